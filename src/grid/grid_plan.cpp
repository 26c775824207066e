#include "grid/grid_plan.h"

#include "base/input_error.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace lsdcd {

namespace {

std::string number(Real value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.6g", value);
  return text;
}

// Bricks along an axis for which cell numbers still fit an int.
constexpr std::int32_t kMostBricks = 1 << 27;

// While it is built, every cell of a brick has two counters.
constexpr std::size_t kBrickBytes = sizeof(Brick) + kBrickCells * 2 * sizeof(std::uint32_t);

// The ball around one point of the wall, or the slab on both sides of one face.
Real least_volume(const WallMesh &mesh, Real reach)
{
  Real largest = 0;
  for (const auto &f : mesh.faces) {
    const Vec3 a = mesh.vertices[f[0]], b = mesh.vertices[f[1]], c = mesh.vertices[f[2]];
    largest = std::max(largest, Real(0.5) * norm(cross(b - a, c - a)));
  }
  return std::max(4 * reach * reach * reach, 2 * reach * largest);
}

GridPlan plan_with_length(const WallMesh &mesh, Real reach, Real length, Real least_volume)
{
  const Vec3 extent = mesh.report.hi - mesh.report.lo;
  const Real diagonal = norm(extent);
  GridPlan plan;
  plan.length = length;
  // A point at the rim of a cell may be rounded into its neighbour.
  plan.half_diagonal = Real(0.5) * std::sqrt(Real(3)) * length * (1 + Real(1e-6));
  plan.reach = reach;
  plan.least_volume = least_volume;
  // Covers the regions that flat edges leave out (four times their largest
  // angle, times reach) and the rounding of dot products over a whole face.
  plan.slack = 4e-13 * reach + 16 * kRoundoff * (diagonal + reach);
  const Real pad = reach + plan.slack + Real(0.5) * length;
  plan.origin = mesh.report.lo - Vec3{pad, pad, pad};
  for (int k = 0; k < 3; k++) {
    const Real n = std::ceil((extent[k] + 2 * pad) / (kBrickSide * length));
    plan.n_bricks[k] = static_cast<std::int32_t>(std::clamp(n, Real(1), Real(kMostBricks)));
  }
  return plan;
}

}    // namespace

bool GridPlan::may_fit(std::size_t budget) const
{
  // A plan cut off at the most bricks does not reach the wall's far end.
  for (std::int32_t n : n_bricks)
    if (n >= kMostBricks) return false;
  const double side = kBrickSide * length;
  if (least_volume / (side * side * side) * kBrickBytes > double(budget)) return false;
  // Counted in floating point: a hopeless length overflows the integer product.
  const double entries = double(n_bricks[0]) * n_bricks[1] * n_bricks[2];
  return entries * sizeof(std::int32_t) <= double(budget) &&
         entries < 5e8;    // octant keys have 32 bits
}

std::size_t grid_bytes(const GridPlan &plan, std::size_t bricks, std::size_t cells,
                       std::size_t candidates)
{
  return plan.table_size() * sizeof(std::int32_t) + bricks * sizeof(Brick) + cells * sizeof(Cell) +
         candidates * sizeof(Candidate);
}

bool bricks_fit(const GridPlan &plan, std::size_t bricks, std::size_t budget)
{
  return plan.table_size() * sizeof(std::int32_t) + bricks * kBrickBytes <= budget;
}

GridPlan plan_grid(const WallMesh &mesh, const GridSettings &settings)
{
  if (!(settings.reach > 0) || !std::isfinite(settings.reach))
    throw InputError("grid reach is " + number(settings.reach) +
                     "; it must be the largest particle radius, above 0");
  Real length = settings.length;
  // A third of an edge keeps lists at one or two entries; past the radius a
  // longer cell saves nothing, below a fifth of it memory grows without gain.
  if (length <= 0)
    length =
        std::clamp(Real(0.3) * mesh.report.median_edge, Real(0.2) * settings.reach, settings.reach);
  return plan_with_length(mesh, settings.reach, length, least_volume(mesh, settings.reach));
}

GridPlan coarser(const GridPlan &plan, const WallMesh &mesh, const GridSettings &settings)
{
  const Vec3 extent = mesh.report.hi - mesh.report.lo;
  if (plan.length > norm(extent) + 2 * settings.reach)
    throw InputError("no grid of this mesh fits a memory budget of " +
                     number(settings.memory_budget / 1048576.0) + " MB; raise the budget");
  return plan_with_length(mesh, settings.reach, plan.length * Real(1.25), plan.least_volume);
}

std::vector<std::uint64_t> bricks_that_meet(const GridPlan &plan, const std::vector<Box> &boxes)
{
  if (boxes.empty()) return {};
  std::vector<std::uint64_t> bits(plan.table_size() / 64 + 1, 0);
  const Real side = kBrickSide * plan.length;
  for (const Box &box : boxes) {
    std::int64_t first[3], last[3];
    for (int k = 0; k < 3; k++) {
      // A point on the rim of two bricks may be looked up in either.
      const Real rim = Real(1e-6) * side, most = plan.n_bricks[k] - 1;
      const auto place = [&](Real at) {
        return static_cast<std::int64_t>(
            std::clamp(std::floor((at - plan.origin[k]) / side), Real(0), most));
      };
      first[k] = place(box.lo[k] - rim);
      last[k] = place(box.hi[k] + rim);
    }
    for (std::int64_t z = first[2]; z <= last[2]; z++)
      for (std::int64_t y = first[1]; y <= last[1]; y++)
        for (std::int64_t x = first[0]; x <= last[0]; x++) {
          const std::size_t brick = (z * plan.n_bricks[1] + y) * plan.n_bricks[0] + x;
          bits[brick / 64] |= std::uint64_t(1) << brick % 64;
        }
  }
  return bits;
}

void throw_over_budget(const GridSettings &settings, Real asked, Real would_fit)
{
  throw InputError("grid " + number(asked) + " does not fit the memory budget of " +
                   number(settings.memory_budget / 1048576.0) + " MB; grid " + number(would_fit) +
                   " would fit, or raise the budget");
}

}    // namespace lsdcd
