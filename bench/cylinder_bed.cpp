// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "cylinder_bed.h"

#include "bench.h"

#include "mesh/welded_mesh.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <tuple>

namespace lsdcd {

namespace {

constexpr Real kRadius = 50, kHeight = 100;
constexpr Real kSmallest = 0.35, kLargest = 1;
constexpr Real kMargin = 0.05;    // how far spheres may move before the next choice

// Shirley and Chiu's map of the square, -1 to 1, to the disk.
std::array<Real, 2> on_disk(Real a, Real b)
{
  if (a == 0 && b == 0) return {0, 0};
  const bool by_a = std::abs(a) > std::abs(b);
  const Real r = by_a ? a : b, turn = by_a ? kPi / 4 * b / a : kPi / 2 - kPi / 4 * a / b;
  return {kRadius * r * std::cos(turn), kRadius * r * std::sin(turn)};
}

}    // namespace

EvenCylinder::EvenCylinder(double triangles)
{
  // 2 round along + round^2 / 4 triangles, sides about as wide as high.
  const int k = std::max(1, int(std::lround(std::sqrt(triangles / (2 / kPi + 0.25)) / 4)));
  n_round = 4 * k;
  n_along = std::max(1, int(std::lround((triangles - 4. * k * k) / (2. * n_round))));
  half_angle = kPi / n_round;
  apothem = kRadius * std::cos(half_angle);
}

Real EvenCylinder::depth(Real x, Real y) const
{
  // The first corner is at 45 degrees.
  const Real side = 2 * half_angle, turn = std::atan2(y, x) - kPi / 4;
  const Real inside = turn - side * std::floor(turn / side) - half_angle;
  return apothem - std::hypot(x, y) * std::cos(inside);
}

TriangleSoup EvenCylinder::mesh() const
{
  TriangleSoup soup;
  soup.source = "closed cylinder";
  const auto quad = [&](const Vec3 &a, const Vec3 &b, const Vec3 &c, const Vec3 &d) {
    soup.corners.insert(soup.corners.end(), {a, b, c, a, c, d});
  };
  const auto ring = [&](int s, Real z) {
    const Real turn = kPi / 4 + 2 * half_angle * (s % n_round);
    return Vec3{kRadius * std::cos(turn), kRadius * std::sin(turn), z};
  };
  for (int s = 0; s < n_round; s++)
    for (int t = 0; t < n_along; t++) {
      const Real z0 = kHeight * t / n_along, z1 = kHeight * (t + 1) / n_along;
      quad(ring(s, z0), ring(s + 1, z0), ring(s + 1, z1), ring(s, z1));
    }
  const int k = n_round / 4;
  for (Real z : {Real(0), kHeight})
    for (int j = 0; j < k; j++)
      for (int i = 0; i < k; i++) {
        const auto at = [&](int p, int q) {
          const auto xy = on_disk(Real(2) * (i + p) / k - 1, Real(2) * (j + q) / k - 1);
          return Vec3{xy[0], xy[1], z};
        };
        // The diagonal that runs to the centre: the other one is nearly on the circle.
        if ((2 * i + 1 - k) * (2 * j + 1 - k) >= 0)
          quad(at(0, 0), at(1, 0), at(1, 1), at(0, 1));
        else
          quad(at(1, 0), at(1, 1), at(0, 1), at(0, 0));
      }
  return soup;
}

SphereArrays bed_spheres(const EvenCylinder &wall, int n, bool sorted)
{
  std::mt19937_64 random(7);
  // Standard distributions differ between libraries, these numbers do not.
  const auto between = [&](Real lo, Real hi) {
    return lo + (hi - lo) * Real(random() >> 11) * Real(0x1p-53);
  };
  struct One {
    Real x, y, z, r;
  };
  std::vector<One> all(n);
  for (One &s : all) {
    s.r = between(kSmallest, kLargest);
    const Real gap = s.r * (1 - between(Real(0.01), Real(0.05)));
    if (between(0, 1) < kHeight / (kHeight + kRadius)) {    // sides and caps by their areas
      const Real side = 2 * wall.half_angle, inside = between(-wall.half_angle, wall.half_angle);
      const Real turn =
          kPi / 4 + side * (std::floor(between(0, wall.n_round)) + Real(0.5)) + inside;
      const Real rho = (wall.apothem - gap) / std::cos(inside);
      s = {rho * std::cos(turn), rho * std::sin(turn), between(kLargest, kHeight - kLargest), s.r};
    } else {
      do {
        s.x = between(-kRadius, kRadius);
        s.y = between(-kRadius, kRadius);
      } while (wall.depth(s.x, s.y) < kLargest);
      s.z = between(0, 1) < Real(0.5) ? gap : kHeight - gap;
    }
  }
  if (sorted) {
    const auto cube = [](const One &s) {
      return std::make_tuple(int(s.z / 3), int((s.y + 60) / 3), int((s.x + 60) / 3));
    };
    std::stable_sort(all.begin(), all.end(),
                     [&](const One &a, const One &b) { return cube(a) < cube(b); });
  }
  SphereArrays spheres;
  for (const One &s : all) {
    Vec3 v, omega;
    for (int k = 0; k < 3; k++) {
      v[k] = between(-1, 1);
      omega[k] = between(-1, 1);
    }
    spheres.add({s.x, s.y, s.z}, s.r, 1, v, omega);
  }
  return spheres;
}

CylinderBed::CylinderBed(const EvenCylinder &wall, const SphereArrays &spheres,
                         const ContactLaw &law, Device device) :
    arrays_(device == Device::cuda)
{
  const bool cuda = device == Device::cuda;
  const TriangleSoup soup = wall.mesh();
  const double began = clock_ms();
  const WeldedMesh mesh = weld(soup, -1);
  StepGridSettings grid;
  grid.cutoff = kLargest;
  grid.for_gpu = cuda;
  grid_ = FlatOf(build_grid(mesh, grid, cuda));
  build_ms = clock_ms() - began;
  triangles = mesh.faces.size();

  EngineSettings e;
  e.device = device;
  e.law() = law;
  engine_ = cuda ? make_cuda_engine_in_place(e, 0, nullptr) : make_cpu_engine(e);
  engine_->set_grid(grid_.view());
  spheres_ = arrays_.put(spheres);
  choose();
}

void CylinderBed::choose()
{
  engine_->choose(spheres_, kMargin);
}

void CylinderBed::steps(int n)
{
  StepSettings step;
  step.dt = Real(1e-6);
  for (int k = 0; k < n; k++) engine_->step(spheres_, step);
  engine_->read_diagnostics();
}

}    // namespace lsdcd
