// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are no spheres at triangles, where their contact is known in long double because they were put there.
// Random pairs are in test_shape and test_shape_query.
#include "base/quaternion.h"
#include "query/shape_query.h"
#include "support/cut_surface.h"
#include "support/random.h"
#include "support/shape_oracle.h"
#include "support/tree_case.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace lsdcd::test_shape_pairs {
namespace {

LongVec long_unit(const LongVec &a)
{
  return (1 / length(a)) * a;
}

// A rotation in long double, by a quaternion of any length.
struct LongTurn {
  Long w, scale;
  LongVec v;

  explicit LongTurn(const Real *q) :
      w(q[0]),
      scale(1 / (Long(q[0]) * q[0] + Long(q[1]) * q[1] + Long(q[2]) * q[2] + Long(q[3]) * q[3])),
      v{q[1], q[2], q[3]}
  {
  }
  LongVec turned(const LongVec &x, Long sign) const
  {
    return scale * ((w * w - dot(v, v)) * x + 2 * dot(v, x) * v + (sign * 2 * w) * cross(v, x));
  }
  LongVec to_box(const LongVec &x) const { return turned(x, 1); }
  LongVec to_own(const LongVec &x) const { return turned(x, -1); }
};

// Where a grain touches: its unit normal into the wall, the place on the wall, and how deep, below 0 for a gap.
struct Touch {
  LongVec normal, foot;
  Long overlap;
};

// Grains of one shape in arrays, each with the one contact that it should have.
struct PutGrains {
  const Superellipsoid &shape;
  const ShapeOracle &oracle;
  const Real exponents[2];
  std::vector<Real> centres, quaternions;
  std::vector<Touch> touch;

  PutGrains(const Superellipsoid &s, const ShapeOracle &of) :
      shape(s), oracle(of), exponents{s.n1, s.n2}
  {
  }
  // Puts a grain so that it touches there, with its axes turned by a quaternion.
  void put(const Touch &t, const std::array<Real, 4> &q)
  {
    const LongTurn turn(q.data());
    const LongVec own = long_unit(turn.to_own(t.normal));
    const LongVec centre = t.foot - turn.to_box(oracle.point(own) - t.overlap * own);
    centres.insert(centres.end(), {Real(centre.x), Real(centre.y), Real(centre.z)});
    quaternions.insert(quaternions.end(), q.begin(), q.end());
    touch.push_back(t);
  }
  std::size_t n() const { return touch.size(); }
  ShapesGiven given() const
  {
    return {0, n(), centres.data(), quaternions.data(), &shape.half.x, exponents, true};
  }
};

struct Wrong {
  long missed = 0, wrong = 0, not_brute = 0, touching = 0;
};

// Compares with what is found, and what was put with brute force.
void compare(const TreeCase &mesh, const PutGrains &grains, Wrong &of)
{
  constexpr Long kWrong = 1e-10L;
  const Superellipsoid &s = grains.shape;
  const ShapeOracle &oracle = grains.oracle;
  const Long size = s.farthest;
  const FoundGrainContacts found = find_shape_contacts(mesh.tree, grains.given());
  for (std::size_t i = 0; i < grains.n(); i++) {
    const Touch &t = grains.touch[i];
    const LongTurn turn(&grains.quaternions[4 * i]);
    const LongVec centre = {grains.centres[3 * i], grains.centres[3 * i + 1],
                            grains.centres[3 * i + 2]};
    // No point of the surface is nearer to the foot: those of a cloud, and for one the lowest downhill from it.
    const Vec3 own_foot = vec_cast<Real>(turn.to_own(t.foot - centre));
    const bool refine = i == 0;
    const Long away =
        refine ? oracle.distance(own_foot) : Long(oracle.distance_from_cloud(own_foot));
    const Long brute = std::fabs(t.overlap) - away;
    of.not_brute += !(brute <= kWrong * size) || (refine && !(brute >= -kWrong * size));

    const std::size_t n = found.first[i + 1] - found.first[i];
    of.touching += t.overlap > 0;
    of.missed += n != (t.overlap > 0 ? 1u : 0u);
    if (n != 1) continue;
    const FoundGrainContact &c = found.found[found.first[i]];
    const Long distance = std::fabs(c.distance + t.overlap) / size,
               normal = length(vec_cast<Long>(c.normal) + t.normal);
    // Under a flat side the foot goes far by the rounding of a normal: there it is where the two surfaces are.
    const LongVec of_grain = vec_cast<Long>(c.of_grain), point = vec_cast<Long>(c.point);
    const Long on_grain = std::fabs(oracle.gauge(turn.to_own(of_grain - centre)) - 1),
               on_wall =
                   length(of_grain - point - Long(c.distance) * vec_cast<Long>(c.normal)) / size;
    const Long foot = s.is_ellipsoid() ? length(point - t.foot) / size : 0;
    of.wrong += !(distance <= kWrong && normal <= kWrong && on_grain <= kWrong &&
                  on_wall <= kWrong && foot <= 2 * kWrong);
  }
}

}    // namespace

