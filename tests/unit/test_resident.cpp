// The engine for particles that live where it computes against the one for a host's: one
// source, so the same bits. LSDCD_QUICK=1 tries a tenth of the spheres for other searches.
#include "contact/spring_store.h"
#include "effects/effects.h"
#include "engine/force/law_step.h"
#include "engine/resident_on.h"
#include "grid/lookup/near_within.h"
#include "parallel/backend_cpu.h"
#include "support/crowd.h"
#include "support/device.h"
#include "support/device_memory.h"
#include "support/test_engine.h"

#include <cstdlib>
#include <gtest/gtest.h>
#include <random>

using namespace lsdcd;

namespace {

void expect_same(const Outcome &a, const Outcome &b, const std::string &name)
{
  expect_same_rows(a, b, name);
  EXPECT_EQ(a.totals.energy, b.totals.energy) << name;
  EXPECT_TRUE(a.totals.force == b.totals.force) << name;
  EXPECT_TRUE(a.totals.torque == b.totals.torque) << name;
  EXPECT_EQ(a.totals.contacts, b.totals.contacts) << name;
  EXPECT_EQ(a.totals.uncertified, b.totals.uncertified) << name;
  EXPECT_EQ(a.totals.largest_overlap_sphere, b.totals.largest_overlap_sphere) << name;
  EXPECT_GT(a.totals.contacts, 0) << name;
}

ContactLaw history()
{
  return classic(LawStyle::hertz_history);
}

TEST(resident, gives_what_every_effect_gives_on_the_host)
{
  std::vector<Case> walls = cases();
  walls.erase(walls.begin() + 2);    // the largest one tells no more and takes the longest
  for (const EffectCase &effect : effect_cases()) {
    const Case &c = walls[effect.name.size() % walls.size()];
    const EngineSettings &s = effect.settings;
    expect_same(run_steps(c, s.law, on_host, 2000, kComplete, s),
                run_steps(c, s.law, in_place, 2000, kComplete, s), effect.name);
  }
}

TEST(resident, gives_what_the_host_gives_however_it_searches)
{
  const int spheres = std::getenv("LSDCD_QUICK") ? 200 : 2000;
  for (const Search &search : other_searches())
    for (const Case &c : cases())
      expect_same(run_steps(c, history(), on_host, spheres, search),
                  run_steps(c, history(), in_place, spheres, search),
                  std::string(c.name) + ", " + search.name);
}

TEST(resident, drops_no_contact_of_crowded_spheres)
{
  for (int n : {9, 40, 100, 400}) {
    EngineSettings s;
    s.law = history();
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
      EXPECT_EQ(scene.engine->totals().contacts, n * spheres);
      return force;
    };
    EXPECT_TRUE(same_bytes(outcome(on_host), outcome(in_place))) << n;
  }
}

// A resident engine with particles of its own, in its memory.
class Particles {
 public:
  Particles(const EngineSettings &settings, int n, Real reach, bool cuda = test_on_cuda()) :
      x_(cuda), v_(cuda), omega_(cuda), radius_(cuda), mass_(cuda), force_(cuda), torque_(cuda),
      n_(n)
  {
    engine =
        cuda ? make_resident_cuda_engine(settings, 0, nullptr) : make_resident_cpu_engine(settings);
    const WallMesh mesh = weld(floor_mesh(40, 10, 7), -1);
    GridSettings g;
    g.reach = reach;
    grid = build_grid(mesh, g);
    flat = FlatGrid(grid);
    engine->set_grid(flat.view());
    engine->grow(n);
    std::mt19937_64 random(5);
    std::uniform_real_distribution<Real> at(-9, 9), up(0, 4 * reach), speed(-1, 1), unit(0.3, 1);
    for (int i = 0; i < n; i++) {
      for (Real value : {at(random), at(random), up(random)}) host_x.push_back(value);
      for (int k = 0; k < 3; k++) host_v.push_back(speed(random));
      host_radius.push_back(reach * unit(random));
    }
  }

  // One step of all spheres along their velocities, then the wall's forces on those near
  // it, or on those of an older choice.
  enum class Choice { older, now };
  void step(Real dt, Choice choice = Choice::older)
  {
    for (std::size_t i = 0; i < host_x.size(); i++) host_x[i] += dt * host_v[i];
    if (choice == Choice::now) engine->choose(spheres(), 0);
    StepSettings step;
    step.dt = dt;
    engine->start(spheres(), step, nullptr);
  }

