// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall and the spheres of one process, step by step, where a test is the host and moves the spheres.
#pragma once

#include "support/fake_host.h"
#include "support/grains.h"
#include "wall/wall.h"

#include <cstdint>
#include <memory>

namespace lsdcd {

struct WallScene : Grains {
  FakeHost &host;
  Real dt;
  Real gravity[3] = {0, 0, 0};
  std::int64_t now = 0;
  // Steps after which spheres are looked at again, as they go less than 0.05 in between; 0: all are watched.
  int look_every = 0;
  std::unique_ptr<Wall> wall;

  WallScene(FakeHost &host, const WallSpec &spec, const WallUnits &units = WallUnits(),
            Real dt = 1e-3, const WallBackend &backend = WallBackend()) :
      host(host),
      dt(dt)
  {
    if (!host.simulation.any_periodic()) host.simulation = wide_box();    // or that of the test
    wall = std::make_unique<Wall>(host, spec, units, backend, "", StepClock{0, 0, 0, dt});
  }

  // Forces and torques are those of this step.
  void step(Step::Kind kind)
  {
    for (Vec3 &f : force) f = {0, 0, 0};
    for (Vec3 &t : torque) t = {0, 0, 0};
    wall->history().grow(static_cast<int>(x.size()));
    StepInput input;
    input.step = {now, dt, kind};
    input.new_spheres = kind == Step::setup;
    const bool is_due = look_every > 0 && now % look_every == 0;
    input.look = input.new_spheres || is_due;
    input.drift.kind = look_every > 0 ? SphereDrift::bounded : SphereDrift::watched;
    input.drift.distance = 0.05;
    input.drift.has_begun = look_every > 0 && !input.look;
    input.gravity = gravity;
    wall->begin(spheres(), input);
    wall->submit(spheres());
    wall->finish(spheres());
  }
  void set_up()
  {
    wall->begin_run(now, false);
    step(Step::setup);
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

}    // namespace lsdcd
