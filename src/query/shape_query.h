// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Finds contacts and signed distances of ellipsoids and superellipsoids at a mesh, on the CPU. Contacts are the local minima
// over the surface of the signed distance from the grain; they do not depend on how the surface is cut into triangles.
#pragma once

#include "contact/shape_search.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// Grains in packed arrays of the caller.
struct ShapesGiven {
  std::size_t from = 0, n = 0;    // the first one in the arrays, and how many
  const Real *centres;            // 3 each
  const Real *quaternions;        // w i j k each, of any length above 0; null: not turned
  const Real *half_axes;          // 3 each
  const Real *exponents;          // n1 and n2 each; null: 2
  bool all_alike;                 // all grains have the first half_axes and exponents
};

// The contacts of grain `from` + i are found[first[i]] to found[first[i + 1] - 1], in the order of their features.
struct FoundGrainContacts {
  std::vector<std::size_t> first;
  std::vector<FoundGrainContact> found;
};

// Both functions use threads() threads, and throw InputError for a grain whose numbers make no shape.
FoundGrainContacts find_shape_contacts(const TriangleTree &tree, const ShapesGiven &grains);
// Writes the nearest place of the mesh for each grain. A grain whose centre is not a number is infinitely far from
// everything.
void find_shape_distances(const TriangleTree &tree, const ShapesGiven &grains,
                          FoundGrainContact *nearest);

}    // namespace lsdcd
