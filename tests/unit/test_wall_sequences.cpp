// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Random sequences of running, changing, saving and restoring a wall, over all that a mesh can be: a wall that goes on from a saved
// state is the one that was never saved, to the bit, or says why not. LSDCD_SEQUENCES sets how many.
#include "base/input_error.h"
#include "input/wall_command.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/says.h"
#include "support/wall_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd::test_wall_sequences {
namespace {

constexpr Real kDt = 4e-4, kRadius = 0.3;

enum class Kind { rests, moves, servo, posed, body, coated, nodes, wears };
constexpr int kKinds = 8;
constexpr const char *kNames[kKinds] = {"rests", "moves",  "servo", "posed",
                                        "body",  "coated", "nodes", "wears"};

MotionTerm some_term(Random &random)
{
  MotionTerm term;
  if (uniform(random, 0, 1) < 0.5) {
    term.kind = MotionKind::wiggle;
    term.amplitude = 0.02 * random_unit(random);
    term.period = 0.1;
  } else {
    term.kind = MotionKind::rotate;
    term.axis = random_unit(random);
    term.period = uniform(random, 40, 80);
  }
  return term;
}

Servo some_servo(Random &random)
{
  Servo servo;
  servo.present = true;
  servo.target = uniform(random, -20, 20);
  servo.max_speed = 0.5;
  return servo;
}

// About a point, where it has one.
Joint some_joint(Random &random, const Vec3 &point)
{
  Joint joint;
  joint.kind = static_cast<JointKind>(static_cast<int>(uniform(random, 0, 5)));
  joint.axis = {0, 0, 1};
  joint.point = point;
  return joint;
}

// A mesh on which spheres lie: a floor, or a cube whose top is in its place.
MeshSpec mesh_of(Kind kind, Real x, Random &random)
{
  MeshSpec mesh;
  mesh.name = kNames[static_cast<int>(kind)];
  const bool is_body = kind == Kind::body || kind == Kind::coated;
  mesh.mesh = welded(is_body ? box_mesh({-1, -1, -2}, {1, 1, 0}) : floor_mesh(3, 2));
  if (kind == Kind::moves) mesh.motion.add(some_term(random));
  if (kind == Kind::servo) mesh.motion.servo() = some_servo(random);
  if (kind == Kind::posed) mesh.motion.begin_posed();
  mesh.has_nodes = kind == Kind::nodes;
  if (!is_body) return mesh;
  mesh.body.present = true;
  mesh.body.density = 2;
  mesh.body.joint = some_joint(random, {x, 0, 1});
  mesh.body.velocity = mesh.body.joint.kind == JointKind::free ? Vec3{0.1, 0, 0} : Vec3{0, 0, 0};
  if (kind == Kind::coated) mesh.body.coat = {true, 0.7, 0.1};
  return mesh;
}

std::vector<LawOfTypes> some_laws(Random &random)
{
  const char *const laws[] = {
      "hooke/history 1000 300 20 5 0.5 0",
      "hooke 1000 300 20 5 0.5 0",
      "granular hertz 1000 20 damping viscoelastic tangential mindlin 300 1 0.5 rolling sds 200 5 "
      "0.1 twisting marshall",
      "granular jkr 2000 0.5 0.3 5 damping viscoelastic tangential mindlin_rescale 300 1 0.5 "
      "rolling sds 200 5 0.1 twisting sds 20 1 0.1",
      "granular dmt 2000 0.5 0.3 5 damping mass_velocity tangential mindlin_rescale/force 300 1 "
      "0.5",
      "hertz/history 1000 300 20 5 0.5 0 rolling epsd2 0.1 cohesion sjkr 50"};
  const auto which = static_cast<std::size_t>(uniform(random, 0, std::size(laws) - 0.01));
  return parse_wall(words(std::string(laws[which]) + " mesh x.stl")).wall.laws;
}

// Meshes side by side. A coated body stands on a floor of its own, which is the next mesh.
WallSpec wall_of(const std::vector<Kind> &kinds, Random &random)
{
  WallSpec wall;
  wall.laws = some_laws(random);
  wall.energy = true;
  wall.impact_speed = 0.02;
  wall.device = Device::cpu;
  wall.average_every = 7;
  const bool wears = std::count(kinds.begin(), kinds.end(), Kind::wears) > 0;
  wall.wear = {wears ? WearModel::archard : WearModel::none, wears ? 1e-4 : 0.};
  if (wears) wall.wear_deform = {5, 3};
  Real x = 0;
  for (const Kind kind : kinds) {
    wall.meshes.push_back(mesh_of(kind, x, random));
    wall.meshes.back().placement.move({x, 0, 0});
    if (kind == Kind::coated) {
      wall.meshes.push_back(mesh_of(Kind::rests, x, random));
      wall.meshes.back().placement.move({x, 0, -2.095});
    }
    x += 6;
  }
  for (MeshSpec &mesh : wall.meshes) {
    mesh.fields = {mesh.name + std::to_string(&mesh - wall.meshes.data()) + "_*.vtp", 1000};
    if (wears) mesh.wear_factor = mesh.name == kNames[static_cast<int>(Kind::wears)] ? 1 : 0;
  }
  return wall;
}

struct World : WallScene {
  WallSpec words;    // of which a script would make the wall now
  bool look = true;

