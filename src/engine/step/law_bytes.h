// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The parameters of any law, as bytes, and a table of these where kernels run.
#pragma once

#include "law/law_table.h"

#include <cstddef>
#include <cstring>
#include <new>
#include <type_traits>

namespace lsdcd {

class LawBytes {
 public:
  LawBytes() = default;    // of no law
  template <class Law>
  explicit LawBytes(const Law &law)
  {
    static_assert(std::is_trivially_copyable<Law>::value && sizeof(Law) <= sizeof bytes_,
                  "laws are plain numbers");
    ::new (bytes_) Law(law);
  }
  template <class Law>
  const Law &as() const
  {
    return *std::launder(reinterpret_cast<const Law *>(bytes_));
  }
  // The same in a kernel, which has no launder.
  template <class Law>
  LSDCD_FN const Law &in_kernel() const
  {
    return *reinterpret_cast<const Law *>(bytes_);
  }

 private:
  alignas(std::max_align_t) unsigned char bytes_[256];
};

// One law of a table.
struct LawEntry {
  LawBytes law;
  Real pull_off;    // see ContactLaw::pull_off()
};

// The law of each mesh and kind of sphere. Where a wall has one law, all indices are 0.
struct LawsView {
  const LawEntry *entries = nullptr;
  int of_mesh = 0;    // entries of a mesh
  SphereKinds kind;

  LSDCD_FN const LawEntry &of(int mesh, int of_kind) const
  {
    return entries[mesh * of_mesh + of_kind];
  }
};

}    // namespace lsdcd
