// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The cost of every effect of a wall, of those that pairs of grains have, or of bodies and their coats: rows for doc/effects.md, as CSV.
//
// Spheres lie on a floor of 20 000 triangles, each with one contact. For effects a step is the engine's; on a GPU the spheres are in its
// memory, as those of LAMMPS with Kokkos are. For bodies a step is that of the whole wall, whose floor is at rest, moves, or is a body on
// a slider, so heavy that it stays; points of a coat are those of a heavy cube on a floor and above it. Cases take turns, so that what
// disturbs the machine disturbs all alike; the least of the times is nearest to the truth, since disturbances only add.
#include "bench.h"

#include "backend/cuda_available.h"
#include "base/input_error.h"
#include "effects/effects.h"
#include "grid/flat_grid.h"
#include "mesh/surface_points.h"
#include "pair/compile_pair.h"
#include "support/meshes.h"
#include "support/sphere_arrays.h"
#include "support/wall_scene.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstddef>
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
// So many steps of a round on a GPU that the wait at its end counts for nothing.
constexpr int kStepsInPlace = 100;

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

// Does the steps of a round for spheres on a GPU, with what a wall does there in each: it sums the forces on a body, and adds up loads,
// energy and impacts by triangle. No sphere and no contact comes to the CPU; of results only the sums of the energy balance do, for which
// the engine waits in each step. At the end the round waits for the GPU.
void steps_in_place(WallEngine &engine, const EngineSettings &settings, const Spheres &spheres,
                    StepSettings step, const FeatureCounts &counts)
{
  step.contacts = false;
  step.totals = settings.bodies;
  for (int k = 0; k < kStepsInPlace; k++) {
    engine.step(spheres, step);
    if (settings.contacts) engine.loads()->add(0, counts, step.dt);
    if (settings.energy_places || settings.impact_speed > 0)
      engine.energies()->add(0, counts, step.dt);
  }
  engine.read_diagnostics();
}

// Fields are separated by semicolons: words and devices have commas in them.
void measure_effects(Device device, int n_spheres, int repeats, const char *commit)
{
  const bool in_place = device == Device::cuda;
  std::string why;
  if (in_place && !cuda_available(&why)) throw InputError("device cuda: " + why);
  const std::vector<EffectCase> effects = effect_cases();
  StepGridSettings settings;
  settings.cutoff = kRadius;
  settings.for_gpu = in_place;
  for (const EffectCase &c : effects)
    settings.cutoff = std::max(settings.cutoff, cutoff_of(c.settings.law(), kRadius));
  const WeldedMesh mesh = weld(floor_mesh(100, kHalf), -1);
  const FeatureCounts counts = {mesh.faces.size(), mesh.edges.size(), mesh.vertices.size()};
  const FlatOf flat(build_grid(mesh, settings, in_place));

  Bed bed(n_spheres);
  SphereArraysOn there(in_place);
  const Spheres spheres = in_place ? there.put(bed.arrays) : bed.spheres();
  StepSettings step;
  step.dt = 1e-7;
  std::vector<std::unique_ptr<WallEngine>> engines;
  std::vector<Case> cases;
  for (const EffectCase &c : effects) {
    EngineSettings e = c.settings;
    e.device = device;
    engines.push_back(in_place ? make_cuda_engine_in_place(e, 0, nullptr) : make_engine(e));
    WallEngine *engine = engines.back().get();
    engine->set_grid(flat.view());
    engine->choose(spheres, 0);
    cases.push_back({c.name, c.words, c.over, 1, [=] {
                       if (in_place)
                         steps_in_place(*engine, e, spheres, step, counts);
                       else
                         engine->step(spheres, step);
                     }});
  }
  take_turns(cases, repeats, !in_place);
  const int steps = in_place ? kStepsInPlace : 1, digits = in_place ? 4 : 2;
  std::vector<int> contacts;
  for (std::size_t i = 0; i < cases.size(); i++) {
    contacts.push_back(static_cast<int>(engines[i]->results().totals().contacts));
    cases[i].each = contacts[i] * steps;
  }

  std::printf("name;words;over;contacts;repeats;median_ns;min_ns;max_ns;over_ns;bytes_per_atom;"
              "bytes_per_contact;engine_bytes;device;compiler;commit\n");
  for (std::size_t i = 0; i < cases.size(); i++) {
    const Case &c = cases[i];
    const EngineSettings &s = effects[i].settings;
    std::printf("%s;%s;%s;%d;%d;%.*f;%.*f;%.*f;%.*f;%d;%d;%zu;%s%s;%s;%s\n", c.name.c_str(),
                c.words.c_str(), c.over.c_str(), contacts[i], repeats, digits,
                c.ns[c.ns.size() / 2] / c.each, digits, c.least(), digits, c.ns.back() / c.each,
                digits, cost_over(cases, c), bytes_per_atom(s), bytes_per_contact(s),
                engines[i]->bytes(), engines[i]->backend().c_str(), in_place ? ", in place" : "",
                compiler(), commit);
  }
}

// ---- pairs ----------------------------------------------------------------------------------------

