// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are no spheres in folds and corners: numbers of a program of its own, forces and energies without jumps, and energies
// that are kept.
#include "support/cut_surface.h"
#include "support/laws.h"
#include "support/meshes.h"
#include "support/random.h"
#include "support/shape_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd::test_grain_folds {
namespace {

using Triangle = std::array<int, 3>;

TriangleSoup soup_of(const std::vector<Vec3> &vertices, const std::vector<Triangle> &faces)
{
  TriangleSoup soup;
  soup.source = "test";
  for (const Triangle &face : faces)
    for (const int v : face) soup.corners.push_back(vertices[v]);
  return soup;
}

// z = |x| tan(degrees).
TriangleSoup valley(Real degrees, Real half = 9)
{
  const Real rise = half * std::tan(degrees * kPi / 180);
  return soup_of({{-half, -half, rise},
                  {0, -half, 0},
                  {half, -half, rise},
                  {-half, half, rise},
                  {0, half, 0},
                  {half, half, rise}},
                 {{0, 1, 4}, {0, 4, 3}, {1, 2, 5}, {1, 5, 4}});
}

// A ridge along y whose edge is at z = 0, its sides falling by 1 in 0.2.
TriangleSoup sharp_rail(Real x)
{
  return soup_of({{x, -30, 0},
                  {x, 30, 0},
                  {x - 0.2, -30, -1},
                  {x - 0.2, 30, -1},
                  {x + 0.2, -30, -1},
                  {x + 0.2, 30, -1}},
                 {{0, 1, 3}, {0, 3, 2}, {0, 5, 1}, {0, 4, 5}});
}

// A pyramid with its tip at (x, y, 0).
TriangleSoup spike(Real x, Real y)
{
  return soup_of({{x, y, 0},
                  {x - 0.1, y - 0.1, -1},
                  {x + 0.1, y - 0.1, -1},
                  {x + 0.1, y + 0.1, -1},
                  {x - 0.1, y + 0.1, -1}},
                 {{0, 2, 1}, {0, 3, 2}, {0, 4, 3}, {0, 1, 4}});
}

TriangleSoup square(Real half = 9)
{
  return soup_of({{-half, -half, 0}, {half, -half, 0}, {half, half, 0}, {-half, half, 0}},
                 {{0, 1, 2}, {0, 2, 3}});
}

// What the wall does to a grain with hooke and kn = 1.
struct Pushed {
  Vec3 force, torque;
  Real energy, overlap;    // the largest overlap
  Real sharp;              // over the radius of curvature there, where it is above the least one
  int contacts;

  Real differs(const Pushed &other) const
  {
    return std::sqrt(norm_sq(force - other.force) + norm_sq(torque - other.torque));
  }
  Real size() const { return std::sqrt(norm_sq(force) + norm_sq(torque)); }
};

class Evaluated {
 public:
  Evaluated(const TriangleSoup &soup, const Vec3 &half, Real n1 = 2, Real n2 = 2,
            EngineSettings law = hooke(1)) :
      shape(make_superellipsoid(half, n1, n2)),
      scene(soup, shape.farthest, for_shapes(std::move(law)))
  {
    scene.add({0, 0, 0}, half, n1, n2);
  }
  Pushed at(const Vec3 &x, const Quaternion &turn)
  {
    scene.x[0] = x;
    scene.shapes[0].turn = turn;
    const Real sharp = scene.look(1e-3).sharpest;
    const WallTotals &totals = scene.engine->results().totals();
    return {scene.force[0], scene.torque[0],
            totals.energy,  totals.largest_overlap_ratio * shape.nearest,
            sharp,          static_cast<int>(totals.contacts)};
  }

