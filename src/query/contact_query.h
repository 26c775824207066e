// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds all contacts of spheres with a wall, with the weights of the corner rule, on the CPU.
#pragma once

#include "base/strided_view.h"
#include "grid/triangle_grid.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Spheres in arrays of the caller. T: float or double.
template <class T>
struct SphereView {
  std::size_t from = 0, n = 0;    // the first one in the arrays, and how many
  StridedView<const T> centres;
  Column<const T> radii;    // null: all spheres have `radius`
  Real radius = 0;
};

struct SphereContact {
  FeatureCode feature;
  Vec3 point, normal;        // on the wall; unit, from there to the centre
  Real distance, overlap;    // overlap = radius - distance > 0
  Real weight;               // share of the force, 0 to 1
};

// The contacts of sphere `from` + i are found[first[i]] to found[first[i + 1] - 1], in the order of their
// features.
struct SphereContacts {
  std::vector<std::size_t> first;
  std::vector<SphereContact> found;
};

// Finds the contacts with threads() threads. The lists must be complete. Throws InputError if a radius in
// `radii` exceeds the cutoff, or if a sphere has more contacts than the corner rule can take.
template <class T>
SphereContacts find_all_contacts(const GridView &grid, const SphereView<T> &spheres);

}    // namespace lsdcd
