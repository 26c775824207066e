// Where a mesh meets itself.
#pragma once

#include "mesh/wall_mesh.h"

#include <cstddef>
#include <functional>

namespace lsdcd {

struct SelfMeetings {
  std::size_t pairs = 0;      // of faces
  int first[2] = {-1, -1};    // the first of them, by their numbers
};

// Pairs of faces with more in common than the corners and edges that they share: they cut, overlap
// or touch each other. Exact, for the corners as they are. `progress` is told now and then which
// share is done.
SelfMeetings meets_itself(const WallMesh &mesh, const std::function<void(double)> &progress = {});

}    // namespace lsdcd
