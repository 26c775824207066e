// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Cells of a mesh whose nodes move, against the distances of another method, and cells and records between backends.
#include "backend/backend_cpu.h"
#include "support/device.h"
#include "support/meshes.h"
#include "support/moved_records.h"
#include "support/node_lists.h"
#include "support/query_oracle.h"
#include "support/random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <vector>

namespace lsdcd::test_node_grid {
namespace {

constexpr Real kCutoff = 0.5, kAllowance = 0.1;

// Many triangles have one corner, so that lists are long.
WeldedMesh cone()
{
  return weld(cone_mesh(300, 6, 4), -1);
}
// Two triangles a side, far from the origin: each reaches many cells.
WeldedMesh large_box()
{
  return weld(box_mesh({1000, -20, 30}, {1060, 20, 90}), -1);
}

MovingGridSettings settings_of(const WeldedMesh &mesh)
{
  Box box = {mesh.vertices.front(), mesh.vertices.front()};
  for (const Vec3 &x : mesh.vertices) extend(box, x);
  return {kCutoff, kAllowance, 1, box, "mesh"};
}

// The list of the cell that holds a point.
std::vector<CellEntry> list_at(const NodeLists &lists, const Vec3 &x)
{
  const GridView &grid = lists.scalars;
  long cell[3];
  for (int d = 0; d < 3; d++) {
    cell[d] = static_cast<long>(std::floor((x[d] - grid.origin[d]) / grid.length));
    if (cell[d] < 0 || cell[d] >= 8L * grid.n_bricks[d]) return {};
  }
  const long place =
      (cell[2] / 8 * grid.n_bricks[1] + cell[1] / 8) * grid.n_bricks[0] + cell[0] / 8;
  const int brick = lists.brick_of[place];
  if (brick < 0) return {};
  const BrickLayer &layer = lists.bricks[brick].layer[cell[2] % 8];
  long at = layer.first_cell;
  const long bit = cell[1] % 8 * 8 + cell[0] % 8;
  for (long k = 0; k < bit; k++) at += layer.mask >> k & 1;
  if (!(layer.mask >> bit & 1)) return {};
  const Cell &of = lists.cells[at];
  if (of.count == 1) return {{of.first, -HUGE_VALF}};
  const auto first = lists.entries.begin() + of.first;
  return {first, first + of.count};
}
Vec3 centre_of_cell(const GridView &grid, const Vec3 &x)
{
  Vec3 centre;
  for (int d = 0; d < 3; d++)
    centre[d] = grid.origin[d] +
                grid.length * (std::floor((x[d] - grid.origin[d]) / grid.length) + Real(0.5));
  return centre;
}

// Each list has all that a sphere in its cell can touch before a node has gone the allowance, is sorted, and has bounds
// that are none too large. Rounding of places is at most 1e-12 here, and of bounds 1e-6.
void expect_complete(const WeldedMesh &mesh, int n_points)
{
  const MovingGridSettings settings = settings_of(mesh);
  const NodeLists lists = node_lists_by(CpuBackend(), mesh, settings);
  Random random(11);
  int n_near = 0, n_listed = 0;
  for (int k = 0; k < n_points; k++) {
    Vec3 x;    // near a triangle
    const auto &face =
        mesh.faces[static_cast<std::size_t>(uniform(random, 0, 1) * double(mesh.faces.size()))];
    Real a = uniform(random, 0, 1), b = uniform(random, 0, 1);
    if (a + b > 1) a = 1 - a, b = 1 - b;
    for (int d = 0; d < 3; d++)
      x[d] =
          mesh.vertices[face[0]][d] + a * (mesh.vertices[face[1]][d] - mesh.vertices[face[0]][d]) +
          b * (mesh.vertices[face[2]][d] - mesh.vertices[face[0]][d]) + uniform(random, -0.7, 0.7);
    const std::vector<CellEntry> list = list_at(lists, x);
    const Vec3 centre = centre_of_cell(lists.scalars, x);
    n_listed += static_cast<int>(list.size());
    for (std::size_t i = 1; i < list.size(); i++)
      EXPECT_TRUE(list[i - 1].bound < list[i].bound ||
                  (list[i - 1].bound == list[i].bound && list[i - 1].feature < list[i].feature));
    for (std::size_t f = 0; f < mesh.faces.size(); f++) {
      const auto corner = [&](int c) { return mesh.vertices[mesh.faces[f][c]]; };
      const auto distance = [&](const Vec3 &from) {
        return std::sqrt(region_distance_sq(corner(0), corner(1), corner(2), from));
      };
      const FeatureCode code = feature_code(FeatureKind::face, static_cast<std::uint32_t>(f));
      const auto at = std::find_if(list.begin(), list.end(),
                                   [&](const CellEntry &c) { return c.feature == code; });
      if (distance(x) <= kCutoff + kAllowance - 1e-12) {
        n_near++;
        EXPECT_NE(at, list.end()) << "face " << f;
      }
      if (at != list.end()) {
        EXPECT_LE(at->bound, distance(centre) - kAllowance + 1e-12);
      }
    }
  }
  EXPECT_GT(n_near, n_points / 2);
  EXPECT_LT(n_listed, 40 * n_near);    // a list that has all would be no test
}

TEST(node_grid, cells_list_all_that_comes_within_the_cutoff)
{
  expect_complete(waves(), 4000);
  expect_complete(cone(), 2000);
  expect_complete(large_box(), 4000);
}

// Threads may come in any order.
struct BackwardBackend : CpuBackend {
  template <class F>
  void for_each(std::size_t n, const F &f, unsigned = 0)
  {
    for (std::size_t i = n; i-- > 0;) f(i);
  }
};

void expect_same(const NodeLists &a, const NodeLists &b)
{
  EXPECT_EQ(a.scalars.length, b.scalars.length);
  EXPECT_TRUE(a.scalars.origin == b.scalars.origin);
  EXPECT_EQ(a.scalars.tolerance, b.scalars.tolerance);
  expect_same_bytes(a.brick_of, b.brick_of);
  expect_same_bytes(a.bricks, b.bricks);
  expect_same_bytes(a.cells, b.cells);
  expect_same_bytes(a.entries, b.entries);
}

TEST(node_grid, lists_do_not_depend_on_the_order_of_threads)
{
  for (const WeldedMesh &mesh : {waves(), cone(), large_box()})
    expect_same(node_lists_by(CpuBackend(), mesh, settings_of(mesh)),
                node_lists_by(BackwardBackend(), mesh, settings_of(mesh)));
}

#if defined(LSDCD_HAVE_CUDA)
TEST(node_grid, a_GPU_builds_the_same_lists)
{
  if (!test_on_cuda()) GTEST_SKIP() << "for a GPU";
  for (const WeldedMesh &mesh : {waves(), cone(), large_box()})
    expect_same(node_lists_by(CpuBackend(), mesh, settings_of(mesh)),
                node_lists_on_cuda(mesh, settings_of(mesh)));
}
#endif

// That mesh has its records by long double. Normals of faces that are not thin are right to 4 kRoundoff/0.05 = 2e-14, as are
// what follows from them; places are up to 8.
TEST(moving_nodes, have_the_records_of_a_mesh_that_is_made_where_they_are)
{
  const MovedWaves waves;
  const MeshFeatures expected = make_moving_features(waves.after, true),
                     found = moved_records_by(CpuBackend(), waves.mesh, waves.after);
  constexpr Real kNear = 1e-13;
  const auto expect_near = [&](const std::vector<Vec3> &a, const std::vector<Vec3> &b) {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); i++) EXPECT_LE(norm(a[i] - b[i]), 10 * kNear) << i;
  };
  for (std::size_t f = 0; f < found.faces.size(); f++) {
    const FaceRecord &a = expected.faces[f], &b = found.faces[f];
    EXPECT_TRUE(a.anchor == b.anchor);
    EXPECT_LE(norm(a.normal - b.normal), kNear) << f;
    for (int k = 0; k < 3; k++) EXPECT_LE(norm(a.inward[k] - b.inward[k]), kNear) << f;
    EXPECT_LE(std::fabs(a.height - b.height), 10 * kNear) << f;
  }
  for (std::size_t i = 0; i < found.edges.size(); i++) {
    const EdgeRecord &a = expected.edges[i], &b = found.edges[i];
    EXPECT_TRUE(a.anchor == b.anchor);
    EXPECT_LE(norm(a.direction - b.direction), kNear) << i;
    EXPECT_LE(std::fabs(a.length - b.length), 10 * kNear) << i;
    ASSERT_EQ(a.n_faces, b.n_faces);
    for (std::uint32_t k = 0; k < std::min(2u, b.n_faces); k++)
      EXPECT_LE(norm(a.inward[k] - b.inward[k]), kNear) << i;
  }
  for (std::size_t i = 0; i < found.vertices.size(); i++) {
    EXPECT_TRUE(expected.vertices[i].position == found.vertices[i].position);
    EXPECT_EQ(expected.vertices[i].first, found.vertices[i].first);
    EXPECT_EQ(expected.vertices[i].count, found.vertices[i].count);
  }
  expect_near(expected.edge_inward, found.edge_inward);
  expect_near(expected.vertex_direction, found.vertex_direction);
  expect_near(expected.edge_out, found.edge_out);
  expect_near(expected.vertex_out, found.vertex_out);
  expect_same_bytes(expected.face_parts, found.face_parts);
}

