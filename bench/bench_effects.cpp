// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of every effect of a wall, or of bodies and their coats: rows for doc/effects.md, as CSV.
//
// Spheres lie on a floor of 20 000 triangles, each with one contact. For effects a step is the engine's. For bodies it is that of the
// whole wall, whose floor is at rest, moves, or is a body on a slider, so heavy that it stays; points of a coat are those of a heavy
// cube on a floor and above it. Cases take turns, so that what disturbs the machine disturbs all alike; the least of the times is
// nearest to the truth, since disturbances only add.
#include "bench.h"

#include "base/input_error.h"
#include "effects/effects.h"
#include "grid/flat_grid.h"
#include "mesh/surface_points.h"
#include "support/meshes.h"
#include "support/sphere_arrays.h"
#include "support/wall_scene.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <utility>
#include <vector>

using namespace lsdcd;

namespace {

constexpr Real kRadius = 0.5, kOverlap = 5e-3;

// ---- cases in turn ------------------------------------------------------------------------------

struct Case {
  std::string name, words, over;    // `over`: the case that lacks just this
  int each = 1;                     // contacts or points that the time is divided by
  std::function<void()> run;        // a round
  std::vector<double> ns = {};      // of a round, in order of size once all have run

  double least() const { return ns.front() / each; }
};

// On the CPU the time of all threads, which others that use the machine do not add to.
double seconds(bool of_processor)
{
  if (of_processor) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void take_turns(std::vector<Case> &cases, int repeats, bool on_cpu)
{
  for (int r = -1; r < repeats; r++)    // the first round warms up
    for (Case &c : cases) {
      const double start = seconds(on_cpu);
      c.run();
      if (r >= 0) c.ns.push_back(1e9 * (seconds(on_cpu) - start));
    }
  for (Case &c : cases) std::sort(c.ns.begin(), c.ns.end());
}

// The least time less that of the case that lacks the effect, for each; 0 where there is none.
double cost_over(const std::vector<Case> &cases, const Case &c)
{
  for (const Case &other : cases)
    if (other.name == c.over) return c.least() - other.ns.front() / c.each;
  return 0;
}

// ---- effects --------------------------------------------------------------------------------------

constexpr Real kHalf = 50;

// Spheres that touch the floor, in the order of bins as LAMMPS sorts them.
struct Bed {
  explicit Bed(int n)
  {
    std::mt19937_64 random(11);
    std::uniform_real_distribution<Real> place(-0.98 * kHalf, 0.98 * kHalf), speed(-1, 1);
    std::vector<Vec3> at(n);
    for (Vec3 &p : at) p = {place(random), place(random), kRadius - kOverlap};
    const auto bin = [](const Vec3 &p) {
      return std::int64_t(p.y + kHalf) * 1000 + std::int64_t(p.x + kHalf);
    };
    std::sort(at.begin(), at.end(), [&](const Vec3 &a, const Vec3 &b) { return bin(a) < bin(b); });
    for (const Vec3 &p : at) {
      Vec3 v, omega;
      for (int k = 0; k < 3; k++) {
        v[k] = speed(random);
        omega[k] = speed(random);
      }
      arrays.add(p, kRadius, 1, v, omega);
    }
    arrays.temperature.assign(n, 300);
    arrays.heat_flow.assign(n, 0);
  }
  Spheres spheres() { return arrays.spheres(); }

  SphereArrays arrays;
};

// Fields are separated by semicolons: words and devices have commas in them.
void measure_effects(Device device, int n_spheres, int repeats, const char *commit)
{
  const std::vector<EffectCase> effects = effect_cases();
  GridSettings settings;
  settings.cutoff = kRadius;
  for (const EffectCase &c : effects)
    settings.cutoff = std::max(settings.cutoff, cutoff_of(c.settings.law(), kRadius));
  const FlatGrid flat(build_grid(weld(floor_mesh(100, kHalf), -1), settings));

  Bed bed(n_spheres);
  StepSettings step;
  step.dt = 1e-7;
  std::vector<std::unique_ptr<WallEngine>> engines;
  std::vector<Case> cases;
  for (const EffectCase &c : effects) {
    EngineSettings e = c.settings;
    e.device = device;
    engines.push_back(make_engine(e));
    WallEngine *engine = engines.back().get();
    engine->set_grid(flat.view());
    engine->choose(bed.spheres(), 0);
    cases.push_back({c.name, c.words, c.over, 1, [=, &bed] { engine->step(bed.spheres(), step); }});
  }
  take_turns(cases, repeats, engines[0]->backend().compare(0, 3, "CPU") == 0);
  for (std::size_t i = 0; i < cases.size(); i++)
    cases[i].each = static_cast<int>(engines[i]->results().totals().contacts);

  std::printf("name;words;over;contacts;repeats;median_ns;min_ns;max_ns;over_ns;bytes_per_atom;"
              "bytes_per_contact;engine_bytes;device;compiler;commit\n");
  for (std::size_t i = 0; i < cases.size(); i++) {
    const Case &c = cases[i];
    const EngineSettings &s = effects[i].settings;
    std::printf("%s;%s;%s;%d;%d;%.2f;%.2f;%.2f;%.2f;%d;%d;%zu;%s;%s;%s\n", c.name.c_str(),
                c.words.c_str(), c.over.c_str(), c.each, repeats, c.ns[c.ns.size() / 2] / c.each,
                c.least(), c.ns.back() / c.each, cost_over(cases, c), bytes_per_atom(s),
                bytes_per_contact(s), engines[i]->bytes(), engines[i]->backend().c_str(),
                compiler(), commit);
  }
}

// ---- bodies ---------------------------------------------------------------------------------------

constexpr Real kHalfOfBodies = 45, kHeavy = 1e30;

MeshSpec floor_at_0()
{
  MeshSpec mesh;
  mesh.name = "floor";
  mesh.mesh = std::make_shared<WeldedMesh>(weld(floor_mesh(100, kHalfOfBodies), -1));
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
  wall.laws.front().law = usual_law(normal, history);
  wall.device = Device::cpu;
  wall.meshes = std::move(meshes);
  return wall;
}

class BodyCases {
 public:
  // `only_more`: than without, because the rest of the step is not theirs.
  void add(const char *name, const char *words, const char *over, const WallSpec &spec, int spheres,
           int each, bool only_more = false)
  {
    hosts_.push_back(std::make_unique<FakeHost>());
    scenes_.push_back(std::make_unique<WallScene>(*hosts_.back(), spec, WallUnits(), 1e-7));
    WallScene *scene = scenes_.back().get();
    std::mt19937_64 random(11);
    std::uniform_real_distribution<Real> place(-0.98 * kHalfOfBodies, 0.98 * kHalfOfBodies);
    for (int i = 0; i < spheres; i++)
      scene->add({place(random), place(random), kRadius - kOverlap}, kRadius);
    scene->set_up();
    cases_.push_back({name, words, over, each * kStepsOfRound, [=] { scene->run(kStepsOfRound); }});
    only_more_.push_back(only_more);
  }
  void measure(int repeats, const char *commit)
  {
    take_turns(cases_, repeats, true);
    std::printf("name;words;over;each;repeats;min_ns;over_ns;saved_bytes;compiler;commit\n");
    for (std::size_t i = 0; i < cases_.size(); i++) {
      const Case &c = cases_[i];
      std::printf("%s;%s;%s;%d;%d;%.2f;%.2f;%zu;%s;%s\n", c.name.c_str(), c.words.c_str(),
                  c.over.c_str(), c.each / kStepsOfRound, repeats, only_more_[i] ? 0 : c.least(),
                  cost_over(cases_, c), saved_bytes(i), compiler(), commit);
    }
  }

 private:
  static constexpr int kStepsOfRound =
      100;    // one without spheres takes less than the clock tells

  // In a restart file for each body, or for each contact of a coat.
  std::size_t saved_bytes(std::size_t i) const
  {
    WallState state = scenes_[i]->wall->save();
    const std::size_t all = state.blocks().numbers().size();
    for (MeshState &m : state.meshes) {
      if (only_more_[i])
        m.coat.clear();
      else
        m.body = BodyState();
    }
    const std::size_t numbers = all - state.blocks().numbers().size();
    return numbers * sizeof(Real) / (only_more_[i] ? cases_[i].each / kStepsOfRound : 1);
  }

  std::vector<std::unique_ptr<FakeHost>> hosts_;
  std::vector<std::unique_ptr<WallScene>> scenes_;
  std::vector<Case> cases_;
  std::vector<bool> only_more_;
};

void measure_bodies(int spheres, int repeats, const char *commit)
{
  BodyCases cases;
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
  cases.measure(repeats, commit);
}

}    // namespace

int main(int argc, char **argv)
{
  const std::string what = argc > 1 ? argv[1] : "";
  const int spheres = argc == 5 ? std::atoi(argv[2]) : 0,
            repeats = argc == 5 ? std::atoi(argv[3]) : 0;
  if (spheres < 1 || repeats < 1 || (what != "cuda" && what != "cpu" && what != "bodies")) {
    std::fprintf(stderr, "usage: bench_effects cpu|cuda|bodies SPHERES REPEATS COMMIT\n");
    return 2;
  }
  try {
    if (what == "bodies")
      measure_bodies(spheres, repeats, argv[4]);
    else
      measure_effects(what == "cuda" ? Device::cuda : Device::cpu, spheres, repeats, argv[4]);
  } catch (const InputError &e) {
    std::fprintf(stderr, "bench_effects: %s\n", e.what());
    return 1;
  }
  return 0;
}
