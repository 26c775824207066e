#include "tune/wall_parts.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

WallParts::WallParts(const WallMesh &mesh, Real cutoff, Real side, const Box &within) :
    cutoff_(cutoff), within_(within)
{
  Vec3 size;
  for (int k = 0; k < 3; k++)
    size[k] = std::max(Real(0), std::min(mesh.report.hi[k], within.hi[k]) -
                                    std::max(mesh.report.lo[k], within.lo[k]));
  // The area of a wall in a box is seldom more than a few times that of the box.
  const Real area = std::min(mesh.report.area, 10 * norm_sq(size));
  side_ = std::max({side, std::sqrt(area) / 300, norm(size) / 3000});
  origin_ = mesh.report.lo - Vec3{cutoff, cutoff, cutoff};
  const Vec3 none = {0, 0, 0};
  for (const auto &f : mesh.faces) {
    const Vec3 a = mesh.vertices[f[0]], b = mesh.vertices[f[1]], c = mesh.vertices[f[2]];
    Vec3 lo, hi;
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min({a[k], b[k], c[k]});
      hi[k] = std::max({a[k], b[k], c[k]});
    }
    const Vec3 n = cross(b - a, c - a);
    const Vec3 unit = norm(n) > 0 ? (1 / norm(n)) * n : none;
    cover(lo, hi, unit, dot(unit, a));
  }
  // What dropped facets left behind.
  for (std::size_t e = 0; e < mesh.edges.size(); e++) {
    if (mesh.edge_first[e] < mesh.edge_first[e + 1]) continue;
    const Vec3 a = mesh.vertices[mesh.edges[e][0]], b = mesh.vertices[mesh.edges[e][1]];
    Vec3 lo, hi;
    for (int k = 0; k < 3; k++) {
      lo[k] = std::min(a[k], b[k]);
      hi[k] = std::max(a[k], b[k]);
    }
    cover(lo, hi, none, 0);
  }
  for (std::size_t v = 0; v < mesh.vertices.size(); v++)
    if (mesh.vertex_first[v] == mesh.vertex_first[v + 1])
      cover(mesh.vertices[v], mesh.vertices[v], none, 0);
  std::sort(key_.begin(), key_.end());
  key_.erase(std::unique(key_.begin(), key_.end()), key_.end());
}

// Cubes within the cutoff of the box whose middle is no farther from the plane
// normal . x = offset than reach and half a diagonal.
void WallParts::cover(const Vec3 &lo, const Vec3 &hi, const Vec3 &normal, Real offset)
{
  Key first, last;
  for (int k = 0; k < 3; k++) {
    const Real from = std::max(lo[k] - cutoff_, within_.lo[k]),
               to = std::min(hi[k] + cutoff_, within_.hi[k]);
    if (from > to) return;
    first[k] = static_cast<std::int32_t>(std::floor((from - origin_[k]) / side_));
    last[k] = static_cast<std::int32_t>(std::floor((to - origin_[k]) / side_));
  }
  const Real far = cutoff_ + Real(0.5) * std::sqrt(Real(3)) * side_;
  Key at;
  for (at[2] = first[2]; at[2] <= last[2]; at[2]++)
    for (at[1] = first[1]; at[1] <= last[1]; at[1]++)
      for (at[0] = first[0]; at[0] <= last[0]; at[0]++) {
        const Vec3 centre = origin_ + side_ * Vec3{at[0] + 0.5, at[1] + 0.5, at[2] + 0.5};
        if (std::fabs(dot(normal, centre) - offset) > far && norm_sq(normal) > 0) continue;
        if (key_.empty() || key_.back() != at) key_.push_back(at);
      }
}

Box WallParts::box(int part) const
{
  const Key &k = key_[part];
  const Vec3 lo = origin_ + side_ * Vec3{Real(k[0]), Real(k[1]), Real(k[2])};
  return {lo, lo + Vec3{side_, side_, side_}};
}

int WallParts::part_of(const Vec3 &x) const
{
  Key at;
  for (int k = 0; k < 3; k++) {
    const Real place = std::floor((x[k] - origin_[k]) / side_);
    if (!(std::fabs(place) < 1e9)) return -1;
    at[k] = static_cast<std::int32_t>(place);
  }
  const auto found = std::lower_bound(key_.begin(), key_.end(), at);
  return found != key_.end() && *found == at ? static_cast<int>(found - key_.begin()) : -1;
}

}    // namespace lsdcd
