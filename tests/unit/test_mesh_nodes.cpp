// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Walls whose nodes move, against rigid walls, brute force and laws of conservation.
//   LSDCD_PAIRS  steps of spheres over nodes that move at random, a tenth of it; 1e6 unless given, or 1e7 on a GPU
//   LSDCD_SEED   the first seed of these, so that several processes can share a large sample; 1 unless given
#include "base/input_error.h"
#include "engine/results/sum_unit.h"
#include "mesh/mesh_features.h"
#include "output/mesh_image.h"
#include "support/brute_force.h"
#include "support/device.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/motions.h"
#include "support/query_oracle.h"
#include "support/random.h"
#include "support/says.h"
#include "support/test_engine.h"
#include "support/wall_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace lsdcd::test_mesh_nodes {
namespace {

constexpr Real kDt = 1e-3, kRadius = 0.5;

WallSpec wall_of(const ContactLaw &law, const std::shared_ptr<const WeldedMesh> &mesh)
{
  WallSpec wall;
  wall.laws.front().law = law;
  wall.device = Device::cpu;
  wall.meshes.resize(1);
  wall.meshes.front().name = "sheet";
  wall.meshes.front().mesh = mesh;
  return wall;
}
WallSpec nodes_of(const ContactLaw &law, const std::shared_ptr<const WeldedMesh> &mesh)
{
  WallSpec wall = wall_of(law, mesh);
  wall.meshes.front().has_nodes = true;
  return wall;
}
// Frictional, with springs, rolling and twisting: all that a contact reads of a wall's motion.
ContactLaw all_motions()
{
  ContactLaw law = granular_law(NormalModel::hertz);
  law.k_normal = 1e4;
  law.modulus = 7.5e3;
  law.damping = DampingModel::velocity;
  law.eta = 5;
  law.tangential = TangentialModel::linear_history;
  law.k_tangent = 3e3;
  law.xgammat = 0.5;
  law.mu = 0.3;
  law.rolling = RollingModel::sds;
  law.rolling.numbers[0] = 500;
  law.rolling.numbers[1] = 10;
  law.rolling.numbers[2] = 0.1;
  law.twisting = TwistingModel::sds;
  law.twisting.numbers[0] = 500;
  law.twisting.numbers[1] = 10;
  law.twisting.numbers[2] = 0.1;
  return law;
}

// The engine that LSDCD_TEST_DEVICE names.
WallBackend tested()
{
  WallBackend backend;
  backend.make_engine = make_test_engine;
  return backend;
}
WallBackend cpu()
{
  WallBackend backend;
  backend.make_engine = on_cpu;
  return backend;
}

struct Scene : WallScene {
  explicit Scene(const WallSpec &spec, Real dt = kDt, const WallBackend &on = tested()) :
      WallScene(spec, WallUnits(), dt, on)
  {
  }
  Scene(FakeHost &host, const WallSpec &spec, Real dt = kDt, const WallBackend &on = tested()) :
      WallScene(host, spec, WallUnits(), dt, on)
  {
  }

  void next() { run(1); }
  // Sets up a run where i is 0, and steps else.
  void proceed(int i) { i == 0 ? set_up() : next(); }
  void set_nodes(const std::vector<Vec3> &at, const std::vector<Vec3> &velocity)
  {
    wall->set_nodes(0, &at[0].x, velocity.empty() ? nullptr : &velocity[0].x);
  }
  const std::vector<Vec3> &nodes() const { return wall->meshes()[0].mesh()->vertices; }
  Vec3 node_force(std::size_t i)
  {
    const std::vector<Real> &f = wall->node_forces(0);
    return {f[3 * i], f[3 * i + 1], f[3 * i + 2]};
  }
  Vec3 sum_of_nodes()
  {
    Vec3 sum = {0, 0, 0};
    for (std::size_t i = 0; i < nodes().size(); i++) sum += node_force(i);
    return sum;
  }
};

// Nodes as a pose has them, with the velocities of half a step ago where spheres have these.
struct PosedNodes {
  std::vector<Vec3> at, velocity;

  PosedNodes(const WeldedMesh &mesh, const Pose &pose, Real back)
  {
    const Vec3 v = pose.velocity - back * pose.acceleration, w = pose.angular - back * pose.spin_up;
    for (const Vec3 &x : mesh.vertices) {
      at.push_back(pose.to_box(x));
      const Vec3 turning = cross(w, at.back() - pose.shift);
      velocity.push_back(v + turning - back * cross(w, turning));
    }
  }
};

// Steps a wall with this motion and one whose nodes go the same way, with the same spheres, and returns the largest
// difference of forces and torques, over the largest of these.
Real worst_difference(const ContactLaw &law, const std::shared_ptr<const WeldedMesh> &mesh,
                      const MotionTerm &term, const std::vector<Vec3> &places, int n_steps,
                      Real &largest)
{
  WallSpec moving = wall_of(law, mesh);
  moving.meshes.front().motion.add(term);
  const RigidMotion motion = motion_of({term});
  Scene rigid(moving), nodes(nodes_of(law, mesh));
  Random random(7);
  for (const Vec3 &x : places) {
    rigid.add(x);
    rigid.v.back() = 0.3 * random_unit(random);
    rigid.omega.back() = 2 * random_unit(random);
  }
  static_cast<Grains &>(nodes) = rigid;
  Real worst = 0;
  largest = 0;
  for (int i = 0; i <= n_steps; i++) {
    const PosedNodes at(*mesh, motion.pose_at(i * kDt), i > 0 ? kDt / 2 : 0);
    nodes.set_nodes(at.at, at.velocity);
    if (i == 0) {
      rigid.set_up();
      nodes.set_up();
    } else {
      for (std::size_t k = 0; k < places.size(); k++) {
        rigid.x[k] += kDt * rigid.v[k];
        nodes.x[k] = rigid.x[k];
      }
      rigid.next();
      nodes.next();
    }
    for (std::size_t k = 0; k < places.size(); k++) {
      largest = std::max({largest, norm(rigid.force[k]), norm(rigid.torque[k])});
      worst = std::max(
          {worst, norm(rigid.force[k] - nodes.force[k]), norm(rigid.torque[k] - nodes.torque[k])});
    }
  }
  return worst / largest;
}

// A sheet of n x n squares over [-1, 1]^2, curved so that each of its edges is a fold.
TriangleSoup curved_sheet(int n)
{
  TriangleSoup soup = floor_mesh(n, 1);
  for (Vec3 &x : soup.corners) x.z = 0.2 * std::sin(2 * x.x) + 0.15 * std::cos(3 * x.y + x.x);
  return soup;
}

std::vector<Vec3> places_over(const WeldedMesh &mesh, int n, Real depth)
{
  std::vector<Vec3> places;
  Random random(3);
  for (int i = 0; i < n; i++) {
    const auto &face = mesh.faces[i * mesh.faces.size() / n];
    const Vec3 &a = mesh.vertices[face[0]], &b = mesh.vertices[face[1]],
               &c = mesh.vertices[face[2]];
    const Real u = uniform(random, 0, 1), w = uniform(random, 0, 1 - u);
    const Vec3 normal = unit(cross(b - a, c - a));
    places.push_back(a + u * (b - a) + w * (c - a) + (i % 2 ? 1 : -1) * (kRadius - depth) * normal);
  }
  return places;
}
}    // namespace

