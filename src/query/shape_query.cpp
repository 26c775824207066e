// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/shape_query.h"

#include "backend/threads.h"
#include "base/input_error.h"
#include "base/quaternion.h"
#include "query/tree_search.h"
#include "shape/triangle_minimum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <exception>
#include <map>
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

// Shapes that were made, as their least radius of curvature takes a search: by proportions and exponents.
class ShapesMade {
 public:
  Superellipsoid get(const Vec3 &half, Real n1, Real n2)
  {
    if (n1 == 2 && n2 == 2) return make_superellipsoid(half, n1, n2);
    const std::array<Real, 4> key = {half.y / half.x, half.z / half.x, n1, n2};
    auto at = made_.find(key);
    if (at == made_.end()) {
      make_superellipsoid(half, 2, 2);    // checks the half-axes
      if (made_.size() >= kMost) made_.clear();
      at = made_.emplace(key, make_superellipsoid({1, key[0], key[1]}, n1, n2)).first;
    }
    const Superellipsoid &one = at->second;
    return {half, n1, n2, half.x * one.rho, half.x * one.farthest, half.x * one.nearest};
  }

 private:
  static constexpr std::size_t kMost = 4096;
  std::map<std::array<Real, 4>, Superellipsoid> made_;
};

// One grain where it is.
struct Grain {
  Superellipsoid shape;
  Vec3 centre, row[3];    // rows of the matrix that turns its axes to where they are

  Vec3 turned(const Vec3 &v) const { return {dot(row[0], v), dot(row[1], v), dot(row[2], v)}; }
  Vec3 to_own(const Vec3 &v) const { return v.x * row[0] + v.y * row[1] + v.z * row[2]; }
  Vec3 own_point(const Vec3 &x) const { return to_own(x - centre); }
};

class GrainReader {
 public:
  explicit GrainReader(const ShapesGiven &given) : given_(given) {}

  Grain read(std::size_t i)
  {
    const Real *centre = given_.centres + 3 * i;
    const std::size_t k = given_.all_alike ? 0 : i;
    const Real *half = given_.half_axes + 3 * k;
    const Real *n = given_.exponents ? given_.exponents + 2 * k : kTwo;
    Grain grain;
    try {
      grain.shape = made_.get({half[0], half[1], half[2]}, n[0], n[1]);
    } catch (const InputError &e) {
      throw InputError("grain " + std::to_string(i) + ": " + e.what());
    }
    grain.centre = {centre[0], centre[1], centre[2]};
    Quaternion turn;
    if (given_.quaternions) {
      const Real *q = given_.quaternions + 4 * i;
      const Real most =
          std::max({std::fabs(q[0]), std::fabs(q[1]), std::fabs(q[2]), std::fabs(q[3])});
      if (!(most > 0 && most - most == 0 &&
            q[0] - q[0] + q[1] - q[1] + q[2] - q[2] + q[3] - q[3] == 0))
        throw InputError("grain " + std::to_string(i) +
                         " has a quaternion that is 0 or no number: give w i j k of a rotation");
      turn = normalised({q[0] / most, {q[1] / most, q[2] / most, q[3] / most}});
    }
    rows_of(turn, grain.row);
    return grain;
  }

 private:
  static constexpr Real kTwo[2] = {2, 2};
  const ShapesGiven &given_;
  ShapesMade made_;
};

// Searches a mesh for one grain after the other.
class ShapeSearch {
 public:
  explicit ShapeSearch(const TriangleTree &tree) : tree_(tree), view_(tree.view()) {}

