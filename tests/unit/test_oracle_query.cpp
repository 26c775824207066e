// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The library's queries of many spheres against an oracle that shares no code, on five meshes.
//   LSDCD_SPHERES    per mesh, 1e5 unless given (1e8 takes a minute or two on a GPU)
//   LSDCD_TRIANGLES  of the largest mesh, 1e4 unless given (up to 1e6)
//   LSDCD_LENGTH     of a cell, chosen by the grid unless given
//   LSDCD_COMMIT_NAME  for these rows, where git does not know
//   LSDCD_QUERY_CSV  a file to add rows to: certified shares, errors, times
#include "support/device.h"
#include "support/meshes.h"
#include "support/query_checks.h"
#include "support/random_mesh.h"

#include "backend/backend_cpu.h"
#include "mesh/welded_mesh.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace lsdcd {

std::unique_ptr<QueryChecks> query_checks_on_cpu(const Bins &bins, const QueryCheckSettings &s)
{
  return std::make_unique<QueryChecksOn<CpuBackend>>(bins, s);
}

namespace {

constexpr Real kCutoff = 1;

double setting(const char *name, double otherwise)
{
  const char *text = std::getenv(name);
  return text && *text ? std::atof(text) : otherwise;
}

// The commit that was built, where git did not know it.
const char *commit()
{
  const char *named = std::getenv("LSDCD_COMMIT_NAME");
  return named && *named ? named : LSDCD_COMMIT;
}

bool quick()
{
  return setting("LSDCD_QUICK", 0) > 0;
}

// A sphere of radius 50 with bumps at random: an octahedron whose sides are cut in n,
// its nodes moved by up to half an edge or so along the radius. 8 n^2 triangles.
TriangleSoup bumpy_sphere(int n, std::uint64_t seed)
{
  Numbers random(seed);
  const Real radius = 50, bump = radius / n / 2;
  std::map<std::array<int, 3>, Vec3> moved;
  const auto node = [&](int x, int y, int z) {
    const auto known = moved.find({x, y, z});
    if (known != moved.end()) return known->second;
    const Vec3 d = {Real(x), Real(y), Real(z)};
    const Vec3 p = ((radius + random.in(-bump, bump)) / norm(d)) * d;
    moved[{x, y, z}] = p;
    return p;
  };
  TriangleSoup soup;
  soup.source = "bumpy sphere";
  const auto add = [&](const Vec3 &a, const Vec3 &b, const Vec3 &c) {
    soup.corners.insert(soup.corners.end(), {a, b, c});
  };
  for (int octant = 0; octant < 8; octant++) {
    const int sx = octant & 1 ? 1 : -1, sy = octant & 2 ? 1 : -1, sz = octant & 4 ? 1 : -1;
    const auto at = [&](int i, int j) { return node(sx * i, sy * j, sz * (n - i - j)); };
    for (int i = 0; i < n; i++)
      for (int j = 0; i + j < n; j++) {
        add(at(i, j), at(i + 1, j), at(i, j + 1));
        if (i + j + 1 < n) add(at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return soup;
}

// A mesh of about so many triangles.
struct Mesh {
  const char *name;
  double triangles;
  TriangleSoup (*make)();
};
const Mesh kMeshes[] = {
    {"cylinder", 1e2, [] { return cylinder_mesh(25, 1, 50, 100); }},
    {"bumpy sphere", 1e3, [] { return bumpy_sphere(11, 5); }},
    {"cylinder", 1e4, [] { return cylinder_mesh(100, 49, 50, 100); }},
    {"bumpy sphere", 1e5, [] { return bumpy_sphere(112, 6); }},
    {"cylinder", 1e6, [] { return cylinder_mesh(1000, 499, 50, 100); }},
};

// A mesh with its oracle and its spheres, made once for all facts.
struct Wall {
  WeldedMesh mesh;
  std::unique_ptr<TriangleTable> names;
  QueryCheckSettings settings;
  std::unique_ptr<QueryChecks> checks;

  explicit Wall(const Mesh &m)
  {
    const TriangleSoup soup = m.make();
    mesh = weld(soup, -1);
    names = std::make_unique<TriangleTable>(mesh);
    const Vec3 lo = mesh.report.lo, hi = mesh.report.hi, r = kCutoff * Vec3{1, 1, 1};
    settings.cutoff = kCutoff;
    // Relative to the mesh's size, as is the distance.
    settings.tolerance = 1e-12 * norm(hi - lo);
    settings.box = {lo - r, hi + r, kCutoff, 20};
    settings.n_spheres = static_cast<std::size_t>(setting("LSDCD_SPHERES", quick() ? 1e4 : 1e5));
    settings.chunk = 1 << 24;
    const Bins bins = make_bins(soup, kCutoff);
#if defined(LSDCD_HAVE_CUDA)
    if (test_on_cuda()) checks = query_checks_on_cuda(bins, settings);
#endif
    if (!checks) checks = query_checks_on_cpu(bins, settings);
  }
};

class query_oracle : public testing::TestWithParam<Mesh> {
 protected:
  void SetUp() override
  {
    const Mesh &m = GetParam();
    if (m.triangles > setting("LSDCD_TRIANGLES", quick() ? 1e3 : 1e4))
      GTEST_SKIP() << "set LSDCD_TRIANGLES";
    static std::map<double, Wall> walls;
    wall_ = &walls.try_emplace(m.triangles, m).first->second;
  }

  QueryCounts check(int nearest)
  {
    GridSettings g;
    g.cutoff = kCutoff;
    g.length = setting("LSDCD_LENGTH", 0);
    g.list_kind = ListKind::of_option(nearest);
    g.memory_budget = std::size_t(32) << 30;
    const TriangleGrid grid = build_grid(wall_->mesh, g, test_on_cuda());
    const QueryCounts c = wall_->checks->check(grid, *wall_->names);
    const std::string lists = nearest > 0 ? std::to_string(nearest) : "complete";
    std::printf("  %s, %zu triangles, L %.4g, %s: %zu spheres, %zu near, %zu touch, missed %zu, "
                "false %zu, wrong %zu; certified %.6f of all, %.6f of the near; %.3f ms\n",
                GetParam().name, wall_->mesh.faces.size(), grid.length, lists.c_str(), c.spheres,
                c.near, c.touching, c.missed, c.false_ones, c.wrong,
                share(c.uncertified, c.spheres), share(c.uncertified, c.near), c.query_ms);
    std::fflush(stdout);
    write_row(lists, grid, c);
    EXPECT_GT(c.touching, 0u);
    return c;
  }

  static double share(std::size_t uncertified, std::size_t of)
  {
    return of > 0 ? 1 - double(uncertified) / of : 1;
  }

  void write_row(const std::string &lists, const TriangleGrid &grid, const QueryCounts &c) const
  {
    const char *path = std::getenv("LSDCD_QUERY_CSV");
    if (!path || !*path) return;
    std::FILE *file = std::fopen(path, "a");
    ASSERT_NE(file, nullptr) << path;
    if (std::fseek(file, 0, SEEK_END) == 0 && std::ftell(file) == 0)
      std::fputs("mesh,triangles,device,commit,spheres,length,reach,lists,near,touching,certified,"
                 "certified_of_near,missed,false,wrong,certified_missed,certified_false,"
                 "certified_wrong,query_ms,grid_bytes\n",
                 file);
    std::fprintf(
        file,
        "%s,%zu,\"%s\",%s,%zu,%.6g,%g,%s,%zu,%zu,%.9f,%.9f,%zu,%zu,%zu,%zu,%zu,%zu,%.4f,%zu\n",
        GetParam().name, wall_->mesh.faces.size(), wall_->checks->device().c_str(), commit(),
        c.spheres, grid.length, grid.cutoff, lists.c_str(), c.near, c.touching,
        share(c.uncertified, c.spheres), share(c.uncertified, c.near), c.missed, c.false_ones,
        c.wrong, c.certified_missed, c.certified_false, c.certified_wrong, c.query_ms,
        grid.report.bytes);
    std::fclose(file);
  }

  Wall *wall_ = nullptr;
};

TEST_P(query_oracle, agrees_with_every_triangle_tried)
{
  // As many as take a moment.
  const std::size_t n =
      static_cast<std::size_t>((test_on_cuda() ? 2e10 : 1e8) / wall_->mesh.faces.size());
  EXPECT_LE(wall_->checks->oracle_error(n), wall_->settings.tolerance);
}

TEST_P(query_oracle, spheres_of_the_device_are_those_of_the_host)
{
  for (std::size_t i :
       {std::size_t(0), wall_->settings.n_spheres / 3, wall_->settings.n_spheres - 1}) {
    const Sphere device = wall_->checks->sphere(i), host = wall_->settings.box.sphere(i);
    EXPECT_EQ(device.x, host.x);
    EXPECT_EQ(device.y, host.y);
    EXPECT_EQ(device.z, host.z);
    EXPECT_EQ(device.r, host.r);
  }
}

void expect_exact(const QueryCounts &c)
{
  EXPECT_EQ(c.missed, 0u);
  EXPECT_EQ(c.false_ones, 0u);
  EXPECT_EQ(c.wrong, 0u);
  EXPECT_EQ(c.uncertified, 0u);
}

TEST_P(query_oracle, complete_lists_miss_nothing)
{
  expect_exact(check(0));
}

TEST_P(query_oracle, certified_answers_are_right)
{
  for (int n = 1; n <= 8; n++) {
    const QueryCounts c = check(n);
    EXPECT_EQ(c.certified_missed, 0u) << n;
    EXPECT_EQ(c.certified_false, 0u) << n;
    EXPECT_EQ(c.certified_wrong, 0u) << n;
    // A list that is cut off can only lose contacts.
    EXPECT_EQ(c.false_ones, 0u) << n;
  }
}

INSTANTIATE_TEST_SUITE_P(meshes, query_oracle, testing::ValuesIn(kMeshes),
                         [](const testing::TestParamInfo<Mesh> &info) {
                           std::string name = info.param.name;
                           for (char &c : name) c = c == ' ' ? '_' : c;
                           return name + "_1e" +
                                  std::to_string(int(std::log10(info.param.triangles) + 0.5));
                         });

}    // namespace
}    // namespace lsdcd
