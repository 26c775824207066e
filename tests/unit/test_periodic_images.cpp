// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh with the images of its triangles across periodic faces.

#include "box/periodic_images.h"

#include "base/input_error.h"
#include "box/likely_scale.h"
#include "box/loose_ends.h"
#include "contact/find_contacts.h"
#include "contact/history.h"
#include "engine/loads/load.h"
#include "grid/triangle_grid.h"
#include "output/feature_rows.h"
#include "support/brute_force_long.h"
#include "support/meshes.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <random>

namespace lsdcd::test_periodic_images {
namespace {

PeriodicBox box_of(const Vec3 &size, Real margin = 0)
{
  PeriodicBox box;
  for (int k = 0; k < 3; k++) {
    box.edge[k] = {0, 0, 0};
    box.edge[k][k] = size[k];
    box.periodic[k] = true;
  }
  box.margin = margin;
  return box;
}

PeriodicBox tilted_box()
{
  PeriodicBox box = box_of({3, 4, 5});
  box.corner = {-0.5, 0.25, 1};
  box.edge[1].x = 1.3;
  box.edge[2].x = -0.9;
  box.edge[2].y = 1.7;
  return box;
}

StepGrid grid_of(const WeldedMesh &mesh, Real cutoff)
{
  StepGridSettings settings;
  settings.cutoff = cutoff;
  return build_grid(mesh, settings);
}

// Triangles anywhere in a box of 2 x 3 x 4, of which none need meet another.
TriangleSoup scattered(std::mt19937_64 &random, int n)
{
  std::uniform_real_distribution<Real> uniform(0, 1);
  TriangleSoup soup;
  for (int t = 0; t < n; t++) {
    const Vec3 at = {2 * uniform(random), 3 * uniform(random), 4 * uniform(random)};
    for (int k = 0; k < 3; k++)
      soup.corners.push_back(at + Vec3{uniform(random), uniform(random), uniform(random)});
  }
  return soup;
}

// A flat square of 2 n^2 triangles, a x a, with its lower corner at the origin.
TriangleSoup square(int n, Real a)
{
  return moved(floor_mesh(n, a / 2), {a / 2, a / 2, 0});
}

}    // namespace

TEST(periodic_box, fractions_of_a_tilted_box_are_those_of_its_edges)
{
  const PeriodicBox box = tilted_box();
  const Vec3 x = box.corner + 0.25 * box.edge[0] + 0.5 * box.edge[1] + 2 * box.edge[2];
  const Vec3 f = box.fraction(x);
  EXPECT_NEAR(f.x, 0.25, 1e-15);
  EXPECT_NEAR(f.y, 0.5, 1e-15);
  EXPECT_NEAR(f.z, 2, 1e-14);
}

TEST(periodic_box, width_is_the_distance_of_faces)
{
  const PeriodicBox box = tilted_box();
  const Vec3 area = cross(box.edge[1], box.edge[2]);
  EXPECT_NEAR(box.width(0), dot(box.edge[0], area) / norm(area), 1e-14);
}

TEST(periodic_images, what_the_mesh_has_keeps_its_number)
{
  std::mt19937_64 random(5);
  for (int round = 0; round < 20; round++) {
    const WeldedMesh mesh = weld(scattered(random, 40), -1);
    const Vec3 size = mesh.report.hi - mesh.report.lo;
    PeriodicBox box = box_of({size.x + 0.1, size.y, 0.7 * size.z});
    box.corner = mesh.report.lo;
    const WeldedMesh whole = with_images(mesh, box, 0.3);
    ASSERT_TRUE(whole.images.any());
    for (std::size_t v = 0; v < mesh.vertices.size(); v++)
      ASSERT_TRUE(mesh.vertices[v] == whole.vertices[v]);
    for (std::size_t f = 0; f < mesh.faces.size(); f++) {
      ASSERT_EQ(mesh.faces[f], whole.faces[f]);
      ASSERT_EQ(mesh.face_edges[f], whole.face_edges[f]);
    }
    for (std::size_t e = 0; e < mesh.edges.size(); e++) ASSERT_EQ(mesh.edges[e], whole.edges[e]);
  }
}

TEST(periodic_images, an_image_is_named_after_what_it_is_an_image_of)
{
  std::mt19937_64 random(7);
  const PeriodicBox box = tilted_box();
  const WeldedMesh mesh = weld(scattered(random, 60), -1);
  const WeldedMesh whole = with_images(mesh, box, 0.5);
  ASSERT_GT(whole.images.face_of.size(), 10u);
  // Moved by whole edges of the box: fractions differ by integers.
  const auto is_image = [&](const Vec3 &x, const Vec3 &of) {
    const Vec3 d = box.fraction(x) - box.fraction(of);
    for (int k = 0; k < 3; k++)
      if (std::fabs(d[k] - std::round(d[k])) > 1e-12) return false;
    return true;
  };
  for (std::size_t i = 0; i < whole.images.vertex_of.size(); i++)
    EXPECT_TRUE(is_image(whole.vertices[mesh.vertices.size() + i],
                         mesh.vertices[whole.images.vertex_of[i]]));
  for (std::size_t i = 0; i < whole.images.face_of.size(); i++)
    for (int k = 0; k < 3; k++)
      EXPECT_TRUE(is_image(whole.vertices[whole.faces[mesh.faces.size() + i][k]],
                           mesh.vertices[mesh.faces[whole.images.face_of[i]][k]]));
  const auto middle = [](const WeldedMesh &m, std::size_t e) {
    return 0.5 * (m.vertices[m.edges[e][0]] + m.vertices[m.edges[e][1]]);
  };
  for (std::size_t i = 0; i < whole.images.edge_of.size(); i++)
    EXPECT_TRUE(
        is_image(middle(whole, mesh.edges.size() + i), middle(mesh, whole.images.edge_of[i])));
}

// The oracle: all 27 copies of the mesh, tested one by one in long double.
TEST(periodic_images, distances_near_faces_are_those_to_all_copies)
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<Real> uniform(0, 1);
  for (int round = 0; round < 10; round++) {
    PeriodicBox box = tilted_box();
    const Real cutoff = 0.2, margin = 0.15;
    const TriangleSoup soup = scattered(random, 30);
    const WeldedMesh mesh = weld(soup, 0);
    const StepGrid grid = grid_of(with_images(mesh, box, cutoff + margin), cutoff);
    TriangleSoup copies;
    for (int a = -1; a <= 1; a++)
      for (int b = -1; b <= 1; b++)
        for (int c = -1; c <= 1; c++)
          for (const Vec3 &x : soup.corners)
            copies.corners.push_back(x + Real(a) * box.edge[0] + Real(b) * box.edge[1] +
                                     Real(c) * box.edge[2]);
    const auto triangles = long_triangles<long double>(copies);
    int near = 0;
    for (int i = 0; i < 2000; i++) {
      Vec3 x = box.corner;
      for (int k = 0; k < 3; k++) {
        const Real past = margin / box.width(k);
        x += (-past + (1 + 2 * past) * uniform(random)) * box.edge[k];
      }
      const Real least =
          std::min(cutoff, long_distance(triangles.data(), static_cast<int>(triangles.size()), x));
      ContactSet<64> set;
      find_contacts(grid.view(), x, cutoff, set);
      Real found = cutoff;
      for (int k = 0; k < set.n; k++) found = std::min(found, set.distance[k]);
      near += least < cutoff;
      // Coordinates below 20 are rounded by 2e-15, and a distance by some tens of that.
      EXPECT_NEAR(found, least, 1e-13);
    }
    EXPECT_GT(near, 20);
  }
}

