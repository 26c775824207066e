// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/body_words.h"

#include "input/value_words.h"
#include "motion/motion.h"

#include <algorithm>
#include <iterator>
#include <string>
#include <vector>

namespace lsdcd {

const char *const kBodySyntax =
    "density D | mass M com x y z inertia Ixx Iyy Izz Ixy Ixz Iyz  [joint free | hinge px py pz ax "
    "ay az | slider ax ay az | planar nx ny nz | ball px py pz] [spring K C [rest]] [limits lo hi] "
    "[motor T] [load fx fy fz] [moment tx ty tz] [velocity vx vy vz] [omega wx wy wz] [gravity gx "
    "gy gz] [coat auto | no | SPACING RADIUS]";

namespace {

Vec3 read_direction(Tokens &w, const char *x, const char *y, const char *z)
{
  const Vec3 a = read_vector(w, x, y, z);
  return a == Vec3{0, 0, 0} ? a : unit_vector(a);
}

void expect(Tokens &w, const char *word)
{
  if (w.done() || w.peek() != word) w.fail(std::string(word) + " must follow");
  w.take();
}

void read_mass(Tokens &w, BodySpec &body)
{
  if (w.choice({"density", "mass"}) == 0) {
    body.density = w.number("the density", kAboveZero);
    return;
  }
  body.mass.mass = w.number("the mass", kAboveZero);
  expect(w, "com");
  body.mass.centre = read_vector(w, "x", "y", "z");
  expect(w, "inertia");
  SymmetricMatrix &inertia = body.mass.inertia;
  inertia.xx = w.number("Ixx", kAboveZero);
  inertia.yy = w.number("Iyy", kAboveZero);
  inertia.zz = w.number("Izz", kAboveZero);
  inertia.xy = w.number("Ixy");
  inertia.xz = w.number("Ixz");
  inertia.yz = w.number("Iyz");
}

void read_joint(Tokens &w, BodySpec &body)
{
  Joint &j = body.joint;
  j.kind = static_cast<JointKind>(w.choice({std::begin(kJointNames), std::end(kJointNames)}));
  if (j.has_point()) j.point = read_vector(w, "px", "py", "pz");
  if (j.has_coordinate()) j.axis = read_direction(w, "ax", "ay", "az");
  if (j.kind == JointKind::planar) j.axis = read_direction(w, "nx", "ny", "nz");
}

void read_limits(Tokens &w, JointDrive &drive)
{
  drive.lo = w.number("lo");
  drive.hi = w.number("hi");
}

void read_spring(Tokens &w, JointDrive &drive)
{
  drive.stiffness = w.number("the stiffness", 0);
  drive.damping = w.number("the damping", 0);
  drive.rest = w.number_follows() ? w.number("rest") : 0;
}

void read_coat(Tokens &w, CoatSpec &coat)
{
  coat = CoatSpec();
  if (!w.number_follows()) {
    coat.present = w.choice({"no", "auto"}) == 1;
    return;
  }
  coat.present = true;
  coat.spacing = w.number("the spacing of the coat", kAboveZero);
  coat.radius = w.number("the radius of the coat", kAboveZero);
}

void read_word(const std::string &word, Tokens &w, BodySpec &body, InputNames &inputs)
{
  if (word == "joint")
    read_joint(w, body);
  else if (word == "spring")
    read_spring(w, body.drive);
  else if (word == "limits")
    read_limits(w, body.drive);
  else if (word == "motor")
    read_value(w, "the motor's force or torque (number or v_NAME)", body.drive.motor,
               body.motor_input, inputs);
  else if (word == "load")
    read_values(w, {"fx (number or v_NAME)", "fy (number or v_NAME)", "fz (number or v_NAME)"},
                body.load, body.load_input, inputs);
  else if (word == "moment")
    read_values(w, {"tx (number or v_NAME)", "ty (number or v_NAME)", "tz (number or v_NAME)"},
                body.moment, body.moment_input, inputs);
  else if (word == "velocity")
    body.velocity = read_vector(w, "vx", "vy", "vz");
  else if (word == "omega")
    body.omega = read_vector(w, "wx", "wy", "wz");
  else if (word == "coat")
    read_coat(w, body.coat);
  else
    body.gravity = read_vector(w, "gx", "gy", "gz");
  body.has_gravity |= word == "gravity";
}

// The words that follow, each once. Returns them.
std::vector<std::string> read_words(Tokens &w, const std::vector<std::string> &words,
                                    BodySpec &body, InputNames &inputs)
{
  std::vector<std::string> seen;
  while (!w.done()) {
    const std::string word = w.peek();
    if (!std::count(words.begin(), words.end(), word)) break;
    if (std::count(seen.begin(), seen.end(), word)) w.fail(word + " is given twice");
    seen.push_back(w.take());
    read_word(word, w, body, inputs);
  }
  w.refuse_number();
  return seen;
}

}    // namespace

void read_body(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  BodySpec &body = s.body;
  body.present = true;
  read_mass(w, body);
  read_words(w,
             {"joint", "spring", "limits", "motor", "load", "moment", "velocity", "omega",
              "gravity", "coat"},
             body, inputs);
  try {
    check_body(body);
  } catch (const InputError &e) {
    w.fail(e.what());
  }
}

BodySpec read_modified_body(Tokens &w, const BodySpec &body, InputNames &inputs)
{
  w.set_context("body",
                "fix_modify ID body [joint ...] [spring K C [rest]] [limits lo hi] [motor T] [load "
                "fx fy fz] [moment tx ty tz] [gravity gx gy gz]");
  w.take();
  BodySpec to = body;
  const std::vector<std::string> seen = read_words(
      w, {"joint", "spring", "limits", "motor", "load", "moment", "gravity"}, to, inputs);
  const auto has = [&](const char *word) { return std::count(seen.begin(), seen.end(), word) > 0; };
  if (seen.empty())
    w.fail(w.done() ? "nothing is given to change: write at least one of the keywords"
                    : "'" + w.peek() + "' is not a keyword of a body, or cannot change");
  if (to.joint == body.joint) return to;
  const JointDrive none, all = to.drive;
  to.drive = none;
  if (has("spring")) {
    to.drive.stiffness = all.stiffness;
    to.drive.damping = all.damping;
    to.drive.rest = all.rest;
  }
  if (has("limits")) {
    to.drive.lo = all.lo;
    to.drive.hi = all.hi;
  }
  to.drive.motor = has("motor") ? all.motor : 0;
  if (!has("motor")) to.motor_input = kNoInput;
  return to;
}

}    // namespace lsdcd
