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

// Returns a point of the grain's frame over these lengths.
Vec3 scaled(const Vec3 &y, const Vec3 &inverse)
{
  return {y.x * inverse.x, y.y * inverse.y, y.z * inverse.z};
}
Vec3 inverse_of(const Vec3 &half)
{
  return {1 / half.x, 1 / half.y, 1 / half.z};
}

// Can a point, over the half-axes, be within the grain? By its box, and an ellipsoid as a ball.
bool may_hold(const Superellipsoid &s, const Vec3 &u)
{
  if (s.is_ellipsoid()) return norm_sq(u) < 1;
  return (std::fabs(u.x) < 1) & (std::fabs(u.y) < 1) & (std::fabs(u.z) < 1);
}

// Returns half the sides of a box around the grain with the axes of the mesh: of an ellipsoid the least one.
Vec3 half_box(const PlacedGrain &grain)
{
  const Superellipsoid &s = grain.shape;
  Vec3 half;
  for (int k = 0; k < 3; k++) {
    const Vec3 &row = grain.row[k];
    const Vec3 part = {row.x * s.half.x, row.y * s.half.y, row.z * s.half.z};
    half[k] = s.is_ellipsoid()
                  ? norm(part)
                  : smaller(std::fabs(part.x) + std::fabs(part.y) + std::fabs(part.z), s.farthest);
  }
  return half;
}

// Is a box about a point, with half its sides, outside the box around the faces of a plane?
bool is_outside(const NearFeatures::Plane &plane, const Vec3 &at, const Vec3 &half)
{
  const auto is_apart = [&](Real at, Real half, Real lo, Real hi) {
    return (at < lo - half) | (at > hi + half);
  };
  return is_apart(at.x, half.x, plane.lo.x, plane.hi.x) |
         is_apart(at.y, half.y, plane.lo.y, plane.hi.y) |
         is_apart(at.z, half.z, plane.lo.z, plane.hi.z);
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

// Where a segment, by its ends over the half-axes, comes nearest to the centre of an ellipsoid.
struct NearestToCentre {
  Vec3 along;
  Real at;    // the share of the way from the first end
  bool is_in_ellipsoid;

  NearestToCentre(const Vec3 &u, const Vec3 &v) :
      along(v - u), at(smaller(larger(-dot(u, along) / norm_sq(along), 0), 1)),
      is_in_ellipsoid(norm_sq(u + at * along) < 1)
  {
  }
};

// Is a segment, by its ends over the half-axes, on the outer side of one of the faces of the box around the grain?
bool is_beside_box(const Vec3 &u, const Vec3 &v)
{
  const auto is_beside = [](Real a, Real b) { return (smaller(a, b) >= 1) | (larger(a, b) <= -1); };
  return is_beside(u.x, v.x) | is_beside(u.y, v.y) | is_beside(u.z, v.z);
}

// Can a segment cut the grain, by its ends over the half-axes? A grain has the ellipsoid of its half-axes in it.
bool may_cut_scaled(const Superellipsoid &s, const Vec3 &u, const Vec3 &v)
{
  if (is_beside_box(u, v)) return false;
  const NearestToCentre nearest(u, v);
  return nearest.is_in_ellipsoid ||
         (!s.is_ellipsoid() && may_be_less_than_one(s, u, nearest.along, nearest.at));
}

// Returns the place of a number in the ascending part of a list between two places, the size of the list where it is not there.
template <class List, class NumberOf>
std::uint32_t place_in(const List &list, std::size_t from, std::size_t to, std::uint32_t number,
                       const NumberOf &number_of)
{
  const auto place = [&](std::size_t i) { return list.begin() + static_cast<std::ptrdiff_t>(i); };
  const auto at =
      std::lower_bound(place(from), place(to), number,
                       [&](const auto &a, std::uint32_t b) { return number_of(a) < b; });
  return static_cast<std::uint32_t>(at != place(to) && number_of(*at) == number
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
  const Vec3 inverse = inverse_of((1 - depth / s.farthest) * s.half);
  return may_cut_scaled(s, scaled(from, inverse), scaled(to, inverse));
}

void ShapeSearch::contacts(const PlacedGrain &grain, std::vector<FoundGrainContact> &found)
{
  find_near(grain, grain.shape.farthest, near_);
  contacts(grain, near_, found);
}

void ShapeSearch::contacts(const PlacedGrain &grain, NearFeatures &near,
                           std::vector<FoundGrainContact> &found)
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
                                 kNoPrimitive,
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
    while (rim < near.rim.size() && patches_[near.rim[rim].primitive] == patch) {
      plane.likely_rim = rim;
      near.rim[rim].plane = static_cast<std::uint32_t>(near.planes.size());
      take_in(near.rim[rim++].primitive);
    }
    while (inner < near.inner.size() && patches_[near.inner[inner]] == patch) {
      plane.likely_rim = kNoPrimitive;
      take_in(near.inner[inner++]);
    }
    plane.rim_end = rim;
    plane.inner_end = inner;
    near.planes.push_back(plane);
  }
  list_faces_at(near);
}

