// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds the contacts of a grain that is no sphere with a mesh, and the place of the mesh that is nearest to it, on a CPU. Contacts are the
// local minima over the surface of the signed distance from the grain.
#pragma once

#include "contact/near_features.h"
#include "geometry/feature_code.h"
#include "shape/placed_grain.h"
#include "shape/triangle_minimum.h"
#include "tree/triangle_tree.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace lsdcd {

// A contact of a grain that is no sphere, as the search finds it: a place of the mesh where the signed distance from the grain is a
// local minimum below 0. ShapeSearch::nearest() returns the place where it is the least of all. GrainContact is the same contact as a
// step uses it.
struct FoundGrainContact {
  FeatureCode feature = kNoFeature;
  Vec3 point = {0, 0, 0}, normal = {0, 0, 0};    // on the wall; unit, from there into the grain
  Vec3 of_grain = {0, 0, 0};    // the point of the grain's surface, distance normal from `point`
  Real distance = std::numeric_limits<Real>::infinity();    // signed; -distance is the overlap
};

// Returns the signed distance of a point in the grain's frame. Throws InputError if it was not found to rounding.
Real sure_distance(const Superellipsoid &s, const Vec3 &y);

// Returns whether a segment, in the grain's frame, can cut the part of the grain that is deeper than `depth`. Exact for an ellipsoid and a
// depth of 0; for other grains also true for a few segments that pass close by.
bool may_cut(const Superellipsoid &s, const Vec3 &from, const Vec3 &to, Real depth = 0);

// Calls visit() for each face at a feature; for a vertex some faces are visited more than once.
template <class Visit>
void each_face(const TreeView &view, FeatureCode feature, const Visit &visit)
{
  const int i = static_cast<int>(feature_index(feature));
  if (feature_kind(feature) == FeatureKind::face) return visit(i);
  const auto of_edge = [&](int e) {
    for (int k = view.edge_first[e]; k < view.edge_first[e + 1]; k++) visit(view.edge_face[k]);
  };
  if (feature_kind(feature) == FeatureKind::edge) return of_edge(i);
  for (int k = view.vertex_first[i]; k < view.vertex_first[i + 1]; k++)
    of_edge(view.vertex_edge[k]);
}

// Searches a mesh for one grain after another.
class ShapeSearch {
 public:
  explicit ShapeSearch(const TriangleTree &tree) :
      tree_(tree), view_(tree.view()), patches_(tree.flat_patches())
  {
  }

  // Adds the contacts of a grain to `found`, in the order of their features.
  void contacts(const PlacedGrain &grain, std::vector<FoundGrainContact> &found);
  // Does the same, with `near` as all features that the sphere around the grain reaches.
  void contacts(const PlacedGrain &grain, NearFeatures &near,
                std::vector<FoundGrainContact> &found);
  // Sets `near` to all features within `radius` of the grain's centre.
  void find_near(const PlacedGrain &grain, Real radius, NearFeatures &near);
  // Returns the nearest place of the mesh; it has no feature if the grain's centre is not a number.
  FoundGrainContact nearest(const PlacedGrain &grain);

 private:
  // The least signed distance of a primitive, in the grain's frame.
  struct Minimum {
    ShapeMinimum at;
    FeatureCode feature;
    std::uint32_t primitive;
  };

  // The state of a listed feature: it can be no contact; it may be one; it is one; or it is deep, and triangles must be searched unless a
  // face at it has another contact.
  enum class State : char { cannot_be, may_be, is, is_deep };
  using Inwards = std::array<Real, 3>;
  // The position of a grain relative to a plane: it does not reach the plane; its overlap is less than the least radius of curvature, or
  // counts as such because its foot is in a face; or it is deep.
  enum class Side : char { out_of_reach, in_reach, is_deep };
  struct AtPlane {
    Side side;
    bool is_owned;    // the foot of its deep minimum is in a face
    Real towards;     // 1, or -1 where the grain is on the front
    Vec3 arm;         // to the grain's point
  };
  // A face whose minimum may differ from that of its tangent plane.
  struct DeepFace {
    std::uint32_t primitive;
    const NearFeatures::Plane *plane;
    const NearFeatures::RimFace *rim;    // null: it is no rim face
  };
  struct EdgeOfGrain {
    Vec3 from, to;    // in the grain's frame
  };
  // The minimum on the line of an edge.
  struct EdgeMinimum {
    TangentMinimum line;
    Vec3 along;
    Real length, at;    // where its foot is, from the beginning of the edge
    bool is_here;
  };
  struct LookedAt {
    std::uint32_t edge;
    EdgeMinimum minimum;
  };
  struct Line {
    Vec3 from, along, foot;    // place of its minimum
  };

