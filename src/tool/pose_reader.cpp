// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/pose_reader.h"

#include "bodies/read_pose.h"

#include <utility>

namespace lsdcd {

BodyPose pose_of_numbers(const std::vector<double> &n)
{
  constexpr double kAsItIs[4] = {1, 0, 0, 0};
  if (n.size() == 12) return pose_of_matrix(n.data());
  if (n.size() != 3 && n.size() != 7)
    throw InputError("a pose has " + std::to_string(n.size()) +
                     " numbers; give 3 (x y z), 7 (x y z qw qx qy qz) or 12 (three rows of a "
                     "rotation matrix and shift)");
  return pose_of_quaternion({n[0], n[1], n[2]}, n.size() == 7 ? n.data() + 3 : kAsItIs);
}

// A quaternion with w last, as many programs have it, is another turn.
void PoseReader::check_names(const std::vector<std::string_view> &names) const
{
  for (int k = 0; k < 3; k++)
    if (const std::ptrdiff_t at = column_of(names, "xyz"[k]); at >= 0 && at != k)
      lines_.fail(std::string("follows names with ") + "xyz"[k] + " in column " +
                  std::to_string(at + 1) + "; a pose begins with x y z");
  for (std::size_t k = 0; k < names.size() && names.size() == 7; k++)
    if (const char end = names[k].empty() ? ' ' : names[k].back();
        (end == 'w' || end == 'W') && k != 3)
      lines_.fail("follows names with '" + std::string(names[k]) + "' in column " +
                  std::to_string(k + 1) + "; a pose is x y z qw qx qy qz");
}

bool PoseReader::read(BodyPose &pose)
{
  while (lines_.next()) {
    if (std::exchange(is_first_, false))
      check_names(lines_.are_names() ? lines_.fields() : lines_.names_of_comment());
    if (lines_.are_names()) continue;
    numbers_.clear();
    for (std::size_t k = 0; k < lines_.fields().size(); k++)
      numbers_.push_back(number<double>(lines_.file(), lines_.fields(), k));
    try {
      pose = pose_of_numbers(numbers_);
    } catch (const InputError &e) {
      lines_.fail(std::string("cannot be used: ") + e.what());
    }
    return true;
  }
  return false;
}

}    // namespace lsdcd