  Superellipsoid shape;
  ShapeScene scene;
};

Quaternion about_y(Real angle)
{
  return rotation_about({0, 1, 0}, angle);
}

// ---- numbers -------------------------------------------------------------------------------

// Numbers are known to six digits and to eight decimals.
void expect_digits(const Vec3 &is, const Vec3 &expected, const std::string &what)
{
  for (int k = 0; k < 3; k++) {
    const Real most = expected[k] == 0 ? 1e-12 : std::fmax(5.1e-9, 5.1e-6 * std::fabs(expected[k]));
    EXPECT_NEAR(is[k], expected[k], most) << what << " " << k;
  }
}
void expect_scene(const char *name, Evaluated &grain, const Vec3 &x, const Quaternion &turn,
                  const Vec3 &force, const Vec3 &torque, Real energy)
{
  const Pushed is = grain.at(x, turn);
  expect_digits(is.force, force, std::string(name) + " force");
  expect_digits(is.torque, torque, std::string(name) + " torque");
  EXPECT_NEAR(is.energy, energy, 6e-6 * energy) << name;
}

// By a program of its own that tries all sets of bearing contacts.
TEST(grain_folds, have_the_forces_of_an_independent_program)
{
  const Vec3 rod = {1, 1, 5}, disc = {1.2, 1.2, 0.4};
  Evaluated on_rails(joined(sharp_rail(-2), sharp_rail(2)), rod);
  expect_scene("two rails", on_rails, {0, 0, std::sqrt(0.84) - 0.05}, about_y(kPi / 2 + 0.005),
               {-0.00120168, 0, 0.0992538}, {0, -0.0372382, 0}, 0.00257368);
  Evaluated upright(valley(20), rod);
  expect_scene("fold", upright, {0.004, 0, 4.97}, {}, {-0.00399987, 0, 0.0432301},
               {0, 0.0191487, 0}, 0.000942417);
  expect_scene("near the end of a contact", upright, {0.026, 0, 4.892}, {},
               {-0.0276640, 0, 0.120624}, {0, 0.132437, 0}, 0.00767128);
  Evaluated lying(valley(5), disc);
  expect_scene("disc", lying, {0.002, 0, 0.392}, about_y(0.002), {-0.000184550, 0, 0.0322685},
               {0, -0.000749130, 0}, 0.000348514);
  TriangleSoup points;
  for (const Real x : {-0.6, 0.6})
    for (const Real y : {-0.6, 0.6}) append(points, spike(x, y));
  Evaluated on_points(points, disc);
  expect_scene("four points", on_points, {0.01, 0.02, 0.4 * std::sqrt(0.5) - 0.02}, {},
               {-0.00168740, -0.00337358, 0.0702210}, {0.00813057, -0.0040649, 0}, 0.000748918);
  const Real r = 2 * std::sqrt(Real(3));
  Evaluated in_corner(
      soup_of({{0, 0, 0}, {4, 0, 2}, {-2, r, 2}, {-2, -r, 2}}, {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}}),
      {0.6, 0.8, 1});
  const Vec3 axis = {0.3, 0.2, 0.1};
  expect_scene("corner", in_corner, {0.05, 0.03, 1.06},
               rotation_about((1 / norm(axis)) * axis, norm(axis)),
               {-0.0131710, -0.0727010, 0.159854}, {-0.00848135, 0.0204867, 0.0167546}, 0.0152075);
  const Real tilt = kPi / 18;
  Evaluated deep(square(), rod);
  expect_scene("deep in a plane", deep,
               {0, 0, std::hypot(5 * std::cos(tilt), std::sin(tilt)) - 0.5}, about_y(tilt),
               {0, 0, 0.5}, {0, 0.416497, 0}, 0.125);
}

// ---- no jumps ------------------------------------------------------------------------------

enum class Place { fold, drum, cone, bumpy };

// Sides of a drum along y about the origin, or about `begin`: of a side that begins there.
TriangleSoup open_drum(int n, Real radius, Real length, Real begin = 0)
{
  TriangleSoup soup;
  soup.source = "drum";
  const auto at = [&](int k, Real y) {
    const Real angle = 2 * kPi * (k + begin) / n;
    return Vec3{radius * std::cos(angle), y, radius * std::sin(angle)};
  };
  for (int k = 0; k < n; k++) {
    const Vec3 a = at(k, -length), b = at(k + 1, -length), c = at(k + 1, length), d = at(k, length);
    soup.corners.insert(soup.corners.end(), {a, b, c, a, c, d});
  }
  return soup;
}
// A funnel of n sides, its tip at the origin, up to `height` at the radius of 4; sides are wide by chance.
TriangleSoup funnel(int n, Real height, Real radius = 4, Random *random = nullptr)
{
  TriangleSoup soup;
  soup.source = "funnel";
  std::vector<Vec3> rim;
  for (int k = 0; k < n; k++) {
    const Real angle = 2 * kPi * (k + (random ? 0.6 * uniform(*random, 0, 1) : 0)) / n;
    rim.push_back({radius * std::cos(angle), radius * std::sin(angle), height});
  }
  for (int k = 0; k < n; k++)
    soup.corners.insert(soup.corners.end(), {{0, 0, 0}, rim[k], rim[(k + 1) % n]});
  return soup;
}
TriangleSoup bumpy(Random &random, int n, Real height)
{
  constexpr Real kHalf = 3;
  std::vector<Vec3> x;
  std::normal_distribution<Real> normal;
  for (int j = 0; j <= n; j++)
    for (int i = 0; i <= n; i++)
      x.push_back(
          {kHalf * (2 * Real(i) / n - 1), kHalf * (2 * Real(j) / n - 1), height * normal(random)});
  std::vector<Triangle> faces;
  for (int j = 0; j < n; j++)
    for (int i = 0; i < n; i++) {
      const int a = j * (n + 1) + i;
      faces.push_back({a, a + 1, a + n + 2});
      faces.push_back({a, a + n + 2, a + n + 1});
    }
  return soup_of(x, faces);
}