// ---- rigid motions -----------------------------------------------------------------------

// Damping, slip and springs are those of the motion: the records are turned in one case and the spheres in the other,
// so that they differ by the rounding of places, 1e-16 of 2 over an overlap of 0.01. Rolling and twisting see the spin
// of the nodes, right to a^2/12 of a turn by a, which is 3e-3 in a step here.
TEST(mesh_nodes, that_turn_as_one_give_the_forces_of_a_motion)
{
  const auto mesh = welded(curved_sheet(6));
  const MotionTerm term = turning({0.2, 0.1, 0}, {1, 2, 3}, 2, {0.05, -0.1, 0.02});
  const auto places = places_over(*mesh, 40, 0.01);
  ContactLaw slip = all_motions();
  slip.rolling = RollingModel::none;
  slip.twisting = TwistingModel::none;
  Real largest = 0;
  EXPECT_LT(worst_difference(slip, mesh, term, places, 200, largest), 1e-12);
  EXPECT_GT(largest, 1);
  EXPECT_LT(worst_difference(all_motions(), mesh, term, places, 200, largest), 1e-6);
}

// A plate that is bent by its nodes, and the bent plate as a rigid mesh: only the order of contacts may differ.
TEST(mesh_nodes, that_bend_a_plate_make_it_the_bent_plate)
{
  const auto flat = welded(floor_mesh(8, 1));
  const ContactLaw law = hooke(1000, 20, 30, 0.4).law();
  Scene nodes(nodes_of(law, flat));
  Random random(11);
  for (int k = 0; k < 60; k++) {
    nodes.add({uniform(random, -1.2, 1.2), uniform(random, -1.2, 1.2), uniform(random, -0.8, 0.8)});
    nodes.v.back() = random_unit(random);
    nodes.omega.back() = random_unit(random);
  }
  int touching = 0;
  for (int i = 0; i <= 20; i++) {
    std::vector<Vec3> at = flat->vertices;
    for (Vec3 &x : at) x.z = 0.02 * i * std::sin(2 * x.x + x.y) + 0.01 * i * x.y * x.y;
    nodes.set_nodes(at, {});
    nodes.proceed(i);

    TriangleSoup bent;
    for (const auto &face : flat->faces)
      for (const int v : face) bent.corners.push_back(at[v]);
    Scene rigid(wall_of(law, welded(bent)));
    static_cast<Grains &>(rigid) = nodes;
    rigid.set_up();
    for (std::size_t k = 0; k < nodes.x.size(); k++) {
      EXPECT_LE(norm(nodes.force[k] - rigid.force[k]), 1e-13 * 1000 * kRadius) << i << " " << k;
      EXPECT_LE(norm(nodes.torque[k] - rigid.torque[k]), 1e-13 * 1000 * kRadius) << i << " " << k;
      touching += norm(rigid.force[k]) > 0;
    }
  }
  EXPECT_GT(touching, 200);
}

// A sheet of nodes beside a rigid mesh, in either order: spheres that touch both share their overlap as between two
// rigid meshes. Where contacts of one sphere are in another order, sums are rounded otherwise.
TEST(mesh_nodes, share_contacts_with_rigid_meshes_of_their_wall)
{
  const auto sheet = welded(curved_sheet(5)),
             box = welded(box_mesh({-0.3, -0.4, -0.5}, {0.5, 0.4, 0.3}));
  for (const bool nodes_first : {true, false}) {
    WallSpec rigid = wall_of(all_motions(), nodes_first ? sheet : box);
    rigid.meshes.push_back(rigid.meshes.front());
    rigid.meshes.back().mesh = nodes_first ? box : sheet;
    rigid.meshes.back().name = "other";
    WallSpec with_nodes = rigid;
    with_nodes.meshes[nodes_first ? 0 : 1].has_nodes = true;
    Scene one(rigid), other(with_nodes);
    Random random(9);
    for (int k = 0; k < 60; k++) {
      one.add({uniform(random, -0.9, 0.9), uniform(random, -0.9, 0.9), uniform(random, -0.6, 0.8)},
              0.2);
      one.v.back() = 0.1 * random_unit(random);
    }
    static_cast<Grains &>(other) = one;
    Real largest = 0;
    int both = 0;
    for (int i = 0; i < 20; i++) {
      for (Scene *scene : {&one, &other}) {
        for (std::size_t k = 0; k < scene->x.size(); k++) scene->x[k] += kDt * scene->v[k];
        scene->proceed(i);
      }
      for (std::size_t k = 0; k < one.x.size(); k++) {
        largest = std::max(largest, norm(one.force[k]));
        EXPECT_LE(norm(one.force[k] - other.force[k]), 1e-12 * 1e3) << i << " " << k;
        EXPECT_LE(norm(one.torque[k] - other.torque[k]), 1e-12 * 1e3) << i << " " << k;
      }
    }
    both = static_cast<int>(
        std::min(one.wall->totals().mesh(0).contacts, one.wall->totals().mesh(1).contacts));
    EXPECT_GT(both, 5);
    EXPECT_GT(largest, 1);
    for (int m = 0; m < 2; m++)
      EXPECT_EQ(one.wall->totals().mesh(m).contacts, other.wall->totals().mesh(m).contacts);
  }
}

// ---- on another device -------------------------------------------------------------------