// Lists the faces at each edge and each vertex that can have a contact.
void ShapeSearch::list_faces_at(NearFeatures &near) const
{
  const auto list = [&](std::size_t n, NearFeatures::FacesAt &at, const auto &number) {
    at.end.assign(n + 1, 0);
    const auto each = [&](const auto &part) {
      for (std::uint32_t r = 0; r < near.rim.size(); r++)
        for (std::uint32_t k = 0; k < 3; k++)
          if (number(near.rim[r], k) < n) part(number(near.rim[r], k), r, k);
    };
    each([&](std::uint32_t i, std::uint32_t, std::uint32_t) { at.end[i + 1]++; });
    std::partial_sum(at.end.begin(), at.end.end(), at.end.begin());
    at.parts.resize(at.end.back());
    each([&](std::uint32_t i, std::uint32_t r, std::uint32_t k) {
      at.parts[at.end[i]++] = {r, k};
    });
    at.end.pop_back();
  };
  list(near.edges.size(), near.faces_at_edge,
       [](const NearFeatures::RimFace &face, std::uint32_t k) { return face.edge[k]; });
  list(near.n_whole, near.faces_at_vertex,
       [](const NearFeatures::RimFace &face, std::uint32_t k) { return face.vertex[k]; });
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
    if (!is_flat(e)) near.edges.push_back({e, {0, 0}, false});
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
  near.n_whole = near.vertices.size();
  const auto place_of = [&](std::uint32_t v) {
    const std::uint32_t of_whole = place_in(near.vertices, 0, near.n_whole, v, SameNumber());
    if (of_whole < near.vertices.size()) return of_whole;
    return place_in(near.vertices, near.n_whole, near.vertices.size(), v, SameNumber());
  };
  numbers_.clear();
  for (const NearFeatures::Edge &edge : near.edges)
    for (int k = 0; k < 2; k++) numbers_.push_back(view_.edges[2 * edge.edge + k]);
  std::sort(numbers_.begin(), numbers_.end());
  numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
  for (const std::uint32_t v : numbers_)
    if (place_of(v) == near.vertices.size()) near.vertices.push_back(v);
  for (NearFeatures::Edge &edge : near.edges)
    for (int k = 0; k < 2; k++) edge.vertex[k] = place_of(view_.edges[2 * edge.edge + k]);
}

