// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Passages through a surface: each fact has a closed form, or follows from the surface being closed.
#include "base/input_error.h"
#include "flow/flow_surface.h"
#include "flow/pass_file.h"
#include "geometry/expansion.h"
#include "input/massflow_settings.h"
#include "support/meshes.h"
#include "support/says.h"
#include "support/temp_dir.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace lsdcd::test_flow {
namespace {

FlowSurface surface_of(const TriangleSoup &soup)
{
  return FlowSurface(weld(soup, 0));
}

PeriodicBox open_box()
{
  return PeriodicBox();
}

// Periodic along x and y, with edges that are no round numbers.
PeriodicBox wrapped_box()
{
  PeriodicBox box;
  box.corner = {-0.3, -0.7, -2};
  box.edge[0] = {1.1, 0, 0};
  box.edge[1] = {0.1, 1.3, 0};
  box.edge[2] = {0, 0, 4};
  box.periodic[0] = box.periodic[1] = true;
  return box;
}

Passes passes(const FlowSurface &surface, const Vec3 &from, const Vec3 &to)
{
  return surface.passes({from}, to, open_box());
}

TEST(flow_expansion, a_sum_that_cancels_to_the_last_bit_has_the_sign_of_that_bit)
{
  // (2^27 + 1)(2^27 - 1) - 2^54 = -1, below the last bit of 2^54.
  const Real big = 134217728;
  Expansion product = Expansion(big + 1) * Expansion(big - 1);
  EXPECT_EQ((product - Expansion(big * big)).sign(), -1);
  product.add(1);
  EXPECT_EQ((product - Expansion(big * big)).sign(), 0);
  product.add(std::ldexp(1, -1000));
  EXPECT_EQ((product - Expansion(big * big)).sign(), 1);
}

// A floor of 2 x 8 x 8 triangles: paths through all nodes, the middles of all edges, and in
// directions that run along edges.
TEST(flow, a_path_through_an_edge_or_a_vertex_passes_once)
{
  const FlowSurface floor = surface_of(floor_mesh(8, 1));
  int tried = 0;
  for (int i = -7; i <= 7; i++)
    for (int j = -7; j <= 7; j++)
      for (const Vec3 &d : {Vec3{0, 0, -1}, {0.125, 0, -1}, {0, 0.125, -1}, {0.125, 0.125, -1}}) {
        const Vec3 at = {i / 8., j / 8., 0};    // nodes are at quarters
        const Passes down = passes(floor, at - 0.5 * d, at + 0.5 * d);
        const Passes up = passes(floor, at + 0.5 * d, at - 0.5 * d);
        EXPECT_EQ(down.forward + down.backward, 1) << at.x << " " << at.y;
        EXPECT_EQ(up.forward, down.backward);
        EXPECT_EQ(up.backward, down.forward);
        tried++;
      }
  EXPECT_EQ(tried, 15 * 15 * 4);
}

TEST(flow, forward_is_along_the_normal)
{
  const FlowSurface box = surface_of(box_mesh({0, 0, 0}, {1, 1, 1}));    // normals out
  const Passes out = passes(box, {0.4, 0.3, 0.5}, {0.4, 0.3, 1.5});
  EXPECT_EQ(out.forward, 1);
  EXPECT_EQ(out.backward, 0);
  const Passes through = passes(box, {0.4, 0.3, -0.5}, {0.4, 0.3, 1.5});
  EXPECT_EQ(through.forward, 1);
  EXPECT_EQ(through.backward, 1);
}

// On the surface counts as a hair further along +x, +y, +z: above a floor, whichever way the
// facets are wound.
TEST(flow, a_centre_that_stops_on_the_surface_passes_when_it_goes_on_below)
{
  for (const bool turned : {false, true}) {
    TriangleSoup soup = floor_mesh(8, 1);
    for (std::size_t t = 0; turned && t < soup.n_triangles(); t++)
      std::swap(soup.corners[3 * t + 1], soup.corners[3 * t + 2]);
    const FlowSurface floor = surface_of(soup);
    for (const Vec3 &on : {Vec3{0.1, 0.13, 0}, {0.25, 0.25, 0}, {0.25, 0.1, 0}, {0.1, 0.1, 0}}) {
      const auto any = [](const Passes &p) { return p.forward + p.backward; };
      const Vec3 h = {0, 0, 0.1}, along = {0.3, 0.2, 0};
      EXPECT_EQ(any(passes(floor, on + h, on)), 0);
      EXPECT_EQ(any(passes(floor, on, on)), 0);
      EXPECT_EQ(any(passes(floor, on, on + along)), 0);
      EXPECT_EQ(any(passes(floor, on, on - h)), 1);
      EXPECT_EQ(any(passes(floor, on - h, on)), 1);
      EXPECT_EQ(any(passes(floor, on, on + h)), 0);
    }
  }
}

// On a device boxes say which paths may pass: they must leave out none that does, and most that are far away.
TEST(flow, boxes_leave_out_no_path_that_passes)
{
  const FlowSurface surface = surface_of(floor_mesh(8, 1));
  for (PeriodicBox box : {open_box(), wrapped_box()}) {
    const FlowBoxes boxes(surface.tree().view(), surface.tree().bounds(), box);
    std::mt19937 random(7);
    std::uniform_real_distribution<Real> unit(-1, 1);
    int passed = 0, far = 0, left_out = 0;
    for (int k = 0; k < 20000; k++) {
      const Vec3 to = {1.5 * unit(random), 1.5 * unit(random), unit(random)};
      const Vec3 from = to + 0.1 * Vec3{unit(random), unit(random), unit(random)};
      const Vec3 wrapped = from + (k % 3 - 1.) * (box.periodic[0] ? box.edge[0] : Vec3{0, 0, 0});
      const Vec3 beside = boxes.beside(wrapped, to);
      EXPECT_LT(norm(beside - from), 1e-12);
      const Vec3 lo = {std::min(to.x, beside.x), std::min(to.y, beside.y),
                       std::min(to.z, beside.z)};
      const Vec3 hi = {std::max(to.x, beside.x), std::max(to.y, beside.y),
                       std::max(to.z, beside.z)};
      const bool may_meet = boxes.may_meet(lo, hi);
      const Passes p =
          surface.passes({wrapped, FlowSurface::cells_between(wrapped, to, box)}, to, box);
      if (p.forward + p.backward > 0) {
        passed++;
        EXPECT_TRUE(may_meet);
      } else if (surface.clearance(to, box) > 0.2) {
        far++;
        left_out += !may_meet;
      }
    }
    EXPECT_GT(passed, 200);
    EXPECT_GT(far, 2000);
    EXPECT_EQ(left_out, far);
  }
}

TEST(flow, past_the_rim_nothing_passes)
{
  const FlowSurface floor = surface_of(floor_mesh(8, 1));
  EXPECT_EQ(passes(floor, {1.0001, 0, 1}, {1.0001, 0, -1}).net(), 0);
  // 2^-52 further than the rim, and 2^-53 before it.
  const Real past = std::nextafter(Real(1), Real(2)), before = std::nextafter(Real(1), Real(0));
  EXPECT_EQ(std::abs(passes(floor, {past, 0.1, 1}, {past, 0.1, -1}).net()), 0);
  EXPECT_EQ(std::abs(passes(floor, {before, 0.1, 1}, {before, 0.1, -1}).net()), 1);
}

// Most integer points lie on planes, edges or vertices of this mesh. A way that comes back to
// where it began has passed out as often as in.
TEST(flow, a_closed_way_passes_a_closed_surface_net_zero_times)
{
  TriangleSoup soup = box_mesh({0, 0, 0}, {2, 2, 2});
  append(soup, box_mesh({2, 2, 2}, {3, 3, 3}));    // shares a vertex
  const FlowSurface boxes = surface_of(soup);
  std::mt19937 random(5);
  const auto point = [&] { return Vec3{random() % 5 - 1., random() % 5 - 1., random() % 5 - 1.}; };
  for (int walk = 0; walk < 2000; walk++) {
    const Vec3 begin = point();
    Vec3 at = begin;
    int net = 0;
    for (int step = 0; step < 6; step++) {
      const Vec3 next = step == 5 ? begin : point();
      net += passes(boxes, at, next).net();
      at = next;
    }
    EXPECT_EQ(net, 0);
  }
}

// The same way far out and in other units: exact signs depend on neither.
TEST(flow, a_mesh_far_from_the_origin_is_as_tight)
{
  for (const Real scale : {1e-9, 1., 1e9}) {
    TriangleSoup soup = box_mesh({0, 0, 0}, {3, 3, 3});
    const Vec3 away = {1e5 * scale, -3e5 * scale, 7e5 * scale};
    for (Vec3 &x : soup.corners) x = scale * x + away;
    const FlowSurface box = surface_of(soup);
    std::mt19937 random(6);
    std::uniform_real_distribution<Real> real(-1, 4);
    for (int walk = 0; walk < 500; walk++) {
      const auto point = [&] {
        return scale * Vec3{real(random), real(random), real(random)} + away;
      };
      const Vec3 a = point(), b = soup.corners[random() % soup.corners.size()], c = point();
      EXPECT_EQ(passes(box, a, b).net() + passes(box, b, c).net() + passes(box, c, a).net(), 0);
    }
  }
}

// A sheet as wide as the box, its ends exactly one edge apart, has no rim: what falls is counted
// once, also along its seam and wherever it was wrapped on the way.
TEST(flow, a_sheet_across_a_periodic_box_has_no_seam)
{
  PeriodicBox box = wrapped_box();
  box.corner = {0, 0, -2};
  box.edge[0] = {1, 0, 0};
  box.edge[1] = {0, 1, 0};
  TriangleSoup soup;
  const Vec3 p[4] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  soup.corners = {p[0], p[1], p[2], p[0], p[2], p[3]};
  const FlowSurface sheet = surface_of(soup);
  for (int i = -4; i <= 8; i++)
    for (int j = -4; j <= 8; j++)
      for (int wrapped = -1; wrapped <= 1; wrapped++) {
        const Vec3 from = {i / 4., j / 4., 0.5}, to = {i / 4. + wrapped, j / 4., -0.5};
        const WrappedPoint begin = {from, FlowSurface::cells_between(from, to, box)};
        const Passes p = sheet.passes(begin, to, box);
        EXPECT_EQ(p.backward, 1) << from.x << " " << from.y << " wrapped " << wrapped;
        EXPECT_EQ(p.forward, 0);
      }
}

// A centre less than the last bit of the box before the seam: moved by an edge and rounded it would
// lie behind it, and neither image would see it.
TEST(flow, nothing_is_lost_between_a_sheet_and_its_image)
{
  PeriodicBox box = wrapped_box();
  box.corner = {0, 0, -2};
  box.edge[1] = {0, 1.3, 0};
  TriangleSoup soup;
  const Vec3 p[4] = {{0, 0, 0}, {1.1, 0, 0}, {1.1, 1.3, 0}, {0, 1.3, 0}};
  soup.corners = {p[0], p[1], p[2], p[0], p[2], p[3]};
  const FlowSurface sheet = surface_of(soup);
  for (const Real x : {-1e-17, 0., 1e-17, 0.5, std::nextafter(1.1, 0), 1.1, std::nextafter(1.1, 2)})
    for (const Real y : {-1e-17, 0., 1e-17, 0.5, 1.3}) {
      const Passes p = sheet.passes({{x, y, 0.5}}, {x, y, -0.5}, box);
      EXPECT_EQ(p.backward, 1) << x << " " << y;
      EXPECT_EQ(p.forward, 0);
    }
}

// Ways in a tilted periodic box, wrapped at random where LAMMPS would round: the way goes on from
// the rounded place, and is closed but for whole cells. Bodies in all images are closed.
TEST(flow, wrapping_opens_no_gap)
{
  const PeriodicBox box = wrapped_box();
  TriangleSoup soup = box_mesh({-0.5, -0.2, -0.4}, {0.1, 0.4, 0.4});    // across a face
  const FlowSurface body = surface_of(soup);
  std::mt19937 random(7);
  std::uniform_real_distribution<Real> real(-0.25, 0.25);
  for (int walk = 0; walk < 500; walk++) {
    const Vec3 begin = {0.3, 0.9, real(random)};
    Vec3 at = begin;
    int net = 0;
    for (int step = 0; step < 40; step++) {
      Vec3 next = at + Vec3{real(random), real(random), real(random)};
      if (random() % 4 == 0) next = soup.corners[random() % soup.corners.size()];    // any image
      if (random() % 3 == 0) next += Real(int(random() % 3) - 1) * box.edge[random() % 2];
      if (step == 39) next = begin;
      net += body.passes({at, FlowSurface::cells_between(at, next, box)}, next, box).net();
      at = next;
    }
    EXPECT_EQ(net, 0);
  }
}

// Against the distance to a box, by components.
TEST(flow, no_clearance_is_more_than_the_distance)
{
  const FlowSurface surface = surface_of(box_mesh({0, 0, 0}, {1, 2, 3}));
  std::mt19937 random(8);
  std::uniform_real_distribution<Real> real(-3, 6);
  for (int i = 0; i < 2000; i++) {
    const Vec3 x = {real(random), real(random), real(random)}, hi = {1, 2, 3};
    Real out = 0, in = HUGE_VAL;
    for (int k = 0; k < 3; k++) {
      const Real past = std::max({-x[k], x[k] - hi[k], Real(0)});
      out += past * past;
      in = std::min({in, x[k], hi[k] - x[k]});
    }
    const Real distance = in > 0 ? in : std::sqrt(out);
    const Real clearance = surface.clearance(x, open_box());
    EXPECT_LE(clearance, distance);
    EXPECT_GT(clearance, distance - 1e-7);    // the room is 1e-9 of the largest coordinate, 6
  }
}

TEST(flow, clearance_sees_the_nearest_image_and_ends_at_half_the_box_or_where_asked)
{
  const PeriodicBox box = wrapped_box();
  const FlowSurface surface = surface_of(box_mesh({-0.2, -0.1, -0.1}, {0, 0.1, 0.1}));
  // The image one edge along x begins at 0.9.
  EXPECT_NEAR(surface.clearance({0.7, 0, 0}, box), 0.2, 1e-8);
  const Real half = std::min(box.width(0), box.width(1)) / 2;
  EXPECT_NEAR(surface.clearance({0.7, 0, 1.9}, box), half, 1e-8);
  EXPECT_NEAR(surface.clearance({0.7, 0, 0}, box, 0.15), 0.15, 1e-8);
}

TEST(flow, images_move_no_farther_than_said)
{
  const PeriodicBox before = wrapped_box();
  PeriodicBox now = before;
  const FlowSurface surface = surface_of(box_mesh({-0.2, -0.1, -0.1}, {0, 0.1, 0.1}));
  EXPECT_EQ(surface.images_move(before, now), 0);
  now.edge[0].x += 0.01;
  EXPECT_GE(surface.images_move(before, now), 0.01);
  now.periodic[0] = false;
  EXPECT_EQ(surface.images_move(before, now), HUGE_VAL);
}

std::string problem(const std::vector<std::string> &words)
{
  return lsdcd::error_of([&] { parse_massflow(words); });
}

TEST(flow_settings, have_the_distance_within_which_corners_are_one)
{
  EXPECT_EQ(parse_massflow({"mesh", "a.stl", "weld", "0"}).surface.weld, 0);
}

TEST(flow_settings, errors_name_the_word)
{
  EXPECT_TRUE(has(problem({"count", "once"}), "mesh FILE is missing"));
  EXPECT_TRUE(has(problem({"mesh", "a", "cuont", "once"}), "'cuont'"));
  EXPECT_TRUE(has(problem({"mesh", "a", "count", "twice"}), "'twice'"));
  EXPECT_TRUE(has(problem({"mesh", "a", "every", "1.5"}), "whole number"));
  EXPECT_TRUE(has(problem({"mesh", "a", "every", "0"}), "out of range"));
  EXPECT_TRUE(has(problem({"mesh", "a", "mesh", "b"}), "given twice"));
  EXPECT_TRUE(has(problem({"mesh", "a", "friction", "1"}), "count each | once"));
}

// Processes hand over their rows of several steps at once.
TEST(pass_file, has_its_rows_in_the_order_of_steps_and_of_ids_within_one)
{
  const TempDir folder;
  PassFile file(folder.path("rows"));
  file.open(0);
  const auto row = [](Real step, Real id) {
    Passage p = {};
    p.step = step;
    p.id = id;
    return p;
  };
  ASSERT_TRUE(file.add({row(8, 2), row(7, 9), row(7, 3), row(8, 1)}));
  EXPECT_EQ(content(folder.path("rows")), "# step time id type diameter x y z vx vy vz direction\n"
                                          "7 0 3 0 0 0 0 0 0 0 0 0\n"
                                          "7 0 9 0 0 0 0 0 0 0 0 0\n"
                                          "8 0 1 0 0 0 0 0 0 0 0 0\n"
                                          "8 0 2 0 0 0 0 0 0 0 0 0\n");
}

}    // namespace
}    // namespace lsdcd::test_flow
