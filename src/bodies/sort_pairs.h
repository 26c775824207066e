// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs in order, in a backend's memory.
#pragma once

#include "bodies/body_collision.h"

#include <algorithm>

namespace lsdcd {

// Sorts by triangle, then by primitive of the wall.
template <class B>
void sort_pairs(B &backend, BodyPair *pairs, std::size_t n, std::uint32_t largest_triangle,
                std::uint32_t largest_wall)
{
  if constexpr (B::kOnCpu) {
    std::sort(pairs, pairs + n);
  } else {
    // The second sort is stable, so that the order of the first remains.
    using Numbers = typename B::template Scratch<std::uint32_t>;
    Numbers triangles(n), walls(n);
    std::uint32_t *triangle = triangles.data(), *wall = walls.data();
    backend.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      triangle[i] = pairs[i].triangle;
      wall[i] = pairs[i].wall;
    });
    backend.sort_pairs(walls, triangles, largest_wall);
    backend.sort_pairs(triangles, walls, largest_triangle);
    triangle = triangles.data(), wall = walls.data();
    backend.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { pairs[i] = {triangle[i], wall[i]}; });
  }
}

}    // namespace lsdcd
