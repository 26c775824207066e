#include "tune/trial_grid.h"

#include "grid/build/shorten_lists.h"
#include "grid/plan/grid_plan.h"

#include <algorithm>
#include <utility>

namespace lsdcd {

std::string lists_name(const GridChoice &choice)
{
  if (choice.nearest == 0) return "all";
  return std::to_string(choice.nearest) + (choice.exact ? " exact" : "");
}

const char *precision_name(Precision precision)
{
  const char *const names[] = {"double", "mixed", "single"};
  return names[static_cast<int>(precision)];
}

const std::vector<ListKind> &list_kinds()
{
  static const std::vector<ListKind> kinds = {{0, false}, {1, false}, {2, false}, {3, false},
                                              {4, false}, {8, false}, {2, true},  {4, true}};
  return kinds;
}

TrialGrid::TrialGrid(const WallMesh &mesh, GridSettings settings, bool on_cuda)
{
  settings.nearest = std::max(settings.nearest, kLongestTried);
  settings.exact = true;
  settings.in_floats = false;
  base_ = build_grid(mesh, settings, on_cuda);
  parts_ = std::move(base_.wall.face_parts);
  made_.wall = std::move(base_.wall);
}

const TriangleGrid &TrialGrid::make(int nearest, bool exact, bool in_floats)
{
  WallFeatures wall = std::move(made_.wall);
  if (!wall.face_parts.empty()) parts_ = std::move(wall.face_parts);
  wall.face_parts.clear();
  if (nearest > 0) wall.face_parts = std::move(parts_);
  made_ = TriangleGrid();
  made_.wall = std::move(wall);
  made_.origin = base_.origin;
  made_.length = base_.length;
  made_.cutoff = base_.cutoff;
  made_.tolerance = base_.tolerance;
  made_.margin = nearest > 0 ? 0 : cell_margin(base_.cutoff);
  made_.outside = base_.outside;
  for (int k = 0; k < 3; k++) made_.n_bricks[k] = base_.n_bricks[k];
  made_.nearest = nearest;
  made_.lists = nearest > 0 ? shorten(base_.lists, nearest) : base_.complete;
  if (exact) made_.complete = base_.complete;
  if (in_floats) add_brick_records(made_);
  return made_;
}

GridView TrialGrid::flat()
{
  flat_ = FlatGrid(made_);
  return flat_.view();
}

}    // namespace lsdcd
