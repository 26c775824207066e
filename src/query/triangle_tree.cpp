// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/triangle_tree.h"

#include "backend/threads.h"
#include "geometry/closest_point.h"
#include "mesh/wall_features.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace lsdcd {

namespace {

// Bounds in float are off by rounding: those of boxes by sqrt(3) half units of the point's largest
// coordinate, those of planes by six half units of their largest term, twice. Distances are widened by more.
constexpr float kBoxRounding = 2e-7f, kPlaneRounding = 1.2e-6f, kWiden = 1 + 2e-6f;
// Float holds the square of this.
constexpr float kHuge = 1e18f;
// Farther than this, in units of the mesh's size, the rounding of float would leave too many triangles.
constexpr Real kFarInUnits = 16;

float below(Real x)
{
  const float f = static_cast<float>(x);
  return f > x ? std::nextafter(f, -HUGE_VALF) : f;
}
float above(Real x)
{
  return -below(-x);
}

typedef float Eight __attribute__((vector_size(32), may_alias));
typedef int EightBits __attribute__((vector_size(32)));

const Eight &eight(const float *at)
{
  return *reinterpret_cast<const Eight *>(at);
}

// A bit for each lane that is true.
[[gnu::always_inline]] inline unsigned lanes(const EightBits &are)
{
#if defined(__x86_64__)
  const __m128i *half = reinterpret_cast<const __m128i *>(&are);
  return static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(half[0]))) |
         static_cast<unsigned>(_mm_movemask_ps(_mm_castsi128_ps(half[1]))) << 4;
#else
  unsigned bits = 0;
  for (int k = 0; k < 8; k++) bits |= (are[k] & 1u) << k;
  return bits;
#endif
}

struct ToSearch {
  float distance_sq;
  std::uint32_t child;
};
constexpr int kStack = 128;    // 7 a level, and 12 levels hold more than can be numbered

}    // namespace

TriangleTree::TriangleTree(const WallMesh &mesh, const TriangleTable &names,
                           const ProgressListener &progress) :
    mesh_(mesh),
    names_(names)
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
  origin_ = Real(0.5) * lo + Real(0.5) * hi;
  Real half = 0;
  for (int k = 0; k < 3; k++)
    half = std::max(half, std::max(hi[k] - origin_[k], origin_[k] - lo[k]));
  int exponent = 0;
  std::frexp(half > 0 ? half : 1, &exponent);
  scale_ = std::ldexp(Real(1), exponent);
  inv_scale_ = std::ldexp(Real(1), -exponent);
  lo_ = lo;
  for (int k = 0; k < 3; k++) inv_size_[k] = hi[k] > lo[k] ? 1 / (hi[k] - lo[k]) : 0;

  const std::size_t n = mesh.faces.size() + bare_edges_.size() + bare_vertices_.size();
  const std::size_t n_leaves = (n + kWide - 1) / kWide;
  leaves_ = OwnedArray<Leaf, LargeMemory>(n_leaves);
  sides_ = OwnedArray<Sides, LargeMemory>(n_leaves);
  exact_ = OwnedArray<Exact, LargeMemory>(n);
  std::vector<Item> items(n);
  for (std::size_t i = 0; i < n; i++) {
    const FeatureCode code = primitive_code(static_cast<std::uint32_t>(i));
    const std::uint32_t at = feature_index(code);
    Vec3 centre;
    if (feature_kind(code) == FeatureKind::face) {
      const auto &f = mesh.faces[at];
      centre = (1. / 3) * (scaled(mesh.vertices[f[0]]) + scaled(mesh.vertices[f[1]]) +
                           scaled(mesh.vertices[f[2]]));
    } else if (feature_kind(code) == FeatureKind::edge) {
      centre = Real(0.5) * (scaled(mesh.vertices[mesh.edges[at][0]]) +
                            scaled(mesh.vertices[mesh.edges[at][1]]));
    } else {
      centre = scaled(mesh.vertices[at]);
    }
    items[i] = {
        {static_cast<float>(centre.x), static_cast<float>(centre.y), static_cast<float>(centre.z)},
        static_cast<std::uint32_t>(i)};
  }
  nodes_.reserve(n_leaves / 7 + 1);
  root_ = build(items.data(), items.data() + n, 0, all_, progress);
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
std::uint32_t TriangleTree::build(Item *first, Item *last, std::uint32_t slot, Bounds &bounds,
                                  const ProgressListener &progress)
{
  constexpr std::size_t kToTell = 4096;    // items, some milliseconds
  const std::size_t n = last - first;
  if (progress && n >= kToTell)
    progress("tree", static_cast<double>(slot) / static_cast<double>(exact_.size()));
  if (n <= kWide) {
    make_leaf(first, last, slot, bounds);
    return slot / kWide | kLeafBit;
  }
  std::size_t of_child = kWide;
  while (of_child * kWide < n) of_child *= kWide;

  struct Part {
    Item *first, *last;
  } part[kWide] = {{first, last}};
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
  for (int k = 0; k < kWide; k++) {
    Bounds of_part = {{kHuge, kHuge, kHuge}, {-kHuge, -kHuge, -kHuge}};
    std::uint32_t child = kLeafBit;
    if (k < n_parts)
      child = build(part[k].first, part[k].last,
                    slot + static_cast<std::uint32_t>(part[k].first - first), of_part, progress);
    Node &node = nodes_[number];
    for (int a = 0; a < 3; a++) {
      node.lo[a][k] = k < n_parts ? of_part.lo[a] : std::numeric_limits<float>::max();
      node.hi[a][k] = k < n_parts ? of_part.hi[a] : std::numeric_limits<float>::max();
      bounds.lo[a] = k == 0 ? of_part.lo[a] : std::min(bounds.lo[a], of_part.lo[a]);
      bounds.hi[a] = k == 0 ? of_part.hi[a] : std::max(bounds.hi[a], of_part.hi[a]);
    }
    node.child[k] = child;
  }
  return static_cast<std::uint32_t>(number);
}