void ShapeSearch::list_face(NearFeatures &near, std::uint32_t primitive)
{
  const TreePrimitive &p = view_.primitives[primitive];
  NearFeatures::RimFace face = {primitive, 0, {0, 0, 0}, {0, 0, 0}};
  bool has_any = false;
  for (int k = 0; k < 3; k++) {
    face.edge[k] =
        place_in(near.edges, 0, near.edges.size(), p.edge[k], [](const auto &e) { return e.edge; });
    face.vertex[k] = place_in(near.vertices, 0, near.n_whole, p.vertex[k], SameNumber());
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
  // One plane alone is always reached.
  const Vec3 half =
      near.planes.size() > 1 ? half_box(grain) : Vec3{s.farthest, s.farthest, s.farthest};
  planes_.resize(near.planes.size());
  for (std::size_t i = 0; i < near.planes.size(); i++) look_at_plane(grain, near, i, half);
  if (near.vertices.empty()) return deep_.empty();
  leave_out_passed(grain, near, unsure);
  lines_.clear();
  looked_at_.clear();
  look_at_likely_edges(grain, near, unsure);
  bool has_deep = false;
  for (std::uint32_t i = 0; i < near.n_whole; i++) {
    if (vertex_[i] == State::may_be) look_at_vertex(grain, near, i);
    has_deep |= vertex_[i] == State::is_deep;
  }
  for (std::uint32_t i = 0; i < near.edges.size(); i++) {
    if (edge_[i] == State::may_be) look_at_edge(grain, near, i);
    has_deep |= edge_[i] == State::is_deep;
    near.edges[i].is_likely = edge_[i] == State::is;
  }
  return deep_are_passed(grain, near, has_deep) && !passed_deep_;
}

// Says where the grain is to a plane, and finds the contact inside its faces. `half`: of the box around the grain.
void ShapeSearch::look_at_plane(const PlacedGrain &grain, NearFeatures &near, std::size_t i,
                                const Vec3 &half)
{
  const Superellipsoid &s = grain.shape;
  const NearFeatures::Plane &plane = near.planes[i];
  AtPlane &at = planes_[i];
  at = {Side::out_of_reach, false, 1, {0, 0, 0}};
  const Real height = dot(plane.normal, plane.point - grain.centre);
  if (!(std::fabs(height) < s.farthest) || is_outside(plane, grain.centre, half)) return;
  at.towards = height < 0 ? -1 : 1;
  const Vec3 normal = at.towards * plane.normal;
  const SupportPlane tangent = support(s, grain.to_own(normal));
  const Real overlap = tangent.height - std::fabs(height);
  if (!(overlap > 0)) return;
  at.side = Side::in_reach;
  at.arm = grain.turned(tangent.point);
  const Vec3 point = grain.centre + at.arm, foot = point - overlap * normal;
  const Real same = kSameFoot * s.farthest;
  const bool is_elsewhere = is_outside(plane, foot, {same, same, same});
  if (!(overlap < s.rho)) {
    at.is_owned = !is_elsewhere && gauge_value(s, grain.own_point(foot)) < 1 &&
                  has_foot(near, i, point) &&
                  (has_all_cut(grain, near, i) || !is_shallow(s, grain.own_point(foot)));
    // On the ray to the point of the surface, so that it is in the grain.
    if (!at.is_owned)
      return look_at_deep_plane(grain, near, i,
                                grain.centre +
                                    (std::fabs(height) / (std::fabs(height) + overlap)) * at.arm);
  }
  if (!is_elsewhere) find_foot(grain, near, i);
}

// Have the faces of a plane, with a place in the grain, all that the grain cuts of it? Then it is past the plane, and not past the end of
// the faces alone.
bool ShapeSearch::has_all_cut(const PlacedGrain &grain, const NearFeatures &near, std::size_t i)
{
  for (std::uint32_t r = near.rim_begin(i); r < near.planes[i].rim_end; r++)
    for (const std::uint32_t edge : near.rim[r].edge)
      if (edge < near.edges.size() && is_edge_cut(grain, near, edge)) return false;
  return true;
}

// Notes the faces of a plane that the grain may cut. `section`: a point of the plane that is in the grain.
void ShapeSearch::look_at_deep_plane(const PlacedGrain &grain, const NearFeatures &near,
                                     std::size_t i, const Vec3 &section)
{
  const NearFeatures::Plane &plane = near.planes[i];
  planes_[i].side = Side::is_deep;
  for (std::uint32_t r = near.rim_begin(i); r < plane.rim_end; r++)
    if (is_cut(grain, near, near.rim[r].primitive, section, &near.rim[r]))
      deep_.push_back({near.rim[r].primitive, &plane, &near.rim[r]});
    else
      rule_out(near.rim[r]);
  for (std::uint32_t k = near.inner_begin(i); k < plane.inner_end; k++)
    if (is_cut(grain, near, near.inner[k], section, nullptr))
      deep_.push_back({near.inner[k], &plane, nullptr});
}

// Adds the contact inside a face of a plane, if one has its foot: then it is that of the sides and corners of the face, too.
void ShapeSearch::find_foot(const PlacedGrain &grain, NearFeatures &near, std::size_t i)
{
  NearFeatures::Plane &plane = near.planes[i];
  const auto &[side, is_owned, towards, arm] = planes_[i];
  const Vec3 point = grain.centre + arm;
  const Real same = kSameFoot * grain.shape.farthest;
  const Inwards likely = inwards_of(plane.likely, point);
  if ((likely[0] > same) & (likely[1] > same) & (likely[2] > same)) {
    if (plane.likely_rim != kNoPrimitive) rule_out(near.rim[plane.likely_rim]);
    return add_face(grain, plane.likely, towards, arm);
  }
  for (std::uint32_t r = near.rim_begin(i); r < plane.rim_end; r++) {
    const NearFeatures::RimFace &face = near.rim[r];
    if (!is_inside(near, face, inwards_of(face.primitive, point), same)) continue;
    add_face(grain, face.primitive, towards, arm);
    rule_out(face);
    plane.likely = face.primitive;
    plane.likely_rim = r;
  }
  for (std::uint32_t k = near.inner_begin(i); k < plane.inner_end; k++) {
    const Inwards in = inwards_of(near.inner[k], point);
    if (!((in[0] >= -same) & (in[1] >= -same) & (in[2] >= -same))) continue;
    add_face(grain, near.inner[k], towards, arm);
    plane.likely = near.inner[k];
    plane.likely_rim = kNoPrimitive;
  }
}

// Leaves out edges and vertices at planes that the grain does not reach, and those from which the foot of a plane is inwards.
void ShapeSearch::leave_out_passed(const PlacedGrain &grain, const NearFeatures &near, Real unsure)
{
  const auto is_passed = [&](const NearFeatures::PartOfFace &part, bool is_vertex) {
    const NearFeatures::RimFace &face = near.rim[part.rim];
    const AtPlane &at = planes_[face.plane];
    if (at.side != Side::in_reach) return at.side == Side::out_of_reach;
    const Inwards in = inwards_of(face.primitive, grain.centre + at.arm);
    return !(in[part.k] < unsure) && !(is_vertex && in[part.k == 0 ? 2 : part.k - 1] < unsure);
  };
  const auto leave_out = [&](std::vector<State> &state, const NearFeatures::FacesAt &faces,
                             bool is_vertex) {
    for (std::size_t i = 0; i < faces.end.size(); i++)
      for (std::size_t k = faces.begin_of(i); k < faces.end[i] && state[i] == State::may_be; k++)
        if (is_passed(faces.parts[k], is_vertex)) state[i] = State::cannot_be;
  };
  leave_out(edge_, near.faces_at_edge, false);
  leave_out(vertex_, near.faces_at_vertex, true);
}

// Is a point over one of the faces of a plane?
bool ShapeSearch::has_foot(const NearFeatures &near, std::size_t plane, const Vec3 &point) const
{
  for (std::uint32_t r = near.rim_begin(plane); r < near.planes[plane].rim_end; r++)
    if (is_inside(near, near.rim[r], inwards_of(near.rim[r].primitive, point), 0)) return true;
  for (std::uint32_t k = near.inner_begin(plane); k < near.planes[plane].inner_end; k++) {
    const Inwards in = inwards_of(near.inner[k], point);
    if ((in[0] >= 0) & (in[1] >= 0) & (in[2] >= 0)) return true;
  }
  return false;
}

// Is a foot inside a face of the rim? On a side within a flat patch faces of the patch share it.
bool ShapeSearch::is_inside(const NearFeatures &near, const NearFeatures::RimFace &face,
                            const Inwards &in, Real same)
{
  const auto least = [&](int k) { return face.edge[k] == near.edges.size() ? -same : Real(0); };
  return (in[0] >= least(0)) & (in[1] >= least(1)) & (in[2] >= least(2));
}

// Begins with those edges and vertices that the grain may cut; of some edges of a superellipsoid that is asked later.
void ShapeSearch::list_cut(const PlacedGrain &grain, const NearFeatures &near)
{
  const std::size_t n = near.vertices.size();
  if (n == 0) return;
  const Vec3 inverse = inverse_of(grain.shape.half);
  own_.resize(n);
  scaled_.resize(n);
  cut_.resize(near.edges.size());
  edge_.resize(near.edges.size() + 1);
  vertex_.resize(n + 1);
  edge_.back() = vertex_.back() = State::cannot_be;
  for (std::size_t i = 0; i < n; i++) {
    own_[i] = grain.own_point(view_.vertices[near.vertices[i]]);
    scaled_[i] = scaled(own_[i], inverse);
    vertex_[i] =
        i < near.n_whole && may_hold(grain.shape, scaled_[i]) ? State::may_be : State::cannot_be;
  }
  for (std::size_t i = 0; i < near.edges.size(); i++) {
    const std::uint32_t *ends = near.edges[i].vertex;
    const Vec3 &from = scaled_[ends[0]], &to = scaled_[ends[1]];
    cut_[i] = is_beside_box(from, to)                     ? Cut::no
              : NearestToCentre(from, to).is_in_ellipsoid ? Cut::yes
              : grain.shape.is_ellipsoid()                ? Cut::no
                                                          : Cut::not_asked;
    edge_[i] = cut_[i] == Cut::no ? State::cannot_be : State::may_be;
  }
}

// May the grain cut an edge of the list?
bool ShapeSearch::is_edge_cut(const PlacedGrain &grain, const NearFeatures &near, std::size_t i)
{
  if (cut_[i] == Cut::not_asked) {
    const std::uint32_t *ends = near.edges[i].vertex;
    cut_[i] = may_cut_scaled(grain.shape, scaled_[ends[0]], scaled_[ends[1]]) ? Cut::yes : Cut::no;
  }
  return cut_[i] == Cut::yes;
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
  for (std::uint32_t i = near.rim_begin(plane); i < deep.plane->rim_end; i++) {
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
  const Vec3 &y = own_[i];
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

// Looks first at the edges that had a contact, then at those inside which an ellipsoid of the same half-axes is deepest, and leaves
// out those that the grain does not cut.
void ShapeSearch::look_at_likely_edges(const PlacedGrain &grain, const NearFeatures &near,
                                       Real unsure)
{
  for (std::uint32_t i = 0; i < near.edges.size(); i++)
    if (edge_[i] == State::may_be && near.edges[i].is_likely)
      look_inside_edge(grain, near, i, unsure);
  for (std::uint32_t i = 0; i < near.edges.size(); i++) {
    const NearFeatures::Edge &edge = near.edges[i];
    if (edge_[i] != State::may_be || edge.is_likely) continue;
    if (is_off_a_line(grain.shape, edge_of(edge)) || !is_edge_cut(grain, near, i)) {
      edge_[i] = State::cannot_be;
      continue;
    }
    const Vec3 &from = scaled_[edge.vertex[0]], way = scaled_[edge.vertex[1]] - from;
    const Real towards = -dot(from, way);
    if (towards > 0 && towards < norm_sq(way)) look_inside_edge(grain, near, i, unsure);
  }
}

// Looks at an edge. Where the foot is surely inside, neither its ends nor others of its line are looked at. What depends on its ends, or
// is deep, is left for later.
void ShapeSearch::look_inside_edge(const PlacedGrain &grain, const NearFeatures &near,
                                   std::uint32_t i, Real unsure)
{
  const Superellipsoid &s = grain.shape;
  const EdgeOfGrain edge = edge_of(near.edges[i]);
  const EdgeMinimum m = minimum_of(s, edge);
  const bool is_deep = !m.line.is_highest || !(-m.line.distance < s.rho);
  if (m.line.distance < 0 &&
      (is_deep || (m.is_here && !(m.at > unsure && m.at < m.length - unsure)))) {
    looked_at_.push_back({i, m});
    return;
  }
  settle_edge(grain, near, i, edge, m);
  if (edge_[i] == State::is)
    for (const std::uint32_t v : near.edges[i].vertex) vertex_[v] = State::cannot_be;
}

void ShapeSearch::look_at_edge(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i)
{
  const std::uint32_t *vertex = near.edges[i].vertex;
  edge_[i] = State::cannot_be;
  if (vertex_[vertex[0]] == State::is || vertex_[vertex[1]] == State::is) return;
  const EdgeOfGrain edge = edge_of(near.edges[i]);
  if (is_off_a_line(grain.shape, edge)) return;
  const auto known = std::find_if(looked_at_.begin(), looked_at_.end(),
                                  [&](const LookedAt &other) { return other.edge == i; });
  settle_edge(grain, near, i, edge,
              known != looked_at_.end() ? known->minimum : minimum_of(grain.shape, edge));
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
bool ShapeSearch::is_off_a_line(const Superellipsoid &s, const EdgeOfGrain &edge) const
{
  const auto &[from, to] = edge;
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
    for (; rim < plane.rim_end; rim++) look_at(near.rim[rim].primitive, planes_[i].is_owned);
    for (; inner < plane.inner_end; inner++) look_at(near.inner[inner], planes_[i].is_owned);
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
void ShapeSearch::add_contacts(const PlacedGrain &grain, std::vector<FoundGrainContact> &found)
{
  std::sort(local_.begin(), local_.end(),
            [](const Minimum &a, const Minimum &b) { return a.feature < b.feature; });
  merge(grain);
  for (std::size_t i = 0; i < local_.size(); i++)
    if (same_as_[i] == i) found.push_back(contact_of(grain, local_[i]));
}

FoundGrainContact ShapeSearch::nearest(const PlacedGrain &grain)
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
bool ShapeSearch::is_cut(const PlacedGrain &grain, const NearFeatures &near,
                         std::uint32_t primitive, const Vec3 &section,
                         const NearFeatures::RimFace *rim)
{
  const TreePrimitive &p = view_.primitives[primitive];
  const Inwards in = inwards_of(primitive, section);
  bool may = (in[0] >= 0) & (in[1] >= 0) & (in[2] >= 0);
  const auto is_listed = [&](int k) { return rim && rim->edge[k] < cut_.size(); };
  for (int k = 0; k < 3 && !may; k++) may = is_listed(k) && is_edge_cut(grain, near, rim->edge[k]);
  if (!may) {
    const Vec3 inverse = inverse_of(grain.shape.half);
    Vec3 corner[3];
    for (int k = 0; k < 3; k++) corner[k] = scaled(corner_of(grain, p, k), inverse);
    for (int k = 0; k < 3 && !may; k++)
      may = !is_listed(k) && may_cut_scaled(grain.shape, corner[k], corner[k == 2 ? 0 : k + 1]);
  }
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

FoundGrainContact ShapeSearch::contact_of(const PlacedGrain &grain, const Minimum &m)
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