// The engine of a device gives the bits of the CPU's: forces on spheres and nodes, springs, the power. The sheet has narrow
// columns, whose faces are too thin for Real, waves run over it and it is shaken, a rigid box moves beside it; spheres touch
// faces, edges, vertices and both meshes. On a CPU the memory of the engine is the host's: there it gets nodes and gives
// forces in place, too, the last node first.
void expect_the_same_bits(const ContactLaw &law, Side side, bool has_box, int n_steps)
{
  TriangleSoup soup = side == Side::both ? floor_mesh(6, 1) : box_mesh({-1, -1, -1}, {1, 1, 1});
  if (side == Side::both)
    for (Vec3 &x : soup.corners) x.x = std::copysign(x.x * x.x * x.x * x.x, x.x);
  WallSpec spec = nodes_of(law, welded(soup));
  spec.side = side;
  if (has_box) {
    spec.meshes.push_back(spec.meshes.front());
    MeshSpec &box = spec.meshes.back();
    box.has_nodes = false;
    box.name = "box";
    box.mesh = welded(box_mesh({-0.3, -0.4, -0.9}, {0.5, 0.4, -0.1}));
    box.motion.add(linear({0, 0.02, 0.05}));
  }
  Scene one(spec, kDt, cpu()), other(spec, kDt, tested());
  Random random(13);
  for (int k = 0; k < 40; k++) {
    const Vec3 at = {uniform(random, -1.1, 1.1), uniform(random, -1.1, 1.1),
                     side == Side::both ? uniform(random, -0.35, 0.35) : uniform(random, 1, 1.3)};
    one.add(at, uniform(random, 0.2, 0.3));
    one.v.back() = 0.2 * random_unit(random);
    one.omega.back() = 2 * random_unit(random);
  }
  static_cast<Grains &>(other) = one;
  const std::vector<Vec3> flat = one.nodes();
  std::vector<Vec3> at = flat, v(at.size(), Vec3{0, 0, 0});
  std::vector<int> order(at.size());
  std::iota(order.rbegin(), order.rend(), 0);
  std::vector<Vec3> back_at, back_v, back_force(at.size());
  Real largest = 0, power = 0;
  for (int i = 0; i <= n_steps; i++) {
    for (std::size_t k = 0; k < at.size(); k++) {
      const Real angle = 3 * flat[k].x + 2 * flat[k].y + 4 * kDt * i;
      const Vec3 to = flat[k] + Vec3{0.02 * std::cos(angle), 0, 0.1 * std::sin(angle)} +
                      1e-4 * random_unit(random);
      v[k] = i == 0 ? Vec3{0, 0, 0} : (1 / kDt) * (to - at[k]);
      at[k] = to;
    }
    // Some steps leave the nodes where they are, some shift them all.
    const bool rests = i % 50 == 49;
    if (i % 50 == 48)
      for (Vec3 &x : at) x += Vec3{0.25, 0, 0.125} - Vec3{0.25, 0, 0.125 - 1. / 1024};
    back_at.assign(at.rbegin(), at.rend());
    back_v.assign(v.rbegin(), v.rend());
    for (Scene *scene : {&one, &other}) {
      const bool in_place = scene == &other && !test_on_cuda() && i % 3 > 0;
      if (!rests && in_place)
        scene->wall->set_nodes_in_place(0, &back_at[0].x, &back_v[0].x, order);
      else if (!rests)
        scene->set_nodes(at, v);
      if (i == 0) {
        scene->set_up();
        continue;
      }
      for (std::size_t k = 0; k < scene->x.size(); k++) {
        if (std::fabs(scene->x[k].z) > 1.5) scene->v[k].z = -scene->v[k].z;
        scene->x[k] += kDt * scene->v[k];
      }
      scene->next();
    }
    for (std::size_t k = 0; k < one.x.size(); k++) {
      ASSERT_TRUE(one.force[k] == other.force[k]) << "step " << i << " sphere " << k;
      ASSERT_TRUE(one.torque[k] == other.torque[k]) << "step " << i << " sphere " << k;
      largest = std::max(largest, norm(one.torque[k]));
    }
    if (!test_on_cuda() && other.wall->put_node_forces(0, &back_force[0].x, order)) {
      for (std::size_t k = 0; k < at.size(); k++)
        ASSERT_TRUE(back_force[at.size() - 1 - k] == one.node_force(k)) << "step " << i;
    }
    ASSERT_EQ(one.wall->node_forces(0), other.wall->node_forces(0)) << "step " << i;
    if (i % 100 != 0) continue;
    ASSERT_EQ(one.wall->nodes(0).power(), other.wall->nodes(0).power()) << "step " << i;
    power = std::max(power, std::fabs(one.wall->nodes(0).power()));
    for (int m = 0; m < static_cast<int>(spec.meshes.size()); m++)
      ASSERT_EQ(one.wall->totals().mesh(m).contacts, other.wall->totals().mesh(m).contacts);
  }
  EXPECT_GT(largest, 0.01);
  EXPECT_GT(power, 0);
}
TEST(mesh_nodes, on_another_device_give_the_same_bits)
{
  const int n = std::getenv("LSDCD_QUICK") ? 150 : 2000;
  ContactLaw rolling_beside_classic = hertz_history(1e4, 3e3, 5, 3, 0.4).law();
  rolling_beside_classic.rolling = RollingModel::cdt;
  rolling_beside_classic.rolling.numbers[0] = 0.1;
  expect_the_same_bits(all_motions(), Side::both, false, n);
  expect_the_same_bits(all_motions(), Side::both, true, n);
  expect_the_same_bits(all_motions(), Side::out, false, n);
  expect_the_same_bits(hertz_history(1e4, 3e3, 5, 3, 0.4).law(), Side::both, true, n);
  expect_the_same_bits(rolling_beside_classic, Side::both, false, n);
}

// Threads of a GPU that add to one of four nodes at once, and the power, which is added in blocks of blocks.
TEST(mesh_nodes, that_bear_many_spheres_have_the_sum_of_all)
{
  WallSpec spec = nodes_of(hooke(1000, 20, 30, 0.4).law(), welded(floor_mesh(1, 20)));
  Scene one(spec, kDt, cpu()), other(spec, kDt, tested());
  Random random(17);
  for (int k = 0; k < 3000; k++) {
    one.add({uniform(random, -19, 19), uniform(random, -19, 19), 0.49}, 0.5);
    one.v.back() = random_unit(random);
  }
  static_cast<Grains &>(other) = one;
  for (Scene *scene : {&one, &other}) {
    scene->set_nodes(one.nodes(), {});
    scene->set_up();
  }
  Vec3 force = {0, 0, 0};
  for (const Vec3 &f : one.force) force += f;
  EXPECT_GT(norm(force), 3000);
  EXPECT_LE(norm(force + one.sum_of_nodes()), 1e-13 * 3000 * 30);
  EXPECT_EQ(one.wall->node_forces(0), other.wall->node_forces(0));
  EXPECT_EQ(one.wall->nodes(0).power(), other.wall->nodes(0).power());
}

