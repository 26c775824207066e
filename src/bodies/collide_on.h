// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The body against the wall on one backend: one source for all.
#pragma once

#include "backend/atomic.h"
#include "base/input_error.h"
#include "base/input_words.h"
#include "bodies/check_body.h"
#include "bodies/exact_pairs.h"
#include "bodies/piece_candidates.h"
#include "bodies/piece_group.h"
#include "bodies/sort_pairs.h"
#include "bodies/subdivide.h"
#include "grid/lookup/grid_on.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {

template <class B>
class BodyCollisionOn : public BodyCollision {
  template <class T>
  using Array = typename B::template Array<T>;
  template <class T>
  using Scratch = typename B::template Scratch<T>;
  template <class T>
  using CpuArray = typename B::template CpuArray<T>;

 public:
  explicit BodyCollisionOn(B backend) : b_(std::move(backend)) {}

  void set_wall(const BodyGrid &grid) override
  {
    if (grid.wall.images.any()) throw InputError("a body needs a wall without periodic images");
    shared_ = std::make_shared<GridOn<B>>(b_, FlatGrid(grid));
    grid_ = shared_->view;
    const auto corners = std::make_shared<MeshFeatures>();
    corners->vertices = grid.wall.vertices;
    corners->face_vertex = grid.wall.face_vertex;
    corners->edge_vertex = grid.wall.edge_vertex;
    wall_ = corners;
    largest_code_ = 0;
    for (const FeatureCode code : grid.wall.primitives)
      largest_code_ = std::max(largest_code_, code);
    pieces_ = Array<Piece>();    // of another wall's cells
  }

  void set_body(const TriangleSoup &body) override
  {
    if (grid_.length <= 0) throw InputError("a body needs a wall first: call set_wall()");
    const Real longest = longest_edge();
    check_body(body, longest);
    pieces_ = Array<Piece>();    // no body if this throws
    n_triangles_ = body.n_triangles();
    body_ = body.corners;
    corners_ = from_cpu(b_, body.corners);
    size_ = 0;
    for (const Vec3 &x : body.corners) size_ = std::max(size_, norm(x));
    cut(longest, body.source);
    unit_ = longest;
  }

  std::unique_ptr<BodyCollision> with_same_wall() const override
  {
    auto other = std::make_unique<BodyCollisionOn>(B());
    other->shared_ = shared_;
    other->wall_ = wall_;
    other->grid_ = grid_;
    other->largest_code_ = largest_code_;
    return other;
  }

  std::size_t n_pieces() const override { return pieces_.size(); }
  bool on_cuda() const override { return !B::kOnCpu; }
  std::string device() const override { return b_.name(); }

  Collision collide(const BodyPose &pose, bool with_segments) override
  {
    check(pose);
    find(pose);
    const std::size_t n = tally_.data()[kMet];
    order(pose, n, with_segments);
    Collision out;
    out.uncertain = tally_.data()[kCutShort];
    for (std::size_t i = 0; i < n; i++) {
      const BodyPair &pair = pairs_.data()[i];
      if (!out.pairs.empty() && out.pairs.back() == pair) continue;    // of another piece
      out.pairs.push_back(pair);
      if (with_segments) out.segments.push_back(segments_.data()[i]);
    }
    if (tally_.data()[kUnsure] > 0) add_exact(pose, with_segments, out);
    return out;
  }

  // Public because nvcc takes no device lambda from a private function.

  void cut(Real longest, const std::string &source)
  {
    const Vec3 *corners = corners_.data();
    Scratch<std::uint64_t> first(n_triangles_ + 1), deep(1);
    const std::uint64_t none = 0;
    b_.copy_in(&none, deep.data(), 1);
    std::uint64_t *at = first.data(), *too_deep = deep.data();
    const std::size_t n_triangles = n_triangles_;
    const BodyPose here;
    b_.for_each(n_triangles + 1, [=] LSDCD_LAMBDA(std::size_t t) {
      std::uint64_t n = 0;
      if (t < n_triangles &&
          !for_each_piece(body_triangle(corners, t, here), longest, [&](const Triangle &) { n++; }))
        raise_to(too_deep, t + 1);
      at[t] = n;
    });
    const std::uint64_t n = b_.exclusive_scan(at, n_triangles + 1);
    if (const std::uint64_t t = read_one(b_, deep.data()))
      throw InputError(source + ", triangle " + std::to_string(t) +
                       " cannot be cut down to cells of " + number_text(longest) +
                       ": use longer ones");
    if (n > kMaxPieces) throw_too_many_pieces(source, Real(n));
    pieces_ = Array<Piece>(n);
    Piece *pieces = pieces_.data();
    b_.for_each(n_triangles, [=] LSDCD_LAMBDA(std::size_t t) {
      std::uint64_t to = at[t];
      const auto number = static_cast<std::uint32_t>(t);
      for_each_piece(body_triangle(corners, number, here), longest, [&](const Triangle &piece) {
        pieces[to++] = piece_of(piece, number, longest);
      });
    });
    groups_ = Array<PieceGroup>((n + kPiecesOfGroup - 1) / kPiecesOfGroup);
    group_has_candidates_ = Array<char>(groups_.size());
    PieceGroup *groups = groups_.data();
    b_.for_each(groups_.size(), [=] LSDCD_LAMBDA(std::size_t g) {
      const std::size_t begin = g * kPiecesOfGroup, end = begin + kPiecesOfGroup;
      groups[g] = group_of(pieces, begin, end < n ? end : n);
    });
    grow_pairs(kFirstRoom);
    b_.wait();
  }

