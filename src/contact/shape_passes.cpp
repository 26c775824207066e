// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "contact/shape_passes.h"

#include <algorithm>

namespace lsdcd {

void ShapePasses::begin(const PlacedGrain &grain, const std::vector<PassEnd> &contacts)
{
  grain_ = grain;
  contacts_ = contacts;
  overlap_.clear();
  tangents_.clear();
  Vec3 sum = {0, 0, 0};
  bool is_deep = false;
  for (const PassEnd &c : contacts) {
    tangents_.push_back({c.normal, dot(c.normal, c.point)});
    sum += c.normal;
    is_deep |= c.overlap >= grain.shape.rho;
  }
  const Real size = norm(sum);
  if (size > 0) {
    const Vec3 between = (1 / size) * sum;
    tangents_.push_back({between, support(grain.shape, between).height});
  }
  // There the overlap of an edge is by tangents that are parallel to it.
  if (is_deep) tangents_.clear();
  list_faces();
}

const std::vector<Real> &ShapePasses::find(std::size_t from, Real above)
{
  pass_.assign(contacts_.size(), 0);
  reached_.clear();
  waiting_.clear();
  const auto is_less_deep = [](const Crossing &a, const Crossing &b) {
    return a.overlap < b.overlap;
  };
  Real pass = contacts_[from].overlap;
  each_face(view_, contacts_[from].feature,
            [&](int face) { reach(static_cast<std::uint32_t>(face), pass, above); });
  // Over the deepest edge of what has been reached, so that each face is reached as deep as can be.
  while (!waiting_.empty()) {
    std::pop_heap(waiting_.begin(), waiting_.end(), is_less_deep);
    const Crossing next = waiting_.back();
    waiting_.pop_back();
    pass = std::min(pass, next.overlap);
    for (int k = view_.edge_first[next.edge]; k < view_.edge_first[next.edge + 1]; k++)
      reach(static_cast<std::uint32_t>(view_.edge_face[k]), pass, above);
  }
  pass_[from] = 0;
  return pass_;
}

void ShapePasses::list_faces()
{
  faces_.clear();
  for (std::size_t i = 0; i < contacts_.size(); i++)
    each_face(view_, contacts_[i].feature, [&](int face) {
      faces_.push_back({static_cast<std::uint32_t>(face), i});
    });
  std::sort(faces_.begin(), faces_.end(),
            [](const FaceOfContact &a, const FaceOfContact &b) { return a.face < b.face; });
}

// Reaches a face, and has the edges of it wait that are deeper than `above`.
void ShapePasses::reach(std::uint32_t face, Real pass, Real above)
{
  bool is_new = false;
  reached_.at(face, is_new);
  if (!is_new) return;
  for (auto of =
           std::lower_bound(faces_.begin(), faces_.end(), face,
                            [](const FaceOfContact &a, std::uint32_t b) { return a.face < b; });
       of != faces_.end() && of->face == face; of++)
    pass_[of->contact] = std::max(pass_[of->contact], pass);
  const TreePrimitive &p = view_.primitives[view_.face_primitive[face]];
  for (const std::uint32_t edge : p.edge) {
    if (view_.edge_first[edge + 1] - view_.edge_first[edge] < 2) continue;
    const Real overlap = overlap_of(edge, above);
    if (!(overlap > above)) continue;
    waiting_.push_back({overlap, edge});
    std::push_heap(waiting_.begin(), waiting_.end(),
                   [](const Crossing &a, const Crossing &b) { return a.overlap < b.overlap; });
  }
}

Real ShapePasses::overlap_of(std::uint32_t edge, Real above)
{
  bool is_new = false;
  EdgeOverlap &known = overlap_.at(edge, is_new);
  if (is_new || (known.overlap <= known.above && above < known.above))
    known = {compute_overlap(edge, above), above};
  return known.overlap;
}

// Returns the largest overlap on an edge, or 0 where that is not above `above`.
Real ShapePasses::compute_overlap(std::uint32_t edge, Real above) const
{
  const Superellipsoid &s = grain_.shape;
  const int *ends = view_.edges + 2 * edge;
  const Vec3 from = grain_.own_point(view_.vertices[ends[0]]),
             to = grain_.own_point(view_.vertices[ends[1]]);
  // No overlap is larger than that by a tangent plane.
  for (const Tangent &t : tangents_)
    if (t.height - smaller(dot(t.normal, from), dot(t.normal, to)) <= above) return 0;
  if (!may_cut(s, from, to, above)) return 0;
  const Real length = norm(to - from);
  const Vec3 along = (1 / length) * (to - from);
  const TangentMinimum line = TangentAboutLine(s, from, along).find();
  if (!(-line.distance > above)) return 0;
  const Real at = dot(line.foot - from, along);
  if (at > 0 && at < length)
    return -line.distance < s.rho || is_contact(s, line) ? -line.distance : 0;
  // At an end.
  const Vec3 &end = at > 0 ? to : from;
  if (!(gauge_value(s, end) < 1)) return 0;
  return -sure_distance(s, end);
}

}    // namespace lsdcd
