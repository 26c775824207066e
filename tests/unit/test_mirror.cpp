// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Engines with arrays of their own: springs and indices across choices of other candidates, where the host's arrays are
// elsewhere. That they give what an engine in place gives is in test_engine.cpp.
#include "support/crowd.h"
#include "support/kept_springs.h"
#include "support/test_engine.h"

#include <gtest/gtest.h>

namespace lsdcd::test_mirror {
namespace {

// A floor at z = 0 with spheres on it, and an engine in place beside one with a mirror: each fact is
// one about what both say.
class Pair {
 public:
  Pair()
  {
    settings_.law() = classic(NormalModel::hertz, true);
    StepGridSettings g;
    g.cutoff = 0.5;
    flat_ = FlatOf(build_grid(weld(floor_mesh(10, 5, 3), -1), g));
    mirrored = with_mirror(settings_);
    direct = on_cpu(settings_);
    spheres_.v.assign(3 * kSpheres, 0.1);
    spheres_.omega = spheres_.v;
    set_grid();
  }
  void set_grid()
  {
    for (WallEngine *e : both()) e->set_grid(flat_.view());
  }
  // Four spheres in a row, one of them deeper than the others; `touching`: bits, the others are far.
  void place(int touching, int deepest)
  {
    for (int i = 0; i < kSpheres; i++) {
      const Real z = touching >> i & 1 ? (i == deepest ? 0.4 : 0.45) : 4;
      put_vector(spheres_.x, i, {0.3 * i, 0.1, z});
    }
  }
  void choose(Real margin = 0, bool watch = false)
  {
    for (WallEngine *e : both()) e->choose(spheres(force_[0]), margin, watch);
  }
  void step()
  {
    StepSettings s;
    s.dt = 1e-3;
    for (int k = 0; k < 2; k++) {
      force_[k].assign(6 * kSpheres, 0);
      both()[k]->step(spheres(force_[k]), s);
    }
  }
  void move(int i, const Vec3 &by) { put_vector(spheres_.x, i, vector_at(spheres_.x, i) + by); }
  bool same_forces() const { return same_bytes(force_[0], force_[1]); }
  // The shear of sphere i's one contact, 0 where it has none, by the engine in place and by the one with a mirror.
  Real shear(int engine, int i)
  {
    ContactHistory store;
    both()[engine]->springs().to_cpu(store, kSpheres);
    return store.count(i) == 0 ? 0 : norm(store.spring(i, 0).shear);
  }
  void expect_same_springs()
  {
    for (int i = 0; i < kSpheres; i++) EXPECT_EQ(shear(0, i), shear(1, i)) << "sphere " << i;
  }
  bool has_moved() { return mirrored->has_moved(spheres(force_[0])); }
  std::vector<WallEngine *> both() { return {direct.get(), mirrored.get()}; }

  static constexpr int kSpheres = 4;
  std::unique_ptr<WallEngine> mirrored, direct;

 private:
  Spheres spheres(std::vector<Real> &force)
  {
    force.resize(6 * kSpheres);
    Spheres s = spheres_.spheres();
    s.force = force.data();
    s.torque = force.data() + 3 * kSpheres;
    return s;
  }

