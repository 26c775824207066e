// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Engines for particles in place, in other layouts and behind a mirror against the CPU's: one
// source, so the same bits. LSDCD_QUICK=1 tries a tenth of the spheres for other searches and
// for effects, the searches on small meshes alone.
#include "support/test_engine.h"
#include "backend/backend_cpu.h"
#include "contact/contact_history.h"
#include "effects/effects.h"
#include "engine/broad_phase/selection_cpu.h"
#include "engine/broad_phase/selection_gpu.h"
#include "engine/loads/sums_on.h"
#include "engine/on_backend/engine_on.h"
#include "engine/step/compile_law.h"
#include "grid/lookup/occupied_within.h"
#include "output/feature_rows.h"
#include "support/crowd.h"
#include "support/device.h"
#include "support/kept_springs.h"
#include "support/says.h"
#include "support/sphere_arrays.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <gtest/gtest.h>
#include <map>
#include <random>
#include <type_traits>

using namespace lsdcd;

namespace {

// A backend that keeps lists of spheres with several contacts, as a GPU does, and counts what crosses between host
// and device, and waiting.
struct CountingBackend : CpuBackend {
  static constexpr bool kOnCpu = false;
  static int &crossings()
  {
    static int n = 0;
    return n;
  }
  template <class T>
  void copy_in(const T *host, T *to, std::size_t n)
  {
    crossings()++;
    CpuBackend::copy_in(host, to, n);
  }
  template <class T>
  void copy_out(const T *from, T *host, std::size_t n)
  {
    crossings()++;
    CpuBackend::copy_out(from, host, n);
  }
  void wait() { crossings()++; }
  template <class T, class Read>
  T largest(std::size_t n, const Read &read)
  {
    crossings()++;
    return CpuBackend::largest<T>(n, read);
  }
  template <class T>
  T exclusive_scan(T *values, std::size_t n)
  {
    crossings()++;
    return CpuBackend::exclusive_scan(values, n);
  }
};

template <class Work>
void run_step(CountingBackend &, std::size_t n, const Work &work)
{
  work.begin();
  const WorkLists &lists = work.work_lists();
  typename Work::Memory memory;
  *lists.n_found_next = 0;
  if (!work.has_fast_path()) {
    for (std::size_t k = 0; k < n; k++) work.general_path(k, memory);
    return;
  }
  const auto run_general_path = [&](int k, bool leaves_lists) {
    if (work.needs_list(k)) {
      if (leaves_lists) {
        lists.found[(*lists.n_found)++] = k;
        return;
      }
      work.make_list(Warp<1>(), true, k);
    }
    if (!work.general_path(k, memory) || !lists.next) return;
    lists.next[(*lists.n_next)++] = k;
    lists.listed_in[k] = lists.step + 1;
  };
  const int n_last = lists.last ? *lists.n_last : 0;
  for (int s = 0; s < n_last; s++) run_general_path(lists.last[s], true);
  for (std::size_t k = 0; k < n; k++)
    if (!(lists.listed_in && lists.listed_in[k] >= lists.step) && !work.fast_path(k))
      lists.found[(*lists.n_found)++] = static_cast<int>(k);
  if (lists.last) *lists.n_last = 0;
  for (int s = 0; s < *lists.n_found; s++) run_general_path(lists.found[s], false);
}

}    // namespace

template <>
class lsdcd::Selection<CountingBackend> : public Selection<CpuBackend> {
 public:
  template <class Work>
  void run(CountingBackend &b, std::size_t n, const Work &work, int *to, std::uint32_t *total)
  {
    CountingBackend::crossings()++;
    Selection<CpuBackend>::run(b, n, work, to, total);
  }
};

namespace {

using CountingLaw = CompiledLaw<CountingBackend>;

// JKR's is the only granular law that is compiled.
struct MakeCountingLaw {
  WallEffects effects;

