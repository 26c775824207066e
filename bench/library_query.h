// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances through liblsdcd, as its users ask: arrays of the host.
#pragma once

#include "bench.h"

#include "lsdcd.h"
#include "mesh/triangle_soup.h"
#include "query/sphere.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace lsdcd {

class LibraryQuery {
 public:
  LibraryQuery(const TriangleSoup &mesh, Real cutoff, bool in_floats);

  // Distance and status of points that lie as x y z r; the cutoff is the radius of all.
  Timing time(const Sphere *spheres, std::size_t n);
  Timing time(const FloatSphere *spheres, std::size_t n);
  const std::vector<double> &distances() const { return distance_; }    // of the last run
  double cell() const { return cell_; }
  double grid_bytes() const { return grid_bytes_; }

 private:
  template <class T>
  Timing time_of(const SphereOf<T> *spheres, std::size_t n, int type);

  std::shared_ptr<lsdcd_grid> grid_;
  double cell_ = 0, grid_bytes_ = 0;
  std::vector<std::uint8_t> status_;
  std::vector<double> distance_;
};

}    // namespace lsdcd
