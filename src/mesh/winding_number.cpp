// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/winding_number.h"

#include "base/input_error.h"
#include "base/number_words.h"
#include "base/vector_text.h"
#include "geometry/orientation.h"
#include "mesh/counted_facets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace lsdcd {

namespace {

std::vector<Triangle> closed_facets(const WeldedMesh &mesh)
{
  const std::string why = why_no_inside(mesh);
  if (!why.empty()) throw InputError(mesh.source + " has no inside: " + why);
  return whole_surface(mesh, CountedFacets(mesh));
}

// Facets that a ray has crossed: one in several cells counts once.
class Crossed {
 public:
  bool is_new(std::uint32_t facet)
  {
    for (int k = 0; k < n_; k++)
      if (some_[k] == facet) return false;
    if (std::find(more_.begin(), more_.end(), facet) != more_.end()) return false;
    if (n_ < kRoom)
      some_[n_++] = facet;
    else
      more_.push_back(facet);
    return true;
  }

 private:
  static constexpr int kRoom = 16;
  std::uint32_t some_[kRoom];
  int n_ = 0;
  std::vector<std::uint32_t> more_;
};

int sign_of(Real a)
{
  return (a > 0) - (a < 0);
}

// The projection of a point along an axis lies on the line from a to b. The side of the line on which it lies when
// it is moved by an infinitesimal e along u and e^2 along v. 0: the line is a point.
int side_when_moved(int u, int v, const Vec3 &a, const Vec3 &b)
{
  const int along_u = sign_of(a[v] - b[v]);
  return along_u != 0 ? along_u : sign_of(b[u] - a[u]);
}

// A cell is at least this part of the mean length of facets: n long ones, as in a fan, would cross sqrt(n) cells each.
constexpr Real kCellsPerFacet = 2, kLeastOfLength = 1. / 16;
constexpr int kMaxCellsAlong = 2048;
// On a ray's way: from here on a tree is quicker, and so many are worth its memory.
constexpr std::uint32_t kMany = 256, kWorthATree = 1024;
// Pieces of facets are listed in cells that are wider by this part of a cell and this part of the largest
// coordinate. Cutting a facet rounds by half a unit of the last place each time, less than 20 times.
// Cells are wide beside that.
constexpr Real kWider = 1e-6, kWiderByRounding = 64 * kRoundoff,
               kThinnestCell = 8 * kWiderByRounding;

}    // namespace

bool has_inside(const WeldedMesh &mesh)
{
  if (mesh.dropped.empty() && mesh.report.open_edges > 0) return false;
  return why_no_inside(mesh).empty();
}

std::string why_no_inside(const WeldedMesh &mesh)
{
  if (is_known_closed(mesh)) return "";
  if (mesh.faces.empty()) return "it has no facets with an area";
  const CountedFacets facets(mesh);
  const std::string both_ways = " there in both windings, as in a double-sided export",
                    remedy = ": lsdcd repair keeps one of each pair";
  if (facets.facets.empty())
    return "each of its facets is" + both_ways + ", so it encloses nothing" + remedy;
  std::string some;
  if (!facets.sheets.empty())
    some = std::to_string(facets.sheets.size()) + " of " + counted(mesh.faces.size(), "facet") +
           (facets.sheets.size() == 1 ? " is" : " are") + both_ways;
  if (facets.loose.empty())
    return enclose(mesh, facets.sheets)
               ? some + ", and what they enclose is neither inside nor outside" + remedy
               : "";
  if (!some.empty()) some += ", so neither winding counts; ";
  const std::size_t open = std::count_if(facets.loose.begin(), facets.loose.end(),
                                         [](const LooseEdge &e) { return e.facets == 1; });
  const LooseEdge &first = facets.loose[0];
  return some + counted(open, "edge is", "edges are") + " open, and along " +
         std::to_string(facets.loose.size() - open) +
         " more facets are wound against each other; the first goes from " +
         vector_text(mesh.vertices[std::min(first.from, first.to)]) + " to " +
         vector_text(mesh.vertices[std::max(first.from, first.to)]) +
         ": close the mesh, or try lsdcd repair";
}

WindingNumber::WindingNumber(const WeldedMesh &mesh, const ProgressListener &progress) :
    WindingNumber(closed_facets(mesh), progress)
{
}