void expect_records_of_cpu(const MeshFeatures &found)
{
  const MovedWaves waves;
  EXPECT_NE(waves.mesh.faces.size() % 32, 0u);
  expect_same_records(moved_records_by(CpuBackend(), waves.mesh, waves.after), found);
}

// Does what an engine on a GPU does, in the memory of the CPU: what is left to the CPU is made after the rest.
struct ApartBackend : CpuBackend {
  static constexpr bool kOnCpu = false;
};

TEST(moving_nodes, have_the_records_of_a_CPU_in_memory_apart)
{
  const MovedWaves waves;
  expect_records_of_cpu(moved_records_by(ApartBackend(), waves.mesh, waves.after));
}

#if defined(LSDCD_HAVE_CUDA)
TEST(moving_nodes, have_the_records_of_a_CPU_on_a_GPU)
{
  if (!test_on_cuda()) GTEST_SKIP() << "for a GPU";
  const MovedWaves waves;
  MeshFeatures found = moved_records_on_cuda(waves.mesh, waves.after),
               expected = moved_records_by(CpuBackend(), waves.mesh, waves.after);
  // atan2() of a GPU is right to 2 units in the last place, that of the C library to 1: each of the 8 angles at most at a vertex, below 4,
  // differs by 3 2^-51, and each of their sums, below 32, by 2^-49 of rounding.
  ASSERT_EQ(found.vertex_out.size(), expected.vertex_out.size());
  for (std::size_t i = 0; i < found.vertex_out.size(); i++)
    EXPECT_LE(norm(found.vertex_out[i] - expected.vertex_out[i]), 8 * (3 * 0x1p-51 + 0x1p-48)) << i;
  expected.vertex_out = found.vertex_out;
  expect_same_records(expected, found);
}
#endif