void TriangleTree::make_leaf(const Item *first, const Item *last, std::uint32_t slot,
                             Bounds &bounds)
{
  Leaf &leaf = leaves_.data()[slot / kWide];
  leaf = Leaf();
  const int n = static_cast<int>(last - first);
  Vec3 corner[kWide][3];
  Vec3 lo = {HUGE_VAL, HUGE_VAL, HUGE_VAL}, hi = -lo;
  for (int k = 0; k < n; k++) {
    Exact &e = exact_.data()[slot + k];
    e = Exact();
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
      const Vec3 x = scaled(mesh_.vertices[e.vertex[c]]);
      corner[k][c] = x;
      for (int a = 0; a < 3; a++) {
        lo[a] = std::min(lo[a], x[a]);
        hi[a] = std::max(hi[a], x[a]);
      }
    }
    if (feature_kind(e.code) == FeatureKind::face) {
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
  const auto put = [&](float(&normal)[3][kWide], float(&offset)[kWide], int k, const Vec3 &n,
                       Real at) {
    for (int a = 0; a < 3; a++) normal[a][k] = static_cast<float>(n[a]);
    offset[k] = static_cast<float>(at);
    size = std::max(size, std::fabs(at));
  };
  Sides &sides = sides_.data()[slot / kWide];
  sides = Sides();
  for (int k = 0; k < n; k++)
    for (int c = 0; c < 3; c++) {
      const Vec3 from = corner[k][c] - origin;
      for (int a = 0; a < 3; a++) sides.corner[c][a][k] = static_cast<float>(from[a]);
      const Real square = norm_sq(corner[k][(c + 1) % 3] - corner[k][c]);
      sides.over_square[c][k] = square > Real(1e-30) ? static_cast<float>(1 / square) : 0;
    }
  for (int k = 0; k < n; k++) {
    const Exact &e = exact_.data()[slot + k];
    const Vec3 anchor = corner[k][0] - origin;
    if (feature_kind(e.code) == FeatureKind::face) {
      put(leaf.normal, leaf.offset, k, e.normal, -dot(e.normal, anchor));
      for (int s = 0; s < 3; s++)
        put(leaf.side[s], leaf.side_offset[s], k, e.inward[s],
            (s == 1 ? inv_scale_ * e.height : 0) - dot(e.inward[s], anchor));
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

std::size_t TriangleTree::bytes() const
{
  return nodes_.capacity() * sizeof(Node) + leaves_.size() * (sizeof(Leaf) + sizeof(Sides)) +
         exact_.size() * sizeof(Exact);
}

Vec3 TriangleTree::place_in_box(const Vec3 &q) const
{
  Vec3 at;
  for (int k = 0; k < 3; k++)
    at[k] = std::min(std::max(Real(0), (q[k] - lo_[k]) * inv_size_[k]), Real(1));
  return at;
}

// ---- distances in double ------------------------------------------------------------------------

// An edge has one direction, a < b, so that all its triangles get the same bits.
Real TriangleTree::segment(std::uint32_t a, std::uint32_t b, std::uint32_t edge, const Vec3 &q,
                           FeatureCode &feature) const
{
  if (b < a) std::swap(a, b);
  const Vec3 &from = mesh_.vertices[a], &to = mesh_.vertices[b];
  const Vec3 along = to - from, d = q - from;
  const Real length_sq = norm_sq(along), t = dot(along, d);
  if (!(t > 0) || !(length_sq > 0)) {
    feature = feature_code(FeatureKind::vertex, a);
    return norm(d);
  }
  if (t >= length_sq) {
    feature = feature_code(FeatureKind::vertex, b);
    return norm(q - to);
  }
  feature = feature_code(FeatureKind::edge, edge);
  return norm(d - (t / length_sq) * along);
}

// The nearest point of a triangle is on its plane where that is inside all sides, else on a side that the
// point is past.
Real TriangleTree::exact(std::uint32_t primitive, const Vec3 &q, FeatureCode &feature) const
{
  const Exact &e = exact_.data()[primitive];
  if (feature_kind(e.code) == FeatureKind::face) {
    const Vec3 d = q - mesh_.vertices[e.vertex[0]];
    const Real side[3] = {dot(e.inward[0], d), dot(e.inward[1], d) + e.height, dot(e.inward[2], d)};
    if ((side[0] >= 0) & (side[1] >= 0) & (side[2] >= 0)) {
      feature = e.code;
      return std::fabs(dot(e.normal, d));
    }
    Real least = kAnyDistance;
    for (int k = 0; k < 3; k++) {
      if (side[k] >= 0) continue;
      FeatureCode here = kNoFeature;
      const Real distance = segment(e.vertex[k], e.vertex[(k + 1) % 3], e.edge[k], q, here);
      if (!(distance < least) && !(distance == least && here < feature)) continue;
      least = distance;
      feature = here;
    }
    return least;
  }
  if (feature_kind(e.code) == FeatureKind::edge)
    return segment(e.vertex[0], e.vertex[1], e.edge[0], q, feature);
  feature = e.code;
  return norm(q - mesh_.vertices[e.vertex[0]]);
}

[[gnu::always_inline]] inline void TriangleTree::attempt(std::uint32_t primitive, const Vec3 &q,
                                                         TreeAnswer &best) const
{
  FeatureCode feature = kNoFeature;
  const Real distance = exact(primitive, q, feature);
  if (!(distance <= best.distance)) return;
  if (distance == best.distance) {
    if (!best.found() || feature == best.feature) return;
    const TriangleNames names = names_.view();
    const std::uint32_t here = names.of(feature), there = names.of(best.feature);
    if (here > there || (here == there && feature > best.feature)) return;
  }
  best = {distance, feature, primitive};
}

// ---- search -------------------------------------------------------------------------------------

// Of several boxes the nearest is searched first.
[[gnu::always_inline]] inline void TriangleTree::search_near(const Vec3 &q, const Vec3 &at,
                                                             TreeAnswer &best) const
{
  const float x = static_cast<float>(at.x), y = static_cast<float>(at.y),
              z = static_cast<float>(at.z);
  const float rounding =
      kBoxRounding * std::fmax(std::fabs(x), std::fmax(std::fabs(y), std::fabs(z)));
  float most = 0, most_sq = 0;
  const auto bound = [&] {
    most = static_cast<float>(std::fmin(best.distance * inv_scale_, Real(kHuge))) * kWiden;
    most_sq = (most + rounding) * (most + rounding) * kWiden;
  };
  bound();
  ToSearch stack[kStack];
  int n = 0;
  std::uint32_t child = root_;
  const Node *const nodes = nodes_.data();
  const Leaf *const leaves = leaves_.data();
  const std::uint32_t n_exact = static_cast<std::uint32_t>(exact_.size());
  for (;;) {
    bool is_far = false;
    while (!(child & kLeafBit)) {
      const Node &node = nodes[child];
      const Eight none = {};
      Eight to_lo = eight(node.lo[0]) - x, to_hi = x - eight(node.hi[0]);
      Eight out = to_lo > to_hi ? to_lo : to_hi;
      out = out > none ? out : none;
      Eight distance_sq = out * out;
      to_lo = eight(node.lo[1]) - y, to_hi = y - eight(node.hi[1]);
      out = to_lo > to_hi ? to_lo : to_hi;
      out = out > none ? out : none;
      distance_sq += out * out;
      to_lo = eight(node.lo[2]) - z, to_hi = z - eight(node.hi[2]);
      out = to_lo > to_hi ? to_lo : to_hi;
      out = out > none ? out : none;
      distance_sq += out * out;
      unsigned near = lanes(distance_sq <= most_sq);
      if (near == 0) {
        is_far = true;
        break;
      }
      alignas(32) float of_child[kWide];
      *reinterpret_cast<Eight *>(of_child) = distance_sq;
      int k = __builtin_ctz(near);
      ToSearch first = {of_child[k], node.child[k]};
      for (near &= near - 1; near != 0; near &= near - 1) {
        k = __builtin_ctz(near);
        ToSearch next = {of_child[k], node.child[k]};
        if (next.distance_sq < first.distance_sq) std::swap(first, next);
        stack[n++] = next;
      }
      child = first.child;
    }
    if (!is_far) {
      const std::uint32_t number = child & ~kLeafBit, slot = number * kWide;
      const Leaf &leaf = leaves[number];
      const float dx = static_cast<float>(at.x - leaf.origin[0]),
                  dy = static_cast<float>(at.y - leaf.origin[1]),
                  dz = static_cast<float>(at.z - leaf.origin[2]);
      const Eight height = eight(leaf.normal[0]) * dx + eight(leaf.normal[1]) * dy +
                           eight(leaf.normal[2]) * dz + eight(leaf.offset);
      Eight past = {-kHuge, -kHuge, -kHuge, -kHuge, -kHuge, -kHuge, -kHuge, -kHuge};
      for (int s = 0; s < 3; s++) {
        const Eight outside = -(eight(leaf.side[s][0]) * dx + eight(leaf.side[s][1]) * dy +
                                eight(leaf.side[s][2]) * dz + eight(leaf.side_offset[s]));
        past = outside > past ? outside : past;
      }
      const Eight none = {}, beside = past > none ? past : none;
      Eight distance_sq = height * height + beside * beside;
      const float plane_rounding =
          kPlaneRounding * (std::fabs(dx) + std::fabs(dy) + std::fabs(dz) + leaf.size);
      const auto limit = [&] {
        const float l = most + plane_rounding;
        return l * l * kWiden;
      };
      unsigned near = lanes(distance_sq <= limit());
      if (slot + kWide > n_exact) near &= (1u << (n_exact - slot)) - 1;
      if ((near & (near - 1)) != 0) {
        // Several: past a corner that was too little. Beside a triangle its sides are nearest.
        const Sides &sides = sides_.data()[number];
        Eight least = {kHuge, kHuge, kHuge, kHuge, kHuge, kHuge, kHuge, kHuge};
        least *= least;
        for (int s = 0; s < 3; s++) {
          const auto &from = sides.corner[s], &to = sides.corner[s == 2 ? 0 : s + 1];
          Eight px = dx - eight(from[0]), py = dy - eight(from[1]), pz = dz - eight(from[2]);
          const Eight ex = eight(to[0]) - eight(from[0]), ey = eight(to[1]) - eight(from[1]),
                      ez = eight(to[2]) - eight(from[2]);
          Eight t = (px * ex + py * ey + pz * ez) * eight(sides.over_square[s]);
          t = t > none ? t : none;
          t = t < 1.0f ? t : none + 1.0f;
          px -= t * ex, py -= t * ey, pz -= t * ez;
          const Eight square = px * px + py * py + pz * pz;
          least = square < least ? square : least;
        }
        distance_sq = past > plane_rounding ? least : distance_sq;
        near &= lanes(distance_sq <= limit());
      }
      if (near != 0) {
        alignas(32) float of_lane[kWide];
        *reinterpret_cast<Eight *>(of_lane) = distance_sq;
        while (near != 0) {
          int least = __builtin_ctz(near);
          for (unsigned others = near & (near - 1); others != 0; others &= others - 1) {
            const int k = __builtin_ctz(others);
            if (of_lane[k] < of_lane[least]) least = k;
          }
          if (of_lane[least] > limit()) break;
          near &= ~(1u << least);
          if (slot + least == best.primitive) continue;
          attempt(slot + least, q, best);
          bound();
        }
      }
    }
    do {
      if (n == 0) return;
      n--;
    } while (stack[n].distance_sq > most_sq);
    child = stack[n].child;
  }
}

void TriangleTree::search_near_plain(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const
{
  search_near(q, at, best);
}
#if defined(__x86_64__)
[[gnu::target("avx2")]] void TriangleTree::search_near_avx2(const Vec3 &q, const Vec3 &at,
                                                            TreeAnswer &best) const
{
  search_near(q, at, best);
}
#endif

// The same with boxes in double and without planes.
void TriangleTree::search_far(const Vec3 &q, const Vec3 &at, TreeAnswer &best) const
{
  struct FarChild {
    Real distance;
    std::uint32_t child;
  } stack[kStack];
  int n = 0;
  const Real largest = std::fmax(std::fabs(at.x), std::fmax(std::fabs(at.y), std::fabs(at.z)));
  const auto most = [&] { return best.distance * inv_scale_ + 64 * kRoundoff * largest; };
  FarChild here = {0, root_};
  const std::uint32_t n_exact = static_cast<std::uint32_t>(exact_.size());
  for (;;) {
    if (here.child & kLeafBit) {
      const std::uint32_t slot = (here.child & ~kLeafBit) * kWide;
      for (std::uint32_t p = slot; p < std::min(slot + kWide, n_exact); p++) attempt(p, q, best);
    } else {
      const Node &node = nodes_[here.child];
      const int base = n;
      for (int k = 0; k < kWide; k++) {
        if (node.lo[0][k] == std::numeric_limits<float>::max()) continue;
        Vec3 out;
        for (int a = 0; a < 3; a++)
          out[a] = std::fmax(0, std::fmax(node.lo[a][k] - at[a], at[a] - node.hi[a][k]));
        const FarChild next = {norm(out), node.child[k]};
        if (!(next.distance <= most())) continue;
        int to = n++;
        for (; to > base && stack[to - 1].distance < next.distance; to--) stack[to] = stack[to - 1];
        stack[to] = next;
      }
    }
    do {
      if (n == 0) return;
      n--;
    } while (!(stack[n].distance <= most()));
    here = stack[n];
  }
}

bool &TriangleTree::wide()
{
#if defined(__x86_64__)
  static bool is = __builtin_cpu_supports("avx2");
#else
  static bool is = false;
#endif
  return is;
}

TreeAnswer TriangleTree::nearest(const Vec3 &q, Real radius, std::uint32_t hint) const
{
  TreeAnswer best = {radius, kNoFeature, kNoPrimitive};
  const Vec3 at = scaled(q);
  const Real largest = std::fmax(std::fabs(at.x), std::fmax(std::fabs(at.y), std::fabs(at.z)));
  // No numbers are far from everything.
  if (at.x - at.x == 0 && at.y - at.y == 0 && at.z - at.z == 0) {
    if (hint != kNoPrimitive) attempt(hint, q, best);
    if (!(largest <= kFarInUnits)) search_far(q, at, best);
#if defined(__x86_64__)
    else if (wide())
      search_near_avx2(q, at, best);
#endif
    else
      search_near_plain(q, at, best);
  }
  if (!best.found()) best.distance = kAnyDistance;
  return best;
}

bool TriangleTree::is_within(const Vec3 &q, Real radius, std::uint32_t &hint) const
{
  FeatureCode feature = kNoFeature;
  if (hint != kNoPrimitive && exact(hint, q, feature) < radius) return true;
  const TreeAnswer a = nearest(q, radius, kNoPrimitive);
  if (a.found()) hint = a.primitive;
  return a.found();
}

// ---- closest points -----------------------------------------------------------------------------

void TriangleTree::closest(const TreeAnswer &answer, const Vec3 &q, Vec3 &point, Vec3 &normal) const
{
  const std::uint32_t i = feature_index(answer.feature);
  if (feature_kind(answer.feature) == FeatureKind::face) {
    const Exact &e = exact_.data()[answer.primitive];
    normal = dot(e.normal, q - mesh_.vertices[e.vertex[0]]) < 0 ? -e.normal : e.normal;
    point = q - answer.distance * normal;
    return;
  }
  const bool is_edge = feature_kind(answer.feature) == FeatureKind::edge;
  Vec3 along = {0, 0, 0};
  if (is_edge) {
    const Vec3 &from = mesh_.vertices[mesh_.edges[i][0]];
    along = mesh_.vertices[mesh_.edges[i][1]] - from;
    point = from + (dot(along, q - from) / norm_sq(along)) * along;
  } else {
    point = mesh_.vertices[i];
  }
  const Vec3 apart = q - point;
  const Real distance = norm(apart);
  if (distance > kNoDistance) {
    normal = (1 / distance) * apart;
    return;
  }
  // q is there: the normal points away from the faces of the edge, or from the edges of the vertex.
  Vec3 away = {0, 0, 0};
  const auto leave = [&](const Vec3 &to) {
    const Real length = norm(to);
    if (length > 0) away -= (1 / length) * to;
  };
  if (is_edge) {
    for (int k = mesh_.edge_first[i]; k < mesh_.edge_first[i + 1]; k++)
      for (const int v : mesh_.faces[mesh_.edge_face[k]])
        if (v != mesh_.edges[i][0] && v != mesh_.edges[i][1]) {
          const Vec3 to = mesh_.vertices[v] - point;
          leave(to - (dot(to, along) / norm_sq(along)) * along);
        }
  } else {
    for (int k = mesh_.vertex_first[i]; k < mesh_.vertex_first[i + 1]; k++) {
      const auto &ends = mesh_.edges[mesh_.vertex_edge[k]];
      along = mesh_.vertices[ends[ends[0] == static_cast<int>(i)]] - point;
      leave(along);
    }
  }
  const Real length = norm(away);
  if (length > Real(1e-6)) {
    normal = (1 / length) * away;
    return;
  }
  // Its faces are flat there: the normal is that of one of them.
  normal = any_perpendicular(along);
  if (!is_edge && mesh_.vertex_first[i] == mesh_.vertex_first[i + 1]) return;
  const int edge = is_edge ? static_cast<int>(i) : mesh_.vertex_edge[mesh_.vertex_first[i]];
  if (mesh_.edge_first[edge] < mesh_.edge_first[edge + 1]) {
    const auto &f = mesh_.faces[mesh_.edge_face[mesh_.edge_first[edge]]];
    normal =
        make_face_record(mesh_.vertices[f[0]], mesh_.vertices[f[1]], mesh_.vertices[f[2]]).normal;
  }
}

}    // namespace lsdcd
