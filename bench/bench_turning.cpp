// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A drum: the same spheres at the wall of a closed cylinder of 2e4 triangles at rest, and turning
// about its axis, with spheres that it carries along and with spheres that stay behind.
//
// Rows differ in the wall and in what slides, and in nothing else. In each of them the places are other
// memory in each step, as those that a host code has just integrated are; spheres that are carried along
// have the wall's velocity. Choices of near spheres are not in the times but in a fact: a host code makes
// them for whatever moves, and not for the wall alone. Runs of the rows take turns, so that what else the
// machine does is in all of them.
#include "bench.h"
#include "cylinder_bed.h"

#include "mesh/welded_mesh.h"

#include <cmath>

using namespace lsdcd;

namespace {

constexpr int kSteps = 100;
constexpr Real kRadius = 50, kWay = 1e-3;    // of the wall at its radius, in a step
// Half the skin is 0.1 here: after 100 steps a turning wall makes the fix choose again.
constexpr Real kMargin = Real(0.1) + kSteps * kWay;

Pose turned(int step, Real dt)
{
  const Real angle = step * kWay / kRadius, c = std::cos(angle), s = std::sin(angle);
  Pose pose;
  pose.row[0] = {c, -s, 0};
  pose.row[1] = {s, c, 0};
  pose.angular = {0, 0, kWay / kRadius / dt};
  pose.placed = true;
  return pose;
}

struct Case {
  const char *what;
  bool turns, carries;
};
constexpr Case kCases[] = {{"hertz/history, at rest", false, false},
                           {"hertz/history, turning, carried along", true, true},
                           {"hertz/history, turning, staying behind", true, false}};
constexpr Real kDt = 1e-6;

// Positions of spheres in each step: where the wall takes them, or where they are.
std::vector<Real> places(const BedSpheres &b, bool carries)
{
  std::vector<Real> all;
  all.reserve(kSteps * b.x.size());
  for (int k = 0; k < kSteps; k++) {
    const Pose pose = carries ? turned(k, kDt) : Pose();
    for (std::size_t i = 0; i < b.x.size(); i += 3) {
      const Vec3 x = pose.to_box({b.x[i], b.x[i + 1], b.x[i + 2]});
      all.insert(all.end(), {x.x, x.y, x.z});
    }
  }
  return all;
}

class Drum {
 public:
  // `x`: places of all steps.
  Drum(const GridView &grid, const BedSpheres &b, const Real *x, const Case &of, Device device) :
      x_(x), case_(of), rest_(device == Device::cuda)
  {
    const bool cuda = device == Device::cuda;
    EngineSettings e;
    e.device = device;
    e.law() = classic_law(NormalModel::hertz, true);
    e.law().k_normal = 1e5;
    e.law().k_tangent = 3e4;
    e.law().eta = 50;
    e.law().gamma_tangent = 25;
    e.law().mu = Real(0.5);
    e.moves = true;
    engine_ = cuda ? make_cuda_engine_in_place(e, 0, nullptr) : make_cpu_engine(e);
    engine_->set_grid(grid);

    const std::size_t n = b.radius.size();
    std::vector<Real> all = b.v;
    for (std::size_t i = 0; of.carries && i < all.size(); i += 3) {
      const Vec3 v = cross(turned(0, kDt).angular, {b.x[i], b.x[i + 1], b.x[i + 2]});
      for (int d = 0; d < 3; d++) all[i + d] += v[d];
    }
    all.insert(all.end(), b.omega.begin(), b.omega.end());
    all.insert(all.end(), b.radius.begin(), b.radius.end());
    all.insert(all.end(), b.mass.begin(), b.mass.end());
    all.resize(14 * n, 0);
    Real *at = rest_.put(all);
    spheres_.n = static_cast<int>(n);
    spheres_.v = at;
    spheres_.omega = at + 3 * n;
    spheres_.radius = at + 6 * n;
    spheres_.mass = at + 7 * n;
    spheres_.force = at + 8 * n;
    spheres_.torque = at + 11 * n;
  }

  // Chooses the near spheres.
  void choose()
  {
    if (case_.turns) engine_->set_pose(turned(0, kDt));
    spheres_.x = x_;
    engine_->choose(spheres_, kMargin);
    engine_->read_diagnostics();
  }
  void steps()
  {
    StepSettings step;
    step.dt = kDt;
    for (int k = 0; k < kSteps; k++) {
      if (case_.turns) engine_->set_pose(turned(k, kDt));
      spheres_.x = x_ + k * 3 * static_cast<std::size_t>(spheres_.n);
      engine_->step(spheres_, step);
    }
    lists_ = static_cast<double>(engine_->read_diagnostics().lists);
  }
  std::int64_t contacts() const { return engine_->results().totals().contacts; }
  // Made in a step, of each sphere.
  double lists() const { return lists_ / kSteps / spheres_.n; }

 private:
  const Real *x_;
  Case case_;
  std::unique_ptr<WallEngine> engine_;
  DeviceArray<Real> rest_;
  Spheres spheres_;
  double lists_ = 0;
};

double ms_of(Drum &drum, void (Drum::*what)())
{
  const double start = clock_ms();
  (drum.*what)();
  return clock_ms() - start;
}

void measure(const BenchOptions &o, BenchRows &rows)
{
  const int n = static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 1e4 : 1e5);
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 5;
  const EvenCylinder wall(2e4);
  const WeldedMesh mesh = weld(wall.mesh(), -1);
  GridSettings settings;
  settings.cutoff = 1;
  for (Device device : o.devices) {
    settings.for_gpu = device == Device::cuda;
    const FlatGrid grid(build_grid(mesh, settings));
    rows.begin(device);
    for (bool sorted : {false, true}) {
      const BedSpheres bed(wall, n, sorted);
      DeviceArray<Real> still(device == Device::cuda), carried(device == Device::cuda);
      still.put(places(bed, false));
      carried.put(places(bed, true));
      std::vector<std::unique_ptr<Drum>> drums;
      for (const Case &c : kCases)
        drums.push_back(std::make_unique<Drum>(grid.view(), bed,
                                               (c.carries ? carried : still).data(), c, device));
      std::vector<double> steps[3], choices[3];
      for (int k = 0; k <= repeats; k++)    // one to warm up
        for (std::size_t c = 0; c < drums.size(); c++) {
          const double choice = ms_of(*drums[c], &Drum::choose);
          const double all = ms_of(*drums[c], &Drum::steps);
          if (k == 0) continue;
          choices[c].push_back(choice);
          steps[c].push_back(all / kSteps);
        }
      BenchRow row;
      row.triangles = mesh.faces.size();
      row.spheres = n;
      row.order = sorted ? "sorted" : "random";
      const Timing at_rest = timing_of(steps[0]);
      for (std::size_t c = 0; c < drums.size(); c++) {
        row.what = kCases[c].what;
        row.timing = timing_of(steps[c]);
        row.facts =
            format("contacts=%lld lists_anew=%.4f choice_ms=%.2f over_rest=%.3f over_rest_min=%.3f",
                   static_cast<long long>(drums[c]->contacts()), drums[c]->lists(),
                   timing_of(choices[c]).median_ms, row.timing.median_ms / at_rest.median_ms,
                   row.timing.min_ms / at_rest.min_ms);
        rows.add(row);
      }
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "turning", "A cylinder at rest and turning: CSV.", measure);
}