Quaternion random_turn(Random &random)
{
  return rotation_about(random_unit(random), uniform(random, 0, kPi));
}

// A grain that goes through a mesh, deeper and less deep in it.
class RandomPath {
 public:
  RandomPath(unsigned seed, bool has_flat_sides) : random_(seed)
  {
    constexpr Place kPlaces[] = {Place::fold, Place::fold, Place::drum, Place::cone, Place::bumpy};
    place_ = kPlaces[pick(5)];
    constexpr Real kFolds[] = {0.35, 0.7, 1, 2, 5, 10, 20, 30, 45, 60};
    TriangleSoup mesh;
    if (place_ == Place::fold)
      mesh = valley(kFolds[pick(10)] * uniform(random_, 0.5, 1));
    else if (place_ == Place::drum)
      mesh = open_drum(9 + pick(16), uniform(random_, 1.8, 6), 8, uniform(random_, 0, 1));
    else if (place_ == Place::cone) {
      constexpr Real kHeights[] = {0.15, 0.3, 0.75, 1.5, 3};
      const int n = 3 + pick(6);
      mesh = funnel(n, kHeights[pick(5)], 4, &random_);
    } else {
      const int n = 2 + pick(4);
      mesh = bumpy(random_, n, uniform(random_, 0.02, 0.6));
    }
    Vec3 half = uniform(random_, {0.5, 0.5, 0.5}, {1.5, 1.5, 1.5});
    Real n1 = 2, n2 = 2;
    const int form = pick(3);
    if (has_flat_sides) {
      constexpr Real kExponents[] = {3, 4, 6, 8};
      n1 = kExponents[pick(4)];
      n2 = kExponents[pick(4)];
    } else if (form > 0) {
      half = form == 1 ? Vec3{0.3, 0.3, 0.3} : Vec3{1.2, 1.2, 1.2};
      half[pick(3)] = form == 1 ? 1.5 : 0.4;
    }
    grain_ = std::make_unique<Evaluated>(mesh, half, n1, n2);
    const Real rho = grain_->shape.rho;
    turn_ = random_turn(random_);
    is_good_ = come_down(uniform(random_, 0.03, 0.95) * rho);
    if (!is_good_) return;
    way_ = unit({normal(), normal(), 0.3 * normal()});
    way_ = (rho * uniform(random_, 0.1, 3)) * way_;
    axis_ = random_unit(random_);
    angle_ = uniform(random_, 0, 1.5) * rho / std::max({half.x, half.y, half.z});
    from_ = from_ - uniform(random_, 0.2, 0.6) * way_;
  }

