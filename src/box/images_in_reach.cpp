// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "box/images_in_reach.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "mesh/face_plane.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace lsdcd {

namespace {

// Slabs of space in units of the edges of a box: between lo and hi along each edge.
struct Slabs {
  Vec3 lo, hi;

  bool meet(const Vec3 &least, const Vec3 &most) const
  {
    for (int k = 0; k < 3; k++)
      if (most[k] < lo[k] || least[k] > hi[k]) return false;
    return true;
  }
};

void include(Vec3 &least, Vec3 &most, const Vec3 &x)
{
  for (int k = 0; k < 3; k++) {
    least[k] = std::min(least[k], x[k]);
    most[k] = std::max(most[k], x[k]);
  }
}

// Tests each part by itself: a mesh may be far from the box, and many boxes long.
class ImagesInReach {
 public:
  ImagesInReach(const WeldedMesh &mesh, const std::vector<FacetPart> &parts, const PeriodicBox &box,
                Real depth) :
      mesh_(mesh),
      box_(box), n_parts_(parts.size())
  {
    for (int k = 0; k < 3; k++) {
      past_[k] = box.periodic[k] ? depth / box.width(k) : HUGE_VAL;
      slabs_.lo[k] = -past_[k];
      slabs_.hi[k] = 1 + past_[k];
    }
    at_.reserve(mesh.vertices.size());
    for (const Vec3 &x : mesh.vertices) at_.push_back(box.fraction(x));
    for (std::size_t i = 0; i < parts.size(); i++) add(parts[i], static_cast<int>(i));
    std::sort(all_.begin(), all_.end());
  }

  std::vector<PartImage> take() { return std::move(all_); }

 private:
  void add(const FacetPart &part, int number)
  {
    Vec3 lo = at_[part.vertex[0]], hi = lo;
    include(lo, hi, at_[part.vertex[1]]);
    include(lo, hi, at_[part.vertex[2]]);
    int first[3], last[3];
    Real more = 1;
    for (int k = 0; k < 3; k++) {
      set_range(part, k, lo[k], hi[k], first[k], last[k]);
      more *= std::max(last[k] - first[k] + 1, 0);
    }
    check_number(more);
    for (int c = first[2]; c <= last[2]; c++)
      for (int b = first[1]; b <= last[1]; b++)
        for (int a = first[0]; a <= last[0]; a++) {
          const Vec3 s = {Real(a), Real(b), Real(c)};
          if ((a || b || c) && slabs_.meet(lo + s, hi + s)) all_.push_back({{a, b, c}, number});
        }
  }

  void set_range(const FacetPart &part, int k, Real lo, Real hi, int &first, int &last) const
  {
    first = last = 0;
    if (!box_.periodic[k]) return;
    constexpr Real kFarthest = 1e6;    // boxes; beyond, coordinates have too few digits for images
    if (!(std::max(std::fabs(lo), std::fabs(hi)) < kFarthest))
      refuse("reaches " + number_text(std::max(std::fabs(lo), std::fabs(hi))) +
             " box lengths along a periodic axis");
    first = static_cast<int>(std::ceil(slabs_.lo[k] - hi));
    last = static_cast<int>(std::floor(slabs_.hi[k] - lo));
    if (first > last || hi - lo <= 1 || !moves_in_plane(part, k)) return;
    // The images of a floor of many boxes lie on top of each other, so that a few are enough.
    const int few = static_cast<int>(std::ceil(past_[k]));
    const int least = std::clamp(-few, first, last), most = std::clamp(few, first, last);
    first = least;
    last = most;
  }

  // Is a periodic edge parallel to the face, up to rounding in float?
  bool moves_in_plane(const FacetPart &part, int k) const
  {
    if (part.face == kNoPart) return false;
    const auto &x = mesh_.vertices;
    const FacePlane plane = face_plane(x[part.vertex[0]], x[part.vertex[1]], x[part.vertex[2]]);
    return std::fabs(dot(plane.normal, box_.edge[k])) <= 1e-6 * norm(box_.edge[k]);
  }

  // Each part has at most three vertices and edges of its own, and each edge two ends.
  void check_number(Real more) const
  {
    if (6 * (static_cast<Real>(n_parts_ + all_.size()) + more) > std::numeric_limits<int>::max())
      refuse("has more periodic images in the box than vertex numbers can count");
  }
  [[noreturn]] void refuse(const std::string &what) const
  {
    throw InputError(mesh_.source + ": the mesh " + what +
                     "; give a smaller scale, or cut off what is outside of the box");
  }

  const WeldedMesh &mesh_;
  const PeriodicBox &box_;
  std::size_t n_parts_;
  Real past_[3];
  Slabs slabs_;
  std::vector<Vec3> at_;    // vertices in units of the edges
  std::vector<PartImage> all_;
};

}    // namespace

std::vector<FacetPart> parts_of(const WeldedMesh &mesh)
{
  std::vector<FacetPart> parts;
  parts.reserve(mesh.faces.size());
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    parts.push_back({mesh.faces[f], static_cast<int>(f), kNoPart});
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (mesh.edge_first[e] == mesh.edge_first[e + 1])
      parts.push_back(
          {{mesh.edges[e][0], mesh.edges[e][1], mesh.edges[e][1]}, kNoPart, static_cast<int>(e)});
  for (std::size_t v = 0; v < mesh.vertices.size(); v++)
    if (mesh.vertex_first[v] == mesh.vertex_first[v + 1]) {
      const int i = static_cast<int>(v);
      parts.push_back({{i, i, i}, kNoPart, kNoPart});
    }
  return parts;
}

std::vector<PartImage> images_in_reach(const WeldedMesh &mesh, const std::vector<FacetPart> &parts,
                                       const PeriodicBox &box, Real depth)
{
  return ImagesInReach(mesh, parts, box, depth).take();
}

}    // namespace lsdcd
