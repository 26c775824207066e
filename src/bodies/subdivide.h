// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A body's triangles in pieces, by longest-edge bisection (section 3.7 of the paper).
#pragma once

#include "geometry/triangles_meet.h"

#include <cstdint>

namespace lsdcd {

// The ball around a piece, which the search uses.
struct Piece {
  Vec3 centre;               // the piece's centroid, in the body's frame
  float radius;              // no corner is farther, in units of the longest edge allowed
  std::uint32_t triangle;    // of the body
};

// Longest-edge bisection halves lengths within a few levels, so that this is enough for edges of
// 2^24 cells.
constexpr int kMaxBisections = 64;

LSDCD_FN Real longest_edge_sq(const Triangle &t, int &longest)
{
  Real most = -1;
  for (int k = 0; k < 3; k++) {
    const Real length_sq = norm_sq(t[(k + 1) % 3] - t[k]);
    if (length_sq > most) {
      most = length_sq;
      longest = k;
    }
  }
  return most;
}

// Calls visit(piece) for the pieces of a triangle, none with an edge above `longest`. False: bisection
// does not end because numbers have too few digits, and some pieces are missing.
template <class Visit>
LSDCD_FN bool for_each_piece(const Triangle &whole, Real longest, const Visit &visit)
{
  Triangle waiting[kMaxBisections];
  int n = 0;
  waiting[n++] = whole;
  while (n > 0) {
    const Triangle t = waiting[--n];
    int k = 0;
    if (longest_edge_sq(t, k) <= longest * longest) {
      visit(t);
      continue;
    }
    if (n + 2 > kMaxBisections) return false;
    const Vec3 a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], middle = Real(0.5) * (a + b);
    waiting[n++] = {{middle, b, c}};
    waiting[n++] = {{a, middle, c}};
  }
  return true;
}

// If edges are at most h, the radius is at most 2 h / 3: the squared distance of the corner
// opposite of an edge a from the centroid is (2 b^2 + 2 c^2 - a^2) / 9.
LSDCD_FN Piece piece_of(const Triangle &t, std::uint32_t triangle, Real longest)
{
  Piece piece;
  piece.centre = (Real(1) / 3) * (t[0] + t[1] + t[2]);
  Real radius_sq = 0;
  for (int k = 0; k < 3; k++) radius_sq = fmax(radius_sq, norm_sq(t[k] - piece.centre));
  // One part in 1e6 more for rounding to float and for the stretch of a pose's rotation; never 0.
  constexpr Real kLeast = 1e-30;
  piece.radius = static_cast<float>(fmax(kLeast, sqrt(radius_sq) / longest * (1 + Real(1e-6))));
  piece.triangle = triangle;
  return piece;
}

}    // namespace lsdcd
