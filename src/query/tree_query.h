// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Queries a mesh by its tree for points at any distance, in the caller's own arrays, on the CPU.
#pragma once

#include "query/point_work.h"
#include "tree/triangle_tree.h"

#include <array>
#include <vector>

namespace lsdcd {

// A bit for each box of a region: may anything be within a cutoff of a point in that box? Points in the other
// boxes need no search.
class CutoffBoxes {
 public:
  CutoffBoxes(const TriangleTree &tree, const WeldedMesh &mesh, Real cutoff,
              const ProgressListener &progress = {});

  bool may_be_within(const Vec3 &q) const
  {
    const Vec3 at = per_length_ * (q - lo_);
    // True also if a coordinate is not a number.
    if (!((at.x >= 0) & (at.y >= 0) & (at.z >= 0) & (at.x < n_) & (at.y < n_) & (at.z < n_)))
      return false;
    const std::size_t i =
        (static_cast<std::size_t>(at.z) * n_ + static_cast<std::size_t>(at.y)) * n_ +
        static_cast<std::size_t>(at.x);
    return bits_[i / 64] >> i % 64 & 1u;
  }
  std::size_t bytes() const { return bits_.size() * sizeof bits_[0]; }

 private:
  void mark(const TriangleTree &tree, Real cutoff, const std::array<int, 3> &at, int size,
            std::uint32_t hint, const ProgressListener &progress);

  Vec3 lo_;
  Real length_, per_length_;    // of a box
  int n_;                       // along each axis, a power of two
  std::vector<std::uint64_t> bits_;
};

// Returns the bytes of both; each may be null.
inline std::size_t bytes_of(const TriangleTree *tree, const CutoffBoxes *boxes)
{
  return (tree ? tree->bytes() : 0) + (boxes ? boxes->bytes() : 0);
}

// Answers points with threads() threads. There is no state, so that any number of threads may call it at the
// same time. Only what is nearer than a point's radius is found; `cutoff` is the largest radius, also that of
// `boxes`, which may be null. Answers everything except the side, which must not be asked for. Throws
// InputError if a radius in `radii` exceeds the cutoff; the answers are then undefined. T: float or double.
template <class T>
void query_tree(const TriangleTree &tree, const CutoffBoxes *boxes, Real cutoff,
                const PointArrays<T> &io);

}    // namespace lsdcd
