// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "clump/fill_mesh.h"

#include "backend/bits.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace lsdcd {

namespace {

constexpr Real kLatticePoints = 1 << 18;    // in the box of the mesh
constexpr Real kSurfacePoints = 6000;       // about, if the faces are not more

// Points in the middle of cells around the mesh, a bit each: which of them a clump covers.
class CoverLattice {
 public:
  // `margin`: how far spheres may leave the box of the mesh.
  CoverLattice(const InsideMesh &inside, Real margin)
  {
    const MeshReport &r = inside.mesh().report;
    const Vec3 size = r.hi - r.lo;
    step_ = std::cbrt(size.x * size.y * size.z / kLatticePoints);
    const Real beyond = std::ceil(margin / step_) * step_;
    lo_ = r.lo - Vec3{beyond, beyond, beyond};
    for (int k = 0; k < 3; k++)
      n_[k] = std::max(1, static_cast<int>(std::ceil((size[k] + 2 * beyond) / step_)));
    words_ = (n_[0] + 63) / 64;
    const std::size_t all = std::size_t(words_) * n_[1] * n_[2];
    left_.resize(all);
    outside_.resize(all);
    for (int k = 0; k < n_[2]; k++)
      for (int j = 0; j < n_[1]; j++)
        for (int i = 0; i < n_[0]; i++) {
          const Vec3 p = lo_ + step_ * Vec3{i + 0.5, j + 0.5, k + 0.5};
          auto &bits = inside.holds(p) ? left_ : outside_;
          bits[row(j, k) + i / 64] |= std::uint64_t(1) << i % 64;
        }
  }

  // Returns how many points inside the mesh a ball would newly cover, less all that it covers outside. It never grows while balls are
  // taken.
  std::int64_t gain(const Ball &ball) const
  {
    std::int64_t n = 0;
    each_word(ball, [&](std::size_t w, std::uint64_t mask) {
      n += count_bits(left_[w] & mask) - count_bits(outside_[w] & mask);
    });
    return n;
  }
  void cover(const Ball &ball)
  {
    each_word(ball, [&](std::size_t w, std::uint64_t mask) { left_[w] &= ~mask; });
  }

 private:
  std::size_t row(int j, int k) const { return (std::size_t(k) * n_[1] + j) * words_; }

  // The first and the last point along an axis within `reach` of a place; the last is before the first where there is none.
  std::array<int, 2> run(int axis, Real at, Real reach) const
  {
    const Real from = (at - reach - lo_[axis]) / step_ - 0.5,
               to = (at + reach - lo_[axis]) / step_ - 0.5;
    // Rounded up and down by casts, as ceil() and floor() are calls.
    const int n = n_[axis];
    return {n - static_cast<int>(n - std::clamp(from, Real(0), Real(n))),
            static_cast<int>(1 + std::clamp(to, Real(-1), Real(n - 1))) - 1};
  }
  template <class Visit>
  void each_word(const Ball &ball, const Visit &visit) const
  {
    const Vec3 &c = ball.centre;
    const auto [k_from, k_to] = run(2, c.z, ball.radius);
    for (int k = k_from; k <= k_to; k++) {
      const Real z = lo_.z + (k + 0.5) * step_ - c.z,
                 disc = std::sqrt(std::fmax(0, ball.radius * ball.radius - z * z));
      const auto [j_from, j_to] = run(1, c.y, disc);
      for (int j = j_from; j <= j_to; j++) {
        const Real y = lo_.y + (j + 0.5) * step_ - c.y;
        const auto [from, to] = run(0, c.x, std::sqrt(std::fmax(0, disc * disc - y * y)));
        for (int w = from / 64; from <= to && w <= to / 64; w++) {
          std::uint64_t mask = ~std::uint64_t(0);
          if (w == from / 64) mask &= ~std::uint64_t(0) << from % 64;
          if (w == to / 64) mask &= ~std::uint64_t(0) >> (63 - to % 64);
          visit(row(j, k) + w, mask);
        }
      }
    }
  }

  Real step_;
  Vec3 lo_;
  std::array<int, 3> n_;
  int words_;
  std::vector<std::uint64_t> left_, outside_;    // inside and not yet covered; outside
};

// A point of a face and the direction into the mesh there.
struct Foot {
  Vec3 point, inward;
};

// Returns points of the faces, at the centroids of pieces that come of cutting each face at its longest edge until no edge is longer
// than the mean distance of kSurfacePoints points.
std::vector<Foot> feet_on(const WeldedMesh &mesh)
{
  const Real apart_sq = 4 * mesh.report.area / kSurfacePoints,
             sign = mesh.report.volume < 0 ? 1 : -1;
  std::vector<Foot> feet;
  std::vector<std::array<Vec3, 3>> left;
  for (const auto &face : mesh.faces) {
    const Vec3 a = mesh.vertices[face[0]], b = mesh.vertices[face[1]], c = mesh.vertices[face[2]];
    const Vec3 normal = cross(b - a, c - a);
    const Vec3 inward = (sign / norm(normal)) * normal;
    left = {{a, b, c}};
    while (!left.empty()) {
      const std::array<Vec3, 3> t = left.back();
      left.pop_back();
      int k = 0;
      for (int i = 1; i < 3; i++)
        if (norm_sq(t[(i + 1) % 3] - t[i]) > norm_sq(t[(k + 1) % 3] - t[k])) k = i;
      const Vec3 &p = t[k], &q = t[(k + 1) % 3], &r = t[(k + 2) % 3];
      if (norm_sq(q - p) <= apart_sq) {
        feet.push_back({Real(1) / 3 * (p + q + r), inward});
        continue;
      }
      const Vec3 middle = 0.5 * (p + q);
      left.push_back({middle, q, r});
      left.push_back({p, middle, r});
    }
  }
  return feet;
}

class MeshFiller {
 public:
  MeshFiller(const InsideMesh &inside, const FillSettings &settings) :
      inside_(inside), settings_(settings), larger_(1 / (1 - settings.stick_out)),
      diagonal_(norm(inside.mesh().report.hi - inside.mesh().report.lo)),
      lattice_(inside, (larger_ - 1) * 0.5 * diagonal_)
  {
  }