  void contacts(const Grain &grain, std::vector<ShapeContact> &found)
  {
    if (!is_near_anything(grain)) return;
    minima_.clear();
    visit(grain, grain.shape.farthest, [&](std::uint32_t primitive) {
      if (!is_beside(grain, primitive)) add(minimum_of(grain, primitive, 0), primitive);
    });
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

  ShapeContact nearest(const Grain &grain)
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

 private:
  // The least signed distance of a primitive, in the grain's frame.
  struct Minimum {
    ShapeMinimum at;
    FeatureCode feature;
    std::uint32_t primitive;
  };

  static bool is_near_anything(const Grain &grain)
  {
    const Vec3 &x = grain.centre;
    if (!(x.x - x.x == 0 && x.y - x.y == 0 && x.z - x.z == 0)) return false;
    if (!(std::fmax(std::fabs(x.x), std::fmax(std::fabs(x.y), std::fabs(x.z))) <= kFarthestCentre))
      throw InputError("a grain is farther than 1e100 from the origin");
    return true;
  }

  template <class Found>
  void visit(const Grain &grain, Real radius, const Found &found)
  {
    TreeWaiting stack[kTreeStack];
    if (view_.search_for(view_.scaled(grain.centre)) == TreeSearch::in_float)
      visit_within<TreeBoundsFloat>(view_, grain.centre, radius, stack, found);
    else
      visit_within<TreeBoundsDouble>(view_, grain.centre, radius, stack, found);
  }
  static int n_corners(FeatureCode primitive)
  {
    const FeatureKind kind = feature_kind(primitive);
    return kind == FeatureKind::face ? 3 : kind == FeatureKind::edge ? 2 : 1;
  }
  Vec3 corner_of(const Grain &grain, const TreePrimitive &p, int k) const
  {
    return grain.own_point(view_.vertices[p.vertex[k]]);
  }
  // Is the primitive on the outer side of one of the faces of the box around the grain?
  bool is_beside(const Grain &grain, std::uint32_t primitive) const
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

  ShapeMinimum minimum_of(const Grain &grain, std::uint32_t primitive, Real below) const
  {
    const TreePrimitive &p = view_.primitives[primitive];
    Vec3 corner[3];
    const int n = n_corners(p.code);
    for (int k = 0; k < n; k++) corner[k] = corner_of(grain, p, k);
    if (n == 3)
      return sure(TriangleMinimum(grain.shape, corner, grain.to_own(p.normal)).find(below));
    // A side or a corner of a triangle that stands on it.
    if (n == 1) corner[1] = corner[0] + Vec3{grain.shape.farthest, 0, 0};
    const Vec3 along = corner[1] - corner[0], across = any_perpendicular(along);
    corner[2] = corner[0] + norm(along) * across;
    const TriangleMinimum alone(grain.shape, corner, (1 / norm(along)) * cross(along, across));
    ShapeMinimum m = n == 2 ? alone.on_side(0, below) : alone.on_corner(0);
    if (!(m.distance < below)) m = no_minimum();
    return sure(m);
  }
  static ShapeMinimum sure(const ShapeMinimum &m)
  {
    if (m.is_sure) return m;
    throw InputError(
        "the nearest point of a grain's surface was not found to rounding at a distance of " +
        std::to_string(m.distance) + ": please report its numbers");
  }
  FeatureCode feature_of(const ShapeMinimum &m, const TreePrimitive &p) const
  {
    const FeatureKind kind = feature_kind(p.code);
    if (m.part == TrianglePart::corner) return feature_code(FeatureKind::vertex, p.vertex[m.k]);
    if (m.part == TrianglePart::edge && kind == FeatureKind::face)
      return feature_code(FeatureKind::edge, p.edge[m.k]);
    return p.code;
  }
  Minimum made(const ShapeMinimum &m, std::uint32_t primitive) const
  {
    return {m, feature_of(m, view_.primitives[primitive]), primitive};
  }
  void add(const ShapeMinimum &m, std::uint32_t primitive)
  {
    if (m.distance < 0) minima_.push_back(made(m, primitive));
  }
  static ShapeContact contact_of(const Grain &grain, const Minimum &m)
  {
    const Vec3 of_grain = m.at.foot - m.at.distance * m.at.normal;
    return {m.feature, grain.centre + grain.turned(m.at.foot), -grain.turned(m.at.normal),
            grain.centre + grain.turned(of_grain), m.at.distance};
  }

  // Calls visit() for each face at a feature.
  template <class Visit>
  void each_face(FeatureCode feature, const Visit &visit) const
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
  bool is_local(const Grain &grain, const Minimum &m) const
  {
    if (feature_kind(m.feature) == FeatureKind::face) return true;
    return m.at.is_smooth ? rises_around(grain, m) : none_is_deeper(grain, m);
  }
  // By the gradient, which is the normal.
  bool rises_around(const Grain &grain, const Minimum &m) const
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
  // Deeper than the least radius of curvature there may be several gradients: by the minima of all faces around.
  bool none_is_deeper(const Grain &grain, const Minimum &m) const
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
  void merge(const Grain &grain)
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
  bool are_same(const Grain &grain, const Minimum &a, const Minimum &b) const
  {
    const Real size = grain.shape.farthest, apart = std::fabs(a.at.distance - b.at.distance);
    const Real turn = norm(a.at.normal - b.at.normal), way = norm(a.at.foot - b.at.foot);
    if (a.at.is_smooth && b.at.is_smooth)
      return apart <= kSameDistance * size && turn <= kSameNormal &&
             (way <= kSameFoot * size || are_neighbours(a.feature, b.feature));
    return apart <= kSameDeepDistance * size && way <= kSameDeepFoot * size;
  }
  // Do the triangles around two features share a vertex?
  bool are_neighbours(FeatureCode a, FeatureCode b) const
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

  const TriangleTree &tree_;
  const TreeView &view_;
  std::vector<Minimum> minima_, local_;
  std::vector<std::size_t> same_as_;    // of local_
  mutable std::vector<int> around_;
};

constexpr std::size_t kGrainsAtATime = 64;

// Calls of_chunk(chunk, from, to, reader, search) for all grains, some at a time, with threads() threads.
template <class OfChunk>
void each_chunk(const TriangleTree &tree, const ShapesGiven &grains, const OfChunk &of_chunk)
{
  const std::size_t n_chunks = (grains.n + kGrainsAtATime - 1) / kGrainsAtATime;
  std::exception_ptr error;
#pragma omp parallel num_threads(threads()) if (n_chunks > 1)
  {
    GrainReader reader(grains);
    ShapeSearch search(tree);
#pragma omp for schedule(dynamic, 1)
    for (std::int64_t c = 0; c < static_cast<std::int64_t>(n_chunks); c++) {
      try {
        const std::size_t from = static_cast<std::size_t>(c) * kGrainsAtATime;
        of_chunk(static_cast<std::size_t>(c), from, std::min(grains.n, from + kGrainsAtATime),
                 reader, search);
      } catch (...) {
#pragma omp critical(lsdcd_shape_query)
        if (!error) error = std::current_exception();
      }
    }
  }
  if (error) std::rethrow_exception(error);
}

}    // namespace

