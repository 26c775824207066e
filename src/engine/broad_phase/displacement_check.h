// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Stores the positions of spheres and meshes at a candidate search. Its candidates are valid until a sphere that could
// touch a mesh has moved by more than the margin relative to it.
#pragma once

#include "backend/atomic.h"
#include "engine/broad_phase/candidate_test.h"
#include "engine/grains.h"
#include "grid/lookup/brick_words.h"
#include "grid/lookup/occupied_within.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <vector>

namespace lsdcd {

// Returns whether sphere i could touch a mesh and has moved farther than the margin since the last candidate search.
struct HasMoved {
  GridView grid;
  BrickTable table;
  Pose pose, chosen;
  StridedView<const Real> x, was;
  Real margin_sq;
  bool cells_first;

  // Reading the old position costs a GPU more than finding the cell, and a CPU less.
  LSDCD_FN bool operator()(std::size_t i) const
  {
    const Vec3 q = pose.to_mesh(x[i]);
    if (cells_first && !may_touch(q)) return false;
    return !(norm_sq(q - chosen.to_mesh(was[i])) <= margin_sq) && (cells_first || may_touch(q));
  }
  // Returns whether a sphere at q may touch the mesh. True if a coordinate is not a number.
  LSDCD_FN bool may_touch(const Vec3 &q) const
  {
    return occupied_cell(grid, table, q) != kNoCell || !(norm_sq(q) >= 0);
  }
};

struct FlagMoved {
  HasMoved test;
  int *flag;

  LSDCD_FN void operator()(std::size_t i) const
  {
    if (test(i)) set_flag(flag);
  }
};

// Returns whether a number of a[0, n) differs from that in the same place of b by `most` or more. True if one of them is
// not a number. Written without a branch, so that compilers process several numbers at once: the sign of |a - b| - most
// decides, and it is clear if the result is not a number, because fabs() clears it.
inline bool any_differs(const Real *a, const Real *b, std::size_t n, Real most)
{
  std::uint64_t all = ~std::uint64_t(0);
  for (std::size_t k = 0; k < n; k++) {
    const Real past = std::fabs(a[k] - b[k]) - most;
    std::uint64_t bits;
    static_assert(sizeof past == sizeof bits, "a double has the sign in bit 63");
    std::memcpy(&bits, &past, sizeof bits);
    all &= bits;
  }
  return !(all >> 63);
}

template <class B>
class DisplacementCheck {
 public:
  // Stores the positions of spheres and the poses of meshes. has_moved() later returns whether a sphere that could touch a
  // mesh at that later time has moved by more than `margin` (length) relative to that mesh since now.
  void store(B &b, const Spheres &spheres, std::vector<EngineMesh<B>> &meshes, Real margin)
  {
    const std::size_t n = spheres.n;
    x_.reserve(3 * n);
    const StridedView<Real> to(x_.data());
    const StridedView<const Real> x = spheres.x;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to.put(i, x[i]); });
    for (EngineMesh<B> &mesh : meshes) mesh.chosen = mesh.pose;
    margin_ = margin;
  }

  bool has_moved(B &b, const Spheres &spheres, const std::vector<EngineMesh<B>> &meshes)
  {
    const StridedView<Real> was(x_.data());
    std::vector<HasMoved> tests;
    bool stay = true;
    for (const EngineMesh<B> &mesh : meshes) {
      tests.push_back({mesh.grid.view, mesh.grid.table, mesh.pose, mesh.chosen, spheres.x, was,
                       margin_ * margin_, !B::kOnCpu});
      stay = stay && !mesh.pose.placed && !mesh.chosen.placed;
    }
    if constexpr (B::kOnCpu) {
      if (stay) return any_at_meshes_that_stay(b, spheres, tests);
    }
    for (const HasMoved &test : tests)
      if (holds_for_any(b, spheres.n, test)) return true;
    return false;
  }

  std::size_t bytes() const { return x_.size() * sizeof(Real); }

 private:
  bool holds_for_any(B &b, std::size_t n, const HasMoved &test)
  {
    int *flag = flag_.data();    // kernels write to this memory of the CPU
    *flag = 0;
    b.for_each(n, FlagMoved{test, flag});
    b.wait();
    return *flag;
  }

  // Does the work of holds_for_any() on a CPU for meshes that stay where they are. It tests every sphere in every step, so
  // it has to be cheap for nearly all of them: a block in which no coordinate has changed by margin / sqrt(3) needs only
  // one comparison for each coordinate. A sphere that has moved farther, and cannot touch a mesh within the margin of where
  // it is, is compared with its present position from now on: until it has moved by the margin from there, it cannot touch
  // a mesh.
  bool any_at_meshes_that_stay(B &b, const Spheres &spheres, const std::vector<HasMoved> &tests)
  {
    constexpr std::size_t kBlock = 128;
    constexpr Real kEach = 0.577;    // below 1 / sqrt(3) = 0.57735
    const Real near = kEach * margin_;
    const StridedView<const Real> x = spheres.x;
    const StridedView<Real> was(x_.data());
    const bool is_packed = x.row == 3 && x.column == 1;
    int *flag = flag_.data();
    *flag = 0;
    const std::size_t n = spheres.n;
    b.for_each((n + kBlock - 1) / kBlock, [&](std::size_t block) {
      const std::size_t first = block * kBlock, end = std::min(first + kBlock, n);
      if (is_packed && !any_differs(x.of(first), was.of(first), 3 * (end - first), near)) return;
      for (std::size_t i = first; i < end; i++) {
        const Vec3 at = x[i];
        if (norm_sq(at - was[i]) <= near * near) continue;
        const auto within_reach = [&](const HasMoved &t) {
          return t.may_touch(at) || occupied_within(t.grid, t.table, at, margin_);
        };
        if (std::none_of(tests.begin(), tests.end(), within_reach))
          was.put(i, at);
        else if (std::any_of(tests.begin(), tests.end(), [&](const HasMoved &t) { return t(i); }))
          set_flag(flag);
      }
    });
    return *flag;
  }

  using Array = typename B::template Array<Real>;

  Array x_;
  Real margin_ = 0;
  typename B::template CpuArray<int> flag_ = typename B::template CpuArray<int>(1);
};

}    // namespace lsdcd
