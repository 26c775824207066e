// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The bodies of compute lsdcd/collide: which atoms they have, and where these put them.

#include "lammps/compute_collide_lsdcd.h"

#include "base/byte_order_mark.h"
#include "base/file_kind.h"
#include "base/input_error.h"
#include "base/input_words.h"

#include "lammps/mpi_host.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>

using namespace LAMMPS_NS;
using lsdcd::InputError;
using lsdcd::PosePoints;
using lsdcd::Vec3;

static Vec3 unwrapped(const Atom &atom, Domain &domain, int i)
{
  double x[3];
  domain.unmap(atom.x[i], atom.image[i], x);
  return {x[0], x[1], x[2]};
}

std::string ComputeCollideLsdcd::name_of(int body) const
{
  return settings.molecules ? "the body of molecule " + std::to_string(bodies[body].molecule)
                            : std::string("the body of all atoms of the group");
}

// The atoms of the group, on every process, by molecule and tag.
std::vector<ComputeCollideLsdcd::Member> ComputeCollideLsdcd::gather_members() const
{
  std::vector<Member> mine;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      mine.push_back(
          {settings.molecules ? atom->molecule[i] : 0, atom->tag[i], unwrapped(*atom, *domain, i)});
  double n_all = static_cast<double>(mine.size());
  MPI_Allreduce(MPI_IN_PLACE, &n_all, 1, MPI_DOUBLE, MPI_SUM, world);
  constexpr double kMax = 2e9 / sizeof(Member);
  if (n_all == 0) throw InputError("the group has no atoms: create them before the compute");
  if (n_all > kMax)
    throw InputError("the group has " + lsdcd::number_text(n_all) + " atoms, more than " +
                     lsdcd::number_text(kMax) + ": use several groups");
  int bytes = static_cast<int>(mine.size() * sizeof(Member));
  std::vector<int> sizes(comm->nprocs), begins(comm->nprocs, 0);
  MPI_Allgather(&bytes, 1, MPI_INT, sizes.data(), 1, MPI_INT, world);
  for (int p = 1; p < comm->nprocs; p++) begins[p] = begins[p - 1] + sizes[p - 1];
  std::vector<Member> all(static_cast<std::size_t>(n_all));
  MPI_Allgatherv(mine.data(), bytes, MPI_BYTE, all.data(), sizes.data(), begins.data(), MPI_BYTE,
                 world);
  std::sort(all.begin(), all.end(), [](const Member &a, const Member &b) {
    return a.molecule != b.molecule ? a.molecule < b.molecule : a.tag < b.tag;
  });
  return all;
}

std::string ComputeCollideLsdcd::kind_text() const
{
  return settings.atoms_file.empty() ? "the first body as it was defined"
                                     : "the atoms of file " + settings.atoms_file;
}

// x y z a line; empty lines and those from # are left out. The first process reads.
std::vector<Vec3> ComputeCollideLsdcd::read_points() const
{
  const std::string &name = settings.atoms_file;
  std::vector<Vec3> all;
  lsdcd::MpiHost mpi(world);
  lsdcd::run_collectively(mpi, mpi.is_first(), [&] {
    const std::string why = lsdcd::why_no_file(name);
    std::ifstream file(name);
    if (!why.empty() || !file)
      throw InputError("cannot read file " + name + (why.empty() ? "" : ", " + why) +
                       ": give x y z of an atom a line");
    std::string line;
    for (int number = 1; std::getline(file, line); number++) {
      if (number == 1) lsdcd::drop_byte_order_mark(line);
      std::istringstream words(line);
      std::string word;
      Vec3 x = {0, 0, 0};
      int n = 0;
      for (; words >> word && word[0] != '#'; n++)
        if (n > 2 || !lsdcd::is_number(word, &x[n]))
          throw InputError("file " + name + ": line " + std::to_string(number) + " has '" + word +
                           "'; give x y z of an atom a line");
      if (n == 1 || n == 2)
        throw InputError("file " + name + ": line " + std::to_string(number) + " has " +
                         lsdcd::counted(n, "number") + "; give x y z of an atom a line");
      if (n == 3) all.push_back(x);
    }
  });
  int n = static_cast<int>(all.size());
  mpi.broadcast(&n, sizeof n, 0);
  all.resize(n);
  mpi.broadcast(all.data(), n * sizeof(Vec3), 0);
  return all;
}

