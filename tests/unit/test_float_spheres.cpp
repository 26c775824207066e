// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An engine for arrays in float, as a LAMMPS has them with KOKKOS_PREC mixed and single, against one that gets the same
// positions in double. The sums of forces that it leaves must be those of that engine, rounded once.
#include "engine/engine.h"

#include "grid/flat_grid.h"
#include "grid/triangle_grid.h"
#include "mesh/welded_mesh.h"
#include "support/sphere_arrays.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <type_traits>
#include <vector>

namespace lsdcd::test_float_spheres {
namespace {

// A host's arrays in float: places row by row, the others column by column.
template <class Sum>
struct HostFloats {
  int n = 0;
  std::ptrdiff_t room;
  std::vector<float> at, going, turning, size, weight;
  std::vector<Sum> pushed, turned;

  explicit HostFloats(int room) :
      room(room), at(3 * room), going(3 * room), turning(3 * room), size(room), weight(room),
      pushed(3 * room), turned(3 * room)
  {
  }
  StridedView<float> x() { return at.data(); }
  StridedView<float> v() { return {going.data(), 1, room}; }
  StridedView<float> omega() { return {turning.data(), 1, room}; }
  StridedView<Sum> force() { return {pushed.data(), 1, room}; }
  StridedView<Sum> torque() { return {turned.data(), 1, room}; }