ShapeContacts find_shape_contacts(const TriangleTree &tree, const ShapesGiven &grains)
{
  ShapeContacts out;
  out.first.resize(grains.n + 1);
  std::vector<std::vector<ShapeContact>> chunks((grains.n + kGrainsAtATime - 1) / kGrainsAtATime);
  each_chunk(tree, grains,
             [&](std::size_t c, std::size_t from, std::size_t to, GrainReader &reader,
                 ShapeSearch &search) {
               for (std::size_t i = from; i < to; i++) {
                 const std::size_t before = chunks[c].size();
                 search.contacts(reader.read(grains.from + i), chunks[c]);
                 out.first[i + 1] = chunks[c].size() - before;
               }
             });
  for (std::size_t i = 0; i < grains.n; i++) out.first[i + 1] += out.first[i];
  out.found.reserve(out.first[grains.n]);
  for (std::vector<ShapeContact> &chunk : chunks) {
    out.found.insert(out.found.end(), chunk.begin(), chunk.end());
    chunk = {};
  }
  return out;
}

void find_shape_distances(const TriangleTree &tree, const ShapesGiven &grains,
                          ShapeContact *nearest)
{
  each_chunk(
      tree, grains,
      [&](std::size_t, std::size_t from, std::size_t to, GrainReader &reader, ShapeSearch &search) {
        for (std::size_t i = from; i < to; i++)
          nearest[i] = search.nearest(reader.read(grains.from + i));
      });
}

}    // namespace lsdcd
