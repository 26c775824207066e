// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/servo_words.h"

#include "input/value_words.h"

#include <algorithm>
#include <string>

namespace lsdcd {

const char *const kServoSyntax =
    "force x|y|z|axis ax ay az TARGET vmax V [gain G] [limits lo hi] | torque x|y|z|axis ax ay az "
    "[through px py pz] TARGET vmax W [gain G] [limits lo hi]";

namespace {

void read_line(Tokens &w, Servo &s)
{
  const int d = w.choice({"x", "y", "z", "axis"});
  Vec3 axis = {d == 0 ? 1.0 : 0.0, d == 1 ? 1.0 : 0.0, d == 2 ? 1.0 : 0.0};
  if (d == 3) axis = read_vector(w, "ax", "ay", "az");
  if (axis == Vec3{0, 0, 0}) w.fail("the axis ax ay az must not be 0 0 0");
  s.axis = unit_vector(axis);
  if (w.done() || w.peek() != "through") return;
  if (!s.turns) w.fail("through is for servo torque only");
  w.take();
  s.point = read_vector(w, "px", "py", "pz");
}

void read_limits(Tokens &w, Servo &s)
{
  s.lo = w.number("lo");
  s.hi = w.number("hi");
  if (s.lo > s.hi)
    w.fail("the limits " + number_text(s.lo) + " " + number_text(s.hi) +
           " are reversed: the lower one comes first");
  if (s.lo > 0 || s.hi < 0)
    w.fail("the limits " + number_text(s.lo) + " " + number_text(s.hi) +
           " do not contain 0, which is where the servo begins");
}

Servo read_one_servo(Tokens &w, InputNames &inputs)
{
  Servo s;
  s.present = true;
  s.turns = w.choice({"force", "torque"}) == 1;
  read_line(w, s);
  read_value(w, "the target (number or v_NAME)", s.target, s.target_input, inputs);
  std::vector<std::string> seen;
  while (!w.done()) {
    const std::string word = w.peek();
    if (word != "vmax" && word != "gain" && word != "limits") break;
    if (std::count(seen.begin(), seen.end(), word)) w.fail(word + " is given twice");
    seen.push_back(w.take());
    if (word == "vmax") s.max_speed = w.number("vmax", kAboveZero);
    if (word == "gain") s.max_gain = w.number("the gain", kAboveZero);
    if (word == "limits") read_limits(w, s);
  }
  w.refuse_number();
  if (s.max_speed == 0)
    w.fail("vmax is missing, the speed at which the mesh moves up to the spheres" +
           (w.done() ? "" : "; '" + w.peek() + "' is not a keyword of a servo"));
  return s;
}

}    // namespace

void read_servo(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  s.motion.servo() = read_one_servo(w, inputs);
}

Servo read_modified_servo(Tokens &w, InputNames &inputs)
{
  w.set_context("servo", std::string("fix_modify ID servo ") + kServoSyntax + " | none");
  w.take();
  if (w.done() || w.peek() != "none") return read_one_servo(w, inputs);
  w.take();
  return {};
}

}    // namespace lsdcd
