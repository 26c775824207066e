// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/shape_search.h"

#include "base/input_error.h"
#include "geometry/primitive_distance.h"
#include "tree/tree_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>

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
// How sure the foot of a plane is, in radii of the sphere around the grain; an ellipsoid's to this by the square of how slender it is.
constexpr Real kUnsureFoot = 1e-2, kRounding = 64 * kRoundoff;

bool is_near_anything(const PlacedGrain &grain)
{
  const Vec3 &x = grain.centre;
  if (!(x.x - x.x == 0 && x.y - x.y == 0 && x.z - x.z == 0)) return false;
  if (!(std::fmax(std::fabs(x.x), std::fmax(std::fabs(x.y), std::fabs(x.z))) <= kFarthestCentre))
    throw InputError("a grain is farther than 1e100 from the origin");
  return true;
}

void check_sure(bool is_sure, Real distance)
{
  if (is_sure) return;
  throw InputError(
      "the nearest point of a grain's surface was not found to rounding at a distance of " +
      std::to_string(distance) + ": please report its numbers");
}

ShapeMinimum sure(const ShapeMinimum &m)
{
  check_sure(m.is_sure, m.distance);
  return m;
}

// Can a point be within the grain? By its box, and an ellipsoid as a ball.
bool may_hold(const Superellipsoid &s, const Vec3 &y)
{
  const Vec3 u = {y.x / s.half.x, y.y / s.half.y, y.z / s.half.z};
  if (s.is_ellipsoid()) return norm_sq(u) < 1;
  return (std::fabs(u.x) < 1) & (std::fabs(u.y) < 1) & (std::fabs(u.z) < 1);
}

// May the gauge be less than 1 on a segment, of a point and the way to its other end over the half-axes? It is convex, and no less than its
// tangents, of which the first is at a share of the way.
bool may_be_less_than_one(const Superellipsoid &s, const Vec3 &u, const Vec3 &along, Real at)
{
  constexpr int kMostTangents = 6;
  struct {
    Real at, over, rise;    // of a tangent: where, how much more than 1, and its rise there
  } end[2] = {{0, -1, 0}, {1, -1, 0}};
  for (int i = 0; i < kMostTangents; i++) {
    const Vec3 x = u + at * along;
    const Vec3 slope = {power_of(std::fabs(x.x), s.n2 - 2) * x.x,
                        power_of(std::fabs(x.y), s.n2 - 2) * x.y,
                        power_of(std::fabs(x.z), s.n1 - 2) * x.z};
    const Real across = slope.x * x.x + slope.y * x.y,
               scale = s.n1 == s.n2 ? 1 : power_of(across, s.n1 / s.n2 - 1);
    const Real power = scale * across + slope.z * x.z,    // the gauge to the power n1
        rise = scale * (slope.x * along.x + slope.y * along.y) + slope.z * along.z;
    if (power < 1) return true;
    const Real value = std::pow(power, 1 / s.n1);
    const bool rises = rise > 0;
    end[rises] = {at, value - 1, value / power * rise};
    // To where the tangents on both sides of the minimum meet, or where the one is 1.
    const auto &low = end[0], &high = end[1];
    const bool has_both = low.over >= 0 && high.over >= 0;
    const Real way = end[rises].over / end[rises].rise,
               meeting = (low.over - high.over + high.rise * high.at - low.rise * low.at) /
                         (high.rise - low.rise);
    at = has_both ? meeting : at - way;
    if (has_both ? !(low.over + low.rise * (at - low.at) < 0) : !(at > 0 && at < 1)) return false;
  }
  return true;
}

// Returns the place of a number in an ascending list, its size where it is not there.
template <class List, class NumberOf>
std::uint32_t place_in(const List &list, std::uint32_t number, const NumberOf &number_of)
{
  const auto at =
      std::lower_bound(list.begin(), list.end(), number,
                       [&](const auto &a, std::uint32_t b) { return number_of(a) < b; });
  return static_cast<std::uint32_t>(at != list.end() && number_of(*at) == number
                                        ? at - list.begin()
                                        : static_cast<std::ptrdiff_t>(list.size()));
}

// Is what has this distance from the grain's centre surely found for it? What is but for rounding out of the sphere around it has no
// deep place.
bool is_in_reach(const PlacedGrain &grain, Real distance)
{
  constexpr Real kSure = 1 - 1e-9;
  return distance < kSure * grain.shape.farthest;
}

struct SameNumber {
  std::uint32_t operator()(std::uint32_t i) const { return i; }
};

int n_corners(FeatureCode primitive)
{
  const FeatureKind kind = feature_kind(primitive);
  return kind == FeatureKind::face ? 3 : kind == FeatureKind::edge ? 2 : 1;
}

}    // namespace

