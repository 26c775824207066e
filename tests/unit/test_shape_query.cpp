// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contacts and distances of superellipsoids at meshes: closed forms, the same surface cut in other ways, and all triangles of a
// mesh one by one.
#include "query/shape_query.h"
#include "shape/triangle_minimum.h"
#include "support/cut_surface.h"
#include "support/random.h"
#include "support/tree_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_shape_query {
namespace {

constexpr int kMostPieces = 100;

// Arrays of grains.
struct Grains {
  std::vector<Real> centres, quaternions, half, exponents;

  std::size_t n() const { return centres.size() / 3; }
  void add(const Vec3 &x, const Vec3 &axes, Real n1, Real n2,
           const std::array<Real, 4> &q = {1, 0, 0, 0})
  {
    centres.insert(centres.end(), {x.x, x.y, x.z});
    half.insert(half.end(), {axes.x, axes.y, axes.z});
    exponents.insert(exponents.end(), {n1, n2});
    quaternions.insert(quaternions.end(), q.begin(), q.end());
  }
  ShapesGiven given() const
  {
    return {0, n(), centres.data(), quaternions.data(), half.data(), exponents.data(), false};
  }
  Superellipsoid shape(std::size_t i) const
  {
    return make_superellipsoid({half[3 * i], half[3 * i + 1], half[3 * i + 2]}, exponents[2 * i],
                               exponents[2 * i + 1]);
  }
};

std::array<Real, 4> random_turn(Random &random)
{
  std::normal_distribution<Real> normal;
  return {normal(random), normal(random), normal(random), normal(random)};
}

// The gauge is convex, so that thirds of a segment come to its least.
TEST(shape_query, cuts_a_segment_where_the_gauge_is_less_than_one)
{
  Random random(7);
  int cut = 0, left_out = 0, not_seen = 0;
  Superellipsoid s;
  for (int i = 0; i < 4000; i++) {
    if (i % 50 == 0) {
      const bool is_ellipsoid = i % 200 == 0, has_two = i % 100 == 0;
      const Real n1 = is_ellipsoid ? 2 : uniform(random, 2, 12),
                 n2 = is_ellipsoid || !has_two ? n1 : uniform(random, 2, 12);
      s = make_superellipsoid(uniform(random, {0.3, 0.3, 0.3}, {1.5, 1.5, 1.5}), n1, n2);
    }
    const Vec3 from = uniform(random, {-3, -3, -3}, {3, 3, 3}),
               to = uniform(random, {-3, -3, -3}, {3, 3, 3});
    const auto gauge_at = [&](Real t) {
      const Vec3 y = from + t * (to - from);
      const auto power = [](Real of, Real n) { return std::pow(std::fabs(of), n); };
      const Real across = power(y.x / s.half.x, s.n2) + power(y.y / s.half.y, s.n2);
      return std::pow(power(across, s.n1 / s.n2) + power(y.z / s.half.z, s.n1), 1 / s.n1);
    };
    Real low = 0, high = 1;
    for (int k = 0; k < 100; k++) {
      const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (gauge_at(a) < gauge_at(b))
        high = b;
      else
        low = a;
    }
    const Real least = gauge_at(low);
    if (std::fabs(least - 1) < 1e-6) continue;
    cut += least < 1;
    left_out += least > 1;
    if (least < 1)
      EXPECT_TRUE(may_cut(s, from, to)) << i;
    else
      not_seen += may_cut(s, from, to);
  }
  EXPECT_GT(cut, 500);
  EXPECT_GT(left_out, 500);
  EXPECT_LE(not_seen, left_out / 100);
}

// Grains that touch a surface by up to rho/2: moved towards it until their distance is what it should be.
Grains at_surface(Random &random, const TriangleSoup &surface, int n, Real most_exponent)
{
  const TreeCase at(surface);
  Grains grains;
  while (static_cast<int>(grains.n()) < n) {
    constexpr Real kOften[] = {2, 2, 3, 4, 6, 8};
    const auto exponent = [&] {
      return std::fmin(kOften[static_cast<int>(uniform(random, 0, 6))], most_exponent);
    };
    const Vec3 half = uniform(random, {0.3, 0.3, 0.3}, {1.5, 1.5, 1.5});
    const Real n1 = exponent(), n2 = exponent();
    const Superellipsoid s = make_superellipsoid(half, n1, n2);
    const std::array<Real, 4> turn = random_turn(random);
    Vec3 x = placed(uniform(random, {-1, -1, 2}, {1, 1, 4}));
    const Real wanted = -uniform(random, 0.01, 0.5) * s.rho;
    FoundGrainContact nearest;
    for (int step = 0; step < 25; step++) {
      Grains one;
      one.add(x, half, n1, n2, turn);
      find_shape_distances(at.tree, one.given(), &nearest);
      if (nearest.distance < 2 * wanted) break;    // it began inside
      // The distance falls by the way at most.
      x -= 0.7 * (nearest.distance - wanted) * nearest.normal;
    }
    if (std::fabs(nearest.distance - wanted) < 0.1 * s.rho) grains.add(x, half, n1, n2, turn);
  }
  return grains;
}

// How far contacts of the same grains differ, by share of the largest half-axis.
struct Differences {
  std::size_t contacts = 0, other_number = 0;
  Real overlap = 0, normal = 0, point = 0;
};
Differences compare(const FoundGrainContacts &a, const FoundGrainContacts &b)
{
  Differences d;
  d.contacts = a.found.size();
  for (std::size_t i = 0; i + 1 < a.first.size(); i++) {
    if (a.first[i + 1] - a.first[i] != b.first[i + 1] - b.first[i]) {
      d.other_number++;
      continue;
    }
    for (std::size_t k = a.first[i]; k < a.first[i + 1]; k++) {
      // Features have other numbers: the nearest normal and overlap.
      const FoundGrainContact &one = a.found[k];
      const FoundGrainContact *other = nullptr;
      for (std::size_t l = b.first[i]; l < b.first[i + 1]; l++)
        if (!other || norm(b.found[l].point - one.point) < norm(other->point - one.point))
          other = &b.found[l];
      d.overlap = std::fmax(d.overlap, std::fabs(other->distance - one.distance));
      d.normal = std::fmax(d.normal, norm(other->normal - one.normal));
      d.point = std::fmax(
          d.point, std::fmax(norm(other->point - one.point), norm(other->of_grain - one.of_grain)));
    }
  }
  return d;
}

void expect_the_same_in_all_pieces(const std::vector<Vec3> &surface, Real most_exponent,
                                   Real tolerance_of_points,
                                   const std::vector<int> &all_pieces = {2, 7, kMostPieces})
{
  Random random(1);
  const Grains grains =
      at_surface(random, cut(surface, 1), most_exponent > 2 ? 12 : 60, most_exponent);
  const TreeCase whole(cut(surface, 1));
  const FoundGrainContacts expected = find_shape_contacts(whole.tree, grains.given());
  EXPECT_GE(expected.found.size(), grains.n() - 1);
  for (int pieces : all_pieces) {
    const TreeCase other(cut(surface, pieces));
    const Differences d = compare(expected, find_shape_contacts(other.tree, grains.given()));
    EXPECT_EQ(d.other_number, 0u) << pieces;
    EXPECT_LT(d.overlap, 1e-12) << pieces;
    EXPECT_LT(d.normal, 1e-10) << pieces;
    EXPECT_LT(d.point, tolerance_of_points) << pieces;
  }
}

}    // namespace
TEST(shape_query, finds_the_same_contacts_of_ellipsoids_however_a_surface_is_cut)
{
  for (Real degrees : {-120, -30, 0, 10, 60, 110})
    expect_the_same_in_all_pieces(fold(degrees), 2, 1e-10);
  expect_the_same_in_all_pieces(bowl(5), 2, 1e-10);
  expect_the_same_in_all_pieces(drum(24), 2, 1e-10, {2, 7, 25});
}
// Of 4, 4, 48 and 5 triangles, and of 2e5.
TEST(shape_query, finds_the_same_contacts_on_surfaces_of_200000_triangles_LONG)
{
  for (Real most_exponent : {2, 8}) {
    const Real of_points = most_exponent > 2 ? 1e-7 : 1e-10;
    expect_the_same_in_all_pieces(fold(0), most_exponent, of_points, {224});
    expect_the_same_in_all_pieces(fold(60), most_exponent, of_points, {224});
    expect_the_same_in_all_pieces(drum(24), most_exponent, of_points, {65});
    expect_the_same_in_all_pieces(bowl(5), most_exponent, of_points, {200});
  }
}
TEST(shape_query, finds_the_same_contacts_of_shapes_with_flat_sides_however_a_surface_is_cut)
{
  // Where a side is flat a point runs over it by the rounding of a triangle's normal times its radius of curvature.
  for (Real degrees : {-60, 60}) expect_the_same_in_all_pieces(fold(degrees), 8, 1e-7);
  expect_the_same_in_all_pieces(bowl(4), 8, 1e-7);
}

