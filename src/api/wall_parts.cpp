// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "api/wall_parts.h"

#include "api/refusals.h"
#include "base/number_words.h"
#include "base/state_blocks.h"
#include "law/sub_models.h"
#include "wall/spec/settings.h"
#include "wall/spec/spec_text.h"
#include "wall/spec/spec_words.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace lsdcd {

namespace {

std::string text_of(Real value)
{
  return exact_text(value + 0.);    // not -0
}

std::string text_of(const Vec3 &v)
{
  return text_of(v.x) + " " + text_of(v.y) + " " + text_of(v.z);
}

// "1 2 0 0 1", of numbers and vectors.
template <class... Values>
std::string row_of(const Values &...values)
{
  std::string text;
  for (const std::string &one : {text_of(values)...}) text += (text.empty() ? "" : " ") + one;
  return text;
}

// What follows takes structs apart by the names of all their members: one that is new does not compile before it is decided
// here whether saved data are of a wall with another one; the keywords of WallSpec and MeshSpec are in the rows of
// tests/library/wall_words.py. Inputs are by their names (InputsText).

template <class Model>
std::string numbers_of(const Chosen<Model> &chosen)
{
  if (!chosen.is_on()) return "";
  const Real *const n = chosen.numbers;
  return ", " + (n[3] == 0 ? row_of(n[0], n[1], n[2]) : row_of(n[0], n[1], n[2], n[3]));
}

// `modulus` is 3/4 k_normal; `for_shapes` and those that begin with `keeps` are the wall's.
std::string text_of(const ContactLaw &law)
{
  const auto &[normal, k_normal, modulus, surface_energy, plastic, damping, eta, tangential,
               k_tangent, gamma_tangent, xgammat, mu, rolling, twisting, heat, cohesion,
               limit_damping, for_shapes, keeps_forces, keeps_at_nodes, keeps_losses, keeps_touch] =
      law;
  return sub_models_text(law) + " with " +
         row_of(k_normal, surface_energy, eta, k_tangent, gamma_tangent, xgammat, mu) +
         (law.yields() ? ", " + row_of(plastic[0], plastic[1], plastic[2], plastic[3], plastic[4],
                                       plastic[5])
                       : "") +
         numbers_of(rolling) + numbers_of(twisting) + numbers_of(heat) + numbers_of(cohesion) +
         (limit_damping ? ", limit_damping" : "");
}

std::string text_of(const std::vector<LawOfTypes> &laws)
{
  std::string text;
  for (const LawOfTypes &row : laws) {
    const std::string types = types_text(row);
    text += (text.empty() ? "" : "; ") + (types.empty() ? "" : "types " + types + " ") +
            text_of(row.law);
  }
  return text.empty() ? "that of the wall" : text;
}

std::string text_of(const Placement &placement)
{
  std::string text;
  for (int k = 0; k < 3; k++)
    text += row_of(placement.row(k), placement.shift()[k]) + (k < 2 ? ", " : "");
  return text;
}

std::string text_of(const JointDrive &drive)
{
  const auto &[stiffness, damping, rest, lo, hi, motor] = drive;
  std::string text;
  if (stiffness != 0) text += ", spring " + row_of(stiffness, rest);
  if (damping != 0) text += ", damping " + text_of(damping);
  if (std::isfinite(lo) || std::isfinite(hi)) text += ", limits " + row_of(lo, hi);
  if (motor != 0) text += ", motor " + text_of(motor);
  return text;
}

// Returns a number, or 0 where it is the last value of an input, whose name is what counts.
Real fixed(Real value, int input)
{
  return input == kNoInput ? value : 0;
}

Vec3 fixed(const Vec3 &values, const int (&inputs)[3])
{
  return {fixed(values.x, inputs[0]), fixed(values.y, inputs[1]), fixed(values.z, inputs[2])};
}

// The data have its velocities, which it has at the start alone.
std::string text_of(const BodySpec &body)
{
  const auto &[present, density, mass, joint, drive, load, moment, motor_input, load_input,
               moment_input, velocity, omega, has_gravity, gravity, coat] = body;
  if (!present) return "none";
  JointDrive fixed_drive = drive;
  fixed_drive.motor = fixed(drive.motor, motor_input);
  const SymmetricMatrix &i = mass.inertia;
  return std::string(kJointNames[static_cast<int>(joint.kind)]) + " " +
         row_of(joint.point, joint.axis) + ", of density " + text_of(density) + ", mass " +
         text_of(mass.mass) + ", centre " + text_of(mass.centre) + " and inertia " +
         row_of(i.xx, i.yy, i.zz, i.xy, i.xz, i.yz) + text_of(fixed_drive) + ", load " +
         text_of(fixed(load, load_input)) + ", moment " + text_of(fixed(moment, moment_input)) +
         (has_gravity ? ", gravity " + text_of(gravity) : "") +
         (coat.present ? ", with a coat of the spacing " + text_of(coat.spacing) + " and radius " +
                             text_of(coat.radius)
                       : "");
}

std::string text_of(const SurfaceMotion &surface)
{
  const auto &[velocity, angular, centre] = surface;
  return text_of(velocity) + ", turning " + text_of(angular) + " about " + text_of(centre);
}

// Of all kinds of terms, as unused numbers are 0. Kind and inputs, of which displacement, speed and its change are values, are in the
// text of the motion, as is the table's file, whose rows count.
std::string numbers_of(const MotionTerm &term)
{
  const auto &[kind, velocity, amplitude, point, axis, period, angle, input, displacement, speed,
               speeding_up, table_file, table_options, table] = term;
  const std::string text = row_of(velocity, amplitude, point, axis, period, angle);
  if (!table) return text;
  const std::vector<Real> &rows = table->rows().numbers;
  return text + " and " + std::to_string(table->rows().count()) + " rows with the number " +
         std::to_string(checksum(rows.data(), rows.size()));
}

std::string numbers_of(const std::vector<MotionTerm> &terms)
{
  std::string text;
  for (const MotionTerm &m : terms) text += (text.empty() ? "" : ", ") + numbers_of(m);
  return text;
}

// The data have its position and velocity, and whether it holds.
std::string numbers_of(const Servo &servo)
{
  const auto &[present, holds, turns, axis, point, target, target_input, max_gain, max_speed, lo,
               hi, position, velocity] = servo;
  return present ? row_of(point, axis, fixed(target, target_input), max_speed, max_gain, lo, hi)
                 : "";
}

// The names of the inputs behind some numbers, in their order.
class InputsText {
 public:
  explicit InputsText(const InputNames &names) : names_(names) {}