  std::vector<Ball> fill()
  {
    find_candidates();
    std::vector<Ball> chosen;
    while (chosen.size() < settings_.most) {
      Ball best;
      if (!choose(best)) break;
      chosen.push_back(improved(best));
      lattice_.cover(chosen.back());
    }
    return chosen;
  }

 private:
  struct Candidate {
    Ball ball;
    std::size_t number;
    std::int64_t most;    // that it can still add

    bool operator<(const Candidate &other) const
    {
      return most < other.most || (most == other.most && number > other.number);
    }
  };

  // Returns the largest ball inside that has its centre there.
  Ball ball_at(const Vec3 &centre) const { return {centre, larger_ * inside_.depth(centre)}; }

  void find_candidates()
  {
    Ball largest = {{0, 0, 0}, 0};
    const auto add = [&](const Ball &ball) {
      if (ball.radius > 0 && ball.radius >= settings_.least_radius)
        candidates_.push_back({ball, candidates_.size(), lattice_.gain(ball)});
    };
    for (const Foot &foot : feet_on(inside_.mesh())) {
      const Ball ball = ball_at(centre_from(foot));
      if (ball.radius > largest.radius) largest = ball;
      add(ball);
    }
    // The least radius may be between those of candidates and the largest in the mesh.
    if (candidates_.empty() && largest.radius > 0)
      add(moved(largest, [](const Ball &) { return 0; }));
    std::make_heap(candidates_.begin(), candidates_.end());
  }
  // Returns the centre of the largest ball inside that touches the foot: a ball that is too large has a point of the mesh in it, and
  // the next one goes through that point.
  Vec3 centre_from(const Foot &foot) const
  {
    constexpr int kMostSteps = 60;
    constexpr Real kTouches = 1e-9;
    Real radius = 0.5 * diagonal_;
    Vec3 centre = foot.point + radius * foot.inward;
    for (int step = 0; step < kMostSteps; step++) {
      Vec3 near;
      if (inside_.nearest(centre, near) >= (1 - kTouches) * radius) break;
      const Vec3 to = near - foot.point;
      const Real smaller = norm_sq(to) / (2 * dot(to, foot.inward));
      if (!(smaller > 0 && smaller < radius)) break;
      radius = smaller;
      centre = foot.point + radius * foot.inward;
    }
    return centre;
  }

  // Finds the candidate that adds most; false: none adds anything. What a ball adds never grows, so that one which has once added less
  // need not be counted again (Minoux 1978).
  bool choose(Ball &best)
  {
    std::int64_t gain = 0;
    std::size_t left = candidates_.size();
    const auto begin = candidates_.begin();
    while (left > 0 && candidates_.front().most > gain) {
      std::pop_heap(begin, begin + left);
      Candidate &c = candidates_[--left];
      c.most = lattice_.gain(c.ball);
      if (c.most <= gain) continue;
      gain = c.most;
      best = c.ball;
    }
    for (; left < candidates_.size(); left++) std::push_heap(begin, begin + left + 1);
    return gain > 0;
  }
  Ball improved(const Ball &from) const
  {
    return moved(from, [&](const Ball &ball) {
      return ball.radius >= settings_.least_radius ? lattice_.gain(ball) : -1;
    });
  }
  // Moves a ball by ever smaller steps to where the value is larger, or as large with a larger radius.
  template <class Value>
  Ball moved(const Ball &from, const Value &value) const
  {
    Ball best = from;
    std::int64_t most = value(best);
    for (Real step = 0.1 * from.radius; step > 1e-5 * from.radius;) {
      bool is_better = false;
      for (int d = 0; d < 27 && !is_better; d++) {
        const Vec3 way = {d % 3 - Real(1), d / 3 % 3 - Real(1), d / 9 - Real(1)};
        if (d == 13) continue;
        const Ball ball = ball_at(best.centre + step * way);
        if (!(ball.radius > 0)) continue;
        const std::int64_t here = value(ball);
        is_better = here > most || (here == most && ball.radius > best.radius * (1 + 1e-12));
        if (!is_better) continue;
        best = ball;
        most = here;
      }
      if (!is_better) step *= 0.5;
    }
    return best;
  }

  const InsideMesh &inside_;
  FillSettings settings_;
  Real larger_;    // by which a sphere is larger than the ball inside
  Real diagonal_;
  CoverLattice lattice_;
  std::vector<Candidate> candidates_;
};

}    // namespace

std::vector<Ball> fill_mesh(const InsideMesh &inside, const FillSettings &settings)
{
  return MeshFiller(inside, settings).fill();
}

}    // namespace lsdcd
