// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "study/sphere_sample.h"

#include "contact/find_contacts.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace lsdcd {

namespace {

bool is_deep(const GridView &grid, const Vec3 &x, Real radius)
{
  ContactSet<1> set;
  find_contacts(grid, x, Real(0.5) * radius, set);
  return set.n > 0;
}

}    // namespace

void add_band_spheres(const TriangleGrid &grid, int n, const std::vector<Real> &radii,
                      Random &random, SphereSample &sample)
{
  const CellLists &lists = grid.lists;
  if (lists.bricks.empty() || radii.empty()) return;
  std::vector<std::size_t> place(lists.bricks.size());
  for (std::size_t i = 0; i < lists.brick_of.size(); i++)
    if (lists.brick_of[i] >= 0) place[lists.brick_of[i]] = i;

  // A random cell of a random brick. It is uniform over the occupied cells, as others are drawn
  // again.
  const GridView view = grid.view();
  constexpr std::int64_t kTries = 1000;
  const int wanted = sample.n() + n;
  for (std::int64_t left = kTries * n; left > 0 && sample.n() < wanted; left--) {
    const std::size_t b = random() % lists.bricks.size();
    const int cell = static_cast<int>(random() % kBrickCells);
    if (!has_entries(lists.bricks[b], cell)) continue;
    const int at[3] = {cell & 7, cell >> 3 & 7, cell >> 6};
    Vec3 x = brick_centre(grid, place[b]);
    for (int k = 0; k < 3; k++)
      x[k] += grid.length * (at[k] - Real(0.5) * kBrickSide + uniform_below_one(random));
    const Real radius = radii[random() % radii.size()];
    if (!is_deep(view, x, radius)) sample.add(x, radius);
  }
}

void sort_by_bins(SphereSample &sample, Real bin)
{
  std::vector<std::array<Real, 3>> key(sample.n());
  for (int i = 0; i < sample.n(); i++)
    for (int k = 0; k < 3; k++) key[i][k] = std::floor(sample.x[i][2 - k] / bin);
  std::vector<int> order(sample.n());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return key[a] < key[b]; });
  SphereSample sorted;
  for (int i : order) sorted.add(sample.x[i], sample.radius[i]);
  sample = std::move(sorted);
}

}    // namespace lsdcd
