// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Triangles in a file that other programs read.
#pragma once

#include "mesh/triangle_soup.h"

#include <string>

namespace lsdcd {

// Throws InputError with the known endings if the name has another.
void check_mesh_name(const std::string &path);

// The ending, in any case, says the format. If all corners are floats, STL and PLY are binary in float; else STL
// is text and PLY binary in double. OBJ and OFF are text. Text gives every number to the last bit.
// Corners with equal coordinates are one vertex. The file appears whole or not at all. Throws
// InputError that names it.
void write_mesh_file(const std::string &path, const TriangleSoup &soup);

}    // namespace lsdcd