TEST(periodic_images, seams_weld_where_the_mesh_continues_itself)
{
  const WeldedMesh whole = with_images(weld(square(4, 2), -1), box_of({2, 2, 2}), 0.3);
  for (std::size_t e = 0; e < whole.images.n_edges; e++)
    EXPECT_EQ(whole.edge_first[e + 1] - whole.edge_first[e], 2) << "edge " << e;
}

TEST(periodic_images, a_mesh_far_from_all_faces_has_none)
{
  const WeldedMesh mesh = weld(box_mesh({1, 1, 1}, {2, 2, 2}), -1);
  EXPECT_FALSE(with_images(mesh, box_of({3, 3, 3}), 0.9).images.any());
}

TEST(periodic_images, what_lies_several_boxes_past_a_face_has_its_image_in_the_box)
{
  const PeriodicBox box = tilted_box();
  const Vec3 lo = box.corner + 0.5 * (box.edge[0] + box.edge[1] + box.edge[2]);
  for (int away = 1; away <= 4; away++) {
    const TriangleSoup soup =
        moved(box_mesh(lo, lo + Vec3{0.3, 0.3, 0.3}), Real(away) * (box.edge[0] - box.edge[1]));
    const WeldedMesh whole = with_images(weld(soup, -1), box, 0.1);
    ASSERT_EQ(whole.images.face_of.size(), 12u) << away;
    for (std::size_t v = 8; v < 16; v++)
      for (int k = 0; k < 3; k++)
        EXPECT_NEAR(whole.vertices[v][k], lo[k] + 0.15, 0.15 + 1e-13) << away;
  }
}

