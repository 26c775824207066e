// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a step leaves behind belongs to it until the next one begins, whatever is set in between, and whether or not somebody has asked
// before.
#include "support/laws.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/wall_scene.h"

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

namespace lsdcd::test_last_step {
namespace {

constexpr Real kDt = 1e-3, kRadius = 0.3;

struct Mesh {
  bool moves = false, servo = false, posed = false, body = false, nodes = false;
  bool keeps_contacts = true;    // for who asks for each
};

MotionTerm rotation(Real period)
{
  MotionTerm term;
  term.kind = MotionKind::rotate;
  term.axis = {0.1, 0.2, 1};
  term.period = period;
  return term;
}

MotionTerm rise(Real speed)
{
  MotionTerm term;
  term.kind = MotionKind::linear;
  for (int d = 0; d < 3; d++) term.speed[d] = d == 2 ? speed : 0;
  return term;
}

Servo servo_to(Real target)
{
  Servo servo;
  servo.present = true;
  servo.target = target;
  servo.max_speed = 0.2;
  return servo;
}

Joint hinge(const Vec3 &axis)
{
  Joint joint;
  joint.kind = JointKind::hinge;
  joint.axis = axis;
  joint.point = {0, 0, -1};
  return joint;
}

WallSpec wall_of(const Mesh &is)
{
  WallSpec wall;
  wall.laws.front().law = hooke_history(1000, 300, 20, 5, 0.5).law();
  wall.device = Device::cpu;
  wall.contacts = wall.each_contact = is.keeps_contacts;
  MeshSpec mesh;
  mesh.name = "mesh";
  mesh.mesh = welded(is.body ? box_mesh({-1, -1, -2}, {1, 1, 0}) : floor_mesh(3, 2));
  if (is.moves) mesh.motion.add(rotation(0.5));
  if (is.servo) mesh.motion.servo() = servo_to(3);
  if (is.posed) mesh.motion.begin_posed();
  mesh.has_nodes = is.nodes;
  mesh.pressure = is.nodes ? 2 : 0;
  mesh.body.present = is.body;
  mesh.body.density = 2;
  mesh.body.joint = hinge({1, 0, 0});
  wall.meshes.push_back(mesh);
  return wall;
}

// Spheres of two processes that slide on what is below z = 0.
struct Scene : WallScene {
  Scene(FakeHost &host, const Mesh &is) : WallScene(host, wall_of(is), WallUnits(), kDt)
  {
    gravity[2] = -10;
    for (int i = 0; i < 4; i++) {
      if (i % host.processes() != host.rank()) continue;
      add({-0.8 + 0.5 * i, 0.2 * i - 0.3, kRadius - 0.01 - 0.004 * i}, kRadius);
      v.back() = {0.3, -0.1 * i, -0.05};
      omega.back() = {1, 0.5 * i, 2};
    }
    set_up();
    for (int k = 0; k < 3; k++) {
      set_mesh(is, 0.02 * k, 0.4);
      move_spheres();
    }
  }

  void set_mesh(const Mesh &is, Real up, Real speed)
  {
    if (is.posed) set_pose(up, speed);
    if (is.nodes) set_nodes(up / 100, speed);
  }
  void set_pose(Real up, Real speed)
  {
    Pose pose;
    pose.placed = true;
    pose.shift = {0, 0, up / 100};
    pose.velocity = {0, 0, speed};
    pose.angular = {0, 0.1 * speed, 0};
    wall->set_pose(0, pose);
  }
  void set_nodes(Real up, Real speed)
  {
    std::vector<Vec3> at = welded(floor_mesh(3, 2))->vertices, with;
    for (Vec3 &x : at) {
      x.z += up * (1 + 0.1 * x.x);
      with.push_back({0, 0, speed * x.y});
    }
    wall->set_nodes(0, &at[0].x, &with[0].x);
  }

