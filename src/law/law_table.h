// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The laws of a wall, by mesh and by atom type.
#pragma once

#include "law/contact_law.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace lsdcd {

// At least one law; all have the same sub-models. Atom types that have the same numbers with every mesh are
// one kind.
struct LawTable {
  LawTable() = default;    // to be filled
  LawTable(const ContactLaw &law) : laws(1, law) {}

  std::vector<ContactLaw> laws;     // `kinds` laws that all meshes have, or as many of each mesh
  int kinds = 1;                    // at least 1
  std::vector<int> kind_of_type;    // of atom type t at min(t, size - 1); empty: all are of kind 0

  bool is_empty() const { return laws.empty(); }
  // Returns how many laws of `laws` each mesh has; 0: all meshes have the same.
  int of_mesh() const { return static_cast<int>(laws.size()) > kinds ? kinds : 0; }
};

// Returns the longest ContactLaw::reach() of a table.
inline LawReach longest_reach(const LawTable &table)
{
  LawReach reach;
  for (const ContactLaw &law : table.laws) reach = longest(reach, law.reach());
  return reach;
}

// Returns the law of this mesh and kind, both from 0.
inline const ContactLaw &law_of(const LawTable &table, int mesh, int kind)
{
  return table.laws[static_cast<std::size_t>(mesh) * table.of_mesh() + kind];
}

// Returns how far from its centre a sphere can feel the wall.
inline Real cutoff_of(const LawTable &table, Real radius)
{
  return cutoff_of(radius, longest_reach(table));
}

// The kind of each sphere, in kernels.
struct SphereKinds {
  const int *type = nullptr;            // of each sphere; null: all are of kind 0
  const int *kind_of_type = nullptr;    // see LawTable
  int last = -1;                        // index in kind_of_type

  LSDCD_FN int operator[](std::size_t i) const
  {
    if (!type) return 0;
    const int t = type[i];
    return kind_of_type[t < last ? t : last];
  }
};

}    // namespace lsdcd