  // The largest jumps of force and torque, and of energy, over the largest of the path; below 0: too little of it touches.
  struct Jumps {
    Real force = -1, energy = -1;
  };
  Jumps jumps(Real width)
  {
    constexpr int kSteps = 240, kLeast = 30;
    if (!is_good_) return {};
    std::vector<Pushed> at;
    for (int i = 0; i < kSteps; i++) at.push_back(pushed(i / Real(kSteps - 1)));
    Real most = 0, most_energy = 0;
    int n = 0;
    for (const Pushed &p : at) {
      if (!is_in_limits(p)) continue;
      n++;
      most = std::fmax(most, p.size());
      most_energy = std::fmax(most_energy, p.energy);
    }
    if (n < kLeast) return {};
    // The steps in which most changes.
    std::vector<std::pair<Real, int>> steps;
    for (const bool of_energy : {false, true}) {
      std::vector<std::pair<Real, int>> all;
      for (int i = 0; i + 1 < kSteps; i++) {
        if (!is_in_limits(at[i]) || !is_in_limits(at[i + 1])) continue;
        all.emplace_back(
            of_energy ? std::fabs(at[i + 1].energy - at[i].energy) : at[i + 1].differs(at[i]), i);
      }
      std::sort(all.rbegin(), all.rend());
      all.resize(std::min<std::size_t>(all.size(), of_energy ? 2 : 4));
      steps.insert(steps.end(), all.begin(), all.end());
    }
    Jumps worst = {0, 0};
    for (const auto &[change, i] : steps) {
      Real low = i / Real(kSteps - 1), high = (i + 1) / Real(kSteps - 1);
      Pushed a = at[i], b = at[i + 1];
      while (high - low > width) {
        const Real middle = 0.5 * (low + high);
        const Pushed here = pushed(middle);
        const bool first = here.differs(a) > b.differs(here);
        (first ? high : low) = middle;
        (first ? b : a) = here;
      }
      worst.force = std::fmax(worst.force, b.differs(a) / most);
      worst.energy = std::fmax(worst.energy, std::fabs(b.energy - a.energy) / most_energy);
    }
    return worst;
  }

 private:
  int pick(int n) { return static_cast<int>(uniform(random_, 0, n)); }
  Real normal() { return std::normal_distribution<Real>()(random_); }
  // It touches, and where contacts end it is less deep than 0.95 of its radius of curvature. Nor is it deeper than 0.8 of its least
  // half-axis: from some 0.84 on the foot of a plane was seen outside of the grain, where the contact passes to another face in a jump.
  bool is_in_limits(const Pushed &p) const
  {
    const Superellipsoid &s = grain_->shape;
    return p.overlap > 0 && p.overlap < 0.8 * s.nearest && (p.overlap < s.rho || p.sharp < 0.95);
  }
  Pushed pushed(Real s)
  {
    return grain_->at(from_ + s * way_, rotation_about(axis_, s * angle_) * turn_);
  }
  // From where it touches nothing to where it is `wanted` deep; false: it does not come to that.
  bool come_down(Real wanted)
  {
    Vec3 push = {0, 0, -1};
    from_ = {0, uniform(random_, -1, 1), 2.5};
    if (place_ == Place::drum) {
      push = unit({uniform(random_, -1, 1), 0, -1});
      from_ = {uniform(random_, -0.5, 0.5), 0, 0};
    } else if (place_ != Place::fold) {
      from_.x = uniform(random_, -1, 1);
    }
    const Real rho = grain_->shape.rho;
    Pushed now = grain_->at(from_, turn_);
    if (now.overlap > 0) return false;
    for (Real way = 0; way < 9 && !(now.overlap > 0); way += 0.3 * rho) {
      from_ += 0.3 * rho * push;
      now = grain_->at(from_, turn_);
    }
    for (int i = 0; i < 40; i++) {
      from_ += 0.5 * (wanted - now.overlap) * push;
      now = grain_->at(from_, turn_);
    }
    return now.overlap > 0 && now.overlap < rho;
  }

  Random random_;
  Place place_;
  std::unique_ptr<Evaluated> grain_;
  Quaternion turn_;
  Vec3 from_ = {0, 0, 0}, way_ = {0, 0, 0}, axis_ = {0, 0, 1};
  Real angle_ = 0;
  bool is_good_ = false;
};

struct Sweep {
  int paths = 0, force = 0, energy = 0;    // with a jump of more than 1e-4
  Real worst_force = 0, worst_energy = 0;
};
// Steps are halved to `width` of the path.
Sweep sweep(int n_paths, bool has_flat_sides, Real width)
{
  constexpr Real kJump = 1e-4;
  Sweep all;
  for (unsigned seed = 0; all.paths < n_paths; seed++) {
    const RandomPath::Jumps jumps = RandomPath(seed, has_flat_sides).jumps(width);
    if (jumps.force < 0) continue;
    all.paths++;
    all.force += jumps.force > kJump;
    all.energy += jumps.energy > kJump;
    all.worst_force = std::fmax(all.worst_force, jumps.force);
    all.worst_energy = std::fmax(all.worst_energy, jumps.energy);
  }
  return all;
}