TEST(shape_query, finds_one_contact_of_a_flat_side_that_lies_on_a_plane_and_one_on_each_rail)
{
  Grains block;
  block.add(placed({0.3, 0.2, 0.97}), {2, 1.5, 1}, 8, 8);
  block.quaternions = {kTurn.w, kTurn.v.x, kTurn.v.y, kTurn.v.z};    // as the surface
  const Vec3 z = rotate(kTurn, {0, 0, 1});
  for (int pieces : {1, 3, kMostPieces}) {
    const TreeCase plane(cut(fold(0), pieces));
    const FoundGrainContacts c = find_shape_contacts(plane.tree, block.given());
    ASSERT_EQ(c.found.size(), 1u) << pieces;
    EXPECT_NEAR(c.found[0].distance, -0.03, 1e-12);
    EXPECT_LT(norm(c.found[0].normal - z), 1e-12);
  }
  std::vector<Vec3> rails;
  for (Real at : {-1.2, 1.2})
    rails.insert(rails.end(), {{at - 0.1, -9, 0},
                               {at + 0.1, -9, 0},
                               {at - 0.1, 9, 0},
                               {at + 0.1, -9, 0},
                               {at + 0.1, 9, 0},
                               {at - 0.1, 9, 0}});
  for (int pieces : {1, 40}) {
    const TreeCase two(cut(rails, pieces));
    const FoundGrainContacts c = find_shape_contacts(two.tree, block.given());
    ASSERT_EQ(c.found.size(), 2u) << pieces;
    for (const FoundGrainContact &one : c.found)
      EXPECT_EQ(feature_kind(one.feature), FeatureKind::edge);
  }
}