Real sure_distance(const Superellipsoid &s, const Vec3 &y)
{
  const SurfacePoint nearest = nearest_on_surface(s, y);
  check_sure(nearest.is_sure, nearest.distance);
  return nearest.distance;
}

// The part of the grain that is deeper than `depth` is within the grain that is smaller by the share depth / farthest: from a
// point of that on, the surface is the rest of the ray away at most.
bool may_cut(const Superellipsoid &s, const Vec3 &from, const Vec3 &to, Real depth)
{
  const Vec3 half = (1 - depth / s.farthest) * s.half;
  const auto is_beside = [](Real a, Real b, Real half) {
    return (smaller(a, b) >= half) | (larger(a, b) <= -half);
  };
  if (is_beside(from.x, to.x, half.x) | is_beside(from.y, to.y, half.y) |
      is_beside(from.z, to.z, half.z))
    return false;
  const Vec3 u = {from.x / half.x, from.y / half.y, from.z / half.z};
  const Vec3 along = {to.x / half.x - u.x, to.y / half.y - u.y, to.z / half.z - u.z};
  const Real at = smaller(larger(-dot(u, along) / norm_sq(along), 0), 1);
  return s.is_ellipsoid() ? norm_sq(u + at * along) < 1 : may_be_less_than_one(s, u, along, at);
}

void ShapeSearch::contacts(const PlacedGrain &grain, std::vector<ShapeContact> &found)
{
  find_near(grain, grain.shape.farthest, near_);
  contacts(grain, near_, found);
}

void ShapeSearch::contacts(const PlacedGrain &grain, NearFeatures &near,
                           std::vector<ShapeContact> &found)
{
  if (!is_near_anything(grain)) return;
  if (!find_by_owner(grain, near)) find_by_triangle(grain, near);
  add_contacts(grain, found);
}

// Is an edge within a flat patch, with a face on either side?
bool ShapeSearch::is_flat(std::uint32_t edge) const
{
  const int first = view_.edge_first[edge];
  if (view_.edge_first[edge + 1] - first != 2) return false;
  std::uint32_t of[2];
  Vec3 inward[2];
  for (int k = 0; k < 2; k++) {
    of[k] = view_.face_primitive[view_.edge_face[first + k]];
    const TreePrimitive &p = view_.primitives[of[k]];
    for (int side = 0; side < 3; side++)
      if (p.edge[side] == edge) inward[k] = p.inward[side];
  }
  return patches_[of[0]] == patches_[of[1]] && dot(inward[0], inward[1]) < 0;
}

void ShapeSearch::find_near(const PlacedGrain &grain, Real radius, NearFeatures &near)
{
  near.clear();
  if (!is_near_anything(grain)) return;
  faces_.clear();
  numbers_.clear();
  visit(grain, radius, [&](std::uint32_t primitive) {
    const TreePrimitive &p = view_.primitives[primitive];
    near.vertices.insert(near.vertices.end(), p.vertex, p.vertex + n_corners(p.code));
    if (feature_kind(p.code) == FeatureKind::vertex) return near.bare.push_back(primitive);
    numbers_.insert(numbers_.end(), p.edge, p.edge + (n_corners(p.code) == 3 ? 3 : 1));
    if (feature_kind(p.code) == FeatureKind::edge) return near.bare.push_back(primitive);
    faces_.push_back(primitive);
  });
  list_edges(near);
  for (const std::uint32_t primitive : faces_) list_face(near, primitive);
  std::sort(near.rim.begin(), near.rim.end(), [&](const auto &a, const auto &b) {
    return std::make_pair(patches_[a.primitive], a.primitive) <
           std::make_pair(patches_[b.primitive], b.primitive);
  });
  std::sort(near.inner.begin(), near.inner.end(), [&](std::uint32_t a, std::uint32_t b) {
    return std::make_pair(patches_[a], a) < std::make_pair(patches_[b], b);
  });
  std::uint32_t rim = 0, inner = 0;
  while (rim < near.rim.size() || inner < near.inner.size()) {
    std::uint32_t patch = kNoPrimitive;
    if (rim < near.rim.size()) patch = patches_[near.rim[rim].primitive];
    if (inner < near.inner.size()) patch = std::min(patch, patches_[near.inner[inner]]);
    NearFeatures::Plane plane = {view_.primitives[patch].normal,
                                 {0, 0, 0},
                                 {HUGE_VAL, HUGE_VAL, HUGE_VAL},
                                 {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL},
                                 0,
                                 0,
                                 kNoPrimitive};
    const auto take_in = [&](std::uint32_t face) {
      plane.likely = face;
      for (const std::uint32_t v : view_.primitives[face].vertex) {
        plane.point = view_.vertices[v];
        for (int k = 0; k < 3; k++) {
          plane.lo[k] = std::fmin(plane.lo[k], plane.point[k]);
          plane.hi[k] = std::fmax(plane.hi[k], plane.point[k]);
        }
      }
    };
    while (rim < near.rim.size() && patches_[near.rim[rim].primitive] == patch)
      take_in(near.rim[rim++].primitive);
    while (inner < near.inner.size() && patches_[near.inner[inner]] == patch)
      take_in(near.inner[inner++]);
    plane.rim_end = rim;
    plane.inner_end = inner;
    near.planes.push_back(plane);
  }
}