  void add(int input)
  {
    any_ |= input != kNoInput;
    text_ += (text_.empty() ? "" : " ") +
             (input == kNoInput ? "-" : "v_" + names_[static_cast<std::size_t>(input)]);
  }
  template <std::size_t n>
  void add(const int (&inputs)[n])
  {
    for (const int input : inputs) add(input);
  }
  void add_to(WallParts &parts, const std::string &of) const
  {
    parts.push_back({"inputs" + of, any_ ? text_ : "none"});
  }

 private:
  const InputNames &names_;
  std::string text_;
  bool any_ = false;
};

std::string motion_of(const MeshSpec &mesh, const InputNames &inputs)
{
  if (mesh.has_nodes) return "nodes of the program";
  if (mesh.body.present) return "that of a body";    // which is posed, too
  if (mesh.motion.is_posed()) return "poses of the program";
  return mesh.motion.moves() ? motion_text(mesh.motion.terms(), inputs) : "rest";
}

std::string text_of(const Wear &wear, const WearDeform &deform)
{
  const auto &[model, per_work, oka] = wear;
  const auto &[hardness, n1, n2, k2, k3, speed, diameter, least_speed] = oka;
  const auto &[every, factor] = deform;
  std::string numbers = " " + text_of(per_work);
  if (model == WearModel::oka)
    for (const Real number : {hardness, n1, n2, k2, k3, speed, diameter, least_speed})
      numbers += " " + text_of(number);
  return word_of(model, kWearWords) + numbers +
         (every > 0
              ? ", every " + std::to_string(every) + " steps moves vertices " + text_of(factor)
              : "");
}

template <class Kind, class T>
std::string text_of(const Kind &kind, const T &value)
{
  if constexpr (std::is_same_v<Kind, WordSetting>)
    return kind.words[static_cast<std::size_t>(value)];
  else
    return text_of(static_cast<Real>(value));
}

// Adds a setting by its rule; "any" where it changes no number of this wall.
void add_setting(OfState rule, const WallSpec &wall, const std::string &name,
                 const std::string &text, WallParts &parts)
{
  const bool counts = rule == OfState::compared ||
                      (rule == OfState::with_nearest && wall.nearest > 0) ||
                      (rule == OfState::with_wear && wall.wears());
  const bool may_count = counts || rule == OfState::with_nearest || rule == OfState::with_wear;
  if (may_count) parts.push_back({name, counts ? text : "any"});
}

std::string steps_text(int every)
{
  return every > 0 ? "over " + std::to_string(every) + " steps" : "none";
}

// What `mesh` and its name and file are is not here: the mesh counts that they make. Names of files may differ, and how often
// the mesh is written; the means in `fields` are over the steps between two files.
void add_made(const WallSpec &wall, std::size_t k, WallParts &parts)
{
  const MeshSpec &mesh = wall.meshes[k];
  const std::string of = " of " + element("meshes", k);
  parts.push_back({"placement" + of, text_of(mesh.placement)});
  parts.push_back({"law" + of, text_of(mesh.laws)});
  parts.push_back({"surface velocity" + of, text_of(mesh.surface)});
  parts.push_back({"pressure" + of,
                   mesh.has_nodes ? text_of(fixed(mesh.pressure, mesh.pressure_input)) : "none"});
  parts.push_back(
      {"temperature" + of,
       mesh.has_temperature ? text_of(fixed(mesh.temperature, mesh.temperature_input)) : "none"});
  InputsText inputs(wall.inputs);
  inputs.add(mesh.surface_input);
  inputs.add(mesh.pressure_input);
  inputs.add(mesh.temperature_input);
  inputs.add_to(parts, " of surface, pressure and temperature" + of);
  parts.push_back(
      {"point of the torque" + of,
       text_of(mesh.torque_about) + (mesh.torque_about_mesh ? ", which moves with it" : "")});
  parts.push_back({"mean of the fields" + of, steps_text(mesh.fields.every)});
#define LSDCD_PART(member, kind, rule, name, ...)                                                  \
  add_setting(OfState::rule, wall, name + of, text_of(kind, mesh.member), parts);
  LSDCD_MESH_SETTINGS(LSDCD_PART)
#undef LSDCD_PART
}

// Without periodic axes the box says how far spheres go, as rmax does.
std::string text_of(const PeriodicBox &box)
{
  std::string text;
  for (int k = 0; k < 3; k++)
    if (box.periodic[k])
      text += (text.empty() ? "" : ", ") + std::string(1, "xyz"[k]) + " from " +
              row_of(box.corner[k], box.edge[k][k]);
  return text.empty() ? "not periodic" : text;
}

using WallPart = WallParts::value_type;
constexpr const char *kOfMeshes = " of meshes[";

const WallPart *find_part(const WallParts &parts, const std::string &name)
{
  for (const WallPart &part : parts)
    if (part.front() == name) return &part;
  return nullptr;
}

// The text of all digits; empty: the other one has them.
std::string exact_text_of(const WallPart &part)
{
  return part.size() > 2 ? part[2] : "";
}

// "exact motion 'linear 0 0 1' of meshes[1]", of the part "motion of meshes[1]".
std::string exact_name_of(const WallPart &part)
{
  const std::size_t end = std::min(part[0].find(kOfMeshes), part[0].size());
  return "exact " + part[0].substr(0, end) + " '" + part[1] + "'" + part[0].substr(end);
}

// Returns whether a wall has the mesh that a part is of, or the part is of no mesh.
bool has_mesh_of(const WallParts &wall, const std::string &name)
{
  const std::size_t at = name.find(kOfMeshes);
  if (at == std::string::npos) return true;
  return find_part(wall, "motion" + name.substr(at)) != nullptr;
}

}    // namespace

