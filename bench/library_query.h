// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distances through liblsdcd, as its users ask: arrays of the host, or of a GPU on a stream.
#pragma once

#include "bench.h"

#include "lsdcd.h"
#include "mesh/triangle_soup.h"
#include "query/sphere.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace lsdcd {

// The grid of a query. A cutoff of 0 is any distance; a cell of 0 is chosen; nearest 0: complete lists.
struct LibraryGrid {
  Real cutoff, cell = 0;
  int nearest = 0;
  bool in_floats = false, on_cuda = false;
};

class LibraryQuery {
 public:
  LibraryQuery(const TriangleSoup &mesh, const LibraryGrid &grid);

  // Distance and status of points that lie as x y z r; the cutoff is the radius of all. One run after one to warm up.
  Timing time(const Sphere *spheres, std::size_t n);
  Timing time(const FloatSphere *spheres, std::size_t n);
  // Status of spheres, each of its own radius, and their distance where it is wanted.
  Timing time_spheres(const Sphere *spheres, std::size_t n, bool distance, int repeats);
  Timing time_spheres(const FloatSphere *spheres, std::size_t n, bool distance, int repeats);
  // The distances of the last run.
  const std::vector<double> &distances() const { return distance_; }
  const std::vector<std::uint8_t> &status() const { return status_; }
  double cell() const { return cell_; }
  double grid_bytes() const;

 private:
  template <class T>
  Timing time_of(const SphereOf<T> *spheres, std::size_t n, bool radii, bool distance, int repeats);

  std::shared_ptr<lsdcd_grid> grid_;
  bool on_cuda_;
  double cell_ = 0;
  std::vector<std::uint8_t> status_;
  std::vector<double> distance_;
};

}    // namespace lsdcd