// Lists those edges of numbers_, and those vertices, that are whole and not within a flat patch.
void ShapeSearch::list_edges(NearFeatures &near)
{
  std::sort(numbers_.begin(), numbers_.end());
  std::sort(near.vertices.begin(), near.vertices.end());
  near.vertices.erase(std::unique(near.vertices.begin(), near.vertices.end()), near.vertices.end());
  // Of a vertex: all edges are near; one of them is not flat.
  whole_.clear();
  for (std::size_t i = 0, next; i < numbers_.size(); i = next) {
    const std::uint32_t e = numbers_[i];
    for (next = i; next < numbers_.size() && numbers_[next] == e; next++) {
    }
    const int n_faces = view_.edge_first[e + 1] - view_.edge_first[e];
    if (static_cast<int>(next - i) < n_faces) continue;
    whole_.push_back(e);
    if (!is_flat(e)) near.edges.push_back({e, {0, 0}});
  }
  const auto is_left_out = [&](std::uint32_t v) {
    const int *begin = view_.vertex_edge + view_.vertex_first[v],
              *end = view_.vertex_edge + view_.vertex_first[v + 1];
    bool is_flat_here = begin != end;
    for (const int *e = begin; e != end; e++) {
      if (!std::binary_search(whole_.begin(), whole_.end(), static_cast<std::uint32_t>(*e)))
        return true;
      is_flat_here &= is_flat(static_cast<std::uint32_t>(*e));
    }
    return is_flat_here;
  };
  near.vertices.erase(std::remove_if(near.vertices.begin(), near.vertices.end(), is_left_out),
                      near.vertices.end());
  for (NearFeatures::Edge &edge : near.edges)
    for (int k = 0; k < 2; k++)
      edge.vertex[k] = place_in(near.vertices, view_.edges[2 * edge.edge + k], SameNumber());
}

void ShapeSearch::list_face(NearFeatures &near, std::uint32_t primitive)
{
  const TreePrimitive &p = view_.primitives[primitive];
  NearFeatures::RimFace face = {primitive, {0, 0, 0}, {0, 0, 0}};
  bool has_any = false;
  for (int k = 0; k < 3; k++) {
    face.edge[k] = place_in(near.edges, p.edge[k], [](const auto &e) { return e.edge; });
    face.vertex[k] = place_in(near.vertices, p.vertex[k], SameNumber());
    has_any |= face.edge[k] < near.edges.size() || face.vertex[k] < near.vertices.size();
  }
  if (has_any)
    near.rim.push_back(face);
  else
    near.inner.push_back(primitive);
}

// Finds the contacts by the minimum over the plane of each face, which shows which of its features can be one: the distance
// is convex on a plane, so that from all places of a face it falls towards that minimum. Where it is inside it is the one
// contact of the face and its sides; no side and no corner is one from which it is inwards. What remains is looked at. Returns
// false where an overlap that is not less than the least radius of curvature is left over, which has to be found by triangles.
bool ShapeSearch::find_by_owner(const PlacedGrain &grain, NearFeatures &near)
{
  local_.clear();
  deep_.clear();
  passed_deep_ = false;
  list_cut(grain, near);
  // A foot is sure to this, but for rounding the same for all faces of a patch. Under a flat side it goes far by the rounding of
  // a normal.
  const Superellipsoid &s = grain.shape;
  const Real slender = s.farthest / s.nearest;
  const Real unsure =
      s.farthest *
      (s.is_ellipsoid() ? std::fmax(kSameFoot, kRounding * slender * slender) : kUnsureFoot);
  std::uint32_t rim = 0, inner = 0;
  owned_.assign(near.planes.size(), false);
  for (NearFeatures::Plane &plane : near.planes) {
    look_at_plane(grain, near, plane, rim, inner, unsure);
    rim = plane.rim_end;
    inner = plane.inner_end;
  }
  lines_.clear();
  look_at_likely_edges(grain, near, unsure);
  bool has_deep = false;
  for (std::uint32_t i = 0; i < near.vertices.size(); i++) {
    if (vertex_[i] == State::may_be) look_at_vertex(grain, near, i);
    has_deep |= vertex_[i] == State::is_deep;
  }
  for (std::uint32_t i = 0; i < near.edges.size(); i++) {
    if (edge_[i] == State::may_be) look_at_edge(grain, near, i);
    has_deep |= edge_[i] == State::is_deep;
  }
  return deep_are_passed(grain, near, has_deep) && !passed_deep_;
}

