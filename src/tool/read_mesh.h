// A mesh from a file of any format that is known.
#pragma once

#include "mesh/triangle_soup.h"

#include <cstddef>
#include <string>

namespace lsdcd {

struct ReadMesh {
  TriangleSoup soup;
  std::size_t left_out = 0;    // points and lines, which are no facets
};

// By the name's ending: STL; and by assimp, where it was there when this was built, OBJ, PLY and
// OFF, whose polygons are cut into triangles and whose coordinates assimp rounds to float. Throws
// InputError that names the file.
ReadMesh read_mesh(const std::string &path);

}    // namespace lsdcd