TEST(shape_query, finds_one_contact_of_a_flat_side_whose_middle_is_on_a_corner_of_many_triangles)
{
  // For the exponent 20 the side is flat to rounding on 0.14 of its half-axis: over some triangles.
  for (Real n : {2.0, 8.0, 20.0})
    for (const Vec3 &at : {Vec3{1, 0.4, 0.97}, Vec3{1.05, 0.4, 0.97}, Vec3{0, 0, 0.97}}) {
      Grains block;
      block.add(placed(at), {2, 1.5, 1}, n, n);
      block.quaternions = {kTurn.w, kTurn.v.x, kTurn.v.y, kTurn.v.z};
      for (int pieces : {1, 50, kMostPieces}) {
        const TreeCase plane(cut(fold(0), pieces));
        EXPECT_EQ(find_shape_contacts(plane.tree, block.given()).found.size(), 1u)
            << n << " " << pieces;
      }
    }
}

TEST(shape_query, finds_no_contact_that_has_no_overlap)
{
  // Heights over a tilted plane at which the overlap is 0 to rounding.
  Random random(4);
  std::size_t found = 0;
  for (Real n : {2.0, 8.0}) {
    const TreeCase plane(cut(fold(0), 5));
    Grains grains;
    for (int i = 0; i < 300; i++) {
      const Vec3 half = uniform(random, {0.3, 0.3, 0.3}, {1.5, 1.5, 1.5});
      grains.add(placed({uniform(random, -2, 2), uniform(random, -2, 2), half.z}), half, n, n,
                 {kTurn.w, kTurn.v.x, kTurn.v.y, kTurn.v.z});
    }
    for (const FoundGrainContact &c : find_shape_contacts(plane.tree, grains.given()).found) {
      EXPECT_LT(c.distance, 0) << n;
      found++;
    }
  }
  EXPECT_GT(found, 100u);    // about half of them
}