void ShapeSearch::look_at_plane(const PlacedGrain &grain, const NearFeatures &near,
                                NearFeatures::Plane &plane, std::uint32_t rim, std::uint32_t inner,
                                Real unsure)
{
  const Superellipsoid &s = grain.shape;
  const Real height = dot(plane.normal, plane.point - grain.centre), side = height < 0 ? -1 : 1;
  const Vec3 normal = side * plane.normal;
  Vec3 arm = {0, 0, 0};
  Real overlap = s.farthest - std::fabs(height);
  if (overlap > 0) {
    const SupportPlane tangent = support(s, grain.to_own(normal));
    overlap = tangent.height - std::fabs(height);
    arm = grain.turned(tangent.point);
  }
  if (!(overlap > 0)) {
    for (; rim < plane.rim_end; rim++) rule_out(near.rim[rim]);
    return;
  }
  const Vec3 point = grain.centre + arm;
  const bool is_deep = !(overlap < s.rho);
  if (is_deep && gauge_value(s, grain.own_point(point - overlap * normal)) < 1 &&
      has_foot(near, plane, rim, inner, point)) {
    owned_[static_cast<std::size_t>(&plane - near.planes.data())] = true;
  } else if (is_deep) {
    // On the ray to the point of the surface, so that it is in the grain.
    const Vec3 section = grain.centre + (std::fabs(height) / (std::fabs(height) + overlap)) * arm;
    for (; rim < plane.rim_end; rim++)
      if (is_cut(grain, near.rim[rim].primitive, section, &near.rim[rim]))
        deep_.push_back({near.rim[rim].primitive, &plane, &near.rim[rim]});
      else
        rule_out(near.rim[rim]);
    for (; inner < plane.inner_end; inner++)
      if (is_cut(grain, near.inner[inner], section, nullptr))
        deep_.push_back({near.inner[inner], &plane, nullptr});
    return;
  }
  const Real same = kSameFoot * s.farthest;
  const std::uint32_t first_rim = rim;
  bool has_foot = false;
  for (; rim < plane.rim_end; rim++) {
    const NearFeatures::RimFace &face = near.rim[rim];
    if (!may_be_at(face)) continue;
    const Inwards in = inwards_of(face.primitive, point);
    if (is_inside(near, face, in, same)) {
      add_face(grain, face.primitive, side, arm);
      rule_out(face);
      has_foot = true;
      continue;
    }
    // Without branches, which no processor could foresee.
    const int past[3] = {in[0] < unsure, in[1] < unsure, in[2] < unsure};
    leave(edge_[face.edge[0]], past[0]);
    leave(edge_[face.edge[1]], past[1]);
    leave(edge_[face.edge[2]], past[2]);
    leave(vertex_[face.vertex[0]], past[0] | past[2]);
    leave(vertex_[face.vertex[1]], past[1] | past[0]);
    leave(vertex_[face.vertex[2]], past[2] | past[1]);
  }
  if (has_foot || is_outside(plane, point - overlap * normal, same)) return;
  const Inwards likely = inwards_of(plane.likely, point);
  if ((likely[0] > same) & (likely[1] > same) & (likely[2] > same))
    return add_face(grain, plane.likely, side, arm);
  for (rim = first_rim; rim < plane.rim_end; rim++) {
    const NearFeatures::RimFace &face = near.rim[rim];
    if (may_be_at(face) || !is_inside(near, face, inwards_of(face.primitive, point), same))
      continue;
    add_face(grain, face.primitive, side, arm);
    plane.likely = face.primitive;
  }
  for (; inner < plane.inner_end; inner++) {
    const Inwards in = inwards_of(near.inner[inner], point);
    if (!((in[0] >= -same) & (in[1] >= -same) & (in[2] >= -same))) continue;
    add_face(grain, near.inner[inner], side, arm);
    plane.likely = near.inner[inner];
  }
}

// Is a point over one of the faces of a plane?
bool ShapeSearch::has_foot(const NearFeatures &near, const NearFeatures::Plane &plane,
                           std::uint32_t rim, std::uint32_t inner, const Vec3 &point) const
{
  for (; rim < plane.rim_end; rim++)
    if (is_inside(near, near.rim[rim], inwards_of(near.rim[rim].primitive, point), 0)) return true;
  for (; inner < plane.inner_end; inner++) {
    const Inwards in = inwards_of(near.inner[inner], point);
    if ((in[0] >= 0) & (in[1] >= 0) & (in[2] >= 0)) return true;
  }
  return false;
}

