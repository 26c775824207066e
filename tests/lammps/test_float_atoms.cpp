// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// FloatAtomsEngine with arrays as a LAMMPS has them in KOKKOS_PREC mixed and single, against the engine that it uses,
// which gets the same positions in double. The sums of forces that it leaves must be those of that engine, rounded once.
#include "float_atoms_engine.h"

#include "grid/flat_grid.h"
#include "grid/triangle_grid.h"
#include "mesh/welded_mesh.h"

#include <cmath>
#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace lsdcd;

namespace {

using Space = Kokkos::DefaultHostExecutionSpace;
using Device = Kokkos::Device<Space, Kokkos::HostSpace>;

// As a TransformView of LAMMPS.
template <class View>
struct Dual {
  View rows;
  template <class>
  View &view()
  {
    return rows;
  }
};

template <class Sum>
struct Atoms {
  int nlocal = 0;
  Dual<Kokkos::View<float *[3], Kokkos::LayoutRight, Device>> k_x;
  Dual<Kokkos::View<float *[3], Kokkos::LayoutLeft, Device>> k_v, k_omega;
  Dual<Kokkos::View<Sum *[3], Kokkos::LayoutLeft, Device>> k_f, k_torque;
  Dual<Kokkos::View<float *, Device>> k_radius, k_rmass;

  explicit Atoms(int room)
  {
    Kokkos::resize(k_x.rows, room);
    Kokkos::resize(k_v.rows, room);
    Kokkos::resize(k_omega.rows, room);
    Kokkos::resize(k_f.rows, room);
    Kokkos::resize(k_torque.rows, room);
    Kokkos::resize(k_radius.rows, room);
    Kokkos::resize(k_rmass.rows, room);
  }
};

// The arrays that the other engine gets.
struct Doubles {
  std::vector<Real> x, v, omega, radius, mass, force, torque;

  template <class Sum>
  explicit Doubles(Atoms<Sum> &a)
  {
    for (int i = 0; i < a.nlocal; i++) {
      for (int d = 0; d < 3; d++) {
        x.push_back(Real(a.k_x.rows(i, d)));
        v.push_back(Real(a.k_v.rows(i, d)));
        omega.push_back(Real(a.k_omega.rows(i, d)));
      }
      radius.push_back(Real(a.k_radius.rows(i)));
      mass.push_back(Real(a.k_rmass.rows(i)));
    }
    force.assign(x.size(), 0);
    torque.assign(x.size(), 0);
  }
  Spheres spheres()
  {
    Spheres s;
    s.n = static_cast<int>(radius.size());
    s.x = x.data();
    s.v = v.data();
    s.omega = omega.data();
    s.radius = radius.data();
    s.mass = mass.data();
    s.force = force.data();
    s.torque = torque.data();
    return s;
  }
};

// A bumpy floor over [-1, 1]^2, `up` above z = 0.
FlatGrid grid_of_floor(Real up)
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
  GridSettings settings;
  settings.cutoff = 0.06;
  return FlatGrid(build_grid(weld(soup, 1e-9), settings));
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
  const FlatGrid floors[2] = {grid_of_floor(0), grid_of_floor(0.05)};
  Atoms<Sum> atoms(700);
  Real deepest = 0, deepest_seen = 0;
  FloatAtomsEngine<Device, Atoms<Sum>> engine(make_cpu_engine(settings_of(meshes)), &atoms,
                                              &deepest);
  const std::unique_ptr<WallEngine> other = make_cpu_engine(settings_of(meshes));
  for (int m = 0; m < meshes; m++) {
    engine.set_grid(floors[m].view(), m);
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
      const int first = atoms.nlocal;
      atoms.nlocal += first ? 100 : 400;
      for (int i = first; i < atoms.nlocal; i++) {
        atoms.k_radius.rows(i) = any(0.03, 0.05);
        atoms.k_rmass.rows(i) = any(0.5, 2);
        for (int d = 0; d < 3; d++)
          atoms.k_x.rows(i, d) = d < 2 ? any(-0.9f, 0.9f) : any(-0.1f, 0.3f);
      }
    }
    for (int i = 0; i < atoms.nlocal; i++)
      for (int d = 0; d < 3; d++) {
        atoms.k_x.rows(i, d) += any(-1e-3, 1e-3);
        atoms.k_v.rows(i, d) = any(-1, 1);
        atoms.k_omega.rows(i, d) = any(-1, 1);
        atoms.k_f.rows(i, d) = static_cast<Sum>(any(-1, 1));
        atoms.k_torque.rows(i, d) = static_cast<Sum>(any(-1, 1));
      }
    Doubles doubles(atoms);
    const Spheres given = doubles.spheres();
    Spheres without;    // what a fix gives the engine for atoms in float
    without.n = given.n;
    for (int i = 0; i < 3 * given.n; i++) {
      doubles.force[i] = Real(atoms.k_f.rows(i / 3, i % 3));
      doubles.torque[i] = Real(atoms.k_torque.rows(i / 3, i % 3));
    }
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
    run(engine, without, when);
    run(*other, given, When::in_turn);
    ASSERT_EQ(engine.n_candidates(), other->n_candidates());
    contacts += engine.totals().contacts;
    ASSERT_EQ(engine.totals().contacts, other->totals().contacts);
    for (int i = 0; i < 3 * given.n; i++) {
      ASSERT_EQ(atoms.k_f.rows(i / 3, i % 3), static_cast<Sum>(doubles.force[i]))
          << step << " " << i;
      ASSERT_EQ(atoms.k_torque.rows(i / 3, i % 3), static_cast<Sum>(doubles.torque[i]));
    }
    const StepDiagnostics seen = other->read_diagnostics();
    engine.read_diagnostics();
    if (seen.deepest_sphere >= 0)
      deepest_seen = std::max(deepest_seen, seen.deepest * doubles.radius[seen.deepest_sphere]);
    ASSERT_EQ(deepest, deepest_seen);
  }
  EXPECT_GT(contacts, 300 * 50);
  EXPECT_GT(choices, 2 * 3);
  EXPECT_LT(choices, 2 * 150);
}

}    // namespace

TEST(float_atoms, forces_added_in_float_are_those_in_double_rounded_once)
{
  walk<float>(1, When::in_turn);
}

TEST(float_atoms, forces_added_in_double_are_those_in_double)
{
  walk<double>(1, When::in_turn);
}

TEST(float_atoms, spheres_near_two_meshes_are_added_once)
{
  walk<float>(2, When::in_turn);
}

TEST(float_atoms, a_step_that_is_launched_beside_adds_in_finish)
{
  walk<float>(1, When::beside);
}

TEST(float_atoms, a_step_may_add_when_it_is_launched)
{
  walk<float>(1, When::beside_adding_early);
}

int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  const Kokkos::ScopeGuard kokkos;
  return RUN_ALL_TESTS();
}