// The first body's atoms, or those of a file, are the points by which all are placed, in the order of
// their tags.
void ComputeCollideLsdcd::find_bodies()
{
  if (!atom->tag_enable)
    throw InputError("bodies need atoms with IDs: leave out atom_modify id no");
  if (settings.molecules && !atom->molecule_flag)
    throw InputError("bodies molecule needs atoms with molecule IDs: add fix property/atom mol, or "
                     "use an atom style that has them");
  const std::vector<Member> all = gather_members();
  if (settings.molecules && all.front().molecule <= 0)
    throw InputError("atom " + std::to_string(all.front().tag) +
                     " of the group is in no molecule: leave it out, or use bodies one");
  std::vector<int> sizes;
  for (const Member &m : all) {
    if (bodies.empty() || m.molecule != bodies.back().molecule) {
      bodies.push_back({m.molecule, m.x});
      sizes.push_back(0);
    }
    body_point_of[m.tag] = {static_cast<int>(bodies.size()) - 1, sizes.back()++};
  }
  std::vector<Vec3> first;
  if (settings.atoms_file.empty())
    for (int k = 0; k < sizes[0]; k++) first.push_back(all[k].x);
  else
    first = read_points();
  try {
    points = std::make_unique<PosePoints>(first);
  } catch (const InputError &e) {
    throw InputError(kind_text() + ": " + e.what());
  }
  if (first.size() != static_cast<std::size_t>(sizes[0]))
    throw InputError("file " + settings.atoms_file + " has " + std::to_string(first.size()) +
                     " atoms, and " + name_of(0) + " has " + std::to_string(sizes[0]));
  for (std::size_t b = 0; b < bodies.size(); b++)
    if (sizes[b] != sizes[0])
      throw InputError(name_of(static_cast<int>(b)) + " has " + std::to_string(sizes[b]) +
                       " atoms, and " + name_of(0) + " " + std::to_string(sizes[0]) +
                       ": bodies of one compute are copies of the first; use a compute for each "
                       "kind, with groups");
  // The others are where rigid motions put them.
  const std::vector<double> sums = gather_sums();
  for (std::size_t b = 0; b < bodies.size(); b++) pose_of(static_cast<int>(b), sums);
}

// The sums of all bodies, on every process.
std::vector<double> ComputeCollideLsdcd::gather_sums() const
{
  std::vector<double> sums(PosePoints::kSums * bodies.size(), 0.0);
  for (int i = 0; i < atom->nlocal; i++) {
    const auto place = body_point_of.find(atom->tag[i]);
    if (place == body_point_of.end()) continue;
    const auto [body, point] = place->second;
    points->add(point, unwrapped(*atom, *domain, i), bodies[body].near,
                &sums[PosePoints::kSums * body]);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), static_cast<int>(sums.size()), MPI_DOUBLE, MPI_SUM,
                world);
  return sums;
}

lsdcd::BodyPose ComputeCollideLsdcd::pose_of(int body, const std::vector<double> &sums) const
{
  const double *mine = &sums[PosePoints::kSums * body];
  if (mine[0] != static_cast<double>(points->size()))
    throw InputError(name_of(body) + " has " + std::to_string(static_cast<long>(mine[0])) +
                     " of its " + std::to_string(points->size()) +
                     " atoms left: define the compute again");
  double off = 0;
  const lsdcd::BodyPose pose = points->fit(mine, bodies[body].near, off);
  constexpr double kRigid = 1e-3;    // of its size
  if (!(off <= kRigid * points->radius())) {
    char text[64];
    std::snprintf(text, sizeof text, "%.3g", off);
    throw InputError(name_of(body) + " is not a rigid copy of " + kind_text() + ": its atoms are " +
                     text +
                     " off, root mean square; they must move as one, by fix rigid, rigid/small or "
                     "move, and have their tags in one order");
  }
  return pose;
}