  Spheres spheres()
  {
    const std::vector<Real> none(3 * n_, 0), one(n_, 1);
    Spheres s;
    s.n = n_;
    s.x = x_.put(host_x);
    s.v = v_.put(host_v);
    s.omega = omega_.put(none);
    s.radius = radius_.put(host_radius);
    s.mass = mass_.put(one);
    s.force = force_.put(none);
    s.torque = torque_.put(none);
    return s;
  }

  std::vector<Real> force() { return force_.get(3 * n_); }
  SpringStore springs()
  {
    SpringStore store;
    engine->springs_to(store, n_);
    return store;
  }

  std::unique_ptr<ResidentEngine> engine;
  TriangleGrid grid;
  FlatGrid flat;
  std::vector<Real> host_x, host_v, host_radius;

 private:
  DeviceArray<Real> x_, v_, omega_, radius_, mass_, force_, torque_;
  int n_;
};

EngineSettings with_history()
{
  EngineSettings s;
  s.law = history();
  return s;
}

bool same_springs(const SpringStore &a, int i, const SpringStore &b, int j)
{
  const auto of = [](const SpringStore &store, int k) {
    return std::vector<Spring>(store.of(k), store.of(k) + store.count(k));
  };
  return same_bytes(of(a, i), of(b, j));
}

TEST(resident, a_list_that_is_kept_gives_the_same_bits)
{
  const int n = 3000;
  Particles kept(with_history(), n, 0.5), anew(with_history(), n, 0.5);
  // 20 steps of 0.01 at up to sqrt(3): 0.35.
  kept.engine->choose(kept.spheres(), 0.36);
  bool differs = false;
  for (int k = 0; k < 20; k++) {
    kept.step(0.01);
    anew.step(0.01, Particles::Choice::now);
    differs = differs || !same_bytes(kept.force(), anew.force());
  }
  EXPECT_FALSE(differs);
  const SpringStore a = kept.springs(), b = anew.springs();
  int with = 0, same = 0;
  for (int i = 0; i < n; i++) {
    with += a.count(i) > 0;
    same += same_springs(a, i, b, i);
  }
  EXPECT_EQ(same, n);
  EXPECT_GT(with, 100);
  EXPECT_GT(kept.engine->n_near(), anew.engine->n_near());
}