  // All numbers that a host can ask for.
  std::vector<Real> left() const
  {
    std::vector<Real> all;
    const auto put = [&all](const Vec3 &a) { all.insert(all.end(), {a.x, a.y, a.z}); };
    const MeshTotals t = wall->totals().mesh(0);
    for (const Vec3 &a : {t.force, t.torque, t.torque_at_origin, t.couple}) put(a);
    all.insert(all.end(), {t.contacts, t.overlap, t.uncertified, t.power, t.energy});
    wall->for_contact_rows([&](int sphere, const Real *row) {
      all.push_back(sphere);
      all.insert(all.end(), row, row + 8);
    });
    wall->for_contacts([&](const WallContact &c) {
      all.insert(all.end(), {Real(c.sphere), Real(c.mesh), c.overlap});
      put(c.force);
      put(c.point);
    });
    Real virial[6] = {};
    wall->add_virial(virial);
    all.insert(all.end(), virial, virial + 6);
    if (const BodyMover *body = wall->body(0)) {
      put(body->reaction().force);
      put(body->reaction().torque);
      all.push_back(body->stop_force());
    }
    if (wall->meshes()[0].nodes())
      all.insert(all.end(), wall->node_forces(0).begin(), wall->node_forces(0).end());
    return all;
  }
};

struct Change {
  const char *name;
  Mesh mesh;
  std::function<void(Scene &)> set;
};

RigidMotion rigid_motion(const std::vector<MotionTerm> &terms)
{
  RigidMotion motion;
  for (const MotionTerm &term : terms) motion.add(term);
  return motion;
}

const Mesh kRests = {}, kMoves = {true}, kServo = {false, true}, kPosed = {false, false, true},
           kBody = {false, false, false, true}, kNodes = {false, false, false, false, true},
           kPlain = {false, false, false, false, false, false};

std::vector<Change> changes()
{
  const auto motion = [](const std::vector<MotionTerm> &terms) {
    return [terms](Scene &s) { s.wall->set_motion(0, rigid_motion(terms), {s.now, s.dt}); };
  };
  const auto servo = [](const Servo &to) { return [to](Scene &s) { s.wall->set_servo(0, to); }; };
  const auto body = [](const Joint &joint, Real motor) {
    return [joint, motor](Scene &s) {
      BodySpec to = s.wall->spec().meshes[0].body;
      to.joint = joint;
      to.drive.motor = motor;
      to.has_gravity = true;
      s.wall->set_body(0, to);
    };
  };
  return {{"a first motion", kRests, motion({rotation(2)})},
          {"a first motion of a plain wall", kPlain, motion({rise(2)})},
          {"a first servo", kRests, servo(servo_to(3))},
          {"the virial", kPlain, [](Scene &s) { s.wall->begin_run(s.now, true); }},
          {"inputs", kRests, [](Scene &s) { s.wall->set_inputs({"a"}); }},
          {"another motion", kMoves, motion({rise(2)})},
          {"no motion", kMoves, motion({})},
          {"another target", kServo, servo(servo_to(-5))},
          {"no servo", kServo, servo(Servo())},
          {"a motion beside a servo", kServo, motion({rise(1)})},
          {"a pose", kPosed, [](Scene &s) { s.set_pose(0.5, 3); }},
          {"another joint", kBody, body(hinge({0, 1, 0}), 0)},
          {"a motor", kBody, body(hinge({1, 0, 0}), 20)},
          {"nodes", kNodes, [](Scene &s) { s.set_nodes(0.002, 3); }}};
}

TEST(last_step, keeps_its_numbers_whatever_is_set_asked_before_or_not)
{
  for (const Change &change : changes())
    for (const int processes : {1, 2})
      on_processes(processes, [&](FakeHost &host) {
        const std::string where = std::string(change.name) + (host.rank() ? ", second" : "");
        Scene asked(host, change.mesh), silent(host, change.mesh);
        const std::vector<Real> before = asked.left();
        ASSERT_GT(asked.wall->totals().mesh(0).contacts, 1) << where;
        change.set(asked);
        change.set(silent);
        EXPECT_EQ(silent.left(), before) << where;
        EXPECT_EQ(asked.left(), before) << where;
        asked.run(2);
        silent.run(2);
        EXPECT_EQ(asked.left(), silent.left()) << where;
      });
}

// The next step has what was set, and not what was asked.
TEST(last_step, hands_over_to_a_step_that_does_not_depend_on_what_was_asked)
{
  for (const Change &change : changes())
    on_processes(2, [&](FakeHost &host) {
      Scene asked(host, change.mesh), silent(host, change.mesh);
      asked.left();
      change.set(asked);
      change.set(silent);
      asked.run(1);
      silent.run(1);
      EXPECT_TRUE(is_same_pose(asked.wall->meshes()[0].pose(), silent.wall->meshes()[0].pose()))
          << change.name;
      EXPECT_EQ(asked.force.size(), silent.force.size());
      for (std::size_t i = 0; i < asked.force.size(); i++)
        EXPECT_TRUE(asked.force[i] == silent.force[i]) << change.name;
      EXPECT_EQ(asked.left(), silent.left()) << change.name;
    });
}

TEST(last_step, is_in_a_state_that_is_saved_after_a_change)
{
  for (const Change &change : changes()) {
    FakeHost host;
    Scene asked(host, change.mesh), silent(host, change.mesh);
    asked.left();
    change.set(asked);
    change.set(silent);
    const MeshTotals right = asked.wall->totals().mesh(0),
                     saved = silent.wall->save().meshes[0].last.front().totals;
    EXPECT_TRUE(saved.force == right.force && saved.torque == right.torque) << change.name;
    EXPECT_EQ(saved.contacts, right.contacts) << change.name;
    EXPECT_EQ(saved.power, right.power) << change.name;
  }
}

// The engine that a first motion replaces has seen the deepest overlap.
TEST(last_step, is_counted_in_a_run_whose_mesh_begins_to_move)
{
  FakeHost host;
  Scene scene(host, kRests);
  for (Vec3 &x : scene.x) x.z = kRadius - 0.05;
  scene.run(1);
  for (Vec3 &x : scene.x) x.z = kRadius - 0.01;
  scene.wall->set_motion(0, rigid_motion({rise(0.1)}), {scene.now, scene.dt});
  scene.run(1);
  scene.wall->end_run(scene.spheres(), false, "", 0);
  std::string log;
  for (const std::string &line : host.lines) log += line + "\n";
  EXPECT_TRUE(has(log, "the deepest overlap of this run is 16.6667 %"));
}

}    // namespace
}    // namespace lsdcd::test_last_step