// A path is a few radii of curvature long, and forces were seen to change by 11 stiffnesses times the way: by 1e-6 of the largest in 3e-8 of
// the path.
void expect_no_jumps(int n_ellipsoids, int n_others)
{
  const Sweep ellipsoids = sweep(n_ellipsoids, false, 3e-8);
  EXPECT_EQ(ellipsoids.force, 0) << ellipsoids.worst_force;
  EXPECT_EQ(ellipsoids.energy, 0) << ellipsoids.worst_energy;
  // The point of a flat side runs as a root of the tilt, and with it the torque: what it changes by falls with the width.
  const Sweep others = sweep(n_others, true, 3e-8), finer = sweep(n_others, true, 3e-12);
  EXPECT_EQ(others.energy, 0) << others.worst_energy;
  EXPECT_LE(finer.worst_force, 0.5 * others.worst_force);
  EXPECT_LE(finer.force, others.force);
}

TEST(grain_folds, have_no_jumps_of_force_and_energy_up_to_the_radius_of_curvature)
{
  expect_no_jumps(60, 20);
}
TEST(grain_folds, have_no_jumps_of_force_and_energy_on_4000_paths_RELEASE)
{
  expect_no_jumps(3000, 1000);
}

// Where a contact ends at a fold of 20 degrees a side, an upright ellipsoid of half-axes a, 1, 1 overlaps the ending side by `part` of
// its least radius of curvature there.
TEST(grain_folds, have_no_jump_where_a_contact_of_an_upright_ellipsoid_ends)
{
  const Real angle = 20 * kPi / 180;
  const Vec3 normal = {-std::sin(angle), 0, std::cos(angle)};
  for (const Real a : {1., 2., 5.})
    for (const Real part : {0.14, 0.25, 0.3, 0.45, 0.8, 0.95}) {
      Evaluated grain(valley(20), {1, 1, a});
      const SupportPlane ending = support(grain.shape, -normal);
      const Real deep = part * grain.shape.rho, x = -(ending.point.x + deep * normal.x),
                 z = (ending.height - deep - normal.x * x) / normal.z;
      constexpr Real kWay = 1e-9;
      const Pushed before = grain.at({x + kWay, 0, z - kWay * normal.x / normal.z}, {}),
                   after = grain.at({x - kWay, 0, z + kWay * normal.x / normal.z}, {});
      EXPECT_LE(std::abs(before.contacts - after.contacts), 1);
      // The force changes by 11 times the way at most.
      EXPECT_LE(norm(after.force - before.force), 11 * 2 * kWay) << a << ", " << part;
    }
}

// ---- energy --------------------------------------------------------------------------------

// Poses in funnels with three contacts or more, which are with faces alone: else normals of edges are in the gradient, too.
TEST(grain_folds, have_the_gradient_of_their_energy_as_force_and_torque)
{
  std::vector<Real> off;
  for (unsigned seed = 0; off.size() < 300; seed++) {
    Random random(seed);
    constexpr Real kHeights[] = {0.15, 0.3, 0.75, 1.5, 3};
    const int n = 3 + static_cast<int>(uniform(random, 0, 6));
    const TriangleSoup mesh =
        funnel(n, kHeights[static_cast<int>(uniform(random, 0, 5))], 4, &random);
    const Vec3 half = uniform(random, {0.4, 0.4, 0.4}, {1.2, 1.2, 1.2});
    const bool is_ellipsoid = seed % 2;
    const Real n1 = is_ellipsoid ? 2 : uniform(random, 2, 6),
               n2 = is_ellipsoid ? 2 : uniform(random, 2, 6);
    EngineSettings law = hooke(1);
    law.contacts = true;
    Evaluated grain(mesh, half, n1, n2, law);
    const Quaternion turn = random_turn(random);
    Vec3 x = {0, 0, 4};
    const Real wanted = uniform(random, 0.02, 0.4) * grain.shape.rho;
    while (x.z > -1 && !(grain.at(x, turn).overlap > 0)) x.z -= 0.3 * grain.shape.rho;
    Pushed here = grain.at(x, turn);
    for (int i = 0; i < 200; i++) {
      x += 0.3 * (here.force - Vec3{0, 0, wanted});
      here = grain.at(x, turn);
    }
    bool has_faces_alone = true;
    for (const StepContact &c : grain.scene.engine->results().contacts())
      has_faces_alone &= feature_kind(c.feature) == FeatureKind::face;
    if (here.contacts < 3 || here.overlap > 0.6 * grain.shape.rho || !has_faces_alone) continue;
    Real worst = 0;
    for (int k = 0; k < 6; k++) {
      const Real h = 1e-6 * grain.shape.nearest;
      Vec3 along = {0, 0, 0};
      along[k % 3] = 1;
      const auto energy = [&](Real by) {
        return k < 3 ? grain.at(x + by * along, turn).energy
                     : grain.at(x, rotation_about(along, by) * turn).energy;
      };
      // Central differences of two steps.
      const Real slope =
          (8 * (energy(h) - energy(-h)) - (energy(2 * h) - energy(-2 * h))) / (12 * h);
      worst = std::fmax(worst, std::fabs(slope + (k < 3 ? here.force : here.torque)[k % 3]));
    }
    off.push_back(worst / here.size());
  }
  std::sort(off.begin(), off.end());
  EXPECT_LE(off[off.size() / 2], 1e-8);
  EXPECT_LE(off[off.size() * 9 / 10], 1e-2);
}

