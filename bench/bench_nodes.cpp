// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A sheet over which waves run, as a mesh whose nodes move and as a rigid mesh that has the shape of the first step:
// about 1e3, 1e4 and 1e5 triangles, with as many spheres, all of which touch it.
//
// Spheres go where the sheet goes, and slide along it in both cases. A step is that of a host program: places and
// velocities of nodes are given, forces of nodes are asked for. Steps of both walls take turns, so that what else
// the machine does is in both; the least times are nearest to the truth. *In place*: spheres are in the memory of a GPU.
#include "bench.h"

#include "support/device_memory.h"
#include "support/fake_host.h"
#include "support/grains.h"
#include "support/meshes.h"
#include "support/random.h"
#include "wall/wall.h"

#include <cmath>
#include <numeric>

using namespace lsdcd;

namespace {

// Edges of squares are as long as the largest sphere is wide. In a step nodes go up to a thousandth of its radius, and
// spheres as far along the sheet: lists hold for 50 steps and the grid of nodes for 150.
constexpr Real kRadius = 0.5, kSmallest = 0.35, kDt = 1e-5, kWay = 5e-4;
constexpr Real kHeight = 1, kWave = 2 * kPi / 40;    // of waves along x and y
constexpr int kSteps = 50;                           // that are timed at once

struct Sheet {
  std::shared_ptr<const WeldedMesh> flat;
  Real half;

  explicit Sheet(int n) : half(Real(n) / 2)
  {
    flat = std::make_shared<WeldedMesh>(weld(floor_mesh(n, half), -1));
  }
  static Real phase(const Vec3 &x, int step) { return kWave * x.x - kWay / kHeight * step; }
  std::vector<Vec3> at(int step) const
  {
    std::vector<Vec3> all = flat->vertices;
    for (Vec3 &x : all) x.z = kHeight * std::sin(phase(x, step)) * std::cos(kWave * x.y);
    return all;
  }
  std::vector<Vec3> velocity(int step) const
  {
    std::vector<Vec3> all = flat->vertices;
    for (Vec3 &x : all) x = {0, 0, -kWay / kDt * std::cos(phase(x, step)) * std::cos(kWave * x.y)};
    return all;
  }
};

class Bed {
 public:
  // `in_place`: spheres are in the memory of a GPU, and so are what a step is given of nodes and the forces on them.
  Bed(const Sheet &sheet, int n_spheres, bool has_nodes, Device device, bool in_place) :
      sheet_(sheet), has_nodes_(has_nodes), in_place_(in_place)
  {
    WallSpec spec;
    spec.device = device;
    spec.laws.front().law = usual_law(NormalModel::hertz, true);
    spec.meshes.resize(1);
    spec.meshes.front().name = "sheet";
    spec.meshes.front().has_nodes = has_nodes;
    WeldedMesh mesh = *sheet.flat;
    if (!has_nodes) mesh.vertices = sheet.at(0);
    spec.meshes.front().mesh = std::make_shared<WeldedMesh>(mesh);
    host_.simulation = wide_box();
    for (int k = 0; k < 3; k++) {
      host_.simulation.corner[k] = -2 * sheet.half;
      host_.simulation.edge[k][k] = 4 * sheet.half;
    }
    WallBackend backend;
    if (in_place)
      backend = {[](const EngineSettings &s) { return make_cuda_engine_in_place(s, 0, nullptr); },
                 true, [this](const HostSpheres &, CpuArrays) { return grains_.spheres(); }};
    wall_ = std::make_unique<Wall>(host_, spec, WallUnits(), backend, "", StepClock{0, 0, 0, kDt});
    Random random(5);
    const Real most = sheet.half - 2;
    for (int i = 0; i < n_spheres; i++) {
      const Real r = uniform(random, kSmallest, kRadius);
      grains_.add({uniform(random, -most, most), uniform(random, -most, most), 0}, r);
      on_sheet_.push_back(r * (1 - uniform(random, 0.01, 0.05)));
      const Real turn = uniform(random, 0, 2 * kPi);
      way_.push_back({kWay * std::cos(turn), kWay * std::sin(turn), 0});
    }
    // In the order of bins, as host programs sort them.
    const auto bin = [&](const Vec3 &p) {
      return std::int64_t(p.y + sheet.half) * 4096 + std::int64_t(p.x + sheet.half);
    };
    std::sort(grains_.x.begin(), grains_.x.end(),
              [&](const Vec3 &a, const Vec3 &b) { return bin(a) < bin(b); });
    go(0);
    order_.resize(nodes_.size());
    std::iota(order_.begin(), order_.end(), 0);
    wall_->begin_run(0, false);
    step(Step::setup);
  }

