// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/meets_itself.h"

#include "backend/threads.h"
#include "geometry/triangles_meet.h"
#include "mesh/box_tree.h"
#include "mesh/close_faces.h"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <numeric>
#include <utility>

namespace lsdcd {

namespace {

using namespace triangles_meet_detail;

// More than rounding adds to a dot product of differences of coordinates, or of their cross
// products, in units of the lengths of its factors: u = 2^-53 in each of at most 30 operations,
// 3.4e-15.
constexpr Real kRounding = 1e-14;

// Does a plane through their common corner, which comes first, separate the other corners? It is
// quick and answers for most neighbours. False: not known.
bool are_parted(const Triangle &a, const Triangle &b)
{
  const auto towards = [&](const Vec3 &x) { return (1 / norm(x - a[0])) * (x - a[0]); };
  const Vec3 of_a[2] = {towards(a[1]), towards(a[2])}, of_b[2] = {towards(b[1]), towards(b[2])};
  const Vec3 normal = of_a[0] + of_a[1] - of_b[0] - of_b[1];
  return dot(normal, of_a[0]) > kRounding && dot(normal, of_a[1]) > kRounding &&
         dot(normal, of_b[0]) < -kRounding && dot(normal, of_b[1]) < -kRounding;
}

// Do their third corners lie on different sides of their common edge? false: not known.
bool are_unfolded(const Triangle &a, const Triangle &b)
{
  const Vec3 edge = a[1] - a[0], to_a = a[2] - a[0], to_b = b[2] - a[0];
  const Real scale = dot(edge, edge) * norm(to_a) * norm(to_b);
  constexpr Real kNoUnderflow = 1e-250;
  return scale > kNoUnderflow && dot(cross(edge, to_a), cross(edge, to_b)) < -kRounding * scale;
}

// Both begin with what they share.
bool meet_beyond(int shared, const Triangle &a, const Triangle &b)
{
  if (shared == 0) return triangles_meet(a, b);
  if (shared == 1 ? are_parted(a, b) : are_unfolded(a, b)) return false;
  // If they share more than a corner, that reaches from the corner to the opposite side of one of them.
  if (shared == 1) return segment_meets(a, b[1], b[2]) || segment_meets(b, a[1], a[2]);
  // On both sides of a common edge, unless one is folded upon the other.
  if (orientation(a[0], a[1], a[2], b[2]) != 0) return false;
  const int axis = axis_of_plane(a.corner, 3);
  return orientation_along(axis, a[0], a[1], a[2]) == orientation_along(axis, a[0], a[1], b[2]);
}

// How many corners two faces share. Turns the corners so that these come first.
int line_up(const WeldedMesh &mesh, int f, int g, Triangle &a, Triangle &b)
{
  auto v = mesh.faces[f], w = mesh.faces[g];
  int shared = 0;
  for (int i = 0; i < 3; i++) {
    const auto same = std::find(w.begin() + shared, w.end(), v[i]);
    if (same == w.end()) continue;
    std::swap(w[shared], *same);
    std::swap(v[shared++], v[i]);
  }
  for (int k = 0; k < 3; k++) {
    a.corner[k] = mesh.vertices[v[k]];
    b.corner[k] = mesh.vertices[w[k]];
  }
  return shared;
}

// Pairs of faces, collected and tested many at once.
class FacePairs {
 public:
  // `list`: gets the pairs that meet; null: they are counted only.
  explicit FacePairs(const WeldedMesh &mesh, std::vector<std::array<int, 2>> *list = nullptr) :
      mesh_(mesh), list_(list)
  {
  }

  void add(int f, int g)
  {
    pairs_.push_back({std::min(f, g), std::max(f, g)});
    if (pairs_.size() == kAtOnce) test();
  }
  const SelfMeetings &found()
  {
    test();
    return found_;
  }

 private:
  static constexpr std::size_t kAtOnce = 1 << 16;

  void test()
  {
    std::vector<char> meet(pairs_.size());
    const std::int64_t n = static_cast<std::int64_t>(pairs_.size());
#pragma omp parallel for schedule(dynamic, 256) num_threads(threads()) if (n > 256)
    for (std::int64_t i = 0; i < n; i++) {
      Triangle a, b;
      const int shared = line_up(mesh_, pairs_[i][0], pairs_[i][1], a, b);
      meet[i] = meet_beyond(shared, a, b);
    }
    for (std::int64_t i = 0; i < n; i++) {
      if (!meet[i]) continue;
      if (list_) list_->push_back(pairs_[i]);
      if (found_.pairs++ == 0 || pairs_[i] < found_.first) found_.first = pairs_[i];
    }
    pairs_.clear();
  }

  const WeldedMesh &mesh_;
  std::vector<std::array<int, 2>> *list_;
  std::vector<std::array<int, 2>> pairs_;
  SelfMeetings found_;
};

// All pairs of faces that may meet.
void add_near(const WeldedMesh &mesh, FacePairs &pairs)
{
  std::vector<int> all(mesh.images.any() ? mesh.images.n_faces : mesh.faces.size());
  std::iota(all.begin(), all.end(), 0);
  CloseFaces(mesh, all).visit_pairs([&](int f, int g) { pairs.add(f, g); });
}

}    // namespace

SelfMeetings meets_itself(const WeldedMesh &mesh)
{
  FacePairs pairs(mesh);
  add_near(mesh, pairs);
  return pairs.found();
}

std::vector<std::array<int, 2>> meeting_faces(const WeldedMesh &mesh)
{
  std::vector<std::array<int, 2>> list;
  FacePairs pairs(mesh, &list);
  add_near(mesh, pairs);
  pairs.found();
  std::sort(list.begin(), list.end());
  return list;
}

SelfMeetings shells_meet(const WeldedMesh &mesh, const std::vector<std::vector<int>> &shells)
{
  std::vector<Box> boxes;
  for (const auto &shell : shells) {
    Box around = box_of(mesh, shell[0]);
    for (const int f : shell)
      for (const int v : mesh.faces[f]) extend(around, mesh.vertices[v]);
    boxes.push_back(around);
  }
  std::vector<std::unique_ptr<CloseFaces>> close(shells.size());
  const auto faces = [&](int i) -> const CloseFaces & {
    if (!close[i]) close[i] = std::make_unique<CloseFaces>(mesh, shells[i]);
    return *close[i];
  };
  FacePairs pairs(mesh);
  BoxTree(boxes).visit_pairs([&](int i, int j) {
    faces(i).visit_pairs(faces(j), [&](int f, int g) { pairs.add(f, g); });
  });
  return pairs.found();
}

}    // namespace lsdcd
