// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The springs of a process's spheres in memory of the CPU, for the time in which a host moves
// spheres.
#pragma once

#include "base/kept_rows.h"
#include "contact/spring.h"

namespace lsdcd {

// A row is a spring as pack_spring() writes it, followed by the `n_extra` numbers that further effects of the contact law keep
// (most laws have none).
class ContactHistory : public KeptRows {
 public:
  explicit ContactHistory(int n_extra = 0) : KeptRows(kPackedSpring + n_extra) {}

  int n_extra() const { return row_size() - kPackedSpring; }
  Spring spring(int i, int k) const
  {
    Spring s;
    unpack_spring(row(i, k), s);
    return s;
  }
};

}    // namespace lsdcd