WindingNumber::WindingNumber(std::vector<Triangle> closed, const ProgressListener &progress) :
    facets_(std::move(closed))
{
  if (facets_.empty()) {    // each facet has one against it
    box_ = {{1, 1, 1}, {-1, -1, -1}};
    return;
  }
  box_ = {facets_[0].corner[0], facets_[0].corner[0]};
  for (const Triangle &f : facets_)
    for (const Vec3 &x : f.corner) extend(box_, x);
  choose_cells();
  list_facets(progress);
  if (choose_directions(progress) > kWorthATree) build_tree();
  number_empty_cells(progress);
}

Real WindingNumber::largest_coordinate() const
{
  Real largest = 0;
  for (int k = 0; k < 3; k++)
    largest = std::max({largest, std::fabs(box_.lo[k]), std::fabs(box_.hi[k])});
  return largest;
}

// Cubes as far as the box allows.
void WindingNumber::choose_cells()
{
  const Vec3 size = box_.hi - box_.lo;
  const Real wanted = std::min(kCellsPerFacet * static_cast<Real>(facets_.size()), Real(1 << 28));
  Real cell = std::max({size.x, size.y, size.z});
  const auto along = [&](int k) {
    const Real most =
        std::min(size[k] / (kThinnestCell * largest_coordinate()), Real(kMaxCellsAlong));
    return std::min(std::ceil(size[k] / cell), std::floor(most));
  };
  const auto cells = [&] {
    return std::max(along(0), Real(1)) * std::max(along(1), Real(1)) * std::max(along(2), Real(1));
  };
  Real lengths = 0;
  for (const Triangle &f : facets_)
    lengths += std::max({norm(f[1] - f[0]), norm(f[2] - f[1]), norm(f[0] - f[2])});
  const Real least = kLeastOfLength * lengths / static_cast<Real>(facets_.size());
  for (int i = 0; i < 200 && cells() < wanted && cell > least; i++) cell /= 1.1;
  for (int k = 0; k < 3; k++) {
    n_[k] = std::max(static_cast<int>(along(k)), 1);
    length_[k] = size[k] / n_[k];
    per_length_[k] = n_[k] > 1 ? 1 / length_[k] : 0;
  }
  stride_ = {std::ptrdiff_t(n_[1]) * n_[2], n_[2], 1};
}

// A facet is cut in pieces, whose boxes are at most two cells wide.
void WindingNumber::list_facets(const ProgressListener &progress)
{
  constexpr std::uint32_t kPart = 1 << 13;    // milliseconds
  struct Entry {
    std::uint32_t cell, facet;
  };
  std::vector<Entry> entries;
  std::vector<std::uint32_t> last(stride_[0] * n_[0], kEmpty);    // that a cell lists
  std::vector<Triangle> pieces;
  const Real largest = largest_coordinate();
  for (std::uint32_t f = 0; f < facets_.size(); f++) {
    if (progress && f % kPart == 0) progress("cells for sides", double(f) / double(facets_.size()));
    pieces.push_back(facets_[f]);
    while (!pieces.empty()) {
      const Triangle piece = pieces.back();
      pieces.pop_back();
      const Box box = box_around(piece.corner[0], piece.corner[1], piece.corner[2]);
      Index lo, hi;
      bool is_small = true;
      for (int k = 0; k < 3; k++) {
        const Real wider = kWider * length_[k] + kWiderByRounding * largest;
        lo[k] = cell_along(k, std::max(box.lo[k] - wider, box_.lo[k]));
        hi[k] = cell_along(k, std::min(box.hi[k] + wider, box_.hi[k]));
        is_small = is_small && hi[k] - lo[k] < 2;
      }
      if (!is_small) {
        const auto edge = [&](int k) {
          const Vec3 d = piece.corner[(k + 1) % 3] - piece.corner[k];
          Real most = 0;
          for (int a = 0; a < 3; a++) most = std::max(most, std::fabs(d[a]) * per_length_[a]);
          return most;
        };
        int k = edge(0) >= edge(1) ? 0 : 1;
        if (edge(2) > edge(k)) k = 2;
        const Vec3 middle = 0.5 * piece.corner[k] + 0.5 * piece.corner[(k + 1) % 3];
        Triangle half = piece;
        half.corner[k] = middle;
        pieces.push_back(half);
        half = piece;
        half.corner[(k + 1) % 3] = middle;
        pieces.push_back(half);
        continue;
      }
      for (int i = lo[0]; i <= hi[0]; i++)
        for (int j = lo[1]; j <= hi[1]; j++)
          for (int k = lo[2]; k <= hi[2]; k++) {
            const auto cell = static_cast<std::uint32_t>(cell_number({i, j, k}));
            if (last[cell] != f) entries.push_back({cell, f});
            last[cell] = f;
          }
    }
  }
  cells_.assign(last.size(), {kEmpty, 0});
  for (const Entry &e : entries) cells_[e.cell].number++;
  std::uint32_t first = 0;
  for (Cell &c : cells_)
    if (c.number > 0) {
      c.first = first;
      first += c.number;
      c.number = 0;
    }
  listed_.resize(entries.size());
  for (const Entry &e : entries) {
    Cell &c = cells_[e.cell];
    listed_[c.first + c.number++] = e.facet;
  }
}

