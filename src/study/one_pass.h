// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A query as one loop over all spheres.
#pragma once

#include "base/real.h"

#include <cstddef>

namespace lsdcd {

// One way to run a query: reserve() allocates memory for n spheres S, run() answers them.
// This one needs no memory.
struct OnePass {
  template <class S>
  void reserve(std::size_t)
  {
  }

  template <class B, class Work>
  void run(B &b, std::size_t n, const Work &work)
  {
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { work.answer(i, work.sphere(i)); });
  }
};

}    // namespace lsdcd