  // Milliseconds of kSteps.
  double run()
  {
    double ms = 0;
    for (int k = 0; k < kSteps; k++) {
      now_++;
      go(has_nodes_ ? now_ : 0);
      ms += step(Step::step);
    }
    return ms;
  }
  std::int64_t contacts() { return static_cast<std::int64_t>(wall_->totals().mesh(0).contacts); }
  std::size_t bytes() const { return wall_->bytes(); }

 private:
  // Spheres to where the sheet is in this step. Their velocities do not change where they go.
  void go(int step)
  {
    const std::vector<Vec3> z = sheet_.at(step);
    nodes_ = z;
    velocity_ = sheet_.velocity(step);
    const int n = static_cast<int>(std::lround(2 * sheet_.half));
    if (z_of_.empty()) {
      z_of_.resize(std::size_t(n + 1) * (n + 1));
      for (std::size_t k = 0; k < z.size(); k++)
        z_of_[std::lround(z[k].y + sheet_.half) * (n + 1) + std::lround(z[k].x + sheet_.half)] =
            static_cast<int>(k);
    }
    const Real most = sheet_.half - 2;
    for (std::size_t k = 0; k < grains_.x.size(); k++) {
      Vec3 p = under_.empty() || under_.size() <= k ? grains_.x[k] : under_[k];
      p += way_[k];
      for (int d = 0; d < 2; d++)
        if (std::fabs(p[d]) > most) way_[k][d] = std::copysign(way_[k][d], -p[d]);
      const int i = static_cast<int>(p.x + sheet_.half), j = static_cast<int>(p.y + sheet_.half);
      const auto at = [&](int a, int b) { return z[z_of_[(j + b) * (n + 1) + i + a]]; };
      const Vec3 a = at(0, 0), c = at(1, 1);
      const bool lower = p.x - a.x > p.y - a.y;
      const Vec3 b = lower ? at(1, 0) : at(0, 1);
      Vec3 normal = cross(b - a, c - a);
      normal = ((lower ? 1 : -1) / norm(normal)) * normal;
      p.z = a.z - (normal.x * (p.x - a.x) + normal.y * (p.y - a.y)) / normal.z;
      if (under_.size() <= k)
        under_.push_back(p);
      else
        under_[k] = p;
      grains_.x[k] = p + on_sheet_[k] * normal;
    }
  }
  // Milliseconds of the step, without what brings spheres to a GPU.
  double step(Step::Kind kind)
  {
    const HostSpheres spheres = in_place_ ? on_gpu() : grains_.spheres();
    const std::size_t n = 3 * nodes_.size();
    if (in_place_ && has_nodes_) {
      arrays_[7].put(&nodes_[0].x, n);
      arrays_[8].put(&velocity_[0].x, n);
    }
    const double start = clock_ms();
    if (has_nodes_ && in_place_)
      wall_->set_nodes_in_place(0, arrays_[7].data(), arrays_[8].data(), order_);
    else if (has_nodes_)
      wall_->set_nodes(0, &nodes_[0].x, &velocity_[0].x);
    wall_->history().grow(static_cast<int>(grains_.x.size()));
    StepInput input;
    input.step = {now_, kDt, kind};
    input.look = input.new_spheres = kind == Step::setup;
    input.drift.kind = SphereDrift::watched;
    input.drift.distance = 0.1 * kRadius;
    wall_->begin(spheres, input);
    wall_->submit(spheres);
    wall_->finish(spheres);
    if (has_nodes_ && !(in_place_ && wall_->put_node_forces(0, arrays_[9].resize(n), order_)))
      sum_ += wall_->node_forces(0).front();
    if (in_place_) sum_ += arrays_[3].get(1).front();    // waits for the forces
    return clock_ms() - start;
  }
  HostSpheres on_gpu()
  {
    HostSpheres s = grains_.spheres();
    const std::size_t n = 3 * static_cast<std::size_t>(s.n);
    const auto put = [&](int k, const std::vector<Vec3> &from) {
      return arrays_[k].put(&from[0].x, n);
    };
    s.x = put(0, grains_.x);
    s.v = put(1, grains_.v);
    s.omega = put(2, grains_.omega);
    s.force = put(3, grains_.force);
    s.torque = put(4, grains_.torque);
    s.radius = arrays_[5].put(grains_.radius);
    s.mass = arrays_[6].put(grains_.mass);
    return s;
  }

