// Grids of one cell length and every kind of list, from one build.
#pragma once

#include "engine/wall_engine.h"
#include "grid/flat_grid.h"

#include <string>
#include <vector>

namespace lsdcd {

// What the keywords `grid`, `nearest` and `precision` say.
struct GridChoice {
  Real length;    // of a cell
  int nearest;    // 0: complete lists
  bool exact;     // nearest lists fall back to complete ones
  Precision precision;

  // No contact is missed but by rounding.
  bool complete() const { return nearest == 0 || exact; }
};

// "nearest all", "nearest 2 exact"; "double", "mixed" or "single".
std::string lists_name(const GridChoice &choice);
const char *precision_name(Precision precision);

// The lists that are tried for each cell length, the complete ones first.
struct ListKind {
  int nearest;
  bool exact;
};
const std::vector<ListKind> &list_kinds();
constexpr int kLongestTried = 8;

class TrialGrid {
 public:
  // Builds with `settings`; its `nearest` is the longest list that can be made where it is
  // above kLongestTried, its other lists and its precision are left aside.
  TrialGrid(const WallMesh &mesh, GridSettings settings, bool on_cuda);

  // What build_grid would make of the choice, but for its report; its length is the one
  // built. Borrowed until the next call.
  const TriangleGrid &make(int nearest, bool exact, bool in_floats);

  const TriangleGrid &made() const { return made_; }    // by the last call

  // The same as a flat block: what a CUDA engine takes.
  GridView flat();

  // Without its wall: the longest lists of nearest primitives and, in `complete`, the complete ones.
  const TriangleGrid &base() const { return base_; }

 private:
  TriangleGrid base_, made_;        // made_ has the wall
  std::vector<FaceParts> parts_;    // of its faces, while no nearest lists want them
  FlatGrid flat_;
};

}    // namespace lsdcd