  World(FakeHost &host, const WallSpec &of) : WallScene(host, of, WallUnits(), kDt), words(of)
  {
    gravity[2] = -10;
  }

  // A host that moves meshes does so in each step.
  void set_meshes()
  {
    const Real t = static_cast<Real>(now) * dt;
    for (std::size_t k = 0; k < words.meshes.size(); k++) {
      const int mesh = static_cast<int>(k);
      if (words.meshes[k].motion.is_posed()) {
        Pose pose;
        pose.placed = true;
        pose.shift = {0, 0, 0.01 * std::sin(30 * t)};
        pose.velocity = {0, 0, 0.3 * std::cos(30 * t)};
        wall->set_pose(mesh, pose);
      }
      if (!words.meshes[k].has_nodes) continue;
      std::vector<Vec3> at, v;
      for (Vec3 x : words.meshes[k].mesh->vertices) {
        x += Vec3{6 * static_cast<Real>(k), 0, 0};
        x.z += 0.01 * std::sin(20 * t + x.x);
        at.push_back(x);
        v.push_back({0, 0, 0.2 * std::cos(20 * t + x.x)});
      }
      wall->set_nodes(mesh, &at[0].x, &v[0].x);
    }
  }

  void take_step(Step::Kind kind)
  {
    set_meshes();
    step(kind, std::exchange(look, false));
  }

  void go(int n)
  {
    for (int i = 0; i < n; i++) {
      kick();
      for (std::size_t k = 0; k < x.size(); k++) x[k] += dt * v[k];
      now++;
      take_step(Step::step);
      kick();
    }
  }

  // What became of energy at a mesh, and its impacts.
  std::vector<Real> books(int mesh)
  {
    const BookedEnergy e = wall->energy().mesh(mesh);
    std::vector<Real> all = {e.dt, wall->impacts(mesh).impacts(), wall->impacts(mesh).energy()};
    for (int k = 0; k < kEnergyRows; k++) all.insert(all.end(), {e.rows.of[k], e.step.of[k]});
    return all;
  }

