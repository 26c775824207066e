// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall of several meshes acts as one: spheres feel each place once, whatever mesh it is of and
// whatever frame that is in.
#include "support/crowd.h"
#include "support/meshes.h"
#include "support/motions.h"
#include "support/named_laws.h"
#include "support/test_engine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lsdcd::test_several_meshes {
namespace {

constexpr Real kStiffness = 1e5, kRadius = 0.5, kMass = 2, kStep = 1e-4;

// Triangles dealt out to n meshes by turns.
std::vector<TriangleSoup> dealt(const TriangleSoup &soup, int n)
{
  std::vector<TriangleSoup> parts(n);
  for (std::size_t t = 0; t < soup.n_triangles(); t++) {
    TriangleSoup &part = parts[t % n];
    part.source = "part";
    part.corners.insert(part.corners.end(), soup.corners.begin() + 3 * t,
                        soup.corners.begin() + 3 * t + 3);
  }
  return parts;
}

// The pose of the m-th mesh; with `turned` each has another, else all are at rest.
Pose pose_of(int m, bool turned)
{
  if (!turned) return {};
  const RigidMotion motion = motion_of({turning({0.3 * m, 1, -2}, {1, 0.2 * m, -0.5}, 1)});
  return motion.pose_at(0.05 + 0.03 * m).still();
}

// A wall whose meshes lie in frames of their own and are placed so that they fit.
class Wall {
 public:
  Wall(std::vector<TriangleSoup> parts, Real cutoff, EngineSettings settings, bool turned) :
      turned_(turned)
  {
    settings.meshes = static_cast<int>(parts.size());
    StepGridSettings g;
    g.cutoff = cutoff;
    for (int m = 0; m < settings.meshes; m++) {
      for (Vec3 &p : parts[m].corners) p = pose_of(m, turned).to_mesh(p);
      grids_.emplace_back(build_grid(weld(parts[m], -1), g));
    }
    scene = std::make_unique<Scene>(parts[0], cutoff, settings);
    put_into(*scene->engine);
  }

  void put_into(WallEngine &engine) const
  {
    for (int m = 0; m < static_cast<int>(grids_.size()); m++) {
      engine.set_grid(grids_[m].view(), m);
      engine.set_pose(pose_of(m, turned_), m);
    }
  }

  std::unique_ptr<Scene> scene;

