// The body against the wall on one backend: one source for all.
#pragma once

#include "base/input_error.h"
#include "bodies/near_piece.h"
#include "bodies/piece_group.h"
#include "bodies/subdivide.h"
#include "grid/flat_grid.h"
#include "parallel/atomic.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace lsdcd {

template <class B>
class BodyCollisionOn : public BodyCollision {
  template <class T>
  using Array = typename B::template Array<T>;
  template <class T>
  using Scratch = typename B::template Scratch<T>;

 public:
  explicit BodyCollisionOn(B backend) : b_(std::move(backend)) {}

  void set_wall(const TriangleGrid &grid) override
  {
    if (grid.nearest == 0 || grid.in_floats || grid.wall.images.any())
      throw InputError("a body needs a wall's grid with lists of triangles in double, without "
                       "periodic images: build it with collision_grid()");
    const FlatGrid flat(grid);
    const GridView view = flat.view();
    Array<char> block(view.block_bytes);
    b_.copy_in(view.block, block.data(), block.size());
    block_ = std::move(block);
    grid_ = moved_view(view, block_.data());
    corners_ = Array<Vec3>();
    pieces_ = Array<Piece>();
  }

  void set_body(const TriangleSoup &body) override
  {
    if (grid_.length <= 0) throw InputError("a body needs a wall first: call set_wall()");
    const Real longest = longest_edge();
    check_body(body, longest);
    n_triangles_ = body.n_triangles();
    corners_ = b_.from_host(body.corners);
    size_ = 0;
    for (const Vec3 &x : body.corners) size_ = std::max(size_, norm(x));
    cut(longest, body.source);
    unit_ = longest;
  }

  std::size_t n_pieces() const override { return pieces_.size(); }
  std::string device() const override { return b_.name(); }

  Collision collide(const BodyPose &pose, bool with_segments) override
  {
    check(pose);
    Collision out;
    const std::uint64_t n = find_near(pose, out.uncertain);
    if (n == 0) return out;
    if (n > kMost)
      throw InputError("the body is near the wall in " + std::to_string(n) +
                       " pairs, more than fit: use shorter cells");
    Scratch<std::uint32_t> triangle(n), wall(n);
    write_near(pose, triangle.data(), wall.data());
    sort(triangle, wall);
    test(pose, triangle.data(), wall.data(), n, with_segments, out);
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
    if (const std::uint64_t t = read(deep.data()))
      throw InputError(source + ", triangle " + std::to_string(t) +
                       " cannot be cut down to cells of " + std::to_string(longest) +
                       ": use longer ones");
    if (n > kMost) throw_too_many(source, Real(n));
    pieces_ = Array<Piece>(n);
    offset_ = Array<std::uint64_t>(n + 1);
    Piece *pieces = pieces_.data();
    b_.for_each(n_triangles, [=] LSDCD_LAMBDA(std::size_t t) {
      std::uint64_t to = at[t];
      const auto number = static_cast<std::uint32_t>(t);
      for_each_piece(body_triangle(corners, number, here), longest, [&](const Triangle &piece) {
        pieces[to++] = piece_of(piece, number, longest);
      });
    });
    groups_ = Array<PieceGroup>((n + kPiecesOfGroup - 1) / kPiecesOfGroup);
    group_near_ = Array<char>(groups_.size());
    PieceGroup *groups = groups_.data();
    b_.for_each(groups_.size(), [=] LSDCD_LAMBDA(std::size_t g) {
      const std::size_t begin = g * kPiecesOfGroup, end = begin + kPiecesOfGroup;
      groups[g] = group_of(pieces, begin, end < n ? end : n);
    });
    b_.wait();
  }