// The energy of a grain that moves without friction, by flights alone: in a contact that of velocity Verlet swings.
struct EnergyKept {
  Real last = 0, most = 0;    // changes over the energy of its fall from 2.5
  Real deepest = 0;           // overlap over the least radius of curvature
};
EnergyKept energy_kept(const TriangleSoup &mesh, const Vec3 &half, Real n, bool is_drum, Real depth,
                       unsigned seed, int n_steps)
{
  constexpr Real kFall = 2.5;
  Random random(seed);
  const Superellipsoid s = make_superellipsoid(half, n, n);
  const Real most = depth * s.rho, stiffness = 2 * kFall / (most * most),
             dt = 0.02 / 1.5 / std::sqrt(stiffness);
  ShapeScene scene(mesh, s.farthest, for_shapes(hooke(stiffness)));
  scene.add(is_drum ? Vec3{uniform(random, -0.8, 0.8), 0, uniform(random, -0.5, 0.5)}
                    : Vec3{uniform(random, -0.8, 0.8), uniform(random, -0.8, 0.8), 3.5},
            half, n, n);
  scene.shapes[0].turn = random_turn(random);
  scene.v[0] = 0.3 * uniform(random, {-1, -0.1, -1}, {1, 0.1, 1});
  scene.spin(0, 0.3 * uniform(random, {-1, -1, -1}, {1, 1, 1}));
  const Vec3 gravity = {0, 0, -1};
  const auto energy = [&] { return scene.energy(0) - dot(gravity, scene.x[0]); };
  const Real begin = energy();
  EnergyKept kept;
  for (int k = 0; k < n_steps; k++) {
    scene.step(dt, gravity);
    const WallTotals &totals = scene.engine->results().totals();
    kept.deepest = std::fmax(kept.deepest, totals.largest_overlap_ratio * s.nearest / s.rho);
    if (totals.contacts > 0) continue;
    kept.last = (energy() - begin) / kFall;
    kept.most = std::fmax(kept.most, std::fabs(kept.last));
  }
  return kept;
}

// Rods and discs in drums and funnels. The mean of the squares of what their energy has changed by.
void expect_the_energy_of_falls(int n_seeds, int n_steps, Real most)
{
  struct Surface {
    TriangleSoup mesh;
    bool is_drum;
  };
  const Surface surfaces[] = {{open_drum(9, 3, 60), true},
                              {open_drum(12, 3, 60), true},
                              {open_drum(24, 3, 60), true},
                              {funnel(4, 42, 60), false},
                              {funnel(6, 30, 60), false}};
  Real square = 0, deepest = 0;
  int n = 0;
  for (const Surface &surface : surfaces)
    for (const Vec3 &half : {Vec3{0.5, 0.5, 1.5}, Vec3{0.3, 0.3, 1.5}, Vec3{1.2, 1.2, 0.4}})
      for (int seed = 0; seed < n_seeds; seed++) {
        const EnergyKept kept =
            energy_kept(surface.mesh, half, 2, surface.is_drum, 0.45, seed, n_steps);
        deepest = std::fmax(deepest, kept.deepest);
        square += kept.last * kept.last;
        n++;
      }
  EXPECT_LE(std::sqrt(square / n), most);
  EXPECT_GE(deepest, 0.3);
  EXPECT_LE(deepest, 0.6);
}
TEST(grain_folds, keep_their_energy_in_drums_and_funnels)
{
  expect_the_energy_of_falls(1, 30000, 3e-4);
}
TEST(grain_folds, keep_their_energy_in_drums_and_funnels_for_100000_steps_RELEASE)
{
  expect_the_energy_of_falls(5, 100000, 3e-4);
}

