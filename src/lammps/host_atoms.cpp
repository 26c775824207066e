// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/host_atoms.h"

#include "host/host.h"

#include "atom.h"
#include "neighbor.h"

#include <set>
#include <utility>
#include <vector>

namespace lsdcd {

std::string shape_of_atoms(const LAMMPS_NS::Atom &atom)
{
  if (atom.line_flag) return "lines";
  if (atom.tri_flag) return "triangles";
  if (atom.body_flag) return "bodies";
  return atom.ellipsoid_flag ? kEllipsoids : "";
}

namespace {

// Atoms with the same type and groups are alike.
using Kinds = std::set<std::pair<int, int>>;

// Of the atoms of a group, on the first process.
Kinds kinds_of(const LAMMPS_NS::Atom &atom, int group_bit, Host &host)
{
  Kinds mine;
  for (int i = 0; i < atom.nlocal; i++)
    if (atom.mask[i] & group_bit) mine.insert({atom.type[i], atom.mask[i]});
  std::vector<double> numbers;
  for (const auto &kind : mine)
    numbers.insert(numbers.end(), {double(kind.first), double(kind.second)});
  const std::vector<double> gathered = host.gather(numbers);
  Kinds all;
  for (std::size_t k = 0; k < gathered.size(); k += 2)
    all.insert({static_cast<int>(gathered[k]), static_cast<int>(gathered[k + 1])});
  return all;
}

bool is_excluded(const LAMMPS_NS::Neighbor &neighbor, const Kinds::value_type &a,
                 const Kinds::value_type &b)
{
  if (neighbor.nex_type > 0 && neighbor.ex_type[a.first][b.first]) return true;
  for (int k = 0; k < neighbor.nex_group; k++) {
    const int one = neighbor.ex1_bit[k], other = neighbor.ex2_bit[k];
    if ((a.second & one && b.second & other) || (a.second & other && b.second & one)) return true;
  }
  for (int k = 0; k < neighbor.nex_mol; k++)
    if (!neighbor.ex_mol_intra[k] && a.second & b.second & neighbor.ex_mol_bit[k]) return true;
  return false;
}

}    // namespace

bool pairs_act_between(const LAMMPS_NS::Neighbor &neighbor, const LAMMPS_NS::Atom &atom,
                       int group_bit, int other_bit, Host &host)
{
  const Kinds ours = kinds_of(atom, group_bit, host), others = kinds_of(atom, other_bit, host);
  Real any = 0;
  for (const auto &a : ours)
    for (const auto &b : others)
      if (!is_excluded(neighbor, a, b)) any = 1;
  host.max(&any, 1);
  return any > 0;
}

}    // namespace lsdcd
