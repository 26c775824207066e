#include "grid/triangle_grid.h"

#include <cstdio>
#include <cstring>

namespace lsdcd {

namespace {

constexpr std::size_t kAlign = 64;

std::size_t rounded(std::size_t bytes)
{
  return (bytes + kAlign - 1) / kAlign * kAlign;
}

// Front of a flat block: the scalars, and where each array starts.
struct FlatHeader {
  Vec3 origin;
  Real length, reach, slack, outside;
  std::int32_t n_bricks[3];
  std::uint64_t offset[13];
  std::uint64_t bytes;    // of the whole block
};

// The one list of a grid's arrays; flat_bytes, flatten and flat_view follow it.
template <class Visit>
void each_array(const TriangleGrid &g, Visit visit)
{
  visit(0, g.wall.faces);
  visit(1, g.wall.edges);
  visit(2, g.wall.vertices);
  visit(3, g.wall.edge_inward);
  visit(4, g.wall.vertex_direction);
  visit(5, g.wall.face_vertex);
  visit(6, g.wall.edge_vertex);
  visit(7, g.wall.edge_out);
  visit(8, g.wall.vertex_out);
  visit(9, g.brick_of);
  visit(10, g.bricks);
  visit(11, g.cells);
  visit(12, g.candidates);
}

template <class T>
std::size_t array_bytes(const std::vector<T> &a)
{
  return a.size() * sizeof(T);
}

std::string amount(double bytes)
{
  char text[32];
  if (bytes < 1e6)
    std::snprintf(text, sizeof text, "%.1f kB", bytes / 1e3);
  else
    std::snprintf(text, sizeof text, "%.1f MB", bytes / 1e6);
  return text;
}

}    // namespace

GridView TriangleGrid::view() const
{
  GridView v;
  v.wall = {wall.faces.data(),
            wall.edges.data(),
            wall.vertices.data(),
            wall.edge_inward.data(),
            wall.vertex_direction.data(),
            wall.face_vertex.data(),
            wall.edge_vertex.data(),
            wall.edge_out.data(),
            wall.vertex_out.data()};
  v.origin = origin;
  v.length = length;
  v.inv_length = 1 / length;
  v.reach = reach;
  v.slack = slack;
  v.outside = outside;
  for (int k = 0; k < 3; k++) v.n_bricks[k] = n_bricks[k];
  v.brick_of = brick_of.data();
  v.bricks = bricks.data();
  v.cells = cells.data();
  v.candidates = candidates.data();
  v.block = nullptr;
  v.block_bytes = 0;
  return v;
}

std::size_t flat_bytes(const TriangleGrid &grid)
{
  std::size_t total = rounded(sizeof(FlatHeader));
  each_array(grid, [&](int, const auto &a) { total += rounded(array_bytes(a)); });
  return total;
}

void flatten(const TriangleGrid &grid, char *block)
{
  FlatHeader header = {};
  header.origin = grid.origin;
  header.length = grid.length;
  header.reach = grid.reach;
  header.slack = grid.slack;
  header.outside = grid.outside;
  for (int k = 0; k < 3; k++) header.n_bricks[k] = grid.n_bricks[k];
  std::size_t at = rounded(sizeof(FlatHeader));
  each_array(grid, [&](int i, const auto &a) {
    header.offset[i] = at;
    if (!a.empty()) std::memcpy(block + at, a.data(), array_bytes(a));
    at += rounded(array_bytes(a));
  });
  header.bytes = at;
  std::memcpy(block, &header, sizeof header);
}

GridView flat_view(const char *block)
{
  FlatHeader header;
  std::memcpy(&header, block, sizeof header);
  const char *at[13];
  for (int i = 0; i < 13; i++) at[i] = block + header.offset[i];
  GridView v;
  v.wall = {
      reinterpret_cast<const FaceRecord *>(at[0]),   reinterpret_cast<const EdgeRecord *>(at[1]),
      reinterpret_cast<const VertexRecord *>(at[2]), reinterpret_cast<const Vec3 *>(at[3]),
      reinterpret_cast<const Vec3 *>(at[4]),         reinterpret_cast<const FaceVertices *>(at[5]),
      reinterpret_cast<const EdgeVertices *>(at[6]), reinterpret_cast<const Vec3 *>(at[7]),
      reinterpret_cast<const Vec3 *>(at[8])};
  v.origin = header.origin;
  v.length = header.length;
  v.inv_length = 1 / header.length;
  v.reach = header.reach;
  v.slack = header.slack;
  v.outside = header.outside;
  for (int k = 0; k < 3; k++) v.n_bricks[k] = header.n_bricks[k];
  v.brick_of = reinterpret_cast<const std::int32_t *>(at[9]);
  v.bricks = reinterpret_cast<const Brick *>(at[10]);
  v.cells = reinterpret_cast<const Cell *>(at[11]);
  v.candidates = reinterpret_cast<const Candidate *>(at[12]);
  v.block = block;
  v.block_bytes = header.bytes;
  return v;
}

std::string describe(const GridReport &r)
{
  char text[512];
  std::snprintf(text, sizeof text,
                "  grid %.6g (%s), reach %.6g: %zu bricks, %zu cells, %zu candidates, "
                "lists %.2f on average, %zu at most\n"
                "  %s, built in %.3f s with %.3g distance tests on %s",
                r.length, r.length_chosen ? "chosen" : "given", r.reach, r.bricks, r.cells,
                r.candidates, r.mean_list, r.longest_list, amount(double(r.bytes)).c_str(),
                r.seconds, double(r.distance_tests), r.device.c_str());
  return text;
}

}    // namespace lsdcd
