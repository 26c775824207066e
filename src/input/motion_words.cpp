// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/motion_words.h"

namespace lsdcd {

const char *const kMotionSyntax =
    "linear Vx Vy Vz | wiggle Ax Ay Az period | rotate Px Py Pz Rx Ry Rz period | transrot Vx Vy "
    "Vz "
    "Px Py Pz Rx Ry Rz period | variable v_dx v_dy v_dz v_vx v_vy v_vz";

namespace {

bool variable_follows(const Tokens &w)
{
  return !w.done() && w.peek().rfind("v_", 0) == 0;
}

std::string take_variable(Tokens &w)
{
  const std::string name = w.take().substr(2);
  if (name.empty()) w.fail("the variable's name is missing after v_");
  return name;
}

Real fixed_number(Tokens &w, const char *what, Real low = -Tokens::kHuge)
{
  if (variable_follows(w))
    w.fail(std::string(what) + " must be a number, not the variable '" + w.peek() +
           "': where the mesh is would have to be integrated. Use motion variable, whose variables "
           "give the displacement and its velocity at every time");
  return w.number(what, low);
}

Vec3 fixed_vector(Tokens &w, const char *x, const char *y, const char *z)
{
  Vec3 a;
  a.x = fixed_number(w, x);
  a.y = fixed_number(w, y);
  a.z = fixed_number(w, z);
  return a;
}

void read_axis(Tokens &w, MotionTerm &m)
{
  m.point = fixed_vector(w, "Px", "Py", "Pz");
  m.axis = fixed_vector(w, "Rx", "Ry", "Rz");
  if (m.axis == Vec3{0, 0, 0}) w.fail("the axis Rx Ry Rz must not be 0 0 0");
}

void read_variables(Tokens &w, MotionTerm &m, InputNames &inputs)
{
  const char *const names[] = {"v_dx", "v_dy", "v_dz", "v_vx", "v_vy", "v_vz"};
  for (int k = 0; k < 6; k++) {
    if (w.done()) w.fail(std::string("the variable ") + names[k] + " is missing (NULL: none)");
    if (variable_follows(w))
      m.input[k] = number_of_input(inputs, take_variable(w));
    else if (w.take() != "NULL")
      w.fail(std::string("in the place of ") + names[k] + " a variable v_NAME or NULL is expected");
  }
  for (int d = 0; d < 3; d++)
    if (m.input[d] == kNoInput && m.input[3 + d] != kNoInput)
      w.fail(std::string("there is a velocity ") + names[3 + d] + " without a displacement " +
             names[d] +
             ": it would have to be integrated. Give both, as with vdisplace() and a "
             "number, or ramp()");
  if (m.input[0] == kNoInput && m.input[1] == kNoInput && m.input[2] == kNoInput)
    w.fail("all variables are NULL, and nothing moves");
}

MotionTerm read_motion_term(Tokens &w, InputNames &inputs)
{
  MotionTerm m;
  const MotionKind kinds[] = {MotionKind::linear, MotionKind::wiggle, MotionKind::rotate,
                              MotionKind::transrot, MotionKind::variable};
  m.kind = kinds[w.choice({"linear", "wiggle", "rotate", "transrot", "variable"})];
  if (m.kind == MotionKind::linear || m.kind == MotionKind::transrot)
    m.velocity = fixed_vector(w, "Vx", "Vy", "Vz");
  if (m.kind == MotionKind::wiggle) m.amplitude = fixed_vector(w, "Ax", "Ay", "Az");
  if (m.turns()) read_axis(w, m);
  if (m.turns() || m.kind == MotionKind::wiggle)
    m.period = fixed_number(w, "the period", kAboveZero);
  if (m.kind == MotionKind::variable) read_variables(w, m, inputs);
  if (w.number_follows())
    w.fail("the number '" + w.peek() + "' is one too many" +
           (m.turns() ? ": there is one centre P, one axis R and one period; for a second turn "
                        "write motion once more"
                      : ""));
  return m;
}

MotionTerm read_wiggle_term(Tokens &w)
{
  MotionTerm m;
  m.kind = MotionKind::cosine;
  const int dim = w.choice({"x", "y", "z"});
  m.amplitude[dim] = fixed_number(w, "the amplitude");
  m.period = fixed_number(w, "the period", kAboveZero);
  return m;
}

// A number, or v_NAME, which is an input: then the number is 0.
Real number_or_variable(Tokens &w, const char *what, int &input, InputNames &inputs)
{
  if (!variable_follows(w)) return w.number(what);
  input = number_of_input(inputs, take_variable(w));
  return 0;
}

}    // namespace

void read_surface_vel(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  const char *const names[] = {"vx", "vy", "vz"};
  for (int d = 0; d < 3; d++)
    s.surface.velocity[d] = number_or_variable(w, names[d], s.surface_input[d], inputs);
}

void read_shear(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  const int d = w.choice({"x", "y", "z"});
  s.surface.velocity[d] = number_or_variable(w, "the speed", s.surface_input[d], inputs);
}

void read_motion(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  s.motion.add(read_motion_term(w, inputs));
}

void read_wiggle(Tokens &w, MeshSpec &s, InputNames &)
{
  s.motion.add(read_wiggle_term(w));
}

void read_surface_angvel(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  const char *const names[] = {"wx", "wy", "wz"};
  for (int d = 0; d < 3; d++)
    s.surface.angular[d] = number_or_variable(w, names[d], s.surface_input[3 + d], inputs);
  if (w.number_follows())
    s.surface.centre = fixed_vector(w, "the centre (x)", "the centre (y)", "the centre (z)");
}

RigidMotion read_modified_motion(Tokens &w, InputNames &inputs)
{
  RigidMotion read;
  w.set_context("motion", std::string("fix_modify ID motion ") + kMotionSyntax + " | none");
  while (!w.done() && w.peek() == "motion") {
    w.take();
    if (!w.done() && w.peek() == "none") {
      w.take();
      if (read.moves() || (!w.done() && w.peek() == "motion"))
        w.fail("none stops all motion: it must stand alone");
    } else {
      read.add(read_motion_term(w, inputs));
    }
  }
  return read;
}

}    // namespace lsdcd
