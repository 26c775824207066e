// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Triangles as a file of a format that other programs read.
#pragma once

#include "mesh/triangle_soup.h"

#include <string>

namespace lsdcd {

// Throws InputError, which names the endings that are known, where the name has another.
void check_mesh_name(const std::string &path);

// By its ending, in any case. STL and PLY are binary, of floats where all corners are floats; else STL is text,
// and PLY of doubles. OBJ and OFF are text. Text tells every number to the last bit. Corners of
// equal coordinates are one vertex. The file appears whole or not at all; throws InputError that
// names it.
void write_mesh_file(const std::string &path, const TriangleSoup &soup);

}    // namespace lsdcd
