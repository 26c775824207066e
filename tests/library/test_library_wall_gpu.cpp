// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall with arrays of spheres on a GPU against the same wall with arrays of the host.
#include "floor_and_grains.h"
#include "process.h"
#include "support/device_memory.h"
#include "support/fake_host.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <cuda_runtime_api.h>
#include <optional>
#include <random>
#include <string>
#include <vector>

namespace {

const std::string kHertz = "hertz/history 1e5 5e4 100 50 0.5 1 ", kHooke = "hooke 1000 0 0 0 0 0 ";
const std::string kOnWaves = kHertz + "mesh $waves ",
                  kWavesAndRisingFloor = kOnWaves + "mesh $floor motion linear 0 0 0.2";

class wall_gpu : public FloorTest {
 protected:
  // Waves of 2 x 16 x 16 triangles from -2 to 2: edges and vertices that stand out and in.
  const std::string waves_file_ = file_ + ".waves.stl";
  std::optional<api::Mesh> waves_;

  void SetUp() override
  {
    FloorTest::SetUp();
    write_waves();
    waves_.emplace(waves_file_);
  }
  void TearDown() override
  {
    std::remove(waves_file_.c_str());
    FloorTest::TearDown();
  }
  void write_waves() const
  {
    std::ofstream file(waves_file_);
    file << "solid w\n";
    const auto corner = [&](int i, int j) {
      file << "vertex " << -2 + 0.25 * i << " " << -2 + 0.25 * j << " "
           << 0.2 * ((i * 7 + j * 11) % 5) << "\n";
    };
    const auto facet = [&](int i, int j, int di, int dj, int ei, int ej) {
      file << "facet normal 0 0 0\nouter loop\n";
      corner(i, j);
      corner(i + di, j + dj);
      corner(i + ei, j + ej);
      file << "endloop\nendfacet\n";
    };
    for (int i = 0; i < 16; i++)
      for (int j = 0; j < 16; j++) {
        facet(i, j, 1, 0, 1, 1);
        facet(i, j, 1, 1, 0, 1);
      }
    file << "endsolid w\n";
  }
  // $waves and $floor in the words are these meshes.
  lsdcd::Wall wall_of(const std::string &words, const lsdcd_wall_options *options = nullptr) const
  {
    lsdcd::Values values;
    if (has(words, "$waves")) values.emplace_back("waves", *waves_);
    if (has(words, "$floor")) values.emplace_back("floor", *mesh_);
    return lsdcd::Wall(words, values, options);
  }
};

// Spheres with all that a wall may ask for, whose numbers are on the host or on a GPU in a step.
struct Rain {
  std::vector<double> x, v, omega, radius, mass, force, torque, temperature, heat;
  std::vector<int> type;

  explicit Rain(int n, int seed = 5)
  {
    std::mt19937_64 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    for (int i = 0; i < n; i++) {
      for (const double most : {1.8, 1.8}) x.push_back(most * (2 * unit(random) - 1));
      x.push_back(0.4 + 0.8 * unit(random));
      for (int k = 0; k < 3; k++) v.push_back(unit(random) - 0.5);
      for (int k = 0; k < 3; k++) omega.push_back(4 * unit(random) - 2);
      radius.push_back(0.1 + 0.1 * unit(random));
      mass.push_back(unit(random) + 0.5);
      temperature.push_back(300 + unit(random));
      type.push_back(1 + i % 2);
    }
    clear();
  }
  void clear()
  {
    force.assign(x.size(), 0);
    torque.assign(x.size(), 0);
    heat.assign(radius.size(), 0);
  }
  void move()
  {
    for (std::size_t i = 0; i < x.size(); i++) {
      v[i] += kDt * (force[i] / mass[i / 3] - (i % 3 == 2 ? 9.81 : 0));
      omega[i] += kDt * torque[i] / (0.4 * mass[i / 3] * radius[i / 3] * radius[i / 3]);
      x[i] += kDt * v[i];
    }
  }
};

lsdcd_wall_step step_with(bool setup, bool changed = false)
{
  lsdcd_wall_step step = step_of();
  step.setup = setup;
  step.changed = changed;
  return step;
}

lsdcd::WallOptions on_device(void *stream = nullptr)
{
  lsdcd::WallOptions o;
  o.device = LSDCD_CUDA;
  o.stream = stream;
  return o;
}

// Where a step has the numbers of spheres.
struct Copies {
  using Numbers = lsdcd::DeviceArray<double>;
  bool cuda;
  Numbers x{cuda}, v{cuda}, omega{cuda}, radius{cuda}, mass{cuda}, force{cuda}, torque{cuda},
      temperature{cuda}, heat{cuda};
  lsdcd::DeviceArray<int> type{cuda};

