// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spec/spec_text.h"

#include "base/input_words.h"
#include "base/vector_text.h"
#include "law/sub_models.h"

#include <cmath>

namespace lsdcd {

namespace {

constexpr Real kDegrees = 180 / kPi;    // in a radian

std::string with_comma(const std::string &list, const std::string &next)
{
  return list + (list.empty() ? "" : ", ") + next;
}

std::string step_text(const PlacementStep &step)
{
  const Vec3 &v = step.vector;
  std::string text;
  switch (step.kind) {
    case PlacementStep::scale:
      return "scale " + (v.x == v.y && v.y == v.z ? number_text(v.x) : vector_text(v));
    case PlacementStep::rotate:
      return "rotate " + vector_text(v) + " " + number_text(step.degrees);
    case PlacementStep::matrix:
      text = "matrix";
      for (int k = 0; k < 3; k++) text += " " + vector_text(step.row[k]) + " " + number_text(v[k]);
      return text;
    default:
      return "move " + vector_text(v);
  }
}

std::string input_text(int input, const InputNames &inputs)
{
  return "v_" + inputs[static_cast<std::size_t>(input)];
}

// The direction of the only component of a vector that is not 0; else empty.
std::string direction(const Vec3 &a)
{
  for (int d = 0; d < 3; d++)
    if (a[d] != 0 && a[(d + 1) % 3] == 0 && a[(d + 2) % 3] == 0) return {"xyz"[d]};
  return "";
}

std::string cosine_text(const MotionTerm &m)
{
  const std::string along = direction(m.amplitude);
  const int d = along.empty() ? 0 : along[0] - 'x';
  return "wiggle " + (along.empty() ? "x" : along) + " " + number_text(m.amplitude[d]) + " " +
         number_text(m.period);
}

std::string input_or_null(int input, const InputNames &inputs)
{
  return " " + (input == kNoInput ? "NULL" : input_text(input, inputs));
}

std::string table_text(const MotionTerm &m)
{
  const TableOptions &o = m.table_options;
  std::string text = "table " + (m.table_file.empty() ? "of rows" : m.table_file);
  if (o.has_axis)
    text += " axis " + vector_text(m.point) + " " + vector_text(m.axis);
  else if (!(m.point == Vec3{0, 0, 0}))
    text += " about " + vector_text(m.point);
  if (o.linear) text += " linear";
  if (o.repeats) text += " repeat";
  return text + (o.degrees ? " degrees" : "");
}

std::string term_text(const MotionTerm &m, const InputNames &inputs)
{
  const std::string axis = vector_text(m.point) + " " + vector_text(m.axis),
                    period = " " + number_text(m.period);
  std::string text = "variable";
  switch (m.kind) {
    case MotionKind::linear:
      return "linear " + vector_text(m.velocity);
    case MotionKind::wiggle:
      return "wiggle " + vector_text(m.amplitude) + period;
    case MotionKind::cosine:
      return cosine_text(m);
    case MotionKind::rotate:
      return "rotate " + axis + period;
    case MotionKind::transrot:
      return "transrot " + vector_text(m.velocity) + " " + axis + period;
    case MotionKind::variable:
      for (const int input : m.input) text += input_or_null(input, inputs);
      return text;
    case MotionKind::riggle:
      return "riggle " + axis + " " + number_text(m.angle * kDegrees) + period;
    case MotionKind::variable_turn:
      return "rotate " + axis + " variable" + input_or_null(m.input[0], inputs) +
             input_or_null(m.input[3], inputs);
    case MotionKind::table:
      return table_text(m);
  }
  return text;
}

}    // namespace

std::string placement_text(const Placement &placement)
{
  std::string text;
  for (const PlacementStep &step : placement.steps()) text = with_comma(text, step_text(step));
  return text;
}

std::string motion_text(const std::vector<MotionTerm> &terms, const InputNames &inputs)
{
  std::string text;
  for (const MotionTerm &m : terms) text = with_comma(text, term_text(m, inputs));
  return text;
}

std::string servo_text(const Servo &s, const InputNames &inputs)
{
  if (!s.present) return "";
  const std::string along = direction(s.axis);
  const bool is_along = !along.empty() && s.axis[along[0] - 'x'] == 1;
  std::string text = s.turns ? "torque " : "force ";
  text += is_along ? along : "axis " + vector_text(s.axis);
  if (!(s.point == Vec3{0, 0, 0})) text += " through " + vector_text(s.point);
  text += " " +
          (s.target_input == kNoInput ? number_text(s.target) : input_text(s.target_input, inputs));
  text += " vmax " + number_text(s.max_speed);
  if (std::isfinite(s.max_gain)) text += " gain " + number_text(s.max_gain);
  if (std::isfinite(s.lo) || std::isfinite(s.hi))
    text += " limits " + number_text(s.lo) + " " + number_text(s.hi);
  return text;
}

std::string types_text(const LawOfTypes &row)
{
  if (row.is_of_all()) return "";
  const std::string first = std::to_string(row.first_type);
  if (row.last_type == row.first_type) return first;
  return first + "*" + (row.last_type == kAnyType ? "" : std::to_string(row.last_type));
}

std::string law_name(const LawOfTypes &row)
{
  if (!row.name.empty()) return row.name;
  std::string text = row.law.is_classic() ? "" : "granular";
  for (const SubModel *model : rows_of(row.law)) {
    if (row.law.is_classic() && model->family != Family::style) continue;
    const std::string family = family_word(model->family);
    for (const std::string &word : {family, std::string(model->name)})
      if (!word.empty()) text += (text.empty() ? "" : " ") + word;
  }
  return text;
}

}    // namespace lsdcd
