// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/tree_query.h"

#include "backend/backend_cpu.h"
#include "base/curve.h"
#include "query/radius_error.h"
#include "query/tree_answers.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {

// ---- far points ---------------------------------------------------------------------------------

CutoffBoxes::CutoffBoxes(const TriangleTree &tree, const WeldedMesh &mesh, Real cutoff,
                         const ProgressListener &progress)
{
  // As many boxes as are made in a part of the time of the tree.
  n_ = 32;
  while (n_ < 128 && std::size_t(n_) * n_ * 16 < tree.n_primitives()) n_ *= 2;
  const Vec3 lo = mesh.report.lo, size = mesh.report.hi - lo;
  // A little more than the cutoff, for rounding.
  const Real pad = cutoff + Real(1e-6) * (cutoff + norm(size));
  lo_ = lo - Vec3{pad, pad, pad};
  length_ = (std::fmax(size.x, std::fmax(size.y, size.z)) + 2 * pad) / n_;
  per_length_ = 1 / length_;
  bits_.resize(std::size_t(n_) * n_ * n_ / 64);
  mark(tree, pad, {0, 0, 0}, n_, kNoPrimitive, progress);
}

// Marks the boxes of a larger box, `size` along each axis, that may be within the cutoff. It halves the box along each axis, and
// leaves out parts that are far.
void CutoffBoxes::mark(const TriangleTree &tree, Real cutoff, const std::array<int, 3> &at,
                       int size, std::uint32_t hint, const ProgressListener &progress)
{
  const Real half = Real(0.5) * size * length_;
  const Vec3 centre =
      lo_ + Vec3{at[0] * length_ + half, at[1] * length_ + half, at[2] * length_ + half};
  const Real within = cutoff + std::sqrt(Real(3)) * half;
  if (!tree.is_within(centre, within, hint)) return;
  if (size == 1) {
    const std::size_t i = (std::size_t(at[2]) * n_ + at[1]) * n_ + at[0];
    bits_[i / 64] |= std::uint64_t(1) << i % 64;
    return;
  }
  for (int part = 0; part < 8; part++) {
    if (progress && size == n_) progress("boxes near the mesh", part / 8.);
    mark(tree, cutoff,
         {at[0] + (part & 1) * size / 2, at[1] + (part >> 1 & 1) * size / 2,
          at[2] + (part >> 2) * size / 2},
         size / 2, hint, progress);
  }
}

// ---- points -------------------------------------------------------------------------------------

namespace {

// How many points are sorted at once: a few for each triangle, so that the points of a small mesh stay in a
// processor's cache. Fewer than kFewPoints are not sorted, nor are any where the whole mesh stays in the cache.
constexpr std::size_t kChunk = std::size_t(1) << 20, kLeastChunk = std::size_t(1) << 15,
                      kPointsOfTriangle = 4, kFewPoints = 64;
constexpr std::size_t kInCache = std::size_t(1) << 20;    // bytes
constexpr std::size_t kAhead = 8;                         // points whose memory is on its way
constexpr int kCurveBits = 7;                             // an axis

// Sorts numbers of points by keys below 2^21: by digits, so that all counts of a digit
// stay in a processor's cache.
class CurveOrder {
 public:
  explicit CurveOrder(std::size_t most) : key_(most), number_(most), from_(most) {}
  void add(std::uint32_t number, std::uint32_t key)
  {
    from_.data()[n_++] = number;
    key_.data()[number] = key;
  }
  std::size_t size() const { return n_; }
  const std::uint32_t *sort()
  {
    sort_by(0, from_.data(), number_.data());
    sort_by(kDigitBits, number_.data(), from_.data());
    return from_.data();
  }

 private:
  static constexpr int kDigitBits = 11;

  void sort_by(int shift, const std::uint32_t *from, std::uint32_t *to) const
  {
    std::uint32_t start[1 << kDigitBits] = {};
    const auto digit = [&](std::uint32_t i) {
      return key_.data()[i] >> shift & ((1u << kDigitBits) - 1);
    };
    for (std::size_t k = 0; k < n_; k++) start[digit(from[k])]++;
    std::uint32_t before = 0;
    for (std::uint32_t &s : start) before += std::exchange(s, before);
    for (std::size_t k = 0; k < n_; k++) to[start[digit(from[k])]++] = from[k];
  }

  std::size_t n_ = 0;
  CpuBackend::Array<std::uint32_t> key_, number_, from_;
};

template <class T>
class TreeQuery {
 public:
  TreeQuery(const TriangleTree &tree, const CutoffBoxes *boxes, Real cutoff,
            const PointArrays<T> &io) :
      tree_(tree),
      boxes_(boxes),
      io_(io), answers_{tree.view(), io, {static_cast<T>(cutoff), &too_large_}, io.only_distance()}
  {
  }