// ---- nothing is missed -------------------------------------------------------------------

// Spheres and nodes go at random, in small steps and in jumps. With stiffness 1 and every overlap in full a force is
// the sum of overlaps: it shows each contact that is missed. Brute force has the nearest by a formula of its own, and
// all by trying each feature.
TEST(mesh_nodes, miss_no_contact_while_they_move_at_random)
{
  const double wanted = random_pairs() / 10;
  double n_done = 0, n_touching = 0;
  const char *first = std::getenv("LSDCD_SEED");
  const int n_spheres =
      wanted > 2e6 ? 6000 : 60;    // a step of many costs a GPU as much as one of few
  for (std::uint64_t seed = first ? std::strtoull(first, nullptr, 10) : 1; n_done < wanted;
       seed++) {
    Random random(seed);
    TriangleSoup soup =
        seed % 4 == 0 ? box_mesh({-1, -1, -1}, {1, 1, 1}) : floor_mesh(4, 1.5, seed);
    const auto mesh = welded(soup);
    WallSpec spec = nodes_of(hooke(1).law(), mesh);
    spec.corner = Corner::sum;
    Scene scene(spec);
    constexpr int kSteps = 100;
    for (int k = 0; k < n_spheres; k++)
      scene.add(uniform(random, {-2, -2, -1.5}, {2, 2, 1.5}), log_uniform(random, 0.05, kRadius));
    std::vector<Vec3> at = mesh->vertices;
    std::vector<Vec3> drift(at.size(), Vec3{0, 0, 0});
    for (int i = 0; i < kSteps; i++) {
      const Real way = i % 37 == 36 ? 0.3 : log_uniform(random, 1e-4, 0.03);
      for (std::size_t k = 0; k < at.size(); k++) {
        drift[k] = 0.9 * drift[k] + 0.3 * way * random_unit(random);
        const Real far = norm(drift[k]);
        at[k] += std::min(Real(1), way / std::max(far, Real(1e-300))) * drift[k];
        at[k] += 0.02 * (mesh->vertices[k] - at[k]);
      }
      for (Vec3 &x : scene.x) x += log_uniform(random, 1e-5, 0.05) * random_unit(random);
      scene.set_nodes(at, {});
      scene.proceed(i);

      WeldedMesh now = *mesh;
      now.vertices = at;
      const MeshFeatures features = make_features(now, false);
      const Real tolerance = 1e-12;
      for (int k = 0; k < n_spheres; k++) {
        const Vec3 &x = scene.x[k];
        Vec3 force = {0, 0, 0};
        for (const BruteContact &c : brute_contacts(features.view(), features.contact_features, x,
                                                    scene.radius[k], tolerance, 4 * tolerance))
          force += (scene.radius[k] / c.distance - 1) * (x - c.closest);
        Real least = HUGE_VAL;
        for (const auto &f : mesh->faces)
          least = std::min(least, region_distance_sq(at[f[0]], at[f[1]], at[f[2]], x));
        const bool touches = std::sqrt(least) < scene.radius[k];
        ASSERT_EQ(touches, norm(scene.force[k]) > 0)
            << "seed " << seed << " step " << i << " " << k;
        // Places are of size 2, so that a closest point is off by 1e-15 at most, and the direction to a centre at a
        // distance d from the wall by 1e-15/d.
        ASSERT_NEAR(norm(scene.force[k] - force), 0,
                    1e-9 + scene.radius[k] * 1e-15 / std::sqrt(least))
            << "seed " << seed << " step " << i << " sphere " << k;
        n_touching += touches;
      }
      n_done += n_spheres;
    }
  }
  std::printf("  %.3g steps of spheres, %.0f %% touch\n", n_done, 100 * n_touching / n_done);
  EXPECT_GT(n_touching, 0.1 * n_done);
}

// ---- forces on nodes ---------------------------------------------------------------------

// For any number of contacts, on faces, edges and vertices: the nodes get the force that the spheres give, and its
// moment. A sphere's force acts where the normal force does, at its closest point.
TEST(mesh_nodes, get_the_force_and_its_moment_at_the_contact)
{
  const auto mesh = welded(curved_sheet(5));
  Scene scene(nodes_of(hooke(1000, 20, 30, 0.4).law(), mesh));
  Random random(2);
  for (int k = 0; k < 80; k++) {
    scene.add({uniform(random, -1.4, 1.4), uniform(random, -1.4, 1.4), uniform(random, -0.8, 0.8)},
              0.3);
    scene.v.back() = random_unit(random);
  }
  std::vector<Vec3> velocity;
  for (std::size_t i = 0; i < mesh->vertices.size(); i++) velocity.push_back(random_unit(random));
  scene.set_nodes(mesh->vertices, velocity);
  scene.set_up();
  scene.next();

  // The torque on a sphere is its tangential force on the arm of its radius; at the closest point the arm is shorter
  // by the overlap. So its moment there, the sum of the contacts' force on the arm, is found sphere by sphere.
  Vec3 force = {0, 0, 0};
  Real size = 0;
  int single = 0;
  const MeshFeatures features = make_features(*mesh, false);
  for (std::size_t k = 0; k < scene.x.size(); k++) {
    force += scene.force[k];
    size += norm(scene.force[k]);
    const auto contacts = brute_contacts(features.view(), features.contact_features, scene.x[k],
                                         scene.radius[k], 1e-12, 4e-12);
    if (contacts.size() != 1) continue;
    // One sphere alone at a time has its moment at its only contact.
    single++;
    Scene one(nodes_of(hooke(1000, 20, 30, 0.4).law(), mesh));
    one.add(scene.x[k], scene.radius[k]);
    one.v[0] = scene.v[k];
    one.set_nodes(mesh->vertices, velocity);
    one.set_up();
    one.next();
    Vec3 of_nodes = {0, 0, 0};
    for (std::size_t i = 0; i < mesh->vertices.size(); i++)
      of_nodes += cross(mesh->vertices[i], one.node_force(i));
    const Vec3 moment = cross(contacts[0].closest, one.force[0]);
    EXPECT_LE(norm(of_nodes + moment), 1e-13 * norm(one.force[0])) << k;
  }
  EXPECT_LE(norm(force + scene.sum_of_nodes()), 1e-13 * size);
  EXPECT_GT(single, 10);
}

