// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "grid/plan/grid_plan.h"

#include "base/input_error.h"
#include "base/input_words.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd {

namespace {

// Bricks along an axis for which cell numbers still fit an int.
constexpr std::int32_t kMaxBricks = 1 << 27;

// While it is built, every cell of a brick has two counters.
constexpr std::size_t kBrickBytes = sizeof(Brick) + kBrickCells * 2 * sizeof(std::uint32_t);

// The area of a triangle within a box (Sutherland and Hodgman 1974).
Real area_within(const Vec3 &a, const Vec3 &b, const Vec3 &c, const Box &box)
{
  std::vector<Vec3> polygon = {a, b, c}, left;
  for (int side = 0; side < 6; side++) {
    const int d = side / 2;
    const auto depth = [&](const Vec3 &x) {
      return side % 2 ? box.hi[d] - x[d] : x[d] - box.lo[d];
    };
    left.clear();
    for (std::size_t i = 0; i < polygon.size(); i++) {
      const Vec3 &from = polygon[i], &to = polygon[(i + 1) % polygon.size()];
      const Real s = depth(from), t = depth(to);
      if (s >= 0) left.push_back(from);
      if ((s >= 0) != (t >= 0)) left.push_back(from + (s / (s - t)) * (to - from));
    }
    polygon.swap(left);
  }
  Vec3 sum = {0, 0, 0};
  for (std::size_t i = 2; i < polygon.size(); i++)
    sum += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return Real(0.5) * norm(sum);
}

// The ball around one point of the wall, or the slab on both sides of one face, as far as
// spheres can be there.
Real least_volume(const WeldedMesh &mesh, Real cutoff, const Box &within)
{
  Real largest = 0;
  for (const auto &f : mesh.faces) {
    const Vec3 a = mesh.vertices[f[0]], b = mesh.vertices[f[1]], c = mesh.vertices[f[2]];
    if (Real(0.5) * norm(cross(b - a, c - a)) > largest)
      largest = std::max(largest, area_within(a, b, c, within));
  }
  return std::max(4 * cutoff * cutoff * cutoff, 2 * cutoff * largest);
}

// The box of the mesh widened by the cutoff, cut to where spheres can be; never empty.
Box covered(const WeldedMesh &mesh, const Box &within, Real pad, Real rim)
{
  Box box;
  for (int k = 0; k < 3; k++) {
    box.lo[k] = std::max(mesh.report.lo[k] - pad, within.lo[k] - rim);
    box.hi[k] = std::max(box.lo[k], std::min(mesh.report.hi[k] + pad, within.hi[k] + rim));
  }
  return box;
}

// Divides the box in which spheres can touch the wall into bricks: formula (1) of the paper, which divides all of space into
// cells.
GridPlan plan_with_length(const WeldedMesh &mesh, const GridSettings &settings, Real length,
                          Real least_volume)
{
  const Real cutoff = settings.cutoff, diagonal = norm(mesh.report.hi - mesh.report.lo);
  GridPlan plan;
  plan.length = length;
  // A point at the rim of a cell may be rounded into its neighbour.
  plan.half_diagonal = Real(0.5) * std::sqrt(Real(3)) * length * (1 + Real(1e-6));
  plan.cutoff = cutoff;
  plan.least_volume = least_volume;
  plan.tolerance = list_tolerance(cutoff, diagonal);
  plan.margin = cell_margin(cutoff);
  // Half a cell, or a little more than the margin; covers rounding.
  const Real pad =
      cutoff + plan.tolerance + std::max(Real(0.5) * length, plan.margin + Real(0.01) * length);
  const Box box = covered(mesh, settings.within, pad, length);
  plan.origin = box.lo;
  for (int k = 0; k < 3; k++) {
    const Real n = std::ceil((box.hi[k] - box.lo[k]) / (kBrickSide * length));
    plan.n_bricks[k] = static_cast<std::int32_t>(std::clamp(n, Real(1), Real(kMaxBricks)));
  }
  return plan;
}

}    // namespace

double GridPlan::least_bytes() const
{
  // In floating point, as a much too small length overflows the integer product.
  const double entries = double(n_bricks[0]) * n_bricks[1] * n_bricks[2];
  // A plan cut off at the most bricks does not reach the wall's far end.
  for (std::int32_t n : n_bricks)
    if (n >= kMaxBricks || entries >= kMostBricks) return HUGE_VAL;
  const double side = kBrickSide * length;
  return std::max(least_volume / (side * side * side) * kBrickBytes,
                  entries * sizeof(std::int32_t));
}

std::size_t grid_bytes(const GridPlan &plan, std::size_t bricks, std::size_t cells,
                       std::size_t entries)
{
  return plan.table_size() * sizeof(std::int32_t) + bricks * sizeof(Brick) + cells * sizeof(Cell) +
         entries * sizeof(CellEntry);
}

