#include "engine/choose/select_near.h"

#include "parallel/backend_cpu.h"
#include "engine/results/sphere_error.h"
#include "grid/lookup/brick_words.h"
#include "model/normal.h"

#include <algorithm>
#include <cstdio>

namespace lsdcd {

void throw_too_large(int i, Real radius, Real reach)
{
  char text[160];
  std::snprintf(text, sizeof text,
                "has radius %.9g, more than the grid's reach %.9g; set rmax to the largest radius "
                "that will occur",
                radius, reach);
  throw SphereError(i, text);
}

namespace {

// For CpuBackend::select: a CPU reads what it turns out to need.
struct NearNow {
  const GridView &grid;
  const Spheres &spheres;
  Real pull_off;
  Real fits;    // radii up to this do for certain
  int &too_large;
  BrickTable table = {};    // it asks the grid

  Rows<const Real> places() const { return spheres.x; }
  int read(std::size_t i) const { return !spheres.mask || (spheres.mask[i] & spheres.group_bit); }
  void check(std::size_t i, int in_group) const
  {
    if (!in_group || spheres.radius[i] <= fits ||
        reach_of(spheres.radius[i], pull_off) <= grid.reach)
      return;
    const int at = static_cast<int>(i);
#pragma omp critical
    too_large = too_large < 0 ? at : std::min(too_large, at);
  }
  bool may_keep(int in_group, const Vec3 &x, const BrickTable &) const
  {
    return in_group && near_wall(grid, x);
  }
  bool keep(const Vec3 &, const BrickTable &) const
  {
    return true;
  }
  bool notes() const
  {
    return false;
  }
  void note(std::size_t, bool) const {}
};

}    // namespace

void select_near(const GridView &grid, const Spheres &spheres, Real pull_off,
                 std::vector<int> &near, std::vector<int> &scratch)
{
  if (static_cast<int>(scratch.size()) < spheres.n) scratch.resize(spheres.n);
  int too_large = -1;
  std::uint32_t n = 0;
  CpuBackend::SelectRoom room;
  CpuBackend().select(
      spheres.n, NearNow{grid, spheres, pull_off, pull_off > 0 ? 0 : grid.reach, too_large, {}},
      room, scratch.data(), &n);
  if (too_large >= 0) throw_too_large(too_large, spheres.radius[too_large], grid.reach);
  near.assign(scratch.begin(), scratch.begin() + n);
}

}    // namespace lsdcd