// The unit of sums: below 2^63 units also where all numbers are as large as the largest power of two in their range lets
// them be, and no farther from the sum than half a unit a number, which is 2^(b - 63) of the largest or less.
TEST(mesh_nodes, sums_in_units_fit_into_64_bits_and_are_near)
{
  const Real largest = std::nextafter(1., 0.);    // rounds to 1, if it is rounded
  for (int b = 1; b <= 40; b++)
    for (const Real size : {largest, 0.5, 1e-3 * largest})
      for (const int e : {-1060, -1021, -300, 0, 300, 1023}) {
        const Real x = std::ldexp(size, e);
        const std::uint64_t n = (std::uint64_t(1) << b) - 1;
        const SumUnit unit({n, exponent_field(x)});
        const std::int64_t units = unit.units(x);
        EXPECT_LT(static_cast<__int128>(n) * units, static_cast<__int128>(1) << 63)
            << b << " " << e;
        EXPECT_EQ(unit.units(-x), -units);
        // Normal numbers have units of half the distance at most; others those of 2^-1022.
        EXPECT_LE(std::fabs(unit.value(units) - x),
                  std::max(std::ldexp(x, b - 63), std::ldexp(1., -1023)))
            << b << " " << e;
      }
  for (const Real x : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
    const SumUnit none({1, exponent_field(x)});
    EXPECT_FALSE(none.is_finite());
    EXPECT_TRUE(std::isnan(none.value(0)));
  }

  // Numbers of both signs over 12 decades.
  Random random(5);
  constexpr int kMany = 1000000;
  std::vector<Real> numbers;
  SummandRange range = {kMany, 0};
  Real most = 0;
  for (int k = 0; k < kMany; k++) {
    numbers.push_back(uniform(random, -1, 1) * std::pow(10, uniform(random, -6, 6)));
    range.exponent = std::max<std::uint64_t>(range.exponent, exponent_field(numbers.back()));
    most = std::max(most, std::fabs(numbers.back()));
  }
  const SumUnit unit(range);
  std::int64_t sum = 0;
  long double exact = 0;
  for (const Real x : numbers) {
    sum += unit.units(x);
    exact += x;
  }
  const Real bound = kMany * std::ldexp(most, -43);
  EXPECT_LE(std::fabs(static_cast<Real>(exact - unit.value(sum))), bound);
  EXPECT_GT(std::fabs(unit.value(sum)), 100 * bound);
}

// The spheres of a step on one process, and dealt out to several: the nodes go by their forces, so that one bit would
// grow. The first is of the CPU.
TEST(mesh_nodes, have_the_same_bits_on_any_number_of_processes)
{
  const auto mesh = welded(curved_sheet(4));
  const WallSpec spec = nodes_of(all_motions(), mesh);
  std::vector<Real> forces, moments;
  const auto run = [&](FakeHost &host, const WallBackend &on) {
    Scene scene(host, spec, kDt, on);
    Random random(23);
    for (int k = 0; k < 300; k++) {
      const Vec3 x = {uniform(random, -1.3, 1.3), uniform(random, -1.3, 1.3),
                      uniform(random, -0.7, 0.7)};
      const Real radius = uniform(random, 0.2, 0.3);
      const Vec3 v = random_unit(random), omega = random_unit(random);
      if (k % host.processes() != host.rank()) continue;
      scene.add(x, radius);
      scene.v.back() = v;
      scene.omega.back() = omega;
    }
    std::vector<Vec3> at = mesh->vertices, v(at.size(), Vec3{0, 0, 0});
    std::vector<Real> all, torques;
    for (int i = 0; i <= 10; i++) {
      scene.set_nodes(at, v);
      scene.proceed(i);
      const std::vector<Real> &f = scene.wall->node_forces(0);
      all.insert(all.end(), f.begin(), f.end());
      const Vec3 torque = scene.wall->totals().mesh(0).torque;
      torques.insert(torques.end(), {torque.x, torque.y, torque.z});
      for (std::size_t k = 0; k < at.size(); k++) {
        v[k] += kDt * Vec3{f[3 * k], f[3 * k + 1], f[3 * k + 2]};
        at[k] += kDt * v[k];
      }
      for (std::size_t k = 0; k < scene.x.size(); k++) scene.x[k] += kDt * scene.v[k];
    }
    if (forces.empty()) {
      forces = all;
      moments = torques;
    }
    EXPECT_EQ(all, forces) << host.processes();
    EXPECT_EQ(torques, moments) << host.processes();
  };
  FakeHost host;
  run(host, cpu());
  EXPECT_GT(*std::max_element(forces.begin(), forces.end()), 10);
  for (const int n : {1, 2, 4}) on_processes(n, [&](FakeHost &of) { run(of, tested()); });
}

// A sphere that slides, spins and rolls on a sheet in the plane z = 0: its force acts at its foot, and all else that turns it
// acts on it alone. Sums of 9 nodes of forces of up to 200 at 1.5 are rounded to 1e-12.
TEST(mesh_nodes, have_the_torque_of_the_forces_on_them)
{
  on_processes(2, [](FakeHost &host) {
    const auto mesh = welded(floor_mesh(2, 1));
    WallSpec spec = nodes_of(all_motions(), mesh);
    spec.meshes.front().torque_about = {1, -2, 3};
    Scene scene(host, spec);
    const Vec3 foot = {host.rank() == 0 ? -0.4 : 0.3, 0.15, 0};
    scene.add(foot + Vec3{0, 0, kRadius - 0.02});
    scene.v[0] = {0.5, -0.3, -0.1};
    scene.omega[0] = {1, 2, 3};
    scene.set_up();
    for (int i = 0; i < 3; i++) scene.next();
    const Vec3 mine = cross(foot - spec.meshes.front().torque_about, -scene.force[0]);
    Real expected[3] = {mine.x, mine.y, mine.z};
    host.sum(expected, 3);
    EXPECT_GT(norm(scene.torque[0]), 0.1);
    EXPECT_LE(
        norm(scene.wall->totals().mesh(0).torque - Vec3{expected[0], expected[1], expected[2]}),
        1e-12);

    // All that the sphere gets besides, about its foot, has its reaction on the mesh.
    const Vec3 rest = -cross(scene.x[0] - foot, scene.force[0]) - scene.torque[0];
    Real couple[3] = {rest.x, rest.y, rest.z};
    host.sum(couple, 3);
    EXPECT_LE(norm(scene.wall->totals().mesh(0).couple - Vec3{couple[0], couple[1], couple[2]}),
              1e-12);
  });
}