// Is a foot outside the box around the faces of a plane?
bool ShapeSearch::is_outside(const NearFeatures::Plane &plane, const Vec3 &foot, Real same)
{
  bool is = false;
  for (int k = 0; k < 3; k++) is |= (foot[k] < plane.lo[k] - same) | (foot[k] > plane.hi[k] + same);
  return is;
}

// Is a foot inside a face of the rim? On a side within a flat patch faces of the patch share it.
bool ShapeSearch::is_inside(const NearFeatures &near, const NearFeatures::RimFace &face,
                            const Inwards &in, Real same)
{
  const auto least = [&](int k) { return face.edge[k] == near.edges.size() ? -same : Real(0); };
  return (in[0] >= least(0)) & (in[1] >= least(1)) & (in[2] >= least(2));
}

// Can a feature of a face be a contact?
bool ShapeSearch::may_be_at(const NearFeatures::RimFace &face) const
{
  constexpr int kMay = static_cast<int>(State::may_be);
  int may = 0;
  for (int k = 0; k < 3; k++)
    may |= static_cast<int>(edge_[face.edge[k]]) | static_cast<int>(vertex_[face.vertex[k]]);
  return may & kMay;
}

// Begins with those edges and vertices that the grain may cut.
void ShapeSearch::list_cut(const PlacedGrain &grain, const NearFeatures &near)
{
  cut_.resize(near.edges.size());
  edge_.resize(near.edges.size() + 1);
  vertex_.resize(near.vertices.size() + 1);
  edge_.back() = vertex_.back() = State::cannot_be;
  for (std::size_t i = 0; i < near.vertices.size(); i++)
    vertex_[i] = may_hold(grain.shape, grain.own_point(view_.vertices[near.vertices[i]]))
                     ? State::may_be
                     : State::cannot_be;
  for (std::size_t i = 0; i < near.edges.size(); i++) {
    const int *ends = view_.edges + 2 * near.edges[i].edge;
    cut_[i] = may_cut(grain.shape, grain.own_point(view_.vertices[ends[0]]),
                      grain.own_point(view_.vertices[ends[1]]));
    edge_[i] = cut_[i] ? State::may_be : State::cannot_be;
  }
}

// Returns how far a point is from the sides of a face, inwards.
ShapeSearch::Inwards ShapeSearch::inwards_of(std::uint32_t face, const Vec3 &point) const
{
  const TreePrimitive &p = view_.primitives[face];
  const Vec3 at = point - view_.vertices[p.vertex[0]];
  return {dot(p.inward[0], at), dot(p.inward[1], at) + p.height, dot(p.inward[2], at)};
}

// Adds the minimum inside a face, where the grain's point is `arm` from its centre.
void ShapeSearch::add_face(const PlacedGrain &grain, std::uint32_t face, Real side, const Vec3 &arm)
{
  const TreePrimitive &p = view_.primitives[face];
  const Vec3 out = side * p.normal;
  const Real distance = dot(out, view_.vertices[p.vertex[0]] - grain.centre - arm);
  if (!(distance < 0)) return;    // by another rounding than that of the plane
  const Vec3 normal = grain.to_own(out), foot = grain.to_own(arm) + distance * normal;
  local_.push_back(
      {{distance, normal, normal, foot, TrianglePart::face, 0, true, true}, p.code, face});
}

// Is each place where the overlap is not less than the least radius of curvature at a face that has its minimum elsewhere?
bool ShapeSearch::deep_are_passed(const PlacedGrain &grain, const NearFeatures &near, bool has_deep)
{
  for (const DeepFace &face : deep_)
    if (!(face.rim && has_minimum(*face.rim)) && !is_passed(grain, near, face)) return false;
  if (!has_deep) return true;
  for (const NearFeatures::RimFace &face : near.rim) {
    if (!has_minimum(face)) continue;
    for (int k = 0; k < 3; k++) {
      if (edge_[face.edge[k]] == State::is_deep) edge_[face.edge[k]] = State::cannot_be;
      if (vertex_[face.vertex[k]] == State::is_deep) vertex_[face.vertex[k]] = State::cannot_be;
    }
  }
  return std::find(edge_.begin(), edge_.end(), State::is_deep) == edge_.end() &&
         std::find(vertex_.begin(), vertex_.end(), State::is_deep) == vertex_.end();
}