  template <class Law>
  CountingLaw operator()(const Law &law) const
  {
    if constexpr (!Law::kHeat || Law::kBeyondContact)
      return on_wall<WallKernels::plain_or_both, true>(law, effects, [](const auto &compiled) {
        using L = std::decay_t<decltype(compiled)>;
        return CountingLaw{
            traits_of(compiled), {LawBytes(compiled)}, run_compiled_law<L, CountingBackend>};
      });
    else
      throw std::logic_error("not compiled for this test");
  }
};

CountingLaw counting_law(const EngineSettings &s)
{
  const MakeCountingLaw make = {wall_effects(s)};
  if (s.law().is_classic()) return with_classic_law(s.law(), make);
  return with_granular_law(s.law(), make);
}

std::unique_ptr<WallEngine> by_two_kernels(const EngineSettings &s)
{
  return std::make_unique<EngineOn<CountingBackend>>(s, counting_law(s), CountingBackend());
}

ContactLaw history()
{
  return classic(NormalModel::hertz, true);
}

int effect_spheres()
{
  return std::getenv("LSDCD_QUICK") ? 200 : 2000;
}

TEST(engine, gives_what_every_effect_gives_on_the_host)
{
  std::vector<Case> walls = cases();
  walls.erase(walls.begin() + 2);    // the largest one tells no more and takes the longest
  // Wall by wall, so that each grid is made once.
  for (std::size_t w = 0; w < walls.size(); w++)
    for (const EffectCase &effect : effect_cases()) {
      if (effect.name.size() % walls.size() != w) continue;
      const Case &c = walls[w];
      const EngineSettings &s = effect.settings;
      const Outcome cpu = run_steps(c, s.law(), on_cpu, effect_spheres(), kComplete, s);
      expect_same(cpu, run_steps(c, s.law(), in_place, effect_spheres(), kComplete, s),
                  effect.name);
      expect_same(cpu, run_steps(c, s.law(), with_mirror, effect_spheres(), kComplete, s),
                  effect.name);
    }
}

TEST(engine, gives_what_the_host_gives_however_it_searches)
{
  const bool quick = std::getenv("LSDCD_QUICK") != nullptr;
  const int spheres = quick ? 200 : 2000;
  std::vector<Case> walls = cases();
  if (quick) walls.erase(walls.begin() + 1, walls.begin() + 4);    // grids that take long
  for (const Case &c : walls)
    for (const Search &search : other_searches()) {
      const std::string name = std::string(c.name) + ", " + search.name;
      const Outcome cpu = run_steps(c, history(), on_cpu, spheres, search);
      expect_same(cpu, run_steps(c, history(), in_place, spheres, search), name);
      expect_same(cpu, run_steps(c, history(), by_two_kernels, spheres, search), name);
    }
}

TEST(engine, drops_no_contact_of_crowded_spheres)
{
  for (int n : {9, 40, 100, 400}) {
    EngineSettings s;
    s.law() = history();
    s.corner = Corner::sum;
    const auto outcome = [&](const EngineMaker &make) {
      Scene scene(faces_all_round(n), 1.1, s);
      scene.use(make(s));
      const int spheres = 50;
      for (int i = 0; i < 3 * spheres; i += 3) {
        const auto off = [](int k) { return 1e-3 * std::sin(7.0 * k); };
        scene.add_sphere({off(i), off(i + 1), off(i + 2)}, 1.05, 1, {0.1, 0.1, 0.1},
                         {0.2, 0.2, 0.2});
      }
      std::vector<Vec3> force;
      for (int k = 0; k < 2; k++) {
        scene.compute(1e-3);
        for (int i = 0; i < spheres; i++) force.push_back(scene.force(i));
      }
      EXPECT_EQ(scene.springs.count(spheres - 1), n);
      EXPECT_EQ(scene.engine->results().totals().contacts, n * spheres);
      return force;
    };
    EXPECT_TRUE(same_bytes(outcome(on_cpu), outcome(in_place))) << n;
  }
}

// An engine with particles of its own, in its memory.
class Particles {
 public:
  Particles(const EngineSettings &settings, int n, Real cutoff, bool cuda = test_on_cuda()) :
      host(n, 0), there_(cuda)
  {
    engine = cuda ? make_cuda_engine_in_place(settings, 0, nullptr) : make_cpu_engine(settings);
    const WeldedMesh mesh = weld(floor_mesh(60, 10, 7), -1);    // of more than a CPU keeps near
    StepGridSettings g;
    g.cutoff = cutoff;
    grid = build_grid(mesh, g);
    flat = FlatOf(grid);
    engine->set_grid(flat.view());
    engine->springs().grow(n);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<Real> at(-9, 9), up(0, 4 * cutoff), speed(-1, 1), unit(0.3, 1);
    for (int i = 0; i < n; i++) {
      const Real x = at(random), y = at(random), z = up(random);
      put_vector(host.x, i, {x, y, z});
      for (int k = 0; k < 3; k++) host.v[3 * i + k] = speed(random);
      host.radius[i] = cutoff * unit(random);
    }
  }

  // One step of all spheres along their velocities, then the wall's forces on those near
  // it, or on those of an older choice.
  enum class Candidates { older, now };
  void step(Real dt, Candidates choice = Candidates::older)
  {
    host.move(dt);
    if (choice == Candidates::now) engine->choose(spheres(), 0);
    StepSettings step;
    step.number = number++;
    step.dt = dt;
    engine->step(spheres(), step);
  }
  std::int64_t number = 1000;    // of the next step

  Spheres spheres() { return there_.put(host); }

  void set_force(const std::vector<Real> &to) { there_.put_force(to); }
  std::vector<Real> force() { return there_.force(host.n()); }
  std::vector<Real> torque() { return there_.torque(host.n()); }
  ContactHistory springs()
  {
    ContactHistory store;
    engine->springs().to_cpu(store, host.n());
    return store;
  }

  std::unique_ptr<WallEngine> engine;
  StepGrid grid;
  FlatOf<StepGrid> flat;
  SphereArrays host;

