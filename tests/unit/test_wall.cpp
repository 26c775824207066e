// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall stepped by a program that is not LAMMPS: forces, grids, motion, restarts and totals of its
// processes, against closed forms.
#include "base/input_error.h"
#include "input/wall_command.h"
#include "mesh/io/read_mesh.h"
#include "support/fake_host.h"
#include "support/grains.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/temp_dir.h"
#include "support/test_engine.h"
#include "support/wall_scene.h"
#include "wall/wall.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

namespace lsdcd::test_wall {
namespace {

constexpr Real kN = 1000, kT = 300, kDt = 1e-3, kRadius = 0.5;

// A file with a square floor at z = 0, 20 across, gone when the object is.
struct Floor {
  TempDir dir;
  std::string name = dir.write(
      "floor.stl", "solid floor\n"
                   "facet normal 0 0 1\nouter loop\n"
                   "vertex -10 -10 0\nvertex 10 -10 0\nvertex 10 10 0\nendloop\nendfacet\n"
                   "facet normal 0 0 1\nouter loop\n"
                   "vertex -10 -10 0\nvertex 10 10 0\nvertex -10 10 0\nendloop\nendfacet\n"
                   "endsolid floor\n");

  // A Hooke wall with friction of this mesh, and more words.
  WallSpec wall(const std::string &more = "") const
  {
    return parse_wall(
               words("hooke/history 1000 300 0 0 0.5 0 mesh " + name + " device cpu " + more))
        .wall;
  }
};

class wall : public testing::Test {
 protected:
  const Floor floor;
};

// A box that may change, as that of LAMMPS.
struct Scene : WallScene {
  explicit Scene(const WallSpec &spec) : WallScene(spec) { box_changes = true; }
  Scene(FakeHost &host, const WallSpec &spec) : WallScene(host, spec) { box_changes = true; }
};

// Sums of a few products of doubles of order one: some hundred roundings.
constexpr Real kRounding = 1e-13;

// A mesh that has come to rest has nothing to do in a step, but where the box changes. It acts as one that was always there, and its
// next motion begins where it is.
TEST_F(wall, lets_a_mesh_that_was_stopped_rest_until_the_box_changes_or_it_moves_again)
{
  FakeHost host;
  host.simulation = wide_box();
  host.simulation.corner = {-15, -15, -15};
  for (int k = 0; k < 3; k++) {
    host.simulation.edge[k] = {0, 0, 0};
    host.simulation.edge[k][k] = 30;
  }
  host.simulation.periodic[0] = true;
  WallScene moved(host, floor.wall("motion linear 100 0 1"));
  moved.add({0, 0, kRadius - 0.01}, kRadius);
  moved.go(4);
  const MotionTerm term = moved.wall->spec().meshes.front().motion.terms().front();
  moved.wall->set_motion(0, RigidMotion(), {moved.now, kDt});
  moved.run(3);
  EXPECT_NEAR(moved.force[0].z, kN * (0.01 + 4 * kDt), 1e-9);
  const Vec3 at_rest = moved.force[0];
  EXPECT_EQ(moved.wall->totals().mesh(0).power, 0);
  moved.run(3);
  EXPECT_TRUE(moved.force[0] == at_rest);
  EXPECT_EQ(moved.wall->meshes()[0].pose().shift.x, 0.4);

  RigidMotion again;
  again.add(term);
  moved.wall->set_motion(0, again, {moved.now, kDt});
  moved.run(2);
  EXPECT_NEAR(moved.force[0].z, kN * (0.01 + 6 * kDt), 1e-9);
  moved.wall->set_motion(0, RigidMotion(), {moved.now, kDt});
  moved.run(3);
  host.simulation.corner.x = -10;
  host.simulation.edge[0].x = 21;
  EXPECT_FALSE(fails_with("periodic face", [&] { moved.run(1); }));    // nobody said so
  moved.box_changes = true;
  EXPECT_TRUE(fails_with("reaches the periodic face in x", [&] { moved.run(1); }));
}

// In radii. A mesh that goes less sees the sphere in front of it; one that goes more may leave it behind.
TEST_F(wall, stops_where_a_mesh_jumps_over_spheres)
{
  struct Row {
    Real jump, height;
    bool warns, stops;
  };
  const Row rows[] = {{0.9, 1.2, false, false},
                      {1.4, 1.2, true, false},
                      {2.1, 1.2, false, true},
                      {6, 1.2, false, true},
                      {6, 7.5, false, false}};
  for (const bool is_body : {false, true})
    for (const Row &row : rows) {
      const Real speed = row.jump * kRadius / kDt;
      Scene scene(is_body ? floor.wall("body mass 1 com 0 0 0 inertia 1 1 1 0 0 0 velocity 0 0 " +
                                       std::to_string(speed))
                          : floor.wall("motion variable NULL NULL v_jump NULL NULL NULL"));
      scene.add({0.3, 0.2, row.height * kRadius});
      scene.inputs = {0};
      scene.set_up();
      scene.inputs = {row.jump * kRadius};
      const std::size_t before = scene.host.warnings.size();
      const std::string error = error_of([&] { scene.run(1); });
      EXPECT_EQ(has(error, "it may have passed through a sphere"), row.stops) << row.jump << error;
      EXPECT_EQ(scene.host.warnings.size() - before, row.warns) << row.jump << is_body;
    }
}

// A disc 0.3 of its radius thick: the sphere around it is larger than the jump.
TEST_F(wall, stops_where_a_mesh_jumps_over_a_thin_ellipsoid)
{
  constexpr Real kThick = 0.15 * kRadius;
  for (const Real jump : {1.9 * kThick, 2.2 * kThick}) {
    WallSpec spec = floor.wall("motion variable NULL NULL v_jump NULL NULL NULL");
    spec.shapes = true;
    Scene scene(spec);
    scene.add({0.3, 0.2, 1.01 * kThick});
    GrainShape disc;
    disc.half = {kRadius, kRadius, kThick};
    disc.inertia_over_mass = {0.1, 0.1, 0.1};
    scene.shapes.push_back(disc);
    scene.inputs = {0};
    scene.set_up();
    scene.inputs = {jump};
    const std::string error = error_of([&] { scene.run(1); });
    EXPECT_EQ(has(error, "it may have passed through a sphere"), jump > 2 * kThick)
        << jump << error;
  }
}

TEST_F(wall, warns_once_where_its_program_puts_a_mesh_past_spheres)
{
  WallSpec spec = floor.wall();
  spec.meshes[0].motion.begin_posed();
  Scene scene(spec);
  scene.add({0.3, 0.2, 1.2 * kRadius});
  scene.set_up();
  const std::size_t before = scene.host.warnings.size();
  for (const Real way : {6., 0.}) {
    Pose there;
    there.shift.z = way * kRadius;
    there.placed = true;
    scene.wall->set_pose(0, there);
    scene.run(1);
  }
  EXPECT_EQ(scene.host.warnings.size() - before, 1U);
}

// A program that only is a Host: its spheres go anywhere, and it makes no room for springs.
TEST_F(wall, of_a_plain_host_pushes_spheres_anywhere)
{
  for (const Real at : {0.5, 3., -9.}) {
    Host host;
    Real x[] = {at, at, 0.45}, none[] = {0, 0, 0}, force[] = {0, 0, 0}, torque[] = {0, 0, 0},
         radius[] = {kRadius}, mass[] = {1};
    HostSpheres s;
    s.n = 1;
    s.x = x;
    s.v = s.omega = none;
    s.force = force;
    s.torque = torque;
    s.radius = radius;
    s.mass = mass;
    Wall wall(host, floor.wall(), WallUnits(), WallBackend(), "", StepClock{0, 0, 0, kDt}, s);
    wall.begin_run(0, false);
    StepInput input;
    input.step = {0, kDt, Step::setup};
    input.look = input.new_spheres = true;
    input.drift.kind = SphereDrift::watched;
    input.drift.distance = 0.1;
    wall.begin(s, input);
    wall.finish(s);
    EXPECT_NEAR(force[2], kN * 0.05, kN * kRounding) << at;
  }
}

// Placed askew, so that every coordinate of the mesh is rounded.
TEST_F(wall, has_the_same_bits_from_a_mesh_as_from_its_file)
{
  const WallSpec from_file = floor.wall("scale 0.7 rotate 1 2 3 11 move 0 0 0.1");
  WallSpec from_mesh = from_file;
  from_mesh.meshes[0].file.clear();
  from_mesh.meshes[0].mesh = welded(read_mesh(floor.name).soup);
  Vec3 force[2];
  std::uint64_t fingerprint[2];
  for (const bool by_mesh : {false, true}) {
    Scene scene(by_mesh ? from_mesh : from_file);
    scene.add(from_file.meshes[0].placement.apply({0.3, 0.2, 0.7}));    // 0.49 above it
    scene.set_up();
    force[by_mesh] = scene.force[0];
    fingerprint[by_mesh] = scene.wall->meshes()[0].grid.mesh_fingerprint();
  }
  EXPECT_GT(norm(force[0]), 0);
  EXPECT_EQ(force[0], force[1]);
  EXPECT_EQ(fingerprint[0], fingerprint[1]);
}

TEST_F(wall, names_the_lowest_tag_of_spheres_larger_than_rmax)
{
  on_processes(2, [&](FakeHost &host) {
    Scene scene(host, floor.wall("rmax 0.5"));
    scene.add({0, 0, 2}, 0.75);
    scene.add({0, 0, 4}, 0.75);
    scene.tags = {host.rank() == 0 ? 7 : 5, 9};
    EXPECT_EQ(error_of([&] { scene.set_up(); }),
              "sphere 5 has radius 0.75, more than rmax 0.5: raise rmax or use rmax auto");
  });
}

// Inputs 0 and 1 are the height of the mesh and its speed; input 2 is of no mesh.
TEST_F(wall, moves_its_mesh_by_the_inputs_of_a_step)
{
  WallSpec spec = floor.wall("motion variable NULL NULL v_z NULL NULL v_vz");
  spec.inputs.push_back("other");
  Scene scene(spec);
  EXPECT_EQ(scene.wall->inputs_read(), (std::vector<int>{0, 1}));
  scene.add({0, 0, 0.49});
  scene.inputs = {0.02, 0.5, 7};
  scene.set_up();
  EXPECT_NEAR(scene.force[0].z, kN * 0.03, kN * kRounding);
  EXPECT_EQ(scene.wall->meshes()[0].pose().velocity.z, 0.5);
}

// A mesh that is stopped where its file has it, before its first step or after a whole period, has no velocity: friction with a
// sphere that stands still does not grow.
TEST_F(wall, stands_still_where_its_motion_is_stopped_at_its_begin)
{
  constexpr int kPeriod = 4;    // steps
  for (const int steps : {0, kPeriod}) {
    WallScene scene(floor.wall("motion wiggle 0.01 0 0 " + std::to_string(kPeriod * kDt)));
    scene.add({0.3, 0.2, kRadius - 0.01}, kRadius);
    scene.set_up();
    scene.run(steps);
    scene.wall->set_motion(0, RigidMotion(), {scene.now, kDt});
    ASSERT_TRUE(scene.wall->meshes()[0].pose().shift == (Vec3{0, 0, 0}));
    scene.run(1);
    const Vec3 first = scene.force[0];
    scene.run(1);
    EXPECT_EQ(scene.force[0].x, first.x) << "after " << steps << " steps";
    EXPECT_EQ(scene.wall->totals_with_power().mesh(0).power, 0) << "after " << steps << " steps";
  }
}

// A square floor that lies turned by an eighth, and is turned back: its vertices reach x = 10, the corners of the box around it 20.
// It goes on by 0.07 a step until it is too near to the face at 18: in the first step in which it is, and not before.
TEST_F(wall, refuses_a_mesh_in_the_step_in_which_its_vertices_come_to_a_periodic_face)
{
  WallSpec spec = floor.wall("rotate 0 0 1 45");
  spec.meshes[0].motion.begin_posed();
  Scene scene(spec);
  scene.host.simulation.corner.x = -18;
  scene.host.simulation.edge[0].x = 36;
  scene.host.simulation.periodic[0] = true;
  scene.add({0, 0, 2});
  Pose pose;
  pose.placed = true;
  const Real h = std::sqrt(0.5);
  pose.row[0] = {h, -h, 0};
  pose.row[1] = {h, h, 0};
  scene.wall->set_pose(0, pose);
  scene.set_up();
  int steps = 0;
  std::string says;
  while (says.empty() && steps < 200) {
    pose.shift.x = 0.07 * ++steps;
    scene.wall->set_pose(0, pose);
    try {
      scene.run(1);
    } catch (const InputError &e) {
      says = e.what();
    }
  }
  Real from = 0, to = 0, away = 0;
  const std::size_t at = says.find("it goes from ");
  ASSERT_NE(at, std::string::npos) << says;
  ASSERT_EQ(std::sscanf(says.c_str() + at, "it goes from %lf to %lf of the box and must stay %lf",
                        &from, &to, &away),
            3)
      << says;
  EXPECT_NEAR(to, (28 + 0.07 * steps) / 36, 1e-5);    // of 6 digits
  EXPECT_GT(to, 1 - away);
  EXPECT_LE(to - 0.07 / 36, 1 - away);
}

TEST_F(wall, warns_once_where_spheres_of_its_group_went_past_a_periodic_face)
{
  Scene scene(floor.wall("rotate 0 1 0 90 move -49.6 0 0"));
  scene.host.simulation.periodic[0] = true;
  scene.add({49, 0, 0});
  scene.add({49, 2, 0});
  scene.set_up();
  scene.x[1].x = 50.5;
  HostSpheres s = scene.spheres();
  const int mask[] = {2, 1};
  s.mask = mask;
  s.group_bit = 2;
  scene.wall->check_wrapping(s);
  EXPECT_TRUE(scene.host.warnings.empty());
  s.group_bit = 1;
  // The first by 0.5, where the margin is 0.1, and then farther than the grid reaches.
  for (const Real x : {50.5, 51.5}) {
    scene.x[1].x = x;
    scene.wall->check_wrapping(s);
    ASSERT_EQ(scene.host.warnings.size(), 1u);
    EXPECT_TRUE(begins(scene.host.warnings[0], "a grain was 0.5 past a periodic face"));
  }
}

TEST_F(wall, names_the_meshes_that_press_a_sphere_whose_centre_comes_to_one_of_them)
{
  Scene scene(floor.wall("mesh " + floor.name + " move 0 0 0.4"));
  scene.add({0, 0, -0.3});    // 40 % in the floor
  scene.tags = {42};
  scene.set_up();
  scene.now = 6;
  scene.x[0].z = 0.01;    // 98 %, and 22 % in the other one
  scene.run(1);
  scene.x[0].z = 0.2;
  scene.run(1);
  scene.wall->end_run(scene.spheres(), false, "", 0);
  ASSERT_EQ(scene.host.warnings.size(), 2U);    // the first one is of where it was put
  EXPECT_TRUE(begins(scene.host.warnings[1],
                     "sphere 42 sank into the wall by 98 % of its radius 0.5 in step "
                     "7, pressed by mesh 1 '" +
                         floor.name + "' and mesh 2 '" + floor.name +
                         "': its centre came to the wall"));
  EXPECT_EQ(std::count(scene.host.lines.begin(), scene.host.lines.end(),
                       "the deepest overlap of this run is 98 % of the radius of sphere 42, at "
                       "mesh 1 '" +
                           floor.name + "' in step 7"),
            1);
}

// The sphere of a process overlaps the floor by this part of the radius in a step.
Real overlap_in(std::int64_t step, int rank)
{
  return 0.001 * static_cast<Real>(step * step + 20 * rank);
}

void press(Scene &scene, int n)
{
  for (int i = 0; i < n; i++) {
    scene.x[0].z = kRadius * (1 - overlap_in(scene.now + 1, scene.host.rank()));
    scene.run(1);
  }
}

// The mean force of two processes on the floor in these steps; rounding of a few sums of order 100.
Real mean_push(std::int64_t first, std::int64_t last)
{
  Real sum = 0;
  for (std::int64_t step = first; step <= last; step++)
    sum += overlap_in(step, 0) + overlap_in(step, 1);
  return -kN * kRadius * sum / static_cast<Real>(last - first + 1);
}

TEST_F(wall, has_the_mean_force_of_each_interval_until_the_next_one_ends)
{
  on_processes(2, [&](FakeHost &host) {
    Scene scene(host, floor.wall("average 4 mesh " + floor.name + " move 0 0 -30"));
    scene.add({2, host.rank() ? -1. : 1., 0.4});
    scene.now = 2;
    scene.set_up();    // counts for nothing
    press(scene, 1);
    EXPECT_EQ(scene.wall->means().mesh(0).force.z, 0);
    press(scene, 1);
    EXPECT_NEAR(scene.wall->means().mesh(0).force.z, mean_push(3, 4), 1e-11);
    press(scene, 3);
    EXPECT_NEAR(scene.wall->means().mesh(0).force.z, mean_push(3, 4), 1e-11);
    press(scene, 1);
    EXPECT_NEAR(scene.wall->means().mesh(0).force.z, mean_push(5, 8), 1e-11);
    // About 0 0 0 by spheres at x = 2.
    EXPECT_NEAR(scene.wall->means().mesh(0).torque.y, -2 * mean_push(5, 8), 1e-11);
    EXPECT_EQ(scene.wall->means().mesh(1).force.z, 0);
    EXPECT_EQ(scene.wall->means().of_all().force.z, scene.wall->means().mesh(0).force.z);
  });
}

TEST_F(wall, weights_a_mean_by_the_time_of_its_steps)
{
  Scene scene(floor.wall("average 2"));
  scene.add({0, 0, 0.4});
  scene.set_up();
  press(scene, 1);
  scene.dt = 3 * kDt;
  press(scene, 1);
  EXPECT_NEAR(scene.wall->means().mesh(0).force.z,
              -kN * kRadius * (overlap_in(1, 0) + 3 * overlap_in(2, 0)) / 4, 1e-11);
}

TEST_F(wall, goes_on_with_a_mean_from_a_saved_state)
{
  on_processes(2, [&](FakeHost &host) {
    Scene first(host, floor.wall("average 4")), next(host, floor.wall("average 4"));
    first.add({2, 1, 0.4});
    first.set_up();
    press(first, 6);
    next.restore_with_spheres(first);
    next.set_up();
    EXPECT_NEAR(next.wall->means().mesh(0).force.z, mean_push(1, 4), 1e-11);
    press(next, 2);
    EXPECT_NEAR(next.wall->means().mesh(0).force.z, mean_push(5, 8), 1e-11);
  });
}

TEST_F(wall, of_one_process_that_fails_names_its_sphere)
{
  Scene scene(floor.wall());
  scene.add({0, 0, 0.49});
  scene.set_up();
  scene.tags = {42};
  scene.radius[0] = 0.51;    // without a word to the wall
  scene.run(1);
  try {
    scene.wall->poll_diagnostics(scene.spheres());
    ADD_FAILURE() << "no error";
  } catch (const InputError &e) {
    EXPECT_TRUE(begins(e.what(), "sphere 42 "));
    EXPECT_TRUE(e.is_local);
  }
}

TEST_F(wall, has_the_ways_out_of_its_host_in_errors_of_the_engine)
{
  struct Told : FakeHost {
    Told() { names_.announce_growth = "tell of it"; }
  } host;
  Scene scene(host, floor.wall("rmax 0.6"));
  scene.add({0, 0, 0.49});
  scene.set_up();
  scene.radius[0] = 0.51;
  scene.run(1);
  EXPECT_EQ(error_of([&] { scene.wall->poll_diagnostics(scene.spheres()); }),
            "sphere 1 has grown since the spheres near the wall were selected, so others may "
            "have been missed; tell of it");
}

// As after `unfix` and another `fix`, when a gate is taken out: what rests on it slips a little.
TEST_F(wall, that_begins_among_spheres_at_rest_tells_that_their_springs_are_new)
{
  const auto told = [&](std::int64_t first, Real z, bool continued) {
    Scene scene(floor.wall()), before(floor.wall());
    scene.add({0.3, 0.2, z});
    before.now = scene.now = first;
    if (continued) scene.restore(before);
    scene.set_up();
    scene.set_up();
    int lines = 0;
    for (const std::string &line : scene.host.lines)
      lines += line.rfind("the wall begins in step 5 with 1 contact, whose springs are 0", 0) == 0;
    return lines;
  };
  EXPECT_EQ(told(5, 0.49, false), 1);
  EXPECT_EQ(told(0, 0.49, false), 0);
  EXPECT_EQ(told(5, 0.51, false), 0);
  EXPECT_EQ(told(5, 0.49, true), 0);
}

// Its springs go on in the next run, as in a script with two lines `run`.
TEST_F(wall, that_began_in_step_0_tells_of_no_new_springs_in_its_second_run)
{
  Scene scene(floor.wall());
  scene.add({0.3, 0.2, 0.49});
  scene.go(5);
  scene.set_up();
  for (const std::string &line : scene.host.lines) EXPECT_FALSE(has(line, "whose springs are 0"));
}

// Its shape follows from the contacts of all steps before.
TEST_F(wall, whose_mesh_recedes_has_no_snapshots)
{
  Scene scene(floor.wall("wear archard 1e-4 50 deform every 10"));
  scene.add({0.3, 0.2, 0.49});
  scene.go(10);
  EXPECT_TRUE(fails_with("in a replay the shape of a mesh that wear moves",
                         [&] { scene.step(Step::snapshot, true); }));
}

// No time has passed since the step before.
TEST_F(wall, dissipates_no_power_in_a_snapshot)
{
  WallScene scene(floor.wall("energy each_contact"));
  scene.add({0.3, 0.2, 0.49});
  scene.v[0] = {1, 0, 0};
  scene.go(30);    // until the spring is at its limit
  const auto sliding = [&] { return scene.wall->energy().mesh(0).power(EnergyRow::slider); };
  const auto of_contact = [&] {
    Real power = -1;
    scene.wall->for_contacts([&](const WallContact &c) { power = c.losses->power[1]; });
    return power;
  };
  ASSERT_GT(sliding(), 0);
  EXPECT_NEAR(of_contact(), sliding(), 1e-12 * sliding());
  scene.step(Step::snapshot, true);
  EXPECT_EQ(sliding(), 0);
  EXPECT_EQ(of_contact(), 0);
}

// A contact with an image would wear vertices that the mesh does not have, long before they are to move.
TEST_F(wall, whose_mesh_recedes_is_refused_in_the_step_in_which_its_grid_gets_images)
{
  Scene scene(floor.wall("wear archard 1e-4 50 deform every 1000"));
  PeriodicBox &box = scene.host.simulation;
  box.periodic[0] = true;
  scene.add({9.9, 0.2, 0.49});
  scene.go(1);
  box.corner.x = -10;
  box.edge[0].x = 20;
  EXPECT_TRUE(
      fails_with("wear cannot move a mesh that has periodic images", [&] { scene.run(1); }));
}

// A wall with sjkr's cohesion of 50 energy/length^3, whose pull is that times the area in which the plane cuts the sphere, whatever the
// unit of pressure is.
TEST_F(wall, takes_an_energy_of_cohesion_by_volume_in_any_unit_of_pressure)
{
  constexpr Real kOverlap = 0.01, kArea = kPi * (2 * kRadius - kOverlap) * kOverlap;
  WallUnits units;
  units.pressure = 1.6021765e6;    // of units metal
  WallScene scene(floor.wall("cohesion sjkr 50"), units);
  scene.add({0.3, 0.2, kRadius - kOverlap}, kRadius);
  scene.go(1);
  EXPECT_NEAR(scene.force[0].z, kN * kOverlap - 50 * kArea, 1e-12);
}

// Returns a wall of a box with upright sides, and gives the host two dimensions.
WallSpec upright_in_two_dimensions(FakeHost &host)
{
  host.simulation = wide_box();
  host.simulation.dimension = 2;
  WallSpec wall;
  wall.meshes.resize(1);
  wall.meshes.front().mesh = welded(box_mesh({-1, -1, -1}, {1, 1, 1}));
  return wall;
}

// A contact wears the corners of one triangle of an outline's strip, which would lean.
TEST_F(wall, whose_mesh_recedes_is_refused_in_two_dimensions)
{
  FakeHost host;
  WallSpec upright = upright_in_two_dimensions(host);
  upright.wear = {WearModel::archard, 1e-4};
  const auto make = [&](const WallSpec &wall) {
    Wall(host, wall, WallUnits(), WallBackend(), "", StepClock{0, 0, 0, kDt});
  };
  EXPECT_NO_THROW(make(upright));
  upright.wear_deform.every = 10;
  EXPECT_TRUE(fails_with("in two dimensions wear cannot move a mesh", [&] { make(upright); }));
}

// A motion or servo that leaves the plane z = 0 changes nothing.
TEST_F(wall, keeps_its_motion_where_another_one_leaves_the_plane)
{
  FakeHost host;
  WallSpec upright = upright_in_two_dimensions(host);
  Wall wall(host, upright, WallUnits(), WallBackend(), "", StepClock{0, 0, 0, kDt});
  MotionTerm term;
  term.kind = MotionKind::wiggle;
  term.amplitude = {0.1, 0, 0};
  term.period = 1;
  RigidMotion along, out;
  along.add(term);
  term.amplitude = {0, 0, 0.1};
  out.add(term);
  wall.set_motion(0, along, {0, kDt});
  EXPECT_THROW(wall.set_motion(0, out, {0, kDt}), InputError);
  ASSERT_EQ(wall.meshes().front().spec.motion.terms().size(), 1u);
  EXPECT_EQ(wall.meshes().front().spec.motion.terms().front().amplitude.x, 0.1);
  wall.set_motion(0, RigidMotion(), {0, kDt});
  Servo up;
  up.present = true;
  up.axis = {0, 0, 1};
  EXPECT_THROW(wall.set_servo(0, up), InputError);
  EXPECT_FALSE(wall.meshes().front().servo().present);
}

// Sums of servos, bodies and outputs, in that step and after it, are those of the others.
TEST_F(wall, goes_on_with_a_process_that_cannot_begin_a_step)
{
  on_processes(2, [&](FakeHost &host) {
    bool is_full = false;
    WallBackend backend;
    backend.make_engine = [&](const EngineSettings &settings) {
      return in_place_after(settings, [&] {
        if (is_full) throw InputError("there is no memory");
      });
    };
    WallSpec wall = floor.wall();
    wall.average_every = 1;
    WallScene scene(host, wall, WallUnits(), kDt, backend);
    scene.add({0.3, 0.2, 0.49}, 0.5);
    scene.go(1);
    is_full = host.rank() == 1;
    if (host.rank() == 1)
      EXPECT_THROW(scene.run(1), InputError);
    else
      scene.run(1);
    EXPECT_EQ(scene.wall->totals().mesh(0).contacts, 1);
    is_full = false;
    scene.run(1);
    EXPECT_EQ(scene.wall->totals().mesh(0).contacts, 2);
  });
}

TEST_F(wall, that_cannot_be_read_fails_on_all_processes)
{
  WallSpec settings = floor.wall();
  settings.meshes[0].file += ".missing";
  on_processes(2, [&](FakeHost &host) { EXPECT_THROW(Scene(host, settings), InputError); });
}

}    // namespace
}    // namespace lsdcd::test_wall
