// Poses of a body, from a file or the command line.
#pragma once

#include "bodies/body_collision.h"
#include "tool/input_file.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace lsdcd {

// Of 3 numbers, x y z; 7, with a quaternion w x y z behind them; or 12, three rows of a rotation
// matrix, each with its number of the shift. Throws InputError.
BodyPose pose_of_numbers(const std::vector<double> &numbers);

// A pose a line; words of numbers between blanks, commas or semicolons. Lines that are empty or
// begin with # are left out, and a first one that has no number.
class PoseReader {
 public:
  explicit PoseReader(const std::string &path) : file_(path) {}
  bool read(BodyPose &pose);    // false: there are no more
  double share_read() const { return file_.share_read(); }

 private:
  InputFile file_;
  bool first_ = true;
  std::vector<std::string_view> words_;
  std::vector<double> numbers_;
};

}    // namespace lsdcd
