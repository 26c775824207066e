// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Poses of a body, from a file or the command line.
#pragma once

#include "bodies/body_collision.h"
#include "tool/field_lines.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lsdcd {

// From 3 numbers, x y z; 7, with a quaternion w x y z after them; or 12, three rows of a rotation matrix,
// each with a component of the shift. Throws InputError.
BodyPose pose_of_numbers(const std::vector<double> &numbers);

// A pose a line. A first line without a number, or a comment before the first one, may name the columns, in this order.
class PoseReader {
 public:
  explicit PoseReader(const std::string &path) : lines_(InputFile(path)) {}
  bool read(BodyPose &pose);    // false: there are no more
  double share_read() const { return lines_.file().share_read(); }

 private:
  void check_names(const std::vector<std::string_view> &names) const;

  FieldLines lines_;
  bool is_first_ = true;
  std::vector<double> numbers_;
};

}    // namespace lsdcd
