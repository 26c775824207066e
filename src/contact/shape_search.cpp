// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/shape_search.h"

#include "base/input_error.h"
#include "tree/tree_search.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace lsdcd {
namespace {

// A place is a local minimum if no direction on the surface goes downhill by more than this, an angle: it is above the rounding
// of normals.
constexpr Real kLevel = 1e-12;
// Places of triangles that have a vertex in common are one if their normals are this close, an angle, and their distances by
// this share of the size; all others if their feet are as close, too. Under a flat side the feet are where rounding puts them.
constexpr Real kSameNormal = 1e-9, kSameDistance = 1e-12, kSameFoot = 1e-9;
// The same where the overlap is more than the least radius of curvature.
constexpr Real kSameDeepDistance = 1e-11, kSameDeepFoot = 1e-4;
constexpr Real kFarthestCentre = 1e100;

bool is_near_anything(const PlacedGrain &grain)
{
  const Vec3 &x = grain.centre;
  if (!(x.x - x.x == 0 && x.y - x.y == 0 && x.z - x.z == 0)) return false;
  if (!(std::fmax(std::fabs(x.x), std::fmax(std::fabs(x.y), std::fabs(x.z))) <= kFarthestCentre))
    throw InputError("a grain is farther than 1e100 from the origin");
  return true;
}

ShapeMinimum sure(const ShapeMinimum &m)
{
  if (m.is_sure) return m;
  throw InputError(
      "the nearest point of a grain's surface was not found to rounding at a distance of " +
      std::to_string(m.distance) + ": please report its numbers");
}

int n_corners(FeatureCode primitive)
{
  const FeatureKind kind = feature_kind(primitive);
  return kind == FeatureKind::face ? 3 : kind == FeatureKind::edge ? 2 : 1;
}

}    // namespace

void ShapeSearch::contacts(const PlacedGrain &grain, std::vector<ShapeContact> &found)
{
  if (!is_near_anything(grain)) return;
  minima_.clear();
  visit(grain, grain.shape.farthest, [&](std::uint32_t primitive) {
    if (!is_beside(grain, primitive)) add(minimum_of(grain, primitive, 0), primitive);
  });
  find_contacts(grain, found);
}

void ShapeSearch::contacts(const PlacedGrain &grain, const std::vector<std::uint32_t> &among,
                           std::vector<ShapeContact> &found)
{
  if (!is_near_anything(grain)) return;
  minima_.clear();
  for (const std::uint32_t primitive : among)
    if (!is_beside(grain, primitive)) add(minimum_of(grain, primitive, 0), primitive);
  find_contacts(grain, found);
}

void ShapeSearch::find_near(const PlacedGrain &grain, Real radius, std::vector<std::uint32_t> &near)
{
  near.clear();
  if (!is_near_anything(grain)) return;
  visit(grain, radius, [&](std::uint32_t primitive) { near.push_back(primitive); });
}

// Adds those minima of primitives that are contacts.
void ShapeSearch::find_contacts(const PlacedGrain &grain, std::vector<ShapeContact> &found)
{
  std::sort(minima_.begin(), minima_.end(), [](const Minimum &a, const Minimum &b) {
    return a.feature != b.feature           ? a.feature < b.feature
           : a.at.distance != b.at.distance ? a.at.distance < b.at.distance
                                            : a.primitive < b.primitive;
  });
  local_.clear();
  for (std::size_t i = 0; i < minima_.size(); i++)
    if ((i == 0 || minima_[i].feature != minima_[i - 1].feature) && is_local(grain, minima_[i]))
      local_.push_back(minima_[i]);
  merge(grain);
  for (std::size_t i = 0; i < local_.size(); i++)
    if (same_as_[i] == i) found.push_back(contact_of(grain, local_[i]));
}

ShapeContact ShapeSearch::nearest(const PlacedGrain &grain)
{
  if (!is_near_anything(grain)) return {};
  const TreeAnswer to_centre = tree_.nearest(grain.centre, kAnyDistance, kNoPrimitive);
  if (!to_centre.found()) return {};
  Minimum best = made(minimum_of(grain, to_centre.primitive, HUGE_VAL), to_centre.primitive);
  // The grain is within its circumscribed sphere.
  visit(grain, best.at.distance + grain.shape.farthest, [&](std::uint32_t primitive) {
    if (primitive == to_centre.primitive) return;
    const ShapeMinimum m = minimum_of(grain, primitive, best.at.distance);
    if (m.distance < best.at.distance) best = made(m, primitive);
  });
  return contact_of(grain, best);
}

