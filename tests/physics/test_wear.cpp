// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads of spheres on a wall: forces on its triangles and wear, against hand integration.
#include "engine/loads/load.h"
#include "output/feature_rows.h"
#include "support/laws.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_wear {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kOverlap = 0.01;

EngineSettings worn(EngineSettings s, WearModel wear)
{
  s.contacts = true;
  s.wear = wear;
  return s;
}

// Takes a sphere along a path at constant velocity, n steps.
FeatureRows<Load> drive(Scene &scene, const Vec3 &from, const Vec3 &v, Real dt, int n,
                        Real per_work)
{
  scene.add_sphere(from, kRadius, kMass, v);
  FeatureRows<Load> loads;
  for (int i = 1; i <= n; i++) {
    scene.set_x(0, from + (i * dt) * v);
    scene.compute(dt);
    loads.add(scene.engine->results().contacts().data(), scene.engine->results().n_contacts(),
              LoadOf{dt, per_work});
  }
  return loads;
}

// Archard: V = K F s/H, whatever the triangles; each face has the part of the way that the
// sphere was over it. A spring takes the first part of the way, until with the dashpot it is at the limit.
TEST(wear, of_archard_is_force_times_way)
{
  const Vec3 v = {0.9, 0.63, 0}, from = {-1.4, -0.9, kRadius - kOverlap};
  const Real per_work = 1e-3 / 50, dt = 1e-3, mu = 0.3, k = 3e4, gamma = 20, speed = norm(v),
             stretched = (mu * kStiffness * kOverlap - kMass * gamma * speed) / k;
  for (const bool spring : {false, true}) {
    const EngineSettings law =
        spring ? hooke_history(kStiffness, k, 0, gamma, mu) : hooke(kStiffness, 0, 100, mu);
    Scene scene(floor_mesh(16, 2, 5), kRadius, worn(law, WearModel::archard));
    const FeatureRows<Load> loads = drive(scene, from, v, dt, 3000, per_work);
    const Real per_way = per_work * kStiffness * kOverlap, sticks = spring ? stretched : 0,
               whole = per_way * (speed * 3 - sticks);
    EXPECT_NEAR(loads.total().worn, whole, 1e-11 * whole);

    const std::vector<Load> faces = loads.of_faces(scene.mesh);
    std::vector<Real> way_over(faces.size(), 0);
    std::vector<int> steps_over(faces.size(), 0);
    for (int i = 1; i <= 3000; i++) {
      const Vec3 p = from + (i * dt) * v;
      for (std::size_t f = 0; f < faces.size(); f++) {
        bool inside[2] = {true, true};
        for (int k = 0; k < 3; k++) {
          const Vec3 &a = scene.mesh.vertices[scene.mesh.faces[f][k]];
          const Vec3 &b = scene.mesh.vertices[scene.mesh.faces[f][(k + 1) % 3]];
          const Real turn = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
          inside[turn < 0] = false;
        }
        if (!inside[0] && !inside[1]) continue;
        steps_over[f]++;
        way_over[f] +=
            std::fmax(i * dt * speed - sticks, 0) - std::fmax((i - 1) * dt * speed - sticks, 0);
      }
    }
    Real sum = 0;
    for (std::size_t f = 0; f < faces.size(); f++) {
      EXPECT_NEAR(faces[f].worn, per_way * way_over[f], 1e-11 * whole) << "face " << f;
      EXPECT_NEAR(faces[f].contacts, dt * steps_over[f], 1e-11);
      sum += faces[f].worn;
    }
    EXPECT_NEAR(sum, whole, 1e-11 * whole);
  }
}

