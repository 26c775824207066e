// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/wall_spec.h"

#include "base/input_error.h"

#include <algorithm>
#include <cstddef>
#include <iterator>

namespace lsdcd {

namespace {

const LawOfTypes *last_with(const std::vector<LawOfTypes> &rows, int type)
{
  const LawOfTypes *found = nullptr;
  for (const LawOfTypes &row : rows)
    if (row.has(type)) found = &row;
  return found;
}

const ContactLaw &law_of(const WallSpec &wall, const MeshSpec &mesh, int type)
{
  const LawOfTypes *own = last_with(mesh.laws, type);
  return own ? own->law : last_with(wall.laws, type)->law;
}

// Types beyond the result have the same laws. 0: all types have.
int last_type_named(const WallSpec &wall)
{
  int last = 0;
  const auto look = [&](const std::vector<LawOfTypes> &rows) {
    for (const LawOfTypes &row : rows)
      if (!row.is_of_all())
        last = std::max(last, row.last_type == kAnyType ? row.first_type - 1 : row.last_type);
  };
  look(wall.laws);
  for (const MeshSpec &mesh : wall.meshes) look(mesh.laws);
  return last;
}

// A mesh in a message: its name, or its number from 1.
std::string mesh_text(const WallSpec &wall, std::size_t k)
{
  const MeshSpec &mesh = wall.meshes[k];
  return "mesh " + (mesh.name.empty() ? std::to_string(k + 1) : "'" + mesh.name + "'");
}

void check_inputs(const WallSpec &wall, std::size_t mesh, const std::string &member,
                  const int *input, std::size_t n)
{
  const int n_inputs = static_cast<int>(wall.inputs.size());
  for (std::size_t k = 0; k < n; k++)
    if (input[k] != kNoInput && (input[k] < 0 || input[k] >= n_inputs))
      throw InputError(mesh_text(wall, mesh) + ": " + member + " has input " +
                       std::to_string(input[k]) + ", but the wall has " + std::to_string(n_inputs) +
                       " inputs, which count from 0; add its name to them, or use kNoInput");
}

void check_body(const WallSpec &wall, std::size_t k)
{
  const BodySpec &body = wall.meshes[k].body;
  check_inputs(wall, k, "the motor of its body", &body.motor_input, 1);
  check_inputs(wall, k, "the load of its body", body.load_input, std::size(body.load_input));
  check_inputs(wall, k, "the moment of its body", body.moment_input, std::size(body.moment_input));
  if (body.present && body.coat.present && wall.meshes.size() == 1)
    throw InputError(mesh_text(wall, k) + ": its body has a coat, which feels other meshes, and "
                                          "the wall has no other mesh: leave the coat out");
  if (body.present && body.coat.present &&
      std::any_of(wall.meshes.begin(), wall.meshes.end(),
                  [](const MeshSpec &m) { return m.has_nodes; }))
    throw InputError(mesh_text(wall, k) + ": its body has a coat, which cannot feel meshes whose "
                                          "nodes move: leave out the coat, or the nodes");
  try {
    check_body(body);
  } catch (const InputError &e) {
    throw InputError(mesh_text(wall, k) + ": in its body, " + e.what());
  }
}

// A mesh whose nodes move takes nothing that counts on its shape.
void check_nodes(const WallSpec &wall, std::size_t k)
{
  const MeshSpec &mesh = wall.meshes[k];
  const auto refuse = [&](const std::string &what, const std::string &remedy) {
    throw InputError(mesh_text(wall, k) + " has nodes that move, and " + what + ": " + remedy);
  };
  if (!mesh.has_nodes) {
    if (mesh.pressure != 0 || mesh.pressure_input != kNoInput)
      throw InputError(
          mesh_text(wall, k) +
          " has a pressure, which acts on nodes, and no nodes: give it nodes, or leave "
          "the pressure out");
    return;
  }
  if (mesh.motion.any() || mesh.body.present)
    refuse("a motion, servo, pose or body", "its nodes alone move it; leave the other out");
  if (!mesh.cache_file.empty())
    refuse("a cache file", "its grid is made again as they move; leave the file out");
  if (mesh.torque_about_mesh)
    refuse("a torque about a point of the mesh",
           "they have no frame in which a point could stay; give a point of the box");
  if (wall.nearest > 0) refuse("lists of the nearest primitives", "leave nearest out");
}

// A mesh that recedes by its wear keeps no number that counts on its shape.
void check_wear_shape(const WallSpec &wall, std::size_t k)
{
  const MeshSpec &mesh = wall.meshes[k];
  const auto refuse = [&](const std::string &what) {
    throw InputError(
        "wear moves " + mesh_text(wall, k) + ", and " + what +
        ": leave that or deform out, or give the mesh wear_factor 0, by which it does not wear");
  };
  if (wall.wear_shape.every > 0 && !wall.wears())
    throw InputError("wear should move the meshes, but nothing wears: give a wear model");
  if (!wall.recedes(mesh)) return;
  if (mesh.has_nodes) refuse("others move its nodes");
  if (mesh.body.present) refuse("it is a rigid body, whose mass and centre are those of its shape");
}

// Calls visit(law) for those of the wall and of its meshes.
template <class Visit>
void for_laws(WallSpec &wall, const Visit &visit)
{
  for (LawOfTypes &row : wall.laws) visit(row.law);
  for (MeshSpec &mesh : wall.meshes)
    for (LawOfTypes &row : mesh.laws) visit(row.law);
}

}    // namespace

bool MeshSpec::surface_varies() const
{
  return std::any_of(std::begin(surface_input), std::end(surface_input),
                     [](int input) { return input != kNoInput; });
}

bool WallSpec::has_bodies() const
{
  return std::any_of(meshes.begin(), meshes.end(),
                     [](const MeshSpec &m) { return m.body.present; });
}

bool WallSpec::has_nodes() const
{
  return std::any_of(meshes.begin(), meshes.end(), [](const MeshSpec &m) { return m.has_nodes; });
}

bool WallSpec::has_loads() const
{
  return std::any_of(meshes.begin(), meshes.end(),
                     [this](const MeshSpec &mesh) { return has_loads(mesh); });
}

void check_spec(const WallSpec &wall)
{
  if (wall.laws.empty() || !wall.laws.front().is_of_all())
    throw InputError("the wall's first law is not of all types; give a law of all types first");
  if (wall.meshes.empty())
    throw InputError("the wall has no mesh; give it 1 to " + std::to_string(kMaxMeshes) +
                     " meshes");
  if (wall.meshes.size() > kMaxMeshes)
    throw InputError("the wall has " + std::to_string(wall.meshes.size()) +
                     " meshes; it can have 1 to " + std::to_string(kMaxMeshes) +
                     ", so join some of them, or make a second wall");
  for (std::size_t k = 0; k < wall.meshes.size(); k++) {
    const MeshSpec &mesh = wall.meshes[k];
    for (const MotionTerm &term : mesh.motion.terms())
      check_inputs(wall, k, "its motion", term.input, std::size(term.input));
    check_inputs(wall, k, "its servo", &mesh.motion.servo().target_input, 1);
    check_inputs(wall, k, "its surface", mesh.surface_input, std::size(mesh.surface_input));
    check_inputs(wall, k, "its temperature", &mesh.temperature_input, 1);
    check_body(wall, k);
    check_inputs(wall, k, "its pressure", &mesh.pressure_input, 1);
    check_nodes(wall, k);
    check_wear_shape(wall, k);
    if (wall.law().has_heat() && !mesh.has_temperature)
      throw InputError(mesh_text(wall, k) +
                       " has no temperature, which the sub-model heat needs; give it one");
    if (!wall.law().has_heat() && mesh.has_temperature)
      throw InputError(
          mesh_text(wall, k) +
          " has a temperature, but the law has no sub-model heat that uses it; give the "
          "law one, or the mesh no temperature");
  }
}

void leave_out_zero_cohesion(WallSpec &wall)
{
  bool any = false;
  for_laws(wall, [&](const ContactLaw &law) { any |= law.cohesion.numbers[0] != 0; });
  if (any) return;
  for_laws(wall, [](ContactLaw &law) { law.cohesion = CohesionModel::none; });
}

LawTable law_table(const WallSpec &wall)
{
  LawTable table;
  if (wall.laws.size() == 1 && std::all_of(wall.meshes.begin(), wall.meshes.end(),
                                           [](const MeshSpec &m) { return m.laws.empty(); })) {
    table.laws = {wall.law()};
    return table;
  }
  std::vector<std::vector<const ContactLaw *>> kinds;    // of each, the law of each mesh
  const int last = last_type_named(wall);
  for (int type = 1; type <= last + 1; type++) {
    std::vector<const ContactLaw *> laws;
    for (const MeshSpec &mesh : wall.meshes) laws.push_back(&law_of(wall, mesh, type));
    const auto at = std::find(kinds.begin(), kinds.end(), laws);
    const int kind = static_cast<int>(at - kinds.begin());
    if (at == kinds.end()) kinds.push_back(laws);
    if (type == 1) table.kind_of_type.push_back(kind);    // there is no type 0
    table.kind_of_type.push_back(kind);
  }
  if (last == 0) table.kind_of_type.clear();
  table.kinds = static_cast<int>(kinds.size());
  for (std::size_t m = 0; m < wall.meshes.size(); m++)
    for (const auto &laws : kinds) table.laws.push_back(*laws[m]);
  return table;
}

const ContactLaw &law_of_all_types(const WallSpec &wall, int mesh)
{
  const std::vector<LawOfTypes> &own = wall.meshes[static_cast<std::size_t>(mesh)].laws;
  const auto last =
      std::find_if(own.rbegin(), own.rend(), [](const LawOfTypes &row) { return row.is_of_all(); });
  return last == own.rend() ? wall.law() : last->law;
}

bool torques_share_a_point(const WallSpec &wall)
{
  if (wall.meshes.size() == 1) return true;
  const Vec3 &first = wall.meshes.front().torque_about;
  return std::all_of(wall.meshes.begin(), wall.meshes.end(), [&](const MeshSpec &m) {
    return !m.torque_about_mesh && m.torque_about == first;
  });
}

bool are_one_mesh(const WallSpec &wall, const MeshSpec &mesh, const WallSpec &other_wall,
                  const MeshSpec &other)
{
  return mesh.file == other.file && mesh.mesh == other.mesh && mesh.placement == other.placement &&
         mesh.body.present == other.body.present && mesh.has_nodes == other.has_nodes &&
         are_same(mesh.motion.terms(), wall.inputs, other.motion.terms(), other_wall.inputs) &&
         are_same(mesh.motion.servo(), wall.inputs, other.motion.servo(), other_wall.inputs);
}

}    // namespace lsdcd
