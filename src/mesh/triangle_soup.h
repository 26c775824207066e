// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Triangles as they are in a file: no shared corners, nothing dropped.
#pragma once

#include "base/vec3.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

// How coarse the numbers are that a file has for its corners.
struct FileRounding {
  // Between neighbouring numbers, over their size: 2^-23 of a file of floats. 0: that of Real.
  Real step = 0;
  Vec3 origin = {0, 0, 0};    // where 0 0 0 of the file is

  // Returns the length of a step at x.
  Real at(const Vec3 &x) const { return step * norm(x - origin); }
};

// Corners of triangle t are corners[3t], corners[3t+1], corners[3t+2], in the
// file's winding; units are the file's until a placement is applied. The facet
// number in messages is t + 1.
struct TriangleSoup {
  std::vector<Vec3> corners;
  std::string source;    // file name, for messages
  FileRounding rounding = {};

  std::size_t n_triangles() const { return corners.size() / 3; }
};

// Returns the rounding of its file, where a step of 0 has become that of Real.
FileRounding known_rounding(const TriangleSoup &soup);

// Reads an STL file, ASCII or binary, distinguished by structure (a binary header
// may begin with "solid"). ASCII: several solids, any case, CR LF accepted.
// Throws InputError naming the file, the line or facet, the value and the remedy.
TriangleSoup read_stl(const std::string &path);

// Reads an STL file from a buffer in memory, as read_stl() does from a file. Messages name it `source`.
TriangleSoup read_stl_bytes(const char *bytes, std::size_t size, const std::string &source);

}    // namespace lsdcd
