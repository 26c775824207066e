// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A mesh from a file of any format that is known.
#pragma once

#include "mesh/triangle_soup.h"

#include <cstddef>
#include <string>
#include <vector>

namespace lsdcd {

struct ReadMesh {
  TriangleSoup soup;
  std::size_t left_out = 0;      // points and lines, which are no facets
  std::vector<Vec3> vertices;    // of a file that numbers them, all formats but STL, in its order
};

// By the name's ending, as the table in read_mesh.cpp says; a file with another name is read as STL.
// Coordinates are those of the file in doubles. Polygons are cut into triangles that are exactly
// them (cut_polygon.h). Throws InputError naming the file, the line or facet, the value and the remedy.
ReadMesh read_mesh(const std::string &path);

// OBJ and OFF from buffers already in memory; `source` is used in messages.
ReadMesh read_obj_bytes(const char *bytes, std::size_t size, const std::string &source);
ReadMesh read_off_bytes(const char *bytes, std::size_t size, const std::string &source);
// PLY from a buffer already in memory; `source` is used in messages. Polygons are cut into triangles,
// triangle strips too; other elements are passed over, and edges counted as left out. Counts of the header
// have to hold. In text each element has a line of its own. Throws InputError naming the file, the line or
// byte, the element, the value and the remedy.
ReadMesh read_ply_bytes(const char *bytes, std::size_t size, const std::string &source);

// Returns the name's end from its last dot on, in lower case.
std::string name_ending(const std::string &path);

}    // namespace lsdcd
