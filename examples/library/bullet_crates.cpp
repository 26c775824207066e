// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Crates fall on a bed of grains and on each other: Bullet moves them and has the contacts between them, the library has
// the forces between them, the tray and the grains. bullet_crates [SECONDS]
//
// Both programs make the same steps: forces where all is, then velocities, then places. So what a crate gives the grains it
// takes from them in the same step. The program prints how much of the momentum of all is missing, and ends with 1 where
// that is more than rounding. Units are SI; z is up.
#include <btBulletDynamicsCommon.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <deque>
#include <lsdcd.hpp>
#include <string>
#include <vector>

namespace {

static_assert(sizeof(btScalar) == sizeof(double), "compile with -D BT_USE_DOUBLE_PRECISION");

constexpr double kDt = 5e-5, kGravity = 9.81, kStiffness = 1e4;
constexpr double kGrain = 6e-3,
                 kGrainMass = 2500 * 4 / 3. * 3.14159265358979 * kGrain * kGrain * kGrain;
constexpr double kTray = 0.16, kCrateMass = 0.05;
constexpr int kCrates = 3;

// Half the edge of a crate: each is smaller than the one below.
double half_of(int crate)
{
  return 0.025 - 0.002 * crate;
}

// A box about the origin in x and y; without its lid it is a tray.
lsdcd::Mesh box(double half, double below, double above, bool has_lid)
{
  std::vector<double> vertices;
  for (int k = 0; k < 8; k++)
    for (const double x : {k & 1 ? half : -half, k & 2 ? half : -half, k & 4 ? above : below})
      vertices.push_back(x);
  const std::array<std::uint32_t, 4> quads[] = {{0, 2, 3, 1}, {0, 1, 5, 4}, {2, 6, 7, 3},
                                                {0, 4, 6, 2}, {1, 3, 7, 5}, {4, 5, 7, 6}};
  std::vector<std::uint32_t> faces;
  for (int q = 0; q < (has_lid ? 6 : 5); q++)
    for (const int k : {0, 1, 2, 0, 2, 3}) faces.push_back(quads[q][k]);
  return lsdcd::Mesh(vertices, faces);
}

// Spheres that push one another by a spring and a dashpot. Vectors have three numbers, as the library takes them.
struct Grains {
  std::vector<std::array<double, 3>> x, v, omega, force, torque;
  std::vector<double> radius, mass;

  Grains()
  {
    const double side = 2.02 * kGrain, half = kTray / 2 - kGrain;
    for (int layer = 0; layer < 3; layer++)
      for (double a = -half; a <= half - layer % 2 * side / 2; a += side)
        for (double b = -half; b <= half - layer % 2 * side / 2; b += side)
          x.push_back(
              {a + layer % 2 * side / 2, b + layer % 2 * side / 2, kGrain + 0.75 * layer * side});
    v = omega = force = torque = std::vector<std::array<double, 3>>(x.size(), {0, 0, 0});
    radius.assign(x.size(), kGrain);
    mass.assign(x.size(), kGrainMass);
  }

  void push_each_other()
  {
    const double damping = 0.3 * std::sqrt(kStiffness * kGrainMass);
    for (std::size_t i = 0; i < x.size(); i++)
      for (std::size_t j = 0; j < i; j++) {
        double between[3], distance = 0, approach = 0;
        for (int k = 0; k < 3; k++) distance += std::pow(between[k] = x[i][k] - x[j][k], 2);
        if (distance >= 4 * kGrain * kGrain) continue;
        distance = std::sqrt(distance);
        for (int k = 0; k < 3; k++) approach -= (v[i][k] - v[j][k]) * between[k] / distance;
        const double push = kStiffness * (2 * kGrain - distance) + damping * approach;
        for (int k = 0; k < 3; k++) {
          force[i][k] += push * between[k] / distance;
          force[j][k] -= push * between[k] / distance;
        }
      }
  }
  void push(lsdcd::Wall &wall, bool setup)
  {
    std::fill(torque.begin(), torque.end(), std::array<double, 3>{0, 0, 0});
    std::fill(force.begin(), force.end(), std::array<double, 3>{0, 0, -kGravity * kGrainMass});
    push_each_other();
    lsdcd_spheres s = {};
    s.size = sizeof s;
    s.n = x.size();
    s.x = x[0].data();
    s.v = v[0].data();
    s.omega = omega[0].data();
    s.radius = radius.data();
    s.mass = mass.data();
    s.force = force[0].data();
    s.torque = torque[0].data();
    lsdcd_wall_step step = {};
    step.size = sizeof step;
    step.dt = kDt;
    step.setup = setup;
    wall.step(s, step);
  }
  void move()
  {
    const double inertia = 0.4 * kGrainMass * kGrain * kGrain;
    for (std::size_t i = 0; i < x.size(); i++)
      for (int k = 0; k < 3; k++) {
        v[i][k] += kDt / kGrainMass * force[i][k];
        omega[i][k] += kDt / inertia * torque[i][k];
        x[i][k] += kDt * v[i][k];
      }
  }
};

// Bullet's world with the crates, one above the other and each turned a little.
struct Crates {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::deque<btBoxShape> shapes;
  std::deque<btRigidBody> bodies;