  void run()
  {
    const std::size_t n = io_.n;
    if (n <= kFewPoints) {
      search_in_turn(0, n, true);
    } else {
      const std::size_t n_threads = static_cast<std::size_t>(threads());
      const std::size_t share = n_threads > 1 ? n / (4 * n_threads) + 1 : n;
      const std::size_t enough = std::max(kLeastChunk, kPointsOfTriangle * tree_.n_primitives()),
                        chunk = std::max(kFewPoints, std::min({kChunk, enough, share}));
      const std::int64_t n_chunks = static_cast<std::int64_t>((n + chunk - 1) / chunk);
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads()) if (n_chunks > 1)
      for (std::int64_t c = 0; c < n_chunks; c++)
        search_along_curve(static_cast<std::size_t>(c) * chunk,
                           std::min(n, (static_cast<std::size_t>(c) + 1) * chunk));
    }
    if (too_large_ != 0)
      throw_bad_radius("point", ~too_large_, io_.radii[~too_large_], answers_.too_large.cutoff);
  }

 private:
  std::uint32_t curve_key(std::size_t i) const
  {
    return number_on_curve(tree_.view().share_of_box(io_.points[i]), kCurveBits);
  }
  // Do most points follow a near one? Checks a few.
  bool are_in_order(std::size_t from, std::size_t to) const
  {
    constexpr int kSteepBits = 12;    // so many bits of a curve are a box of an eighth
    std::size_t looks = 0, jumps = 0;
    const std::size_t step = std::max<std::size_t>(1, (to - from) / 512);
    for (std::size_t i = from; i + 1 < to; i += step, looks++)
      jumps += (curve_key(i) ^ curve_key(i + 1)) >> kSteepBits != 0;
    return jumps <= looks / 8;
  }

  void prefetch(std::size_t i) const
  {
    __builtin_prefetch(io_.points.of(i));
    if (io_.distance.at) __builtin_prefetch(&io_.distance[i], 1);
    asm volatile("");    // else gcc drops calls of a function that only prefetches
  }

  // Along a curve through the mesh's box, so that neighbours read the same triangles, and the answer of one
  // bounds that of the next.
  void search_along_curve(std::size_t from, std::size_t to)
  {
    if (are_in_order(from, to)) return search_in_turn(from, to, true);
    if (tree_.bytes() <= kInCache) return search_in_turn(from, to, false);
    CurveOrder order(to - from);
    for (std::size_t i = from; i < to; i++)
      if (!is_far(i)) order.add(static_cast<std::uint32_t>(i - from), curve_key(i));
    const std::uint32_t *number = order.sort();
    std::uint32_t hint = kNoPrimitive;
    for (std::size_t k = 0; k < order.size(); k++) {
      if (k + kAhead < order.size()) prefetch(from + number[k + kAhead]);
      find_nearest(from + number[k], hint);
    }
  }

  void search_in_turn(std::size_t from, std::size_t to, bool in_order)
  {
    std::uint32_t hint = kNoPrimitive;
    for (std::size_t i = from; i < to; i++) {
      if (is_far(i)) continue;
      find_nearest(i, hint);
      if (!in_order) hint = kNoPrimitive;
    }
  }

  // Writes the answer if nothing can be within the cutoff.
  bool is_far(std::size_t i) const
  {
    answers_.check(i);
    if (!boxes_) return false;
    const Vec3 q = io_.points[i];
    if (boxes_->may_be_within(q)) return false;
    answers_.store(i, q, {kAnyDistance, kNoFeature, kNoPrimitive}, 1);
    return true;
  }
  void find_nearest(std::size_t i, std::uint32_t &hint) const
  {
    const Vec3 q = io_.points[i];
    const Real times = answers_.tree.times_nearer(q);
    const TreeAnswer a = tree_.nearest((1 / times) * q, answers_.radius(i, times), hint);
    hint = a.primitive;
    answers_.store(i, q, a, times);
  }

  const TriangleTree &tree_;
  const CutoffBoxes *boxes_;
  std::uint64_t too_large_ = 0;
  const PointArrays<T> &io_;
  const TreeAnswers<T> answers_;
};

}    // namespace

template <class T>
void query_tree(const TriangleTree &tree, const CutoffBoxes *boxes, Real cutoff,
                const PointArrays<T> &io)
{
  TreeQuery<T>(tree, boxes, cutoff, io).run();
}
template void query_tree(const TriangleTree &, const CutoffBoxes *, Real,
                         const PointArrays<float> &);
template void query_tree(const TriangleTree &, const CutoffBoxes *, Real,
                         const PointArrays<double> &);

}    // namespace lsdcd