// Every law that has a spring: what is moved to and fro by less than friction holds wears nothing, and what slides on wears F_n s.
TEST(wear, of_archard_is_none_while_friction_holds)
{
  struct Case {
    const char *name;
    EngineSettings law;
  };
  std::vector<Case> cases = {{"hooke/history", hooke_history(kStiffness, 3e4, 0, 1, 0.3)},
                             {"hertz/history", hertz_history(kStiffness, 3e4, 0, 1, 0.3)}};
  for (const NormalModel normal : {NormalModel::hooke, NormalModel::hertz, NormalModel::jkr})
    for (const TangentialModel tangential :
         {TangentialModel::linear_history, TangentialModel::linear_history_slip,
          TangentialModel::linear_history_liggghts, TangentialModel::mindlin,
          TangentialModel::mindlin_force, TangentialModel::mindlin_slip,
          TangentialModel::mindlin_liggghts, TangentialModel::mindlin_rescale,
          TangentialModel::mindlin_rescale_force}) {
      EngineSettings s = granular(normal, kStiffness, normal == NormalModel::jkr ? 1e-3 : 0);
      s.law().damping = DampingModel::velocity;
      s.law().eta = 1;
      s.law().xgammat = 1;
      s.law().tangential = tangential;
      s.law().k_tangent = 3e5;
      s.law().mu = 0.3;
      cases.push_back({"granular", s});
    }
  const Real dt = 1e-5, speed = 0.2;
  const Vec3 from = {0.1, 0.2, kRadius - kOverlap}, v = {speed * 0.6, speed * 0.8, 0};
  for (const bool energy : {false, true})
    for (Case &c : cases) {
      c.law.law().keeps_forces = energy;
      // jkr reaches beyond the radius.
      Scene scene(floor_mesh(16, 2, 5), 1.1 * kRadius, worn(c.law, WearModel::archard));
      scene.add_sphere(from, kRadius, kMass, v);
      Vec3 x = from;
      // Moves n steps at a velocity. Returns what is worn, over F_n of the last one.
      const auto worn_in = [&](int n, Real part) {
        Real worn = 0, normal = 0;
        for (int i = 0; i < n; i++) {
          x += (dt * part) * v;
          scene.set_x(0, x);
          scene.set_v(0, part * v);
          scene.compute(dt);
          const StepContact &contact = scene.engine->results().contacts()[0];
          worn += dt * contact.wear_power;
          normal = contact.normal;
        }
        return worn / normal;
      };
      const std::string name =
          std::string(c.name) + " normal " + std::to_string(static_cast<int>(c.law.law().normal)) +
          " tangential " + std::to_string(static_cast<int>(c.law.law().tangential)) +
          (energy ? " with books" : "");
      // Springs are stretched by 2e-5 at most, to 6, and the dashpot has 0.2: friction holds 0.3 times 70 at least.
      EXPECT_EQ(worn_in(10, 1) + worn_in(20, -1) + worn_in(15, 1), 0) << name;
      // The longest spring is 300/(3e5 times the contact radius, 0.07), 0.014.
      worn_in(1500, 10);
      worn_in(100, 1);    // it goes on where the dashpot is at this speed
      // The spring is as long as before to rounding, 1e-16 of 0.014 in each of 100 steps, of a way of 2e-4.
      EXPECT_NEAR(worn_in(100, 1), 100 * dt * speed, 1e-10 * 100 * dt * speed) << name;
      EXPECT_EQ(worn_in(10, -1), 0) << name;
    }
}

// A belt wears under a sphere that stays; one that moves with it does not wear it.
TEST(wear, goes_with_the_slip_on_a_moving_surface)
{
  for (const Real v : {0.0, 2.0}) {
    EngineSettings law = worn(hooke(kStiffness, 0, 100, 0.3), WearModel::archard);
    law.surface.velocity = {2, 0, 0};
    Scene scene(floor_mesh(4, 2), kRadius, law);
    const FeatureRows<Load> loads =
        drive(scene, {-1, 0.1, kRadius - kOverlap}, {v, 0, 0}, 1e-3, 500, 1);
    EXPECT_NEAR(loads.total().worn, v == 0 ? kStiffness * kOverlap * 2 * 0.5 : 0, 1e-8);
  }
}

Real finnie(Real angle)
{
  return std::tan(angle) < Real(1) / 3 ? std::sin(2 * angle) - 3 * std::sin(angle) * std::sin(angle)
                                       : std::cos(angle) * std::cos(angle) / 3;
}

// Pressed in at constant velocity and angle a, the overlap grows from 0 to d:
// V = K f(a) v int F dt = K f(a) v k d^2/(2 v sin a); on the way out nothing.
TEST(wear, of_finnie_depends_on_the_angle)
{
  const Real per_work = 2e-4, dt = 1e-5, depth = 0.02, speed = 1.3;
  for (const Real degrees : {5.0, 15.0, 18.0, 19.0, 30.0, 60.0, 89.0}) {
    const Real a = degrees * kPi / 180;
    Scene scene(floor_mesh(8, 2, 3), kRadius, worn(hooke(kStiffness), WearModel::finnie));
    const Vec3 v = {speed * std::cos(a), 0, -speed * std::sin(a)};
    const int n = static_cast<int>(std::lround(depth / (speed * std::sin(a) * dt)));
    const Real reached = n * dt * speed * std::sin(a);
    const FeatureRows<Load> loads = drive(scene, {-0.8, 0.1, kRadius}, v, dt, n, per_work);
    const Real exact = per_work * finnie(a) * kStiffness * reached * reached / (2 * std::sin(a));
    // A sum at the ends of steps in place of the integral: 1/n of it.
    EXPECT_NEAR(loads.total().worn, exact, 1.01 * exact / n) << degrees;

    FeatureRows<Load> out;
    scene.set_v(0, -v);
    scene.compute(dt);
    out.add(scene.engine->results().contacts().data(), scene.engine->results().n_contacts(),
            LoadOf{dt, per_work});
    EXPECT_EQ(out.total().worn, 0);
    EXPECT_GT(out.packed()[3], 0) << "the contact itself is there";
  }
}

