// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/close_faces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>
#include <utility>

namespace lsdcd {

namespace {

// Faces round a vertex from which on they are a fan. Up to it their pairs take less time than its trees.
constexpr std::size_t kFan = 64;

// Faces by the hub of their fan.
using ByHub = std::map<int, std::vector<int>>;

// Returns the faces by that of their vertices, other than those of `shared`, which most of these faces have, where it is the hub of a fan.
ByHub by_hub(const WeldedMesh &mesh, const std::vector<int> &faces, const std::vector<int> &shared)
{
  if (faces.size() <= kFan) return {{CloseFaces::kNone, faces}};
  const auto is_shared = [&](int v) {
    return std::find(shared.begin(), shared.end(), v) != shared.end();
  };
  // Of a few of a large mesh's faces not each vertex is counted.
  const bool of_all = faces.size() > mesh.vertices.size() / 8;
  std::vector<int> at(of_all ? mesh.vertices.size() : 0, 0);
  std::unordered_map<int, int> found;
  const auto count = [&](int v) -> int & { return of_all ? at[v] : found[v]; };
  for (const int f : faces)
    for (const int v : mesh.faces[f])
      if (!is_shared(v)) count(v)++;
  ByHub parts;
  for (const int f : faces) {
    int hub = CloseFaces::kNone, most = static_cast<int>(kFan);
    for (const int v : mesh.faces[f])
      if (!is_shared(v) && count(v) > most) hub = v, most = count(v);
    parts[hub].push_back(f);
  }
  return parts;
}

// ---- faces that share a corner or an edge: where they are, seen from there ------------------

constexpr Real kRounding = 1e-14;    // of a unit vector, of a few operations

Box around(const Vec3 &x, Real margin)
{
  const Vec3 wide = {margin, margin, margin};
  return {x - wide, x + wide};
}

// The directions from vertex v to the points of a face: an arc of the unit sphere, which bulges out of its chord.
Box directions(const WeldedMesh &mesh, int v, int face)
{
  Vec3 to[2];
  int n = 0;
  for (const int w : mesh.faces[face])
    if (w != v) to[n++] = direction(mesh.vertices[v], mesh.vertices[w]);
  const Real bulge = 1 - norm(to[0] + to[1]) / 2 + kRounding;
  Box box = around(to[0], bulge);
  const Box other = around(to[1], bulge);
  extend(box, other.lo);
  extend(box, other.hi);
  return box;
}

// The direction in which a face goes off its edge from v to w.
Box direction_off(const WeldedMesh &mesh, int v, int w, int face)
{
  const Vec3 &from = mesh.vertices[v], edge = mesh.vertices[w] - from;
  for (const int u : mesh.faces[face]) {
    if (u == v || u == w) continue;
    const Vec3 to = mesh.vertices[u] - from, off = to - dot(to, edge) / dot(edge, edge) * edge;
    const Real size = norm(off);
    return size > 0 ? around((1 / size) * off, kRounding * (1 + norm(to) / size))
                    : around({0, 0, 0}, 1);
  }
  return around({0, 0, 0}, 1);
}

// Pairs of faces that all have the vertices `shared`, one or two.
void visit_fan(const WeldedMesh &mesh, const std::vector<int> &faces,
               const std::vector<int> &shared, const CloseFaces::Found &found)
{
  const bool at_edge = shared.size() == 2;
  const ByHub by = at_edge ? ByHub{{CloseFaces::kNone, faces}} : by_hub(mesh, faces, shared);
  std::vector<const std::vector<int> *> parts;
  std::vector<BoxTree> trees;
  std::vector<Box> bounds;
  for (const auto &[hub, of_hub] : by) {
    std::vector<Box> boxes;
    boxes.reserve(of_hub.size());
    for (const int f : of_hub)
      boxes.push_back(at_edge ? direction_off(mesh, shared[0], shared[1], f)
                              : directions(mesh, shared[0], f));
    parts.push_back(&of_hub);
    trees.emplace_back(boxes);
    bounds.push_back(trees.back().bounds());
    if (hub == CloseFaces::kNone)
      trees.back().visit_pairs([&, of = &of_hub](int f, int g) { found((*of)[f], (*of)[g]); });
    else
      visit_fan(mesh, of_hub, {shared[0], hub}, found);
  }
  BoxTree(bounds).visit_pairs([&](int i, int j) {
    trees[i].visit_pairs(trees[j], [&](int f, int g) { found((*parts[i])[f], (*parts[j])[g]); });
  });
}

// ---- faces of different fans ------------------------------------------------------------------

// Is one edge so short that the face is nearly a segment?
bool is_long(const WeldedMesh &mesh, int face)
{
  constexpr Real kLong = 16;
  Real least = HUGE_VAL, most = 0;
  for (int k = 0; k < 3; k++) {
    const Real length =
        norm(mesh.vertices[mesh.faces[face][(k + 1) % 3]] - mesh.vertices[mesh.faces[face][k]]);
    least = std::min(least, length);
    most = std::max(most, length);
  }
  return most > kLong * least;
}

// The vertex of a face that is opposite to its shortest edge.
int tip_of(const WeldedMesh &mesh, int face)
{
  int tip = 0;
  Real least = HUGE_VAL;
  const auto &v = mesh.faces[face];
  for (int k = 0; k < 3; k++) {
    const Real length = norm(mesh.vertices[v[(k + 2) % 3]] - mesh.vertices[v[(k + 1) % 3]]);
    if (length < least) least = length, tip = v[k];
  }
  return tip;
}

// A vertex of a face and its other two, as its ends.
Ends ends_at(const WeldedMesh &mesh, int tip, int face)
{
  const Vec3 &x = mesh.vertices[tip];
  Ends ends = {{{x, x}, {}}};
  bool first = true;
  for (const int v : mesh.faces[face]) {
    if (v == tip) continue;
    if (std::exchange(first, false)) ends.end[1] = {mesh.vertices[v], mesh.vertices[v]};
    extend(ends.end[1], mesh.vertices[v]);
  }
  return ends;
}

// The ends of a long face. The lower one along the axis of its bounds comes first, so that ends of neighbours are near each other.
Ends ends_of(const WeldedMesh &mesh, int face)
{
  Ends ends = ends_at(mesh, tip_of(mesh, face), face);
  const Box all = ends.bounds();
  int axis = 0;
  for (int k = 1; k < 3; k++)
    if (all.hi[k] - all.lo[k] > all.hi[axis] - all.lo[axis]) axis = k;
  if (ends.end[1].lo[axis] < ends.end[0].lo[axis]) std::swap(ends.end[0], ends.end[1]);
  return ends;
}

}    // namespace

Box box_of(const WeldedMesh &mesh, int face)
{
  const auto &v = mesh.faces[face];
  return box_around(mesh.vertices[v[0]], mesh.vertices[v[1]], mesh.vertices[v[2]]);
}

CloseFaces::CloseFaces(const WeldedMesh &mesh, const std::vector<int> &faces) : mesh_(mesh)
{
  for (auto &[hub, of_hub] : by_hub(mesh, faces, {})) {
    if (hub == kNone) {
      std::vector<int> long_ones;
      for (const int f : of_hub) (is_long(mesh, f) ? long_ones : rest_).push_back(f);
      if (long_ones.size() > kFan)
        add_part(kNone, long_ones);
      else
        rest_ = of_hub;
    } else {
      add_part(hub, of_hub);
    }
  }
  std::vector<Box> boxes;
  boxes.reserve(rest_.size());
  for (const int f : rest_) boxes.push_back(box_of(mesh, f));
  rest_tree_ = std::make_unique<BoxTree>(boxes);
}

void CloseFaces::add_part(int hub, const std::vector<int> &faces)
{
  std::vector<Ends> ends;
  ends.reserve(faces.size());
  for (const int f : faces)
    ends.push_back(hub == kNone ? ends_of(mesh_, f) : ends_at(mesh_, hub, f));
  parts_.push_back({hub, faces, EndTree(ends)});
}

// Returns the rest as things that are not long, for pairs with those that are.
EndTree CloseFaces::rest_as_ends() const
{
  std::vector<Ends> ends;
  ends.reserve(rest_.size());
  for (const int f : rest_) ends.push_back({{box_of(mesh_, f), box_of(mesh_, f)}});
  return EndTree(ends);
}

void CloseFaces::visit_pairs(const Found &found) const
{
  rest_tree_->visit_pairs([&](int f, int g) { found(rest_[f], rest_[g]); });
  std::vector<Box> bounds;
  for (const Part &part : parts_) {
    bounds.push_back(part.tree.bounds());
    if (part.hub == kNone)
      part.tree.visit_pairs([&](int f, int g) { found(part.faces[f], part.faces[g]); });
    else
      visit_fan(mesh_, part.faces, {part.hub}, found);
  }
  BoxTree(bounds).visit_pairs([&](int i, int j) { visit_pairs(parts_[i], parts_[j], found); });
  visit_rest(*this, found);
}

void CloseFaces::visit_pairs(const CloseFaces &others, const Found &found) const
{
  rest_tree_->visit_pairs(*others.rest_tree_,
                          [&](int f, int g) { found(rest_[f], others.rest_[g]); });
  std::vector<Box> mine, theirs;
  for (const Part &part : parts_) mine.push_back(part.tree.bounds());
  for (const Part &part : others.parts_) theirs.push_back(part.tree.bounds());
  BoxTree(mine).visit_pairs(BoxTree(theirs),
                            [&](int i, int j) { visit_pairs(parts_[i], others.parts_[j], found); });
  visit_rest(others, found);
  others.visit_rest(*this, [&](int f, int g) { found(g, f); });
}

void CloseFaces::visit_pairs(const Part &a, const Part &b, const Found &found)
{
  a.tree.visit_pairs(b.tree, [&](int f, int g) { found(a.faces[f], b.faces[g]); });
}

void CloseFaces::visit_rest(const CloseFaces &others, const Found &found) const
{
  if (rest_.empty() || others.parts_.empty()) return;
  const EndTree ends = rest_as_ends();
  for (const Part &part : others.parts_)
    ends.visit_pairs(part.tree, [&](int f, int g) { found(rest_[f], part.faces[g]); });
}

}    // namespace lsdcd