// The images lie on the floor and each other: each more would be in every cell of the grid.
TEST(periodic_images, a_floor_of_many_boxes_has_only_the_nearest_images)
{
  PeriodicBox box = box_of({2, 2, 2});
  box.periodic[2] = false;
  const TriangleSoup floor = moved(square(2, 400), {-190, -190, 0});
  EXPECT_EQ(with_images(weld(floor, -1), box, 0.1).images.face_of.size(), 2u * (8 + 3 + 3 + 1));
}

// Leaning along the periodic axis they are at other heights.
TEST(periodic_images, a_leaning_face_of_many_boxes_has_all_that_reach_the_box)
{
  PeriodicBox box = box_of({2, 2, 2});
  box.periodic[1] = box.periodic[2] = false;
  TriangleSoup chute = square(2, 20);
  for (Vec3 &x : chute.corners) x.z = 0.1 * x.x;
  EXPECT_EQ(with_images(weld(chute, -1), box, 0.1).images.face_of.size(), 4u * 6 + 4u * 7);
}

TEST(periodic_images, a_mesh_too_far_away_for_images_is_refused_with_its_distance)
{
  const TriangleSoup soup = box_mesh({4e6, 0, 0}, {4e6 + 1, 1, 1});
  EXPECT_TRUE(fails_with("reaches 2e+06 box lengths", [&] {
    with_images(weld(soup, -1), box_of({2, 2, 2}), 0.1);
  }));
}

TEST(periodic_images, more_images_than_can_be_numbered_are_refused_before_they_are_made)
{
  TriangleSoup chute = square(2, 1e5);
  for (Vec3 &x : chute.corners) x.z = 0.1 * x.x + 0.1 * x.y;
  PeriodicBox box = box_of({2, 2, 2});
  box.periodic[2] = false;
  EXPECT_THROW(with_images(weld(chute, -1), box, 0.1), InputError);
}

TEST(periodic_images, an_image_on_top_of_the_mesh_is_dropped)
{
  // Two boxes long: each half lies on the image of the other.
  const WeldedMesh mesh = weld(square(8, 4), -1);
  PeriodicBox box = box_of({2, 2, 2});
  box.periodic[2] = false;
  const WeldedMesh whole = with_images(mesh, box, 0.01);
  ASSERT_TRUE(whole.images.any());
  for (std::size_t f = mesh.faces.size(); f < whole.faces.size(); f++) {
    Vec3 lo = whole.vertices[whole.faces[f][0]];
    for (int v : whole.faces[f])
      for (int k = 0; k < 3; k++) lo[k] = std::min(lo[k], whole.vertices[v][k]);
    EXPECT_LT(std::min(lo.x, lo.y), 0);    // outside of the mesh
  }
}

TEST(periodic_images, a_contact_goes_on_where_its_sphere_is_wrapped)
{
  const WeldedMesh mesh = weld(square(4, 2), -1);
  const StepGrid grid = grid_of(with_images(mesh, box_of({2, 2, 2}), 0.3), 0.2);
  ContactSet<4> out, in;
  find_contacts(grid.view(), {2.11, 0.7, 0.1}, 0.2, out);
  find_contacts(grid.view(), {0.11, 0.7, 0.1}, 0.2, in);
  ASSERT_EQ(out.n, 1);
  ASSERT_EQ(in.n, 1);
  ASSERT_NE(out.feature[0], in.feature[0]);
  EXPECT_TRUE(are_adjacent(grid.view().wall, out.feature[0], in.feature[0]));
  EXPECT_EQ(own_feature(grid.view().wall, out.feature[0]), in.feature[0]);
}

TEST(periodic_images, loads_of_an_image_are_those_of_the_mesh)
{
  const WeldedMesh mesh = weld(square(4, 2), -1);
  const StepGrid grid = grid_of(with_images(mesh, box_of({2, 2, 2}), 0.3), 0.2);
  ContactSet<4> out;
  find_contacts(grid.view(), {2.11, 0.7, 0.1}, 0.2, out);
  StepContact record = {};
  record.feature = out.feature[0];
  record.normal = 3;
  FeatureRows<Load> loads;
  loads.add(&record, 1, LoadOf{0.5, 0}, grid.view().wall);
  Real sum = 0;
  for (const Load &l : loads.of_faces(mesh)) sum += l.normal;
  EXPECT_EQ(sum, 1.5);
}

