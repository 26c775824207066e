// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Ears are cut off (Meisters 1975): an ear is a corner whose triangle with its two neighbours is part of the
// polygon. All signs are exact. A triangle counts as part if it turns as the polygon does and holds no other
// corner, neither inside nor on its new side: a corner there would be one on an edge of the mesh. Every
// simple polygon with more than three corners has two ears, also if some of its angles are straight.
//
// That no corner is in the way does not prove that the polygon is simple: its edges may cross. So the result
// is proved: each triangle turns as the polygon does, by exact signs. Their boundaries add up to the polygon's,
// so they cover each point as often as it winds around it. That is once where no edges meet, but where they
// follow each other; else, as at the bridges of holes, no two triangles may have a common inner point.
#include "mesh/io/cut_polygon.h"

#include "base/input_words.h"
#include "geometry/orientation.h"
#include "mesh/box_tree.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <deque>
#include <memory>

namespace lsdcd {
namespace {

class Cutter {
 public:
  Cutter(const std::vector<Vec3> &corners, std::vector<Vec3> &triangles) :
      corners_(corners), triangles_(triangles), n_(static_cast<int>(corners.size()))
  {
  }

  std::string cut()
  {
    if (n_ == 3) {
      append({0, 1, 2});
      return "";
    }
    if (!look_along_axis()) return "its corners are farther apart than any number";
    if (n_ == 4 && cut_quadrilateral()) return "";
    const int stuck = cut_ears();
    if (stuck >= 0) return crosses_near(corners_[stuck]);
    const int doubled = is_simple() ? -1 : corner_of_overlap();
    if (doubled >= 0) return crosses_near(corners_[doubled]);
    if (!has_area_of_polygon()) return "its triangles have a different area than it has";
    for (const Triple &t : cut_) append(t);
    return "";
  }

 private:
  using Triple = std::array<int, 3>;
  struct Due {
    int corner, number;    // valid if the number is the corner's newest
  };

  void append(const Triple &t)
  {
    for (const int corner : t) triangles_.push_back(corners_[corner]);
  }

  static std::string crosses_near(const Vec3 &x)
  {
    return "it crosses itself near (" + number_text(x.x) + ", " + number_text(x.y) + ", " +
           number_text(x.z) + "), or is far from flat there";
  }

  // Twice the signed area of a triangle as it is seen, in units of the square of size_.
  Real area_of(int a, int b, int c) const
  {
    const Vec3 ab = (1 / size_) * (flat_[b] - flat_[a]), ac = (1 / size_) * (flat_[c] - flat_[a]);
    return ab[u()] * ac[v()] - ab[v()] * ac[u()];
  }
  Real area_of_polygon() const
  {
    Real area = 0;
    for (int k = 1; k + 1 < n_; k++) area += area_of(0, k, k + 1);
    return area;
  }
  int u() const { return axis_ == 0 ? 1 : 0; }    // as orientation_along() has them
  int v() const { return axis_ == 2 ? 1 : 2; }

  // Chooses the axis. False: the size overflows.
  bool look_along_axis()
  {
    size_ = 0;
    for (const Vec3 &x : corners_)
      for (int k = 0; k < 3; k++) size_ = std::max(size_, fabs(x[k] - corners_[0][k]));
    if (!std::isfinite(size_)) return false;
    if (size_ == 0) size_ = 1;
    flat_ = corners_;
    Real largest = -1;
    int best = 0;
    for (axis_ = 0; axis_ < 3; axis_++) {
      Real area = 0, parts = 0;
      for (int k = 1; k + 1 < n_; k++) {
        const Real part = area_of(0, k, k + 1);
        area += part;
        parts += fabs(part);
      }
      // The parts decide where a polygon that crosses itself has no area along any axis.
      const Real seen = fabs(area) + 1e-9 * parts;
      if (seen <= largest) continue;
      largest = seen;
      best = axis_;
      side_ = area < 0 ? -1 : 1;
    }
    axis_ = best;
    for (Vec3 &x : flat_) x[axis_] = 0;
    return true;
  }

  // 1 where a, b, c turn as the polygon does, as seen along the axis; 0: they are in a line.
  int turn(int a, int b, int c) const
  {
    return side_ * orientation_along(axis_, flat_[a], flat_[b], flat_[c]);
  }
  int turn_at(int b) const { return turn(previous_[b], b, next_[b]); }
  bool is_same(int a, int b) const { return corners_[a] == corners_[b]; }

  bool cut_quadrilateral()
  {
    for (const int k : {0, 1}) {
      const Triple first = {k, k + 1, k + 2}, second = {k, k + 2, (k + 3) % 4};
      if (turn(first[0], first[1], first[2]) > 0 && turn(second[0], second[1], second[2]) > 0) {
        append(first);
        append(second);
        return true;
      }
    }
    return false;
  }

