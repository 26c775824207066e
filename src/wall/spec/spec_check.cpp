// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spec/spec_check.h"

#include "base/input_error.h"
#include "engine/shape_engine.h"
#include "law/sub_models.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <string>

namespace lsdcd {

namespace {

// What of a mesh does not go with the rest of its wall. The text is about the value of the keyword, and says what to do.
struct MeshRule {
  const char *keyword;
  bool (*breaks)(const WallSpec &wall, const MeshSpec &mesh);
  const char *text;
};

bool is_driven(const MeshSpec &mesh)
{
  return mesh.motion.moves() || mesh.motion.servo().present;
}

const MeshRule kMeshRules[] = {
    {"temperature",
     [](const WallSpec &w, const MeshSpec &m) { return w.law().has_heat() && !m.has_temperature; },
     "the temperature is missing, which the sub-model heat needs: give the mesh one"},
    {"temperature",
     [](const WallSpec &w, const MeshSpec &m) { return !w.law().has_heat() && m.has_temperature; },
     "a temperature is given, but no sub-model heat uses it: leave it out, or give the law one"},
    {"wear_factor",
     [](const WallSpec &w, const MeshSpec &m) { return !w.wears() && m.wear_factor != 1; },
     "a factor is given, but nothing wears: leave it out, or give the wall a model of wear"},
    {"pressure",
     [](const WallSpec &, const MeshSpec &m) {
       return !m.has_nodes && (m.pressure != 0 || m.pressure_input != kNoInput);
     },
     "it acts on nodes, and the mesh has none: leave it out, or let nodes move the mesh"},
    {"nodes",
     [](const WallSpec &, const MeshSpec &m) {
       return m.has_nodes && (m.motion.any() || m.body.present);
     },
     "its nodes alone move such a mesh: leave its motion, servo, pose or body out"},
    {"motion",
     [](const WallSpec &, const MeshSpec &m) { return m.motion.is_posed() && is_driven(m); },
     "the poses of the program alone move such a mesh: leave its motion and servo out"},
    {"body",
     [](const WallSpec &, const MeshSpec &m) {
       return m.body.present && (is_driven(m) || m.motion.is_posed());
     },
     "a body moves by what acts on it: leave out its motion, wiggle, servo or pose"},
    {"body",
     [](const WallSpec &w, const MeshSpec &m) {
       return m.body.present && m.body.coat.present && w.meshes.size() == 1;
     },
     "its coat feels other meshes, and the wall has no other mesh: leave the coat out"},
    {"body",
     [](const WallSpec &w, const MeshSpec &m) {
       return m.body.present && m.body.coat.present && w.has_nodes();
     },
     "its coat cannot feel meshes whose nodes move: leave out the coat, or the nodes"},
    {"cache",
     [](const WallSpec &, const MeshSpec &m) { return m.has_nodes && !m.cache_file.empty(); },
     "the grid of a mesh is made again as its nodes move: leave the file out"},
    {"torque_about",
     [](const WallSpec &, const MeshSpec &m) { return m.has_nodes && m.torque_about_mesh; },
     "a mesh whose nodes move has no frame in which a point could stay: give a point of the box"},
    {"nodes", [](const WallSpec &w, const MeshSpec &m) { return m.has_nodes && w.nearest > 0; },
     "a mesh whose nodes move has no lists of the nearest primitives: leave nearest out"},
    {"nodes", [](const WallSpec &w, const MeshSpec &m) { return m.has_nodes && w.recedes(m); },
     "wear moves this mesh, and its nodes are moved by others: leave one of them out, or give the "
     "mesh a wear factor by which it does not wear"},
    {"impact_spectrum",
     [](const WallSpec &w, const MeshSpec &m) {
       return m.spectrum.every > 0 && !(w.impact_speed > 0);
     },
     "no impacts are recorded, of which it would be: give the wall the least speed of an impact, "
     "or leave "
     "it out"},
    {"body", [](const WallSpec &w, const MeshSpec &m) { return m.body.present && w.recedes(m); },
     "wear moves this mesh, and the mass and centre of a body are those of its shape: leave one of "
     "them out, or give the mesh a wear factor by which it does not wear"},
};

class SpecCheck {
 public:
  explicit SpecCheck(const WallSpec &wall) : wall_(wall) {}

  void check() const
  {
    check_wall();
    for (std::size_t k = 0; k < wall_.meshes.size(); k++) {
      const MeshSpec &mesh = wall_.meshes[k];
      check_inputs(k);
      check_laws(k);
      for (const MeshRule &rule : kMeshRules)
        if (rule.breaks(wall_, mesh)) refuse(k, rule.keyword, rule.text);
      check_of_body(k, [&] { check_body(mesh.body); });
      for (std::size_t i = 0; i < k; i++) check_apart(i, k);
    }
  }

  void check_begin() const
  {
    for (std::size_t k = 0; k < wall_.meshes.size(); k++)
      check_of_body(k, [&] { check_limits(wall_.meshes[k].body.drive, 0); });
  }

 private:
  template <class Check>
  void check_of_body(std::size_t k, const Check &check) const
  {
    try {
      check();
    } catch (const InputError &e) {
      refuse(k, "body", e.what());
    }
  }