// From each cell with facets, the way to an empty cell, or out of the box, that looks at the fewest. Returns
// the most that one looks at.
std::uint32_t WindingNumber::choose_directions(const ProgressListener &progress)
{
  direction_.assign(cells_.size(), 0);
  std::vector<std::uint32_t> least(cells_.size(), std::numeric_limits<std::uint32_t>::max());
  for (int axis = 0; axis < 3; axis++) {
    if (progress) progress("ways to empty cells", axis / 3.);
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (int i = 0; i < n_[u]; i++)
      for (int j = 0; j < n_[v]; j++)
        for (const int down : {0, 1}) {
          std::size_t cell = i * stride_[u] + j * stride_[v];
          if (!down) cell += (n_[axis] - 1) * stride_[axis];
          std::uint32_t on_way = 0;
          for (int k = 0; k < n_[axis]; k++, cell += down ? stride_[axis] : -stride_[axis]) {
            on_way = cells_[cell].first == kEmpty ? 0 : on_way + cells_[cell].number;
            if (on_way == 0 || on_way >= least[cell]) continue;
            least[cell] = on_way;
            direction_[cell] = static_cast<std::uint8_t>(2 * axis + down);
          }
        }
  }
  std::uint32_t most = 0;
  for (std::size_t cell = 0; cell < cells_.size(); cell++)
    if (cells_[cell].first != kEmpty) most = std::max(most, least[cell]);
  return most;
}

void WindingNumber::build_tree()
{
  std::vector<Box> boxes;
  boxes.reserve(facets_.size());
  for (const Triangle &f : facets_)
    boxes.push_back(box_around(f.corner[0], f.corner[1], f.corner[2]));
  tree_ = std::make_unique<const BoxTree>(boxes);
}

// In the order of cells, so that those below have their numbers.
void WindingNumber::number_empty_cells(const ProgressListener &progress)
{
  constexpr int kDownZ = 5;
  std::size_t cell = 0;
  for (int i = 0; i < n_[0]; i++) {
    if (progress) progress("sides of empty cells", double(i) / n_[0]);
    for (int j = 0; j < n_[1]; j++)
      for (int k = 0; k < n_[2]; k++, cell++) {
        if (cells_[cell].first != kEmpty) continue;
        const auto is_empty = [&](int axis) {
          return cells_[cell - stride_[axis]].first == kEmpty;
        };
        if (i == 0 || j == 0 || k == 0)
          cells_[cell].number = 0;    // its outer face is outside
        else if (is_empty(2))
          cells_[cell].number = cells_[cell - stride_[2]].number;
        else if (is_empty(1))
          cells_[cell].number = cells_[cell - stride_[1]].number;
        else if (is_empty(0))
          cells_[cell].number = cells_[cell - stride_[0]].number;
        else
          cells_[cell].number =
              walk({box_.lo.x + (i + 0.5) * length_.x, box_.lo.y + (j + 0.5) * length_.y,
                    box_.lo.z + (k + 0.5) * length_.z},
                   {i, j, k - 1}, kDownZ)
                  .number;
      }
  }
}

