// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/wall_outputs.h"

#include "base/input_words.h"
#include "base/quaternion.h"

#include <algorithm>

namespace lsdcd {

namespace {

template <Vec3 MeshTotals::*member>
Real vector_of(Wall &wall, int mesh, int d)
{
  return (wall.totals().mesh(mesh).*member)[d];
}
template <Real MeshTotals::*member>
Real number_of(Wall &wall, int mesh, int /* d */)
{
  return wall.totals().mesh(mesh).*member;
}
template <Vec3 MeshTotals::*member>
Real vector_of_all(Wall &wall, int d)
{
  return (wall.totals().of_all().*member)[d];
}
template <Real MeshTotals::*member>
Real number_of_all(Wall &wall, int /* d */)
{
  return wall.totals().of_all().*member;
}
template <Vec3 MeanLoad::*member>
Real mean_of(Wall &wall, int mesh, int d)
{
  return (wall.means().mesh(mesh).*member)[d];
}
template <Vec3 MeanLoad::*member>
Real mean_of_all(Wall &wall, int d)
{
  return (wall.means().of_all().*member)[d];
}

// Of a mesh that is a body; 0 of others.
template <Real (*get)(const BodyMover &, int)>
Real of_body(Wall &wall, int mesh, int d)
{
  const BodyMover *body = wall.body(mesh);
  return body ? get(*body, d) : 0;
}
Real centre(const BodyMover &b, int d)
{
  return b.rigid().centre()[d];
}
Real velocity(const BodyMover &b, int d)
{
  return b.rigid().velocity()[d];
}
Real turn(const BodyMover &b, int d)
{
  const Quaternion &q = b.rigid().turn();
  return d == 0 ? q.w : q.v[d - 1];
}
Real omega(const BodyMover &b, int d)
{
  return b.rigid().omega()[d];
}
Real reaction_force(const BodyMover &b, int d)
{
  return b.reaction().force[d];
}
Real reaction_torque(const BodyMover &b, int d)
{
  return b.reaction().torque[d];
}
Real coordinate(const BodyMover &b, int /* d */)
{
  return b.rigid().coordinate();
}
Real energy(const BodyMover &b, int /* d */)
{
  return b.spring_and_kinetic_energy();
}
Real stop_force(const BodyMover &b, int /* d */)
{
  return b.stop_force();
}

Real place(Wall &wall, int mesh, int d)
{
  return wall.meshes()[mesh].pose().to_box({0, 0, 0})[d];
}
// Returns the rotation that has these rows, with w at least 0 (Shepperd 1978: the largest number is computed first).
Quaternion quaternion_of(const Vec3 (&row)[3])
{
  const Real trace = row[0].x + row[1].y + row[2].z;
  int k = 0;
  for (int i = 1; i < 3; i++)
    if (row[i][i] > row[k][k]) k = i;
  Quaternion q;
  if (trace > row[k][k]) {
    q = {1 + trace, {row[2].y - row[1].z, row[0].z - row[2].x, row[1].x - row[0].y}};
  } else {
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    q.w = row[j][i] - row[i][j];
    q.v[k] = 1 + row[k][k] - row[i][i] - row[j][j];
    q.v[i] = row[k][i] + row[i][k];
    q.v[j] = row[k][j] + row[j][k];
  }
  q = normalised(q);
  return q.w < 0 ? Quaternion{-q.w, -q.v} : q;
}
Real orientation(Wall &wall, int mesh, int d)
{
  const Pose &pose = wall.meshes()[mesh].pose();
  const Quaternion q = pose.placed ? quaternion_of(pose.row) : Quaternion();
  return d == 0 ? q.w : q.v[d - 1];
}

// Position, velocity, push.
template <int which>
Real of_servo(Wall &wall, int mesh, int /* d */)
{
  const Servo &s = wall.meshes()[mesh].servo();
  if (!s.present) return 0;
  return which == 0 ? s.position : which == 1 ? s.velocity : wall.servo_push(mesh);
}

Real power(Wall &wall, int mesh, int /* d */)
{
  return wall.totals_with_power().mesh(mesh).power;
}
Real power_of_all(Wall &wall, int /* d */)
{
  return wall.totals_with_power().of_all().power;
}

Real worn(Wall &wall, int mesh, int /* d */)
{
  return wall.worn(mesh);
}
Real removed(Wall &wall, int mesh, int /* d */)
{
  return wall.removed(mesh);
}
Real held_back(Wall &wall, int mesh, int /* d */)
{
  return wall.held_back(mesh);
}

Real dissipated_power(const BookedEnergy &e, int d)
{
  return e.power(kCauses[d]);
}
Real dissipated(const BookedEnergy &e, int d)
{
  return e.rows[kCauses[d]];
}
Real other_losses(const BookedEnergy &e, int d)
{
  return e.rows[kOtherLosses[d]];
}
template <EnergyRow row>
Real sum_of(const BookedEnergy &e, int /* d */)
{
  return e.rows[row];
}
template <EnergyRow row>
Real power_of(const BookedEnergy &e, int /* d */)
{
  return e.power(row);
}
Real remainder(const BookedEnergy &e, int /* d */)
{
  return e.remainder();
}
template <Real (*get)(const BookedEnergy &, int)>
Real energy_of(Wall &wall, int mesh, int d)
{
  return get(wall.energy().mesh(mesh), d);
}
template <Real (*get)(const BookedEnergy &, int)>
Real energy_of_all(Wall &wall, int d)
{
  return get(wall.energy().of_all(), d);
}

Real impacts(Wall &wall, int mesh, int /* d */)
{
  return wall.impacts(mesh).impacts();
}
Real impact_energy(Wall &wall, int mesh, int /* d */)
{
  return wall.impacts(mesh).energy();
}

bool has_servo(const MeshSpec &m)
{
  return m.motion.servo().present;
}
bool is_body(const MeshSpec &m)
{
  return m.body.present;
}

// Also one that was stopped.
bool has_motion(const MeshSpec &m)
{
  return m.motion.moves() || m.motion.start().placed || !m.motion.stopped().empty();
}

bool has(const WallSpec &wall, OutputPart part)
{
  const auto any = [&](bool (*of)(const MeshSpec &)) {
    return std::any_of(wall.meshes.begin(), wall.meshes.end(), of);
  };
  switch (part) {
    case OutputPart::servo:
      return any(has_servo);
    case OutputPart::body:
      return any(is_body);
    case OutputPart::wear:
      return wall.wear_deform.every > 0;
    case OutputPart::wear_energy:
      return wall.energy && wall.wear_deform.every > 0;
    case OutputPart::plastic:
      return wall.energy && wall.law().yields();
    case OutputPart::nodes:
      return wall.has_nodes();
    case OutputPart::means:
      return wall.average_every > 0;
    case OutputPart::motion:
      return any(has_motion);
    case OutputPart::energy:
      return wall.energy;
    case OutputPart::impacts:
      return wall.impact_speed > 0;
    case OutputPart::scalar:
      return false;
    default:
      return true;
  }
}

// Returns the only mesh that has it, or -1 where several have it, or none.
int only_mesh_with(const WallSpec &wall, bool (*has)(const MeshSpec &))
{
  int only = -1;
  for (std::size_t k = 0; k < wall.meshes.size(); k++) {
    if (!has(wall.meshes[k])) continue;
    if (only >= 0) return -1;
    only = static_cast<int>(k);
  }
  return only;
}

}    // namespace

const char *keyword_of(OutputPart part)
{
  switch (part) {
    case OutputPart::servo:
      return "*servo*";
    case OutputPart::body:
      return "*body*";
    case OutputPart::wear:
      return "*wear ... deform*";
    case OutputPart::nodes:
      return "*nodes*";
    case OutputPart::means:
      return "*average*";
    case OutputPart::motion:
      return "*motion*";
    case OutputPart::energy:
      return "*energy*";
    case OutputPart::impacts:
      return "*impacts*";
    case OutputPart::wear_energy:
      return "*energy* with *wear ... deform*";
    case OutputPart::plastic:
      return "*energy* with a law that yields";
    default:
      return "";
  }
}

const std::vector<WallOutput> &wall_outputs()
{
  using P = OutputPart;
  using T = MeshTotals;
  const bool adds_up = true, is_one = false;
  const char *const xyz = "x y z", *const wxyz = "w x y z", *const one = "";
  static const std::vector<WallOutput> all = {
      {{3, "force", xyz, "force on the mesh, x y z", "force units"},
       adds_up,
       P::every_wall,
       vector_of<&T::force>,
       vector_of_all<&T::force>},
      {{3, "torque", xyz, "torque on the mesh about the point of *torque_about*, x y z",
        "torque units"},
       adds_up,
       P::every_wall,
       vector_of<&T::torque>,
       vector_of_all<&T::torque>},
      {{1, "contacts", one, "number of contacts that carry a force", ""},
       adds_up,
       P::every_wall,
       number_of<&T::contacts>,
       number_of_all<&T::contacts>},
      {{1, "overlap", one,
        "largest overlap divided by the radius, of an ellipsoid by its least half-axis", ""},
       is_one,
       P::every_wall,
       number_of<&T::overlap>,
       number_of_all<&T::overlap>},
      {{1, "uncertified", one,
        "number of spheres whose contacts are not certified exact; 0 except with *nearest N*", ""},
       adds_up,
       P::every_wall,
       number_of<&T::uncertified>,
       number_of_all<&T::uncertified>},
      {{1, "worn_volume", one, "volume worn off since the beginning; 0 without *wear*",
        "volume units"},
       adds_up,
       P::every_wall,
       worn,
       nullptr},
      {{1, "power", one, "power of the moving mesh on the spheres", "energy/time units"},
       adds_up,
       P::every_wall,
       power,
       power_of_all},
      {{1, "servo_position", one, "position of the servo; 0 without one",
        "distance units; with *torque* radians"},
       is_one,
       P::servo,
       of_servo<0>,
       nullptr},
      {{1, "servo_velocity", one, "its speed", "velocity units; with *torque* radians/time"},
       is_one,
       P::servo,
       of_servo<1>,
       nullptr},
      {{1, "servo_push", one, "its push on the spheres", "force units; with *torque* torque units"},
       adds_up,
       P::servo,
       of_servo<2>,
       nullptr},
      {{3, "body_centre", xyz, "centre of mass of the body, x y z", "distance units"},
       is_one,
       P::body,
       of_body<centre>,
       nullptr},
      {{3, "body_velocity", xyz, "its velocity, x y z", "velocity units"},
       is_one,
       P::body,
       of_body<velocity>,
       nullptr},
      {{4, "body_quaternion", wxyz, "its rotation since the start, a quaternion w x y z", ""},
       is_one,
       P::body,
       of_body<turn>,
       nullptr},
      {{3, "body_angular_velocity", xyz, "its angular velocity, x y z", "radians/time"},
       is_one,
       P::body,
       of_body<omega>,
       nullptr},
      {{3, "body_reaction_force", xyz, "force that the joint exerts on the body to hold it, x y z",
        "force units"},
       adds_up,
       P::body,
       of_body<reaction_force>,
       nullptr},
      {{3, "body_reaction_torque", xyz,
        "torque that it exerts, x y z, about the joint's point or, for *slider* and *planar*, the "
        "centre",
        "torque units"},
       adds_up,
       P::body,
       of_body<reaction_torque>,
       nullptr},
      {{1, "body_coordinate", one, "coordinate of *hinge* or *slider*; 0 with another joint",
        "radians; with *slider* distance units"},
       is_one,
       P::body,
       of_body<coordinate>,
       nullptr},
      {{1, "body_energy", one, "kinetic energy of the body, with that of its spring",
        "energy units"},
       adds_up,
       P::body,
       of_body<energy>,
       nullptr},
      {{1, "removed_volume", one, "volume by which *wear ... deform* has moved the mesh",
        "volume units"},
       adds_up,
       P::wear,
       removed,
       nullptr},
      {{1, "held_back_volume", one,
        "volume that it has held back, because triangles would fold over or meet", "volume units"},
       adds_up,
       P::wear,
       held_back,
       nullptr},
      {{3, "couple", xyz, "torque on a mesh with *nodes* that none of its nodes gets, x y z",
        "torque units"},
       adds_up,
       P::nodes,
       vector_of<&T::couple>,
       nullptr},
      {{1, "body_stop_force", one,
        "force of a stop (*limits*) on the body along the axis of its *slider*, or torque about "
        "that "
        "of its *hinge*; 0 where the body is at none",
        "force or torque units"},
       adds_up,
       P::body,
       of_body<stop_force>,
       nullptr},
      {{3, "mean_force", xyz, "with *average N* the mean of 1-3 over N steps, x y z",
        "force units"},
       adds_up,
       P::means,
       mean_of<&MeanLoad::force>,
       mean_of_all<&MeanLoad::force>},
      {{3, "mean_torque", xyz, "with *average N* the mean of 4-6 over N steps, x y z",
        "torque units"},
       adds_up,
       P::means,
       mean_of<&MeanLoad::torque>,
       mean_of_all<&MeanLoad::torque>},
      {{3, "position", xyz,
        "place of a mesh with *motion*: of its point that was at 0 0 0 at the start, x y z",
        "distance units"},
       is_one,
       P::motion,
       place,
       nullptr},
      {{4, "quaternion", wxyz, "its rotation since the start, a quaternion w x y z", ""},
       is_one,
       P::motion,
       orientation,
       nullptr},
      {{5, "dissipated_power", kCauseNames,
        "power that contacts dissipate in the step: damping, slider, rolling, twisting, adhesion",
        "energy/time units"},
       adds_up,
       P::energy,
       energy_of<dissipated_power>,
       energy_of_all<dissipated_power>},
      {{5, "dissipated", kCauseNames,
        "energy that contacts have dissipated since the beginning: damping, slider, rolling, "
        "twisting, adhesion",
        "energy units"},
       adds_up,
       P::energy,
       energy_of<dissipated>,
       energy_of_all<dissipated>},
      {{4, "lost", kOtherLossNames,
        "energy that is lost by lever arms, stiffness, turned springs, and with contacts that are "
        "inserted and deleted",
        "energy units"},
       adds_up,
       P::energy,
       energy_of<other_losses>,
       energy_of_all<other_losses>},
      {{1, "contact_work", one, "work of grains and mesh on their contacts", "energy units"},
       adds_up,
       P::energy,
       energy_of<sum_of<EnergyRow::work>>,
       energy_of_all<sum_of<EnergyRow::work>>},
      {{1, "drive_work", one, "work of the moving mesh on the spheres", "energy units"},
       adds_up,
       P::energy,
       energy_of<sum_of<EnergyRow::drive>>,
       energy_of_all<sum_of<EnergyRow::drive>>},
      {{1, "held_energy", one, "elastic energy of contacts after the last step", "energy units"},
       adds_up,
       P::energy,
       energy_of<sum_of<EnergyRow::held>>,
       energy_of_all<sum_of<EnergyRow::held>>},
      {{1, "remainder", one, "contact work less all of the rows above: what the timestep costs",
        "energy units"},
       adds_up,
       P::energy,
       energy_of<remainder>,
       energy_of_all<remainder>},
      {{1, "impacts", one, "number of impacts since the beginning", ""},
       adds_up,
       P::impacts,
       impacts,
       nullptr},
      {{1, "impact_energy", one, "their energy, the sum of m v^2/2 with the speed along the normal",
        "energy units"},
       adds_up,
       P::impacts,
       impact_energy,
       nullptr},
      {{1, "lost_wear", one, "energy that contacts lose as *wear ... deform* moves the mesh",
        "energy units"},
       adds_up,
       P::wear_energy,
       energy_of<sum_of<EnergyRow::wear>>,
       energy_of_all<sum_of<EnergyRow::wear>>},
      {{1, "dissipated_power_plastic", one,
        "power that contacts dissipate in the step by yielding, and on the adhesive branch of "
        "those "
        "that have",
        "energy/time units"},
       adds_up,
       P::plastic,
       energy_of<power_of<EnergyRow::plastic>>,
       energy_of_all<power_of<EnergyRow::plastic>>},
      {{1, "dissipated_plastic", one,
        "energy that contacts have dissipated since the beginning by yielding, and on the "
        "adhesive "
        "branch of those that have",
        "energy units"},
       adds_up,
       P::plastic,
       energy_of<sum_of<EnergyRow::plastic>>,
       energy_of_all<sum_of<EnergyRow::plastic>>},
      {{1, "elastic_energy", one,
        "elastic energy of overlaps and tangential springs, by the forces of the last step",
        "energy units"},
       adds_up,
       P::scalar,
       number_of<&T::energy>,
       number_of_all<&T::energy>}};
  return all;
}

int n_outputs(const WallSpec &wall)
{
  int n = 0, columns = 0;
  for (const WallOutput &row : wall_outputs()) {
    n += row.row.n;
    if (has(wall, row.part)) columns = n;
  }
  return columns;
}

namespace {

// Returns whether a wall has the numbers of a row.
bool has_row(const WallSpec &wall, const WallOutput &output)
{
  return output.part == OutputPart::scalar || has(wall, output.part);
}

}    // namespace

Real output_value(Wall &wall, int mesh, const WallOutput &output, int d)
{
  if (!has_row(wall.spec(), output)) return 0;
  if (mesh >= 0) return output.of_mesh(wall, mesh, d);
  if (output.of_all) return output.of_all(wall, d);
  bool (*const owner)(const MeshSpec &) = output.part == OutputPart::servo    ? has_servo
                                          : output.part == OutputPart::body   ? is_body
                                          : output.part == OutputPart::motion ? has_motion
                                                                              : nullptr;
  if (owner) {
    const int only = only_mesh_with(wall.spec(), owner);
    return only < 0 ? 0 : output.of_mesh(wall, only, d);
  }
  Real sum = 0;
  for (const MeshPart &m : wall.meshes()) sum += output.of_mesh(wall, m.index, d);
  return sum;
}

Real output_of(Wall &wall, int mesh, int column)
{
  const WallOutput *output = wall_outputs().data();
  for (; column >= output->row.n; output++) column -= output->row.n;
  return output_value(wall, mesh, *output, column);
}

namespace {

const WallOutput *row_of(const std::string &name, int &d)
{
  for (const WallOutput &output : wall_outputs())
    for (d = 0; d < output.row.n; d++)
      if (output_name(output.row, d) == name) return &output;
  return nullptr;
}

}    // namespace

const WallOutput *find_output(const WallSpec &wall, const std::string &name, int &d)
{
  const WallOutput *const output = row_of(name, d);
  return output && has_row(wall, *output) ? output : nullptr;
}

std::vector<NamedElement> named_outputs(const WallSpec &wall)
{
  std::vector<NamedElement> all;
  int column = 0;
  for (const WallOutput &output : wall_outputs())
    for (int d = 0; d < output.row.n; d++, column++)
      if (has_row(wall, output))
        all.push_back({output_name(output.row, d),
                       output.part == OutputPart::scalar ? NamedElement::kScalar : column});
  return all;
}

std::string why_no_output(const WallSpec &wall, const std::string &name)
{
  int d;
  const std::string none = "there is no number '" + name + "': ";
  if (const WallOutput *const output = row_of(name, d)) {
    std::string keyword = keyword_of(output->part);
    std::replace(keyword.begin(), keyword.end(), '*', '\'');    // as messages have keywords
    return none + "the wall needs " + keyword + " for it";
  }
  std::vector<std::string> names;
  for (const NamedElement &one : named_outputs(wall)) names.push_back(one.name);
  return none + nearest_or_all(name, names);
}

}    // namespace lsdcd