  // Does the way a, b, c, in a line, turn back at b?
  bool turns_back(int a, int b, int c) const
  {
    const int k = flat_[a][u()] != flat_[b][u()] ? u() : v();
    const Real x = flat_[b][k];
    return flat_[a][k] < x ? flat_[c][k] < x : (flat_[a][k] > x && flat_[c][k] > x);
  }

  // Returns -1, or a corner of what cannot be cut.
  int cut_ears()
  {
    previous_.resize(n_);
    next_.resize(n_);
    for (int i = 0; i < n_; i++) {
      previous_[i] = (i + n_ - 1) % n_;
      next_[i] = (i + 1) % n_;
    }
    left_ = n_;
    blocks_.assign(n_, 0);
    for (int i = 0; i < n_; i++)
      if (turn_at(i) <= 0) block(i);
    number_due_.assign(n_, 0);
    // A corner on an old side of an ear, or at an end of it, is let be only where there is no other ear: the polygon
    // touches itself there.
    for (bool sides_too = true; left_ >= 3;) {
      const int before = left_;
      for (int i = 0; i < n_; i++)
        if (next_[i] >= 0) make_due(i);
      while (left_ >= 3 && !due_.empty()) {
        const auto [corner, number] = due_.front();
        due_.pop_front();
        if (number == number_due_[corner] && next_[corner] >= 0) try_corner(corner, sides_too);
      }
      if (left_ == before && !sides_too) return first_left();
      sides_too = left_ < before;
    }
    return -1;
  }
  int first_left() const
  {
    const auto is_left = [](int next) { return next >= 0; };
    return static_cast<int>(std::find_if(next_.begin(), next_.end(), is_left) - next_.begin());
  }

  void block(int corner) { blocks_[corner] = any_blocks_ = true; }
  void make_due(int corner) { due_.push_back({corner, ++number_due_[corner]}); }

  void try_corner(int b, bool sides_too)
  {
    const int a = previous_[b], c = next_[b], way = turn(a, b, c);
    if (is_same(a, b) || is_same(b, c)) {
      take_out(b);
    } else if (way == 0 && turns_back(a, b, c)) {
      if (!is_same(a, c)) cut_.push_back({a, b, c});
      take_out(b);
    } else if (way > 0) {
      if (has_corner_in(a, b, c, sides_too)) return;
      cut_.push_back({a, b, c});
      take_out(b);
    }
  }

  // Its neighbours are tried again, after all others.
  void take_out(int b)
  {
    const int a = previous_[b], c = next_[b];
    next_[a] = c;
    previous_[c] = a;
    next_[b] = previous_[b] = -1;
    left_--;
    for (const int corner : {a, c}) {
      if (turn_at(corner) <= 0) block(corner);
      make_due(corner);
    }
  }

  // Is there another corner in the triangle? If so, there is one whose angle is straight or larger.
  bool has_corner_in(int a, int b, int c, bool sides_too)
  {
    if (!any_blocks_) return false;
    if (!tree_ || in_tree_.size() > 2 * static_cast<std::size_t>(left_)) {
      in_tree_.clear();
      std::vector<Box> boxes;
      for (int i = 0; i < n_; i++)
        if (next_[i] >= 0) in_tree_.push_back(i), boxes.push_back({flat_[i], flat_[i]});
      tree_ = std::make_unique<BoxTree>(boxes);
    }
    const Box around = box_around(flat_[a], flat_[b], flat_[c]);
    bool found = false;
    const auto may_hold = [&](const Box &box) {
      return !found && overlap(box, around) && !is_beyond(a, b, box) && !is_beyond(b, c, box) &&
             !is_beyond(c, a, box);
    };
    tree_->visit(may_hold, [&](int i) {
      const int p = in_tree_[i];
      if (!blocks_[p] || next_[p] < 0) return;
      if (p == a || p == b || p == c) return;
      const int least = sides_too ? 0 : 1;
      if (turn(a, b, p) >= least && turn(b, c, p) >= least && turn(c, a, p) >= 0) found = true;
    });
    return found;
  }

  // Is all of the box on the other side of the line a, b than the polygon? Its corner farthest in decides.
  bool is_beyond(int a, int b, const Box &box) const
  {
    const Vec3 &from = flat_[a], &to = flat_[b];
    Vec3 in = from;
    in[u()] = (from[v()] < to[v()]) == (side_ > 0) ? box.lo[u()] : box.hi[u()];
    in[v()] = (from[u()] < to[u()]) == (side_ > 0) ? box.hi[v()] : box.lo[v()];
    return side_ * orientation_along(axis_, from, to, in) < 0;
  }