// Turns a grain's own axis k to the normal and the next one along another direction, to rounding.
std::array<Real, 4> turn_by_axes(int k, const Vec3 &normal, const Vec3 &along)
{
  Vec3 own = {0, 0, 0}, next = {0, 0, 0};
  own[k] = next[(k + 1) % 3] = 1;
  const Quaternion half_turn = {0, unit(own + normal)};
  const Vec3 there = rotate(half_turn, next);
  const Quaternion q =
      rotation_about(normal, std::atan2(dot(normal, cross(there, along)), dot(there, along))) *
      half_turn;
  return {q.w, q.v.x, q.v.y, q.v.z};
}

// Ellipsoids exactly, flat sides, needles and discs.
std::vector<Superellipsoid> hard_shapes()
{
  std::vector<Superellipsoid> shapes;
  for (const Vec3 &half : {Vec3{1, 0.2, 0.2}, Vec3{1, 0.6, 0.2}, Vec3{1, 1, 0.2}})
    for (Real n : {2, 8, 20}) shapes.push_back(make_superellipsoid(half, n, n));
  for (const Vec3 &half : {Vec3{1, 0.01, 0.01}, Vec3{1, 1, 0.01}})
    shapes.push_back(make_superellipsoid(half, 2, 2));
  return shapes;
}

TEST(shape_pairs, touch_edges_and_corners_of_a_box_with_their_axes_along_these)
{
  // A box of needles: each side of triangles that meet in a corner of it.
  std::vector<Vec3> sides;
  const TriangleSoup box = box_mesh({0, 0, 0}, {4, 4, 4});
  for (std::size_t t = 0; t < box.corners.size(); t += 3)
    for (int i = 0; i < 50; i++) {
      const Vec3 &a = box.corners[t + 1], &b = box.corners[t + 2];
      sides.insert(sides.end(),
                   {box.corners[t], a + (i / 50.) * (b - a), a + ((i + 1) / 50.) * (b - a)});
    }
  for (const TriangleSoup &soup : {cut(box.corners, 1), cut(box.corners, 5), cut(sides, 1)}) {
    const TreeCase mesh(soup);
    const LongVec corner = vec_cast<Long>(placed({4, 4, 4}));
    const auto out = [](const Vec3 &v) { return rotate(kTurn, v); };
    // Into the wall, as the box is outside of the grain.
    const Vec3 of_edge = -unit(Vec3{1, 1, 0}), of_corner = -unit(Vec3{1, 1, 1});
    Wrong wrong;
    for (const Superellipsoid &s : hard_shapes()) {
      const ShapeOracle oracle(s);
      PutGrains grains(s, oracle);
      for (Real depth : {-0.01, 0.01, 0.2, 0.5})
        for (int k = 0; k < 3; k++) {
          const Touch at_edge = {vec_cast<Long>(out(of_edge)), vec_cast<Long>(placed({4, 4, 2.1})),
                                 depth * s.rho};
          grains.put(at_edge, turn_by_axes(k, out(of_edge), out({0, 0, 1})));
          grains.put(at_edge, turn_by_axes(k, out(of_edge), out(unit(Vec3{1, -1, 0}))));
          const Touch at_corner = {vec_cast<Long>(out(of_corner)), corner, depth * s.rho};
          grains.put(at_corner, turn_by_axes(k, out(of_corner), out(unit(Vec3{1, -1, 0}))));
        }
      compare(mesh, grains, wrong);
    }
    EXPECT_EQ(wrong.missed, 0);
    EXPECT_EQ(wrong.wrong, 0);
    EXPECT_EQ(wrong.not_brute, 0);
    EXPECT_GT(wrong.touching, 200);
  }
}