  // All that the two must have the same.
  std::vector<Real> numbers()
  {
    std::vector<Real> all;
    const auto put = [&](const Vec3 &a) { all.insert(all.end(), {a.x, a.y, a.z}); };
    for (const std::vector<Vec3> *of : {&x, &v, &omega, &force, &torque})
      for (const Vec3 &a : *of) put(a);
    for (const MeshPart &m : wall->meshes()) {
      const MeshTotals &t = wall->totals().mesh(m.index);
      const MeanLoad &mean = wall->means().mesh(m.index);
      for (const Vec3 &a : {t.force, t.torque, mean.force, mean.torque, m.pose().shift}) put(a);
      all.insert(all.end(),
                 {t.contacts, t.power, t.energy, wall->worn(m.index), wall->removed(m.index)});
      for (const Real number : books(m.index)) all.push_back(number);
      for (const Vec3 &row : m.pose().row) put(row);
      for (const Vec3 &vertex : m.mesh()->vertices) put(vertex);
      if (!wall->body(m.index)) continue;
      const RigidBody &body = wall->body(m.index)->rigid();
      for (const Vec3 &a : {body.centre(), body.velocity(), body.omega()}) put(a);
    }
    return all;
  }
};

// What a program keeps of a world.
struct Saved {
  std::vector<Real> numbers;
  Grains grains;
  std::vector<std::vector<Real>> springs;
  std::int64_t now = 0;
};

Saved saved(World &from)
{
  Saved all = {from.wall->save().blocks().numbers(), from, {}, from.now};
  std::vector<Real> packed(1 + from.wall->history().max_packed_size());
  for (std::size_t i = 0; i < from.x.size(); i++) {
    const int n = from.wall->pack_saved(static_cast<int>(i), packed.data());
    all.springs.emplace_back(packed.begin(), packed.begin() + n);
  }
  return all;
}

// Returns what meshes keep beside what shows: springs of coats, wear that moves no vertex yet, and what became of energy at each
// triangle.
std::vector<Real> kept(Wall &wall)
{
  std::vector<Real> all;
  for (const MeshState &mesh : wall.save().meshes)
    for (const std::vector<Real> *of : {&mesh.coat, &mesh.surface.pending, &mesh.surface.held,
                                        &mesh.loads.rows, &mesh.energy_places, &mesh.impacts})
      all.insert(all.end(), of->begin(), of->end());
  return all;
}

// Another wall of these words that goes on from there, with the spheres of this process: each of as many as there are. `before`: a
// state that it gets first, of which nothing may stay; null: it gets none.
std::unique_ptr<World> restored(const Saved &from, FakeHost &host, const WallSpec &words,
                                const Saved *before = nullptr)
{
  auto to = std::make_unique<World>(host, words);
  to->now = from.now;
  std::vector<std::vector<Real>> springs;
  const Grains &all = from.grains;
  for (std::size_t i = 0; i < all.x.size(); i++) {
    if (static_cast<int>(i) % host.processes() != host.rank()) continue;
    to->add(all.x[i], all.radius[i]);
    to->tags.back() = all.tags[i];
    to->v.back() = all.v[i];
    to->omega.back() = all.omega[i];
    to->force.back() = all.force[i];
    to->torque.back() = all.torque[i];
    springs.push_back(from.springs[i]);
  }
  if (before) to->wall->keep_made();
  for (const Saved *state : {before, &from}) {
    if (!state) continue;
    host.warnings.clear();
    to->wall->restore(
        WallState::from(State(WallState::kKind, state->numbers.data(), state->numbers.size())),
        {state->now, kDt});
  }
  to->wall->restore_springs(springs);
  return to;
}

struct Went {
  std::vector<Vec3> x;    // of spheres by their tags
  std::vector<std::vector<Real>> books;
};

Went where(World &world)
{
  Went went;
  went.x.resize(world.x.size());
  for (std::size_t i = 0; i < went.x.size(); i++)
    went.x[static_cast<std::size_t>(world.tags[i] - 1)] = world.x[i];
  for (const MeshPart &m : world.wall->meshes()) went.books.push_back(world.books(m.index));
  return went;
}

// But for sums, which processes round otherwise.
void expect_same(const Went &a, const Went &b, const std::string &text)
{
  for (std::size_t i = 0; i < a.x.size(); i++) EXPECT_NEAR(norm(a.x[i] - b.x[i]), 0, 1e-10) << text;
  for (std::size_t k = 0; k < a.books.size(); k++)
    for (std::size_t i = 0; i < a.books[k].size(); i++)
      EXPECT_NEAR(a.books[k][i], b.books[k][i], 1e-8) << text << ", book " << i << " of mesh " << k;
}

// Goes on with two processes, and with one again.
Went on_others(const Saved &from, const WallSpec &words, const Saved *before, int steps)
{
  std::vector<Saved> parts(2);
  on_processes(2, [&](FakeHost &host) {
    const std::unique_ptr<World> world = restored(from, host, words, before);
    world->go(steps);
    parts[static_cast<std::size_t>(host.rank())] = saved(*world);
  });
  Saved all = parts[0];
  for (std::size_t i = 0; i < parts[1].grains.x.size(); i++) {
    const Grains &g = parts[1].grains;
    all.grains.add(g.x[i], g.radius[i]);
    all.grains.tags.back() = g.tags[i];
    all.grains.v.back() = g.v[i];
    all.grains.omega.back() = g.omega[i];
    all.grains.force.back() = g.force[i];
    all.grains.torque.back() = g.torque[i];
    all.springs.push_back(parts[1].springs[i]);
  }
  FakeHost host;
  const std::unique_ptr<World> world = restored(all, host, words);
  world->go(steps);
  return where(*world);
}

void add_spheres(World &world, std::size_t kinds, Random &random)
{
  for (std::size_t k = 0; k < kinds; k++)
    for (int i = 0; i < 3; i++) {
      world.add(
          {6 * static_cast<Real>(k) + (i - 1) * 0.62, uniform(random, -0.4, 0.4), kRadius - 1e-3},
          kRadius);
      world.v.back() = uniform(random, {-0.3, -0.3, -0.3}, {0.3, 0.3, 0});
      world.omega.back() = random_unit(random);
    }
}

// A change of a mesh, of the wall and of the words.
void change(World &world, std::size_t mesh, Random random)
{
  MeshSpec &words = world.words.meshes[mesh];
  const int m = static_cast<int>(mesh);
  const bool ends = uniform(random, 0, 1) < 0.3;
  if (words.body.present) {
    BodySpec to = words.body;
    if (ends) {
      to.joint = some_joint(random, to.joint.point);
      to.velocity = {0, 0, 0};
    }
    to.load = uniform(random, {-5, -5, -5}, {5, 5, 5});
    world.wall->set_body(m, to);
    words.body = to;
  } else if (words.motion.servo().present) {
    const Servo to = ends ? Servo() : some_servo(random);
    world.wall->set_servo(m, to);
    words.motion.servo() = to;
  } else {
    RigidMotion to;
    if (!ends) to.add(some_term(random));
    world.wall->set_motion(m, to, {world.now, kDt});
    words.motion = to;
  }
}

void try_sequence(unsigned seed, std::string &text)
{
  Random random(seed);
  std::vector<Kind> kinds;
  const int n = 1 + static_cast<int>(uniform(random, 0, 2.99));
  for (int k = 0; k < n; k++) {
    const Kind kind = static_cast<Kind>(static_cast<int>(uniform(random, 0, kKinds - 0.01)));
    const auto has = [&](Kind of) { return std::count(kinds.begin(), kinds.end(), of) > 0; };
    const bool no_nodes = kind == Kind::nodes && has(Kind::coated),
               no_coat = kind == Kind::coated && has(Kind::nodes);
    if (!no_nodes && !no_coat) kinds.push_back(kind);    // a coat and nodes refuse each other
  }
  text = "seed " + std::to_string(seed) + ":";
  for (const Kind kind : kinds) text += std::string(" ") + kNames[static_cast<int>(kind)];
  const WallSpec spec = wall_of(kinds, random);
  FakeHost host;
  World whole(host, spec);
  add_spheres(whole, kinds.size(), random);
  whole.wall->begin_run(0, false);
  whole.take_step(Step::setup);
  std::vector<std::unique_ptr<FakeHost>> hosts;
  std::unique_ptr<World> other;    // that is saved and restored
  std::vector<Saved> states;
  for (int k = 0; k < 5; k++) {
    const Real what = uniform(random, 0, 1);
    if (!other || what < 0.3) {
      const int steps = static_cast<int>(uniform(random, 1, 15));
      text += " run " + std::to_string(steps);
      whole.go(steps);
      if (other) other->go(steps);
    } else if (what < 0.55) {
      const std::size_t mesh = static_cast<std::size_t>(
          uniform(random, 0, static_cast<Real>(spec.meshes.size()) - 0.01));
      text += " change " + std::to_string(mesh);
      const unsigned of = static_cast<unsigned>(uniform(random, 0, 1e9));
      const std::string why = error_of([&] { change(whole, mesh, Random(of)); });
      ASSERT_EQ(why, error_of([&] { change(*other, mesh, Random(of)); })) << text;
      if (!why.empty()) text += " (" + why + ")";
    }
    if (what >= 0.55 || !other) {
      text += " restore";
      World &from = other ? *other : whole;
      hosts.push_back(std::make_unique<FakeHost>());
      states.push_back(saved(from));
      const std::size_t before =
          static_cast<std::size_t>(uniform(random, 0, 2 * static_cast<Real>(states.size()) - 0.01));
      std::unique_ptr<World> next = restored(states.back(), *hosts.back(), from.words,
                                             before < states.size() ? &states[before] : nullptr);
      other = std::move(next);
      for (const std::string &warning : hosts.back()->warnings)
        if (warning.find("was written with") != std::string::npos) return;    // it says why not
    }
  }
  whole.go(10);
  other->go(10);
  ASSERT_EQ(whole.numbers(), other->numbers()) << text;
  ASSERT_EQ(kept(*whole.wall), kept(*other->wall)) << text;
  const Went there = on_others(saved(whole), whole.words, &states.front(), 5);
  whole.go(10);
  expect_same(there, where(whole), text);
}

TEST(wall_sequences, go_on_from_saved_states_to_the_bit_or_say_why_not)
{
  const char *const given = std::getenv("LSDCD_SEQUENCES");
  const unsigned n = given ? static_cast<unsigned>(std::atoi(given)) : 20;
  for (unsigned seed = 1; seed <= n && !HasFatalFailure(); seed++) {
    std::string text;
    try {
      try_sequence(seed, text);
    } catch (const InputError &e) {
      ADD_FAILURE() << text << ": " << e.what();
    }
  }
}

// Springs of coats are in the saved state. A coat and nodes refuse each other.
TEST(wall_sequences, coats_go_on_beside_all_other_meshes_and_by_all_joints)
{
  for (int joint = 0; joint < 5; joint++)
    for (const Kind kind :
         {Kind::moves, Kind::servo, Kind::posed, Kind::body, Kind::coated, Kind::wears}) {
      Random random(static_cast<unsigned>(joint));
      WallSpec words = wall_of({Kind::coated, kind}, random);
      for (MeshSpec &mesh : words.meshes)
        if (mesh.body.present) mesh.body.joint.kind = static_cast<JointKind>(joint);
      for (MeshSpec &mesh : words.meshes)
        if (mesh.body.present) mesh.body.velocity = joint == 0 ? Vec3{0.1, 0, 0} : Vec3{0, 0, 0};
      FakeHost host, other_host;
      World whole(host, words);
      add_spheres(whole, 2, random);
      whole.take_step(Step::setup);
      whole.go(15);
      const Saved state = saved(whole);
      const std::string text =
          "joint " + std::to_string(joint) + " beside " + kNames[static_cast<int>(kind)];
      const std::unique_ptr<World> other = restored(state, other_host, words);
      EXPECT_TRUE(other_host.warnings.empty()) << text << ": " << other_host.warnings.front();
      EXPECT_GT(whole.wall->save().meshes[0].coat.size(), 2u) << text << ": no springs";
      whole.go(10);
      other->go(10);
      EXPECT_EQ(whole.numbers(), other->numbers()) << text;
      EXPECT_EQ(kept(*whole.wall), kept(*other->wall)) << text;
      if (joint != static_cast<int>(kind) % 5) continue;    // enough of them
      expect_same(on_others(state, words, nullptr, 5), where(whole), text);
    }
}

// Those of the same words, and of others.
TEST(wall_sequences, keep_nothing_of_a_state_that_another_one_replaces)
{
  std::vector<Saved> states;
  std::vector<WallSpec> words;
  for (int kind = 0; kind < kKinds; kind++) {
    Random random(1);
    FakeHost host;
    words.push_back(wall_of({static_cast<Kind>(kind)}, random));
    World world(host, words.back());
    add_spheres(world, 1, random);
    world.take_step(Step::setup);
    world.go(20);
    states.push_back(saved(world));
    if (static_cast<Kind>(kind) != Kind::moves) continue;
    world.wall->set_motion(0, RigidMotion(), {world.now, kDt});
    world.go(5);
    states.push_back(saved(world));
  }
  for (std::size_t kind = 0; kind < words.size(); kind++) {
    const Saved &state = states[kind + (kind > static_cast<std::size_t>(Kind::moves))];
    FakeHost host;
    const std::unique_ptr<World> once = restored(state, host, words[kind]);
    once->go(8);
    for (std::size_t before = 0; before < states.size(); before++) {
      FakeHost other_host;
      const std::unique_ptr<World> twice =
          restored(state, other_host, words[kind], &states[before]);
      twice->go(8);
      EXPECT_EQ(once->numbers(), twice->numbers())
          << kNames[kind] << " after state " << before << " of " << states.size();
      EXPECT_EQ(host.warnings, other_host.warnings) << kNames[kind] << " after state " << before;
    }
  }
}

// What one kind of mesh has saved and another one does not take over is told.
TEST(wall_sequences, say_what_of_a_saved_state_another_wall_does_not_have)
{
  for (int was = 0; was < kKinds; was++)
    for (int is = 0; is < kKinds; is++) {
      const std::string text = std::string(kNames[was]) + " becomes " + kNames[is];
      Random random(1);
      FakeHost host, other_host;
      World from(host, wall_of({static_cast<Kind>(was)}, random));
      add_spheres(from, 1, random);
      from.take_step(Step::setup);
      from.go(30);
      Random anew(1);
      WallSpec words = wall_of({static_cast<Kind>(is)}, anew);
      for (std::size_t k = 0; k < std::min(words.meshes.size(), from.words.meshes.size()); k++)
        words.meshes[k].mesh = from.words.meshes[k].mesh;
      if (words.meshes[0].body.present && !from.words.meshes[0].mesh->report.closed) continue;
      std::unique_ptr<World> to = restored(saved(from), other_host, words);
      const std::string told =
          other_host.warnings.empty() ? "nothing" : other_host.warnings.front();
      const bool has_nothing = was == static_cast<int>(Kind::rests),
                 is_taken = (was == is) || (was == static_cast<int>(Kind::coated) &&
                                            is == static_cast<int>(Kind::body));
      EXPECT_TRUE(was != is || told == "nothing") << text << ": " << told;
      EXPECT_TRUE(has_nothing || is_taken || told != "nothing") << text;
      to->go(2);
      if (is == static_cast<int>(Kind::coated)) continue;
      for (const MeshState &mesh : to->wall->save().meshes)
        EXPECT_EQ(mesh.last.front().coat.contacts, 0) << text << ": a coat that is gone acts on";
    }
}

// All parts are checked before any is restored.
TEST(wall_sequences, change_nothing_where_one_mesh_refuses_a_saved_state)
{
  Random random(1);
  FakeHost host, other_host;
  World from(host, wall_of({Kind::moves, Kind::servo}, random));
  add_spheres(from, 2, random);
  from.take_step(Step::setup);
  from.go(20);
  WallSpec words = from.words;
  Servo &servo = words.meshes[1].motion.servo();
  const Real at = from.wall->meshes()[1].servo().position;
  ASSERT_NE(at, 0);
  servo.lo = std::min<Real>(at / 2, -1e-9);
  servo.hi = std::max<Real>(at / 2, 1e-9);
  World to(other_host, words);
  const std::vector<Real> before = to.wall->save().blocks().numbers();
  EXPECT_THROW(to.wall->restore(from.wall->save(), {from.now, kDt}), InputError);
  EXPECT_EQ(to.wall->save().blocks().numbers(), before);
  EXPECT_TRUE(other_host.warnings.empty());
}

}    // namespace
}    // namespace lsdcd::test_wall_sequences
