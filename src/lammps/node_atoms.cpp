// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/node_atoms.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "base/vector_text.h"
#include "wall/mesh_name.h"

#include "atom.h"
#include "domain.h"
#include "group.h"
#include "lammps.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using lsdcd::InputError;
using lsdcd::Vec3;

namespace {

// An atom is a vertex's if it is so near, as a share of the shortest edge of the mesh: more than the rounding of a
// mesh file in float, less than confuses two vertices.
constexpr double kTolerance = 1e-3;

}    // namespace

void NodeAtoms::set_tags(const std::vector<double> &tags)
{
  tag_of.clear();
  node_of.clear();
  for (const double tag : tags) {
    node_of[static_cast<tagint>(tag)] = static_cast<int>(tag_of.size());
    tag_of.push_back(static_cast<tagint>(tag));
  }
}

void NodeAtoms::init(lsdcd::Wall &wall, int wall_bit)
{
  const std::string &name = wall.spec().meshes[mesh].node_group;
  const int group = lmp->group->find(name.c_str());
  if (group < 0)
    throw InputError("there is no group '" + name + "', whose atoms should be the nodes of mesh '" +
                     wall.spec().meshes[mesh].name + "': define it before the wall");
  bit = lmp->group->bitmask[group];
  const Atom &atom = *lmp->atom;
  if (!atom.tag_enable)
    throw InputError("the fix knows nodes by their atom IDs: leave out atom_modify id no");
  // Nodes from a restart file are known already.
  if (tag_of.empty() && !wall.nodes(mesh).names.empty()) set_tags(wall.nodes(mesh).names);
  if (tag_of.empty()) find(wall);
  wall.nodes(mesh).names.assign(tag_of.begin(), tag_of.end());

  bigint both = 0;
  for (int i = 0; i < atom.nlocal; i++)
    both += atom.mask[i] & wall_bit && node_of.count(atom.tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &both, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (both > 0)
    throw InputError(std::to_string(both) + " atoms are nodes of mesh '" +
                     wall.spec().meshes[mesh].name +
                     "' and also in the group of the fix: they would touch the triangles whose "
                     "corners they are; give the fix a group without them");
  send(wall, true);
}

// Each process looks for a vertex near each of its atoms, and all put together what they have found.
void NodeAtoms::find(const lsdcd::Wall &wall)
{
  const lsdcd::MeshPart &part = wall.meshes()[mesh];
  const std::vector<Vec3> &vertices = part.mesh()->vertices;
  const int n = static_cast<int>(vertices.size());
  const double tolerance = kTolerance * part.grid.report().smallest_edge;
  std::vector<int> by_x(n);
  for (int k = 0; k < n; k++) by_x[k] = k;
  std::sort(by_x.begin(), by_x.end(), [&](int a, int b) { return vertices[a].x < vertices[b].x; });

  const Atom &atom = *lmp->atom;
  std::vector<double> sums(2 * n,
                           0);    // how many atoms are at each vertex, and the sum of their tags
  bigint in_group = 0;
  for (int i = 0; i < atom.nlocal; i++) {
    if (!(atom.mask[i] & bit)) continue;
    in_group++;
    double x[3];
    lmp->domain->unmap(atom.x[i], atom.image[i], x);
    const Vec3 at = {x[0], x[1], x[2]};
    auto k = std::lower_bound(by_x.begin(), by_x.end(), at.x - tolerance,
                              [&](int a, double least) { return vertices[a].x < least; });
    for (; k != by_x.end() && vertices[*k].x <= at.x + tolerance; ++k)
      if (lsdcd::norm(vertices[*k] - at) <= tolerance) {
        sums[2 * *k]++;
        sums[2 * *k + 1] += static_cast<double>(atom.tag[i]);
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 2 * n, MPI_DOUBLE, MPI_SUM, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, &in_group, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  const lsdcd::MeshSpec &spec = wall.spec().meshes[mesh];
  int without = 0, first = -1;
  for (int k = n - 1; k >= 0; k--) {
    if (sums[2 * k] > 1)
      throw InputError(lsdcd::number_text(sums[2 * k]) + " atoms of group '" + spec.node_group +
                       "' are at the vertex " + lsdcd::vector_text(vertices[k]) + " of mesh '" +
                       spec.name + "': one of them is its node, remove the others");
    if (sums[2 * k] > 0) continue;
    without++;
    first = k;
  }
  if (without > 0)
    throw InputError(std::to_string(without) + " of the " + std::to_string(n) +
                     " vertices of mesh '" + spec.name + "' have no atom of group '" +
                     spec.node_group + "' within " + lsdcd::number_text(tolerance) +
                     " (a thousandth of the shortest edge): the first is at " +
                     lsdcd::vector_text(vertices[first]) + "; put an atom at each welded vertex");
  std::vector<double> tags;
  for (int k = 0; k < n; k++) tags.push_back(sums[2 * k + 1]);
  set_tags(tags);
}

void NodeAtoms::find_local()
{
  const Atom &atom = *lmp->atom;
  local.clear();
  for (int i = 0; i < atom.nlocal; i++) {
    if (!(atom.mask[i] & bit)) continue;
    const auto node = node_of.find(atom.tag[i]);
    if (node != node_of.end()) local.push_back({i, node->second});
  }
}

// A sum of one number and of zeros is exact: all processes have the same bits, whoever has the atom.
void NodeAtoms::send(lsdcd::Wall &wall, bool look)
{
  if (look) find_local();
  const Atom &atom = *lmp->atom;
  const std::size_t n = tag_of.size();
  numbers.assign((look ? 7 : 6) * n, 0);    // atoms are lost where they are looked for
  for (const Local &of : local) {
    double *x = numbers.data() + 3 * of.node, *v = x + 3 * n;
    lmp->domain->unmap(atom.x[of.atom], atom.image[of.atom], x);
    std::copy_n(atom.v[of.atom], 3, v);
    if (look) numbers[6 * n + of.node]++;
  }
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_SUM,
                lmp->world);
  for (std::size_t k = 0; look && k < n; k++)
    if (numbers[6 * n + k] != 1)
      throw InputError("atom " + std::to_string(tag_of[k]) + ", a node of mesh '" +
                       wall.spec().meshes[mesh].name + "', is " +
                       (numbers[6 * n + k] == 0 ? "lost, or no longer in group '" +
                                                      wall.spec().meshes[mesh].node_group + "'"
                                                : "there more than once") +
                       ": a mesh cannot go on without its nodes");
  wall.set_nodes(mesh, numbers.data(), numbers.data() + 3 * n);
}

void NodeAtoms::add_forces(lsdcd::Wall &wall)
{
  const std::vector<double> &forces = wall.node_forces(mesh);
  double **f = lmp->atom->f;
  for (const Local &of : local)
    for (int d = 0; d < 3; d++) f[of.atom][d] += forces[3 * of.node + d];
}