// A sphere rocks on a triangle whose corners hang on springs: with one contact the forces on sphere and nodes are the
// gradient of the elastic energy, so that velocity Verlet, which is symplectic, lets the total oscillate by the square of
// the step and not drift.
TEST(mesh_nodes, keep_the_energy_of_an_elastic_contact_CPU)
{
  const auto mesh = welded(TriangleSoup{{{-1, -1, 0}, {2, -1, 0}, {-1, 2, 0}}, ""});
  const Real stiffness = 1000, spring = 300, node_mass = 0.7, weight = 5;
  Scene scene(nodes_of(hooke(stiffness).law(), mesh));
  // At rest each node has sunk by its share of the weight, and the sphere by that and its overlap.
  std::vector<Vec3> at = mesh->vertices, v(at.size(), Vec3{0, 0, 0});
  Real sunk = 0;
  for (std::size_t k = 0; k < at.size(); k++) {
    const Real share = mesh->vertices[k].x > 0 ? 0.4 : 0.3;
    at[k].z -= share * weight / spring;
    sunk += share * share * weight / spring;
  }
  const Vec3 home = {0.2, -0.1, kRadius - weight / stiffness - sunk};
  scene.add(home);
  scene.v[0] = {0.01, -0.02, 0.03};
  const auto side = [&] { return Vec3{scene.x[0].x - home.x, scene.x[0].y - home.y, 0}; };
  std::vector<Vec3> force(at.size());
  const auto forces = [&] {
    scene.force[0] -= Vec3{0, 0, weight} + spring * side();
    for (std::size_t k = 0; k < at.size(); k++)
      force[k] = scene.node_force(k) - spring * (at[k] - mesh->vertices[k]);
  };
  scene.set_nodes(at, v);
  scene.set_up();
  forces();
  const int n_steps = std::getenv("LSDCD_QUICK") ? 20000 : 1000000, part = n_steps / 10;
  Real mean[10] = {}, least = HUGE_VAL;
  for (int i = 0; i < n_steps; i++) {
    const auto kick = [&] {
      scene.v[0] += kDt / 2 * scene.force[0];
      for (std::size_t k = 0; k < at.size(); k++) v[k] += kDt / 2 / node_mass * force[k];
    };
    kick();
    scene.x[0] += kDt * scene.v[0];
    for (std::size_t k = 0; k < at.size(); k++) at[k] += kDt * v[k];
    scene.set_nodes(at, v);
    scene.next();
    forces();
    kick();
    const MeshTotals all = scene.wall->totals().of_all();
    Real energy = all.energy + norm_sq(scene.v[0]) / 2 + spring / 2 * norm_sq(side()) +
                  weight * (scene.x[0].z - home.z);
    for (std::size_t k = 0; k < at.size(); k++)
      energy += node_mass / 2 * norm_sq(v[k]) + spring / 2 * norm_sq(at[k] - mesh->vertices[k]);
    mean[i / part] += energy / part;
    least = std::min(least, all.contacts);
  }
  EXPECT_EQ(least, 1);
  EXPECT_LE(std::fabs(mean[9] - mean[0]), 1e-6 * std::fabs(mean[0]));
}

// ---- pressure ----------------------------------------------------------------------------

TEST(mesh_nodes, of_a_closed_mesh_have_a_pressure_without_force_and_moment)
{
  TriangleSoup soup = box_mesh({-1, -0.5, -2}, {1, 2, 1});
  for (Vec3 &x : soup.corners)
    x += 0.3 * Vec3{std::sin(x.y), std::cos(2 * x.z), std::sin(x.x * x.z)};
  for (const bool inwards : {false, true}) {
    const auto mesh = welded(inwards ? inverted(soup) : soup);
    WallSpec spec = nodes_of(hooke(1000).law(), mesh);
    spec.meshes.front().pressure = 7;
    Scene scene(spec);
    scene.set_up();
    Vec3 force = {0, 0, 0}, moment = {0, 0, 0};
    Real outward = 0;
    for (std::size_t i = 0; i < mesh->vertices.size(); i++) {
      force += scene.node_force(i);
      moment += cross(mesh->vertices[i], scene.node_force(i));
      outward += dot(mesh->vertices[i], scene.node_force(i));
    }
    EXPECT_LE(norm(force), 1e-13 * 7 * mesh->report.area);
    EXPECT_LE(norm(moment), 1e-13 * 7 * mesh->report.area);
    // The virial of a pressure is 3 p V: outward.
    EXPECT_NEAR(outward, 3 * 7 * std::fabs(mesh->report.volume), 1e-12 * outward);
  }
}

void reverse(TriangleSoup &soup, std::size_t facet)
{
  std::swap(soup.corners[3 * facet + 1], soup.corners[3 * facet + 2]);
}

// Such faces would be pushed to the other side: those of a closed mesh inward.
TEST(mesh_nodes, of_faces_wound_against_each_other_take_no_pressure)
{
  TriangleSoup closed = box_mesh({-1, -1, -1}, {1, 1, 1}), open = curved_sheet(4);
  const TriangleSoup shells = joined(closed, inverted(box_mesh({2, -1, -1}, {4, 1, 1})));
  reverse(closed, 5);
  reverse(open, 3);
  for (const TriangleSoup &soup : {closed, open, shells})
    for (const bool by_input : {false, true}) {
      WallSpec spec = nodes_of(hooke(1000).law(), welded(soup));
      FakeHost host;
      EXPECT_NO_THROW(Scene(host, spec));
      if (by_input) {
        spec.inputs = {"p"};
        spec.meshes.front().pressure_input = 0;
      } else {
        spec.meshes.front().pressure = 5;
      }
      EXPECT_TRUE(fails_with("wind all alike", [&] { Scene scene(host, spec); }));
    }
}