TEST(wear, of_finnie_is_none_where_a_sphere_slides)
{
  Scene scene(floor_mesh(8, 2, 3), kRadius,
              worn(hooke(kStiffness, 0, 100, 0.3), WearModel::finnie));
  EXPECT_EQ(drive(scene, {-1, 0.1, kRadius - kOverlap}, {1, 0, 0}, 1e-3, 100, 1).total().worn, 0);
}

// SiO2 on a steel of 1.18 GPa (Oka et al. 2005): n1 0.71 Hv^0.14, n2 2.4 Hv^-0.94, k2 2.3 Hv^0.038, k3 0.19.
constexpr Real kHardness = 1.18, kN1 = 0.727, kN2 = 2.054, kK2 = 2.315, kK3 = 0.19;

EngineSettings worn_by_impacts(EngineSettings s, Real least_speed)
{
  s = worn(s, WearModel::oka);
  s.law().keeps_touch = true;
  s.oka = {kHardness, kN1, kN2, kK2, kK3, 104, 3.26e-4, least_speed};
  return s;
}

// The formula of the paper, of a sphere that strikes at this speed under this angle (rad), for an E90 of 1.
Real oka_volume(Real speed, Real angle)
{
  const Real sine = std::sin(angle);
  return kMass * std::pow(sine, kN1) * std::pow(1 + kHardness * (1 - sine), kN2) *
         std::pow(speed / 104, kK2) * std::pow(2 * kRadius / 3.26e-4, kK3);
}

// One impact at constant velocity, whose contact then crosses seams: the formula once, on the triangle that it has touched first, also
// beside books and recorded impacts.
TEST(wear, of_oka_is_the_formula_of_the_impact_on_its_first_triangle)
{
  const Real dt = 1e-4, speed = 1.3;
  for (const Real degrees : {5.0, 20.0, 45.0, 90.0})
    for (const int beside : {0, 1, 2, 3}) {    // 1: energy, 2: impacts
      EngineSettings law = worn_by_impacts(hooke(kStiffness), 0.05);
      law.law().keeps_forces = beside & 1;
      law.impact_speed = beside & 2 ? 1e3 : 0;    // none is so fast
      Scene scene(floor_mesh(16, 2, 5), kRadius, law);
      const Real a = degrees * kPi / 180;
      const Vec3 v = {speed * std::cos(a), 0, -speed * std::sin(a)};
      const Vec3 from = Vec3{-0.9, 0.1, kRadius} - (20.5 * dt) * v;
      const FeatureRows<Load> loads = drive(scene, from, v, dt, 2000, 1);
      EXPECT_NEAR(loads.total().worn, oka_volume(speed, a), 1e-13 * oka_volume(speed, a))
          << degrees << " " << beside;
      int worn_faces = 0;
      for (const Load &face : loads.of_faces(scene.mesh)) worn_faces += face.worn > 0;
      EXPECT_EQ(worn_faces, 1) << degrees;
    }
}

// On a belt, speed and angle are those against its surface.
TEST(wear, of_oka_sees_the_motion_of_the_surface)
{
  EngineSettings law = worn_by_impacts(hooke(kStiffness), 0.05);
  law.surface.velocity = {2, 0, 0};
  Scene scene(floor_mesh(4, 2), kRadius, law);
  const Vec3 v = {0.5, 0, -1.5};
  const Real worn =
      drive(scene, Vec3{-0.4, 0.1, kRadius} - 1.5e-3 * v, v, 1e-3, 20, 1).total().worn;
  const Real exact = oka_volume(1.5 * std::sqrt(Real(2)), kPi / 4);
  EXPECT_NEAR(worn, exact, 1e-13 * exact);
}

