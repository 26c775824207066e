// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall and the spheres of one process, step by step, where a test is the host and moves the spheres.
#pragma once

#include "support/fake_host.h"
#include "support/grains.h"
#include "wall/wall.h"

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

namespace lsdcd {

struct WallScene : Grains {
  std::unique_ptr<FakeHost> alone;    // the host of a scene that has one of its own
  FakeHost &host;
  Real dt;
  Real gravity[3] = {0, 0, 0};
  std::int64_t now = 0;
  // Steps after which spheres are looked at again, as they go less than 0.05 in between; 0: all are watched.
  int look_every = 0;
  bool box_changes = false;
  std::vector<Real> inputs;          // of the step
  std::vector<GrainShape> shapes;    // of the grains; none: they are spheres
  std::unique_ptr<Wall> wall;

  WallScene(FakeHost &host, const WallSpec &spec, const WallUnits &units = WallUnits(),
            Real dt = 1e-3, const WallBackend &backend = WallBackend()) :
      host(host),
      dt(dt)
  {
    if (!host.simulation.any_periodic()) host.simulation = wide_box();    // or that of the test
    wall = std::make_unique<Wall>(host, spec, units, backend, "", StepClock{0, 0, 0, dt});
  }

  // On one process, which this is the only scene of.
  explicit WallScene(const WallSpec &spec, const WallUnits &units = WallUnits(), Real dt = 1e-3,
                     const WallBackend &backend = WallBackend()) :
      WallScene(std::make_unique<FakeHost>(), spec, units, dt, backend)
  {
  }
  WallScene(std::unique_ptr<FakeHost> own, const WallSpec &spec, const WallUnits &units, Real dt,
            const WallBackend &backend) :
      WallScene(*own, spec, units, dt, backend)
  {
    alone = std::move(own);
  }

  // Takes what the wall of `before` saves, and its time.
  void restore(WallScene &before)
  {
    now = before.now;
    wall->restore(WallState::from(before.wall->save().blocks()), {now, dt});
  }
  // Takes the spheres of `before` besides, with their springs.
  void restore_with_spheres(WallScene &before)
  {
    static_cast<Grains &>(*this) = before;
    wall->history().grow(static_cast<int>(x.size()));
    restore(before);
    std::vector<Real> packed(before.wall->history().max_packed_size());
    for (int i = 0; i < static_cast<int>(x.size()); i++)
      wall->history().unpack_saved(i, packed.data(), before.wall->pack_saved(i, packed.data()));
  }

  // Forces and torques are those of this step.
  void step(Step::Kind kind) { step(kind, kind == Step::setup); }
  void step(Step::Kind kind, bool new_spheres)
  {
    for (Vec3 &f : force) f = {0, 0, 0};
    for (Vec3 &t : torque) t = {0, 0, 0};
    wall->history().grow(static_cast<int>(x.size()));
    StepInput input;
    input.step = {now, dt, kind};
    input.new_spheres = new_spheres;
    input.box_changes = box_changes;
    input.inputs = inputs;
    const bool is_due = look_every > 0 && now % look_every == 0;
    input.look = input.new_spheres || is_due;
    input.drift.kind = look_every > 0 ? SphereDrift::bounded : SphereDrift::watched;
    input.drift.distance = 0.05;
    input.drift.has_begun = look_every > 0 && !input.look;
    input.gravity = gravity;
    HostSpheres grains = spheres();
    if (!shapes.empty()) grains.shapes = shapes.data();
    wall->begin(grains, input);
    wall->submit(grains);
    wall->finish(grains);
  }
  void set_up()
  {
    wall->begin_run(now, false);
    step(Step::setup);
  }
  // A run of n steps.
  void go(int n)
  {
    set_up();
    run(n);
  }
  // A step in which spheres move as well, by their forces and gravity.
  void move_spheres()
  {
    kick();
    for (std::size_t i = 0; i < x.size(); i++) x[i] += dt * v[i];
    run(1);
    kick();
  }
  // Half a step of their velocities.
  void kick()
  {
    const Vec3 g = {gravity[0], gravity[1], gravity[2]};
    for (std::size_t i = 0; i < x.size(); i++) {
      v[i] += 0.5 * dt * (1 / mass[i] * force[i] + g);
      omega[i] += 0.5 * dt / (0.4 * mass[i] * radius[i] * radius[i]) * torque[i];
    }
  }
  void run(int n)
  {
    for (int i = 0; i < n; i++) {
      now++;
      step(Step::step);
    }
  }
};

// To the last bit, with velocities.
inline bool is_same_pose(const Pose &a, const Pose &b)
{
  return a.shift == b.shift && a.velocity == b.velocity && a.angular == b.angular &&
         a.row[0] == b.row[0];
}

}    // namespace lsdcd
