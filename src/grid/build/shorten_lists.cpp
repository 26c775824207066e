#include "grid/build/shorten_lists.h"

#include <algorithm>

namespace lsdcd {

CellLists shorten(const CellLists &lists, int nearest)
{
  const std::uint32_t most = nearest + 1;
  CellLists out;
  out.brick_of = lists.brick_of;
  out.bricks = lists.bricks;
  out.cells = lists.cells;
  for (Cell &cell : out.cells) {
    if (cell.count == 1) continue;    // holds its one primitive itself
    const auto begin = lists.candidates.begin() + cell.first;
    cell.count = std::min(cell.count, most);
    cell.first = static_cast<std::uint32_t>(out.candidates.size());
    out.candidates.insert(out.candidates.end(), begin, begin + cell.count);
  }
  return out;
}

}    // namespace lsdcd