TEST(shape_query, finds_the_rim_of_a_table_alone_where_the_centre_is_below_the_top)
{
  const std::vector<Vec3> table = {{-9, -9, 0}, {0, -9, 0}, {0, 9, 0},  {-9, -9, 0},
                                   {0, 9, 0},   {-9, 9, 0}, {0, -9, 0}, {0, -9, -9},
                                   {0, 9, -9},  {0, -9, 0}, {0, 9, -9}, {0, 9, 0}};
  const Superellipsoid rod = make_superellipsoid({5, 1, 1}, 2, 2);
  constexpr Real kDepth = 0.01, kLean = 25 * kPi / 180, kOff = 0.1;
  // From where it touches: a point of the rim, and the normal there; the long axis is across it but for kOff.
  const Vec3 normal = {std::cos(kLean), 0, std::sin(kLean)}, up = {-normal.z, 0, normal.x};
  const Vec3 axis = std::sqrt(1 - kOff * kOff) * up - kOff * normal;
  const Quaternion turn = rotation_about({0, 1, 0}, -std::atan2(axis.z, axis.x));
  const Vec3 arm = rotate(turn, support(rod, rotate(inverse(turn), -normal)).point);
  const Vec3 rim = {0, 0.3, 0}, centre = rim - kDepth * normal - arm;
  ASSERT_LT(centre.z, -1);
  Grains grains;
  const Quaternion q = kTurn * turn;
  grains.add(placed(centre), rod.half, 2, 2, {q.w, q.v.x, q.v.y, q.v.z});
  for (int pieces : {1, 7, kMostPieces}) {
    const TreeCase at(cut(table, pieces));
    const FoundGrainContacts c = find_shape_contacts(at.tree, grains.given());
    ASSERT_EQ(c.found.size(), 1u) << pieces;
    // Roundings of lengths of 9, over the grain's size.
    EXPECT_NEAR(c.found[0].distance, -kDepth, 1e-13) << pieces;
    EXPECT_LT(norm(c.found[0].normal - rotate(kTurn, normal)), 1e-12) << pieces;
    EXPECT_LT(norm(c.found[0].point - placed(rim)), 1e-12) << pieces;
  }
}

TEST(shape_query, finds_one_contact_on_an_edge_whose_sides_are_apart_by_rounding)
{
  // Two triangles that are not welded, as the ends of their common edge differ by rounding.
  const Real next = std::nextafter(1.0, 2.0);
  TriangleSoup roof;
  roof.corners = {{-1, 0, 0}, {1, 0, 0}, {0, 1, -1}, {-next, 0, 0}, {0, -1, -1}, {next, 0, 0}};
  const TreeCase apart(roof);
  ASSERT_EQ(apart.mesh.vertices.size(), 6u);
  Grains rice;
  rice.add({0.1, 0, 0.29}, {0.5, 0.4, 0.3}, 2, 2);
  EXPECT_EQ(find_shape_contacts(apart.tree, rice.given()).found.size(), 1u);
}

