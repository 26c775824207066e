// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spec/wall_spec.h"

#include "output/output_row.h"

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

int WallSpec::contact_columns() const
{
  return contacts ? n_elements(contact_outputs(law().has_heat())) : 0;
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

bool WallSpec::has_energy_places() const
{
  return energy && std::any_of(meshes.begin(), meshes.end(),
                               [this](const MeshSpec &mesh) { return has_energy_places(mesh); });
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
