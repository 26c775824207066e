#include "engine/select_near.h"

#include "base/threads.h"
#include "base/input_error.h"
#include "model/normal.h"

#include <algorithm>
#include <cstdio>

namespace lsdcd {

namespace {

[[noreturn]] void throw_too_large(const Spheres &spheres, int i, Real reach)
{
  char text[160];
  std::snprintf(text, sizeof text,
                "sphere %d has radius %.9g, more than the grid's reach %.9g; set rmax to the "
                "largest radius that will occur",
                i, spheres.radius[i], reach);
  throw InputError(text);
}

}    // namespace

void select_near(const GridView &grid, const Spheres &spheres, Real pull_off,
                 std::vector<int> &near, std::vector<int> &scratch)
{
  // Blocks of one size whatever the number of threads, so that order is fixed.
  constexpr int kBlock = 4096;
  const int n_blocks = (spheres.n + kBlock - 1) / kBlock;
  if (static_cast<int>(scratch.size()) < spheres.n) scratch.resize(spheres.n);
  std::vector<int> found(n_blocks, 0);
  const Real fits = pull_off > 0 ? 0 : grid.reach;    // radii up to this do for certain
  int too_large = -1;
#pragma omp parallel for schedule(static) num_threads(threads()) if (n_blocks > 1)
  for (int b = 0; b < n_blocks; b++) {
    const int lo = b * kBlock, hi = std::min(lo + kBlock, spheres.n);
    int n = 0;
    for (int i = lo; i < hi; i++) {
      if (spheres.mask && !(spheres.mask[i] & spheres.group_bit)) continue;
      if (!(spheres.radius[i] <= fits) && !(reach_of(spheres.radius[i], pull_off) <= grid.reach)) {
#pragma omp critical
        too_large = too_large < 0 ? i : std::min(too_large, i);
      }
      if (near_wall(grid, {spheres.x[3 * i], spheres.x[3 * i + 1], spheres.x[3 * i + 2]}))
        scratch[lo + n++] = i;
    }
    found[b] = n;
  }
  if (too_large >= 0) throw_too_large(spheres, too_large, grid.reach);
  near.clear();
  for (int b = 0; b < n_blocks; b++)
    near.insert(near.end(), scratch.begin() + b * kBlock, scratch.begin() + b * kBlock + found[b]);
}

}    // namespace lsdcd
