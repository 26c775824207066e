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
  std::unique_ptr<Wall> wall;

  WallScene(FakeHost &host, const WallSpec &spec, const WallUnits &units = WallUnits(),
            Real dt = 1e-3, const WallBackend &backend = WallBackend()) :
      host(host),
      dt(dt)
  {
    host.simulation = wide_box();
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
    input.look = input.new_spheres = kind == Step::setup;
    input.drift.kind = SphereDrift::watched;
    input.drift.distance = 0.05;
    input.gravity = gravity;
    wall->begin(spheres(), input);
    wall->launch(spheres());
    wall->finish(spheres());
  }
  void set_up()
  {
    wall->begin_run(now, false);
    step(Step::setup);
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