// What slides, what was put into contact, and what is slower than the threshold.
TEST(wear, of_oka_is_none_without_an_impact)
{
  const EngineSettings law = worn_by_impacts(hooke_history(kStiffness, 3e4, 0, 1, 0.3), 0.05);
  struct Case {
    const char *name;
    Vec3 from, v;
  };
  for (const Case &c : {Case{"slides", {-1, 0.1, kRadius - kOverlap}, {1, 0, 0}},
                        Case{"was put there", {-1, 0.1, kRadius - kOverlap}, {1, 0, -0.1}},
                        Case{"is slow", {-1, 0.1, kRadius + 1e-4}, {1, 0, -0.04}}}) {
    Scene scene(floor_mesh(16, 2, 5), kRadius, law);
    const FeatureRows<Load> loads = drive(scene, c.from, c.v, 1e-3, 1500, 1);
    EXPECT_EQ(loads.total().worn, 0) << c.name;
    EXPECT_GT(loads.total().normal, 0) << c.name;
  }
}

// A sphere that rolls along a floor and strikes a wall wears the wall, and one that falls into their fold wears each of both once.
TEST(wear, of_oka_is_once_for_each_side_of_a_fold)
{
  TriangleSoup soup = box_mesh({-4, -4, -1}, {4, 4, 0});
  append(soup, box_mesh({2, -4, 0}, {3, 4, 4}));
  const Real dt = 1e-4, at_wall = 2 - kRadius;
  const auto worn = [&](const Vec3 &from, const Vec3 &v) {
    Scene scene(soup, kRadius, worn_by_impacts(hooke(kStiffness), 0.05));
    return drive(scene, from, v, dt, 100, 1).total().worn;
  };
  const Vec3 rolls = {1.2, 0, 0}, falls = {0.9, 0, -0.9};
  const Real struck = worn({at_wall - 30.5 * dt * 1.2, 0.3, kRadius - 1e-3}, rolls);
  EXPECT_NEAR(struck, oka_volume(1.2, kPi / 2), 1e-12 * struck);
  const Real both = worn(Vec3{at_wall, 0.3, kRadius} - (30.5 * dt) * falls, falls);
  const Real one = oka_volume(norm(falls), kPi / 4);
  EXPECT_NEAR(both, 2 * one, 1e-9 * one);
}

// Weight on the floor, and on both sides of an edge.
TEST(stress, of_a_resting_sphere_is_its_weight)
{
  Scene scene(floor_mesh(4, 2), kRadius, worn(hooke(kStiffness, 50), WearModel::none));
  const FeatureRows<Load> loads = drive(scene, {0.3, 0.1, kRadius - 2e-4}, {0, 0, 0}, 1e-3, 10, 0);
  Real normal = 0;
  int loaded = 0;
  for (const Load &l : loads.of_faces(scene.mesh)) {
    normal += l.normal;
    loaded += l.normal > 0;
    EXPECT_EQ(l.shear, 0);
    EXPECT_EQ(l.worn, 0);
  }
  EXPECT_NEAR(normal / 0.01, 20, 1e-9);
  EXPECT_EQ(loaded, 1);

  Scene box(box_mesh({0, 0, 0}, {1, 1, 1}), kRadius, worn(hooke(kStiffness), WearModel::none));
  const Real r = std::sqrt(0.5) * (kRadius - kOverlap);
  const FeatureRows<Load> edge = drive(box, {1 + r, 0.4, 1 + r}, {0, 0, 0}, 1e-3, 10, 0);
  const std::vector<Load> faces = edge.of_faces(box.mesh);
  int halves = 0;
  for (const Load &l : faces) {
    if (l.normal == 0) continue;
    EXPECT_NEAR(l.normal / 0.01, kStiffness * kOverlap / 2, 1e-9);
    halves++;
  }
  EXPECT_EQ(halves, 2);
}

TEST(stress, in_shear_is_the_friction)
{
  Scene scene(floor_mesh(4, 2), kRadius, worn(hooke(kStiffness, 0, 1e4, 0.3), WearModel::none));
  const FeatureRows<Load> loads =
      drive(scene, {-1, 0.1, kRadius - kOverlap}, {1, 0, 0}, 1e-3, 100, 0);
  Real shear = 0;
  for (const Load &l : loads.of_faces(scene.mesh)) shear += l.shear;
  EXPECT_NEAR(shear / 0.1, 0.3 * kStiffness * kOverlap, 1e-9);
}