  // Puts the pairs that meet into met_, in any order and some more than once, and their number into
  // tally_. If the room is too small, it grows and all is done again.
  void find(const BodyPose &pose)
  {
    for (;;) {
      find_candidates(pose);
      test_candidates(pose);
      b_.copy_out(counts_.data(), tally_.data(), kCounts);
      b_.wait();
      const std::uint64_t n = tally_.data()[kCandidates];
      if (n <= candidates_.size()) return;
      if (n > kMaxPairs)
        throw InputError("the body is near the wall in " + std::to_string(n) +
                         " pairs, more than fit: use shorter cells");
      grow_pairs(n);
    }
  }

  // Puts the primitives of the wall that each piece may meet into candidates_, as many as fit.
  void find_candidates(const BodyPose &pose)
  {
    const GridView grid = grid_;
    const Piece *pieces = pieces_.data();
    const PieceGroup *groups = groups_.data();
    char *group_has_candidates = group_has_candidates_.data();
    const Real unit = unit_, more = slack(pose) + grid_.tolerance;
    std::uint64_t *counts = counts_.data();
    BodyPair *candidates = candidates_.data();
    const std::uint64_t room = candidates_.size();
    b_.for_each(groups_.size(), [=] LSDCD_LAMBDA(std::size_t g) {
      if (g == 0)
        for (int k = 0; k < kCounts; k++) counts[k] = 0;
      const PieceGroup group = groups[g];
      group_has_candidates[g] =
          any_brick_within(grid, pose.corner_at(group.centre), group.radius + more);
    });
    const auto search = [=] LSDCD_LAMBDA(std::size_t i) {
      const Piece piece = pieces[i];
      const bool cut_short = for_each_candidate(
          grid, pose.corner_at(piece.centre), unit * piece.radius + more, [&](FeatureCode code) {
            if (is_of_piece_before(grid, pieces, i, pose, unit, code)) return;
            const std::uint64_t to = fetch_add_one(counts + kCandidates);
            if (to < room) candidates[to] = {piece.triangle, code};
          });
      if (cut_short) count_one(counts + kCutShort);
    };
    const std::size_t n = pieces_.size();
    if constexpr (B::kOnCpu)
      b_.for_each(groups_.size(), [=](std::size_t g) {
        if (!group_has_candidates[g]) return;
        const std::size_t end = (g + 1) * kPiecesOfGroup;
        for (std::size_t i = g * kPiecesOfGroup; i < n && i < end; i++) search(i);
      });
    else
      b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
        if (group_has_candidates[i / kPiecesOfGroup]) search(i);
      });
  }

  // Tests each by rounded signs: those that meet go into met_, those for which rounded signs do not
  // decide into unsure_.
  void test_candidates(const BodyPose &pose)
  {
    const MeshFeaturesView wall = grid_.wall;
    const Vec3 *corners = corners_.data();
    std::uint64_t *counts = counts_.data();
    const BodyPair *candidates = candidates_.data();
    BodyPair *met = met_.data(), *unsure = unsure_.data();
    std::size_t most = candidates_.size();    // how many there are is known where kernels run
    if constexpr (B::kOnCpu) most = std::min<std::size_t>(most, counts[kCandidates]);
    b_.for_each(
        most,
        [=] LSDCD_LAMBDA(std::size_t i) {
          if (i >= counts[kCandidates]) return;
          const BodyPair pair = candidates[i];
          const int meet = triangles_meet_rounded(body_triangle(corners, pair.triangle, pose),
                                                  wall_triangle(wall, pair.wall));
          if (meet > 0) met[fetch_add_one(counts + kMet)] = pair;
          if (meet == 0) unsure[fetch_add_one(counts + kUnsure)] = pair;
        },
        64);
  }

  // Puts the first n of met_ into pairs_, ascending, with their segments.
  void order(const BodyPose &pose, std::size_t n, bool with_segments)
  {
    if (n == 0) return;
    grow(pairs_, n);
    sort_pairs(b_, met_.data(), n, static_cast<std::uint32_t>(n_triangles_), largest_code_);
    b_.copy_out(met_.data(), pairs_.data(), n);
    if (with_segments) {
      grow(found_, n);
      grow(segments_, n);
      const MeshFeaturesView wall = grid_.wall;
      const Vec3 *corners = corners_.data();
      const BodyPair *met = met_.data();
      MeetingSegment *found = found_.data();
      b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
        found[i] = meeting_segment<triangles_meet_detail::RoundedSign>(
            body_triangle(corners, met[i].triangle, pose), wall_triangle(wall, met[i].wall));
      });
      b_.copy_out(found_.data(), segments_.data(), n);
    }
    b_.wait();
  }

  void add_exact(const BodyPose &pose, bool with_segments, Collision &out)
  {
    const std::size_t n = tally_.data()[kUnsure];
    grow(unsure_pairs_, n);
    b_.copy_out(unsure_.data(), unsure_pairs_.data(), n);
    b_.wait();
    add_exact_pairs(wall_->view(), body_.data(), pose, unsure_pairs_.data(), n, with_segments, out);
  }

  void grow_pairs(std::size_t n)
  {
    for (Array<BodyPair> *pairs : {&candidates_, &met_, &unsure_}) grow(*pairs, n);
  }
  // Grows to n and a quarter more; the contents are lost.
  template <class A>
  static void grow(A &array, std::size_t n)
  {
    if (array.size() >= n) return;
    array = A();
    array = A(n + n / 4);
  }

 private:
  static constexpr std::uint64_t kMaxPairs = std::uint64_t(1) << 28;    // candidates of a pose
  static constexpr std::size_t kFirstRoom = 1 << 16;
  enum { kCandidates, kMet, kUnsure, kCutShort, kCounts };    // of a pose: pairs, and last pieces

  // 2 / 3 of the longest edge (subdivide.h), and what piece_of() adds to it.
  static constexpr Real kMaxRadius = (2. / 3) * (1 + 2e-6);
  // Returns the longest edge of pieces: a cell, or what the cutoff allows, a little less for rounding.
  Real longest_edge() const
  {
    return std::min(grid_.length, grid_.cutoff / (kMaxRadius * (1 + Real(1e-4))));
  }
  Real slack(const BodyPose &pose) const
  {
    return 128 * kRoundoff * (2 * size_ + norm(pose.shift));
  }

  void check(const BodyPose &pose) const
  {
    if (pieces_.size() == 0) throw InputError("there is no body: call set_body()");
    check_rotation(pose);
    if (!(kMaxRadius * unit_ + slack(pose) + grid_.tolerance <= grid_.cutoff))
      throw InputError("the body is so far from the origin, or so large, that rounding errors of "
                       "its corners are too large for cells of " +
                       number_text(grid_.length) + ": move wall and body nearer to the origin");
  }

  B b_;
  std::shared_ptr<const GridOn<B>> shared_;
  GridView grid_ = {};
  // Wall and body on the CPU, for exact signs: corners of the wall's primitives, and the body's.
  std::shared_ptr<const MeshFeatures> wall_;
  std::vector<Vec3> body_;
  Array<Vec3> corners_;
  std::size_t n_triangles_ = 0;
  Array<Piece> pieces_;
  Array<PieceGroup> groups_;
  Array<char> group_has_candidates_;
  Real size_ = 0, unit_ = 0;    // of the body about its origin; a piece's longest edge
  std::uint32_t largest_code_ = 0;

  // Counts of the last pose; `tally_` is a copy of `counts_`.
  Array<std::uint64_t> counts_ = Array<std::uint64_t>(kCounts);
  CpuArray<std::uint64_t> tally_ = CpuArray<std::uint64_t>(kCounts);
  Array<BodyPair> candidates_, met_, unsure_;
  CpuArray<BodyPair> pairs_, unsure_pairs_;
  Array<MeetingSegment> found_;
  CpuArray<MeetingSegment> segments_;
};

}    // namespace lsdcd
