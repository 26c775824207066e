// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Meshes that recede by their wear: the volume that they lose, on any number of processes, and through a saved state.
#include "mesh/meets_itself.h"
#include "mesh/mesh_features.h"
#include "support/fake_host.h"
#include "support/meshes.h"
#include "support/random.h"
#include "wall/surface/mesh_wear.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_mesh_wear {
namespace {

constexpr Real kPerWork = 1e-4, kFactor = 3, kDt = 0.5;

WallSpec wearing()
{
  WallSpec wall;
  wall.meshes.resize(1);
  wall.meshes.front().name = "can";
  wall.wear = {WearModel::archard, kPerWork};
  wall.wear_deform = {10, kFactor};
  return wall;
}

WeldedMesh can()
{
  return weld(cylinder_mesh(24, 6, 1, 2), -1);
}

// The sum over the tetrahedra from the origin.
long double volume(const WeldedMesh &mesh)
{
  long double six = 0;
  for (const auto &f : mesh.faces) {
    const Vec3 &a = mesh.vertices[f[0]], &b = mesh.vertices[f[1]], &c = mesh.vertices[f[2]];
    six += static_cast<long double>(a.x) *
               (static_cast<long double>(b.y) * c.z - static_cast<long double>(b.z) * c.y) +
           static_cast<long double>(a.y) *
               (static_cast<long double>(b.z) * c.x - static_cast<long double>(b.x) * c.z) +
           static_cast<long double>(a.z) *
               (static_cast<long double>(b.x) * c.y - static_cast<long double>(b.y) * c.x);
  }
  return six / 6;
}

// Contacts with random faces, edges and vertices of the mesh, by spheres outside (1) or inside of it (-1).
std::vector<StepContact> contacts(const WeldedMesh &mesh, int n, int side, unsigned seed)
{
  const MeshFeatures features = make_features(mesh, false);
  Random random(seed);
  std::vector<StepContact> all;
  for (int i = 0; i < n; i++) {
    StepContact r = {};
    const std::size_t k = static_cast<std::size_t>(
        uniform(random, 0, 1) * static_cast<Real>(features.contact_features.size()));
    r.feature = features.contact_features[k];
    r.wear_power = uniform(random, 0, 1);
    // From the axis outwards, or along it, which is outside of a lid.
    Vec3 at = {0, 0, 0};
    if (feature_kind(r.feature) == FeatureKind::vertex)
      at = mesh.vertices[feature_index(r.feature)];
    else if (feature_kind(r.feature) == FeatureKind::edge)
      for (const int v : mesh.edges[feature_index(r.feature)]) at += Real(0.5) * mesh.vertices[v];
    else
      for (const int v : mesh.faces[feature_index(r.feature)])
        at += (1 / Real(3)) * mesh.vertices[v];
    r.arm = side * Vec3{at.x, at.y, at.z - 1};
    all.push_back(r);
  }
  return all;
}

Real worn(const std::vector<StepContact> &records)
{
  long double sum = 0;
  for (const StepContact &r : records) sum += r.wear_power;
  return static_cast<Real>(sum * kPerWork * kDt);
}

struct Case {
  WeldedMesh mesh;
  MeshFeatures features = make_features(mesh, false);
  WallSpec wall = wearing();
  MeshWear wear;
  std::int64_t step = 0;

  explicit Case(Host &host, const WeldedMesh &of = can()) :
      mesh(of), wear(host, wall, 0, mesh.report, &mesh)
  {
  }