 private:
  bool turned_;
  std::vector<FlatOf<StepGrid>> grids_;
};

void add_crowd(Scene &to, const MeshReport &r, int n)
{
  std::mt19937_64 random(3);
  std::uniform_real_distribution<Real> place(-0.1, 1.1), speed(-3, 3);
  for (int i = 0; i < n; i++) {
    Vec3 x, v, omega;
    for (int d = 0; d < 3; d++) {
      x[d] = r.lo[d] + place(random) * (r.hi[d] - r.lo[d]);
      v[d] = speed(random);
      omega[d] = speed(random);
    }
    to.add_sphere(x, kRadius, kMass, v, omega);
  }
}

void move(Scene &s)
{
  for (int i = 0; i < s.n(); i++) s.set_x(i, s.x(i) + kStep * s.v(i));
  s.compute(kStep, true, true);
}

TEST(several_meshes, the_deepest_overlap_is_told_with_its_mesh_and_all_that_its_sphere_touches)
{
  std::vector<TriangleSoup> parts(3, floor_mesh(1, 3));
  for (Vec3 &p : parts[1].corners) p.z = 0.7;    // a gap of 0.7, and a floor far away
  for (Vec3 &p : parts[2].corners) p += Vec3{20, 0, 0};
  for (const bool turned : {false, true}) {
    Wall wall(parts, kRadius, laws(kStiffness).front().settings, turned);
    WallEngine &engine = *wall.scene->engine;
    SphereArrays spheres;
    const Vec3 begin[] = {{0, 0, 0.3}, {1, 1, 0.8}, {20, 0, 0.35}};    // 40 and 20 %, 80 %, 30 %
    for (const Vec3 &x : begin) spheres.add(x, kRadius);
    const struct {
      int sphere;
      Vec3 to;    // it goes there
      Real deepest;
      int of_sphere, mesh;
      std::uint32_t meshes;
    } rows[] = {{0, begin[0], 0.8, 1, 1, 2},
                {1, {1, 1, 5}, 0.4, 0, 0, 3},
                {0, {0, 0, 0.45}, 0.5, 0, 1, 3},    // 10 % and 50 %
                {0, {0, 0, 5}, 0.3, 2, 2, 4}};
    for (const auto &row : rows) {
      put_vector(spheres.x, row.sphere, row.to);
      engine.choose(spheres.spheres(), 0);
      engine.step(spheres.spheres(), StepSettings());
      const StepDiagnostics seen = engine.read_diagnostics();
      EXPECT_NEAR(seen.deepest, row.deepest, 1e-6);    // in float
      EXPECT_EQ(seen.deepest_sphere, row.of_sphere);
      EXPECT_EQ(seen.deepest_mesh, row.mesh);
      EXPECT_EQ(seen.deepest_meshes, row.meshes);
    }
  }
}

// The same triangles in one mesh, which share no corner, and dealt out to 32. Places of size 10 are
// rounded to 2e-15 by turning, which a stiffness of 1e5 to 1e6 (corners share their overlap, with
// angles as small as 1e-2) makes 1e-7 of forces of 1e4 at most.
void expect_as_one(bool turned, Real tolerance)
{
  const TriangleSoup soup = random_soup(600, 5);
  for (NamedLaw &law : laws(kStiffness)) {
    const Real cutoff = cutoff_of(law.settings.law(), kRadius);
    Scene one(soup, cutoff, law.settings);
    Wall wall(dealt(soup, kMaxMeshes), cutoff, law.settings, turned);
    Scene &several = *wall.scene;
    add_crowd(one, one.mesh.report, 500);
    add_crowd(several, one.mesh.report, 500);
    int touching = 0, joint = 0;
    for (int step = 0; step < 5; step++) {
      move(one);
      move(several);
    }
    for (int i = 0; i < one.n(); i++) {
      touching += one.springs.count(i) > 0;
      joint += one.springs.count(i) > 1;
      EXPECT_LE(norm(several.force(i) - one.force(i)), tolerance) << law.name << " " << i;
      EXPECT_LE(norm(several.torque(i) - one.torque(i)), tolerance) << law.name << " " << i;
      EXPECT_LE(std::fabs(several.heat(i) - one.heat(i)), tolerance) << law.name << " " << i;
      EXPECT_EQ(several.springs.count(i), one.springs.count(i)) << law.name << " " << i;
    }
    if (law.settings.law().has_history()) {
      EXPECT_GT(touching, 100) << law.name;
      EXPECT_GT(joint, 30) << law.name;
    }
    ASSERT_EQ(several.engine->results().n_touching(), one.engine->results().n_touching())
        << law.name;
    // A kernel with both effects keeps contacts that were not asked for.
    if (law.settings.contacts) {
      EXPECT_EQ(several.engine->results().n_contacts(), one.engine->results().n_contacts())
          << law.name;
    }
    EXPECT_EQ(several.engine->results().totals().contacts, one.engine->results().totals().contacts)
        << law.name;
  }
}

TEST(several_meshes, act_as_one_at_rest_and_in_frames_of_their_own)
{
  expect_as_one(false, 1e-7);
  expect_as_one(true, 1e-7);
}

// ---- seams -------------------------------------------------------------------------------------

// The triangles of a plane, each with a mesh of its own: the answer is the plane's k (R - h). Heights
// and normals of a floor at z = 0 are exact; in turned frames of size 10 both are rounded to 4e-15,
// against overlaps of 5e-4: 1e-11.
void expect_plane(bool turned, Real bound)
{
  constexpr Real kHalf = 4, kHeight = kRadius * (1 - 1e-3), rim = 0.9 * kHalf;
  const TriangleSoup floor = floor_mesh(4, kHalf, 1);
  ASSERT_EQ(floor.n_triangles(), static_cast<std::size_t>(kMaxMeshes));
  Wall wall(dealt(floor, kMaxMeshes), kRadius, hooke(kStiffness), turned);
  Scene &scene = *wall.scene;
  std::mt19937_64 random(1);
  std::uniform_real_distribution<Real> share(0, 1), far(-17, -6);
  for (int i = 0; i < 20000; i++) {
    const std::size_t t = 3 * (random() % floor.n_triangles()), k = random() % 3;
    const Vec3 a = floor.corners[t + k], b = floor.corners[t + (k + 1) % 3],
               c = floor.corners[t + (k + 2) % 3];
    Vec3 q = a;    // at a corner, along an edge, over a face
    const Real u = share(random);
    if (i % 4 > 0) q += u * (b - a);
    if (i % 4 > 2) q += share(random) * (1 - u) * (c - a);
    if (random() % 2) q += std::pow(10., far(random)) * Vec3{share(random), -share(random), 0};
    if (std::fabs(q.x) > rim || std::fabs(q.y) > rim) q = {0, 0, 0};
    q.z = i % 3 ? kHeight : -kHeight;
    scene.add_sphere(q, kRadius, 1);
  }
  scene.compute(kStep, true, true);
  EXPECT_EQ(scene.engine->results().n_touching(), scene.n()) << "a sphere fell through";
  const Real f0 = kStiffness * (kRadius - kHeight);
  for (int i = 0; i < scene.n(); i++) {
    const Vec3 f = scene.force(i);
    ASSERT_LE(std::fabs((scene.x(i).z > 0 ? f.z : -f.z) / f0 - 1), bound) << i;
    ASSERT_LE(std::hypot(f.x, f.y) / f0, bound) << i;
  }
}

TEST(several_meshes, have_seams_that_are_not_felt_at_rest_and_in_frames_of_their_own)
{
  expect_plane(false, 1e-12);
  expect_plane(true, 1e-10);
}

// Over the seam of two half planes along y, in other frames, and over one plane: 2000 steps in each
// of which rounding of places by 4e-15 times the stiffness turns speeds by 4e-15 k dt / m = 2e-14.
TEST(several_meshes, hand_springs_over_at_a_seam)
{
  constexpr int kSteps = 2000;
  const TriangleSoup floor = floor_mesh(2, 4);
  std::vector<TriangleSoup> halves(2);
  for (std::size_t t = 0; t < floor.corners.size(); t += 3) {
    const Real middle = floor.corners[t].y + floor.corners[t + 1].y + floor.corners[t + 2].y;
    TriangleSoup &half = halves[middle > 0];
    half.corners.insert(half.corners.end(), floor.corners.begin() + t,
                        floor.corners.begin() + t + 3);
  }
  for (const NamedLaw &law : laws(kStiffness)) {
    if (!law.settings.law().has_history()) continue;
    const Real cutoff = cutoff_of(law.settings.law(), kRadius);
    Scene one(floor, cutoff, law.settings);
    Wall wall(halves, cutoff, law.settings, true);
    for (Scene *s : {&one, wall.scene.get()})
      s->add_sphere({0.3, -0.01, kRadius - 1e-3}, kRadius, kMass, {0.02, 2, 0}, {0.3, 0, 0.4});
    for (int step = 0; step < kSteps; step++) {
      one.step(kStep, {0, 0, -9.81});
      wall.scene->step(kStep, {0, 0, -9.81});
    }
    EXPECT_GT(one.x(0).y, 0) << law.name << ": it does not cross the seam";
    EXPECT_LE(norm(wall.scene->x(0) - one.x(0)), 1e-10) << law.name;
    EXPECT_LE(norm(wall.scene->v(0) - one.v(0)), 1e-10) << law.name;
    EXPECT_LE(norm(wall.scene->omega(0) - one.omega(0)), 1e-10) << law.name;
  }
}

// ---- what is counted of each -------------------------------------------------------------------

TEST(several_meshes, in_one_place_are_felt_once)
{
  const TriangleSoup floor = floor_mesh(2, 4);
  Wall wall({floor, floor, floor}, kRadius, hooke(kStiffness), true);
  wall.scene->add_sphere({0.1, 0.2, 0.49}, kRadius, kMass);
  wall.scene->compute(kStep, true, true);
  // Heights of 0.49 are rounded to 4e-15 by turning.
  EXPECT_NEAR(wall.scene->force(0).z, kStiffness * 0.01, 1e-8);
  EXPECT_EQ(wall.scene->engine->results().totals().contacts, 1);
  EXPECT_EQ(wall.scene->engine->results().touching()[0].n_contacts, 1);
}

// A sphere in a right-angled corner of three plates, each with its own overlap.
class CornerOfPlates : public ::testing::Test {
 protected:
  static constexpr Real kOverlap[3] = {0.01, 0.02, 0.03};