// A closed foil through the periodic faces, thinner than a millionth of its diagonal.
TEST(periodic_images, keep_a_thin_foil_open)
{
  const WeldedMesh foil = weld(box_mesh({0, 0.3, 0.5}, {1, 0.7, 0.5 + 4e-7}), -1);
  const WeldedMesh whole = with_images(foil, box_of({1, 1, 1}), 0.1);
  EXPECT_EQ(whole.images.n_vertices, 8u);
  EXPECT_GT(whole.faces.size(), foil.faces.size());
  for (std::size_t v = 0; v < 8; v++) EXPECT_EQ(whole.vertices[v], foil.vertices[v]);
  for (std::size_t f = 0; f < foil.faces.size(); f++) EXPECT_EQ(whole.faces[f], foil.faces[f]);
}

TEST(loose_ends, a_gap_across_the_face_is_found_and_measured)
{
  TriangleSoup belt = square(4, 1);
  for (Vec3 &x : belt.corners) x = {0.01 + 0.97 * x.x, 0.4 + 0.2 * x.y, 0.5};
  PeriodicBox box = box_of({1, 1, 1});
  const WeldedMesh whole = with_images(weld(belt, -1), box, 0.1);
  const StepGrid grid = grid_of(whole, 0.05);
  const LooseEnds loose = loose_ends(whole, grid.view().wall, box, 0.1, 0.2);
  EXPECT_NEAR(loose.gap, 0.03, 1e-12);
  EXPECT_EQ(loose.axis, 0);
}

// Of two plates that hang together nowhere, and of a short one beside a long one.
TEST(loose_ends, a_gap_of_the_mesh_or_of_a_part_is_found)
{
  const PeriodicBox box = box_of({1, 1, 1});
  for (const Real begins : {0.5, 0.01}) {
    TriangleSoup belts = square(4, 1);
    for (Vec3 &x : belts.corners) x = {(begins == 0.5 ? 0.49 : 1) * x.x, 0.1 + 0.2 * x.y, 0.5};
    for (const Vec3 &x : square(3, 1).corners)
      belts.corners.push_back({begins + (0.97 - begins) * x.x, 0.5 + 0.2 * x.y, 0.5});
    const WeldedMesh whole = with_images(weld(belts, -1), box, 0.1);
    const LooseEnds loose = loose_ends(whole, grid_of(whole, 0.05).view().wall, box, 0.1, 0.2);
    EXPECT_NEAR(loose.gap, begins == 0.5 ? 0.03 : 0.04, 1e-12) << begins;
  }
}

TEST(loose_ends, ends_that_meet_or_overlap_are_none)
{
  for (Real length : {1.0, 1.02}) {
    TriangleSoup belt = square(4, 1);
    for (Vec3 &x : belt.corners) x = {length * x.x, 0.4 + 0.2 * x.y, 0.5};
    PeriodicBox box = box_of({1, 1, 1});
    const WeldedMesh whole = with_images(weld(belt, -1), box, 0.1);
    EXPECT_EQ(loose_ends(whole, grid_of(whole, 0.05).view().wall, box, 0.1, 0.2).gap, 0) << length;
  }
}

TEST(likely_scale, is_of_the_unit_in_which_a_mesh_is_as_large_as_the_box)
{
  const struct {
    const char *what;
    Vec3 mesh, box;
    Real scale;
  } rows[] = {
      {"millimetres in a box of metres", {100, 80, 120}, {0.12, 0.12, 0.12}, 1e-3},
      {"centimetres in a box of metres", {10, 10, 20}, {0.2, 0.2, 0.32}, 1e-2},
      {"a flat floor in millimetres in a box of metres", {80, 80, 0}, {0.1, 0.1, 0.06}, 1e-3},
      {"a floor wider than the box", {2000, 2000, 0}, {10, 10, 10}, 1}};
  for (const auto &row : rows) EXPECT_EQ(likely_scale(row.mesh, row.box), row.scale) << row.what;
  const std::string text =
      "; the file is probably in different units: add scale 0.01 if they are centimetres";
  EXPECT_EQ(likely_scale_text({10, 10, 20}, box_of({0.2, 0.2, 0.32})), text);
  // A mesh of 8 to 12 inches, or of centimetres, for a box of 30 cm.
  EXPECT_EQ(likely_scale_text({8, 8, 12}, box_of({0.3, 0.3, 0.3})),
            text + ", or 0.0254 if they are inches");
}

TEST(likely_scale, is_never_without_a_unit_where_a_mesh_is_far_too_large)
{
  for (Real size = 25; size < 1e9; size *= 1.7)
    EXPECT_LT(likely_scale({size, size, size}, {1, 1, 1}), 1) << size;
}
}    // namespace lsdcd::test_periodic_images