template <class Found>
void ShapeSearch::visit(const PlacedGrain &grain, Real radius, const Found &found)
{
  TreeWaiting stack[kTreeStack];
  if (view_.search_for(view_.scaled(grain.centre)) == TreeSearch::in_float)
    visit_within<TreeBoundsFloat>(view_, grain.centre, radius, stack, found);
  else
    visit_within<TreeBoundsDouble>(view_, grain.centre, radius, stack, found);
}

Vec3 ShapeSearch::corner_of(const PlacedGrain &grain, const TreePrimitive &p, int k) const
{
  return grain.own_point(view_.vertices[p.vertex[k]]);
}

// Is the primitive on the outer side of one of the faces of the box around the grain?
bool ShapeSearch::is_beside(const PlacedGrain &grain, std::uint32_t primitive) const
{
  const TreePrimitive &p = view_.primitives[primitive];
  Vec3 lo = corner_of(grain, p, 0), hi = lo;
  for (int k = 1; k < n_corners(p.code); k++) {
    const Vec3 c = corner_of(grain, p, k);
    for (int a = 0; a < 3; a++) lo[a] = std::fmin(lo[a], c[a]), hi[a] = std::fmax(hi[a], c[a]);
  }
  for (int a = 0; a < 3; a++)
    if (lo[a] > grain.shape.half[a] || hi[a] < -grain.shape.half[a]) return true;
  return false;
}

ShapeMinimum ShapeSearch::minimum_of(const PlacedGrain &grain, std::uint32_t primitive,
                                     Real below) const
{
  const TreePrimitive &p = view_.primitives[primitive];
  Vec3 corner[3];
  const int n = n_corners(p.code);
  for (int k = 0; k < n; k++) corner[k] = corner_of(grain, p, k);
  if (n == 3) return sure(TriangleMinimum(grain.shape, corner, grain.to_own(p.normal)).find(below));
  // A side or a corner of a triangle that stands on it.
  if (n == 1) corner[1] = corner[0] + Vec3{grain.shape.farthest, 0, 0};
  const Vec3 along = corner[1] - corner[0], across = any_perpendicular(along);
  corner[2] = corner[0] + norm(along) * across;
  const TriangleMinimum alone(grain.shape, corner, (1 / norm(along)) * cross(along, across));
  ShapeMinimum m = n == 2 ? alone.on_side(0, below) : alone.on_corner(0);
  if (!(m.distance < below)) m = no_minimum();
  return sure(m);
}

FeatureCode ShapeSearch::feature_of(const ShapeMinimum &m, const TreePrimitive &p) const
{
  const FeatureKind kind = feature_kind(p.code);
  if (m.part == TrianglePart::corner) return feature_code(FeatureKind::vertex, p.vertex[m.k]);
  if (m.part == TrianglePart::edge && kind == FeatureKind::face)
    return feature_code(FeatureKind::edge, p.edge[m.k]);
  return p.code;
}

ShapeSearch::Minimum ShapeSearch::made(const ShapeMinimum &m, std::uint32_t primitive) const
{
  return {m, feature_of(m, view_.primitives[primitive]), primitive};
}

void ShapeSearch::add(const ShapeMinimum &m, std::uint32_t primitive)
{
  if (m.distance < 0) minima_.push_back(made(m, primitive));
}

ShapeContact ShapeSearch::contact_of(const PlacedGrain &grain, const Minimum &m)
{
  const Vec3 of_grain = m.at.foot - m.at.distance * m.at.normal;
  return {m.feature, grain.centre + grain.turned(m.at.foot), -grain.turned(m.at.normal),
          grain.centre + grain.turned(of_grain), m.at.distance};
}

// Calls visit() for each face at a feature.
template <class Visit>
void ShapeSearch::each_face(FeatureCode feature, const Visit &visit) const
{
  const int i = static_cast<int>(feature_index(feature));
  if (feature_kind(feature) == FeatureKind::face) return visit(i);
  const auto of_edge = [&](int e) {
    for (int k = view_.edge_first[e]; k < view_.edge_first[e + 1]; k++) visit(view_.edge_face[k]);
  };
  if (feature_kind(feature) == FeatureKind::edge) return of_edge(i);
  for (int k = view_.vertex_first[i]; k < view_.vertex_first[i + 1]; k++)
    of_edge(view_.vertex_edge[k]);
}