WallParts made_parts(const Wall &wall, const PeriodicBox &box)
{
  const WallSpec &spec = wall.spec();
  WallParts parts = {{"number of meshes", std::to_string(spec.meshes.size())},
                     {"law", text_of(spec.laws)},
                     {"wear", text_of(spec.wear, spec.wear_deform)},
                     {"grains", spec.shapes ? "of any shape" : "spheres"},
                     {"periodic box", text_of(box)}};
#define LSDCD_PART(member, kind, rule, name, ...)                                                  \
  add_setting(OfState::rule, spec, name, text_of(kind, spec.member), parts);
  LSDCD_WALL_SETTINGS(LSDCD_PART)
#undef LSDCD_PART
  for (std::size_t k = 0; k < spec.meshes.size(); k++) add_made(spec, k, parts);
  for (const MeshPart &mesh : wall.meshes()) {
    const MeshReport &report = mesh.grid.report();
    parts.push_back({"mesh of " + element("meshes", static_cast<std::size_t>(mesh.index)),
                     counted(report.facets, "triangle") + " with " +
                         counted(report.vertices, "vertex", "vertices") + " and the number " +
                         std::to_string(mesh.grid.mesh_fingerprint())});
  }
  return parts;
}

WallParts set_parts(const Wall &wall)
{
  const WallSpec &spec = wall.spec();
  WallParts parts;
  for (std::size_t k = 0; k < spec.meshes.size(); k++) {
    const Servo &servo = spec.meshes[k].motion.servo();
    const std::string of = " of " + element("meshes", k);
    parts.push_back({"motion" + of, motion_of(spec.meshes[k], spec.inputs),
                     numbers_of(spec.meshes[k].motion.terms())});
    parts.push_back(
        {"servo" + of, servo.present ? servo_text(servo, spec.inputs) : "none", numbers_of(servo)});
    const BodySpec &body = spec.meshes[k].body;
    parts.push_back({"body" + of, text_of(body)});
    InputsText inputs(spec.inputs);
    inputs.add(body.motor_input);
    inputs.add(body.load_input);
    inputs.add(body.moment_input);
    inputs.add_to(parts, " of motor, load and moment" + of);
  }
  return parts;
}

std::string differences(const WallParts &is, const WallParts &was)
{
  std::string text;
  const auto add = [&](const std::string &name, const std::string &one, const std::string &other) {
    if (one != other)
      text += (text.empty() ? "the " : "; the ") + name + " is " + one + " and was " + other;
  };
  const WallPart none = {"", "none"};
  for (const WallPart &part : is) {
    const WallPart *const other = find_part(was, part[0]);
    if (!other && !has_mesh_of(was, part[0])) continue;
    const WallPart &before = other ? *other : none;
    add(part[0], part[1], before[1]);
    if (part[1] == before[1]) add(exact_name_of(part), exact_text_of(part), exact_text_of(before));
  }
  for (const WallPart &part : was)
    if (!find_part(is, part[0]) && has_mesh_of(is, part[0])) add(part[0], none[1], part[1]);
  return text;
}

}    // namespace lsdcd
