// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/value_words.h"

namespace lsdcd {

Vec3 read_vector(Tokens &w, const char *x, const char *y, const char *z)
{
  Vec3 a;
  a.x = w.number(x);
  a.y = w.number(y);
  a.z = w.number(z);
  return a;
}

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

void read_value(Tokens &w, const std::string &what, Real &value, int &input, InputNames &inputs)
{
  value = 0;
  input = kNoInput;
  if (variable_follows(w))
    input = number_of_input(inputs, take_variable(w));
  else
    value = w.number(what.c_str());
}

void read_values(Tokens &w, const char *const (&names)[3], Vec3 &values, int (&input)[3],
                 InputNames &inputs)
{
  for (int d = 0; d < 3; d++) read_value(w, names[d], values[d], input[d], inputs);
}

}    // namespace lsdcd
