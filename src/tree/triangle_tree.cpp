// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tree/triangle_tree.h"

#include "geometry/closest_point.h"
#include "mesh/mesh_features.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace lsdcd {

namespace {

template <class Numbers>
const int *flat(const std::vector<Numbers> &of)
{
  return of.empty() ? nullptr : of[0].data();
}

float below(Real x)
{
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -HUGE_VALF) : f;
}
float above(Real x)
{
  return -below(-x);
}

}    // namespace

TriangleTree::TriangleTree(const WeldedMesh &mesh, const TriangleTable &names,
                           const ProgressListener &progress) :
    mesh_(mesh)
{
  std::vector<char> has_face(mesh.vertices.size(), 0);
  for (const auto &face : mesh.faces)
    for (const int v : face) has_face[v] = 1;
  for (std::size_t e = 0; e < mesh.edges.size(); e++)
    if (mesh.edge_first[e] == mesh.edge_first[e + 1]) {
      bare_edges_.push_back(static_cast<std::uint32_t>(e));
      for (const int v : mesh.edges[e]) has_face[v] = 1;
    }
  for (std::size_t v = 0; v < mesh.vertices.size(); v++)
    if (!has_face[v]) bare_vertices_.push_back(static_cast<std::uint32_t>(v));

  const Vec3 lo = mesh.report.lo, hi = mesh.report.hi;
  view_.origin = Real(0.5) * lo + Real(0.5) * hi;
  Real half = 0;
  for (int k = 0; k < 3; k++)
    half = std::max(half, std::max(hi[k] - view_.origin[k], view_.origin[k] - lo[k]));
  int exponent = 0;
  std::frexp(half > 0 ? half : 1, &exponent);
  view_.inv_scale = std::ldexp(Real(1), -exponent);
  view_.lo = lo;
  for (int k = 0; k < 3; k++) view_.inv_size[k] = hi[k] > lo[k] ? 1 / (hi[k] - lo[k]) : 0;

  const std::size_t n = mesh.faces.size() + bare_edges_.size() + bare_vertices_.size();
  const std::size_t n_leaves = (n + kTreeWidth - 1) / kTreeWidth;
  leaves_ = OwnedArray<TreeLeaf, LargeMemory>(n_leaves);
  sides_ = OwnedArray<TreeSides, LargeMemory>(n_leaves);
  primitives_ = OwnedArray<TreePrimitive, LargeMemory>(n);
  std::vector<Item> items(n);
  for (std::size_t i = 0; i < n; i++) {
    const FeatureCode code = primitive_code(static_cast<std::uint32_t>(i));
    const std::uint32_t at = feature_index(code);
    Vec3 centre;
    if (feature_kind(code) == FeatureKind::face) {
      const auto &f = mesh.faces[at];
      centre = (1. / 3) * (view_.scaled(mesh.vertices[f[0]]) + view_.scaled(mesh.vertices[f[1]]) +
                           view_.scaled(mesh.vertices[f[2]]));
    } else if (feature_kind(code) == FeatureKind::edge) {
      centre = Real(0.5) * (view_.scaled(mesh.vertices[mesh.edges[at][0]]) +
                            view_.scaled(mesh.vertices[mesh.edges[at][1]]));
    } else {
      centre = view_.scaled(mesh.vertices[at]);
    }
    items[i] = {
        {static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z)},
        static_cast<std::uint32_t>(i)};
  }
  nodes_.reserve(n_leaves / 7 + 1);
  face_primitive_.resize(mesh.faces.size());
  Bounds all;
  view_.root = build(items.data(), items.data() + n, 0, all, progress);
  view_.nodes = nodes_.data();
  view_.leaves = leaves_.data();
  view_.sides = sides_.data();
  view_.primitives = primitives_.data();
  view_.n_primitives = static_cast<std::uint32_t>(n);
  view_.vertices = mesh.vertices.data();
  view_.edges = flat(mesh.edges);
  view_.edge_first = mesh.edge_first.data();
  view_.edge_face = mesh.edge_face.data();
  view_.faces = flat(mesh.faces);
  view_.vertex_first = mesh.vertex_first.data();
  view_.vertex_edge = mesh.vertex_edge.data();
  view_.face_primitive = face_primitive_.data();
  view_.names = names.view();
  view_.outside = mesh.report.volume < 0 ? -1 : 1;
}

FeatureCode TriangleTree::primitive_code(std::uint32_t number) const
{
  const std::size_t n_faces = mesh_.faces.size(), n_edges = bare_edges_.size();
  if (number < n_faces) return feature_code(FeatureKind::face, number);
  if (number < n_faces + n_edges)
    return feature_code(FeatureKind::edge, bare_edges_[number - n_faces]);
  return feature_code(FeatureKind::vertex, bare_vertices_[number - n_faces - n_edges]);
}