TEST(shape_query, finds_the_nearest_triangle_and_all_local_minima_of_a_look_at_every_triangle)
{
  Random random(3);
  std::size_t touching = 0, several = 0;
  for (const auto &mesh :
       cases_of<TreeCase>({box_mesh({-1, -1, -1}, {1, 1, 1}), cone_mesh(7, 1, 0.7)}, 6)) {
    const WeldedMesh &m = mesh->mesh;
    bool has_bare = false;    // edges and vertices of no face have contacts, too
    for (std::size_t e = 0; e < m.edges.size(); e++)
      has_bare |= m.edge_first[e] == m.edge_first[e + 1];
    for (std::size_t v = 0; v < m.vertices.size(); v++)
      has_bare |= m.vertex_first[v] == m.vertex_first[v + 1];
    if (has_bare) continue;
    const Real size = mesh->diagonal;
    Grains grains;
    for (int i = 0; i < 24; i++)
      grains.add(m.report.lo + uniform(random, {0, 0, 0}, m.report.hi - m.report.lo),
                 size * uniform(random, {0.1, 0.1, 0.1}, {0.2, 0.2, 0.2}), i % 2 ? 2 : 3,
                 i % 3 ? 2 : 4, random_turn(random));
    const FoundGrainContacts contacts = find_shape_contacts(mesh->tree, grains.given());
    std::vector<FoundGrainContact> nearest(grains.n());
    find_shape_distances(mesh->tree, grains.given(), nearest.data());
    for (std::size_t i = 0; i < grains.n(); i++) {
      const Superellipsoid s = grains.shape(i);
      const Vec3 centre = {grains.centres[3 * i], grains.centres[3 * i + 1],
                           grains.centres[3 * i + 2]};
      const Real *q = &grains.quaternions[4 * i], w = q[0],
                 scale = 1 / (q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
      const Vec3 v = {q[1], q[2], q[3]};
      // The inverse rotation, by its formula.
      const auto own = [&](const Vec3 &x) {
        const Vec3 a = x - centre;
        return scale * ((w * w - norm_sq(v)) * a + 2 * dot(v, a) * v - 2 * w * cross(v, a));
      };
      std::vector<ShapeMinimum> of_face;
      Real least = HUGE_VAL;
      for (const auto &face : m.faces) {
        const Vec3 corner[3] = {own(m.vertices[face[0]]), own(m.vertices[face[1]]),
                                own(m.vertices[face[2]])};
        of_face.push_back(
            TriangleMinimum(s, corner, unit(cross(corner[1] - corner[0], corner[2] - corner[0])))
                .find(HUGE_VAL));
        least = std::fmin(least, of_face.back().distance);
      }
      EXPECT_NEAR(nearest[i].distance, least, 1e-12 * size);
      // The foot and the point of the grain are where they should be.
      EXPECT_NEAR(norm(nearest[i].of_grain - nearest[i].point), std::fabs(least), 1e-12 * size);
      EXPECT_NEAR(gauge_value(s, own(nearest[i].of_grain)), 1, 1e-11);
      // Deeper than the least radius of curvature contacts are by planes.
      if (!std::all_of(of_face.begin(), of_face.end(),
                       [](const ShapeMinimum &m) { return m.is_smooth; }))
        continue;
      // A minimum of a face is a local one of the surface if no face around its foot has a deeper one.
      std::vector<Vec3> feet;
      for (std::size_t g = 0; g < m.faces.size(); g++) {
        const ShapeMinimum &at = of_face[g];
        if (!(at.distance < -1e-9 * size)) continue;
        // The vertices of the part on which it is: the faces around have them all.
        const int first = m.faces[g][at.k], second = m.faces[g][(at.k + 1) % 3];
        bool is_local = true;
        for (std::size_t f = 0; f < m.faces.size() && at.part != TrianglePart::face; f++) {
          const auto &face = m.faces[f];
          const auto has = [&](int v) {
            return std::find(face.begin(), face.end(), v) != face.end();
          };
          const bool is_around = has(first) && (at.part == TrianglePart::corner || has(second));
          if (is_around && of_face[f].distance < at.distance - 1e-11 * size) is_local = false;
        }
        if (is_local) feet.push_back(at.foot);
      }
      std::vector<Vec3> found;
      for (std::size_t k = contacts.first[i]; k < contacts.first[i + 1]; k++)
        if (contacts.found[k].distance < -1e-9 * size)
          found.push_back(own(contacts.found[k].point));
      const auto all_in = [&](const std::vector<Vec3> &these, const std::vector<Vec3> &those) {
        return std::all_of(these.begin(), these.end(), [&](const Vec3 &a) {
          return std::any_of(those.begin(), those.end(),
                             [&](const Vec3 &b) { return norm(a - b) < 1e-5 * size; });
        });
      };
      EXPECT_TRUE(all_in(found, feet));
      EXPECT_TRUE(all_in(feet, found));
      touching += !found.empty(), several += found.size() > 1;
    }
  }
  EXPECT_GT(touching, 20u);
  EXPECT_GT(several, 5u);
}

}    // namespace lsdcd::test_shape_query