// Of a plane no edge inside acts, of what it is bent to all do; what has not changed is not written.
TEST(moving_nodes, name_the_parts_of_a_plate_that_is_bent_and_flat_again)
{
  const WeldedMesh flat = weld(floor_mesh(4, 1), -1);
  WeldedMesh bent = flat;
  for (Vec3 &x : bent.vertices) x.z = 0.25 * x.x * x.x + 0.125 * x.x * x.y;
  EngineOn<NodesAlone<CpuBackend>> engine{CpuBackend()};
  MovingNodes<NodesAlone<CpuBackend>> nodes(engine, 0);
  nodes.start(flat);
  for (const bool bends : {true, true, false, false, true}) {
    const WeldedMesh &to = bends ? bent : flat;
    nodes.give(to.vertices.data(), nullptr);
    nodes.move(0);
    expect_same_bytes(make_moving_features(to, true).face_parts,
                      records_on_cpu(engine.b_, nodes, flat).face_parts);
  }
}

// Springs turn from where they were turned to last, however often nodes move until then, and none turns the first time; moves
// that are taken back do not count.
TEST(moving_nodes, turn_springs_from_where_they_were_turned_last)
{
  const WeldedMesh mesh = weld(floor_mesh(2, 1), -1);
  const auto at = [&](Real z) {
    std::vector<Vec3> all = mesh.vertices;
    for (Vec3 &x : all) x.z = z;
    return all;
  };
  EngineOn<NodesAlone<CpuBackend>> engine(CpuBackend(), false);
  MovingNodes<NodesAlone<CpuBackend>> nodes(engine, 0);
  nodes.start(mesh);
  const auto move = [&](Real z) {
    nodes.give(at(z).data(), nullptr);
    nodes.move(0);
  };
  std::vector<TurningMesh> &turned = engine.springs_.turned;
  const auto expect_turn = [&](Real from, Real to) {
    nodes.turn_springs(0);
    ASSERT_EQ(turned.size(), 1u);
    EXPECT_EQ(turned[0].from[0].z, from);
    EXPECT_EQ(turned[0].to[0].z, to);
    nodes.turn_springs(0);
    EXPECT_EQ(turned.size(), 1u);
    turned.clear();
  };
  const auto expect_no_turn = [&] {
    nodes.turn_springs(0);
    EXPECT_TRUE(turned.empty());
  };
  move(1);
  expect_no_turn();
  move(2);
  expect_turn(1, 2);
  move(3);
  move(4);
  move(5);
  expect_turn(2, 5);
  move(6);
  nodes.move_back();
  expect_no_turn();
  move(7);
  move(8);
  nodes.move_back();
  expect_turn(5, 7);
  move(9);
  const std::vector<Vec3> none(mesh.vertices.size(), Vec3{0, 0, 0});
  nodes.put(at(10).data(), none.data(), 0);
  move(11);
  expect_turn(10, 11);
}

}    // namespace
}    // namespace lsdcd::test_node_grid
