// A drum: the same spheres at the wall of a closed cylinder of 2e4 triangles at rest, and turning
// about its axis, with spheres that it carries along and with spheres that stay behind.
#include "bench.h"
#include "cylinder_bed.h"

#include "mesh/wall_mesh.h"

#include <cmath>

using namespace lsdcd;

namespace {

constexpr int kSteps = 100;
constexpr Real kRadius = 50, kWay = 1e-3;    // of the wall at its radius, in a step
// Of half the skin, which is 0.1 here: after 100 steps a turning wall makes the fix choose anew.
constexpr Real kMargin = Real(0.1) + kSteps * kWay;

WallPose turned(int step, Real dt)
{
  const Real angle = step * kWay / kRadius, c = std::cos(angle), s = std::sin(angle);
  WallPose pose;
  pose.row[0] = {c, -s, 0};
  pose.row[1] = {s, c, 0};
  pose.angular = {0, 0, kWay / kRadius / dt};
  pose.placed = true;
  return pose;
}

class Drum {
 public:
  Drum(const GridView &grid, const BedSpheres &b, Device device) :
      x_(device == Device::cuda), rest_(device == Device::cuda), places_(b.x)
  {
    const bool cuda = device == Device::cuda;
    EngineSettings e;
    e.device = device;
    e.law.style = LawStyle::hertz_history;
    e.law.k_normal = 1e5;
    e.law.k_tangent = 3e4;
    e.law.gamma_normal = 50;
    e.law.gamma_tangent = 25;
    e.law.mu = Real(0.5);
    e.moves = true;
    engine_ = cuda ? make_cuda_engine_in_place(e, 0, nullptr) : make_cpu_engine(e);
    engine_->set_grid(grid);

    const std::size_t n = b.radius.size();
    std::vector<Real> all = b.v;
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

  // Steps of a wall that turns or does not, with the spheres where it takes them or where they are.
  void run(bool turns, bool carries)
  {
    if (turns) {
      engine_->place_wall(turned(0, kDt));
      choose();
    }
    StepSettings step;
    step.dt = kDt;
    for (int k = 0; k < kSteps; k++) {
      if (turns) engine_->place_wall(turned(k, kDt));
      if (carries) spheres_.x = x_.data() + k * places_.size();
      engine_->start(spheres_, step);
      engine_->collect();
    }
    engine_->read_diagnostics();
  }

  // All places that carried spheres have, beforehand.
  void put_places(bool carries)
  {
    std::vector<Real> all;
    for (int k = 0; k < (carries ? kSteps : 1); k++) {
      const WallPose pose = turned(k, kDt);
      for (std::size_t i = 0; i < places_.size(); i += 3) {
        const Vec3 x = pose.to_box({places_[i], places_[i + 1], places_[i + 2]});
        all.insert(all.end(), {x.x, x.y, x.z});
      }
    }
    spheres_.x = x_.put(all);
    choose();
  }
  std::int64_t contacts() const { return engine_->totals().contacts; }

 private:
  static constexpr Real kDt = 1e-6;

  void choose()
  {
    spheres_.x = x_.data();
    engine_->choose(spheres_, kMargin);
  }

  std::unique_ptr<InPlaceEngine> engine_;
  DeviceArray<Real> x_, rest_;
  std::vector<Real> places_;
  Spheres spheres_;
};

void measure(const BenchOptions &o, BenchRows &rows)
{
  const int n = static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 1e4 : 1e5);
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 5;
  const EvenCylinder wall(2e4);
  const WallMesh mesh = weld(wall.mesh(), -1);
  GridSettings settings;
  settings.cutoff = 1;
  const FlatGrid grid(build_grid(mesh, settings));
  for (Device device : o.devices) {
    rows.begin(device);
    for (bool sorted : {false, true}) {
      Drum drum(grid.view(), BedSpheres(wall, n, sorted), device);
      BenchRow row;
      row.triangles = mesh.faces.size();
      row.spheres = n;
      row.order = sorted ? "sorted" : "random";
      double at_rest = 0;
      const auto add = [&](const char *what, bool turns, bool carries) {
        drum.put_places(carries);
        row.what = what;
        row.timing = time_it(repeats, [&] { drum.run(turns, carries); });
        for (double *ms : {&row.timing.median_ms, &row.timing.min_ms, &row.timing.max_ms})
          *ms /= kSteps;
        if (!turns) at_rest = row.timing.median_ms;
        row.facts = format("contacts=%lld over_rest=%.3f", static_cast<long long>(drum.contacts()),
                           row.timing.median_ms / at_rest);
        rows.add(row);
      };
      add("hertz/history, at rest", false, false);
      add("hertz/history, turning, carried along", true, true);
      add("hertz/history, turning, staying behind", true, false);
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "turning", "A cylinder at rest and turning: CSV.", measure);
}