  CornerOfPlates()
  {
    std::vector<TriangleSoup> plates(3);
    for (int m = 0; m < 3; m++)
      for (Vec3 p : floor_mesh(1, 2).corners)
        plates[m].corners.push_back(m == 0   ? Vec3{0, p.x + 2, p.y + 2}
                                    : m == 1 ? Vec3{p.x + 2, 0, p.y + 2}
                                             : Vec3{p.x + 2, p.y + 2, 0});
    EngineSettings s = hooke(kStiffness);
    s.contacts = true;
    wall = std::make_unique<Wall>(plates, kRadius, s, true);
    wall->scene->add_sphere({kRadius - kOverlap[0], kRadius - kOverlap[1], kRadius - kOverlap[2]},
                            kRadius, kMass);
    wall->scene->add_sphere({2, 2, kRadius - 0.05}, kRadius, kMass);    // on the third alone
    wall->scene->compute(kStep, true, true);
  }
  WallEngine &engine() { return *wall->scene->engine; }

  std::unique_ptr<Wall> wall;
};

TEST_F(CornerOfPlates, gives_each_plate_its_own_force_and_contacts_and_totals_of_all)
{
  for (int m = 0; m < 3; m++) {
    const WallTotals t = engine().results().mesh_totals(m);
    Vec3 expected = {0, 0, 0};
    expected[m] = -kStiffness * (kOverlap[m] + (m == 2 ? 0.05 : 0));
    EXPECT_LE(norm(t.force - expected), 1e-8) << m;
    EXPECT_EQ(t.contacts, m == 2 ? 2 : 1) << m;
  }
  const WallTotals all = engine().results().totals();
  EXPECT_LE(norm(all.force + kStiffness * Vec3{0.01, 0.02, 0.08}), 1e-8);
  EXPECT_EQ(all.contacts, 4);
}

TEST_F(CornerOfPlates, gives_one_output_for_a_sphere)
{
  ASSERT_EQ(engine().results().n_touching(), 2);
  for (int k = 0; k < 2; k++) {
    const TouchingSphere &out = engine().results().touching()[k];
    const bool in_corner = engine().results().touching()[k].sphere == 0;
    EXPECT_EQ(out.n_contacts, in_corner ? 3 : 1);
    EXPECT_LE(norm(out.force - wall->scene->force(engine().results().touching()[k].sphere)), 1e-12);
  }
}

TEST_F(CornerOfPlates, names_the_mesh_of_each_record)
{
  ASSERT_EQ(engine().results().n_contacts(), 4);
  Real normal[3] = {0, 0, 0};
  for (int k = 0; k < 4; k++)
    normal[engine().results().contacts()[k].mesh] += engine().results().contacts()[k].normal;
  for (int m = 0; m < 3; m++)
    EXPECT_NEAR(normal[m], kStiffness * (kOverlap[m] + (m == 2 ? 0.05 : 0)), 1e-8) << m;
}

// ---- many contacts, and choices that last -------------------------------------------------------

// 40 faces round a sphere touch it at once: more than a kernel's stack has room for.
TEST(several_meshes, with_more_contacts_than_a_stack_holds_act_as_one)
{
  const TriangleSoup soup = faces_all_round(40);
  EngineSettings s = hooke_history(kStiffness, 3e4, 50, 20, 0.4);
  s.corner = Corner::sum;
  Scene one(soup, 1.1, s);
  Wall wall(dealt(soup, 5), 1.1, s, true);
  for (Scene *scene : {&one, wall.scene.get()}) {
    scene->add_sphere({0.01, 0.02, -0.03}, 1.08, kMass, {1, 2, 3}, {3, -1, 2});
    for (int step = 0; step < 3; step++) move(*scene);
  }
  EXPECT_EQ(one.springs.count(0), 40);
  EXPECT_EQ(wall.scene->springs.count(0), one.springs.count(0));
  EXPECT_LE(norm(wall.scene->force(0) - one.force(0)), 1e-7);
  EXPECT_LE(norm(wall.scene->torque(0) - one.torque(0)), 1e-7);
}

// The forces on spheres that cross a wall in 200 steps, with a choice in every so many of these: they come near
// meshes and leave them, and their springs with them.
struct Crossing {
  std::vector<Real> force;
  int joint = 0;               // spheres with several springs at the end
  Vec3 on_mesh = {0, 0, 0};    // the force on mesh 1, summed over steps