// The number that a facet adds to that of a ray's origin. A facet whose projection along the ray has no
// area is never crossed.
int WindingNumber::crossing(const Triangle &facet, const Ray &ray, bool &on_surface)
{
  const int axis = ray.axis, u = axis == 0 ? 1 : 0, v = axis == 2 ? 1 : 2;
  const Vec3 &a = facet.corner[0], &b = facet.corner[1], &c = facet.corner[2], &q = ray.from;
  for (const int d : {u, v}) {
    if (a[d] < q[d] && b[d] < q[d] && c[d] < q[d]) return 0;
    if (a[d] > q[d] && b[d] > q[d] && c[d] > q[d]) return 0;
  }
  const int on[3] = {orientation_along(axis, a, b, q), orientation_along(axis, b, c, q),
                     orientation_along(axis, c, a, q)};
  const bool left = on[0] > 0 || on[1] > 0 || on[2] > 0,
             right = on[0] < 0 || on[1] < 0 || on[2] < 0;
  if (left && right) return 0;
  const int behind = orientation(a, b, c, q);    // its normal points away from q
  if (!left && !right) {                         // the projection is a segment, and q on its line
    on_surface = on_surface || lies_on(facet, q);
    return 0;
  }
  if (behind == 0) {
    on_surface = true;
    return 0;
  }
  const int side = left ? 1 : -1;
  if ((on[0] == 0 && side_when_moved(u, v, a, b) != side) ||
      (on[1] == 0 && side_when_moved(u, v, b, c) != side) ||
      (on[2] == 0 && side_when_moved(u, v, c, a) != side))
    return 0;
  if (ray.ends) return orientation(a, b, c, ray.end) == -behind ? behind : 0;
  // Along y, u and v are z and x in the wrong order.
  const int normal = axis == 1 ? -side : side;
  return behind * normal == (ray.up ? 1 : -1) ? behind : 0;
}

WindingNumber::Answer WindingNumber::walk(const Vec3 &q, const Index &at, int direction) const
{
  Ray ray = {q, q, direction / 2, direction % 2 == 0, false};
  const std::ptrdiff_t step = ray.up ? stride_[ray.axis] : -stride_[ray.axis];
  const std::size_t first = cell_number(at);
  std::size_t end = first;
  int i = at[ray.axis];
  Answer answer = {false, 0};
  std::uint32_t on_way = 0;
  for (; i >= 0 && i < n_[ray.axis]; i += ray.up ? 1 : -1, end += step)
    if (cells_[end].first == kEmpty) {
      ray.ends = true;
      ray.end[ray.axis] = box_.lo[ray.axis] + (i + 0.5) * length_[ray.axis];
      answer.number = cells_[end].number;
      break;
    } else {
      on_way += cells_[end].number;
    }
  if (tree_ && on_way > kMany) {
    Box way = {q, q};
    if (ray.ends)
      extend(way, ray.end);
    else
      (ray.up ? way.hi : way.lo)[ray.axis] = (ray.up ? box_.hi : box_.lo)[ray.axis];
    tree_->visit([&](const Box &box) { return overlap(box, way); },
                 [&](int f) { answer.number += crossing(facets_[f], ray, answer.on_surface); });
    return answer;
  }
  Crossed crossed;
  for (std::size_t cell = first; cell != end; cell += step) {
    const Cell &c = cells_[cell];
    for (std::uint32_t k = c.first; k < c.first + c.number; k++) {
      const int sum = crossing(facets_[listed_[k]], ray, answer.on_surface);
      if (answer.on_surface) return answer;
      if (sum != 0 && crossed.is_new(listed_[k])) answer.number += sum;
    }
  }
  return answer;
}

WindingNumber::Answer WindingNumber::at(const Vec3 &q) const
{
  Index at;
  for (int k = 0; k < 3; k++) {
    if (!(q[k] >= box_.lo[k] && q[k] <= box_.hi[k])) return {false, 0};    // also not a number
    at[k] = cell_along(k, q[k]);
  }
  const std::size_t cell = cell_number(at);
  if (cells_[cell].first == kEmpty) return {false, cells_[cell].number};
  return walk(q, at, direction_[cell]);
}

std::size_t WindingNumber::bytes() const
{
  return facets_.capacity() * sizeof(Triangle) + cells_.capacity() * sizeof(Cell) +
         direction_.capacity() + listed_.capacity() * sizeof(std::uint32_t) +
         (tree_ ? tree_->bytes() : 0);
}

}    // namespace lsdcd
