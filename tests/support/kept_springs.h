// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The springs that a sphere has in a history, for tests that compare or make them.
#pragma once

#include "contact/contact_history.h"

#include <vector>

namespace lsdcd {

inline std::vector<Spring> springs_of(const ContactHistory &history, int i)
{
  std::vector<Spring> all;
  for (int k = 0; k < history.count(i); k++) all.push_back(history.spring(i, k));
  return all;
}

// Returns the further numbers of all springs, one spring after the other.
inline std::vector<Real> extra_of(const ContactHistory &history, int i)
{
  std::vector<Real> all;
  for (int k = 0; k < history.count(i); k++)
    all.insert(all.end(), history.row(i, k) + kPackedSpring,
               history.row(i, k) + history.row_size());
  return all;
}

// Replaces what sphere i has.
inline void give_springs(ContactHistory &history, int i, const std::vector<Spring> &springs,
                         const std::vector<Real> &extra = {})
{
  const int n_extra = history.n_extra();
  history.clear(i);
  Real *to = history.add(i, static_cast<int>(springs.size()));
  for (std::size_t k = 0; k < springs.size(); k++) {
    to = pack_spring(springs[k], to);
    for (int e = 0; e < n_extra; e++) *to++ = extra[k * n_extra + e];
  }
}

}    // namespace lsdcd