  const Sheet &sheet_;
  bool has_nodes_, in_place_;
  // Seven of spheres, three of nodes.
  DeviceArray<Real> arrays_[10] = {DeviceArray<Real>(in_place_), DeviceArray<Real>(in_place_),
                                   DeviceArray<Real>(in_place_), DeviceArray<Real>(in_place_),
                                   DeviceArray<Real>(in_place_), DeviceArray<Real>(in_place_),
                                   DeviceArray<Real>(in_place_), DeviceArray<Real>(in_place_),
                                   DeviceArray<Real>(in_place_), DeviceArray<Real>(in_place_)};
  std::vector<int> order_;    // rows of those of nodes: node after node
  FakeHost host_;
  std::unique_ptr<Wall> wall_;
  Grains grains_;
  std::vector<Vec3> nodes_, velocity_, under_, way_;
  std::vector<Real> on_sheet_;
  std::vector<int> z_of_;
  int now_ = 0;
  Real sum_ = 0;
};

void measure_on(Device device, bool in_place, const BenchOptions &o, BenchRows &rows)
{
  const double most = o.most_triangles > 0 ? o.most_triangles : o.quick ? 1e3 : 1e5;
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 5;
  rows.begin(device);
  for (const int n : {22, 71, 224}) {
    if (2. * n * n > 1.1 * most) continue;
    const Sheet sheet(n);
    const int n_spheres = static_cast<int>(o.spheres > 0 ? o.spheres : 2. * n * n);
    Bed rigid(sheet, n_spheres, false, device, in_place),
        nodes(sheet, n_spheres, true, device, in_place);
    std::vector<double> ms[2];
    for (int k = 0; k <= repeats; k++)    // one to warm up
      for (Bed *bed : {&rigid, &nodes}) {
        const double all = bed->run();
        if (k > 0) ms[bed == &nodes].push_back(all / kSteps);
      }
    BenchRow row;
    row.triangles = sheet.flat->faces.size();
    row.spheres = n_spheres;
    row.order = "sorted";
    const Timing of_rigid = timing_of(ms[0]);
    for (Bed *bed : {&rigid, &nodes}) {
      row.what = bed == &nodes ? "hertz/history, nodes" : "hertz/history, rigid";
      if (in_place) row.what += ", in place";
      row.timing = timing_of(ms[bed == &nodes]);
      row.facts =
          format("contacts=%lld bytes=%zu over_rigid=%.2f over_rigid_min=%.2f",
                 static_cast<long long>(bed->contacts()), bed->bytes(),
                 row.timing.median_ms / of_rigid.median_ms, row.timing.min_ms / of_rigid.min_ms);
      rows.add(row);
    }
  }
}

void measure(const BenchOptions &o, BenchRows &rows)
{
  for (const Device device : o.devices) {
    measure_on(device, false, o, rows);
    if (device == Device::cuda) measure_on(device, true, o, rows);
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "nodes", "A rigid sheet and one whose nodes move: CSV.", measure);
}