  // How many primitives of the wall each piece is near: their sums, in offset_; returns all.
  std::uint64_t find_near(const BodyPose &pose, std::uint64_t &uncertain)
  {
    const GridView grid = grid_;
    const Piece *pieces = pieces_.data();
    const std::size_t n = pieces_.size();
    const Real unit = unit_, more = slack(pose) + grid_.tolerance;
    std::uint64_t *offset = offset_.data();
    Scratch<std::uint64_t> counted(1);
    const std::uint64_t none = 0;
    b_.copy_in(&none, counted.data(), 1);
    std::uint64_t *cut_short = counted.data();
    const PieceGroup *groups = groups_.data();
    char *group_near = group_near_.data();
    b_.for_each(groups_.size(), [=] LSDCD_LAMBDA(std::size_t g) {
      const PieceGroup group = groups[g];
      group_near[g] = any_brick_near(grid, pose.corner_at(group.centre), group.radius + more);
    });
    b_.for_each(n + 1, [=] LSDCD_LAMBDA(std::size_t i) {
      std::uint64_t near = 0;
      if (i < n && group_near[i / kPiecesOfGroup]) {
        const Piece piece = pieces[i];
        if (for_each_near(grid, pose.corner_at(piece.centre), unit * piece.radius + more,
                          [&](FeatureCode) { near++; }))
          count_one(cut_short);
      }
      offset[i] = near;
    });
    uncertain = read(cut_short);
    return b_.exclusive_scan(offset, n + 1);
  }

  void write_near(const BodyPose &pose, std::uint32_t *triangle, std::uint32_t *wall)
  {
    const GridView grid = grid_;
    const Piece *pieces = pieces_.data();
    const Real unit = unit_, more = slack(pose) + grid_.tolerance;
    const std::uint64_t *offset = offset_.data();
    b_.for_each(pieces_.size(), [=] LSDCD_LAMBDA(std::size_t i) {
      std::uint64_t to = offset[i];
      if (to == offset[i + 1]) return;
      const Piece piece = pieces[i];
      for_each_near(grid, pose.corner_at(piece.centre), unit * piece.radius + more,
                    [&](FeatureCode code) {
                      triangle[to] = piece.triangle;
                      wall[to++] = code;
                    });
    });
  }

  // By triangle, and by primitive within each. Pieces ascend by triangle, so that one sort is kept
  // stable by the next.
  void sort(Scratch<std::uint32_t> &triangle, Scratch<std::uint32_t> &wall)
  {
    const std::uint32_t *codes = wall.data();
    const std::uint32_t largest = b_.template largest<std::uint32_t>(
        wall.size(), [=] LSDCD_LAMBDA(std::size_t i) -> std::uint32_t { return codes[i]; });
    b_.sort_pairs(wall, triangle, largest);
    b_.sort_pairs(triangle, wall, static_cast<std::uint32_t>(n_triangles_));
  }