// Records are only read: what is computed beside them is what it is without.
TEST(step_contacts, change_no_bit_of_the_forces)
{
  for (EngineSettings law :
       {hooke(kStiffness, 20, 100, 0.3), hertz_history(kStiffness, 3e4, 10, 20, 0.3)}) {
    Vec3 force[3], torque[3];
    for (int k = 0; k < 3; k++) {
      law.contacts = k > 0;
      law.wear = k > 1 ? WearModel::archard : WearModel::none;
      Scene scene(cylinder_mesh(9, 3, 1, 2), kRadius, law);
      scene.add_sphere({0.55, 0.4, 0.45}, kRadius, kMass, {0.3, -0.2, 0.1}, {3, 2, 1});
      for (int i = 0; i < 5; i++) scene.compute(1e-4);
      force[k] = scene.force(0);
      torque[k] = scene.torque(0);
      EXPECT_EQ(scene.engine->results().n_contacts(),
                k ? scene.engine->results().totals().contacts : 0);
      EXPECT_GE(scene.engine->results().totals().contacts, 2);
    }
    for (int k = 1; k < 3; k++) {
      EXPECT_EQ(force[k], force[0]);
      EXPECT_EQ(torque[k], torque[0]);
    }
  }
}

// In a shallow fold contacts share their overlap; so do the forces that are recorded.
TEST(step_contacts, of_contacts_that_share_sum_to_the_force)
{
  Scene scene(hinge_mesh(20, 4), kRadius, worn(hooke(kStiffness), WearModel::none));
  const Real a = 20 * kPi / 180;
  const Vec3 n[] = {{0, 0, 1}, {-std::sin(a), 0, std::cos(a)}};
  // On the bisector, 2 % of the radius into both sides.
  const Vec3 out = {-std::sin(a / 2), 0, std::cos(a / 2)};
  scene.add_sphere((0.98 * kRadius / std::cos(a / 2)) * out, kRadius, kMass);
  scene.compute(1e-4);
  ASSERT_EQ(scene.engine->results().n_contacts(), 2);
  Vec3 sum = {0, 0, 0};
  for (int i = 0; i < 2; i++) {
    const StepContact &r = scene.engine->results().contacts()[i];
    EXPECT_LT(r.normal, 0.6 * kStiffness * 0.02 * kRadius) << "it has its share only";
    const auto &face = scene.mesh.faces[feature_index(r.feature)];
    bool rises = false;
    for (int v : face) rises = rises || scene.mesh.vertices[v].x > 1e-9;
    sum += r.normal * n[rises];
  }
  EXPECT_LE(norm(sum - scene.force(0)), 1e-10 * norm(sum));
}

// A sphere with more contacts than the kernel has places for is done again: every contact
// is recorded, and the spheres around it keep theirs.
TEST(step_contacts, of_crowded_spheres_are_all_there)
{
  // Thin posts, further apart than a needle is thick: one contact each.
  TriangleSoup soup;
  for (int i = 0; i < 12; i++) {
    const Real a = 2 * kPi * i / 12;
    const Vec3 p = {0.45 * std::cos(a), 0.45 * std::sin(a), 0};
    TriangleSoup post = box_mesh(p - Vec3{0.01, 0.01, 1}, p + Vec3{0.01, 0.01, 0});
    append(soup, post);
  }
  for (const bool history : {false, true}) {
    EngineSettings law = worn(
        history ? hooke_history(kStiffness, 3e4, 0, 0, 0.3) : hooke(kStiffness), WearModel::none);
    law.corner = Corner::sum;
    Scene scene(soup, kRadius, law);
    for (const Real z : {1.2, 0.3, 1.2, 0.0}) scene.add_sphere({0, 0, z}, kRadius, kMass);
    scene.add_sphere({0.45, 0, kRadius - kOverlap}, kRadius, kMass);
    scene.compute(1e-4);
    ASSERT_GT(scene.engine->results().n_contacts(), 12);
    for (int i = 0; i < scene.engine->results().n_contacts(); i++)
      EXPECT_GT(scene.engine->results().contacts()[i].normal, 0) << i;
    EXPECT_EQ(scene.engine->results().n_contacts(), scene.engine->results().totals().contacts);
    FeatureRows<Load> loads;
    loads.add(scene.engine->results().contacts().data(), scene.engine->results().n_contacts(),
              LoadOf{1, 0});
    // The last record is the last sphere's, on the top of a post.
    const StepContact &last =
        scene.engine->results().contacts()[scene.engine->results().n_contacts() - 1];
    EXPECT_NEAR(last.normal, kStiffness * kOverlap, 1e-9);
  }
}

}    // namespace
}    // namespace lsdcd::test_wear
