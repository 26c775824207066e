// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/motion_words.h"

#include "input/value_words.h"

#include <algorithm>

namespace lsdcd {

const char *const kMotionSyntax =
    "linear Vx Vy Vz | wiggle Ax Ay Az period | rotate Px Py Pz Rx Ry Rz period | transrot Vx Vy "
    "Vz "
    "Px Py Pz Rx Ry Rz period | variable v_dx v_dy v_dz v_vx v_vy v_vz | rotate Px Py Pz Rx Ry Rz "
    "variable v_angle v_speed | riggle Px Py Pz Rx Ry Rz degrees period | table FILE [axis Px Py "
    "Pz Rx Ry Rz | about Px Py Pz] [cubic | linear] [repeat] [degrees]";

namespace {

Real fixed_number(Tokens &w, const char *what,
                  const NumberRange &in = {-Tokens::kHuge, Tokens::kHuge})
{
  if (variable_follows(w))
    w.fail(std::string(what) + " must be a number, not the variable '" + w.peek() +
           "': a period or an amplitude that changes would jump. Use motion variable, whose "
           "variables are "
           "the displacement and its velocity in each step, or motion rotate Px Py Pz Rx Ry Rz "
           "variable v_angle v_speed");
  return w.number(what, in);
}

// What to do in place of a negative period.
std::string other_way_text(MotionKind kind)
{
  const bool swings = kind == MotionKind::wiggle || kind == MotionKind::cosine;
  return std::string("give a period above 0 and, to ") + (swings ? "begin" : "turn") +
         " the other way, " + (swings ? "the amplitude" : "the axis") + " with the other sign";
}

Real read_period(Tokens &w, const MotionTerm &m)
{
  Real value = 0;
  if (!w.done() && is_number(w.peek(), &value) && value < 0)
    w.fail("the period = " + w.peek() + " is below 0: " + other_way_text(m.kind));
  return fixed_number(w, "the period", {kAboveZero, Tokens::kHuge});
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

void read_variable(Tokens &w, const char *name, int &input, InputNames &inputs)
{
  if (w.done())
    w.fail(std::string("the variable ") + name +
           " is missing: write v_NAME, or NULL if there is none");
  if (variable_follows(w))
    input = number_of_input(inputs, take_variable(w));
  else if (w.take() != "NULL")
    w.fail(name + std::string(" must be a variable, v_NAME, or NULL"));
}

void read_variables(Tokens &w, MotionTerm &m, InputNames &inputs)
{
  const char *const names[] = {"v_dx", "v_dy", "v_dz", "v_vx", "v_vy", "v_vz"};
  for (int k = 0; k < 6; k++) read_variable(w, names[k], m.input[k], inputs);
}

void read_turn_variables(Tokens &w, MotionTerm &m, InputNames &inputs)
{
  w.take();
  m.kind = MotionKind::variable_turn;
  read_variable(w, "v_angle", m.input[0], inputs);
  read_variable(w, "v_speed", m.input[3], inputs);
}

// The file is read when the wall is made.
void read_table(Tokens &w, MotionTerm &m)
{
  if (w.done()) w.fail("the file name is missing after table");
  m.table_file = w.take();
  TableOptions &o = m.table_options;
  std::vector<std::string> given;
  while (!w.done()) {
    const std::string word = w.peek();
    const std::string kind = word == "about" ? "axis" : word == "cubic" ? "linear" : word;
    if (kind != "axis" && kind != "linear" && kind != "repeat" && kind != "degrees") return;
    w.take();
    if (std::find(given.begin(), given.end(), kind) != given.end())
      w.fail("the keyword '" + word + "' is given twice, or together with one that contradicts it");
    given.push_back(kind);
    if (word == "axis") {
      read_axis(w, m);
      o.has_axis = true;
    } else if (word == "about") {
      m.point = fixed_vector(w, "Px", "Py", "Pz");
    }
    o.linear |= word == "linear";
    o.repeats |= word == "repeat";
    o.degrees |= word == "degrees";
  }
}

MotionTerm read_motion_term(Tokens &w, InputNames &inputs)
{
  MotionTerm m;
  const MotionKind kinds[] = {MotionKind::linear,   MotionKind::wiggle,   MotionKind::rotate,
                              MotionKind::transrot, MotionKind::variable, MotionKind::riggle,
                              MotionKind::table};
  m.kind =
      kinds[w.choice({"linear", "wiggle", "rotate", "transrot", "variable", "riggle", "table"})];
  if (m.kind == MotionKind::linear || m.kind == MotionKind::transrot)
    m.velocity = fixed_vector(w, "Vx", "Vy", "Vz");
  if (m.kind == MotionKind::wiggle) m.amplitude = fixed_vector(w, "Ax", "Ay", "Az");
  if (m.turns()) read_axis(w, m);
  if (m.kind == MotionKind::rotate && !w.done() && w.peek() == "variable")
    read_turn_variables(w, m, inputs);
  else if (m.kind == MotionKind::riggle)
    m.angle = fixed_number(w, "the amplitude in degrees") * (kPi / 180);
  const bool has_period = m.turns() && m.kind != MotionKind::variable_turn;
  if (has_period || m.kind == MotionKind::wiggle) m.period = read_period(w, m);
  if (m.kind == MotionKind::variable) read_variables(w, m, inputs);
  if (m.kind == MotionKind::table) read_table(w, m);
  if (m.is_by_inputs() && std::all_of(m.input, m.input + 6, [](int i) { return i == kNoInput; }))
    w.fail("all variables are NULL, so nothing would move: give at least one");
  w.refuse_number(has_period ? ": there is one centre P, one axis R and one period; for a second "
                               "turn write motion once more"
                             : "");
  return m;
}

MotionTerm read_wiggle_term(Tokens &w)
{
  MotionTerm m;
  m.kind = MotionKind::cosine;
  const int dim = w.choice({"x", "y", "z"});
  m.amplitude[dim] = fixed_number(w, "the amplitude");
  m.period = read_period(w, m);
  return m;
}

}    // namespace

void read_surface_vel(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  const char *const names[] = {"vx", "vy", "vz"};
  for (int d = 0; d < 3; d++)
    read_value(w, names[d], s.surface.velocity[d], s.surface_input[d], inputs);
}

void read_shear(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  const int d = w.choice({"x", "y", "z"});
  read_value(w, "the speed", s.surface.velocity[d], s.surface_input[d], inputs);
}

void read_motion(Tokens &w, MeshSpec &s, InputNames &inputs)
{
  if (!w.done() && w.peek() == "caller") {    // of programs; parse_wall() refuses it in scripts
    w.take();
    s.motion.begin_posed();
    return;
  }
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
    read_value(w, names[d], s.surface.angular[d], s.surface_input[3 + d], inputs);
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
        w.fail("none stops all motion: write no other motion with it");
    } else {
      if (!w.done() && w.peek() == "caller")
        w.fail("a mesh has poses of its program from the start or not at all: say motion caller "
               "when the wall is made");
      read.add(read_motion_term(w, inputs));
    }
  }
  return read;
}

}    // namespace lsdcd
