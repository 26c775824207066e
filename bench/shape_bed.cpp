// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "shape_bed.h"

#include "support/laws.h"
#include "support/random.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {
namespace {

constexpr int kSide = 60;    // facets along x
constexpr Real kSunk = 0.01, kWay = 1e-3, kDt = 1e-6;
constexpr Real kHeight = 0.3;    // of ridges over the length of a facet

// A plane of triangles, or ridges along y, of which every second line is an edge that is 0.3 high.
TriangleSoup terrain(Real length, bool has_ridges)
{
  TriangleSoup soup;
  soup.source = has_ridges ? "ridges" : "plane";
  const auto at = [&](int i, int j) {
    return Vec3{i * length, j * length, has_ridges && i % 2 ? kHeight * length : 0};
  };
  for (int i = 0; i < kSide; i++)
    for (int j = 0; j < kSide; j++) {
      for (const Vec3 &corner :
           {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1)})
        soup.corners.push_back(corner);
    }
  return soup;
}

// Returns where a grain is `depth` deep in both sides of a fold through a point.
Vec3 in_fold(const PlacedGrain &g, const Vec3 &at, Real depth)
{
  const Real size = std::hypot(Real(1), kHeight), sine = kHeight / size, cosine = 1 / size;
  const auto distance = [&](Real side) {
    return support(g.shape, g.to_own({side * sine, 0, -cosine})).height - depth;
  };
  const Real left = distance(-1), right = distance(1);
  return at + Vec3{(left - right) / (2 * sine), 0, (left + right) / (2 * cosine)};
}

}    // namespace

ShapeBed::ShapeBed(const ShapeKind &kind, ShapePlace place, int n) :
    shape_(make_superellipsoid(kind.half, kind.n, kind.n)),
    mesh_(
        weld(terrain(shape_.farthest, place == ShapePlace::edge || place == ShapePlace::fold), -1)),
    names_(mesh_), tree_(mesh_, names_), search_(tree_)
{
  StepGridSettings grid;
  grid.cutoff = shape_.farthest;
  flat_ = FlatOf(build_grid(mesh_, grid, false));
  EngineSettings e = hooke_history(1e5, 3e4, 50, 25, 0.5);
  e.moves = e.contacts = true;
  e.law().for_shapes = !kind.is_sphere;
  engine_ = kind.is_sphere ? make_cpu_engine(e) : make_shape_engine(e);
  engine_->set_grid(flat_.view());
  if (!kind.is_sphere) engine_->set_tree(tree_);
  lay(place, n, kind.is_sphere);
  engine_->choose(at(0), kWay * 4 * shape_.farthest);
  engine_->read_diagnostics();
}

void ShapeBed::steps()
{
  StepSettings step;
  step.dt = kDt;
  for (int k = 0; k < kSteps; k++) engine_->step(at(k), step);
}

void ShapeBed::lay(ShapePlace place, int n, bool is_sphere)
{
  Random random(3);
  NearFeatures near;
  std::vector<Vec3> feet(n);
  for (Vec3 &foot : feet) foot = {uniform(random, 4, kSide - 4), uniform(random, 4, kSide - 4), 0};
  // In the order of bins, as LAMMPS sorts its atoms.
  std::sort(feet.begin(), feet.end(), [](const Vec3 &a, const Vec3 &b) {
    const Real row = std::floor(a.y), other = std::floor(b.y);
    return row != other ? row < other : a.x < b.x;
  });
  for (Vec3 &foot : feet) {
    PlacedGrain g;
    g.shape = shape_;
    const Quaternion turn =
        is_sphere ? Quaternion() : rotation_about(random_unit(random), uniform(random, 0, 3));
    rows_of(turn, g.row);
    // From where it touches, and the normal there.
    const bool at_edge = place == ShapePlace::edge;
    const Real depth = (place == ShapePlace::above ? -kSunk : kSunk) * shape_.nearest,
               tilt = at_edge ? uniform(random, -0.25, 0.25) : 0;
    if (at_edge) foot.x = 2 * std::floor(foot.x / 2) + 1, foot.z = kHeight;
    const Vec3 down = {std::sin(tilt), 0, -std::cos(tilt)};
    g.centre =
        place == ShapePlace::fold
            ? in_fold(g, shape_.farthest * Vec3{2 * std::floor(foot.x / 2), foot.y, 0}, depth)
            : shape_.farthest * foot + depth * down -
                  g.turned(support(shape_, g.to_own(down)).point);
    search_.find_near(g, shape_.farthest, near);
    listed_ += static_cast<double>(near.n_faces());
    grains_.add(g.centre, shape_.farthest);
    turns_.push_back(turn);
  }
  for (int k = 0; k < kSteps; k++)
    for (int i = 0; i < n; i++) {
      x_.push_back(grains_.x[i] + kWay * shape_.farthest *
                                      Vec3{uniform(random, -1, 1), uniform(random, -1, 1), 0});
      GrainShape row;
      row.half = shape_.half;
      row.n1 = shape_.n1;
      row.n2 = shape_.n2;
      row.inertia_over_mass = inertia_over_mass(shape_);
      row.turn = rotation_about(random_unit(random), kWay) * turns_[i];
      shapes_.push_back(row);
    }
}

Spheres ShapeBed::at(int k)
{
  const std::size_t first = k * grains_.x.size();
  Spheres s = grains_.spheres();
  s.x = &x_[first].x;
  s.shapes = &shapes_[first];
  return s;
}

}    // namespace lsdcd
