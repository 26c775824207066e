// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A text file with a row for each passage of a sphere through a surface.
#pragma once

#include "base/vec3.h"

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

// What a sphere was at the end of the step in which it passed.
struct Passage {
  Real step, time;
  Real id, type;    // whole numbers
  Real diameter;    // 0: a point
  Vec3 x, v;
  Real direction;    // 1 along the normal of the triangle, -1 against it
};

// Rows are in the order of steps, and of IDs within one, whichever processes they come from.
class PassFile {
 public:
  explicit PassFile(std::string path) : path_(std::move(path)) {}

  // Throws InputError if the file cannot be written. The first `kept` rows that are there stay, as those of the run that
  // goes on; 0: the file begins anew.
  void open(std::int64_t kept);
  bool is_open() const { return file_ != nullptr; }
  std::int64_t rows() const { return rows_; }
  // Adds rows, which no later call may precede. Returns false if not all could be written.
  bool add(std::vector<Passage> rows);

 private:
  struct Close {
    void operator()(std::FILE *file) const { std::fclose(file); }
  };
  std::string path_;
  std::int64_t rows_ = 0;
  std::unique_ptr<std::FILE, Close> file_;
};

}    // namespace lsdcd
