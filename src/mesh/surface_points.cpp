// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/surface_points.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <unordered_map>

namespace lsdcd {

namespace {

class SurfaceCutter {
 public:
  SurfaceCutter(const WeldedMesh &mesh, Real apart, std::size_t most) :
      points(mesh.vertices), apart_sq_(apart * apart), most_(most)
  {
  }

  // An edge is cut by its own length, so that faces on both sides have the same points of it.
  void cut_edge(int a, int b)
  {
    std::vector<std::array<int, 2>> left = {{a, b}};
    while (!left.empty() && !is_full()) {
      const auto [from, to] = left.back();
      left.pop_back();
      if (!is_long(from, to)) continue;
      const int middle = middle_of(from, to);
      left.push_back({from, middle});
      left.push_back({middle, to});
    }
  }
  void cut_face(const std::array<int, 3> &face)
  {
    std::vector<std::array<int, 3>> left = {face};
    while (!left.empty() && !is_full()) {
      const std::array<int, 3> f = left.back();
      left.pop_back();
      int k = 0;
      for (int j = 1; j < 3; j++)
        if (length_sq(f[j], f[(j + 1) % 3]) > length_sq(f[k], f[(k + 1) % 3])) k = j;
      const int a = f[k], b = f[(k + 1) % 3], c = f[(k + 2) % 3];
      if (!is_long(a, b)) continue;
      const int middle = middle_of(a, b);
      left.push_back({a, middle, c});
      left.push_back({middle, b, c});
    }
  }
  bool is_full() const { return points.size() > most_; }

  std::vector<Vec3> points;

 private:
  Real length_sq(int a, int b) const { return norm_sq(points[a] - points[b]); }
  bool is_long(int a, int b) const { return length_sq(a, b) > apart_sq_; }
  int middle_of(int a, int b)
  {
    const std::uint64_t key = std::uint64_t(std::min(a, b)) << 32 | std::uint64_t(std::max(a, b));
    const auto [at, is_new] = middle_.emplace(key, static_cast<int>(points.size()));
    if (is_new) points.push_back(0.5 * (points[a] + points[b]));
    return at->second;
  }

  Real apart_sq_;
  std::size_t most_;
  std::unordered_map<std::uint64_t, int> middle_;
};

}    // namespace

std::vector<Vec3> surface_points(const WeldedMesh &mesh, Real apart, std::size_t most)
{
  SurfaceCutter cutter(mesh, apart, most);
  for (const auto &edge : mesh.edges) cutter.cut_edge(edge[0], edge[1]);
  for (const auto &face : mesh.faces) cutter.cut_face(face);
  if (cutter.is_full()) return {};
  return std::move(cutter.points);
}

}    // namespace lsdcd