// Is a minimum in the plane of a deep face one from which the distance does not fall towards the face? Then that of the plane
// is not in the face.
bool ShapeSearch::is_passed(const PlacedGrain &grain, const NearFeatures &near,
                            const DeepFace &deep) const
{
  const std::size_t plane = deep.plane - near.planes.data();
  const TreePrimitive &p = view_.primitives[deep.primitive];
  for (std::uint32_t i = plane > 0 ? deep.plane[-1].rim_end : 0; i < deep.plane->rim_end; i++) {
    const NearFeatures::RimFace &face = near.rim[i];
    if (!has_minimum(face)) continue;
    for (const Minimum &m : local_) {
      bool is_here = false;
      for (int k = 0; k < 3; k++)
        is_here |= m.feature ==
                       feature_code(FeatureKind::edge, view_.primitives[face.primitive].edge[k]) ||
                   m.feature == feature_code(FeatureKind::vertex,
                                             view_.primitives[face.primitive].vertex[k]);
      for (int k = 0; k < 3 && is_here; k++)
        is_here =
            dot(m.at.normal, corner_of(grain, p, k) - m.at.foot) >= -kLevel * grain.shape.farthest;
      if (is_here) return true;
    }
  }
  return false;
}

bool ShapeSearch::has_minimum(const NearFeatures::RimFace &face) const
{
  bool has = false;
  for (int k = 0; k < 3; k++)
    has |= edge_[face.edge[k]] == State::is || vertex_[face.vertex[k]] == State::is;
  return has;
}

void ShapeSearch::rule_out(const NearFeatures::RimFace &face)
{
  for (int k = 0; k < 3; k++) edge_[face.edge[k]] = vertex_[face.vertex[k]] = State::cannot_be;
}

void ShapeSearch::look_at_vertex(const PlacedGrain &grain, const NearFeatures &near,
                                 std::uint32_t i)
{
  vertex_[i] = State::cannot_be;
  const Vec3 y = grain.own_point(view_.vertices[near.vertices[i]]);
  if (!(gauge_value(grain.shape, y) < 1)) return;
  const SurfacePoint p = nearest_on_surface(grain.shape, y);
  if (!(p.distance < 0)) return;
  if (!p.is_sure || !(-p.distance < grain.shape.rho)) {
    vertex_[i] = State::is_deep;
    return;
  }
  const Minimum m = {{p.distance, p.normal, p.normal, y, TrianglePart::corner, 0, true, true},
                     feature_code(FeatureKind::vertex, near.vertices[i]),
                     kNoPrimitive};
  if (!rises_around(grain, m)) return;
  vertex_[i] = State::is;
  local_.push_back(m);
}

// Looks first at the edges inside which an ellipsoid of the same half-axes is deepest: where the foot is surely inside one, neither its ends
// nor others of its line are looked at. What depends on its ends, or is deep, is left for later.
void ShapeSearch::look_at_likely_edges(const PlacedGrain &grain, const NearFeatures &near,
                                       Real unsure)
{
  const Superellipsoid &s = grain.shape;
  const auto scaled = [&](const Vec3 &x) {
    return Vec3{x.x / s.half.x, x.y / s.half.y, x.z / s.half.z};
  };
  for (std::uint32_t i = 0; i < near.edges.size(); i++) {
    if (edge_[i] != State::may_be) continue;
    const EdgeOfGrain edge = edge_of(grain, near, i);
    const Vec3 from = scaled(edge.from), way = scaled(edge.to) - from;
    const Real towards = -dot(from, way);
    if (!(towards > 0 && towards < norm_sq(way))) continue;
    if (is_off_a_line(s, edge.from, edge.to)) {
      edge_[i] = State::cannot_be;
      continue;
    }
    const EdgeMinimum m = minimum_of(s, edge);
    const bool is_deep = !m.line.is_highest || !(-m.line.distance < s.rho);
    if (m.line.distance < 0 &&
        (is_deep || (m.is_here && !(m.at > unsure && m.at < m.length - unsure))))
      continue;
    settle_edge(grain, near, i, edge, m);
    if (edge_[i] == State::is)
      for (const std::uint32_t v : near.edges[i].vertex) leave(vertex_[v], 0);
  }
}

void ShapeSearch::look_at_edge(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i)
{
  const std::uint32_t *vertex = near.edges[i].vertex;
  edge_[i] = State::cannot_be;
  if (vertex_[vertex[0]] == State::is || vertex_[vertex[1]] == State::is) return;
  const EdgeOfGrain edge = edge_of(grain, near, i);
  if (is_off_a_line(grain.shape, edge.from, edge.to)) return;
  settle_edge(grain, near, i, edge, minimum_of(grain.shape, edge));
}

ShapeSearch::EdgeOfGrain ShapeSearch::edge_of(const PlacedGrain &grain, const NearFeatures &near,
                                              std::uint32_t i) const
{
  const int *ends = view_.edges + 2 * near.edges[i].edge;
  return {grain.own_point(view_.vertices[ends[0]]), grain.own_point(view_.vertices[ends[1]])};
}

