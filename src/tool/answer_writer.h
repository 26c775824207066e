// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Writes the answers for points to a file of any size, block by block.
#pragma once

#include "tool/point_reader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

enum class SideKind { none, exact, estimated };

// As in query/point_work.h.
struct AnswerBlock {
  std::vector<double> distance, closest;
  std::vector<std::uint32_t> triangle, feature;
  std::vector<std::int8_t> side;    // empty: the mesh has none
  std::vector<double> winding;      // empty: sides are exact; else they are by these, probable

  void resize(std::size_t n, SideKind sides)
  {
    winding.resize(sides == SideKind::estimated ? n : 0);
    distance.resize(n);
    closest.resize(3 * n);
    triangle.resize(n);
    feature.resize(n);
    side.resize(sides == SideKind::none ? 0 : n);
  }
};

class AnswerWriter {
 public:
  virtual ~AnswerWriter() = default;
  virtual void write(const PointBlock &points, const AnswerBlock &answers) = 0;
  virtual void commit() = 0;    // until then the file is not there
};

// The ending of its name says the format: .csv or .npy; - is CSV in the standard output. Throws InputError for another.
std::unique_ptr<AnswerWriter> open_answers(const std::string &path, bool with_ids, SideKind sides);

}    // namespace lsdcd