  Crates()
  {
    world.setGravity(btVector3(0, 0, -kGravity));
    for (int k = 0; k < kCrates; k++) {
      const double half = half_of(k);
      btBoxShape &shape = shapes.emplace_back(btVector3(half, half, half));
      btVector3 inertia;
      shape.calculateLocalInertia(kCrateMass, inertia);
      btRigidBody &b = bodies.emplace_back(
          btRigidBody::btRigidBodyConstructionInfo(kCrateMass, nullptr, &shape, inertia));
      b.setWorldTransform(btTransform(btQuaternion(btVector3(0, 0, 1), 0.2 * k),
                                      btVector3(0.004 * k, 0, 0.07 + 0.055 * k)));
      b.setActivationState(DISABLE_DEACTIVATION);
      world.addRigidBody(&b);
    }
  }
  ~Crates()
  {
    for (btRigidBody &b : bodies) world.removeRigidBody(&b);
  }
  lsdcd::Pose pose(int k) const
  {
    const btRigidBody &b = bodies[k];
    const btQuaternion q = b.getOrientation();
    lsdcd::Pose pose;
    pose.quaternion = {q.w(), q.x(), q.y(), q.z()};
    for (int i = 0; i < 3; i++) {
      pose.position[i] = b.getCenterOfMassPosition()[i];
      pose.velocity[i] = b.getLinearVelocity()[i];
      pose.angular_velocity[i] = b.getAngularVelocity()[i];
    }
    return pose;
  }
};

int fall(double seconds)
{
  std::string words = "hooke/history $kn $kt 800 400 0.5 1 log brief  mesh $tray";
  lsdcd::Values values = {
      {"kn", kStiffness}, {"kt", 0.5 * kStiffness}, {"tray", box(kTray / 2, 0, 0.1, false)}};
  for (int k = 0; k < kCrates; k++) {    // mesh number 1 + k
    const double half = half_of(k);
    const std::string name = "crate" + std::to_string(k);
    words += " mesh $" + name + " motion caller";
    values.emplace_back(name, box(half, -half, half, true));
  }
  lsdcd::Wall wall(words, values);
  Grains grains;
  Crates crates;

  std::array<double, 3> missing = {0, 0, 0};
  double given = 0;
  const auto book = [&](int k, double momentum) {
    missing[k] += momentum;
    given += std::fabs(momentum);
  };
  const int steps = static_cast<int>(std::lround(seconds / kDt));
  for (int n = 0; n < steps; n++) {
    for (int k = 0; k < kCrates; k++) wall.set_pose(1 + k, crates.pose(k));
    grains.push(wall, n == 0);
    for (int k = 0; k < kCrates; k++) {
      const lsdcd::Pose at = crates.pose(k);
      const lsdcd_wall_totals w =
          wall.totals(1 + k, {at.position[0], at.position[1], at.position[2]});
      crates.bodies[k].applyCentralForce(btVector3(w.force[0], w.force[1], w.force[2]));
      crates.bodies[k].applyTorque(btVector3(w.torque[0], w.torque[1], w.torque[2]));
    }
    const lsdcd_wall_totals on_tray = wall.totals(0);
    for (int k = 0; k < 3; k++) book(k, -kDt * on_tray.force[k]);
    book(2, -kDt * kGravity *
                (kCrates * kCrateMass + static_cast<double>(grains.x.size()) * kGrainMass));
    grains.move();
    crates.world.stepSimulation(kDt, 0);
  }
  for (const auto &v : grains.v)
    for (int k = 0; k < 3; k++) book(k, -kGrainMass * v[k]);
  bool is_stacked = true;
  double below = 0.03;
  for (const btRigidBody &b : crates.bodies) {
    for (int k = 0; k < 3; k++) book(k, -kCrateMass * b.getLinearVelocity()[k]);
    const double z = b.getCenterOfMassPosition().z();
    std::printf("a crate is %.1f mm above the tray's floor, and sinks at %.2g mm/s\n", 1e3 * z,
                -1e3 * b.getLinearVelocity().z());
    is_stacked &= z > below;
    below = z + 0.03;
  }
  std::printf("momentum: %.2g %.2g %.2g N s are missing of %.3g\n", missing[0], missing[1],
              missing[2], given);
  // Each step sums as many numbers as there are grains, none larger than all that was given.
  const double rounding = static_cast<double>(grains.x.size()) * 2.3e-16 * given;
  return is_stacked && std::all_of(missing.begin(), missing.end(),
                                   [&](double m) { return std::fabs(m) <= rounding; })
             ? 0
             : 1;
}

}    // namespace

int main(int argc, char **argv)
try {
  return fall(argc > 1 ? std::atof(argv[1]) : 0.4);
} catch (const std::exception &e) {
  std::fprintf(stderr, "%s\n", e.what());
  return 1;
}
