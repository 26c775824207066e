// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are no spheres and a wall, for tests that move them.
#pragma once

#include "engine/shape_engine.h"
#include "grid/flat_grid.h"
#include "shape/superellipsoid.h"
#include "support/grains.h"
#include "support/meshes.h"
#include "tree/triangle_tree.h"

#include <memory>
#include <vector>

namespace lsdcd {

inline EngineSettings for_shapes(EngineSettings settings)
{
  settings.law().for_shapes = true;
  return settings;
}

// Grains and a wall. Grains turn by rotations about their own axes in turn, which keeps their angular momentum.
class ShapeScene : public Grains {
 public:
  std::vector<Vec3> momentum;
  std::vector<GrainShape> shapes;
  std::unique_ptr<WallEngine> engine;
  ContactHistory springs;

  ShapeScene(const TriangleSoup &soup, Real cutoff, const EngineSettings &settings) :
      springs(settings.law().n_extra()), mesh_(weld(soup, -1)), names_(mesh_), tree_(mesh_, names_)
  {
    StepGridSettings g;
    g.cutoff = cutoff;
    flat_ = FlatOf(build_grid(mesh_, g, false));
    engine = make_shape_engine(settings);
    engine->set_grid(flat_.view());
    engine->set_tree(tree_);
  }

  // At rest, not turned.
  int add(const Vec3 &at, const Vec3 &half, Real n1 = 2, Real n2 = 2, Real m = 1)
  {
    const Superellipsoid s = make_superellipsoid(half, n1, n2);
    GrainShape row;
    row.half = half;
    row.n1 = n1;
    row.n2 = n2;
    row.inertia_over_mass = inertia_over_mass(s);
    shapes.push_back(row);
    Grains::add(at, s.farthest);
    mass.back() = m;
    momentum.push_back({0, 0, 0});
    springs.grow(static_cast<int>(x.size()));
    return static_cast<int>(x.size()) - 1;
  }
  // Keeps the candidates from here on: for grains that never leave the wall.
  void keep_candidates(Real dt)
  {
    compute(dt, false);
    keeps_candidates_ = true;
  }
  void compute(Real dt, bool update = true)
  {
    step_once(*engine, prepared(), settings_of(dt, update),
              springs.n_extra() > 0 ? &springs : nullptr);
  }
  // Forces that depend on places alone, and what was counted.
  StepDiagnostics look(Real dt)
  {
    engine->choose(prepared(), 0, false);
    engine->step(prepared(), settings_of(dt, false));
    return engine->read_diagnostics();
  }
  // With the candidates of the last step.
  void step_as_chosen(Real dt) { engine->step(prepared(), settings_of(dt, true)); }
  // As velocity Verlet.
  void step(Real dt, const Vec3 &gravity = {0, 0, 0})
  {
    kick(dt / 2, gravity);
    for (std::size_t i = 0; i < x.size(); i++) {
      x[i] += dt * v[i];
      turn(i, dt);
    }
    if (keeps_candidates_)
      step_as_chosen(dt);
    else
      compute(dt);
    kick(dt / 2, gravity);
  }
  Vec3 inertia_of(std::size_t i) const { return mass[i] * shapes[i].inertia_over_mass; }
  Vec3 omega_of(std::size_t i) const
  {
    const Vec3 own = rotate(inverse(shapes[i].turn), momentum[i]), I = inertia_of(i);
    return rotate(shapes[i].turn, {own.x / I.x, own.y / I.y, own.z / I.z});
  }
  void spin(std::size_t i, const Vec3 &to)
  {
    const Vec3 own = rotate(inverse(shapes[i].turn), to), I = inertia_of(i);
    momentum[i] = rotate(shapes[i].turn, {own.x * I.x, own.y * I.y, own.z * I.z});
  }
  Real energy(std::size_t i) const
  {
    return 0.5 * mass[i] * norm_sq(v[i]) + 0.5 * dot(momentum[i], omega_of(i)) +
           engine->results().totals().energy;
  }

 private:
  Spheres prepared()
  {
    for (Vec3 &f : force) f = {0, 0, 0};
    for (Vec3 &t : torque) t = {0, 0, 0};
    for (std::size_t i = 0; i < x.size(); i++) omega[i] = omega_of(i);
    Spheres s = spheres();
    s.shapes = shapes.data();
    return s;
  }
  static StepSettings settings_of(Real dt, bool update)
  {
    StepSettings step;
    step.dt = dt;
    step.update_history = update;
    return step;
  }
  void kick(Real dt, const Vec3 &gravity)
  {
    for (std::size_t i = 0; i < x.size(); i++) {
      v[i] += dt * ((1 / mass[i]) * force[i] + gravity);
      momentum[i] += dt * torque[i];
    }
  }
  void turn(std::size_t i, Real dt)
  {
    GrainShape &s = shapes[i];
    const int axis[] = {0, 1, 2, 1, 0};
    const Real part[] = {0.5, 0.5, 1, 0.5, 0.5};
    for (int k = 0; k < 5; k++) {
      const int a = axis[k];
      Vec3 own = {0, 0, 0};
      own[a] = 1;
      const Real rate = rotate(inverse(s.turn), momentum[i])[a] / inertia_of(i)[a];
      s.turn = s.turn * rotation_about(own, part[k] * dt * rate);
    }
    s.turn = normalised(s.turn);
  }

  WeldedMesh mesh_;
  TriangleTable names_;
  TriangleTree tree_;
  FlatOf<StepGrid> flat_;
  bool keeps_candidates_ = false;
};

}    // namespace lsdcd