// Grains of a lattice, six contacts each but at its faces, whose list has each pair once.
struct PairBed {
  explicit PairBed(int side)
  {
    constexpr Real kSpacing = 2 * kRadius - kOverlap;
    std::mt19937_64 random(11);
    std::uniform_real_distribution<Real> speed(-1, 1);
    n = side * side * side;
    neighbours.resize(n);
    for (int i = 0; i < n; i++) {
      const int at[] = {i % side, i / side % side, i / side / side};
      for (int k = 0, step = 1; k < 3; k++, step *= side) {
        x.push_back(kSpacing * at[k]);
        v.push_back(speed(random));
        omega.push_back(speed(random));
        if (at[k] + 1 < side) neighbours[i].push_back(i + step);
      }
      contacts += static_cast<int>(neighbours[i].size());
      length.push_back(static_cast<int>(neighbours[i].size()));
      row.push_back(neighbours[i].data());
      grain.push_back(i);
    }
    radius.assign(n, kRadius);
    mass.assign(n, 1);
    type.assign(n, 1);
    temperature.assign(n, 300);
    heat.assign(n, 0);
    force.assign(x.size(), 0);
    torque.assign(x.size(), 0);
  }
  PairJob job()
  {
    PairJob job = {};
    job.x = x.data(), job.v = v.data(), job.omega = omega.data();
    job.radius = radius.data(), job.mass = mass.data(), job.type = type.data();
    job.force = force.data(), job.torque = torque.data();
    job.n_own = n;
    job.list = {n, grain.data(), length.data(), row.data(), 0x1FFFFFFF, 30};
    job.factor = factor;
    job.n_laws = 1;
    job.law_of = law_of;
    job.n_types = 2;
    job.dt = 1e-7;
    job.update = true;
    return job;
  }

  int n, contacts = 0;
  std::vector<Real> x, v, omega, radius, mass, temperature, heat, force, torque;
  std::vector<int> type, grain, length;
  std::vector<std::vector<int>> neighbours;
  std::vector<const int *> row;
  Real factor[4] = {1, 1, 1, 1};
  int law_of[4] = {0, 0, 0, 0};
};

// The pairs of one law, step after step.
class PairRun {
 public:
  PairRun(PairBed &bed, const ContactLaw &law) :
      bed_(bed), law_(pair_law(law)), heat_(law.has_heat()), keeps_(law.has_history()),
      books_(law.keeps_forces)
  {
    for (PairHistory &h : history_) h.begin(keeps_ ? 3 + law.n_extra() : 0);
  }
  void step()
  {
    PairJob job = bed_.job();
    job.laws = &law_;
    if (heat_) job.temperature = bed_.temperature.data(), job.heat = bed_.heat.data();
    if (keeps_) {
      now_ = 1 - now_;
      history_[now_].begin(history_[now_].width());
      job.old = &history_[1 - now_];
      job.history = &history_[now_];
    }
    if (books_) job.energy = &energy_;
    run_pairs(job);
  }
  std::size_t bytes() const
  {
    return keeps_ ? PairHistory::bytes_per_pair(history_[0].width()) : 0;
  }

 private:
  PairBed &bed_;
  PairLaw law_;
  bool heat_, keeps_, books_;
  EnergyRows energy_;
  PairHistory history_[2];
  int now_ = 0;
};

void measure_pairs(int n_grains, int repeats, const char *commit)
{
  PairBed bed(static_cast<int>(std::lround(std::cbrt(n_grains))));
  std::vector<std::unique_ptr<PairRun>> runs;
  std::vector<Case> cases;
  for (const EffectCase &c : effect_cases()) {
    if (!acts_on_pairs(c.settings)) continue;
    runs.push_back(std::make_unique<PairRun>(bed, c.settings.law()));
    PairRun *run = runs.back().get();
    cases.push_back({c.name, c.words, c.over, bed.contacts, [run] { run->step(); }});
  }
  take_turns(cases, repeats, true);
  std::printf("name;words;over;contacts;repeats;median_ns;min_ns;over_ns;bytes_per_pair;device;"
              "compiler;commit\n");
  for (std::size_t i = 0; i < cases.size(); i++) {
    const Case &c = cases[i];
    std::printf("%s;%s;%s;%d;%d;%.2f;%.2f;%.2f;%zu;CPU, 1 thread;%s;%s\n", c.name.c_str(),
                c.words.c_str(), c.over.c_str(), c.each, repeats, c.ns[c.ns.size() / 2] / c.each,
                c.least(), cost_over(cases, c), runs[i]->bytes(), compiler(), commit);
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
  if (spheres < 1 || repeats < 1 ||
      (what != "cuda" && what != "cpu" && what != "pairs" && what != "bodies")) {
    std::fprintf(stderr, "usage: bench_effects cpu|cuda|pairs|bodies SPHERES REPEATS COMMIT\n");
    return 2;
  }
  try {
    if (what == "bodies")
      measure_bodies(spheres, repeats, argv[4]);
    else if (what == "pairs")
      measure_pairs(spheres, repeats, argv[4]);
    else
      measure_effects(what == "cuda" ? Device::cuda : Device::cpu, spheres, repeats, argv[4]);
  } catch (const InputError &e) {
    std::fprintf(stderr, "bench_effects: %s\n", e.what());
    return 1;
  }
  return 0;
}
