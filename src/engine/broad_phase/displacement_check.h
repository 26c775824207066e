// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Positions of spheres and meshes when candidates were chosen. The choice holds until a sphere that could
// touch a mesh has moved by more than the margin relative to it.
#pragma once

#include "backend/atomic.h"
#include "engine/broad_phase/candidate_test.h"
#include "engine/wall_engine.h"
#include "grid/lookup/brick_words.h"

#include <vector>

namespace lsdcd {

// Could sphere i touch a mesh, and has it gone farther than the margin since the choice?
struct HasMoved {
  GridView grid;
  BrickTable table;
  Pose pose, chosen;
  StridedView<const Real> x, was;
  Real margin_sq;
  bool cells_first;

  // Reading where it was costs a GPU more than looking for its cell, and a CPU less.
  LSDCD_FN bool operator()(std::size_t i) const
  {
    const Vec3 q = pose.to_mesh(x[i]);
    if (cells_first && !may_touch(q)) return false;
    return !(norm_sq(q - chosen.to_mesh(was[i])) <= margin_sq) && (cells_first || may_touch(q));
  }
  // A position that is no number may.
  LSDCD_FN bool may_touch(const Vec3 &q) const
  {
    return occupied_cell(grid, table, q) != kNoCell || !(norm_sq(q) >= 0);
  }
};

template <class B>
class DisplacementCheck {
 public:
  // Stores positions of spheres and poses of meshes. has_moved() later asks: has a sphere that could touch a
  // mesh at that time moved by more than `margin` (length) relative to that mesh since now?
  void store(B &b, const Spheres &spheres, std::vector<EngineMesh<B>> &meshes, Real margin)
  {
    const std::size_t n = spheres.n;
    if (x_.size() < 3 * n) x_ = Array(3 * (n + n / 8));
    const StridedView<Real> to(x_.data());
    const StridedView<const Real> x = spheres.x;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to.put(i, x[i]); });
    for (EngineMesh<B> &mesh : meshes) mesh.chosen = mesh.pose;
    margin_ = margin;
  }

  bool has_moved(B &b, const Spheres &spheres, const std::vector<EngineMesh<B>> &meshes)
  {
    const StridedView<const Real> was(x_.data());
    for (const EngineMesh<B> &mesh : meshes) {
      const HasMoved test = {mesh.grid.view,    mesh.grid.table, mesh.pose,
                             mesh.chosen,       spheres.x,       was,
                             margin_ * margin_, !B::kOnHost};
      if (holds_for_any(b, spheres.n, test)) return true;
    }
    return false;
  }

  // Public because nvcc takes no device lambda from a private function.
  bool holds_for_any(B &b, std::size_t n, const HasMoved &test)
  {
    int *flag = flag_.data();    // kernels write this memory of the host
    *flag = 0;
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      if (test(i)) set_flag(flag);
    });
    b.wait();
    return *flag;
  }

  std::size_t bytes() const { return x_.size() * sizeof(Real); }

 private:
  using Array = typename B::template Array<Real>;

  Array x_;
  Real margin_ = 0;
  typename B::template HostArray<int> flag_ = typename B::template HostArray<int>(1);
};

}    // namespace lsdcd