  // Does no edge meet another, but where they follow each other? Then it winds around each point once or never.
  bool is_simple() const
  {
    std::vector<Box> boxes;
    const auto after = [&](int i) { return (i + 1) % n_; };
    for (int i = 0; i < n_; i++) {
      const int a = i, b = after(a), c = after(b);
      if (is_same(a, b) || (turn(a, b, c) == 0 && turns_back(a, b, c))) return false;
      boxes.push_back(box_around(flat_[a], flat_[b], flat_[b]));
    }
    bool found = false;
    BoxTree(boxes).visit_pairs([&](int i, int j) {
      const int a = i, b = after(a), c = j, d = after(c);
      if (found || b == c || d == a) return;
      found = turn(a, b, c) * turn(a, b, d) <= 0 && turn(c, d, a) * turn(c, d, b) <= 0;
    });
    return !found;
  }

  // A corner of a triangle that has inner points in common with another; -1: there is none.
  int corner_of_overlap() const
  {
    std::vector<Triple> with_area;
    std::vector<Box> boxes;
    for (const Triple &t : cut_) {
      if (turn(t[0], t[1], t[2]) == 0) continue;
      with_area.push_back(t);
      boxes.push_back(box_around(flat_[t[0]], flat_[t[1]], flat_[t[2]]));
    }
    int found = -1;
    BoxTree(boxes).visit_pairs([&](int i, int j) {
      const Triple &s = with_area[i], &t = with_area[j];
      if (found < 0 && !has_on_other_side(s, t) && !has_on_other_side(t, s)) found = s[0];
    });
    return found;
  }
  // Is all of t beyond one side of s?
  bool has_on_other_side(const Triple &s, const Triple &t) const
  {
    for (int k = 0; k < 3; k++) {
      const auto beyond = [&](int corner) { return turn(s[k], s[(k + 1) % 3], corner) <= 0; };
      if (std::all_of(t.begin(), t.end(), beyond)) return true;
    }
    return false;
  }

  // Areas here are below 2 each, and each is rounded a few times by 2^-53 of that.
  bool has_area_of_polygon() const
  {
    Real sum = 0;
    for (const Triple &t : cut_) sum += fabs(area_of(t[0], t[1], t[2]));
    return fabs(sum - fabs(area_of_polygon())) <= 16 * kRoundoff * n_ * (1 + sum);
  }

  const std::vector<Vec3> &corners_;
  std::vector<Vec3> &triangles_;
  int n_;
  std::vector<Vec3> flat_;    // the corners as they are seen
  int axis_ = 0, side_ = 1;
  Real size_ = 1;    // length, from the first corner to any other at most

  std::vector<Triple> cut_;
  std::vector<int> previous_, next_;    // -1: it is no longer a corner
  int left_ = 0;
  std::vector<char> blocks_;    // was its angle ever straight or larger?
  bool any_blocks_ = false;
  std::deque<Due> due_;
  std::vector<int> number_due_;
  std::unique_ptr<BoxTree> tree_;
  std::vector<int> in_tree_;
};

// Is b, read from some corner on, a? `way` is 1, or -1 for b read backwards.
bool is_same_polygon(const Vec3 *a, const Vec3 *b, std::size_t n, int way)
{
  for (std::size_t first = 0; first < n; first++) {
    std::size_t k = 0;
    while (k < n && a[k] == b[(way > 0 ? first + k : first + n - k) % n]) k++;
    if (k == n) return true;
  }
  return false;
}

}    // namespace

std::string cut_polygon(const std::vector<Vec3> &corners, std::vector<Vec3> &triangles)
{
  return Cutter(corners, triangles).cut();
}

std::string PolygonCutter::cut(const std::vector<Vec3> &corners, std::vector<Vec3> &triangles)
{
  const std::size_t n = corners.size();
  if (n == 3) return cut_polygon(corners, triangles);
  std::uint64_t hash =
      0;    // the same from any corner on, either way; 0.0 for -0.0, which has other bits
  for (const Vec3 &x : corners) hash += hash_three(x.x + 0, x.y + 0, x.z + 0);
  int way = 0;
  const auto is_same = [&](int i) {
    if (cuts_[i].n != n) return false;
    const Vec3 *const a = corners.data(), *const b = &corners_[cuts_[i].corner];
    way = is_same_polygon(a, b, n, 1) ? 1 : is_same_polygon(a, b, n, -1) ? -1 : 0;
    return way != 0;
  };
  if (const int i = known_cuts_.find(hash, is_same); i != HashIndex::kNone) {
    for (std::size_t k = cuts_[i].triangle; k < cuts_[i].behind; k += 3)
      for (const std::size_t corner : {k, way > 0 ? k + 1 : k + 2, way > 0 ? k + 2 : k + 1})
        triangles.push_back(Vec3(triangles[corner]));
    return "";
  }
  const std::size_t before = triangles.size();
  std::string problem = cut_polygon(corners, triangles);
  if (!problem.empty()) return problem;
  known_cuts_.find_or_insert(hash, static_cast<int>(cuts_.size()), [](int) { return false; });
  cuts_.push_back({corners_.size(), n, before, triangles.size()});
  corners_.insert(corners_.end(), corners.begin(), corners.end());
  return "";
}

}    // namespace lsdcd
