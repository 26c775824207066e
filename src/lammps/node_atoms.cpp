// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/node_atoms.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "base/vector_text.h"
#include "lammps/host_fixes.h"
#include "wall/spec/mesh_name.h"

#include "atom.h"
#include "domain.h"
#include "group.h"
#include "lammps.h"
#include "modify.h"

#include <mpi.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

using namespace LAMMPS_NS;
using lsdcd::InputError;
using lsdcd::Vec3;

namespace {

// An atom is a vertex's if it is so near, as a share of the shortest edge of the mesh: more than the rounding of a
// mesh file in float, less than confuses two vertices.
constexpr double kTolerance = 1e-3;

// Outside of a step.
const lsdcd::Step kAtRest = {0, 0, lsdcd::Step::setup};

double tolerance_of(const lsdcd::MeshPart &part)
{
  return kTolerance * part.grid.report().smallest_edge;
}

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

std::string NodeAtoms::init(lsdcd::Wall &wall, int wall_bit, bool keeps_tags)
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
  moved_bit = bit_of_fix_move();
  std::string note;
  // Nodes from a restart file are known already.
  if (tag_of.empty() && !wall.nodes(mesh).names.empty()) set_tags(wall.nodes(mesh).names);
  if (tag_of.empty())
    find(wall);
  else if (!keeps_tags)
    note = check_tags(wall);
  wall.nodes(mesh).names.assign(tag_of.begin(), tag_of.end());

  bigint both = 0;
  for (int i = 0; i < atom.nlocal; i++)
    both += atom.mask[i] & wall_bit && node_of.count(atom.tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &both, 1, MPI_LMP_BIGINT, MPI_SUM, lmp->world);
  if (both > 0)
    throw InputError(lsdcd::counted(both, "atom is a node", "atoms are nodes") + " of mesh '" +
                     wall.spec().meshes[mesh].name +
                     "' and also in the group of the fix: nodes would touch the triangles whose "
                     "corners they are; give the fix a group without them");
  send(wall, true, kAtRest);
  return note;
}

// Fix move gives its atoms the velocities of the whole step.
int NodeAtoms::bit_of_fix_move() const
{
  int bits = 0;
  for (const Fix *fix : lsdcd::host_fixes(*lmp->modify))
    if (std::strcmp(fix->style, "move") == 0) bits |= fix->groupbit;
  return bits;
}

// Each process looks for a place near each of its atoms, and all put together what they have found.
NodeAtoms::Near NodeAtoms::atoms_near(const std::vector<Vec3> &places, double tolerance) const
{
  const int n = static_cast<int>(places.size());
  std::vector<int> by_x(n);
  std::iota(by_x.begin(), by_x.end(), 0);
  std::sort(by_x.begin(), by_x.end(), [&](int a, int b) { return places[a].x < places[b].x; });
  const Atom &atom = *lmp->atom;
  Near near = {std::vector<double>(n, 0), std::vector<double>(n, 0)};
  for (int i = 0; i < atom.nlocal; i++) {
    if (!(atom.mask[i] & bit)) continue;
    double x[3];
    lmp->domain->unmap(atom.x[i], atom.image[i], x);
    const Vec3 at = {x[0], x[1], x[2]};
    auto k = std::lower_bound(by_x.begin(), by_x.end(), at.x - tolerance,
                              [&](int a, double least) { return places[a].x < least; });
    for (; k != by_x.end() && places[*k].x <= at.x + tolerance; ++k)
      if (lsdcd::norm(places[*k] - at) <= tolerance) {
        near.count[*k]++;
        near.tag[*k] += static_cast<double>(atom.tag[i]);
      }
  }
  MPI_Allreduce(MPI_IN_PLACE, near.count.data(), n, MPI_DOUBLE, MPI_SUM, lmp->world);
  MPI_Allreduce(MPI_IN_PLACE, near.tag.data(), n, MPI_DOUBLE, MPI_SUM, lmp->world);
  return near;
}

void NodeAtoms::find(const lsdcd::Wall &wall)
{
  const std::vector<Vec3> &vertices = wall.meshes()[mesh].mesh()->vertices;
  const double tolerance = tolerance_of(wall.meshes()[mesh]);
  const Near near = atoms_near(vertices, tolerance);
  const lsdcd::MeshSpec &spec = wall.spec().meshes[mesh];
  const int n = static_cast<int>(vertices.size());
  int without = 0, first = -1;
  for (int k = n - 1; k >= 0; k--) {
    if (near.count[k] > 1)
      throw InputError(lsdcd::number_text(near.count[k]) + " atoms of group '" + spec.node_group +
                       "' are at the vertex " + lsdcd::vector_text(vertices[k]) + " of mesh '" +
                       spec.name + "': one of them is its node, remove the others");
    if (near.count[k] > 0) continue;
    without++;
    first = k;
  }
  if (without > 0)
    throw InputError(std::to_string(without) + " of the " + std::to_string(n) +
                     " vertices of mesh '" + spec.name + "' have no atom of group '" +
                     spec.node_group + "' within " + lsdcd::number_text(tolerance) +
                     " (a thousandth of the shortest edge): the first is at " +
                     lsdcd::vector_text(vertices[first]) + "; put an atom at each welded vertex");
  set_tags(near.tag);
}

