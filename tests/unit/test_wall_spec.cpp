// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A wall's data: what a wall cannot be made of is refused, by its keyword.
#include "base/input_error.h"
#include "support/fake_host.h"
#include "support/says.h"
#include "wall/spec/spec_check.h"
#include "wall/wall.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>

namespace lsdcd::test_wall_spec {
namespace {

WallSpec good()
{
  WallSpec wall;
  wall.meshes.resize(2);
  wall.meshes[1].name = "blade";
  wall.meshes[1].file = "blade.stl";
  wall.inputs = {"height"};
  return wall;
}

// The text of the error; empty: there is none.
std::string refusal_of(const WallSpec &wall)
{
  return lsdcd::error_of([&] { check_spec(wall); });
}

void expect_error(const WallSpec &wall, const std::string &text)
{
  const std::string error = refusal_of(wall);
  EXPECT_TRUE(has(error, text));
}

TEST(wall_spec, a_wall_has_as_many_meshes_as_it_can_have)
{
  expect_error(WallSpec(), "in 'mesh', there are 0 meshes, and a wall has 1 to 32");
  WallSpec wall = good();
  EXPECT_EQ(refusal_of(wall), "");
  const auto add = [&] { wall.meshes.emplace_back().file = std::to_string(wall.meshes.size()); };
  while (wall.meshes.size() < kMaxMeshes) add();
  EXPECT_EQ(refusal_of(wall), "");
  add();
  expect_error(wall, "in 'mesh', there are 33 meshes, and a wall has 1 to 32");
}

TEST(wall_spec, a_wall_without_a_law_of_all_types_is_refused)
{
  WallSpec wall = good();
  wall.laws[0].first_type = 2;
  expect_error(wall, "the wall's first law is not of all types");
  wall.laws.clear();
  expect_error(wall, "the wall's first law is not of all types");
}

TEST(wall_spec, an_input_that_is_not_there_is_refused)
{
  const struct {
    const char *keyword;
    void (*take)(MeshSpec &, int input);
  } rows[] = {
      {"motion",
       [](MeshSpec &m, int input) {
         MotionTerm term;
         term.input[5] = input;
         m.motion.add(term);
       }},
      {"servo", [](MeshSpec &m, int input) { m.motion.servo().target_input = input; }},
      {"surface_vel", [](MeshSpec &m, int input) { m.surface_input[0] = input; }},
      {"temperature", [](MeshSpec &m, int input) { m.temperature_input = input; }},
      {"body", [](MeshSpec &m, int input) { m.body.motor_input = input; }},
      {"body", [](MeshSpec &m, int input) { m.body.load_input[2] = input; }},
      {"body", [](MeshSpec &m, int input) { m.body.moment_input[1] = input; }},
  };
  for (const auto &row : rows)
    for (const int input : {1, -2}) {
      WallSpec wall = good();
      row.take(wall.meshes[1], input);
      expect_error(wall, "in '" + std::string(row.keyword) +
                             "', of mesh 2 'blade': there is no input " + std::to_string(input) +
                             ", as the wall has 1, which count from 0");
    }
  WallSpec wall = good();
  wall.meshes[0].surface_input[0] = 0;
  EXPECT_EQ(refusal_of(wall), "");
}

// Each row is a wall that contradicts itself: the keyword of the blade, or with a point before it of the wall, that is wrong, and why.
TEST(wall_spec, what_does_not_go_together_is_refused_by_its_keyword)
{
  const auto wear = [](WallSpec &w) {
    w.wear.model = WearModel::archard;
    w.wear_deform.every = 5;
  };
  const auto body = [](MeshSpec &m) {
    m.body.present = true;
    m.body.density = 1;
  };
  using Wall = WallSpec;
  using Mesh = MeshSpec;
  const struct {
    std::function<void(Wall &, Mesh &)> spoil;
    const char *keyword, *text;
  } rows[] = {
      {[](Wall &, Mesh &m) { m.has_temperature = true; }, "temperature",
       "a temperature is given, but no sub-model heat uses it"},
      {[](Wall &w, Mesh &) {
         w.laws[0].law.heat = HeatModel::radius;
         w.meshes[0].has_temperature = true;
       },
       "temperature", "the temperature is missing, which the sub-model heat needs"},
      {[](Wall &, Mesh &m) { m.wear_factor = 2; }, "wear_factor",
       "a factor is given, but nothing wears"},
      {[](Wall &w, Mesh &) { w.wear_deform.every = 5; }, ".wear",
       "wear should move the meshes, but nothing wears"},
      {[](Wall &, Mesh &m) { m.pressure = 1; }, "pressure",
       "it acts on nodes, and the mesh has none"},
      {[](Wall &, Mesh &m) { m.pressure_input = 0; }, "pressure", "it acts on nodes"},
      {[](Wall &, Mesh &m) {
         m.has_nodes = true;
         m.motion.add(MotionTerm());
       },
       "nodes", "its nodes alone move such a mesh"},
      {[](Wall &, Mesh &m) {
         m.has_nodes = true;
         m.motion.begin_posed();
       },
       "nodes", "its nodes alone move such a mesh"},
      {[&](Wall &, Mesh &m) {
         m.has_nodes = true;
         body(m);
       },
       "nodes", "its nodes alone move such a mesh"},
      {[](Wall &, Mesh &m) {
         m.has_nodes = true;
         m.cache_file = "a.grid";
       },
       "cache", "the grid of a mesh is made again as its nodes move"},
      {[](Wall &, Mesh &m) { m.has_nodes = m.torque_about_mesh = true; }, "torque_about",
       "a mesh whose nodes move has no frame"},
      {[](Wall &w, Mesh &m) {
         m.has_nodes = true;
         w.nearest = 2;
       },
       "nodes", "a mesh whose nodes move has no lists of the nearest"},
      {[](Wall &w, Mesh &) {
         w.shapes = true;
         w.nearest = 2;
       },
       ".nearest", "contacts of ellipsoids are found without lists"},
      {[&](Wall &w, Mesh &m) {
         m.has_nodes = true;
         wear(w);
       },
       "nodes", "wear moves this mesh, and its nodes are moved by others"},
      {[&](Wall &w, Mesh &m) {
         body(m);
         wear(w);
       },
       "body", "wear moves this mesh, and the mass and centre of a body are those of its"},
      {[](Wall &, Mesh &m) {
         m.motion.begin_posed();
         m.motion.add(MotionTerm());
       },
       "motion", "the poses of the program alone move such a mesh"},
      {[&](Wall &, Mesh &m) {
         body(m);
         m.motion.servo().present = true;
       },
       "body", "a body moves by what acts on it"},
      {[&](Wall &w, Mesh &m) {
         body(m);
         m.body.coat.present = true;
         w.meshes[0].has_nodes = true;
       },
       "body", "its coat cannot feel meshes whose nodes move"},
      {[](Wall &w, Mesh &m) {
         m.laws.resize(1);
         m.laws[0].law = w.law();
         m.laws[0].law.heat = HeatModel::radius;
       },
       "law", "it has the sub-models "},
      {[](Wall &w, Mesh &m) {
         m.laws.resize(1);
         m.laws[0].first_type = 2;
         m.laws[0].law = w.law();
         m.laws[0].law.heat = HeatModel::radius;
       },
       "law", "it has the sub-models "},
      {[](Wall &w, Mesh &m) { m.file = w.meshes[0].file; }, "mesh", "it is that of mesh"},
      {[](Wall &w, Mesh &m) { m.stl.name = w.meshes[0].stl.name = "a.stl"; }, "mesh_stl", "mesh"},
      {[](Wall &w, Mesh &m) { m.fields.name = w.meshes[0].fields.name = "a.vtp"; }, "mesh_fields",
       "mesh"},
      {[](Wall &w, Mesh &m) { m.cache_file = w.meshes[0].cache_file = "a.grid"; }, "cache", "mesh"},
  };
  for (const auto &row : rows) {
    WallSpec wall = good();
    row.spoil(wall, wall.meshes[1]);
    const bool is_of_wall = row.keyword[0] == '.';
    const std::string begin = "in '" + std::string(row.keyword + is_of_wall) + "', " +
                              (is_of_wall ? "" : "of mesh 2 'blade': ") + row.text;
    EXPECT_EQ(refusal_of(wall).substr(0, begin.size()), begin);
  }
}

TEST(wall_spec, what_grains_of_other_shapes_do_not_have_is_refused)
{
  const struct {
    void (*spoil)(WallSpec &, ContactLaw &);
    const char *keyword, *text;
  } rows[] = {
      {[](WallSpec &w, ContactLaw &) { w.side = Side::out; }, "side", "both sides alone"},
      {[](WallSpec &w, ContactLaw &) { w.device = Device::cuda; }, "device", "on a CPU alone"},
      {[](WallSpec &w, ContactLaw &) { w.meshes[0].has_nodes = true; }, "nodes", "nodes move"},
      {[](WallSpec &, ContactLaw &law) { law.normal = NormalModel::jkr; }, "law", "adhesion"},
      {[](WallSpec &, ContactLaw &law) { law.normal = NormalModel::dmt; }, "law", "adhesion"},
      {[](WallSpec &, ContactLaw &law) { law.cohesion = CohesionModel::sjkr; }, "law", "cohesion"},
      {[](WallSpec &, ContactLaw &law) { law.rolling = RollingModel::sds; }, "law", "rolling"},
      {[](WallSpec &, ContactLaw &law) { law.twisting = TwistingModel::sds; }, "law", "twisting"},
      {[](WallSpec &w, ContactLaw &law) {
         law.heat = HeatModel::radius;
         for (MeshSpec &mesh : w.meshes) mesh.has_temperature = true;
       },
       "law", "heat"},
      {[](WallSpec &, ContactLaw &law) { law.tangential = TangentialModel::mindlin_rescale; },
       "law", "rescaled"},
  };
  for (const auto &row : rows) {
    WallSpec wall = good();
    wall.shapes = true;
    EXPECT_EQ(refusal_of(wall), "");
    row.spoil(wall, wall.laws[0].law);
    const std::string error = refusal_of(wall);
    EXPECT_TRUE(begins(error, "in '" + std::string(row.keyword) + "', "));
    EXPECT_TRUE(has(error, row.text));
    wall.shapes = false;
    EXPECT_EQ(refusal_of(wall), "") << row.text;    // of spheres alone it is taken
  }
}

TEST(wall_spec, another_mesh_is_named_as_its_maker_does)
{
  WallSpec wall = good();
  wall.meshes[0].name = "lid";
  wall.meshes[0].stl.name = wall.meshes[1].stl.name = "a.stl";
  expect_error(wall, "of mesh 2 'blade': mesh 1 'lid' has the same file 'a.stl', so one would");
}

// With one mesh no error says which.
TEST(wall_spec, a_coat_needs_another_mesh)
{
  WallSpec wall = good();
  wall.meshes.resize(1);
  wall.meshes[0].body.present = wall.meshes[0].body.coat.present = true;
  wall.meshes[0].body.density = 1;
  EXPECT_EQ(
      refusal_of(wall),
      "in 'body', its coat feels other meshes, and the wall has no other mesh: leave the coat "
      "out");
}

// The sentences of the words of a script (test_body_words).
TEST(wall_spec, a_body_that_there_cannot_be_is_refused)
{
  const struct {
    void (*spoil)(BodySpec &);
    const char *text;
  } cases[] = {
      {[](BodySpec &b) { b.density = -1; }, "the density is -1, not a number of 0 or more"},
      {[](BodySpec &b) { b.density = 0; }, "a mass of 0 is not above 0"},
      {[](BodySpec &b) {
         b.density = 0, b.mass = {1, {0, 0, 0}, {1, 1, 3, 0, 0, 0}};
       },
       "no body has the principal moments of inertia"},
      {[](BodySpec &b) { b.joint.kind = static_cast<JointKind>(9); }, "no joint of kind 9"},
      {[](BodySpec &b) {
         b.joint.axis = {0, 0, 0};
       },
       "a direction must not be 0 0 0"},
      {[](BodySpec &b) {
         b.joint.axis = {0, 0, 2};
       },
       "direction 0 0 2 is not of length 1"},
      {[](BodySpec &b) { b.joint.kind = JointKind::ball, b.drive.stiffness = 1; },
       "spring works only with a joint hinge or slider"},
      {[](BodySpec &b) { b.joint.kind = JointKind::free, b.drive.lo = -1; },
       "limits works only with"},
      {[](BodySpec &b) { b.joint.kind = JointKind::planar, b.motor_input = 0; },
       "motor works only with"},
      {[](BodySpec &b) { b.drive.damping = -1; }, "the damping is -1, not a number of 0 or more"},
      {[](BodySpec &b) { b.drive.lo = 1, b.drive.hi = 0; }, "the limits 1 0 are reversed"},
      {[](BodySpec &b) { b.load.y = NAN; }, "the load is 0 nan 0, which is not finite"},
  };
  WallSpec wall = good();
  BodySpec &body = wall.meshes[1].body;
  body.present = true;
  body.density = 1;
  body.joint.kind = JointKind::hinge;
  EXPECT_EQ(refusal_of(wall), "");
  for (const auto &c : cases) {
    WallSpec spoilt = wall;
    c.spoil(spoilt.meshes[1].body);
    expect_error(spoilt, c.text);
    expect_error(spoilt, "in 'body', of mesh 2 'blade': ");
  }
}

TEST(wall_spec, a_wall_is_not_made_of_what_is_refused)
{
  on_processes(1, [](FakeHost &host) {
    const WallSpec none;
    EXPECT_THROW(Wall(host, none, WallUnits(), WallBackend(), "", StepClock()), InputError);
  });
}

}    // namespace
}    // namespace lsdcd::test_wall_spec