 private:
  SphereArraysOn there_;
};

EngineSettings with_history()
{
  EngineSettings s;
  s.law() = history();
  return s;
}

bool same_springs(const ContactHistory &a, int i, const ContactHistory &b, int j)
{
  return same_bytes(springs_of(a, i), springs_of(b, j));
}

// `now`: to what the host has put there by submit(), and not by collect().
TEST(engine, adds_forces_found_beside_to_what_the_host_has_put_there)
{
  const int n = 3000;
  const Real of_host = 3;
  Particles beside(with_history(), n, 0.5), after(with_history(), n, 0.5);
  for (const bool now : {false, true, false}) {
    const Spheres a = beside.spheres(), b = after.spheres();
    const std::vector<Real> others(3 * n, of_host);
    beside.engine->begin(now ? When::beside_adding_early : When::beside);
    if (now) beside.set_force(others);
    beside.engine->choose(a, 0);
    beside.engine->submit(a, StepSettings());
    if (!now) beside.set_force(others);
    beside.engine->collect();
    after.engine->choose(b, 0);
    after.set_force(others);
    after.engine->step(b, StepSettings());
    EXPECT_TRUE(same_bytes(beside.force(), after.force()));
    EXPECT_TRUE(same_bytes(beside.torque(), after.torque()));
    EXPECT_NE(beside.force(), others);
  }
}

TEST(engine, a_list_that_is_kept_gives_the_same_bits)
{
  const int n = 3000;
  Particles kept(with_history(), n, 0.5), anew(with_history(), n, 0.5);
  // 20 steps of 0.01 at up to sqrt(3): 0.35.
  kept.engine->choose(kept.spheres(), 0.36);
  bool differs = false;
  for (int k = 0; k < 20; k++) {
    kept.step(0.01);
    anew.step(0.01, Particles::Candidates::now);
    differs = differs || !same_bytes(kept.force(), anew.force());
  }
  EXPECT_FALSE(differs);
  const ContactHistory a = kept.springs(), b = anew.springs();
  int with = 0, same = 0;
  for (int i = 0; i < n; i++) {
    with += a.count(i) > 0;
    same += same_springs(a, i, b, i);
  }
  EXPECT_EQ(same, n);
  EXPECT_GT(with, 100);
  EXPECT_GT(kept.engine->n_candidates(), anew.engine->n_candidates());
}

TEST(engine, a_way_within_the_margin_ends_near_only_where_it_was_seen_before)
{
  Particles p(with_history(), 1, 0.5);
  const GridView grid = p.flat.view();
  const std::vector<BrickWord> words = brick_words(grid);
  const BrickTable table(words, words.data());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> across(-12, 12), up(-3, 3), unit(-1, 1), margins(0, 1.5);
  int near = 0, missed = 0, far = 0;
  for (int k = 0; k < 200000; k++) {
    const Vec3 q = {across(random), across(random), up(random)};
    CellAddress at;
    Cell cell;
    Vec3 way = {unit(random), unit(random), unit(random)};
    const Real margin = margins(random);
    way = (margin * std::fabs(unit(random)) / norm(way)) * way;
    if (find_cell(grid, q + way, at, cell)) {
      near++;
      missed += !occupied_within(grid, table, q, margin);
    } else
      far += !occupied_within(grid, table, q, margin);
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);    // it is not near everywhere
}

TEST(engine, the_bricks_of_a_choice_with_a_margin_leave_out_none_that_its_cells_keep)
{
  StepGridSettings g;
  g.cutoff = 0.5;
  g.length = 0.2;
  const FlatOf<StepGrid> flat(build_grid(weld(box_mesh({-10, -10, -10}, {10, 10, 10}), -1), g));
  const GridView grid = flat.view();
  const std::vector<BrickWord> words = brick_words(grid);
  CandidateTest<true, false> choice = {};
  choice.grid = grid;
  choice.table = BrickTable(words, words.data());
  choice.filter = BrickFilter<Real>(grid);
  std::mt19937_64 random(4);
  std::uniform_real_distribution<Real> at(-12, 12), margins(1e-9, 0.9);
  int kept = 0, missed = 0, left_out = 0;
  for (int k = 0; k < 300000; k++) {
    const Vec3 q = {at(random), at(random), at(random)};
    choice.past = margins(random);
    choice.fixed_margin = choice.filter.margin(choice.past * grid.inv_length / kBrickSide);
    const bool may = choice.coarse_test({0.5, 0}, q);
    const bool keeps = choice.is_near(q);
    kept += keeps;
    missed += keeps && !may;
    left_out += !may;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(kept, 1000);
  EXPECT_GT(left_out, 1000);    // bricks save something
}

// What a GPU runs, on a CPU: of spheres in a box and past it, in a group or not, with each way of testing them.
TEST(engine, a_selection_by_flags_leaves_the_spheres_that_one_by_blocks_leaves)
{
  StepGridSettings g;
  g.cutoff = 0.5;
  g.length = 0.2;
  const FlatOf<StepGrid> flat(build_grid(weld(box_mesh({-3, -3, -3}, {3, 3, 3}), -1), g));
  CpuBackend b;
  const GridOn<CpuBackend> grid(b, flat.view());
  const int n = 20000;
  std::mt19937_64 random(12);
  std::uniform_real_distribution<Real> at(-4, 4);
  std::vector<Real> x(3 * n), radius(n);
  std::vector<int> mask(n);
  for (Real &u : x) u = at(random);
  for (int i = 0; i < n; i++) radius[i] = 0.1 + 0.02 * (i % 20), mask[i] = i % 7 == 0 ? 1 : 2;
  Spheres spheres;
  spheres.n = n;
  spheres.x = x.data();
  spheres.radius = radius.data();
  spheres.mask = mask.data();
  spheres.group_bit = 2;
  // Each had a contact in the last step, a third of them with this mesh.
  std::vector<int> first(n);
  std::vector<Spring> pool(n);
  for (int i = 0; i < n; i++) first[i] = i, pool[i].mesh = i % 3;
  const auto check = [&](bool by_features, auto closes) {
    StepCounts counts = {};
    std::vector<int> springs[2] = {std::vector<int>(n, 1), std::vector<int>(n, 1)}, left[2];
    const auto choice = [&](int k) {
      return CandidateTest<false, closes()>{
          grid.view,
          grid.table,
          BrickFilter<Real>(grid.view),
          spheres,
          Pose(),
          0.05,
          0,
          LawReach(),
          by_features,
          &counts,
          springs[k].data(),
          {{first.data()}, {springs[k].data()}, pool.data(), nullptr},
          0};
    };
    std::uint32_t total[2] = {0, 0};
    for (std::vector<int> &to : left) to.resize(n);
    Selection<CpuBackend, true>().run(b, n, choice(0), left[0].data(), &total[0]);
    Selection<CpuBackend, false>().run(b, n, choice(1), left[1].data(), &total[1]);
    for (int k = 0; k < 2; k++) left[k].resize(total[k]);
    EXPECT_EQ(left[1], left[0]);
    EXPECT_EQ(springs[1], springs[0]);
    EXPECT_GT(total[0], 1000u);
    EXPECT_LT(total[0], closes() ? 13000u : 10000u);
    EXPECT_EQ(counts.too_large, 0u);
    for (int i = 0; i < n; i++) {
      const bool is_left = std::binary_search(left[0].begin(), left[0].end(), i);
      ASSERT_EQ(springs[0][i] != 0, is_left);
      if (closes() && i % 3 == 0) {
        ASSERT_EQ(is_left, mask[i] == 2) << i;
      }
    }
  };
  for (const bool by_features : {false, true}) {
    check(by_features, std::false_type());
    check(by_features, std::true_type());
  }
}

// Spheres walk from far away to the wall, each step shorter than the margin, so that a look that compares them with a
// place too near to the wall lets one through. The margin is more than a cell, and spheres are few, so that no other
// one is at the wall before.
TEST(engine, a_choice_holds_while_spheres_walk_to_the_wall)
{
  const int n = 20, n_steps = 1000;
  const Real margin = 0.9;
  Particles kept(with_history(), n, 0.5), anew(with_history(), n, 0.5);
  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> start(1, 8), way(-0.05, 0.03);
  for (int i = 0; i < n; i++) kept.host.x[3 * i + 2] = anew.host.x[3 * i + 2] = start(random);
  kept.engine->choose(kept.spheres(), margin, true);
  int held = 0, same = 0, touching = 0;
  for (int k = 0; k < n_steps; k++) {
    for (int i = 0; i < n; i++) {
      Real &z = kept.host.x[3 * i + 2];
      z = std::max(Real(0.3), z + way(random));
      anew.host.x[3 * i + 2] = z;
    }
    const bool moved = kept.engine->has_moved(kept.spheres());
    if (moved) kept.engine->choose(kept.spheres(), margin, true);
    held += !moved;
    kept.step(0);
    anew.step(0, Particles::Candidates::now);
    const std::vector<Real> force = kept.force();
    same += same_bytes(force, anew.force());
    for (int i = 0; i < n; i++) touching += force[3 * i + 2] != 0;
  }
  EXPECT_EQ(same, n_steps);
  EXPECT_GT(held, n_steps / 2);
  EXPECT_GT(touching, n_steps);
}

TEST(engine, springs_follow_through_pack_and_unpack)
{
  const int n = 2000, stay = 1500;
  Particles from(with_history(), n, 0.5), to(with_history(), n, 0.5);
  for (int k = 0; k < 5; k++) {
    from.step(0.01, Particles::Candidates::now);
  }
  const ContactHistory before = from.springs();
  // The last 500 fill the places of every third of the first 1500, which leave.
  std::vector<int> which, copies, back;
  for (int i = 0; i < stay; i += 3) {
    which.push_back(i);
    copies.push_back(n - 1 - i / 3);
    back.push_back(i % 2 == 0 ? 10 + i : -1);    // every other one arrives
  }
  const int moved = static_cast<int>(which.size());
  const bool cuda = test_on_cuda();
  DeviceArray<int> d_which(cuda), d_copies(cuda), d_back(cuda);
  DeviceArray<double> buffer(cuda);
  buffer.resize(moved * (1 + from.engine->springs().largest_packed_size(n)));
  const int size =
      from.engine->springs().pack(moved, d_which.put(which), d_copies.put(copies), buffer.data());
  EXPECT_LE(size, moved * (1 + from.engine->springs().largest_packed_size(n)));

  const ContactHistory left = from.springs();
  int same = 0, carried = 0;
  for (int k = 0; k < moved; k++) same += same_springs(left, which[k], before, copies[k]);
  EXPECT_EQ(same, moved);
  for (int i = 1; i < stay; i += 3) EXPECT_TRUE(same_springs(left, i, before, i));

  // Another message behind the first, as from a second neighbour, of spheres that stay.
  std::vector<int> others, stays(moved, -1), places = back;
  for (int k = 0; k < moved; k++) {
    others.push_back(which[k] + 1);
    places.push_back(back[k] < 0 ? -1 : back[k] + 1);
  }
  std::vector<double> both = buffer.get(size);
  const int second =
      from.engine->springs().pack(moved, d_which.put(others), d_copies.put(stays), buffer.data());
  const std::vector<double> behind = buffer.get(second);
  both.insert(both.end(), behind.begin(), behind.end());
  DeviceArray<double> d_both(cuda);
  d_both.put(both);
  to.step(0.01, Particles::Candidates::now);
  const ContactHistory own = to.springs();
  to.engine->springs().unpack(2 * moved, d_back.put(places), d_both.data(), moved, size);
  const ContactHistory after = to.springs();
  int arrived = 0;
  for (int k = 0; k < moved; k++) {
    if (back[k] < 0) continue;
    arrived++;
    carried += before.count(which[k]) > 0;
    EXPECT_TRUE(same_springs(after, back[k], before, which[k]));
    EXPECT_TRUE(same_springs(after, back[k] + 1, before, others[k]));
  }
  EXPECT_GT(arrived, 200);
  EXPECT_GT(carried, 20);
  EXPECT_TRUE(same_springs(after, n - 1, own, n - 1));
}

TEST(engine, a_step_without_outputs_neither_copies_nor_waits)
{
  using Law = OnWall<HertzHistoryLaw, false, false>;
  const ContactLaw p = history();
  const Law law = {{{p.k_normal}, {p.eta}, {p.k_tangent, p.gamma_tangent, p.mu}, false}, {}, {}};
  Particles particles(with_history(), 2000, 0.5, false);
  particles.engine = std::make_unique<EngineOn<CountingBackend>>(
      with_history(),
      CompiledLaw<CountingBackend>{
          traits_of(law), {LawBytes(law)}, run_compiled_law<Law, CountingBackend>},
      CountingBackend());
  particles.engine->set_grid(particles.flat.view());
  particles.engine->springs().grow(2000);
  particles.engine->choose(particles.spheres(), 0.5);
  EXPECT_GT(CountingBackend::crossings(), 0);
  const auto crossings_of = [&](bool per_sphere) {
    const int before = CountingBackend::crossings();
    StepSettings step;
    step.dt = 0.01;
    step.per_sphere = per_sphere;
    particles.engine->step(particles.spheres(), step);
    return CountingBackend::crossings() - before;
  };
  for (int k = 0; k < 5; k++) EXPECT_EQ(crossings_of(false), 0);
  EXPECT_GT(crossings_of(true), 0);
  EXPECT_GT(particles.engine->results().totals().contacts, 100);
}

// Against sums over the contacts of each step, in double. Units are at most 2^-48 of twice the largest number of a step with fewer than 2^13
// contacts, and its sums are rounded once more: less than 2^-46 of it for each contact.
TEST(engine, adds_up_the_loads_of_features_without_copying_contacts)
{
  EngineSettings s = with_history();
  s.contacts = true;
  s.wear = WearModel::archard;
  const int n = 3000, n_steps = 6;
  Particles in_place(s, n, 0.5, false), host(s, n, 0.5, false);
  TriangleSoup bumps = floor_mesh(60, 10, 7);
  for (Vec3 &c : bumps.corners) c.z = 0.3 * std::sin(3 * c.x) * std::cos(3 * c.y);
  const WeldedMesh mesh = weld(bumps, -1);
  StepGridSettings g;
  g.cutoff = 0.5;
  const StepGrid grid = build_grid(mesh, g);
  const FlatOf flat(grid);
  in_place.engine = by_two_kernels(s);
  in_place.engine->springs().grow(n);
  for (Particles *p : {&in_place, &host}) p->engine->set_grid(flat.view());
  const FeatureCounts counts = {mesh.faces.size(), mesh.edges.size(), mesh.vertices.size()};
  for (const int takes : {0, 1}) {
    FeatureRows<Load> oracle, added;
    Real largest[8] = {};
    std::size_t most = 0;
    for (int k = 0; k < n_steps; k++) {
      host.step(0.01, Particles::Candidates::now);
      const std::vector<StepContact> contacts = host.engine->results().contacts();
      most = std::max(most, contacts.size());
      oracle.add(contacts.data(), static_cast<int>(contacts.size()), LoadOf{0.01, 1});
      for (const StepContact &c : contacts) {
        const Real numbers[] = {c.normal,  c.shear,   1,        c.wear_power,
                                c.force.x, c.force.y, c.force.z};
        for (int j = 0; j < 7; j++)
          largest[1 + j] = std::max(largest[1 + j], 0.01 * std::fabs(numbers[j]));
      }
      in_place.host.move(0.01);
      in_place.engine->choose(in_place.spheres(), 0);
      StepSettings step;
      step.dt = 0.01;
      step.contacts = false;
      const int before = CountingBackend::crossings();
      in_place.engine->step(in_place.spheres(), step);
      in_place.engine->loads()->add(0, counts, 0.01);
      if (k > 0) {    // the first one makes room
        EXPECT_EQ(CountingBackend::crossings(), before);
      }
      EXPECT_TRUE(in_place.engine->results().contacts().empty());
    }
    for (const RowOfFeature<Load> &of : in_place.engine->loads()->take(0))
      added.add(of.feature, of.row);
    const std::vector<Real> rows = added.packed(), wanted = oracle.packed();
    ASSERT_EQ(rows.size(), wanted.size());
    EXPECT_GT(rows.size(), 8 * 100u) << takes;
    EXPECT_LT(most, 1u << 13);
    int of_kind[3] = {};
    for (std::size_t at = 0; at < rows.size(); at += 8)
      of_kind[static_cast<int>(feature_kind(static_cast<FeatureCode>(rows[at])))]++;
    for (const int of : of_kind) EXPECT_GT(of, 5);    // faces, edges, vertices
    for (std::size_t at = 0; at < rows.size(); at += 8) {
      EXPECT_EQ(rows[at], wanted[at]);
      const Real n_contacts = std::round(wanted[at + 3] / 0.01);
      for (int j = 1; j < 8; j++)
        EXPECT_NEAR(rows[at + j], wanted[at + j], n_contacts * largest[j] * std::ldexp(1, -46));
    }
  }
  EXPECT_TRUE(in_place.engine->loads()->take(0).empty());
}

// Numbers are multiples of 1/8, of which sums are exact. Records are in any order, and some are of another mesh.
TEST(engine, adds_up_the_energies_of_features_and_keeps_their_greatest_speed)
{
  const std::size_t n_faces = 20, n_edges = 30, n_vertices = 12, n_places = 62;
  CpuBackend b;
  FeatureSums<CpuBackend, PlaceEnergy> sums;
  std::vector<ImpactBin> bins(kImpactBins);
  const std::vector<Real> begins = begins_of_bins();
  std::mt19937_64 random(5);
  const auto below = [&](std::size_t n) { return static_cast<std::uint32_t>(random() % n); };
  for (int takes = 0; takes < 2; takes++) {
    std::map<FeatureCode, std::array<Real, 4>> exact;
    std::int64_t impacts = 0;
    for (int step = 0; step < 5; step++) {
      std::vector<EnergyRecord> records(400);
      for (EnergyRecord &r : records) {
        const std::pair<FeatureKind, std::size_t> kinds[] = {{FeatureKind::face, n_faces},
                                                             {FeatureKind::edge, n_edges},
                                                             {FeatureKind::vertex, n_vertices - 4}};
        const auto [kind, n] = kinds[below(3)];
        r = {feature_code(kind, below(n)), below(2), below(800) / 8.0, 0, 0};
        if (below(3) > 0) continue;
        r.speed = (1 + below(80)) / 8.0;
        r.impact = 2 * r.speed * r.speed;
      }
      const int n_records = 300;    // the rest is of steps before
      for (int k = 0; k < n_records; k++) {
        const EnergyRecord &r = records[k];
        if (r.mesh != 1) continue;
        std::array<Real, 4> &to = exact[r.feature];
        to[0] += r.dissipated;
        to[1] += r.speed > 0;
        to[2] += r.impact;
        to[3] = std::max(to[3], r.speed);
        impacts += r.speed > 0;
      }
      const EnergyItems items = {
          records.data(), records.size(), &n_records, 1, {bins.data(), begins.data()}, {}};
      sums.add(b, items, {{}, n_faces, n_edges}, n_places);
    }
    const std::vector<RowOfFeature<PlaceEnergy>> rows = sums.take(b);
    ASSERT_EQ(rows.size(), exact.size());
    EXPECT_GT(rows.size(), 50u);
    auto wanted = exact.begin();
    for (const RowOfFeature<PlaceEnergy> &of : rows) {
      const PlaceEnergy &row = of.row;
      EXPECT_EQ(of.feature, wanted->first);
      EXPECT_EQ(
          (std::array<Real, 4>{row.dissipated, row.impacts, row.impact_energy, row.impact_speed}),
          wanted->second);
      ++wanted;
    }
    std::int64_t in_bins = 0;
    for (const ImpactBin &bin : bins) in_bins += bin.count;
    EXPECT_EQ(in_bins, impacts);
    for (ImpactBin &bin : bins) bin = {};
  }
  EXPECT_TRUE(sums.take(b).empty());
}

TEST(engine, outputs_of_the_step_that_asks_for_them_are_those_of_always_asking)
{
  const int n = 3000;
  Particles once(with_history(), n, 0.5), always(with_history(), n, 0.5);
  const auto outputs = [](Particles &p, bool asks) {
    StepSettings step;
    step.dt = 0.01;
    step.per_sphere = asks;
    p.engine->step(p.spheres(), step);
    return p.engine->results().touching();
  };
  for (Particles *p : {&once, &always}) p->engine->choose(p->spheres(), 0);
  for (bool asks : {false, true, false}) {
    const std::vector<TouchingSphere> a = outputs(once, asks), b = outputs(always, true);
    EXPECT_GT(b.size(), 100u);
    EXPECT_EQ(a.empty(), !asks);
    EXPECT_TRUE(!asks || same_bytes(a, b));
    EXPECT_EQ(once.engine->results().totals().energy, always.engine->results().totals().energy);
  }
}

TEST(engine, springs_that_are_taken_over_are_all_that_there_are)
{
  const int n = 2000, few = 10;
  Particles p(with_history(), n, 0.5);
  for (int k = 0; k < 5; k++) p.step(0.01, Particles::Candidates::now);
  const ContactHistory before = p.springs();
  ContactHistory store;
  store.grow(few);
  p.engine->springs().from_cpu(store, few);
  const ContactHistory after = p.springs();
  int had = 0, have = 0;
  for (int i = few; i < n; i++) {
    had += before.count(i);
    have += after.count(i);
  }
  EXPECT_GT(had, 100);
  EXPECT_EQ(have, 0);
}

TEST(engine, a_sphere_that_was_far_has_no_spring_of_before)
{
  Particles p(with_history(), 1, 0.5);
  p.host.x = {0.3, 0.1, 0.45};
  p.host.v = {1, 0, 0};
  p.host.radius = {0.5};
  for (int k = 0; k < 3; k++) p.step(0.01, Particles::Candidates::now);
  const Real three = p.springs().spring(0, 0).shear.x;
  p.host.x[2] += 10;
  p.step(0.01, Particles::Candidates::now);
  EXPECT_EQ(p.springs().count(0), 0);
  p.host.x[2] -= 10;
  p.step(0.01, Particles::Candidates::now);
  ASSERT_EQ(p.springs().count(0), 1);
  EXPECT_NEAR(p.springs().spring(0, 0).shear.x, three / 3, 1e-15);
}

TEST(engine, a_sphere_larger_than_the_reach_is_an_error)
{
  Particles p(with_history(), 100, 0.5);
  p.host.radius[7] = 0.6;
  p.host.radius[70] = 0.7;
  EXPECT_TRUE(fails_with("sphere 7 has radius 0.6", [&] { p.engine->choose(p.spheres(), 0); }));
}

TEST(engine, a_sphere_that_is_pulled_from_past_the_reach_is_named)
{
  int tried = 0;
  for (const EffectCase &effect : effect_cases()) {
    const LawReach reach = effect.settings.law().reach();
    const Real cutoff = 0.5;
    if (!reach.acts()) continue;
    tried++;
    Particles p(effect.settings, 100, cutoff);
    // The radius from which a sphere is pulled from farther than the cutoff, by bisection.
    Real fits = 0, too_large = cutoff;
    while (too_large - fits > 1e-12) {
      const Real middle = (fits + too_large) / 2;
      (cutoff_of(middle, reach) <= cutoff ? fits : too_large) = middle;
    }
    ASSERT_GT(fits, 0.1) << effect.name;
    for (Real &radius : p.host.radius) radius = fits * (1 - 1e-9);
    EXPECT_NO_THROW(p.engine->choose(p.spheres(), 0)) << effect.name;
    p.host.radius[7] = too_large * (1 + 1e-9);
    EXPECT_TRUE(fails_with("sphere 7 has radius", [&] { p.engine->choose(p.spheres(), 0); }))
        << effect.name;
  }
  EXPECT_GT(tried, 0);
}

TEST(engine, a_sphere_that_grows_past_the_reach_is_an_error_at_the_next_look)
{
  Particles p(with_history(), 100, 0.5);
  for (int i = 0; i < 100; i++) p.host.x[3 * i + 2] = 0.1;
  p.engine->choose(p.spheres(), 0);
  p.step(0);
  EXPECT_NO_THROW(p.engine->read_diagnostics());
  p.host.radius[7] = 0.6;
  p.step(0);
  EXPECT_THROW(p.engine->read_diagnostics(), std::exception);
}

TEST(engine, notes_the_deepest_overlap_of_all_steps_since_the_last_look)
{
  Particles p(with_history(), 3, 0.5);
  p.host.x = {0.3, 0.1, 0.45, 4, 4, 0.3, -4, 3, 3};
  p.host.v.assign(9, 0);
  p.host.radius = {0.5, 0.4, 0.5};
  p.engine->choose(p.spheres(), 0.5);
  p.step(1);    // 10 % and 25 %
  p.host.x[5] = 0.39;
  p.step(1);
  const StepDiagnostics diagnostics = p.engine->read_diagnostics();
  EXPECT_NEAR(diagnostics.deepest, 0.25, 1e-7);    // it is kept in single precision
  EXPECT_EQ(diagnostics.deepest_sphere, 1);
  EXPECT_EQ(diagnostics.deepest_meshes, 1U);
  EXPECT_EQ(diagnostics.deepest_step, 1000);
  p.step(1);
  p.step(1);
  p.host.x[5] = 0.2;
  p.step(1);
  const StepDiagnostics later = p.engine->read_diagnostics();
  EXPECT_NEAR(later.deepest, 0.5, 1e-7);
  EXPECT_EQ(later.deepest_step, 1004);
  EXPECT_EQ(p.engine->read_diagnostics().deepest_meshes, 0U);
}

// Lists of other purposes are read by other rules than those of steps: each grid goes where it serves, and nowhere else.
template <class View>
constexpr bool kIsForSteps =
    std::is_invocable_v<decltype(&WallEngine::set_grid), WallEngine &, View, int>;
static_assert(kIsForSteps<ViewOf<StepGrid>> && !kIsForSteps<ViewOf<QueryGrid>>);
static_assert(!kIsForSteps<ViewOf<BodyGrid>> && !kIsForSteps<GridView>);
static_assert(!std::is_constructible_v<FlatOf<StepGrid>, QueryGrid>);
static_assert(!std::is_convertible_v<QueryGrid, StepGrid> &&
              !std::is_convertible_v<StepGrid, QueryGrid>);
static_assert(!std::is_convertible_v<StepGrid, BodyGrid> &&
              !std::is_convertible_v<TriangleGrid, StepGrid>);

// `n` spheres of one radius over another wall.
struct OverWall : Particles {
  OverWall(const EngineSettings &settings, int n, const TriangleSoup &soup, Real radius) :
      Particles(settings, n, radius), wall(grid_of(soup, radius))
  {
    engine->set_grid(wall.view());
    host.v.assign(3 * n, 0);
    host.radius.assign(n, radius);
  }
  static StepGrid grid_of(const TriangleSoup &soup, Real radius)
  {
    StepGridSettings g;
    g.cutoff = radius;
    return build_grid(weld(soup, -1), g);
  }
  FlatOf<StepGrid> wall;
};

// As many as fill a corner between one choice and the next, from no contact to three each.
TEST(engine, has_room_for_springs_of_spheres_that_all_come_into_a_corner)
{
  const int n = 200000;
  OverWall p(with_history(), n, box_mesh({0, 0, 0}, {10, 10, 10}), 0.5);
  p.host.x.assign(3 * n, 0.51);
  p.engine->choose(p.spheres(), 0.1);
  p.step(0);
  EXPECT_EQ(p.engine->results().totals().contacts, 0);
  p.host.x.assign(3 * n, 0.49);
  p.step(0);
  EXPECT_NO_THROW(p.engine->read_diagnostics());
  EXPECT_EQ(p.engine->results().totals().contacts, 3 * n);
}

// Its old springs are in the pool that the step has left.
TEST(engine, a_sphere_with_more_contacts_than_there_is_room_for_is_an_error_and_has_no_springs)
{
  EngineSettings s = with_history();
  s.corner = Corner::sum;
  OverWall p(s, 1, faces_all_round(800), 1.01);
  p.host.x = {0.1, 0, 0};
  p.engine->choose(p.spheres(), 0.2);
  p.step(0);
  EXPECT_GT(p.springs().count(0), 100);
  EXPECT_NO_THROW(p.engine->read_diagnostics());
  p.host.x = {0, 0, 0};
  p.step(0);
  EXPECT_EQ(p.springs().count(0), 0);
  EXPECT_TRUE(fails_with("more than 512 separate places", [&] { p.engine->read_diagnostics(); }));
}

// Walls on which there are single contacts, several, and some that are uncertain.
std::vector<Case> walls()
{
  const std::vector<Case> all = cases();
  return {all[0], all[3], all[4], all[5]};
}

TEST(engine, with_two_kernels_gives_what_one_pass_gives_beyond_contact_and_with_every_effect)
{
  for (const Case &c : walls()) {
    EngineSettings s;
    s.law() = everything(NormalModel::jkr);
    s.contacts = true;
    s.surface.velocity = {1, 0, 0};
    expect_same(run_steps(c, s.law(), on_cpu, effect_spheres(), kComplete, s),
                run_steps(c, s.law(), by_two_kernels, effect_spheres(), kComplete, s), c.name);
  }
}

TEST(engine, with_two_kernels_gives_what_one_pass_gives_on_one_side_of_the_wall)
{
  for (Side side : {Side::in, Side::out}) {
    EngineSettings s;
    s.law() = classic(NormalModel::hooke, false);
    s.side = side;
    const auto outcome = [&](const EngineMaker &make) {
      Scene scene(box_mesh({0, 0, 0}, {4, 4, 4}), 0.6, s);
      scene.use(make(s));
      // Along a diagonal, through the wall at a corner.
      for (int i = 0; i < 60; i++)
        scene.add_sphere(Real(0.05 * i - 0.8) * Vec3{1, 1.01, 0.99}, 0.5, 1, {0.1, 0.2, 0.3});
      scene.compute(1e-3);
      std::vector<Vec3> force;
      for (int i = 0; i < scene.n(); i++) force.push_back(scene.force(i));
      EXPECT_GT(scene.engine->results().totals().contacts, 10);
      return force;
    };
    EXPECT_TRUE(same_bytes(outcome(on_cpu), outcome(by_two_kernels)));
  }
}

// A step's spheres by what they touch: a face, a corner of three, faces all round, nothing.
struct Mixture {
  int single, several, crowded;
};
constexpr Mixture kMixtures[] = {{300, 20, 5}, {10, 200, 1}, {0, 0, 0},    {150, 150, 30},
                                 {1, 1, 1},    {0, 400, 0},  {400, 0, 40}, {0, 0, 2}};
constexpr int kSpheres = 500, kAllRound = 12;

Vec3 place_in(const Mixture &m, int i)
{
  const auto off = [](int k) { return 1e-3 * std::sin(7.0 * k); };
  const Vec3 a_little = {off(3 * i), off(3 * i + 1), off(3 * i + 2)};
  if (i < m.single) return Vec3{25, 25, 21} + a_little;
  if (i < m.single + m.several) return Vec3{21, 21, 21} + a_little;
  if (i < m.single + m.several + m.crowded) return a_little;
  return {25, 25, 25};
}

TEST(engine, takes_spheres_whose_kind_of_contact_changes_from_step_to_step)
{
  TriangleSoup soup = faces_all_round(kAllRound);
  append(soup, box_mesh({20, 20, 20}, {30, 30, 30}));
  EngineSettings s;
  s.law() = classic(NormalModel::hertz, true);
  s.corner = Corner::sum;    // each face counts
  Scene host(soup, 1.1, s), device(soup, 1.1, s), ahead(soup, 1.1, s);
  host.use(on_cpu(s));
  device.use(in_place(s));
  ahead.use(by_two_kernels(s));
  for (Scene *scene : {&host, &device, &ahead})
    for (int i = 0; i < kSpheres; i++)
      scene->add_sphere({25, 25, 25}, 1.05, 1, {0.1, 0.2, 0.3}, {0.3, 0.2, 0.1});
  for (const Mixture &m : kMixtures) {
    for (Scene *scene : {&host, &device, &ahead}) {
      for (int i = 0; i < kSpheres; i++) scene->set_x(i, place_in(m, i));
      scene->compute(1e-3);
    }
    EXPECT_EQ(host.engine->results().totals().contacts,
              m.single + 3 * m.several + kAllRound * m.crowded);
    for (Scene *scene : {&device, &ahead}) {
      EXPECT_TRUE(same_bytes(std::vector<WallTotals>{host.engine->results().totals()},
                             std::vector<WallTotals>{scene->engine->results().totals()}));
      int same = 0;
      for (int i = 0; i < kSpheres; i++) {
        same += scene->force(i) == host.force(i) && scene->torque(i) == host.torque(i) &&
                same_springs(scene->springs, i, host.springs, i);
      }
      EXPECT_EQ(same, kSpheres) << m.single << " " << m.several << " " << m.crowded;
    }
  }
}

// Threads of a GPU's second kernel.
constexpr int kMaxLanes = 1 << 17;

TEST(engine, takes_more_spheres_with_several_contacts_than_a_kernel_has_threads)
{
  const int n = kMaxLanes + 5000;
  EngineSettings s;
  s.law() = classic(NormalModel::hooke, false);
  const auto outcome = [&](const EngineMaker &make) {
    Scene scene(box_mesh({20, 20, 20}, {30, 30, 30}), 1.1, s);
    scene.use(make(s));
    for (int i = 0; i < n; i++)
      scene.add_sphere(place_in({0, n, 0}, i), 1.05, 1, {0.1, 0.2, 0.3}, {0.3, 0.2, 0.1});
    scene.compute(1e-3);
    EXPECT_EQ(scene.engine->results().totals().contacts, 3 * n);
    std::vector<Vec3> force;
    for (int i = 0; i < n; i++) force.push_back(scene.force(i));
    return force;
  };
  const std::vector<Vec3> host = outcome(on_cpu);
  EXPECT_TRUE(same_bytes(host, outcome(by_two_kernels)));
  EXPECT_TRUE(same_bytes(host, outcome(in_place)));
}

// 100 spheres that stay where they are, each in the midst of kAllRound faces.
struct AllTouching {
  static constexpr int n = 100;

  AllTouching() : grid(grid_of_faces()), host(n, 1.05), there(test_on_cuda())
  {
    EngineSettings s;
    s.law() = classic(NormalModel::hertz, true);
    s.corner = Corner::sum;
    engine = test_on_cuda() ? make_cuda_engine_in_place(s, 0, nullptr) : make_cpu_engine(s);
    for (int i = 0; i < n; i++) put_vector(host.x, i, place_in({0, 0, n}, i));
    spheres = there.put(host);
    step.dt = 1e-3;
    engine->set_grid(grid.view());
    engine->springs().grow(n);
    choose();
  }

  void choose()
  {
    there.put_x(host.x);
    engine->choose(spheres, 0);
  }

  static StepGrid grid_of_faces()
  {
    StepGridSettings g;
    g.cutoff = 1.1;
    return build_grid(weld(faces_all_round(kAllRound), -1), g);
  }

  FlatOf<StepGrid> grid;
  std::unique_ptr<WallEngine> engine;
  SphereArrays host;
  SphereArraysOn there;
  Spheres spheres;
  StepSettings step;
};

TEST(engine, takes_no_places_from_the_next_step)
{
  // 12 contacts of each of 100 spheres in 60 steps are more than all shared places.
  constexpr int n = AllTouching::n, n_steps = 60;
  static_assert(n * n_steps * kAllRound > 65536 + 3 * n, "");
  AllTouching all;
  for (int k = 0; k < n_steps; k++) {
    all.engine->step(all.spheres, all.step);
  }
  EXPECT_NO_THROW(all.engine->read_diagnostics());
  EXPECT_EQ(all.engine->results().totals().contacts, n * kAllRound);
}

// A variable of another fix may ask for a wall's force between the forces of atoms and the wall's.
TEST(engine, keeps_the_totals_of_the_last_step_until_the_next_one_is_collected)
{
  for (const When when : {When::in_turn, When::beside}) {
    AllTouching all;
    const auto submit = [&] {
      all.engine->begin(when);
      all.choose();
      all.engine->submit(all.spheres, all.step);
    };
    const std::vector<Real> x = all.host.x;
    for (int i = 0; i < all.n; i += 2) all.host.x[3 * i] += 100;
    submit();
    all.engine->collect();
    // More spheres than there was memory for before, and other columns.
    all.host.x = x;
    all.step.per_sphere = true;
    submit();
    EXPECT_EQ(all.engine->results().totals().contacts, all.n / 2 * kAllRound);
    all.engine->collect();
    EXPECT_EQ(all.engine->results().totals().contacts, all.n * kAllRound);
  }
}

// One state says where a step is, also where the choice before it fails.
TEST(engine, knows_a_step_that_is_begun_submitted_or_none)
{
  for (const When when : {When::in_turn, When::beside}) {
    AllTouching all;
    WallEngine &engine = *all.engine;
    const auto submit = [&] { engine.submit(all.spheres, all.step); };
    EXPECT_EQ(engine.state(), StepState::none);
    EXPECT_THROW(submit(), std::logic_error);
    engine.begin(when);
    EXPECT_EQ(engine.state(), StepState::begun);
    EXPECT_THROW(engine.collect(), std::logic_error);
    const Real radius = std::exchange(all.host.radius[0], 100);    // beyond the cutoff of its grid
    all.spheres = all.there.put(all.host);
    EXPECT_THROW(all.choose(), InputError);
    EXPECT_EQ(engine.state(), StepState::begun);
    all.host.radius[0] = radius;
    all.spheres = all.there.put(all.host);
    all.choose();
    submit();
    EXPECT_EQ(engine.state(), StepState::submitted);
    EXPECT_EQ(engine.is_under_way(), when == When::beside);
    engine.collect();
    EXPECT_EQ(engine.state(), StepState::none);
    EXPECT_EQ(engine.results().totals().contacts, all.n * kAllRound);
  }
}

// LAMMPS's buffers have room for so many numbers of an atom.
TEST(engine, packs_a_sphere_into_no_more_than_any_sphere_can_have)
{
  AllTouching all;
  all.engine->step(all.spheres, all.step);
  const int largest = all.engine->springs().largest_packed_size(all.n);
  EXPECT_EQ(largest, 1 + kAllRound * ContactHistory().row_size());
  EXPECT_LE(largest, 1 + kMaxContacts * ContactHistory().row_size());
}

}    // namespace