std::size_t brick_bytes(const GridPlan &plan, std::size_t bricks)
{
  return plan.table_size() * sizeof(std::int32_t) + bricks * kBrickBytes;
}

Real default_length(const WeldedMesh &mesh, const AnyGridSettings &settings)
{
  const Real cutoff = settings.cutoff;
  const ListKind list_kind = settings.list_kind();
  // Each point reads a list. Two edges keep it at a few features; below a tenth of the cutoff memory grows
  // and little is gained.
  if (list_kind.is_complete() && settings.purpose == GridPurpose::queries)
    return std::clamp(2 * mesh.report.median_edge, Real(0.1) * cutoff, cutoff);
  // Complete lists are read when a sphere's list of the wall is gathered, not in every step. With
  // cells of the radius that takes no longer than with smaller ones, and the lists take less
  // memory than the mesh's records. Larger cells name too many spheres that touch nothing.
  if (list_kind.is_complete() && !settings.for_gpu) return cutoff;
  // On a GPU a sphere waits for each entry of its cell in turn. Half of that length, and less where
  // triangles are small, makes choices 1.4 to 3 times as fast; below that memory grows and little is gained.
  if (list_kind.is_complete())
    return std::clamp(2 * mesh.report.median_edge, Real(0.25) * cutoff, Real(0.5) * cutoff);
  // Nearest lists are searched in every step. A third of an edge keeps them at one or two entries;
  // past the radius a longer cell saves nothing, below a fifth of it memory grows without gain.
  return std::clamp(Real(0.3) * mesh.report.median_edge, Real(0.2) * cutoff, cutoff);
}

GridPlan plan_grid(const WeldedMesh &mesh, const AnyGridSettings &settings)
{
  if (!(settings.cutoff > 0) || !std::isfinite(settings.cutoff))
    throw InputError("grid cutoff is " + number_text(settings.cutoff) +
                     "; it must be the largest radius of a grain, above 0");
  // A billionth of the mesh: smaller cells cannot be numbered, and the smallest numbers do not grow.
  const Real least = Real(0x1p-30) * norm(mesh.report.hi - mesh.report.lo);
  const Real length =
      settings.length > 0 ? settings.length : std::max(default_length(mesh, settings), least);
  return plan_with_length(mesh, settings, length,
                          least_volume(mesh, settings.cutoff, settings.within));
}

bool is_coarsest(const GridPlan &plan, const WeldedMesh &mesh)
{
  return plan.length > norm(mesh.report.hi - mesh.report.lo) + 2 * plan.cutoff;
}

GridPlan coarser(const GridPlan &plan, const WeldedMesh &mesh, const GridSettings &settings)
{
  // Passes the cutoff, with which a CPU begins, so that a grid on a GPU is never coarser.
  const Real next = plan.length * kCoarser;
  const bool past = plan.length < plan.cutoff && next > plan.cutoff;
  return plan_with_length(mesh, settings, past ? plan.cutoff : next, plan.least_volume);
}

void throw_over_budget(const GridSettings &settings, double needed, double budget)
{
  // Rounded up to four digits, so that the number in the message is enough.
  const auto rounded_up = [](double x) {
    const double digit = std::pow(10, std::floor(std::log10(x)) - 3);
    return std::ceil(x / digit) * digit;
  };
  constexpr double kMebi = 1048576;
  const bool given = settings.length > 0 && !settings.may_coarsen;
  const std::string name = settings.length_name;
  std::string text =
      given ? name + " " + number_text(settings.length) : "the coarsest grid of this mesh";
  if (std::isfinite(needed))
    text += " takes " + number_text(rounded_up(needed / kMebi)) + " MB" +
            (given ? " at least" : "") +
            ", the mesh's own records among them, and the memory budget is " +
            number_text(budget / kMebi) + " MB: give that" + (given ? ", or " : "");
  else
    text += " has more cells than can be numbered: " +
            std::string(given ? "" : "give a smaller cutoff, or a mesh of fewer triangles");
  throw InputError(text +
                   (given ? "leave " + name + " out, which takes the finest that fits" : ""));
}

void throw_over_limit(const GridSettings &settings, double times)
{
  const std::string &name = settings.length_name;
  throw InputError(name + " " + number_text(settings.length) +
                   " is too fine for this mesh: its build takes " + number_text(std::ceil(times)) +
                   " times the limit of 1 s and 20 us a triangle, or 128 MB and 2 kB a triangle; "
                   "leave " +
                   name +
                   " out to have one chosen within it, or give a memory budget, which lifts it");
}

}    // namespace lsdcd