  FloatSpheres floats()
  {
    FloatSpheres f;
    f.x = x();
    f.v = v();
    f.omega = omega();
    f.radius = size.data();
    f.mass = weight.data();
    if constexpr (std::is_same_v<Sum, float>) {
      f.force = force();
      f.torque = torque();
    }
    return f;
  }
  Spheres spheres(const FloatSpheres &floats)
  {
    Spheres s;
    s.n = n;
    s.in_float = &floats;
    if constexpr (!std::is_same_v<Sum, float>) {
      s.force = force();
      s.torque = torque();
    }
    return s;
  }
};
template <class T>
T &component(const StridedView<T> &rows, int i, int d)
{
  return rows.of(i)[d * rows.column];
}

// Returns the arrays that the other engine gets.
template <class Sum>
SphereArrays in_double(HostFloats<Sum> &a)
{
  const auto vector = [](const auto &rows, int i) {
    return Vec3{Real(component(rows, i, 0)), Real(component(rows, i, 1)),
                Real(component(rows, i, 2))};
  };
  SphereArrays doubles;
  for (int i = 0; i < a.n; i++) {
    doubles.add(vector(a.x(), i), Real(a.size[i]), Real(a.weight[i]), vector(a.v(), i),
                vector(a.omega(), i));
    put_vector(doubles.force, i, vector(a.force(), i));
    put_vector(doubles.torque, i, vector(a.torque(), i));
  }
  return doubles;
}

// A bumpy floor over [-1, 1]^2, `up` above z = 0.
FlatOf<StepGrid> grid_of_floor(Real up)
{
  TriangleSoup soup;
  const int n = 16;
  const auto at = [&](int i, int j) {
    const Real x = 2.0 * i / n - 1, y = 2.0 * j / n - 1;
    return Vec3{x, y, up + 0.02 * std::sin(5 * x) * std::cos(5 * y)};
  };
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++)
      for (const Vec3 &p :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        soup.corners.push_back(p);
  StepGridSettings settings;
  settings.cutoff = 0.06;
  return FlatOf(build_grid(weld(soup, 1e-9), settings));
}

EngineSettings settings_of(int meshes)
{
  EngineSettings s;
  s.meshes = meshes;
  s.law().k_normal = 1e4;
  s.law().eta = 20;
  s.law().mu = 0.4;
  s.law().tangential = TangentialModel::linear_history_classic;
  s.law().k_tangent = 3e3;
  s.law().gamma_tangent = 10;
  return s;
}

// 400 spheres move at random for 300 steps, some of them through both floors; every 100 steps there are more, and the
// arrays are too short. Candidates are chosen by the engines' own has_moved(), and where spheres come.
template <class Sum>
void walk(int meshes, When when)
{
  const FlatOf<StepGrid> floors[2] = {grid_of_floor(0), grid_of_floor(0.05)};
  HostFloats<Sum> host(700);
  EngineSettings engine_settings = settings_of(meshes);
  const std::unique_ptr<WallEngine> other = make_cpu_engine(engine_settings);
  engine_settings.arrays = HostArrays::in_float;
  const std::unique_ptr<WallEngine> engine = make_cpu_engine(engine_settings);
  for (int m = 0; m < meshes; m++) {
    engine->set_grid(floors[m].view(), m);
    other->set_grid(floors[m].view(), m);
  }
  std::mt19937 random(4711);
  const auto any = [&](Real lo, Real hi) {
    return static_cast<float>(std::uniform_real_distribution<Real>(lo, hi)(random));
  };
  int choices = 0;
  std::int64_t contacts = 0;
  for (int step = 0; step < 300; step++) {
    const bool look = step % 100 == 0;
    if (look) {
      const int first = host.n;
      host.n += first ? 100 : 400;
      for (int i = first; i < host.n; i++) {
        host.size[i] = any(0.03, 0.05);
        host.weight[i] = any(0.5, 2);
        for (int d = 0; d < 3; d++)
          component(host.x(), i, d) = d < 2 ? any(-0.9f, 0.9f) : any(-0.1f, 0.3f);
      }
    }
    for (int i = 0; i < host.n; i++)
      for (int d = 0; d < 3; d++) {
        component(host.x(), i, d) += any(-1e-3, 1e-3);
        component(host.v(), i, d) = any(-1, 1);
        component(host.omega(), i, d) = any(-1, 1);
        component(host.force(), i, d) = static_cast<Sum>(any(-1, 1));
        component(host.torque(), i, d) = static_cast<Sum>(any(-1, 1));
      }
    SphereArrays doubles = in_double(host);
    const Spheres given = doubles.spheres();
    const FloatSpheres floats = host.floats();
    StepSettings settings;
    settings.dt = 1e-3;
    const auto run = [&](WallEngine &e, const Spheres &spheres, When when) {
      if (look) {
        EXPECT_NEAR(e.largest_radius(spheres), 0.05, 0.001);
      }
      e.begin(when);
      if (look) e.expire_choice();
      SphereDrift drift;
      drift.kind = SphereDrift::watched;
      drift.distance = 0.01;
      choices += e.choose_if_due(spheres, drift, {}) ? 1 : 0;
      e.submit(spheres, settings);
      e.collect();
    };
    run(*engine, host.spheres(floats), when);
    run(*other, given, When::in_turn);
    ASSERT_EQ(engine->n_candidates(), other->n_candidates());
    contacts += engine->results().totals().contacts;
    ASSERT_EQ(engine->results().totals().contacts, other->results().totals().contacts);
    for (int i = 0; i < 3 * given.n; i++) {
      ASSERT_EQ(component(host.force(), i / 3, i % 3), static_cast<Sum>(doubles.force[i]))
          << step << " " << i;
      ASSERT_EQ(component(host.torque(), i / 3, i % 3), static_cast<Sum>(doubles.torque[i]));
    }
    const StepDiagnostics expected = other->read_diagnostics(), seen = engine->read_diagnostics();
    ASSERT_EQ(seen.deepest_sphere, expected.deepest_sphere);
    if (seen.deepest_sphere >= 0) {
      ASSERT_EQ(seen.deepest_radius, doubles.radius[seen.deepest_sphere]);
    }
  }
  EXPECT_GT(contacts, 300 * 50);
  EXPECT_GT(choices, 2 * 3);
  EXPECT_LT(choices, 2 * 150);
}

TEST(float_spheres, forces_added_in_float_are_those_in_double_rounded_once)
{
  walk<float>(1, When::in_turn);
  walk<float>(1, When::beside);
  walk<float>(1, When::beside_adding_early);
}

TEST(float_spheres, forces_added_in_double_are_those_in_double)
{
  walk<double>(1, When::in_turn);
}

TEST(float_spheres, spheres_near_two_meshes_are_added_once)
{
  walk<float>(2, When::in_turn);
}

}    // namespace
}    // namespace lsdcd::test_float_spheres