  EngineSettings settings_;
  FlatOf<StepGrid> flat_;
  SphereArrays spheres_ = SphereArrays(kSpheres, 0.5);
  std::vector<Real> force_[2];    // and torques
};

TEST(mirror, springs_that_were_asked_for_are_still_there_in_the_next_step)
{
  Pair p;
  p.place(0b0101, 0);
  p.choose();
  for (int k = 0; k < 4; k++) {
    p.step();
    p.expect_same_springs();
    EXPECT_TRUE(p.same_forces()) << k;
  }
  EXPECT_GT(p.shear(1, 2), 0);
}

TEST(mirror, springs_that_are_given_replace_those_it_has)
{
  Pair p;
  p.place(0b0111, 0);
  p.choose();
  for (int k = 0; k < 3; k++) p.step();
  // As after a restart: 0 and 2 have changed places, 1 is new.
  ContactHistory had, given;
  p.direct->springs().to_cpu(had, Pair::kSpheres);
  given.grow(Pair::kSpheres);
  give_springs(given, 0, springs_of(had, 2));
  give_springs(given, 2, springs_of(had, 0));
  for (WallEngine *e : p.both()) e->springs().from_cpu(given, Pair::kSpheres);
  EXPECT_GT(p.shear(1, 0), 0);
  EXPECT_EQ(p.shear(1, 1), 0);
  p.expect_same_springs();    // before the step that takes them
  p.step();
  EXPECT_TRUE(p.same_forces());
  EXPECT_GT(p.shear(1, 2), 2 * p.shear(1, 1));
  p.expect_same_springs();
  p.choose();
  p.step();
  p.expect_same_springs();
}

TEST(mirror, springs_survive_another_grid)
{
  Pair p;
  p.place(0b1010, 3);
  p.choose();
  for (int k = 0; k < 3; k++) p.step();
  const Real before = p.shear(0, 3);    // the springs are with the engine
  p.set_grid();
  EXPECT_EQ(p.shear(1, 3), before);
  p.choose();
  p.step();
  EXPECT_TRUE(p.same_forces());
  EXPECT_GT(p.shear(1, 3), 1.3 * before);
  p.expect_same_springs();
}

TEST(mirror, says_that_spheres_have_moved_past_the_margin_alone)
{
  Pair p;
  p.place(0b0001, 0);
  p.choose(0.1, true);
  EXPECT_FALSE(p.has_moved());
  p.move(0, {0.06, 0.06, 0});
  EXPECT_FALSE(p.has_moved());
  p.move(0, {0.02, 0.02, 0});
  EXPECT_TRUE(p.has_moved());
}

TEST(mirror, says_that_a_sphere_has_moved_once_it_is_at_the_wall)
{
  Pair p;
  p.place(0b0001, 0);
  p.choose(0.1, true);
  p.move(2, {0, 0, 3});
  EXPECT_FALSE(p.has_moved());
  p.move(2, {0, 0, -6.55});
  EXPECT_TRUE(p.has_moved());
  p.choose(0.1, true);
  EXPECT_FALSE(p.has_moved());
}

TEST(mirror, says_that_a_sphere_at_no_number_has_moved)
{
  Pair p;
  p.place(0b0001, 0);
  p.choose(0.1, true);
  p.move(2, {0, 0, std::nan("")});
  EXPECT_TRUE(p.has_moved());
}

// Other fixes ask for the last step's totals when spheres are chosen already.
TEST(mirror, totals_of_the_last_step_name_its_sphere_after_another_choice_or_grid)
{
  for (const bool grid : {false, true}) {
    Pair p;
    p.place(0b1100, 3);
    p.choose();
    p.step();
    p.place(0b0011, 0);
    grid ? p.set_grid() : p.choose();
    for (WallEngine *e : p.both()) EXPECT_EQ(e->results().totals().largest_overlap_sphere, 3);
  }
}

TEST(mirror, notes_name_the_sphere_of_the_deepest_overlap_after_another_choice)
{
  Pair p;
  p.place(0b1100, 3);
  p.choose();
  p.step();
  p.place(0b0011, -1);
  p.choose();
  p.step();
  for (WallEngine *e : p.both()) {
    const StepDiagnostics diagnostics = e->read_diagnostics();
    EXPECT_EQ(diagnostics.deepest_sphere, 3);
    EXPECT_NEAR(diagnostics.deepest, 0.2, 1e-7);    // it is kept in single precision
    EXPECT_EQ(e->read_diagnostics().deepest_sphere, -1);
  }
}

}    // namespace
}    // namespace lsdcd::test_mirror