TEST(resident, a_way_within_the_margin_ends_near_only_where_it_was_seen_before)
{
  Particles p(with_history(), 1, 0.5);
  const GridView grid = p.flat.view();
  const std::vector<BrickWord> words = brick_words(grid);
  const BrickTable table(words, words.data());
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> at(-12, 12), up(-3, 3), unit(-1, 1), margins(0, 1.5);
  int near = 0, missed = 0, far = 0;
  for (int k = 0; k < 200000; k++) {
    const Vec3 q = {at(random), at(random), up(random)};
    Vec3 way = {unit(random), unit(random), unit(random)};
    const Real margin = margins(random);
    way = (margin * std::fabs(unit(random)) / norm(way)) * way;
    if (near_wall(grid, q + way)) {
      near++;
      missed += !near_within(grid, table, q, margin);
    } else
      far += !near_within(grid, table, q, margin);
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(near, 1000);
  EXPECT_GT(far, 1000);    // it is not near everywhere
}

TEST(resident, springs_follow_through_pack_and_unpack)
{
  const int n = 2000, stay = 1500;
  Particles from(with_history(), n, 0.5), to(with_history(), n, 0.5);
  for (int k = 0; k < 5; k++) {
    from.step(0.01, Particles::Choice::now);
  }
  const SpringStore before = from.springs();
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
  buffer.resize(moved * (1 + from.engine->largest_packed_size(n)));
  const int size =
      from.engine->pack(moved, d_which.put(which), d_copies.put(copies), buffer.data());
  EXPECT_LE(size, moved * (1 + from.engine->largest_packed_size(n)));

  const SpringStore left = from.springs();
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
      from.engine->pack(moved, d_which.put(others), d_copies.put(stays), buffer.data());
  const std::vector<double> behind = buffer.get(second);
  both.insert(both.end(), behind.begin(), behind.end());
  DeviceArray<double> d_both(cuda);
  d_both.put(both);
  to.step(0.01, Particles::Choice::now);
  const SpringStore own = to.springs();
  to.engine->unpack(2 * moved, d_back.put(places), d_both.data(), moved, size);
  const SpringStore after = to.springs();
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

// A backend that counts what crosses between host and device, and waiting; it finds
// contacts first, as a GPU does.
struct CountingBackend : CpuBackend {
  static constexpr bool kFindsFirst = true;
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
  std::vector<T> to_host(const Array<T> &a, std::size_t n)
  {
    crossings()++;
    return CpuBackend::to_host(a, n);
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
  template <class Work>
  void select(std::size_t n, const Work &work, SelectRoom &room, int *to, std::uint32_t *total)
  {
    crossings()++;
    CpuBackend::select(n, work, room, to, total);
  }
};

TEST(resident, a_step_without_outputs_neither_copies_nor_waits)
{
  using Law = OnWall<HertzHistoryLaw<Real>, false, false>;
  const ContactLaw p = history();
  const Law law = {{{p.k_normal}, {p.gamma_normal}, {p.k_tangent, p.gamma_tangent, p.mu}, false}};
  Particles particles(with_history(), 2000, 0.5, false);
  particles.engine = std::make_unique<ResidentOn<CountingBackend>>(
      with_history(),
      CompiledLaw<CountingBackend>{traits_of<Law>(), LawBytes(law),
                                   start_found_law<Law, CountingBackend>},
      CountingBackend());
  particles.engine->set_grid(particles.flat.view());
  particles.engine->grow(2000);
  particles.engine->choose(particles.spheres(), 0.5);
  EXPECT_GT(CountingBackend::crossings(), 0);
  const auto crossings_of = [&](bool per_sphere) {
    const int before = CountingBackend::crossings();
    StepSettings step;
    step.dt = 0.01;
    step.per_sphere = per_sphere;
    particles.engine->mark_places();
    particles.engine->search(particles.spheres(), step);
    particles.engine->start(particles.spheres(), step, nullptr);
    particles.engine->collect();
    return CountingBackend::crossings() - before;
  };
  for (int k = 0; k < 5; k++) EXPECT_EQ(crossings_of(false), 0);
  EXPECT_GT(crossings_of(true), 0);
  EXPECT_GT(particles.engine->totals().contacts, 100);
}

TEST(resident, outputs_of_the_step_that_asks_for_them_are_those_of_always_asking)
{
  const int n = 3000;
  Particles once(with_history(), n, 0.5), always(with_history(), n, 0.5);
  const auto outputs = [](Particles &p, bool asks) {
    StepSettings step;
    step.dt = 0.01;
    step.per_sphere = asks;
    p.engine->start(p.spheres(), step, nullptr);
    p.engine->collect();
    const SphereOutput *first = p.engine->sphere_output();
    return std::vector<SphereOutput>(first, first + p.engine->n_touching());
  };
  for (Particles *p : {&once, &always}) p->engine->choose(p->spheres(), 0);
  for (bool asks : {false, true, false}) {
    const std::vector<SphereOutput> a = outputs(once, asks), b = outputs(always, true);
    EXPECT_GT(b.size(), 100u);
    EXPECT_EQ(a.empty(), !asks);
    EXPECT_TRUE(!asks || same_bytes(a, b));
    EXPECT_EQ(once.engine->totals().energy, always.engine->totals().energy);
  }
}

TEST(resident, springs_that_are_taken_over_are_all_that_there_are)
{
  const int n = 2000, few = 10;
  Particles p(with_history(), n, 0.5);
  for (int k = 0; k < 5; k++) p.step(0.01, Particles::Choice::now);
  const SpringStore before = p.springs();
  SpringStore store;
  store.grow(few);
  p.engine->springs_from(store, few);
  const SpringStore after = p.springs();
  int had = 0, have = 0;
  for (int i = few; i < n; i++) {
    had += before.count(i);
    have += after.count(i);
  }
  EXPECT_GT(had, 100);
  EXPECT_EQ(have, 0);
}

TEST(resident, a_sphere_that_was_far_has_no_spring_of_before)
{
  Particles p(with_history(), 1, 0.5);
  p.host_x = {0.3, 0.1, 0.45};
  p.host_v = {1, 0, 0};
  p.host_radius = {0.5};
  for (int k = 0; k < 3; k++) p.step(0.01, Particles::Choice::now);
  const Real three = p.springs().of(0)->stretch.x;
  p.host_x[2] += 10;
  p.step(0.01, Particles::Choice::now);
  EXPECT_EQ(p.springs().count(0), 0);
  p.host_x[2] -= 10;
  p.step(0.01, Particles::Choice::now);
  ASSERT_EQ(p.springs().count(0), 1);
  EXPECT_NEAR(p.springs().of(0)->stretch.x, three / 3, 1e-15);
}

TEST(resident, a_sphere_larger_than_the_reach_is_an_error)
{
  Particles p(with_history(), 100, 0.5);
  p.host_radius[7] = 0.6;
  p.host_radius[70] = 0.7;
  try {
    p.engine->choose(p.spheres(), 0);
    FAIL();
  } catch (const std::exception &e) {
    EXPECT_NE(std::string(e.what()).find("sphere 7 has radius 0.6"), std::string::npos) << e.what();
  }
}

TEST(resident, a_sphere_that_is_pulled_from_past_the_reach_is_named)
{
  int tried = 0;
  for (const EffectCase &effect : effect_cases()) {
    const Real pull_off = effect.settings.law.pull_off(), reach = 0.5;
    if (!(pull_off > 0)) continue;
    tried++;
    Particles p(effect.settings, 100, reach);
    // The radius from which a sphere is pulled from farther than the reach, by bisection.
    Real fits = 0, too_large = reach;
    while (too_large - fits > 1e-12) {
      const Real middle = (fits + too_large) / 2;
      (middle + pull_off * std::cbrt(middle) <= reach ? fits : too_large) = middle;
    }
    ASSERT_GT(fits, 0.1) << effect.name;
    for (Real &radius : p.host_radius) radius = fits * (1 - 1e-9);
    EXPECT_NO_THROW(p.engine->choose(p.spheres(), 0)) << effect.name;
    p.host_radius[7] = too_large * (1 + 1e-9);
    try {
      p.engine->choose(p.spheres(), 0);
      FAIL() << effect.name;
    } catch (const std::exception &e) {
      EXPECT_NE(std::string(e.what()).find("sphere 7 has radius"), std::string::npos) << e.what();
    }
  }
  EXPECT_GT(tried, 0);
}

TEST(resident, a_sphere_that_grows_past_the_reach_is_an_error_at_the_next_look)
{
  Particles p(with_history(), 100, 0.5);
  for (int i = 0; i < 100; i++) p.host_x[3 * i + 2] = 0.1;
  p.engine->choose(p.spheres(), 0);
  p.step(0);
  EXPECT_NO_THROW(p.engine->look());
  p.host_radius[7] = 0.6;
  p.step(0);
  EXPECT_THROW(p.engine->look(), std::exception);
}

TEST(resident, notes_the_deepest_overlap_of_all_steps_since_the_last_look)
{
  Particles p(with_history(), 3, 0.5);
  p.host_x = {0.3, 0.1, 0.45, 4, 4, 0.3, -4, 3, 3};
  p.host_v.assign(9, 0);
  p.host_radius = {0.5, 0.4, 0.5};
  p.engine->choose(p.spheres(), 0.5);
  p.step(1);    // 10 % and 25 %
  p.host_x[5] = 0.39;
  p.step(1);
  const StepNotes notes = p.engine->look();
  EXPECT_NEAR(notes.deepest, 0.25, 1e-7);    // it is kept in single precision
  EXPECT_EQ(notes.deepest_sphere, 1);
  p.step(1);
  EXPECT_NEAR(p.engine->look().deepest, 0.1, 1e-7);
}

TEST(resident, many_springs_take_shared_places)
{
  // A corner of three walls has more contacts than a sphere has places of its own.
  const Case corner = {"box", box_mesh({0, 0, 0}, {1.2, 1.2, 1.2}), 0.5, 0};
  const Outcome a = run_steps(corner, history(), on_host, 20000);
  const Outcome b = run_steps(corner, history(), in_place, 20000);
  expect_same(a, b, "corner");
  int three = 0;
  for (const SphereOutput &o : a.outputs) three += o.contacts >= 3;
  EXPECT_GT(three, 300);
}

}    // namespace