// Is the minimum of a primitive one of the whole surface?
bool ShapeSearch::is_local(const PlacedGrain &grain, const Minimum &m) const
{
  if (feature_kind(m.feature) == FeatureKind::face) return true;
  return m.at.is_smooth ? rises_around(grain, m) : none_is_deeper(grain, m);
}

// Does the distance rise in all directions on the faces around a minimum, by its gradient there, which is the normal?
bool ShapeSearch::rises_around(const PlacedGrain &grain, const Minimum &m) const
{
  const Vec3 n = grain.turned(m.at.normal);
  const std::uint32_t i = feature_index(m.feature);
  bool rises = true;
  if (feature_kind(m.feature) == FeatureKind::edge) {
    each_face(m.feature, [&](int face) {
      const TreePrimitive &p = view_.primitives[view_.face_primitive[face]];
      for (int k = 0; k < 3; k++)
        if (p.edge[k] == i) rises &= dot(n, p.inward[k]) >= -kLevel;
    });
    return rises;
  }
  // The edges of a vertex go round each of its faces.
  for (int k = view_.vertex_first[i]; k < view_.vertex_first[i + 1]; k++) {
    const int *ends = view_.edges + 2 * view_.vertex_edge[k];
    const Vec3 along = view_.vertices[ends[ends[0] == static_cast<int>(i)]] - view_.vertices[i];
    rises &= dot(n, along) >= -kLevel * norm(along);
  }
  return rises;
}

// Is no minimum of the faces around a minimum deeper? For overlaps above the least radius of curvature, where there may be
// several gradients.
bool ShapeSearch::none_is_deeper(const PlacedGrain &grain, const Minimum &m) const
{
  const Real least = m.at.distance - kSameDeepDistance * grain.shape.farthest;
  bool is_least = true;
  each_face(m.feature, [&](int face) {
    const std::uint32_t primitive = view_.face_primitive[face];
    for (const Minimum &other : minima_)
      if (other.primitive == primitive) is_least &= other.at.distance >= least;
  });
  return is_least;
}

// Finds for each local minimum the one of the lowest feature that is the same but for rounding. Under a flat side each triangle
// has one, and those in the middle make the outer ones neighbours.
void ShapeSearch::merge(const PlacedGrain &grain)
{
  same_as_.resize(local_.size());
  const auto lowest = [&](std::size_t i) {
    while (same_as_[i] != i) i = same_as_[i];
    return i;
  };
  for (std::size_t i = 0; i < local_.size(); i++) {
    same_as_[i] = i;
    for (std::size_t j = 0; j < i; j++) {
      const std::size_t one = lowest(i), other = lowest(j);
      if (one != other && are_same(grain, local_[i], local_[j]))
        same_as_[std::max(one, other)] = std::min(one, other);
    }
  }
}

bool ShapeSearch::are_same(const PlacedGrain &grain, const Minimum &a, const Minimum &b) const
{
  const Real size = grain.shape.farthest, apart = std::fabs(a.at.distance - b.at.distance);
  const Real turn = norm(a.at.normal - b.at.normal), way = norm(a.at.foot - b.at.foot);
  if (a.at.is_smooth && b.at.is_smooth)
    return apart <= kSameDistance * size && turn <= kSameNormal &&
           (way <= kSameFoot * size || are_neighbours(a.feature, b.feature));
  return apart <= kSameDeepDistance * size && way <= kSameDeepFoot * size;
}

// Do the triangles around two features share a vertex?
bool ShapeSearch::are_neighbours(FeatureCode a, FeatureCode b) const
{
  std::vector<int> &around = around_;
  around.clear();
  each_face(a, [&](int face) {
    around.insert(around.end(), view_.faces + 3 * face, view_.faces + 3 * face + 3);
  });
  bool share = false;
  each_face(b, [&](int face) {
    for (int k = 0; k < 3; k++)
      share |= std::find(around.begin(), around.end(), view_.faces[3 * face + k]) != around.end();
  });
  return share;
}

}    // namespace lsdcd
