// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/ball_reader.h"

#include "base/number_words.h"
#include "mesh/measure_mesh.h"
#include "tool/field_lines.h"

#include <cmath>

namespace lsdcd {

std::vector<Ball> read_balls(const std::string &file, double scale)
{
  FieldLines lines{InputFile(file)};
  std::vector<Ball> balls;
  const auto &fields = lines.fields();
  while (lines.next()) {
    if (lines.are_names()) {
      if (fields.size() != 4 || column_of(fields, 'x') != 0 || column_of(fields, 'y') != 1 ||
          column_of(fields, 'z') != 2)
        lines.fail("names other columns than x y z radius; give these four in this order");
      continue;
    }
    if (fields.size() != 4)
      lines.fail("has " + counted(static_cast<std::int64_t>(fields.size()), "column") +
                 "; a sphere is x y z radius");
    double value[4];
    for (std::size_t k = 0; k < 4; k++) {
      value[k] = number<double>(lines.file(), fields, k);
      if (!(std::fabs(value[k]) <= kLargestLength))
        lines.fail("has " + std::string(fields[k]) + " in column " + std::to_string(k + 1) +
                   ", which is no length that can be squared; give one below 1e100");
    }
    if (!(value[3] > 0))
      lines.fail("has a radius of " + std::string(fields[3]) + "; give one above 0");
    balls.push_back({scale * Vec3{value[0], value[1], value[2]}, scale * value[3]});
  }
  if (balls.empty())
    throw InputError(file + ": the file has no spheres; each is a line x y z radius");
  return balls;
}

}    // namespace lsdcd