TEST(shape_pairs, in_a_corner_touch_each_of_its_sides_by_the_closed_form)
{
  const std::vector<Vec3> sides = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 0}, {0, 4, 0},
                                   {0, 0, 4}, {0, 0, 0}, {0, 0, 4}, {4, 0, 0}};
  Random random(31);
  int all_three = 0;
  for (int pieces : {1, 9}) {
    const TreeCase mesh(cut(sides, pieces));
    for (const Superellipsoid &s : hard_shapes()) {
      const ShapeOracle oracle(s);
      std::vector<Real> centres, quaternions;
      std::vector<std::array<Long, 3>> overlaps;
      const auto axis = [](int k) {
        Vec3 e = {0, 0, 0};
        e[k] = 1;
        return vec_cast<Long>(rotate(kTurn, e));
      };
      for (int i = 0; i < 40; i++) {
        // The long axis points into the corner. From there it is as deep in each side as it shall be.
        const Vec3 into = -unit(uniform(random, {0.05, 0.05, 0.05}, {1, 1, 1}));
        const std::array<Real, 4> q = turn_by_axes(
            0, rotate(kTurn, into), rotate(kTurn, unit(cross(into, random_unit(random)))));
        const LongTurn turn(q.data());
        LongVec centre = {0, 0, 0};
        std::array<Long, 3> overlap;
        for (int k = 0; k < 3; k++) {
          overlap[k] = uniform(random, -0.2, 0.4) * s.rho;
          centre += (oracle.support(turn.to_own(-axis(k))) - overlap[k]) * axis(k);
        }
        bool in_sides = true;    // else an edge may have the contact of a side
        for (int k = 0; k < 3; k++) {
          const LongVec foot = centre + turn.to_box(oracle.point(turn.to_own(-axis(k))));
          for (int j = 1; j < 3; j++) in_sides &= dot(foot, axis((k + j) % 3)) > 1e-3L;
        }
        if (!in_sides) continue;
        const Vec3 x = vec_cast<Real>(centre + vec_cast<Long>(placed({0, 0, 0})));
        centres.insert(centres.end(), {x.x, x.y, x.z});
        quaternions.insert(quaternions.end(), q.begin(), q.end());
        overlaps.push_back(overlap);
      }
      const Real n[] = {s.n1, s.n2};
      const FoundGrainContacts found = find_shape_contacts(
          mesh.tree, {0, overlaps.size(), centres.data(), quaternions.data(), &s.half.x, n, true});
      for (std::size_t i = 0; i < overlaps.size(); i++) {
        std::size_t touching = 0;
        for (int k = 0; k < 3; k++) {
          if (!(overlaps[i][k] > 0)) continue;
          touching++;
          Long nearest = HUGE_VAL;
          for (std::size_t c = found.first[i]; c < found.first[i + 1]; c++)
            if (length(vec_cast<Long>(found.found[c].normal) - axis(k)) < 1e-12L)
              nearest = std::fabs(found.found[c].distance + overlaps[i][k]);
          EXPECT_LE(nearest, 1e-13L) << s.half.y << " " << s.n1;    // roundings of lengths of 4
        }
        EXPECT_EQ(found.first[i + 1] - found.first[i], touching)
            << s.half.y << " " << s.half.z << " " << s.n1;
        all_three += touching == 3;
      }
    }
  }
  EXPECT_GT(all_three, 50);
}

// A rod of half-axes a, a, c stands across a sheet, z over its middle: c - |z| of it is past the sheet, however deep that is.
TEST(shape_pairs, a_rod_through_a_sheet_is_as_deep_in_it_as_its_end_is_past_it)
{
  constexpr Real a = 0.2, c = 1, kThick = 1e-3;
  const auto sheet = [](Real z) {
    return std::vector<Vec3>{{-9, -9, z}, {9, -9, z}, {0.1, 12, z}};
  };
  std::vector<Vec3> two = sheet(0);
  const std::vector<Vec3> under = sheet(-kThick);
  two.insert(two.end(), under.begin(), under.end());
  for (int pieces : {1, 7, 60})
    for (const std::vector<Vec3> &corners : {sheet(0), two})
      for (Real height : {-0.7, -0.2, 0.05, 0.3, 0.8}) {
        const TreeCase mesh(cut(corners, pieces));
        const Vec3 x = placed({0.3, 0.2, height}), half = {a, a, c};
        const Real q[] = {kTurn.w, kTurn.v.x, kTurn.v.y, kTurn.v.z}, n[] = {2, 2};
        const FoundGrainContacts found =
            find_shape_contacts(mesh.tree, {0, 1, &x.x, q, &half.x, n, true});
        ASSERT_EQ(found.found.size(), corners.size() / 3) << pieces << " " << height;
        for (Real z : {height, height + kThick}) {
          if (z != height && corners.size() == 3) continue;
          const Vec3 out = rotate(kTurn, {0, 0, z < 0 ? -1.0 : 1.0});
          Real off = HUGE_VAL;
          for (const FoundGrainContact &k : found.found)
            if (norm(k.point - placed({0.3, 0.2, height - z})) < 1e-4)
              off = std::fabs(k.distance + c - std::fabs(z)) + norm(k.normal - out);
          // Roundings of lengths of 12.
          EXPECT_LE(off, 1e-13) << pieces << " " << height;
        }
      }
}

}    // namespace lsdcd::test_shape_pairs
