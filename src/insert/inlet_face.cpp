// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "insert/inlet_face.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "geometry/primitive_distance.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kFlat = 1e-4;    // of the diagonal; how far corners may be off the plane
constexpr int kTries = 1000;    // for a point that keeps off the outline

}    // namespace

InletFace::InletFace(const WeldedMesh &mesh, Real depth) : depth_(depth)
{
  if (mesh.report.two_sided_faces > 0)
    throw InputError(mesh.source + ": " + std::to_string(mesh.report.two_sided_faces) + " of " +
                     std::to_string(mesh.faces.size()) +
                     " facets are there in both windings, so the side of the inlet is not "
                     "known: keep one of each pair");
  Real area = 0;
  for (const std::array<int, 3> &f : mesh.faces) {
    const std::array<Vec3, 3> t = {mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]};
    const Vec3 twice = cross(t[1] - t[0], t[2] - t[0]);
    triangles_.push_back(t);
    areas_.push_back(area += norm(twice) / 2);
    normal_ += twice;
    middle_ += norm(twice) / 6 * (t[0] + t[1] + t[2]);
  }
  if (!(area > 0) || !(norm(normal_) > 1e-6 * area))
    throw InputError(
        mesh.source +
        ": the triangles have no common side: an inlet must be a flat mesh, wound one way");
  normal_ = (1 / norm(normal_)) * normal_;
  middle_ = (1 / area) * middle_;
  check_flat(mesh);
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (mesh.edge_first[e + 1] - mesh.edge_first[e] == 1)
      outline_.push_back({mesh.vertices[mesh.edges[e][0]], mesh.vertices[mesh.edges[e][1]]});
}

void InletFace::check_flat(const WeldedMesh &mesh) const
{
  const Real diagonal = norm(mesh.report.hi - mesh.report.lo);
  for (std::size_t i = 0; i < triangles_.size(); i++) {
    const std::array<Vec3, 3> &t = triangles_[i];
    const std::string facet = mesh.source + ": facet " + std::to_string(mesh.face_facet[i] + 1);
    for (const Vec3 &x : t) {
      const Real off = std::fabs(dot(normal_, x - middle_));
      if (off > kFlat * diagonal)
        throw InputError(facet + " has a corner " + number_text(off) +
                         " off the plane of the mesh: an inlet is a flat mesh; give a region for "
                         "another shape");
    }
    if (dot(cross(t[1] - t[0], t[2] - t[0]), normal_) < 0)
      throw InputError(facet +
                       " is wound against the others, so the side of the inlet is not known: "
                       "turn it over");
  }
}

Box InletFace::zone() const
{
  Box box = {triangles_[0][0], triangles_[0][0]};
  for (const std::array<Vec3, 3> &t : triangles_)
    for (const Vec3 &x : t) {
      extend(box, x);
      extend(box, x + depth_ * normal_);
    }
  return box;
}

// Uniform in a triangle: Turk 1990.
Vec3 InletFace::point(RandomStream &random) const
{
  const Real at = random.uniform() * areas_.back();
  std::size_t i = std::upper_bound(areas_.begin(), areas_.end(), at) - areas_.begin();
  i = std::min(i, triangles_.size() - 1);
  const Real u = std::sqrt(random.uniform()), v = random.uniform();
  const std::array<Vec3, 3> &t = triangles_[i];
  return (1 - u) * t[0] + u * (1 - v) * t[1] + u * v * t[2];
}

bool InletFace::is_inside(const Vec3 &at, Real radius) const
{
  for (const std::array<Vec3, 2> &edge : outline_)
    if (segment_distance(edge[0], edge[1], at) < radius) return false;
  return true;
}

bool InletFace::draw(RandomStream &random, Real radius, Vec3 &at) const
{
  for (int k = 0; k < kTries; k++) {
    const Vec3 x = point(random);
    if (!is_inside(x, radius)) continue;
    at = x + random.uniform(0, depth_) * normal_;
    return true;
  }
  return false;
}

bool InletFace::has_room(Real radius) const
{
  RandomStream random({1});
  Vec3 at;
  for (int k = 0; k < 20; k++)
    if (draw(random, radius, at)) return true;
  return false;
}

}    // namespace lsdcd