// ---- where they are ----------------------------------------------------------------------

// A box of side 2, which a picture shows by contours at shares of its bounds.
TEST(mesh_nodes, that_have_moved_have_the_bounds_of_their_places)
{
  const auto mesh = welded(box_mesh({-1, -1, -1}, {1, 1, 1}));
  Scene scene(nodes_of(hooke(1000).law(), mesh));
  const std::size_t before = draw_mesh(*mesh, Draw::contours).size();
  std::vector<Vec3> at = mesh->vertices;
  for (Vec3 &x : at) x += {0, 0, 5};
  scene.set_nodes(at, {});
  scene.set_up();
  const WeldedMesh &now = *scene.wall->meshes()[0].mesh();
  EXPECT_EQ(now.report.lo.z, 4);
  EXPECT_EQ(now.report.hi.z, 6);
  EXPECT_EQ(draw_mesh(now, Draw::contours).size(), before);
}

// ---- periodic boxes ----------------------------------------------------------------------

// A box from -4 to 4, periodic along x and y.
PeriodicBox periodic_box()
{
  PeriodicBox box = wide_box();
  for (int k = 0; k < 3; k++) {
    box.corner[k] = -4;
    box.edge[k] = {0, 0, 0};
    box.edge[k][k] = 8;
    box.periodic[k] = k < 2;
  }
  return box;
}

// Clear of the faces a sheet may be anywhere. It reaches 1 to each side, and the sphere 0.5 beyond: at 3 and more from the
// middle it would need images.
TEST(mesh_nodes, that_come_to_a_periodic_face_are_an_error)
{
  const auto mesh = welded(floor_mesh(2, 1));
  const auto force_at = [&](const Vec3 &shift) {
    FakeHost host;
    host.simulation = periodic_box();
    Scene scene(host, nodes_of(hooke(1000).law(), mesh));
    scene.add(shift + Vec3{0.3, 0.2, kRadius - 0.01});
    std::vector<Vec3> at = mesh->vertices;
    for (Vec3 &x : at) x += shift;
    scene.set_nodes(at, {});
    scene.set_up();
    return scene.force[0].z;
  };
  for (const Real shift : {2.6, 4., 8.}) {
    const std::string error = error_of([&] { force_at({shift, 0, 0}); });
    EXPECT_TRUE(has(error, "reaches the periodic face in x at step 0"));
    EXPECT_TRUE(has(error, "A mesh whose nodes move acts through no periodic face"));
  }
  // Faces along z are not periodic. Places of up to 4 are rounded to 4e-16.
  for (const Vec3 &shift : {Vec3{-2, 1.75, 1}, Vec3{0, 0, 2.6}})
    EXPECT_NEAR(force_at(shift), 1000 * 0.01, 1e-11);
}

// ---- saved states ------------------------------------------------------------------------

// A grain that a turning sheet drags along, with springs of friction: step i.
void turn_sheet(Scene &scene, const WeldedMesh &mesh, int i)
{
  const RigidMotion motion = motion_of({turning({0, 0, 0}, {0.6, 0, 0.8}, 0.1)});
  const PosedNodes at(mesh, motion.pose_at(i * kDt), i > 0 ? kDt / 2 : 0);
  scene.set_nodes(at.at, at.velocity);
  scene.proceed(i);
}

// Without the places of nodes the springs would miss the turn of the step after the restore, of 0.06.
TEST(mesh_nodes, go_on_from_a_saved_state_with_the_same_bits)
{
  const auto mesh = welded(floor_mesh(2, 1));
  Scene first(nodes_of(all_motions(), mesh));
  first.add({0.3, 0.2, 0.46});
  first.v[0] = {0.1, 0.4, 0};
  for (int i = 0; i <= 10; i++) turn_sheet(first, *mesh, i);
  Scene second(nodes_of(all_motions(), mesh));
  second.restore_with_spheres(first);
  EXPECT_EQ(second.nodes(), first.nodes());
  EXPECT_EQ(second.wall->save().meshes[0].nodes.velocities,
            first.wall->save().meshes[0].nodes.velocities);
  second.set_up();
  turn_sheet(first, *mesh, 11);
  turn_sheet(second, *mesh, 11);
  EXPECT_GT(norm(first.force[0]), 1);
  EXPECT_EQ(second.force[0], first.force[0]);
  EXPECT_EQ(second.torque[0], first.torque[0]);
}

TEST(mesh_nodes, stay_where_they_are_where_a_saved_state_is_refused)
{
  const auto mesh = welded(floor_mesh(2, 1));
  Scene scene(nodes_of(hooke(1000).law(), mesh));
  const std::vector<Vec3> before = scene.nodes();
  const Box bounds = scene.wall->nodes(0).bounds();
  WallState lifted = scene.wall->save(), flat;
  std::vector<Real> &x = lifted.meshes[0].nodes.places;
  ASSERT_EQ(x.size(), 3 * before.size());
  for (std::size_t k = 2; k < x.size(); k += 3) x[k] += 1;
  flat = lifted;
  for (std::size_t k = 0; k < x.size(); k += 3) flat.meshes[0].nodes.places[k] = 0;
  EXPECT_THROW(scene.wall->restore(flat, {0, kDt}), InputError);
  flat = lifted;
  flat.meshes[0].nodes.places[4] = std::nan("");
  EXPECT_THROW(scene.wall->restore(flat, {0, kDt}), InputError);
  EXPECT_EQ(scene.nodes(), before);
  EXPECT_EQ(scene.wall->nodes(0).bounds().hi, bounds.hi);
  scene.wall->restore(lifted, {0, kDt});
  EXPECT_EQ(scene.wall->nodes(0).bounds().hi.z, bounds.hi.z + 1);
}

// That nodes do not take the motion of a rigid mesh is in test_mesh_body.
TEST(mesh_nodes, do_not_move_a_rigid_mesh_after_a_restart)
{
  const auto mesh = welded(floor_mesh(2, 1));
  Scene nodes(nodes_of(hooke(1000).law(), mesh)), rigid(wall_of(hooke(1000).law(), mesh));
  rigid.restore(nodes);
  ASSERT_EQ(rigid.host.warnings.size(), 1u);
  EXPECT_TRUE(has(rigid.host.warnings[0], "the mesh has the shape of its file"));
}