  void wear_off(const std::vector<StepContact> &records)
  {
    wear.add(records, kDt, features.view());
  }
  bool recede()
  {
    std::vector<Vec3> at;
    if (!wear.recede(&mesh, step += 10, at)) return false;
    mesh.vertices = at;
    return true;
  }
};

// From outside the can becomes smaller, from inside larger, in each move by the factor times what has worn. Rounding of
// the places is 1e-16 times the area, 20, and is carried over.
TEST(mesh_wear, a_closed_mesh_loses_the_worn_volume)
{
  for (const int side : {1, -1}) {
    FakeHost host;
    Case c(host);
    const long double whole = volume(c.mesh);
    Real all = 0;
    for (unsigned move = 0; move < 20; move++) {
      const std::vector<StepContact> records = contacts(c.mesh, 200, side, 5 + move);
      c.wear_off(records);
      all += worn(records);
      ASSERT_TRUE(c.recede());
      const Real lost = static_cast<Real>(side * (whole - volume(c.mesh)));
      EXPECT_NEAR(lost, kFactor * all, 1e-14);
      EXPECT_NEAR(c.wear.removed(), lost, 1e-14);
      EXPECT_EQ(c.wear.held_back(), 0);
    }
    EXPECT_GT(kFactor * all, 0.2) << "of a volume of 6";
  }
}

TEST(mesh_wear, nothing_moves_without_wear)
{
  FakeHost host;
  Case c(host);
  EXPECT_FALSE(c.recede());
  EXPECT_EQ(c.wear.removed(), 0);
}

// The same on all processes to the last bit, and that of one process to rounding.
TEST(mesh_wear, is_summed_over_processes)
{
  std::vector<Vec3> one, of_rank[3];
  for (const int n : {1, 3}) {
    on_processes(n, [&](FakeHost &host) {
      Case c(host);
      for (unsigned move = 0; move < 3; move++) {
        const std::vector<StepContact> records = contacts(can(), 300, 1, move);
        std::vector<StepContact> mine;
        for (std::size_t k = 0; k < records.size(); k++)
          if (static_cast<int>(k) % n == host.rank()) mine.push_back(records[k]);
        c.wear_off(mine);
        c.recede();
      }
      (n == 1 ? one : of_rank[host.rank()]) = c.mesh.vertices;
    });
  }
  for (const std::vector<Vec3> &other : of_rank) {
    ASSERT_EQ(other.size(), one.size());
    for (std::size_t v = 0; v < one.size(); v++) {
      EXPECT_EQ(other[v], of_rank[0][v]);
      EXPECT_LE(norm(other[v] - one[v]), 1e-14);
    }
  }
}

// One lid is worn until it would come through the other: its corners stay, it is said once, and nothing is lost without
// a word.
TEST(mesh_wear, holds_back_what_would_come_through)
{
  FakeHost host;
  Case c(host);
  const MeshFeatures features = make_features(c.mesh, false);
  Real all = 0;
  for (int move = 0; move < 400; move++) {
    std::vector<StepContact> records;
    for (std::size_t f = 0; f < c.mesh.faces.size(); f++) {
      if (features.faces[f].normal.z < 0.5) continue;
      StepContact r = {};
      r.feature = feature_code(FeatureKind::face, static_cast<std::uint32_t>(f));
      r.wear_power = 4;
      r.arm = {0, 0, 1};
      records.push_back(r);
    }
    c.wear_off(records);
    all += worn(records);
    c.recede();
    EXPECT_NEAR(c.wear.removed() + c.wear.held_back(), kFactor * all, 1e-12 * kFactor * all)
        << move;
  }
  EXPECT_GT(c.wear.held_back(), 0);
  EXPECT_GT(volume(c.mesh), 0);
  EXPECT_EQ(meets_itself(c.mesh).pairs, 0U);
  ASSERT_EQ(host.warnings.size(), 1U);
  EXPECT_NE(host.warnings[0].find("would fold over or cut another"), std::string::npos);
}

// Between the middle of a side and the side a hole would open; before and after a saved state.
TEST(mesh_wear, leaves_the_corners_of_a_facet_without_area)
{
  FakeHost host;
  const WeldedMesh mesh = weld(mesh_with_junction(true), -1);
  Case c(host, mesh), other(host, mesh);
  other.wear.restore(c.wear.save(&c.mesh));
  for (Case *of : {&c, &other}) {
    std::vector<StepContact> records(mesh.faces.size());
    for (std::size_t f = 0; f < records.size(); f++) {
      records[f].feature = feature_code(FeatureKind::face, static_cast<std::uint32_t>(f));
      records[f].wear_power = 1;
      records[f].arm = {0, 0, 1};
    }
    of->wear_off(records);
    ASSERT_TRUE(of->recede());
    for (std::size_t v = 0; v < mesh.vertices.size(); v++) {
      const bool is_on_axis = mesh.vertices[v].y == 0;
      EXPECT_EQ(of->mesh.vertices[v].z == 0, is_on_axis) << v;
    }
    EXPECT_NEAR(of->wear.removed() + of->wear.held_back(), kFactor * worn(records), 1e-14);
  }
}

}    // namespace
}    // namespace lsdcd::test_mesh_wear