  bool is_flat(std::uint32_t edge) const;
  void list_cut(const PlacedGrain &grain, const NearFeatures &near);
  void list_edges(NearFeatures &near);
  void list_face(NearFeatures &near, std::uint32_t primitive);
  void list_faces_at(NearFeatures &near) const;
  bool find_by_owner(const PlacedGrain &grain, NearFeatures &near);
  void look_at_plane(const PlacedGrain &grain, NearFeatures &near, std::size_t i, const Vec3 &half);
  bool has_all_cut(const PlacedGrain &grain, const NearFeatures &near, std::size_t i);
  void look_at_deep_plane(const PlacedGrain &grain, const NearFeatures &near, std::size_t i,
                          const Vec3 &section);
  void find_foot(const PlacedGrain &grain, NearFeatures &near, std::size_t i);
  void leave_out_passed(const PlacedGrain &grain, const NearFeatures &near, Real unsure);
  Inwards inwards_of(std::uint32_t face, const Vec3 &point) const;
  bool is_edge_cut(const PlacedGrain &grain, const NearFeatures &near, std::size_t i);
  static bool is_inside(const NearFeatures &near, const NearFeatures::RimFace &face,
                        const Inwards &in, Real same);
  void add_face(const PlacedGrain &grain, std::uint32_t face, Real side, const Vec3 &arm);
  void look_at_likely_edges(const PlacedGrain &grain, const NearFeatures &near, Real unsure);
  void look_inside_edge(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i,
                        Real unsure);
  void look_at_edge(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i);
  EdgeOfGrain edge_of(const NearFeatures::Edge &edge) const
  {
    return {own_[edge.vertex[0]], own_[edge.vertex[1]]};
  }
  static EdgeMinimum minimum_of(const Superellipsoid &s, const EdgeOfGrain &edge);
  void settle_edge(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i,
                   const EdgeOfGrain &of, const EdgeMinimum &on);
  void look_at_vertex(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t i);
  bool is_off_a_line(const Superellipsoid &s, const EdgeOfGrain &edge) const;
  bool deep_are_passed(const PlacedGrain &grain, const NearFeatures &near, bool has_deep);
  bool is_passed(const PlacedGrain &grain, const NearFeatures &near, const DeepFace &deep) const;
  bool has_minimum(const NearFeatures::RimFace &face) const;
  void rule_out(const NearFeatures::RimFace &face);
  void find_by_triangle(const PlacedGrain &grain, const NearFeatures &near);
  template <class Found>
  void visit(const PlacedGrain &grain, Real radius, const Found &found);
  Vec3 corner_of(const PlacedGrain &grain, const TreePrimitive &p, int k) const;
  bool is_beside(const PlacedGrain &grain, std::uint32_t primitive) const;
  bool is_cut(const PlacedGrain &grain, const NearFeatures &near, std::uint32_t primitive,
              const Vec3 &section, const NearFeatures::RimFace *rim);
  ShapeMinimum minimum_of(const PlacedGrain &grain, std::uint32_t primitive, Real below) const;
  ShapeMinimum contact_minimum(const PlacedGrain &grain, std::uint32_t primitive,
                               bool is_owned) const;
  bool has_foot(const NearFeatures &near, std::size_t plane, const Vec3 &point) const;
  FeatureCode feature_of(const ShapeMinimum &m, const TreePrimitive &p) const;
  Minimum made(const ShapeMinimum &m, std::uint32_t primitive) const;
  void add(const ShapeMinimum &m, std::uint32_t primitive);
  static FoundGrainContact contact_of(const PlacedGrain &grain, const Minimum &m);
  bool is_local(const PlacedGrain &grain, const Minimum &m) const;
  bool rises_around(const PlacedGrain &grain, const Minimum &m) const;
  bool none_is_deeper(const PlacedGrain &grain, const Minimum &m) const;
  void find_pieces(const PlacedGrain &grain);
  std::uint32_t piece_of(std::uint32_t minimum);
  void add_contacts(const PlacedGrain &grain, std::vector<FoundGrainContact> &found);
  void merge(const PlacedGrain &grain);
  bool are_same(const PlacedGrain &grain, const Minimum &a, const Minimum &b) const;
  bool are_neighbours(FeatureCode a, FeatureCode b) const;

  const TriangleTree &tree_;
  const TreeView &view_;
  const std::vector<std::uint32_t> &patches_;
  NearFeatures near_;
  std::vector<std::uint32_t> faces_, numbers_, whole_;    // faces of a list that is being made
  std::vector<Vec3> own_, scaled_;    // vertices in the grain's frame, and over its half-axes
  std::vector<State> edge_, vertex_;
  enum class Cut : char { no, yes, not_asked };
  std::vector<Cut> cut_;    // for each edge: may the grain cut it?
  std::vector<DeepFace> deep_;
  // Has an edge been passed at which the overlap is not less than the least radius of curvature?
  bool passed_deep_ = false;
  std::vector<AtPlane> planes_;
  std::vector<Line> lines_;
  std::vector<LookedAt> looked_at_;    // edges that have to be tested once more
  std::vector<Minimum> minima_, local_;
  std::vector<std::uint32_t> piece_;    // for each of minima_: another one of its piece, or itself
  std::vector<std::pair<FeatureCode, std::uint32_t>>
      shared_;                              // with the minimum of a primitive at it
  std::vector<const Minimum *> deepest_;    // of pieces, as are the next ones
  std::vector<char> has_contact_;
  std::vector<std::size_t> same_as_;    // index into local_
  mutable std::vector<int> around_;
};

}    // namespace lsdcd