// Splits where the middle item along the longest side is, so that leaves and nodes are full but for the
// last ones. Returns the child that a node above has.
std::uint32_t TriangleTree::build(Item *first, Item *last, std::uint32_t start, Bounds &bounds,
                                  const ProgressListener &progress)
{
  constexpr std::size_t kToTell = 4096;    // items, some milliseconds
  const std::size_t n = last - first;
  if (progress && n >= kToTell)
    progress("tree", static_cast<double>(start) / static_cast<double>(primitives_.size()));
  if (n <= kTreeWidth) {
    make_leaf(first, last, start, bounds);
    return start / kTreeWidth | kTreeLeaf;
  }
  std::size_t of_child = kTreeWidth;
  while (of_child * kTreeWidth < n) of_child *= kTreeWidth;

  struct Part {
    Item *first, *last;
  } part[kTreeWidth] = {{first, last}};
  int n_parts = 1;
  // The largest part is split until all are children.
  for (;;) {
    int k = 0;
    for (int i = 1; i < n_parts; i++)
      if (part[i].last - part[i].first > part[k].last - part[k].first) k = i;
    const std::size_t size = part[k].last - part[k].first;
    if (size <= of_child) break;
    float lo[3], hi[3];
    for (int a = 0; a < 3; a++) lo[a] = hi[a] = part[k].first->centre[a];
    for (const Item *i = part[k].first; i < part[k].last; i++)
      for (int a = 0; a < 3; a++) {
        lo[a] = std::min(lo[a], i->centre[a]);
        hi[a] = std::max(hi[a], i->centre[a]);
      }
    int axis = 0;
    for (int a = 1; a < 3; a++)
      if (hi[a] - lo[a] > hi[axis] - lo[axis]) axis = a;
    const std::size_t children = (size + of_child - 1) / of_child;
    Item *middle = part[k].first + children / 2 * of_child;
    std::nth_element(part[k].first, middle, part[k].last, [axis](const Item &i, const Item &j) {
      return i.centre[axis] < j.centre[axis] ||
             (i.centre[axis] == j.centre[axis] && i.number < j.number);
    });
    for (int i = n_parts++; i > k + 1; i--) part[i] = part[i - 1];
    part[k + 1] = {middle, part[k].last};
    part[k].last = middle;
  }
  const std::size_t number = nodes_.size();
  nodes_.emplace_back();
  for (int k = 0; k < kTreeWidth; k++) {
    Bounds of_part = {{kTreeHuge, kTreeHuge, kTreeHuge}, {-kTreeHuge, -kTreeHuge, -kTreeHuge}};
    std::uint32_t child = kTreeLeaf;
    if (k < n_parts)
      child = build(part[k].first, part[k].last,
                    start + static_cast<std::uint32_t>(part[k].first - first), of_part, progress);
    TreeNode &node = nodes_[number];
    for (int a = 0; a < 3; a++) {
      node.lo[a][k] = k < n_parts ? of_part.lo[a] : kNoBox;
      node.hi[a][k] = k < n_parts ? of_part.hi[a] : kNoBox;
      bounds.lo[a] = k == 0 ? of_part.lo[a] : std::min(bounds.lo[a], of_part.lo[a]);
      bounds.hi[a] = k == 0 ? of_part.hi[a] : std::max(bounds.hi[a], of_part.hi[a]);
    }
    node.child[k] = child;
  }
  return static_cast<std::uint32_t>(number);
}