ShapeSearch::EdgeMinimum ShapeSearch::minimum_of(const Superellipsoid &s, const EdgeOfGrain &edge)
{
  EdgeMinimum m;
  m.length = norm(edge.to - edge.from);
  m.along = (1 / m.length) * (edge.to - edge.from);
  m.line = TangentAboutLine(s, edge.from, m.along).find();
  m.at = dot(m.line.foot - edge.from, m.along);
  m.is_here = m.at > 0 && m.at < m.length;
  return m;
}

// Says by the minimum over its line whether an edge is a contact.
void ShapeSearch::settle_edge(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i,
                              const EdgeOfGrain &of, const EdgeMinimum &on)
{
  const Superellipsoid &s = grain.shape;
  const TangentMinimum &line = on.line;
  const auto &[from, to] = of;
  edge_[i] = State::cannot_be;
  if (!(line.distance < 0)) return;
  const bool is_deep = !line.is_highest || !(-line.distance < s.rho), is_here = on.is_here;
  if (!line.is_highest || (is_deep && !(is_here && is_contact(s, line)))) {
    if (is_in_reach(grain, segment_distance(from, to, {0, 0, 0}))) edge_[i] = State::is_deep;
    return;
  }
  lines_.push_back({from, on.along, line.foot});
  if (!is_here) return;
  const Minimum m = {
      {line.distance, line.normal, line.normal, line.foot, TrianglePart::edge, 0, true, true},
      feature_code(FeatureKind::edge, near.edges[i].edge),
      kNoPrimitive};
  if (!rises_around(grain, m)) {
    passed_deep_ |= is_deep;
    return;
  }
  edge_[i] = State::is;
  local_.push_back(m);
}

// Does a segment lie on a line of which the minimum is known, and not there?
bool ShapeSearch::is_off_a_line(const Superellipsoid &s, const Vec3 &from, const Vec3 &to) const
{
  constexpr Real kSameLine = 1e-13;
  const Real unsure = kUnsureFoot * s.farthest;
  for (const Line &line : lines_) {
    const Vec3 begin = from - line.from, end = to - line.from;
    const Real at = dot(begin, line.along), to_at = dot(end, line.along);
    const Real apart = kSameLine * s.farthest;
    if (norm_sq(begin - at * line.along) > apart * apart ||
        norm_sq(end - to_at * line.along) > apart * apart)
      continue;
    const Real foot = dot(line.foot - line.from, line.along);
    if (foot < std::fmin(at, to_at) - unsure || foot > std::fmax(at, to_at) + unsure) return true;
  }
  return false;
}

// Finds the contacts by the minimum of each triangle. Past the least radius of curvature the tangents of some features and the gradients at
// others may each pass the contact on: then the deepest minimum of each connected piece of the surface in the grain is one.
void ShapeSearch::find_by_triangle(const PlacedGrain &grain, const NearFeatures &near)
{
  minima_.clear();
  const auto look_at = [&](std::uint32_t primitive, bool is_owned) {
    if (!is_beside(grain, primitive)) add(contact_minimum(grain, primitive, is_owned), primitive);
  };
  std::uint32_t rim = 0, inner = 0;
  for (std::size_t i = 0; i < near.planes.size(); i++) {
    const NearFeatures::Plane &plane = near.planes[i];
    for (; rim < plane.rim_end; rim++) look_at(near.rim[rim].primitive, owned_[i]);
    for (; inner < plane.inner_end; inner++) look_at(near.inner[inner], owned_[i]);
  }
  for (const std::uint32_t primitive : near.bare) look_at(primitive, false);
  std::sort(minima_.begin(), minima_.end(), [](const Minimum &a, const Minimum &b) {
    return a.feature != b.feature           ? a.feature < b.feature
           : a.at.distance != b.at.distance ? a.at.distance < b.at.distance
                                            : a.primitive < b.primitive;
  });
  local_.clear();
  find_pieces(grain);
  deepest_.assign(minima_.size(), nullptr);
  has_contact_.assign(minima_.size(), false);
  for (std::uint32_t i = 0; i < minima_.size(); i++) {
    const Minimum &m = minima_[i], *&deepest = deepest_[piece_of(i)];
    if (!deepest || m.at.distance < deepest->at.distance) deepest = &m;
    if ((i > 0 && m.feature == minima_[i - 1].feature) || !is_local(grain, m)) continue;
    has_contact_[piece_of(i)] = true;
    local_.push_back(m);
  }
  for (std::size_t i = 0; i < minima_.size(); i++)
    if (deepest_[i] && !has_contact_[i]) local_.push_back(*deepest_[i]);
}