  explicit Copies(bool cuda) : cuda(cuda) {}
  lsdcd_spheres of(const Rain &r)
  {
    lsdcd_spheres s = {};
    s.size = sizeof s;
    s.n = r.radius.size();
    s.x = x.put(r.x);
    s.v = v.put(r.v);
    s.omega = omega.put(r.omega);
    s.radius = radius.put(r.radius);
    s.mass = mass.put(r.mass);
    s.force = force.put(r.force);
    s.torque = torque.put(r.torque);
    s.temperature = temperature.put(r.temperature);
    s.heat = heat.put(r.heat);
    s.type = type.put(r.type);
    return s;
  }
  void step(lsdcd::Wall &wall, Rain &r, const lsdcd_wall_step &step)
  {
    r.clear();
    wall.step(of(r), step);
    r.force = force.get(r.x.size());
    r.torque = torque.get(r.x.size());
    r.heat = heat.get(r.radius.size());
  }
};

bool same_bytes(const std::vector<double> &a, const std::vector<double> &b)
{
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0;
}

TEST_F(wall_gpu, gives_arrays_on_a_device_the_forces_of_arrays_of_the_host)
{
  // Same source, no contraction, IEEE division and root on both: no tolerance for forces. Totals are sums of at
  // most n contacts in another order: n roundings of the sum of sizes.
  const struct {
    const char *text;
    std::string words;
  } walls[] = {{"hertz", kOnWaves},
               {"and a floor that moves", kWavesAndRisingFloor},
               {"and a law of types", kOnWaves + "law types 2 hertz/history 2e5 1e5 100 50 0.3 1 "
                                                 "mesh $floor motion linear 0 0 0.2"},
               {"wear", kOnWaves + "wear archard 1e-3 1e6"},
               {"granular, with heat", "granular hertz 1e5 3 tangential linear_history 5e4 1 0.5 "
                                       "rolling sds 2e3 5 0.1 heat area 1 mesh $waves "
                                       "temperature 350"}};
  constexpr int kSpheres = 300, kSteps = 60;
  for (const auto &[text, words] : walls) {
    const lsdcd::WallOptions options = on_device();
    lsdcd::Wall host = wall_of(words), device = wall_of(words, &options);
    Rain there(kSpheres), here(kSpheres);
    Copies on_gpu(true), on_cpu(false);
    double contacts = 0;
    for (int k = 0; k <= kSteps; k++) {
      on_cpu.step(host, here, step_with(k == 0));
      on_gpu.step(device, there, step_with(k == 0));
      ASSERT_TRUE(same_bytes(there.force, here.force)) << text << ", step " << k;
      ASSERT_TRUE(same_bytes(there.torque, here.torque)) << text << ", step " << k;
      ASSERT_TRUE(same_bytes(there.heat, here.heat)) << text << ", step " << k;
      here.move();
      there.move();
      const lsdcd_wall_totals a = device.totals(), b = host.totals();
      double size = 0;
      for (const double f : here.force) size += std::abs(f);
      EXPECT_EQ(a.contacts, b.contacts);
      for (int c = 0; c < 3; c++) EXPECT_NEAR(a.force[c], b.force[c], kSpheres * 1e-15 * size);
      contacts += b.contacts;
    }
    EXPECT_NEAR(device.totals().worn_volume, host.totals().worn_volume,
                1e-12 * host.totals().worn_volume);
    EXPECT_GT(contacts, kSteps) << text;
  }
}

// Waves as a body on a hinge that grains press down: the load of a step comes from the device in the next. It is summed in blocks of
// candidates, which may be others on a device, so that it differs by as many roundings as there are contacts, 300 x 1.1e-16 in each of
// 100 steps; 1e-9 lets contacts multiply that by 300. Other joints, and saved states: unit/test_body_on_device.
TEST_F(wall_gpu, moves_a_body_on_a_device_as_on_the_host)
{
  const std::string words = "hertz/history 1e5 5e4 0 0 0.5 0 mesh $waves "
                            "body mass 200 com 0 0 0.4 inertia 300 300 600 0 0 0 "
                            "joint hinge 0 0 0.4 1 0.5 0 spring 5e4 100";
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall host = wall_of(words), device = wall_of(words, &options);
  constexpr int kSpheres = 300, kSteps = 100;
  constexpr double kApart = 1e-9;
  Rain there(kSpheres), here(kSpheres);
  Copies on_gpu(true), on_cpu(false);
  for (int k = 0; k <= kSteps; k++) {
    on_cpu.step(host, here, step_with(k == 0, true));
    on_gpu.step(device, there, step_with(k == 0, true));
    double size = 0;
    for (const double f : here.force) size = std::max(size, std::abs(f));
    for (std::size_t i = 0; i < here.force.size(); i++) {
      ASSERT_NEAR(there.force[i], here.force[i], kApart * size) << "step " << k;
      ASSERT_NEAR(there.torque[i], here.torque[i], kApart * size) << "step " << k;
    }
    here.move();
    there.move();
  }
  const api::BodyState a = device.body(0), b = host.body(0);
  for (int k = 0; k < 3; k++) {
    EXPECT_NEAR(a.velocity[k], b.velocity[k], kApart);
    EXPECT_NEAR(a.angular_velocity[k], b.angular_velocity[k], kApart);
  }
  EXPECT_GT(std::abs(b.velocity[2]) + std::abs(b.angular_velocity[0]), 1e-3);
}

// A plate that the caller's poses lift and turn, beside waves at rest. A sphere that is a candidate of both is
// computed in the frame of the box, one of the plate alone in that of the plate, and the two sides may choose
// candidates in other steps. So places differ by the rounding of a turn, 4 eps * 3 = 3e-15, forces by that times
// the stiffness, 1.5 kn sqrt(R overlap) <= 6e4, and springs add this up from step to step.
TEST_F(wall_gpu, takes_poses_of_the_caller_on_a_device_as_on_the_host)
{
  const std::string words = kOnWaves + "mesh $floor name plate motion caller";
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall host = wall_of(words), device = wall_of(words, &options);
  constexpr int kSpheres = 300, kSteps = 60;
  constexpr double kRounding = (kSteps + 1) * 6e4 * 3e-15;
  Rain there(kSpheres), here(kSpheres);
  Copies on_gpu(true), on_cpu(false);
  double pushed = 0;
  for (int k = 0; k <= kSteps; k++) {
    const double half = 0.1 * kDt * k;
    api::Pose pose;
    pose.position = {0, 0, 0.3 + 5 * kDt * k};
    pose.quaternion = {std::cos(half), std::sin(half), 0, 0};
    pose.velocity = {0, 0, 5};
    pose.angular_velocity = {0.2, 0, 0};
    host.set_pose(1, pose);
    device.set_pose(1, pose);
    on_cpu.step(host, here, step_with(k == 0));
    on_gpu.step(device, there, step_with(k == 0));
    for (std::size_t i = 0; i < here.force.size(); i++) {
      ASSERT_NEAR(there.force[i], here.force[i], kRounding) << "step " << k;
      ASSERT_NEAR(there.torque[i], here.torque[i], kRounding) << "step " << k;    // arms < 1
    }
    const lsdcd_wall_totals a = device.totals(1, {1, 2, 3}), b = host.totals(1, {1, 2, 3});
    double size = 0;
    for (const double f : here.force) size += std::abs(f);
    for (int c = 0; c < 3; c++) {    // sums in another order; arms of up to 6
      EXPECT_NEAR(a.force[c], b.force[c], kSpheres * (kRounding + 1e-15 * size));
      EXPECT_NEAR(a.torque[c], b.torque[c], 6 * kSpheres * (kRounding + 1e-15 * size));
    }
    pushed = std::max(pushed, -b.force[2]);
    here.move();
    there = here;
  }
  EXPECT_GT(pushed, 0);
}

// Waves whose vertices the caller moves, with arrays on the device: the forces of nodes given on the host, on spheres and
// nodes, to the last bit, with a pressure. Half of the grids' allowance, 0.15 of the largest radius, is gone after 10 steps, so
// that grids are built several times. The places come back.
TEST_F(wall_gpu, takes_nodes_in_arrays_of_the_device_as_those_of_the_host)
{
  const lsdcd::Mesh &by_corners =
      *waves_;    // nodes of a vertex that facets share are given several times
  const lsdcd::MeshArrays shared = by_corners.arrays();
  const lsdcd::Mesh by_vertices(shared.vertices, shared.faces);
  for (const lsdcd::Mesh *waves : {&by_corners, &by_vertices}) {
    const std::string words = kOnWaves + "nodes caller pressure 50";
    const lsdcd::Values values = {{"waves", *waves}};
    const lsdcd::WallOptions options = on_device();
    lsdcd::Wall host(words, values), device(words, values, &options);
    constexpr int kSpheres = 300, kSteps = 100;
    Rain there(kSpheres), here(kSpheres);
    Copies on_gpu(true), on_cpu(false);
    const std::vector<double> rest = host.nodes(0);
    Copies::Numbers at{true}, speed{true}, forces{true};
    double pushed = 0;
    for (int k = 0; k <= kSteps; k++) {
      std::vector<double> x = rest, v(rest.size(), 0);
      for (std::size_t i = 0; i < x.size(); i += 3) {
        const double phase = 2 * x[i] + x[i + 1], most = 0.001 * k;
        x[i + 2] += most * std::sin(phase);
        v[i + 2] = k == 0 ? 0 : 0.001 / kDt * std::sin(phase);
      }
      host.set_nodes(0, x, v);
      device.set_nodes(0, at.put(x), k % 10 == 9 ? nullptr : speed.put(v));
      if (k % 10 == 9) host.set_nodes(0, x);
      on_cpu.step(host, here, step_with(k == 0));
      on_gpu.step(device, there, step_with(k == 0));
      device.node_forces(0, forces.put(rest));
      const std::vector<double> of_nodes = host.node_forces(0);
      ASSERT_TRUE(same_bytes(there.force, here.force)) << "step " << k;
      ASSERT_TRUE(same_bytes(there.torque, here.torque)) << "step " << k;
      ASSERT_TRUE(same_bytes(forces.get(rest.size()), of_nodes)) << "step " << k;
      if (k % 20 == 7) {
        EXPECT_TRUE(same_bytes(device.nodes(0), x));
        device.nodes(0, at.data());
        EXPECT_TRUE(same_bytes(at.get(x.size()), x));
        EXPECT_TRUE(same_bytes(device.node_forces(0), of_nodes));
      }
      for (const double f : here.force) pushed = std::max(pushed, std::abs(f));
      here.move();
      there = here;
    }
    EXPECT_GT(pushed, 0);
  }
}

// What the host would tell at once the next step tells, and nodes stay where they were; arrays elsewhere are refused.
TEST_F(wall_gpu, tells_of_nodes_in_arrays_of_the_device_in_the_next_step)
{
  const lsdcd::MeshArrays shared = waves_->arrays();    // nodes in place are given once each
  const lsdcd::Mesh waves(shared.vertices, shared.faces);
  const std::string words = "hooke 1e5 5e4 100 50 0.5 1 mesh $waves nodes caller";
  const lsdcd::Values values = {{"waves", waves}};
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall wall(words, values, &options), host(words, values);
  Rain rain(50);
  Copies on_gpu(true);
  on_gpu.step(wall, rain, step_with(true));
  const std::vector<double> rest = wall.nodes(0);
  Copies::Numbers at{true}, speed{true};
  // A step has then failed half-way, and the wall takes no other one.
  const auto error = [&](std::size_t which, double x, double v) {
    lsdcd::Wall failing(words, values, &options);
    on_gpu.step(failing, rain, step_with(true));
    std::vector<double> to = rest, fast(rest.size(), 0);
    to[which] += x;
    fast[which] += v;
    failing.set_nodes(0, at.put(to), speed.put(fast));
    const std::string text = text_of([&] { on_gpu.step(failing, rain, step_of()); });
    EXPECT_TRUE(has(text_of([&] { on_gpu.step(failing, rain, step_of()); }), "it cannot go on"));
    return text;
  };
  EXPECT_TRUE(has(error(4, NAN, 0), "has a position that is not finite"));
  EXPECT_TRUE(has(error(4, 0, NAN), "the velocity of node"));
  EXPECT_TRUE(has(error(4, 3, 0), "has moved by 3 in step"));
  EXPECT_TRUE(has(text_of([&] { host.set_nodes(0, at.data(), nullptr); }),
                  "make the wall with device LSDCD_CUDA"));
  EXPECT_TRUE(
      has(text_of([&] { wall.set_nodes(0, at.data(), rest.data()); }), "are in different memory"));
}

// Waves that wear moves every 5 steps, with arrays on a device and with copies of those of the host. What wears off is a sum in
// another order, so that ways of below 0.1 differ by 300 roundings, 3e-15, and forces as above.
TEST_F(wall_gpu, wear_moves_a_mesh_on_a_device_as_on_the_host)
{
  const std::string words = kOnWaves + "wear archard 1e-2 1e3 deform every 5 factor 10 ";
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall host = wall_of(words), device = wall_of(words, &options),
              copies = wall_of(words + "device cuda");
  constexpr int kSpheres = 300, kSteps = 60;
  constexpr double kRounding = (kSteps + 1) * 6e4 * 3e-15;
  Rain here(kSpheres), there = here, beside = here;
  Copies on_gpu(true), on_cpu(false);
  for (int k = 0; k <= kSteps; k++) {
    on_cpu.step(host, here, step_with(k == 0));
    on_cpu.step(copies, beside, step_with(k == 0));
    on_gpu.step(device, there, step_with(k == 0));
    for (std::size_t i = 0; i < here.force.size(); i++) {
      ASSERT_NEAR(there.force[i], here.force[i], kRounding) << "step " << k;
      ASSERT_NEAR(beside.force[i], here.force[i], kRounding) << "step " << k;
    }
    here.move();
    there = beside = here;
  }
  const lsdcd_wall_totals wanted = host.totals();
  EXPECT_GT(wanted.removed_volume, 1e-6);
  const std::vector<double> at = host.nodes(0);
  for (lsdcd::Wall *wall : {&device, &copies}) {
    EXPECT_NEAR(wall->totals().removed_volume, wanted.removed_volume,
                1e-12 * wanted.removed_volume);
    const std::vector<double> now = wall->nodes(0);
    for (std::size_t i = 0; i < at.size(); i++) EXPECT_NEAR(now[i], at[i], 1e-14);
  }
}

TEST_F(wall_gpu, gives_each_of_two_processes_the_forces_of_arrays_of_the_host)
{
  // Both threads use the GPU at once. No tolerance, as above: no sum is over the processes but that of contacts.
  constexpr int kSpheres = 200, kSteps = 60;
  lsdcd::on_processes(2, [&](lsdcd::FakeHost &fake) {
    Process of_host(fake), of_device(fake);
    of_device.options.device = LSDCD_CUDA;
    lsdcd::Wall host = wall_of(kWavesAndRisingFloor, &of_host.options),
                device = wall_of(kWavesAndRisingFloor, &of_device.options);
    // Other numbers of other spheres.
    const int rank = fake.rank();
    Rain there(kSpheres + 50 * rank, rank), here(kSpheres + 50 * rank, rank);
    Copies on_cuda(true), on_cpu(false);
    int apart = 0, touching = 0;
    for (int k = 0; k <= kSteps; k++) {
      on_cpu.step(host, here, step_with(k == 0));
      on_cuda.step(device, there, step_with(k == 0));
      apart += !same_bytes(there.force, here.force) || !same_bytes(there.torque, here.torque);
      for (std::size_t i = 2; i < here.force.size(); i += 3) touching += here.force[i] != 0;
      apart += device.totals().contacts != host.totals().contacts;
      here.move();
      there.move();
    }
    EXPECT_EQ(apart, 0) << "process " << rank;
    EXPECT_GT(touching, kSteps) << "process " << rank;
  });
}

TEST_F(wall_gpu, lets_springs_follow_spheres_that_change_their_numbers)
{
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall straight = wall_of(kOnWaves, &options), turned = wall_of(kOnWaves, &options),
              restored = wall_of(kOnWaves, &options);
  Rain a(100), b(100);
  Copies copies(true), others(true);
  for (int k = 0; k < 30; k++) {
    copies.step(straight, a, step_of());
    others.step(turned, b, step_of());
    a.move();
    b.move();
  }
  std::vector<std::ptrdiff_t> order(100);
  Rain c = b;
  for (int i = 0; i < 100; i++) {
    order[i] = 99 - i;
    for (int k = 0; k < 3; k++) {
      c.x[3 * i + k] = b.x[3 * order[i] + k];
      c.v[3 * i + k] = b.v[3 * order[i] + k];
      c.omega[3 * i + k] = b.omega[3 * order[i] + k];
    }
    c.radius[i] = b.radius[order[i]];
    c.mass[i] = b.mass[order[i]];
  }
  restored.restore(straight.save());
  const std::vector<double> packed = turned.pack(order);
  turned.renumber(std::vector<std::ptrdiff_t>(100, -1));
  std::vector<std::ptrdiff_t> same(100);
  for (int i = 0; i < 100; i++) same[i] = i;
  turned.unpack(same, packed);
  Rain d = a;
  copies.step(straight, a, step_of());
  others.step(turned, c, step_of());
  Copies again(true);
  again.step(restored, d, step_of());
  EXPECT_TRUE(same_bytes(d.force, a.force));
  double most = 0;
  for (int i = 0; i < 100; i++)
    for (int k = 0; k < 3; k++) {
      ASSERT_EQ(c.force[3 * i + k], a.force[3 * order[i] + k]) << i;
      most = std::max(most, std::abs(a.force[3 * i + k]));
    }
  EXPECT_GT(most, 0);
}

TEST_F(wall_gpu, acts_through_a_periodic_face_and_warns_past_it)
{
  Shown shown;
  shown.device = LSDCD_CUDA;
  set_box(shown, 20);
  lsdcd::Wall wall = floor_wall("move 0 0 -19.6", &shown);
  Rain one(1);
  one.radius = {0.5};
  one.v = one.omega = {0, 0, 0};
  one.x = {0, 0, 19.92};    // the image of the floor is at z = 20.4
  Copies copies(true);
  copies.step(wall, one, step_of());
  EXPECT_NEAR(one.force[2], -kN * 0.02, kN * 1e-13);
  EXPECT_TRUE(shown.warnings.empty());
  one.x[2] = 20.3;
  copies.step(wall, one, step_of());
  ASSERT_EQ(shown.warnings.size(), 1u);
  EXPECT_TRUE(begins(shown.warnings[0], "a grain was 0.3 past a periodic face"));
}

TEST_F(wall_gpu, tells_of_a_sphere_in_the_next_call)
{
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall wall = wall_of(kHertz + "mesh $floor", &options);
  Rain rain(2);
  rain.x = {0, 0, 0.05, 1, 0, 0.05};
  Copies copies(true);
  copies.step(wall, rain, step_of());
  rain.radius[1] *= 2;    // without `changed`
  copies.step(wall, rain, step_of());
  const std::string told = text_of([&] { wall.totals(); });
  EXPECT_TRUE(begins(told, "sphere 1 (from 0) has"));
  EXPECT_EQ(text_of([&] { copies.step(wall, rain, step_of()); }), told);
}

TEST_F(wall_gpu, takes_radii_that_have_grown)
{
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall wall = wall_of(kHooke + "mesh $floor", &options);
  Rain rain(1);
  rain.x = {0, 0, 0.3};
  rain.radius = {0.2};
  Copies copies(true);
  copies.step(wall, rain, step_of());
  EXPECT_EQ(rain.force[2], 0);
  rain.radius = {0.5};
  copies.step(wall, rain, step_with(false, true));
  EXPECT_NEAR(rain.force[2], 1000 * 0.2, 1000 * kRounding);
}

TEST_F(wall_gpu, checks_types_in_steps_that_look)
{
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall wall = wall_of(kHooke + "mesh $floor law types 2 " + kHooke, &options);
  Rain rain(2);
  Copies copies(true);
  copies.step(wall, rain, step_of());
  rain.type[1] = -1;
  EXPECT_EQ(text_of([&] { copies.step(wall, rain, step_with(false, true)); }),
            "type[1] is -1, below 1");
}

TEST_F(wall_gpu, refuses_an_array_that_is_elsewhere_before_it_writes)
{
  const std::string words = kHooke + "mesh $floor";
  const lsdcd::WallOptions options = on_device();
  lsdcd::Wall host = wall_of(words), device = wall_of(words, &options);
  Rain rain(1);
  rain.x = {0, 0, 0.05};
  Copies on_gpu(true);
  lsdcd_spheres s = on_gpu.of(rain);
  s.torque = rain.torque.data();
  EXPECT_EQ(text_of([&] { device.step(s, step_of()); }),
            "the array `torque` is in the host's memory; the wall takes arrays of the device: make "
            "the wall "
            "where the arrays of spheres are");
  EXPECT_EQ(on_gpu.force.get(3), std::vector<double>(3, 0));
  s.torque = on_gpu.torque.data();
  EXPECT_EQ(text_of([&] { host.step(s, step_of()); }),
            "the array `x` is in a GPU's memory: make the wall with device LSDCD_CUDA");
  device.step(s, step_of());
  EXPECT_GT(on_gpu.force.get(3)[2], 0);
}

// The word device says where forces of arrays of the host are computed.
TEST_F(wall_gpu, with_arrays_on_a_device_takes_no_device_in_words)
{
  const lsdcd::WallOptions options = on_device();
  for (const char *device : {"cpu", "cuda"}) {
    const auto make = [&] { wall_of(kHooke + "mesh $floor device " + device, &options); };
    EXPECT_TRUE(is_refused("in 'device', the arrays of the spheres say where", make));
    EXPECT_EQ(code_of(make), LSDCD_ERROR_ARGUMENT) << device;
  }
}

TEST_F(wall_gpu, keeps_the_order_of_its_stream)
{
  cudaStream_t stream;
  ASSERT_EQ(cudaStreamCreateWithFlags(&stream, cudaStreamNonBlocking), cudaSuccess);
  {
    const lsdcd::WallOptions options = on_device(stream);
    lsdcd::Wall wall = wall_of(kHooke + "mesh $floor", &options);
    Rain rain(1);
    rain.radius = {0.2};
    rain.x = {0, 0, 0.15};
    Copies copies(true);
    const lsdcd_spheres s = copies.of(rain);
    wall.step(s, step_of());
    // The stream clears the force, after much other work, and lifts the sphere.
    lsdcd::DeviceArray<char> work(true);
    constexpr std::size_t kMuch = std::size_t(1) << 28;
    work.resize(kMuch);
    for (int k = 0; k < 20; k++) cudaMemsetAsync(work.data(), k, kMuch, stream);
    const double higher[3] = {0, 0, 0.19};
    cudaMemsetAsync(s.force, 0, 3 * sizeof(double), stream);
    cudaMemcpyAsync(const_cast<double *>(s.x), higher, sizeof higher, cudaMemcpyHostToDevice,
                    stream);
    wall.step(s, step_of());
    double force[3];
    cudaMemcpyAsync(force, s.force, sizeof force, cudaMemcpyDeviceToHost, stream);
    cudaStreamSynchronize(stream);
    EXPECT_NEAR(force[2], 1000 * 0.01, 1000 * kRounding);
  }
  cudaStreamDestroy(stream);
}

}    // namespace
