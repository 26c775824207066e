// Triangles as a file of a format that other programs read.
#pragma once

#include "mesh/triangle_soup.h"

#include <string>

namespace lsdcd {

enum class MeshFormat { stl, obj, ply, off };

// By the name's ending, in any case. Throws InputError that names those that are known.
MeshFormat mesh_format(const std::string &path);

// By its ending. STL and PLY are binary, of floats where all corners are floats; else STL is text,
// and PLY of doubles. OBJ and OFF are text. Text tells every number to the last bit. Corners of
// equal coordinates are one vertex. The file appears whole or not at all; throws InputError that
// names it.
void write_mesh_file(const std::string &path, const TriangleSoup &soup);

}    // namespace lsdcd
