// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/pose_reader.h"

#include "bodies/read_pose.h"

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

bool PoseReader::read(BodyPose &pose)
{
  while (lines_.next()) {
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
