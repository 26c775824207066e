// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The contacts of a grain that is no sphere with a mesh, and the nearest place of it, on a CPU: the local minima of the signed
// distance from the grain over the surface.
#pragma once

#include "geometry/feature_code.h"
#include "shape/superellipsoid.h"
#include "shape/triangle_minimum.h"
#include "tree/triangle_tree.h"

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace lsdcd {

// A grain where it is.
struct PlacedGrain {
  Superellipsoid shape;
  Vec3 centre, row[3];    // rows of the matrix that turns its axes to where they are

  Vec3 turned(const Vec3 &v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  Vec3 to_own(const Vec3 &v) const { return v.x * row[0] + v.y * row[1] + v.z * row[2]; }
  Vec3 own_point(const Vec3 &x) const { return to_own(x - centre); }
};

// A place of the mesh where the signed distance from a grain is a local minimum below 0, or the least of all.
struct ShapeContact {
  FeatureCode feature = kNoFeature;
  Vec3 point = {0, 0, 0}, normal = {0, 0, 0};    // on the wall; unit, from there into the grain
  Vec3 of_grain = {0, 0, 0};    // the point of the grain's surface, distance normal from `point`
  Real distance = std::numeric_limits<Real>::infinity();    // signed; -distance is the overlap
};

// Searches a mesh for one grain after the other.
class ShapeSearch {
 public:
  explicit ShapeSearch(const TriangleTree &tree) : tree_(tree), view_(tree.view()) {}

  // Adds the contacts of a grain to `found`, in the order of their features.
  void contacts(const PlacedGrain &grain, std::vector<ShapeContact> &found);
  // The same, where all that the sphere around the grain reaches is `among` these primitives of the tree.
  void contacts(const PlacedGrain &grain, const std::vector<std::uint32_t> &among,
                std::vector<ShapeContact> &found);
  // Makes `near` the primitives within `radius` of a grain's centre.
  void find_near(const PlacedGrain &grain, Real radius, std::vector<std::uint32_t> &near);
  // Returns the nearest place of the mesh; of no feature where the grain's centre is no number.
  ShapeContact nearest(const PlacedGrain &grain);

 private:
  // The least signed distance of a primitive, in the grain's frame.
  struct Minimum {
    ShapeMinimum at;
    FeatureCode feature;
    std::uint32_t primitive;
  };

  void find_contacts(const PlacedGrain &grain, std::vector<ShapeContact> &found);
  template <class Found>
  void visit(const PlacedGrain &grain, Real radius, const Found &found);
  template <class Visit>
  void each_face(FeatureCode feature, const Visit &visit) const;
  Vec3 corner_of(const PlacedGrain &grain, const TreePrimitive &p, int k) const;
  bool is_beside(const PlacedGrain &grain, std::uint32_t primitive) const;
  ShapeMinimum minimum_of(const PlacedGrain &grain, std::uint32_t primitive, Real below) const;
  FeatureCode feature_of(const ShapeMinimum &m, const TreePrimitive &p) const;
  Minimum made(const ShapeMinimum &m, std::uint32_t primitive) const;
  void add(const ShapeMinimum &m, std::uint32_t primitive);
  static ShapeContact contact_of(const PlacedGrain &grain, const Minimum &m);
  bool is_local(const PlacedGrain &grain, const Minimum &m) const;
  bool rises_around(const PlacedGrain &grain, const Minimum &m) const;
  bool none_is_deeper(const PlacedGrain &grain, const Minimum &m) const;
  void merge(const PlacedGrain &grain);
  bool are_same(const PlacedGrain &grain, const Minimum &a, const Minimum &b) const;
  bool are_neighbours(FeatureCode a, FeatureCode b) const;

  const TriangleTree &tree_;
  const TreeView &view_;
  std::vector<Minimum> minima_, local_;
  std::vector<std::size_t> same_as_;    // of local_
  mutable std::vector<int> around_;
};

}    // namespace lsdcd