// Finds which minima are of one connected piece of the surface in the grain: of triangles that share an edge there, or a vertex.
void ShapeSearch::find_pieces(const PlacedGrain &grain)
{
  piece_.resize(minima_.size());
  std::iota(piece_.begin(), piece_.end(), 0);
  shared_.clear();
  for (std::uint32_t i = 0; i < minima_.size(); i++) {
    const TreePrimitive &p = view_.primitives[minima_[i].primitive];
    const int n = n_corners(p.code);
    for (int k = 0; k < (n == 3 ? 3 : n - 1); k++) {
      const int *ends = view_.edges + 2 * p.edge[k];
      if (may_cut(grain.shape, grain.own_point(view_.vertices[ends[0]]),
                  grain.own_point(view_.vertices[ends[1]])))
        shared_.push_back({feature_code(FeatureKind::edge, p.edge[k]), i});
    }
    for (int k = 0; k < n; k++)
      if (gauge_value(grain.shape, corner_of(grain, p, k)) < 1)
        shared_.push_back({feature_code(FeatureKind::vertex, p.vertex[k]), i});
  }
  std::sort(shared_.begin(), shared_.end());
  for (std::size_t k = 1; k < shared_.size(); k++) {
    if (shared_[k].first != shared_[k - 1].first) continue;
    const std::uint32_t a = piece_of(shared_[k].second), b = piece_of(shared_[k - 1].second);
    piece_[std::max(a, b)] = std::min(a, b);
  }
}

// Returns the lowest minimum of the piece that a minimum is of.
std::uint32_t ShapeSearch::piece_of(std::uint32_t minimum)
{
  while (piece_[minimum] != minimum) minimum = piece_[minimum] = piece_[piece_[minimum]];
  return minimum;
}

// Adds the local minima to `found`, in the order of their features.
void ShapeSearch::add_contacts(const PlacedGrain &grain, std::vector<ShapeContact> &found)
{
  std::sort(local_.begin(), local_.end(),
            [](const Minimum &a, const Minimum &b) { return a.feature < b.feature; });
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
    for (int a = 0; a < 3; a++) lo[a] = smaller(lo[a], c[a]), hi[a] = larger(hi[a], c[a]);
  }
  for (int a = 0; a < 3; a++)
    if (lo[a] > grain.shape.half[a] || hi[a] < -grain.shape.half[a]) return true;
  return false;
}

// May the grain cut a face, of whose plane it has the point `section` in it? What it cuts of the plane is convex, so that without a
// side that it cuts the face has all of it or none. All that is in reach is in every list, so that contacts are found in the same way,
// and to the same bits, whatever else a list has.
bool ShapeSearch::is_cut(const PlacedGrain &grain, std::uint32_t primitive, const Vec3 &section,
                         const NearFeatures::RimFace *rim) const
{
  const TreePrimitive &p = view_.primitives[primitive];
  const Inwards in = inwards_of(primitive, section);
  bool may = (in[0] >= 0) & (in[1] >= 0) & (in[2] >= 0);
  const auto is_listed = [&](int k) { return rim && rim->edge[k] < cut_.size(); };
  for (int k = 0; k < 3; k++) may |= is_listed(k) && cut_[rim->edge[k]];
  for (int k = 0; k < 3 && !may; k++)
    if (!is_listed(k))
      may = may_cut(grain.shape, corner_of(grain, p, k), corner_of(grain, p, k == 2 ? 0 : k + 1));
  FeatureCode nearest = kNoFeature;
  return may && is_in_reach(grain, view_.exact(primitive, grain.centre, nearest));
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

// Returns the minimum of a primitive as a contact has it, if it is less than 0.
ShapeMinimum ShapeSearch::contact_minimum(const PlacedGrain &grain, std::uint32_t primitive,
                                          bool is_owned) const
{
  const TreePrimitive &p = view_.primitives[primitive];
  if (feature_kind(p.code) != FeatureKind::face) return minimum_of(grain, primitive, 0);
  Vec3 corner[3];
  for (int k = 0; k < 3; k++) corner[k] = corner_of(grain, p, k);
  return sure(TriangleMinimum(grain.shape, corner, grain.to_own(p.normal)).find_contact(is_owned));
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
    each_face(view_, m.feature, [&](int face) {
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
  each_face(view_, m.feature, [&](int face) {
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
  each_face(view_, a, [&](int face) {
    around.insert(around.end(), view_.faces + 3 * face, view_.faces + 3 * face + 3);
  });
  bool share = false;
  each_face(view_, b, [&](int face) {
    for (int k = 0; k < 3; k++)
      share |= std::find(around.begin(), around.end(), view_.faces[3 * face + k]) != around.end();
  });
  return share;
}

}    // namespace lsdcd
