// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Writes pairs of triangles that meet to a file, pose by pose.
#pragma once

#include "bodies/mesh_collision.h"

#include <cstddef>
#include <memory>
#include <string>

namespace lsdcd {

class PairWriter {
 public:
  virtual ~PairWriter() = default;
  virtual void write(std::size_t pose, const MeshCollision &of, const Collision &found) = 0;
  virtual void commit() = 0;    // until then the file is not there
};

// Pose and triangles in a file that ends in .csv. Throws InputError for another ending.
std::unique_ptr<PairWriter> open_pairs(const std::string &path);

// And where each pair cuts: .csv, or .vtp, lines with pose and triangles as their data, which are
// stored in memory until the end. Pairs in one plane have no line; their numbers in .csv are nan.
std::unique_ptr<PairWriter> open_segments(const std::string &path);

}    // namespace lsdcd