void TriangleTree::make_leaf(const Item *first, const Item *last, std::uint32_t start,
                             Bounds &bounds)
{
  TreeLeaf &leaf = leaves_.data()[start / kTreeWidth];
  leaf = TreeLeaf();
  const int n = static_cast<int>(last - first);
  Vec3 corner[kTreeWidth][3];
  Vec3 lo = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi = -lo;
  for (int k = 0; k < n; k++) {
    TreePrimitive &e = primitives_.data()[start + k];
    e = TreePrimitive();
    e.code = primitive_code(first[k].number);
    const std::uint32_t at = feature_index(e.code);
    for (int c = 0; c < 3; c++) {
      switch (feature_kind(e.code)) {
        case FeatureKind::face:
          e.vertex[c] = mesh_.faces[at][c];
          e.edge[c] = mesh_.face_edges[at][c];
          break;
        case FeatureKind::edge:
          e.vertex[c] = mesh_.edges[at][c > 0];
          e.edge[c] = at;
          break;
        default:
          e.vertex[c] = at;
      }
      const Vec3 x = view_.scaled(mesh_.vertices[e.vertex[c]]);
      corner[k][c] = x;
      for (int a = 0; a < 3; a++) {
        lo[a] = std::min(lo[a], x[a]);
        hi[a] = std::max(hi[a], x[a]);
      }
    }
    if (feature_kind(e.code) == FeatureKind::face) {
      face_primitive_[at] = start + k;
      const FaceRecord f = make_face_record(
          mesh_.vertices[e.vertex[0]], mesh_.vertices[e.vertex[1]], mesh_.vertices[e.vertex[2]]);
      e.normal = f.normal;
      std::copy(f.inward, f.inward + 3, e.inward);
      e.height = f.height;
    }
  }
  for (int a = 0; a < 3; a++) {
    bounds.lo[a] = below(lo[a]);
    bounds.hi[a] = above(hi[a]);
    leaf.origin[a] = static_cast<float>(Real(0.5) * (lo[a] + hi[a]));
  }
  const Vec3 origin = {leaf.origin[0], leaf.origin[1], leaf.origin[2]};
  Real size = 0;
  const auto put = [&](float(&normal)[3][kTreeWidth], float(&offset)[kTreeWidth], int k,
                       const Vec3 &n, Real at) {
    for (int a = 0; a < 3; a++) normal[a][k] = static_cast<float>(n[a]);
    offset[k] = static_cast<float>(at);
    size = std::max(size, std::fabs(at));
  };
  TreeSides &sides = sides_.data()[start / kTreeWidth];
  sides = TreeSides();
  for (int k = 0; k < n; k++)
    for (int c = 0; c < 3; c++) {
      const Vec3 from = corner[k][c] - origin;
      for (int a = 0; a < 3; a++) sides.corner[c][a][k] = static_cast<float>(from[a]);
      const Real square = norm_sq(corner[k][(c + 1) % 3] - corner[k][c]);
      sides.over_square[c][k] = square > Real(1e-30) ? static_cast<float>(1 / square) : 0;
    }
  for (int k = 0; k < n; k++) {
    const TreePrimitive &e = primitives_.data()[start + k];
    const Vec3 anchor = corner[k][0] - origin;
    if (feature_kind(e.code) == FeatureKind::face) {
      put(leaf.normal, leaf.offset, k, e.normal, -dot(e.normal, anchor));
      for (int s = 0; s < 3; s++)
        put(leaf.side[s], leaf.side_offset[s], k, e.inward[s],
            (s == 1 ? view_.inv_scale * e.height : 0) - dot(e.inward[s], anchor));
    } else if (feature_kind(e.code) == FeatureKind::edge) {
      // Between two planes at its ends, and on one along it.
      const Vec3 along = corner[k][1] - corner[k][0];
      const Real length = norm(along);
      if (!(length > 0)) continue;
      const Vec3 direction = (1 / length) * along, across = any_perpendicular(along);
      put(leaf.normal, leaf.offset, k, across, -dot(across, anchor));
      put(leaf.side[0], leaf.side_offset[0], k, direction, -dot(direction, anchor));
      put(leaf.side[1], leaf.side_offset[1], k, -direction, length + dot(direction, anchor));
    }    // that of a vertex stays 0: it is always tried
  }
  leaf.size = above(size);
}

const std::vector<std::uint32_t> &TriangleTree::flat_patches() const
{
  std::call_once(has_patches_, [&] { find_flat_patches(); });
  return patches_;
}

// Goes over edges from the first face of a patch, as long as normals are that of the first one but for rounding.
void TriangleTree::find_flat_patches() const
{
  constexpr Real kFlat = 1e-13;    // an angle
  const TreePrimitive *primitives = primitives_.data();
  patches_.assign(view_.n_primitives, kNoPrimitive);
  std::vector<std::uint32_t> waiting;
  for (const std::uint32_t first : face_primitive_) {
    if (patches_[first] != kNoPrimitive) continue;
    patches_[first] = first;
    waiting.assign(1, first);
    while (!waiting.empty()) {
      const TreePrimitive &from = primitives[waiting.back()];
      waiting.pop_back();
      for (const std::uint32_t e : from.edge)
        for (int k = view_.edge_first[e]; k < view_.edge_first[e + 1]; k++) {
          const std::uint32_t next = face_primitive_[view_.edge_face[k]];
          const Vec3 turn = primitives[next].normal - primitives[first].normal;
          if (patches_[next] != kNoPrimitive || !(norm_sq(turn) <= kFlat * kFlat)) continue;
          patches_[next] = first;
          waiting.push_back(next);
        }
    }
  }
  for (std::uint32_t i = 0; i < view_.n_primitives; i++)
    if (patches_[i] == kNoPrimitive) patches_[i] = i;
}

std::size_t TriangleTree::bytes() const
{
  return nodes_.capacity() * sizeof(TreeNode) +
         leaves_.size() * (sizeof(TreeLeaf) + sizeof(TreeSides)) +
         view_.n_primitives * sizeof(TreePrimitive) +
         (face_primitive_.size() + patches_.size()) * sizeof face_primitive_[0];
}

}    // namespace lsdcd