  std::string name_of(std::size_t k) const
  {
    const std::string &name = wall_.meshes[k].name;
    return "mesh " + std::to_string(k + 1) + (name.empty() ? "" : " '" + name + "'");
  }
  [[noreturn]] static void refuse(const std::string &keyword, const std::string &text)
  {
    throw InputError("in '" + keyword + "', " + text);
  }
  [[noreturn]] void refuse(std::size_t k, const std::string &keyword, const std::string &text) const
  {
    refuse(keyword, (wall_.meshes.size() > 1 ? "of " + name_of(k) + ": " : "") + text);
  }

  void check_wall() const
  {
    if (wall_.laws.empty() || !wall_.laws.front().is_of_all())
      refuse("law", "the wall's first law is not of all types; give a law of all types first");
    const std::size_t n = wall_.meshes.size();
    if (n < 1 || n > kMaxMeshes)
      refuse("mesh", "there are " + std::to_string(n) + " meshes, and a wall has 1 to " +
                         std::to_string(kMaxMeshes) +
                         ": join those that never come near one another, or make another wall");
    if (wall_.wear_deform.every > 0 && !wall_.wears())
      refuse("wear",
             "wear should move the meshes, but nothing wears: leave that out, or give the wall a "
             "model of wear");
    if (wall_.friction_heat > 0 && !(wall_.energy && wall_.law().has_heat()))
      refuse("friction_heat", "the heat of friction comes from the energy balance, and goes where "
                              "the law brings heat: give the wall "
                              "energy and the sub-model heat, too, or leave it out");
    if (wall_.shapes) check_shapes();
  }

  // Not all that spheres have is there for other grains.
  void check_shapes() const
  {
    const std::string why = why_not_for_shapes(wall_.law());
    if (!why.empty()) refuse("law", why);
    if (wall_.impact_speed > 0)
      refuse("impacts", "impacts of ellipsoids are not recorded: leave it out");
    if (wall_.wears_by_impact())
      refuse("wear", "oka wears by impacts, and those of ellipsoids are not recorded: take archard "
                     "or finnie");
    if (wall_.side != Side::both)
      refuse("side", "ellipsoids have a wall with both sides alone: leave it out");
    if (wall_.device == Device::cuda)
      refuse("device", "the wall has ellipsoids on a CPU alone: use cpu or auto");
    if (wall_.nearest > 0)
      refuse("nearest",
             "contacts of ellipsoids are found without lists, and none is missed: leave it out");
    if (wall_.has_nodes())
      refuse("nodes", "ellipsoids cannot have a mesh whose nodes move: leave it out");
  }

  void check_inputs(std::size_t k, const std::string &keyword, const int *input,
                    std::size_t n) const
  {
    const int n_inputs = static_cast<int>(wall_.inputs.size());
    for (std::size_t i = 0; i < n; i++)
      if (input[i] != kNoInput && (input[i] < 0 || input[i] >= n_inputs))
        refuse(k, keyword,
               "there is no input " + std::to_string(input[i]) + ", as the wall has " +
                   std::to_string(n_inputs) +
                   ", which count from 0: add its name to them, or use kNoInput");
  }
  void check_inputs(std::size_t k) const
  {
    const MeshSpec &mesh = wall_.meshes[k];
    for (const MotionTerm &term : mesh.motion.terms())
      check_inputs(k, "motion", term.input, std::size(term.input));
    check_inputs(k, "servo", &mesh.motion.servo().target_input, 1);
    check_inputs(k, "surface_vel", mesh.surface_input, std::size(mesh.surface_input));
    check_inputs(k, "temperature", &mesh.temperature_input, 1);
    check_inputs(k, "pressure", &mesh.pressure_input, 1);
    const BodySpec &body = mesh.body;
    check_inputs(k, "body", &body.motor_input, 1);
    check_inputs(k, "body", body.load_input, std::size(body.load_input));
    check_inputs(k, "body", body.moment_input, std::size(body.moment_input));
  }

  // Only numbers differ between the laws of a wall.
  void check_laws(std::size_t k) const
  {
    for (const LawOfTypes &row : wall_.meshes[k].laws)
      if (rows_of(row.law) != rows_of(wall_.law()))
        refuse(k, "law",
               "it has the sub-models " + sub_models_text(row.law) + ", and the wall has " +
                   sub_models_text(wall_.law()) +
                   ": only the numbers may differ; put the mesh into a wall of its own, or give "
                   "both the same sub-models");
  }

  // Two meshes must not be felt twice, nor overwrite each other's files.
  void check_apart(std::size_t i, std::size_t k) const
  {
    const MeshSpec &one = wall_.meshes[i], &other = wall_.meshes[k];
    if (are_one_mesh(wall_, one, wall_, other))
      refuse(k, "mesh",
             "it is that of " + name_of(i) +
                 " at the same place, so every contact would count twice: leave one out, or "
                 "move it");
    const struct {
      const char *keyword;
      const std::string &name, &of_other;
    } files[] = {{"cache", one.cache_file, other.cache_file},
                 {"mesh_fields", one.fields.name, other.fields.name},
                 {"impact_spectrum", one.spectrum.name, other.spectrum.name},
                 {"mesh_stl", one.stl.name, other.stl.name}};
    for (const auto &file : files)
      if (!file.name.empty() && file.name == file.of_other)
        refuse(k, file.keyword,
               name_of(i) + " has the same file '" + file.name +
                   "', so one would overwrite the other: give each a name of its own");
  }

  const WallSpec &wall_;
};

}    // namespace

void check_spec(const WallSpec &wall)
{
  SpecCheck(wall).check();
}

void check_begin(const WallSpec &wall)
{
  SpecCheck(wall).check_begin();
}

}    // namespace lsdcd