  explicit Crossing(WallEngine &engine, int choice = 20)
  {
    constexpr int kSpheres = 400, kSteps = 200;
    std::mt19937_64 random(9);
    std::uniform_real_distribution<Real> place(-4.5, 4.5), speed(-30, 30);
    SphereArrays spheres(kSpheres, kRadius);
    spheres.mass.assign(kSpheres, kMass);
    spheres.temperature.assign(kSpheres, 300);    // read where the law has heat
    spheres.heat_flow.assign(kSpheres, 0);
    for (int c = 0; c < 3 * kSpheres; c++) {
      spheres.x[c] = place(random);
      spheres.v[c] = speed(random);
      spheres.omega[c] = speed(random);
    }
    std::vector<int> type(kSpheres);
    for (int i = 0; i < kSpheres; i++) type[i] = 1 + i % 3;
    const auto now = [&] {
      Spheres s = spheres.spheres();
      s.type = type.data();
      return s;
    };
    StepSettings step;
    step.dt = kStep;
    for (int t = 0; t < kSteps; t++) {
      spheres.clear_forces();
      if (t % choice == 0) engine.choose(now(), choice * kStep * 60);
      engine.step(now(), step);
      on_mesh += engine.results().mesh_totals(1).force;
      force.insert(force.end(), spheres.force.begin(), spheres.force.end());
      spheres.move(kStep);
    }
    ContactHistory springs;
    engine.springs().to_cpu(springs, kSpheres);
    for (int i = 0; i < kSpheres; i++) joint += springs.count(i) > 1;
  }
};

TEST(several_meshes, keep_springs_across_choices)
{
  const TriangleSoup soup = random_soup(600, 5);
  const EngineSettings s = hooke_history(kStiffness, 3e4, 50, 20, 0.4);
  Scene one(soup, kRadius, s);
  const Wall wall(dealt(soup, 7), kRadius, s, true);
  const Crossing expected(*one.engine), got(*wall.scene->engine);
  EXPECT_GT(expected.joint, 20);
  EXPECT_EQ(got.joint, expected.joint);
  // Shear displacements add up what places are rounded by, over contacts of up to 200 steps.
  for (std::size_t c = 0; c < expected.force.size(); c++)
    ASSERT_NEAR(got.force[c], expected.force[c], 1e-5);
}

// A sphere that touches one mesh is a candidate of that mesh alone, or of others too, as it was chosen at one time or another.
TEST(several_meshes, give_the_same_bits_whenever_spheres_are_chosen)
{
  for (NamedLaw &law : laws(kStiffness)) {
    EngineSettings &s = law.settings;
    if (!s.law().has_history()) continue;
    s.meshes = 7;
    const Wall wall(dealt(random_soup(600, 5), 7), cutoff_of(s.law(), kRadius), s, true);
    const auto often = make_test_engine(s), seldom = make_test_engine(s);
    wall.put_into(*often);
    wall.put_into(*seldom);
    const Crossing expected(*often, 2), got(*seldom, 40);
    EXPECT_TRUE(same_bytes(got.force, expected.force)) << law.name;
    EXPECT_EQ(got.on_mesh, expected.on_mesh) << law.name;
  }
}

// Types 1 and 3 are of kind 0, type 2 is of kind 1; each of 7 meshes has laws of its own.
EngineSettings with_laws(bool differ)
{
  EngineSettings s = hooke_history(kStiffness, 3e4, 50, 20, 0.4);
  s.meshes = 7;
  s.laws.kinds = 2;
  s.laws.kind_of_type = {0, 0, 1, 0};
  s.laws.laws.resize(14, s.law());
  for (int k = 0; differ && k < 14; k++) s.laws.laws[k].k_normal *= 1 + 0.1 * k;
  return s;
}

// Sums are over the same spheres in the same order.
TEST(several_meshes, act_the_same_through_a_mirror)
{
  EngineSettings one_law = hooke_history(kStiffness, 3e4, 50, 20, 0.4);
  one_law.meshes = 7;
  for (const EngineSettings &s : {one_law, with_laws(true)}) {
    const Wall wall(dealt(random_soup(600, 5), 7), kRadius, s, true);
    const auto mirrored = with_mirror(s), direct = on_cpu(s);
    wall.put_into(*mirrored);
    wall.put_into(*direct);
    const Crossing expected(*direct), got(*mirrored);
    EXPECT_TRUE(same_bytes(got.force, expected.force));
    EXPECT_EQ(got.joint, expected.joint);
    EXPECT_GT(expected.joint, 20);
    EXPECT_GT(norm(expected.on_mesh), 0);
    EXPECT_EQ(got.on_mesh, expected.on_mesh);
  }
}

TEST(several_meshes, with_equal_laws_act_as_with_one)
{
  EngineSettings s = with_laws(false), one = s;
  one.laws = s.law();
  const Wall wall(dealt(random_soup(600, 5), 7), kRadius, s, true);
  const auto first = on_cpu(one), second = on_cpu(s), third = on_cpu(with_laws(true));
  for (WallEngine *engine : {first.get(), second.get(), third.get()}) wall.put_into(*engine);
  const Crossing expected(*first), got(*second), other(*third);
  EXPECT_TRUE(same_bytes(got.force, expected.force));
  EXPECT_FALSE(same_bytes(other.force, expected.force));
}

}    // namespace
}    // namespace lsdcd::test_several_meshes
