// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of bodies and of their coats: rows for doc/effects.md, as CSV.
//
// Spheres lie on a floor of 20 000 triangles as in bench_effects, in a step of the whole wall. The floor is at rest, moves,
// or is a body on a slider, so heavy that it stays. Points of a coat are those of a heavy cube on a floor and above it.
// Cases take turns, and the least of the times counts.
#include "bench.h"

#include "base/input_error.h"
#include "mesh/surface_points.h"
#include "support/meshes.h"
#include "support/wall_scene.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace lsdcd;

namespace {

constexpr Real kHalf = 45, kRadius = 0.5, kOverlap = 5e-3, kHeavy = 1e30;

MeshSpec floor_at_0()
{
  MeshSpec mesh;
  mesh.name = "floor";
  mesh.mesh = std::make_shared<WeldedMesh>(weld(floor_mesh(100, kHalf), -1));
  return mesh;
}

MeshSpec as_body(MeshSpec mesh)
{
  mesh.body.present = true;
  mesh.body.mass = {kHeavy, {0, 0, 0}, {}};
  mesh.body.mass.inertia = {kHeavy, kHeavy, kHeavy, 0, 0, 0};
  mesh.body.joint = {JointKind::slider, {0, 0, 0}, {0, 0, 1}};
  return mesh;
}

MeshSpec moving(MeshSpec mesh)
{
  MotionTerm term;
  term.kind = MotionKind::linear;
  term.velocity = {0, 0, 1e-9};
  mesh.motion.add(term);
  return mesh;
}

// A cube of side 10 whose lower face is `gap` above its coat on the floor.
MeshSpec coated_cube(Real gap, Real spacing, Real radius)
{
  MeshSpec mesh;
  mesh.name = "cube";
  const Real half = 5;
  mesh.mesh =
      std::make_shared<WeldedMesh>(weld(box_mesh({-half, -half, -half}, {half, half, half}), -1));
  mesh.placement.move({0, 0, half + radius + gap});
  mesh = as_body(std::move(mesh));
  mesh.body.mass.centre = {0, 0, half + radius + gap};
  mesh.body.joint = Joint();    // one that holds it would have each contact looked at twice
  mesh.body.coat = {true, spacing, radius};
  return mesh;
}

WallSpec wall_of(std::vector<MeshSpec> meshes, NormalModel normal = NormalModel::hooke,
                 bool history = false)
{
  WallSpec wall;
  ContactLaw &law = wall.laws.front().law;
  law = classic_law(normal, history);
  law.k_normal = 1e5;
  law.k_tangent = 3e4;
  law.eta = 50;
  law.mu = 0.5;
  wall.device = Device::cpu;
  wall.meshes = std::move(meshes);
  return wall;
}

struct Case {
  std::string name, words, over;
  std::unique_ptr<FakeHost> host;
  std::unique_ptr<WallScene> scene;
  int each;                // spheres or points that the time is divided by; 1: a step
  bool only_more;          // than without: the rest of the step is not theirs
  double least = 1e300;    // of a step, ns
};

class Cases {
 public:
  void add(const char *name, const char *words, const char *over, const WallSpec &spec, int spheres,
           int each, bool only_more = false)
  {
    Case c{name, words, over, std::make_unique<FakeHost>(), nullptr, each, only_more};
    c.scene = std::make_unique<WallScene>(*c.host, spec, WallUnits(), 1e-7);
    std::mt19937_64 random(11);
    std::uniform_real_distribution<Real> place(-0.98 * kHalf, 0.98 * kHalf);
    for (int i = 0; i < spheres; i++)
      c.scene->add({place(random), place(random), kRadius - kOverlap}, kRadius);
    c.scene->set_up();
    all_.push_back(std::move(c));
  }
  void run(int repeats)
  {
    constexpr int kStepsOfRound = 100;    // a step without spheres takes less than the clock tells
    for (int r = -1; r < repeats; r++)
      for (Case &c : all_) {
        const std::clock_t start = std::clock();
        c.scene->run(kStepsOfRound);
        const double ns =
            1e9 * static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC / kStepsOfRound;
        if (r >= 0) c.least = std::min(c.least, ns);
      }
  }
  void print(int repeats, const char *commit) const
  {
    std::printf("name;words;over;each;repeats;min_ns;over_ns;saved_bytes;compiler;commit\n");
    for (const Case &c : all_) {
      double more = 0;
      for (const Case &other : all_)
        if (other.name == c.over) more = (c.least - other.least) / c.each;
      std::printf("%s;%s;%s;%d;%d;%.2f;%.2f;%zu;%s;%s\n", c.name.c_str(), c.words.c_str(),
                  c.over.c_str(), c.each, repeats, c.only_more ? 0 : c.least / c.each, more,
                  saved_bytes(c), compiler(), commit);
    }
  }

 private:
  // In a restart file for each body, or for each contact of a coat.
  static std::size_t saved_bytes(const Case &c)
  {
    WallState state = c.scene->wall->save();
    const std::size_t all = state.blocks().numbers().size();
    for (MeshState &m : state.meshes) {
      if (c.only_more)
        m.coat.clear();
      else
        m.body = BodyState();
    }
    const std::size_t numbers = all - state.blocks().numbers().size();
    return numbers * sizeof(Real) / (c.only_more ? c.each : 1);
  }

  std::vector<Case> all_;
};

void measure(int spheres, int repeats, const char *commit)
{
  Cases cases;
  const MeshSpec floor = floor_at_0();
  cases.add("contact on a mesh at rest", "hooke", "", wall_of({floor}), spheres, spheres);
  cases.add("contact on a mesh that moves", "motion", "contact on a mesh at rest",
            wall_of({moving(floor)}), spheres, spheres);
  cases.add("contact on a body", "body", "contact on a mesh at rest", wall_of({as_body(floor)}),
            spheres, spheres);
  cases.add("step of a mesh at rest", "hooke", "", wall_of({floor}), 0, 1);
  cases.add("step of a mesh that moves", "motion", "step of a mesh at rest",
            wall_of({moving(floor)}), 0, 1);
  cases.add("step of a body", "body", "step of a mesh at rest", wall_of({as_body(floor)}), 0, 1);
  const Real spacing = 0.25, radius = 0.2;
  const MeshSpec in_air = coated_cube(5, spacing, radius),
                 touching = coated_cube(-0.01, spacing, radius);
  const std::vector<Vec3> points = surface_points(*in_air.mesh, spacing, 1000000);
  const auto below = [&](const Vec3 &p) { return p.z == in_air.mesh->report.lo.z; };
  cases.add("point of a coat that touches nothing", "coat", "",
            wall_of({floor, in_air}, NormalModel::hooke, true), 0, static_cast<int>(points.size()));
  cases.add("contact of a point of a coat", "coat", "point of a coat that touches nothing",
            wall_of({floor, touching}, NormalModel::hooke, true), 0,
            static_cast<int>(std::count_if(points.begin(), points.end(), below)), true);
  cases.run(repeats);
  cases.print(repeats, commit);
}

}    // namespace

int main(int argc, char **argv)
{
  const int spheres = argc == 4 ? std::atoi(argv[1]) : 0,
            repeats = argc == 4 ? std::atoi(argv[2]) : 0;
  if (spheres < 1 || repeats < 1) {
    std::fprintf(stderr, "usage: bench_rigid SPHERES REPEATS COMMIT\n");
    return 2;
  }
  try {
    measure(spheres, repeats, argv[3]);
  } catch (const InputError &e) {
    std::fprintf(stderr, "bench_rigid: %s\n", e.what());
    return 1;
  }
  return 0;
}
