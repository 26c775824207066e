#include "tool/pose_reader.h"

#include "bodies/read_pose.h"

#include <charconv>

namespace lsdcd {

namespace {

bool read_number(std::string_view word, double &value)
{
  if (word.size() > 1 && word[0] == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  return error == std::errc() && end == word.data() + word.size();
}

}    // namespace

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
  std::string_view line;
  while (file_.line(line)) {
    split_words(line, words_);
    if (words_.empty() || words_[0][0] == '#') continue;
    numbers_.clear();
    std::string_view unread;
    for (const std::string_view word : words_) {
      double value = 0;
      if (read_number(word, value))
        numbers_.push_back(value);
      else if (unread.empty())
        unread = word;
    }
    const bool names = first_ && numbers_.empty();
    first_ = false;
    if (names) continue;
    if (!unread.empty())
      file_.fail_at_line(file_.line_number(), "has '" + std::string(unread) + "', no number");
    try {
      pose = pose_of_numbers(numbers_);
    } catch (const InputError &e) {
      file_.fail_at_line(file_.line_number(), std::string("cannot be used: ") + e.what());
    }
    return true;
  }
  return false;
}

}    // namespace lsdcd
