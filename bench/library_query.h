// Distances through liblsdcd, as its users ask: arrays of the host, or of a GPU on a stream.
#pragma once

#include "bench.h"

#include "mesh/triangle_soup.h"
#include "query/sphere.h"
#include "support/device_memory.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace lsdcd {

class LibraryQuery {
 public:
  // A cell of 0 is chosen.
  LibraryQuery(const TriangleSoup &mesh, Real cell, Real cutoff, bool in_floats, bool cuda);

  // Distance and status of spheres that lie as x y z r. Without their radii, the cutoff is that of
  // all; a stream then waits for nothing, but has to write spheres of that radius.
  Timing time(const Sphere *spheres, std::size_t n, bool with_radii, int repeats);
  Timing time(const FloatSphere *spheres, std::size_t n, bool with_radii, int repeats);
  // Of the last run.
  std::vector<double> distances() const;
  double cell() const { return cell_; }
  double grid_bytes() const { return grid_bytes_; }

 private:
  template <class T>
  Timing time_of(const SphereOf<T> *spheres, std::size_t n, bool with_radii, int repeats, int type);

  std::shared_ptr<void> grid_, stream_;
  bool cuda_;
  double cell_ = 0, grid_bytes_ = 0;
  std::size_t n_ = 0;
  DeviceArray<char> spheres_, distance_;
  DeviceArray<std::uint8_t> status_;
  bool floats_ = false;
};

}    // namespace lsdcd