std::string NodeAtoms::check_tags(lsdcd::Wall &wall)
{
  const lsdcd::MeshPart &part = wall.meshes()[mesh];
  const std::vector<Vec3> &was = part.mesh()->vertices;
  const double tolerance = tolerance_of(part);
  find_local();
  gather(wall, true, kAtRest);
  const int n = static_cast<int>(was.size()), lost_one = lost();
  const double *x = numbers.data();
  bool are_there = lost_one < 0;
  for (int k = 0; k < n && are_there; k++)
    are_there = lsdcd::norm(Vec3{x[3 * k], x[3 * k + 1], x[3 * k + 2]} - was[k]) <= tolerance;
  if (are_there) return "";

  const Near near = atoms_near(was, tolerance);
  if (std::all_of(near.count.begin(), near.count.end(), [](double c) { return c == 1; })) {
    set_tags(near.tag);
    wall.nodes(mesh).names.assign(tag_of.begin(), tag_of.end());
    return "the nodes of mesh '" + part.spec.name +
           "' have different atom IDs than before: the fix has found them where they were";
  }
  const std::string why =
      ". delete_atoms and reset_atom_ids give atoms different IDs, and the fix finds nodes by "
      "their places only where they have not moved since: use delete_atoms with compress no, or "
      "run 0 between "
      "commands that give IDs and commands that move nodes";
  if (lost_one >= 0) fail_lost(wall, lost_one, why);
  if (may_be_others(*part.mesh()))
    throw InputError("the atoms with the IDs of the nodes of mesh '" + part.spec.name +
                     "' are no longer where these were, and edges between them are longer or "
                     "shorter by half: other atoms may have these IDs now" +
                     why + "; move nodes in smaller parts with run 0 between them");
  return "";
}

// Does an edge have another length, as where atoms are those of other nodes? Where nodes were moved together it has not.
bool NodeAtoms::may_be_others(const lsdcd::WeldedMesh &was) const
{
  constexpr double kStretch = 1.5;
  for (const auto &[a, b] : was.edges) {
    const double *x = numbers.data() + 3 * a, *y = numbers.data() + 3 * b;
    const double now = lsdcd::norm(Vec3{x[0] - y[0], x[1] - y[1], x[2] - y[2]}),
                 before = lsdcd::norm(was.vertices[a] - was.vertices[b]);
    if (!(now <= kStretch * before && before <= kStretch * now)) return true;
  }
  return false;
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
//
// Velocities are those of half a step ago, as those of spheres are. An atom that fix move moves has that of the whole step:
// where that is not its way in the step over dt, to rounding, it gets that.
void NodeAtoms::gather(const lsdcd::Wall &wall, bool look, const lsdcd::Step &now)
{
  const Atom &atom = *lmp->atom;
  const std::size_t n = tag_of.size();
  const std::vector<Vec3> *was =
      moved_bit && now.kind == lsdcd::Step::step ? &wall.meshes()[mesh].mesh()->vertices : nullptr;
  numbers.assign((look ? 7 : 6) * n, 0);    // atoms are lost where they are looked for
  for (const Local &of : local) {
    double *x = numbers.data() + 3 * of.node, *v = x + 3 * n;
    lmp->domain->unmap(atom.x[of.atom], atom.image[of.atom], x);
    std::copy_n(atom.v[of.atom], 3, v);
    if (was && atom.mask[of.atom] & moved_bit) {
      const Vec3 &from = (*was)[of.node];
      for (int d = 0; d < 3; d++) {
        const double rounding = 4 * lsdcd::kRoundoff * (std::fabs(x[d]) + std::fabs(from[d]));
        if (std::fabs(x[d] - from[d] - now.dt * v[d]) > rounding) v[d] = (x[d] - from[d]) / now.dt;
      }
    }
    if (look) numbers[6 * n + of.node]++;
  }
  MPI_Allreduce(MPI_IN_PLACE, numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, MPI_SUM,
                lmp->world);
}

// The first node whose tag no atom has, or two; -1: there is none. After atoms were looked for.
int NodeAtoms::lost() const
{
  const std::size_t n = tag_of.size();
  for (std::size_t k = 0; k < n; k++)
    if (numbers[6 * n + k] != 1) return static_cast<int>(k);
  return -1;
}

void NodeAtoms::fail_lost(const lsdcd::Wall &wall, int node, const std::string &why) const
{
  const lsdcd::MeshSpec &spec = wall.spec().meshes[mesh];
  throw InputError("atom " + std::to_string(tag_of[node]) + ", a node of mesh '" + spec.name +
                   "', is " +
                   (numbers[6 * tag_of.size() + node] == 0
                        ? "lost, or no longer in group '" + spec.node_group + "'"
                        : "there more than once") +
                   ": a mesh cannot go on without its nodes" + why);
}

void NodeAtoms::send(lsdcd::Wall &wall, bool look, const lsdcd::Step &now)
{
  if (look) find_local();
  gather(wall, look, now);
  if (const int node = look ? lost() : -1; node >= 0) fail_lost(wall, node);
  wall.set_nodes(mesh, numbers.data(), numbers.data() + 3 * tag_of.size());
}

std::vector<Vec3> NodeAtoms::places(const lsdcd::Wall &wall)
{
  find_local();
  gather(wall, true, {0, 0, lsdcd::Step::setup});    // velocities do not matter
  if (const int node = lost(); node >= 0) fail_lost(wall, node);
  std::vector<Vec3> at;
  for (std::size_t k = 0; k < tag_of.size(); k++)
    at.push_back({numbers[3 * k], numbers[3 * k + 1], numbers[3 * k + 2]});
  return at;
}

void NodeAtoms::add_forces(lsdcd::Wall &wall)
{
  const std::vector<double> &forces = wall.node_forces(mesh);
  double **f = lmp->atom->f;
  for (const Local &of : local)
    for (int d = 0; d < 3; d++) f[of.atom][d] += forces[3 * of.node + d];
}

// Somebody may ask when LAMMPS has given atoms other indices.
double NodeAtoms::power(const std::vector<double> &force)
{
  find_local();
  double sum = 0;
  for (const Local &of : local)
    for (int d = 0; d < 3; d++) sum += force[3 * of.node + d] * lmp->atom->v[of.atom][d];
  return sum;
}