// ---- alike -----------------------------------------------------------------------------------

TEST(grain_folds, rest_on_rails_and_points_with_the_force_of_each)
{
  constexpr Real kDeep = 0.05;
  Evaluated rod(joined(sharp_rail(-2), sharp_rail(2)), {1, 1, 5});
  const Pushed on_rails = rod.at({0, 0, std::sqrt(0.84) - kDeep}, about_y(kPi / 2));
  // What one rail alone does.
  Evaluated one(sharp_rail(2), {1, 1, 5});
  const Pushed on_one = one.at({0, 0, std::sqrt(0.84) - kDeep}, about_y(kPi / 2));
  EXPECT_NEAR(on_rails.force.z / (2 * on_one.force.z), 1, 1e-3);
  EXPECT_LE(std::fabs(on_rails.torque.y), 1e-14);
  TriangleSoup points;
  for (const Real x : {-0.6, 0.6})
    for (const Real y : {-0.6, 0.6}) append(points, spike(x, y));
  const Vec3 plate = {1.2, 1.2, 0.4}, at = {0, 0, 0.4 * std::sqrt(0.5) - 0.02};
  Evaluated on_four(points, plate), on_first(spike(0.6, 0.6), plate);
  EXPECT_GE(on_four.at(at, {}).force.z, 4 * 0.97 * on_first.at(at, {}).force.z);
}

// z = -|x| w. The sides of a ridge fall along (1, 0, -w) and (-1, 0, -w).
TriangleSoup ridge(Real w)
{
  return soup_of({{0, -40, 0},
                  {0, 40, 0},
                  {-40, -40, -40 * w},
                  {-40, 40, -40 * w},
                  {40, -40, -40 * w},
                  {40, 40, -40 * w}},
                 {{0, 1, 3}, {0, 3, 2}, {0, 5, 1}, {0, 4, 5}});
}
// A pyramid with its tip at the origin, whose four edges fall by w in 1 along x and y.
TriangleSoup pyramid(Real w)
{
  return soup_of(
      {{0, 0, 0}, {40, 0, -40 * w}, {0, 40, -40 * w}, {-40, 0, -40 * w}, {0, -40, -40 * w}},
      {{0, 1, 2}, {0, 2, 3}, {0, 3, 4}, {0, 4, 1}});
}

// The tip of a convex wall is d below the point of an ellipsoid whose normal n points into the wall, between those of its sides: then that is
// the one place where the distance has a minimum, however far the ellipsoid reaches over the sides.
TEST(grain_folds, touch_a_ridge_and_a_tip_there_alone_up_to_the_least_radius_of_curvature)
{
  Random random(3);
  for (const Vec3 &half : {Vec3{1, 1, 5}, {5, 5, 1}, {1.2, 0.4, 0.7}})
    for (const Real w : {0.5, 1., 2., 5.})
      for (const bool is_ridge : {true, false}) {
        Evaluated grain(is_ridge ? ridge(w) : pyramid(w), half);
        for (int i = 0; i < 200; i++) {
          Vec3 n;
          do {
            n = random_unit(random);
            if (is_ridge) n = unit({n.x, 0, n.z});
          } while (!(-w * n.z > 1.001 * std::fmax(std::fabs(n.x), std::fabs(n.y))));
          const Quaternion turn = random_turn(random);
          const Vec3 own = rotate(inverse(turn), n),
                     u = {half.x * own.x, half.y * own.y, half.z * own.z};
          const Vec3 point =
              rotate(turn, (1 / norm(u)) * Vec3{half.x * u.x, half.y * u.y, half.z * u.z});
          const Real d = uniform(random, 0.01, 0.99) * grain.shape.rho;
          const Pushed is = grain.at(d * n - point, turn);
          ASSERT_EQ(is.contacts, 1) << i << " " << w;
          // Rounding of lengths of 5.
          ASSERT_LT(norm(is.force + d * n), 1e-13) << i << " " << w;
          ASSERT_LT(norm(is.torque + d * cross(point, n)), 1e-12) << i << " " << w;
        }
      }
}

