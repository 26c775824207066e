// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of a rigid body become what it is.
#include "base/input_error.h"
#include "input/body_words.h"
#include "support/says.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace lsdcd::test_body_words {
namespace {

struct Read {
  MeshSpec mesh;
  InputNames inputs;
  std::string rest;    // the first word that is none of a body; empty: none
};

Read read(const std::string &line)
{
  const std::vector<std::string> all = words(line);
  Tokens tokens(all);
  tokens.set_context("body", "body");
  Read r;
  read_body(tokens, r.mesh, r.inputs);
  if (!tokens.done()) r.rest = tokens.peek();
  return r;
}

}    // namespace

TEST(body_words, give_mass_centre_and_moments_in_the_order_of_fix_rigid)
{
  const BodySpec body = read("mass 3 com 1 2 3 inertia 4 5 6 0.1 0.2 0.3").mesh.body;
  EXPECT_EQ(body.density, 0);
  EXPECT_EQ(body.mass.mass, 3);
  EXPECT_TRUE((body.mass.centre == Vec3{1, 2, 3}));
  const SymmetricMatrix &i = body.mass.inertia;
  EXPECT_EQ(i.xx, 4);
  EXPECT_EQ(i.yy, 5);
  EXPECT_EQ(i.zz, 6);
  EXPECT_EQ(i.xy, 0.1);
  EXPECT_EQ(i.xz, 0.2);
  EXPECT_EQ(i.yz, 0.3);
}

TEST(body_words, hold_and_drive_it)
{
  const Read r = read("density 1 motor v_t joint hinge 1 2 3 0 0 -2 spring 10 0.5 0.1 limits -1 2 "
                      "load 1 v_fy 3 moment 4 5 v_t omega 0 0 7 gravity 0 -9.81 0 wear_factor 2");
  const BodySpec &body = r.mesh.body;
  EXPECT_EQ(body.joint.kind, JointKind::hinge);
  EXPECT_TRUE((body.joint.point == Vec3{1, 2, 3}));
  EXPECT_TRUE((body.joint.axis == Vec3{0, 0, -1}));
  EXPECT_EQ(body.drive.stiffness, 10);
  EXPECT_EQ(body.drive.damping, 0.5);
  EXPECT_EQ(body.drive.rest, 0.1);
  EXPECT_EQ(body.drive.lo, -1);
  EXPECT_EQ(body.drive.hi, 2);
  EXPECT_EQ(r.inputs, (InputNames{"t", "fy"}));
  EXPECT_EQ(body.motor_input, 0);
  EXPECT_EQ(body.load_input[1], 1);
  EXPECT_EQ(body.moment_input[2], 0);
  EXPECT_EQ(body.load.z, 3);
  EXPECT_EQ(body.moment.y, 5);
  EXPECT_EQ(body.omega.z, 7);
  EXPECT_TRUE(body.has_gravity);
  EXPECT_EQ(body.gravity.y, -9.81);
  EXPECT_EQ(r.rest, "wear_factor");
}

TEST(body_words, say_what_its_coat_is)
{
  EXPECT_FALSE(read("density 1").mesh.body.coat.present);
  EXPECT_FALSE(read("density 1 coat no").mesh.body.coat.present);
  const CoatSpec chosen = read("density 1 coat auto").mesh.body.coat,
                 given = read("density 1 coat 0.1 0.07 load 1 2 3").mesh.body.coat;
  EXPECT_TRUE(chosen.present && chosen.spacing == 0 && chosen.radius == 0);
  EXPECT_TRUE(given.present && given.spacing == 0.1 && given.radius == 0.07);
}

TEST(body_words, change_what_they_name_and_nothing_else)
{
  const Read before =
      read("density 2 joint hinge 0 0 0 0 0 1 spring 10 0.5 0.1 limits -1 2 motor v_t load 1 2 3");
  const auto changed = [&](const std::string &line, InputNames &inputs) {
    const std::vector<std::string> all = words("body " + line);
    Tokens tokens(all);
    return read_modified_body(tokens, before.mesh.body, inputs);
  };
  InputNames inputs = before.inputs;
  BodySpec to = changed("load v_f 0 0 spring 3 0", inputs);
  EXPECT_EQ(inputs, (InputNames{"t", "f"}));
  EXPECT_EQ(to.load_input[0], 1);
  EXPECT_EQ(to.drive.stiffness, 3);
  EXPECT_EQ(to.drive.rest, 0);
  EXPECT_EQ(to.drive.hi, 2);
  EXPECT_EQ(to.motor_input, 0);
  EXPECT_EQ(to.density, 2);
  to = changed("motor 4", inputs);
  EXPECT_EQ(to.drive.motor, 4);
  EXPECT_EQ(to.motor_input, kNoInput);
  EXPECT_EQ(to.load.y, 2);
  // What another joint's coordinate had goes with it.
  to = changed("limits -3 3 joint slider 0 0 2", inputs);
  EXPECT_EQ(to.joint.kind, JointKind::slider);
  EXPECT_EQ(to.drive.lo, -3);
  EXPECT_EQ(to.drive.stiffness, 0);
  EXPECT_EQ(to.motor_input, kNoInput);
  for (const char *wrong : {"", "density 3", "velocity 1 0 0", "load 1 2"})
    EXPECT_THROW(changed(wrong, inputs), InputError) << wrong;
}

TEST(body_words, are_refused_with_what_is_wrong)
{
  const struct {
    const char *words, *message;
  } cases[] = {
      {"density -1", "density"},
      {"weight 1", "weight"},
      {"mass 1 inertia 1 1 1 0 0 0", "com must follow"},
      {"mass 1 com 0 0 0 inertia 1 1 3 0 0 0", "no body has"},
      {"density 1 joint hinge 0 0 0 0 0 0", "must not be 0 0 0"},
      {"density 1 joint screw 0 0 0", "screw"},
      {"density 1 spring 1 1", "hinge or slider"},
      {"density 1 joint planar 0 0 1 motor 1", "hinge or slider"},
      {"density 1 joint slider 0 0 1 limits 1 -2", "reversed"},
      {"density 1 joint slider 0 0 1 spring -1 1", "stiffness"},
      {"density 1 load 1 2 3 load 1 2 3", "twice"},
      {"density 1 2", "one more than expected"},
      {"density 1 load 1 v_ 3", "name is missing"},
  };
  for (const auto &c : cases) EXPECT_TRUE(fails_with(c.message, [&] { read(c.words); })) << c.words;
}

}    // namespace lsdcd::test_body_words
