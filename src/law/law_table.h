// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The laws of a wall whose contacts have other numbers by mesh or by atom type.
#pragma once

#include "law/contact_law.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

// All laws have the same sub-models. Atom types that have the same numbers with every mesh are one kind.
struct LawTable {
  std::vector<ContactLaw> laws;    // of mesh m and kind k at m * kinds + k; empty: there is one law
  int kinds = 1;                   // at least 1
  std::vector<int> kind_of_type;    // of atom type t at min(t, size - 1); empty: all are of kind 0

  bool is_empty() const { return laws.empty(); }
};

// See ContactLaw::pull_off(). `one`: the law where the table is empty.
inline Real largest_pull_off(const ContactLaw &one, const LawTable &table)
{
  Real largest = table.is_empty() ? one.pull_off() : 0;
  for (const ContactLaw &law : table.laws) largest = std::max(largest, law.pull_off());
  return largest;
}

// Where kernels run: which kind a sphere is of.
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