TEST(grain_folds, press_a_plane_with_one_contact_at_any_depth_however_it_is_cut)
{
  for (const int pieces : {1, 2, 3, 4, 5, 7, 9, 12, 17, 30}) {
    Evaluated rod(cut(lsdcd::fold(0), pieces), {1, 1, 5});
    for (const Real deep : {0.05, 0.19, 0.21, 0.3, 0.5, 2.})
      for (const Real tilt : {0., 1e-9, 0.2}) {
        const Quaternion turn = kTurn * rotation_about({0, 1, 0}, tilt);
        const Vec3 normal = rotate(kTurn, {0, 0, 1});
        const Real height = std::hypot(5 * std::cos(tilt), std::sin(tilt));
        const Pushed pushed = rod.at(placed({0.3, 0.2, height - deep}), turn);
        EXPECT_EQ(pushed.contacts, 1) << pieces << ", " << deep;
        // Roundings of coordinates of 10.
        EXPECT_LE(norm(pushed.force - deep * normal), 1e-13) << pieces << ", " << deep;
        EXPECT_EQ(pushed.sharp, 0);
      }
  }
}

// Past the least radius of curvature the nearest way out of the grain may be on either side of a face.
TEST(grain_folds, are_pushed_by_a_face_to_the_side_of_their_centre_at_any_depth)
{
  EngineSettings law = hooke(1);
  law.contacts = true;
  int n_deep = 0;
  for (unsigned seed = 0; seed < 300; seed++) {
    Random random(seed);
    Evaluated rod(valley(uniform(random, 2, 30)), {0.3, 0.3, 1.5}, 2, 2, law);
    const Vec3 x = {uniform(random, -0.5, 0.5), 0, uniform(random, 0.1, 1)};
    n_deep += rod.at(x, random_turn(random)).overlap > rod.shape.rho;
    for (const StepContact &c : rod.scene.engine->results().contacts())
      if (feature_kind(c.feature) == FeatureKind::face) {
        EXPECT_GE(-dot(c.force, c.arm), 0) << seed;
      }
  }
  EXPECT_GT(n_deep, 150);
}

// Overlaps are roundings of 10, 1e-15, over the overlap of 0.01 at least.
TEST(grain_folds, are_pushed_alike_by_a_bumpy_wall_however_it_is_cut)
{
  Real worst = 0;
  int several = 0;
  for (unsigned seed = 0; seed < 150; seed++) {
    Random random(seed);
    TriangleSoup coarse = bumpy(random, 2 + static_cast<int>(seed % 4), uniform(random, 0.02, 0.5));
    const Vec3 half = uniform(random, {0.4, 0.4, 0.4}, {1.4, 1.4, 1.4});
    Evaluated whole(cut(coarse.corners, 1), half), in_four(cut(coarse.corners, 2), half);
    const Quaternion turn = random_turn(random);
    const Vec3 up = rotate(kTurn, {0, 0, 1});
    Vec3 x = placed({uniform(random, -1, 1), uniform(random, -1, 1), 3.5});
    const Real wanted = uniform(random, 0.03, 0.7) * whole.shape.rho;
    Pushed a = whole.at(x, turn);
    for (int i = 0; i < 60 && !(a.overlap > 0); i++)
      a = whole.at(x -= 0.2 * whole.shape.rho * up, turn);
    // To where it would lie in the walls.
    for (int i = 0; i < 60; i++) a = whole.at(x += 0.4 * (a.force - wanted * up), turn);
    if (!(a.overlap > 0.01) || a.overlap > 0.9 * whole.shape.rho) continue;
    several += a.contacts > 1;
    worst = std::fmax(worst, in_four.at(x, turn).differs(a) / a.overlap);
  }
  EXPECT_LE(worst, 2e-12);
  EXPECT_GT(several, 30);
}

}    // namespace
}    // namespace lsdcd::test_grain_folds
