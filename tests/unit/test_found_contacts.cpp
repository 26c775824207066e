// Contacts that are found ahead of the law, as on a GPU, against one pass from search to
// force: the same bits. On a backend of the host that finds them first, and where
// LSDCD_TEST_DEVICE says.
#include "engine/force/law_step.h"
#include "engine/force/laws.h"
#include "engine/narrow/find_first.h"
#include "engine/resident_on.h"
#include "parallel/backend_cpu.h"
#include "support/crowd.h"
#include "support/device.h"
#include "support/device_memory.h"
#include "support/test_engine.h"

#include <gtest/gtest.h>

#include <functional>
#include <memory>
#include <vector>

using namespace lsdcd;

namespace {

// What it does beside other work is done as late as it may be: when the backend is made to wait
// for it, or, as nothing orders the two, behind the next search that the backend does itself.
struct FindingFirst : CpuBackend {
  static constexpr bool kFindsFirst = true;
  using Work = std::vector<std::function<void()>>;

  std::shared_ptr<Work> given = std::make_shared<Work>();    // to do beside
  bool is_beside = false;

  class Beside {
   public:
    void mark(const FindingFirst &) {}
    FindingFirst &begin(FindingFirst &b)
    {
      mine_ = std::make_shared<FindingFirst>(b);
      mine_->is_beside = true;
      return *mine_;
    }
    void end() {}
    void join(const FindingFirst &b) { b.do_given(); }

   private:
    std::shared_ptr<FindingFirst> mine_;
  };

  template <class F>
  void list(std::size_t n, const F &work, int *listed)
  {
    if (is_beside)
      given->push_back([=] { CpuBackend().list(n, work, listed); });
    else
      CpuBackend::list(n, work, listed);
  }
  template <class F>
  void few(std::size_t n, const F &work)
  {
    if (is_beside) {
      given->push_back([=] { CpuBackend().few(n, work); });
      return;
    }
    CpuBackend::few(n, work);
    do_given();
  }

 private:
  void do_given() const
  {
    for (const auto &work : *given) work();
    given->clear();
  }
};
using FoundLaw = CompiledLaw<FindingFirst>;

// Of granular laws only the one with every effect is compiled.
struct MakeFoundLaw {
  WallEffects effects;