  // The exact test of each pair, once.
  void test(const BodyPose &pose, const std::uint32_t *triangle, const std::uint32_t *wall,
            std::size_t n, bool with_segments, Collision &out)
  {
    const WallFeaturesView features = grid_.wall;
    const Vec3 *corners = corners_.data();
    Scratch<std::uint64_t> first(n + 1);
    std::uint64_t *to = first.data();
    b_.for_each(n + 1, [=] LSDCD_LAMBDA(std::size_t i) {
      const bool again =
          i == n || (i > 0 && triangle[i] == triangle[i - 1] && wall[i] == wall[i - 1]);
      to[i] = !again && triangles_meet(body_triangle(corners, triangle[i], pose),
                                       wall_triangle(features, wall[i]));
    });
    const std::size_t n_pairs = b_.exclusive_scan(to, n + 1);
    Array<BodyPair> pairs(n_pairs);
    Array<MeetingSegment> segments(with_segments ? n_pairs : 0);
    BodyPair *pair = pairs.data();
    MeetingSegment *segment = segments.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      if (to[i] == to[i + 1]) return;
      pair[to[i]] = {triangle[i], wall[i]};
      if (with_segments)
        segment[to[i]] = meeting_segment(body_triangle(corners, triangle[i], pose),
                                         wall_triangle(features, wall[i]));
    });
    out.pairs = b_.to_host(pairs, n_pairs);
    out.segments = b_.to_host(segments, segments.size());
  }

 private:
  static constexpr std::uint64_t kMost = std::uint64_t(1) << 28;    // pieces, and pairs

  // 2 / 3 of the longest edge (subdivide.h), and what piece_of() adds to it.
  static constexpr Real kMostRadius = (2. / 3) * (1 + 2e-6);
  // Of pieces: a cell, or as the cutoff reaches with a bit to spare for rounding.
  Real longest_edge() const
  {
    return std::min(grid_.length, grid_.cutoff / (kMostRadius * (1 + Real(1e-4))));
  }
  Real slack(const BodyPose &pose) const
  {
    return 128 * kRoundoff * (2 * size_ + norm(pose.shift));
  }

  std::uint64_t read(const std::uint64_t *at)
  {
    std::uint64_t value = 0;
    if constexpr (B::kOnHost)
      value = *at;
    else
      value = b_.read_one(at);
    return value;
  }

  // Before anything is counted one by one: no piece has a larger area than one with equal sides.
  static void check_body(const TriangleSoup &body, Real longest)
  {
    constexpr Real kLargestLength = 1e100;
    if (body.corners.empty()) throw InputError(body.source + ": the body has no triangles");
    Real n = 0;
    for (std::size_t c = 0; c < body.corners.size(); c++) {
      const Vec3 &x = body.corners[c];
      for (int k = 0; k < 3; k++)
        if (!(std::fabs(x[k]) <= kLargestLength))
          throw InputError(body.source + ", triangle " + std::to_string(c / 3 + 1) +
                           ": coordinate " + "xyz"[k] + " is " + std::to_string(x[k]) +
                           ", beyond 1e100; repair the mesh");
      if (c % 3 != 2) continue;
      const Vec3 u = (1 / longest) * (body.corners[c - 1] - body.corners[c - 2]),
                 v = (1 / longest) * (x - body.corners[c - 2]);
      constexpr Real kLargestArea = 0.4330127018922194;    // sqrt(3) / 4
      n += std::max(Real(1), norm(cross(u, v)) / (2 * kLargestArea));
      n = std::max(n, std::max(norm(u), norm(v)));
    }
    if (!(n <= Real(kMost))) throw_too_many(body.source, n);
  }
  [[noreturn]] static void throw_too_many(const std::string &source, Real n)
  {
    char text[32];
    std::snprintf(text, sizeof text, "%.3g", n);
    throw InputError(source + ": in cells of the wall's grid the body has " + text +
                     " pieces, more than 2^28: build the grid with longer cells");
  }

  void check(const BodyPose &pose) const
  {
    for (int i = 0; i < 3; i++)
      for (int j = 0; j <= i; j++)
        if (!(std::fabs(dot(pose.row[i], pose.row[j]) - (i == j)) <= 1e-8))
          throw InputError("the pose's matrix is no rotation: rows are not unit vectors at right "
                           "angles to 1e-8");
    if (!(dot(pose.row[0], cross(pose.row[1], pose.row[2])) > 0))
      throw InputError("the pose's matrix mirrors the body: its determinant is -1");
    if (!(kMostRadius * unit_ + slack(pose) <= grid_.cutoff))
      throw InputError("the body is so far from the origin, or so large, that cells of " +
                       std::to_string(grid_.length) +
                       " have too few digits there: move wall and body nearer to the origin");
  }

  B b_;
  GridView grid_ = {};
  Array<char> block_;
  Array<Vec3> corners_;
  std::size_t n_triangles_ = 0;
  Array<Piece> pieces_;
  Array<PieceGroup> groups_;
  Array<char> group_near_;
  Array<std::uint64_t> offset_;    // of each piece's primitives in a pose
  Real size_ = 0, unit_ = 0;       // of the body about its origin; a piece's longest edge
};

}    // namespace lsdcd