// ---- what is refused ---------------------------------------------------------------------

TEST(mesh_nodes, that_jump_past_a_sphere_or_come_into_a_line_are_an_error)
{
  const struct {
    Vec3 scale, shift;
    const char *why;
  } rows[] = {{{1, 1, 1}, {0, 0, 1}, "has moved by 1 in step 1, more than the largest radius 0.5"},
              {{1, 0, 1}, {0, 0, 0}, "has no area any more"}};
  for (const auto &row : rows) {
    const auto mesh = welded(floor_mesh(1, 0.2));
    Scene scene(nodes_of(hooke(1000).law(), mesh));
    scene.add({0, 0, 0.6});
    scene.set_up();
    std::vector<Vec3> at = mesh->vertices;
    for (Vec3 &x : at)
      for (int k = 0; k < 3; k++) x[k] = row.scale[k] * x[k] + row.shift[k];
    scene.set_nodes(at, {});
    EXPECT_TRUE(fails_with(row.why, [&] { scene.next(); }));
  }
}

// The sphere that pushes them is named, and the mesh. Nothing of such a force is added.
TEST(mesh_nodes, that_get_a_force_that_is_not_finite_are_an_error)
{
  for (const int n : {1, 2})
    for (const Real wrong : {HUGE_VAL, -HUGE_VAL, std::nan("")}) {
      const auto push = [&](FakeHost &host) {
        const auto mesh = welded(floor_mesh(2, 1));
        Scene scene(host, nodes_of(hooke(1000, 20).law(), mesh));
        scene.add({-0.4, 0.3, kRadius - 0.01});
        scene.add({0.3, 0.1, kRadius - 0.01});
        scene.set_up();
        if (host.rank() == 0) scene.v[1].z = wrong;
        scene.next();
      };
      EXPECT_TRUE(begins(error_of([&] { on_processes(n, push); }),
                         "sphere 2 pushes nodes of mesh 'sheet' by a force that is not finite: "));
    }
}
// The other processes do not wait for one whose step has failed, in this step and where sums are asked for after it. They
// have no forces, until a program ends or tells all of them.
TEST(mesh_nodes, of_processes_one_of_which_fails_go_on)
{
  for (const int every : {0, 1})
    on_processes(2, [&](FakeHost &host) {
      const auto mesh = welded(floor_mesh(2, 1));
      WallSpec spec = nodes_of(hooke(1000, 20).law(), mesh);
      spec.average_every = every;
      Scene scene(host, spec);
      scene.add({-0.4, 0.3, kRadius - 0.01});
      scene.set_up();
      if (host.rank() == 1) {
        scene.v[0].z = HUGE_VAL;
        EXPECT_THROW(scene.next(), InputError);
      } else {
        scene.next();
      }
      EXPECT_TRUE(std::isnan(scene.node_force(0).z));
      EXPECT_EQ(scene.wall->totals().mesh(0).contacts, 1);    // of the other process
      if (every > 0) {
        EXPECT_TRUE(std::isnan(scene.wall->means().mesh(0).torque.x));
      }
    });
}
// Where nodes are set in place nothing waits for their forces: these are no numbers, and the next step is the error.
TEST(mesh_nodes, that_got_a_force_in_place_that_is_not_finite_are_an_error_in_the_next_step)
{
  const auto mesh = welded(floor_mesh(2, 1));
  Scene scene(nodes_of(hooke(1000, 20).law(), mesh), kDt, cpu());
  scene.add({-0.4, 0.3, kRadius - 0.01});
  scene.set_up();
  std::vector<int> order(mesh->vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::vector<Vec3> force(order.size());
  const auto set = [&] { scene.wall->set_nodes_in_place(0, &mesh->vertices[0].x, nullptr, order); };
  set();
  scene.v[0].z = HUGE_VAL;
  scene.next();
  ASSERT_TRUE(scene.wall->put_node_forces(0, &force[0].x, order));
  for (const Vec3 &f : force) EXPECT_TRUE(std::isnan(f.z));
  scene.v[0].z = 0;
  set();
  EXPECT_THROW(scene.next(), InputError);
  set();
  scene.next();    // a program may go on
  ASSERT_TRUE(scene.wall->put_node_forces(0, &force[0].x, order));
  Vec3 sum = {0, 0, 0};
  for (const Vec3 &f : force) sum += f;
  EXPECT_NEAR(sum.z, -10, 1e-10);
}

TEST(mesh_nodes, whose_facets_have_no_area_are_an_error)
{
  FakeHost host;
  EXPECT_TRUE(
      fails_with("the facet with the corners -1 0 0, 1 0 0 and 0 0 0 of 'sheet' has no area", [&] {
        Scene scene(host, nodes_of(hooke(1000).law(), welded(mesh_with_junction(true))));
      }));
  EXPECT_NO_THROW(Scene(host, wall_of(hooke(1000).law(), welded(mesh_with_junction(true)))));
}

// A facet of two points, or one that is there twice, opens no hole.
TEST(mesh_nodes, whose_facets_are_lines_or_there_twice_are_none)
{
  TriangleSoup soup = floor_mesh(1, 1);
  const Vec3 a = soup.corners[0], b = soup.corners[1], c = soup.corners[2];
  soup.corners.insert(soup.corners.end(), {a, b, b, a, c, b});
  FakeHost host;
  EXPECT_NO_THROW(Scene(host, nodes_of(hooke(1000).law(), welded(soup))));
  EXPECT_TRUE(host.warnings.empty());
}

TEST(mesh_nodes, that_lie_on_open_edges_are_warned_of)
{
  Scene scene(nodes_of(hooke(1000).law(), welded(mesh_with_junction(false))));
  ASSERT_EQ(scene.host.warnings.size(), 1u);
  EXPECT_TRUE(has(scene.host.warnings[0], "1 vertex of 'sheet' lies on open edges"));
}

TEST(mesh_nodes, in_two_dimensions_are_an_error)
{
  FakeHost host;
  host.simulation = wide_box();
  host.simulation.dimension = 2;
  host.simulation.periodic[2] = true;
  EXPECT_TRUE(fails_with("in two dimensions a mesh cannot have nodes", [&] {
    Scene scene(host, nodes_of(hooke(1000).law(), welded(box_mesh({-1, -1, -1}, {1, 1, 1}))));
  }));
}

}    // namespace lsdcd::test_mesh_nodes