  template <class Law>
  FoundLaw operator()(const Law &law) const
  {
    if constexpr (!Law::kCouple || (Law::kHeat && Law::kExtra == 5))
      return on_wall<WallKernels::both>(law, effects, [](const auto &compiled) {
        using L = std::decay_t<decltype(compiled)>;
        return FoundLaw{traits_of<L>(), LawBytes(compiled), start_found_law<L, FindingFirst>};
      });
    else
      throw std::logic_error("not compiled for this test");
  }
};

FoundLaw found_law(const EngineSettings &s)
{
  const MakeFoundLaw make = {wall_effects(s)};
  if (s.law.style != LawStyle::granular) {
    if (s.precision == Precision::single_) return with_classic_law<float>(s.law, make);
    return with_classic_law<Real>(s.law, make);
  }
  const GranularLaw &g = s.law.granular;
  return with_granular_law(s.law, JkrNormal<Real>(g.modulus, g.cohesion), make);
}

std::unique_ptr<WallEngine> found_first(const EngineSettings &s)
{
  return for_host(std::make_unique<ResidentOn<FindingFirst>>(s, found_law(s), FindingFirst()),
                  s.law.has_history(), false);
}

void expect_same_totals(const WallTotals &a, const WallTotals &b, const std::string &name)
{
  EXPECT_TRUE(same_bytes(std::vector<WallTotals>{a}, std::vector<WallTotals>{b})) << name;
}

void expect_same(const Case &c, const EngineSettings &s, const Search &search)
{
  const Outcome a = run_steps(c, s.law, on_host, 2000, search, s);
  const Outcome b = run_steps(c, s.law, found_first, 2000, search, s);
  const std::string name = std::string(c.name) + ", " + search.name;
  expect_same_rows(a, b, name);
  expect_same_totals(a.totals, b.totals, name);
  EXPECT_GT(a.totals.contacts, 0) << name;
}

// Walls on which there are single contacts, several, and some that are uncertain.
std::vector<Case> walls()
{
  const std::vector<Case> all = cases();
  return {all[0], all[3], all[4], all[5]};
}

TEST(found_contacts, give_what_one_pass_gives)
{
  for (LawStyle style : {LawStyle::hooke, LawStyle::hertz_history})
    for (const Case &c : walls()) {
      EngineSettings s;
      s.law = classic(style);
      expect_same(c, s, kComplete);
    }
}

TEST(found_contacts, give_it_past_touch_and_with_every_effect)
{
  for (const Case &c : walls()) {
    EngineSettings s;
    s.law = everything(NormalModel::jkr);
    s.records = true;
    s.surface.velocity = {1, 0, 0};
    expect_same(c, s, kComplete);
  }
}

TEST(found_contacts, give_it_however_the_wall_is_searched)
{
  for (const Search &search : other_searches())
    for (const Case &c : walls()) {
      EngineSettings s;
      s.law = classic(LawStyle::hertz_history);
      expect_same(c, s, search);
    }
}

TEST(found_contacts, give_it_on_one_side_of_the_wall)
{
  for (Side side : {Side::in, Side::out}) {
    EngineSettings s;
    s.law = classic(LawStyle::hooke);
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
      EXPECT_GT(scene.engine->totals().contacts, 10);
      return force;
    };
    EXPECT_TRUE(same_bytes(outcome(on_host), outcome(found_first)));
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

TEST(found_contacts, of_all_kinds_change_from_step_to_step)
{
  TriangleSoup soup = faces_all_round(kAllRound);
  append(soup, box_mesh({20, 20, 20}, {30, 30, 30}));
  EngineSettings s;
  s.law = classic(LawStyle::hertz_history);
  s.corner = Corner::sum;    // each face counts
  Scene host(soup, 1.1, s), device(soup, 1.1, s), ahead(soup, 1.1, s);
  host.use(on_host(s));
  device.use(in_place(s));
  ahead.use(found_first(s));
  for (Scene *scene : {&host, &device, &ahead})
    for (int i = 0; i < kSpheres; i++)
      scene->add_sphere({25, 25, 25}, 1.05, 1, {0.1, 0.2, 0.3}, {0.3, 0.2, 0.1});
  for (const Mixture &m : kMixtures) {
    for (Scene *scene : {&host, &device, &ahead}) {
      for (int i = 0; i < kSpheres; i++) scene->set_x(i, place_in(m, i));
      scene->compute(1e-3);
    }
    EXPECT_EQ(host.engine->totals().contacts, m.single + 3 * m.several + kAllRound * m.crowded);
    for (Scene *scene : {&device, &ahead}) {
      expect_same_totals(host.engine->totals(), scene->engine->totals(), "totals");
      int same = 0;
      for (int i = 0; i < kSpheres; i++) {
        const int n = host.springs.count(i);
        same += scene->force(i) == host.force(i) && scene->torque(i) == host.torque(i) &&
                scene->springs.count(i) == n &&
                (n == 0 ||
                 std::memcmp(scene->springs.of(i), host.springs.of(i), n * sizeof(Spring)) == 0);
      }
      EXPECT_EQ(same, kSpheres) << m.single << " " << m.several << " " << m.crowded;
    }
  }
}

// Lanes of a GPU that share spheres with several contacts.
constexpr int kMostLanes = 1 << 16;

TEST(found_contacts, of_more_spheres_than_there_are_lanes_for_several)
{
  const int n = kMostLanes + 5000;
  EngineSettings s;
  s.law = classic(LawStyle::hooke);
  const auto outcome = [&](const EngineMaker &make) {
    Scene scene(box_mesh({20, 20, 20}, {30, 30, 30}), 1.1, s);
    scene.use(make(s));
    for (int i = 0; i < n; i++)
      scene.add_sphere(place_in({0, n, 0}, i), 1.05, 1, {0.1, 0.2, 0.3}, {0.3, 0.2, 0.1});
    scene.compute(1e-3);
    EXPECT_EQ(scene.engine->totals().contacts, 3 * n);
    std::vector<Vec3> force;
    for (int i = 0; i < n; i++) force.push_back(scene.force(i));
    return force;
  };
  const std::vector<Vec3> host = outcome(on_host);
  EXPECT_TRUE(same_bytes(host, outcome(found_first)));
  EXPECT_TRUE(same_bytes(host, outcome(in_place)));
}

TEST(found_contacts, of_more_crowded_spheres_than_there_is_room_for_are_an_error)
{
  EngineSettings s;
  s.law = classic(LawStyle::hertz_history);
  for (const EngineMaker &make : {EngineMaker(found_first), EngineMaker(in_place)}) {
    Scene scene(faces_all_round(kAllRound), 1.1, s);
    scene.use(make(s));
    for (int i = 0; i < kCrowded + 7; i++)
      scene.add_sphere(place_in({0, 0, kCrowded + 7}, i), 1.05, 1);
    try {
      scene.compute(1e-3);
      FAIL();
    } catch (const InputError &e) {
      EXPECT_EQ(std::string(e.what()).find("7 spheres touch the wall in more"), 0u) << e.what();
    }
  }
}

enum class Engine { found_first, one_pass, cuda };

// 100 spheres that stay where they are, each in the midst of kAllRound faces, under an engine of
// this kind.
struct AllTouching {
  static constexpr int n = 100;

  explicit AllTouching(Engine kind) :
      grid(grid_of_faces()), place(kind == Engine::cuda), zero(kind == Engine::cuda),
      force(kind == Engine::cuda), torque(kind == Engine::cuda), radius(kind == Engine::cuda),
      mass(kind == Engine::cuda)
  {
    EngineSettings s;
    s.law = classic(LawStyle::hertz_history);
    s.corner = Corner::sum;
    if (kind == Engine::cuda)
      engine = make_resident_cuda_engine(s, 0, nullptr);
    else if (kind == Engine::one_pass)
      engine = make_resident_cpu_engine(s);
    else
      engine = std::make_unique<ResidentOn<FindingFirst>>(s, found_law(s), FindingFirst());
    for (int i = 0; i < n; i++) x.push_back(place_in({0, 0, n}, i));
    const std::vector<Real> none(3 * n, 0);
    spheres.n = n;
    spheres.v = spheres.omega = zero.put(none);
    spheres.radius = radius.put(std::vector<Real>(n, 1.05));
    spheres.mass = mass.put(std::vector<Real>(n, 1));
    spheres.force = force.put(none);
    spheres.torque = torque.put(none);
    step.dt = 1e-3;
    engine->set_grid(grid.view());
    engine->grow(n);
    choose();
  }

  void choose()
  {
    spheres.x = place.put(&x[0].x, 3 * n);
    engine->choose(spheres, 0);
  }

  static TriangleGrid grid_of_faces()
  {
    GridSettings g;
    g.reach = 1.1;
    return build_grid(weld(faces_all_round(kAllRound), -1), g);
  }

  FlatGrid grid;
  std::unique_ptr<ResidentEngine> engine;
  std::vector<Vec3> x;
  DeviceArray<Real> place, zero, force, torque, radius, mass;
  Spheres spheres;
  StepSettings step;
};

TEST(found_contacts, of_a_step_take_no_room_from_the_next)
{
  // 12 contacts of each of 100 spheres in 60 steps are more than all shared places.
  constexpr int n = AllTouching::n, n_steps = 60;
  static_assert(n * n_steps * kAllRound > kCrowdContacts + 4 * n, "");
  for (Engine kind : {Engine::found_first, test_on_cuda() ? Engine::cuda : Engine::one_pass}) {
    AllTouching all(kind);
    for (int k = 0; k < n_steps; k++) all.engine->start(all.spheres, all.step, nullptr);
    EXPECT_NO_THROW(all.engine->look());
    EXPECT_EQ(all.engine->totals().contacts, n * kAllRound);
  }
}

TEST(found_contacts, of_a_search_that_was_begun_are_left_where_spheres_are_chosen_anew)
{
  for (Engine kind : {Engine::found_first, test_on_cuda() ? Engine::cuda : Engine::one_pass}) {
    AllTouching all(kind);
    all.engine->mark_places();
    all.engine->search(all.spheres, all.step);
    for (int i = 0; i < all.n; i += 2) all.x[i].x += 100;
    all.choose();
    all.engine->start(all.spheres, all.step, nullptr);
    EXPECT_EQ(all.engine->totals().contacts, all.n / 2 * kAllRound) << static_cast<int>(kind);
  }
}

TEST(found_contacts, of_a_search_that_was_begun_are_left_where_places_are_marked_anew)
{
  for (Engine kind : {Engine::found_first, test_on_cuda() ? Engine::cuda : Engine::one_pass}) {
    AllTouching all(kind);
    all.engine->mark_places();
    all.engine->search(all.spheres, all.step);
    all.engine->mark_places();
    all.engine->start(all.spheres, all.step, nullptr);
    EXPECT_EQ(all.engine->totals().contacts, all.n * kAllRound) << static_cast<int>(kind);
  }
}

// A variable of another fix may ask for a wall's force between the forces of atoms and the wall's.
TEST(found_contacts, of_the_last_step_count_until_the_next_one_starts)
{
  for (Engine kind : {Engine::found_first, test_on_cuda() ? Engine::cuda : Engine::one_pass}) {
    AllTouching all(kind);
    const std::vector<Vec3> x = all.x;
    for (int i = 0; i < all.n; i += 2) all.x[i].x += 100;
    all.choose();
    all.engine->start(all.spheres, all.step, nullptr);
    // More spheres than there was room for before, and other columns.
    all.x = x;
    all.choose();
    all.step.per_sphere = true;
    all.engine->mark_places();
    all.engine->search(all.spheres, all.step);
    EXPECT_EQ(all.engine->totals().contacts, all.n / 2 * kAllRound) << static_cast<int>(kind);
    all.engine->start(all.spheres, all.step, nullptr);
    EXPECT_EQ(all.engine->totals().contacts, all.n * kAllRound) << static_cast<int>(kind);
  }
}

// LAMMPS's buffers have room for so many numbers of an atom.
TEST(found_contacts, of_a_sphere_pack_into_no_more_than_any_sphere_can_have)
{
  AllTouching all(test_on_cuda() ? Engine::cuda : Engine::found_first);
  all.engine->start(all.spheres, all.step, nullptr);
  const int largest = all.engine->largest_packed_size(all.n);
  EXPECT_EQ(largest, 1 + kAllRound * SpringStore().doubles_per_spring());
  EXPECT_LE(largest, all.engine->most_packed_size());
}

TEST(found_contacts, of_an_engine_that_hands_results_back_are_its_results)
{
  using Law = OnWall<HertzHistoryLaw<Real>, false, false>;
  const ContactLaw p = classic(LawStyle::hertz_history);
  const Law law = {{{p.k_normal}, {p.gamma_normal}, {p.k_tangent, p.gamma_tangent, p.mu}, false}};
  TriangleSoup soup = faces_all_round(kAllRound);
  append(soup, box_mesh({20, 20, 20}, {30, 30, 30}));
  GridSettings g;
  g.reach = 1.1;
  g.nearest = 2;    // so that some answers are uncertain
  const FlatGrid grid(build_grid(weld(soup, -1), g));

  std::vector<Vec3> x;
  const Mixture m = {200, 100, 50};
  for (int i = 0; i < kSpheres; i++) x.push_back(place_in(m, i));
  const std::vector<Vec3> v(kSpheres, {0.1, 0.2, 0.3});
  const std::vector<Real> radius(kSpheres, 1.05), mass(kSpheres, 1);
  const std::vector<int> none(kSpheres, 0);
  Spheres spheres;
  spheres.n = kSpheres;
  spheres.x = &x[0].x;
  spheres.v = spheres.omega = &v[0].x;
  spheres.radius = radius.data();
  spheres.mass = mass.data();
  StepSettings step;
  step.dt = 1e-3;
  EngineSettings settings;
  settings.law = p;

  std::vector<SphereResult> result[2];
  std::vector<Spring> spring[2];
  for (bool first : {false, true}) {
    result[first].assign(kSpheres, SphereResult());
    spring[first].assign(kSpheres * kPlaces, Spring());
    LawJob job = job_of(grid.view(), force_settings(settings, step), spheres);
    return_results(job, result[first].data());
    job.springs.first = {none.data()};
    job.springs.count = {none.data()};
    job.sink.springs = spring[first].data();
    if (!first) {
      CpuBackend backend;
      start_law<Law>(LawBytes(law), job, kSpheres, backend);
      continue;
    }
    FindingFirst backend;
    FoundContacts<FindingFirst> found;
    found.reserve(backend, kSpheres);
    job.found = found.next(kSpheres);
    find_first(backend, job, kSpheres, 0);
    start_found_law<Law>(LawBytes(law), job, kSpheres, backend);
  }
  EXPECT_TRUE(same_bytes(result[0], result[1]));
  EXPECT_TRUE(same_bytes(spring[0], spring[1]));
  int single = 0, several = 0, overflow = 0, uncertain = 0;
  for (const SphereResult &r : result[1]) {
    single += r.n_contacts == 1;
    several += r.n_contacts > 1;
    overflow += r.n_contacts == kOverflow;
    uncertain += r.uncertain > 0;
  }
  EXPECT_GT(single, 100);
  EXPECT_GT(several + overflow, 20);
  EXPECT_GT(uncertain, 20);
}

}    // namespace
