// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/generalized_winding.h"

#include "geometry/solid_angle.h"
#include "mesh/counted_facets.h"
#include "mesh/union_find.h"

#include <utility>

namespace lsdcd {

namespace {

// Nearer to an edge of a cap, in lengths of that edge, facets are added up.
constexpr Real kNearEdge = 1e-4;

// Triangles over the loops of loose edges, wound so that all edges cancel. Loops that have a vertex in common
// have one apex.
template <class Cap>
std::vector<Cap> caps_over(const WeldedMesh &mesh, const std::vector<LooseEdge> &loose)
{
  UnionFind loops(mesh.vertices.size());
  for (const LooseEdge &e : loose) loops.join(e.from, e.to);
  std::vector<Cap> caps;
  caps.reserve(loose.size());
  for (const LooseEdge &e : loose) {
    const int apex = loops.of(e.from);
    if (apex == e.from || apex == e.to) continue;
    caps.push_back({{{mesh.vertices[apex], mesh.vertices[e.to], mesh.vertices[e.from]}}, e.times});
  }
  return caps;
}

}    // namespace

GeneralizedWinding::GeneralizedWinding(const WeldedMesh &mesh, const ProgressListener &progress)
{
  const CountedFacets counted(mesh);
  std::vector<Triangle> facets = whole_surface(mesh, counted);
  n_facets_ = facets.size();
  caps_ = caps_over<Cap>(mesh, counted.loose);
  if (caps_.size() > n_facets_) {
    caps_.clear();
    facets_ = std::move(facets);
    return;
  }
  for (const Cap &cap : caps_) facets.insert(facets.end(), cap.times, cap.facet);
  closed_ = std::make_unique<const WindingNumber>(std::move(facets), progress);
}

GeneralizedWinding::Answer GeneralizedWinding::at(const Vec3 &q) const
{
  if (!std::isfinite(q.x + q.y + q.z)) return {false, 0};
  if (!closed_) return add_facets(q);
  const WindingNumber::Answer whole = closed_->at(q);
  if (whole.on_surface) return add_facets(q);    // of the mesh, or of a cap
  Real capped = 0;
  for (const Cap &cap : caps_) {
    const HalfSolidAngle half = half_solid_angle(cap.facet, q);
    if (half.length_sq() < kNearEdge * kNearEdge) return add_facets(q);
    capped += cap.times * half.value();
  }
  return {false, whole.number - capped / (2 * kPi)};
}

GeneralizedWinding::Answer GeneralizedWinding::add_facets(const Vec3 &q) const
{
  const Triangle *facets = closed_ ? closed_->facets().data() : facets_.data();
  Answer answer = {false, 0};
  for (std::size_t f = 0; f < n_facets_; f++) {
    const HalfSolidAngle half = half_solid_angle(facets[f], q);
    if (half.sine != 0)
      answer.number += half.value();
    else if (half.cosine < kBeside)
      answer.on_surface = answer.on_surface || lies_on(facets[f], q);
  }
  answer.number /= 2 * kPi;
  return answer;
}

}    // namespace lsdcd
