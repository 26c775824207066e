// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "api/wall_parts.h"

#include "api/refusals.h"
#include "base/number_words.h"
#include "base/state_blocks.h"
#include "law/sub_models.h"
#include "wall/spec_text.h"

#include <cstddef>
#include <initializer_list>

namespace lsdcd {

namespace {

std::string text_of(Real value)
{
  return exact_text(value + 0.);    // not -0
}

std::string text_of(std::initializer_list<Real> values)
{
  std::string text;
  for (const Real value : values) text += (text.empty() ? "" : " ") + text_of(value);
  return text;
}

std::string text_of(const Vec3 &v)
{
  return text_of({v.x, v.y, v.z});
}

template <class Model>
std::string numbers_of(const Chosen<Model> &chosen)
{
  return chosen.is_on() ? ", " + text_of({chosen.numbers[0], chosen.numbers[1], chosen.numbers[2]})
                        : "";
}

std::string text_of(const ContactLaw &law)
{
  return sub_models_text(law) + " with " +
         text_of({law.k_normal, law.surface_energy, law.eta, law.k_tangent, law.gamma_tangent,
                  law.xgammat, law.mu}) +
         numbers_of(law.rolling) + numbers_of(law.twisting) + numbers_of(law.heat) +
         numbers_of(law.cohesion) + (law.limit_damping ? ", limit_damping" : "");
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
    text += text_of(placement.row(k)) + " " + text_of(placement.shift()[k]) + (k < 2 ? ", " : "");
  return text;
}

std::string text_of(const BodySpec &body)
{
  const SymmetricMatrix &i = body.mass.inertia;
  return std::string("a body, ") + kJointNames[static_cast<int>(body.joint.kind)] + " " +
         text_of(body.joint.point) + " " + text_of(body.joint.axis) + ", of density " +
         text_of(body.density) + ", mass " + text_of(body.mass.mass) + ", centre " +
         text_of(body.mass.centre) + " and inertia " +
         text_of({i.xx, i.yy, i.zz, i.xy, i.xz, i.yz}) +
         (body.coat.present ? ", with a coat of the spacing " + text_of(body.coat.spacing) +
                                  " and radius " + text_of(body.coat.radius)
                            : "");
}

// Of all kinds of terms, as unused ones are 0. Inputs are in the text of the motion.
std::string numbers_of(const MotionTerm &m)
{
  std::string text = text_of(m.velocity) + " " + text_of(m.amplitude) + " " + text_of(m.point) +
                     " " + text_of(m.axis) + " " + text_of({m.period, m.angle});
  if (!m.table) return text;
  const std::vector<Real> &rows = m.table->rows().numbers;
  return text + " and " + std::to_string(m.table->rows().count()) + " rows with the number " +
         std::to_string(checksum(rows.data(), rows.size()));
}

// The texts of motions and servos have six digits of each number, and no rows of tables.
std::string numbers_of(const RigidMotion &motion)
{
  std::string text;
  for (const MotionTerm &m : motion.terms()) text += (text.empty() ? "" : ", ") + numbers_of(m);
  const Servo &s = motion.servo();
  if (!s.present) return text;
  return text + (text.empty() ? "" : ", ") + text_of(s.point) + " " + text_of(s.axis) + " " +
         text_of({s.target, s.max_speed, s.max_gain, s.lo, s.hi});
}

std::string mover_of(const MeshSpec &mesh, const InputNames &inputs)
{
  if (mesh.has_nodes) return "nodes of the program";
  if (mesh.body.present) return text_of(mesh.body);    // which is posed, too
  if (mesh.motion.is_posed()) return "poses of the program";
  const std::string motions = motion_text(mesh.motion.terms(), inputs),
                    servo = servo_text(mesh.motion.servo(), inputs);
  if (motions.empty() && servo.empty()) return "rest";
  return motions + (motions.empty() || servo.empty() ? "" : ", ") + servo;
}

std::string wear_of(const WallSpec &wall)
{
  const char *const models[] = {"none", "archard", "finnie"};
  return models[static_cast<int>(wall.wear.model)] + (" " + text_of(wall.wear.per_work)) +
         (wall.wear_deform.every > 0 ? ", moves vertices " + text_of(wall.wear_deform.factor) : "");
}

}    // namespace

WallParts parts_of(const Wall &wall)
{
  const WallSpec &spec = wall.spec();
  const char *const corners[] = {"blend", "sum"}, *const sides[] = {"both", "in", "out"};
  WallParts parts = {{"number of meshes", std::to_string(spec.meshes.size())},
                     {"law", text_of(spec.laws)},
                     {"corner", corners[static_cast<int>(spec.corner)]},
                     {"side", sides[static_cast<int>(spec.side)]},
                     {"wear", wear_of(spec)}};
  for (std::size_t k = 0; k < spec.meshes.size(); k++) {
    const MeshSpec &mesh = spec.meshes[k];
    const std::string of = " of " + element("meshes", k);
    const std::string mover = mover_of(mesh, spec.inputs), numbers = numbers_of(mesh.motion);
    parts.push_back({"motion" + of, mover});
    if (!numbers.empty()) parts.push_back({"exact motion '" + mover + "'" + of, numbers});
    parts.push_back({"placement" + of, text_of(mesh.placement)});
    parts.push_back({"law" + of, text_of(mesh.laws)});
    if (spec.wears()) parts.push_back({"wear_factor" + of, text_of(mesh.wear_factor)});
  }
  for (const MeshPart &mesh : wall.meshes()) {
    const MeshReport &report = mesh.grid.report();
    parts.push_back({"mesh of " + element("meshes", static_cast<std::size_t>(mesh.index)),
                     std::to_string(report.facets) + " triangles with " +
                         std::to_string(report.vertices) + " vertices and the number " +
                         std::to_string(mesh.grid.mesh_fingerprint())});
  }
  return parts;
}

std::string differences(const WallParts &is, const WallParts &was)
{
  std::string text;
  for (const std::vector<std::string> &part : is)
    for (const std::vector<std::string> &other : was)
      if (part.size() == 2 && other.size() == 2 && part[0] == other[0] && part[1] != other[1])
        text += (text.empty() ? "the " : "; the ") + part[0] + " is " + part[1] + " and was " +
                other[1];
  return text;
}

}    // namespace lsdcd
