// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points from a file of any size, block by block.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

struct PointBlock {
  std::vector<double> xyz;               // three numbers a point
  std::vector<std::int64_t> step, id;    // of a dump's atoms; else empty
  std::size_t size() const { return xyz.size() / 3; }
  void clear()
  {
    xyz.clear();
    step.clear();
    id.clear();
  }
};

class PointReader {
 public:
  virtual ~PointReader() = default;
  // Reads up to `most` points into the block; none: the end. Throws InputError with the file, the line
  // or point, the value and the remedy.
  virtual void read(PointBlock &block, std::size_t most) = 0;
  virtual double share_read() const = 0;    // 0 to 1
  bool has_ids() const { return has_ids_; }

 protected:
  bool has_ids_ = false;
};

// The contents say the format: a .npy array (n, 3) of floats, doubles or integers, a text dump of LAMMPS,
// or lines with numbers between commas, semicolons or blanks.
std::unique_ptr<PointReader> open_points(const std::string &path);

}    // namespace lsdcd
