// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances by other libraries, each where it is installed, beside which ours are timed.
#pragma once

#include "mesh/triangle_soup.h"
#include "query/sphere.h"

#include <functional>
#include <string>
#include <vector>

namespace lsdcd {

// Distances of the first n spheres' centres to a mesh, infinite where not within the radius.
using PeerQuery = std::function<void(const Sphere *spheres, std::size_t n, double *distance)>;

struct Peer {
  std::string name;
  std::function<PeerQuery(const TriangleSoup &mesh)> build;    // null: `package` is not installed
  const char *package;
  double most;    // spheres in a run: it would take long
};

Peer embree();
Peer cgal();

}    // namespace lsdcd
