// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Distance and status of many spheres against a wall, on the CPU or a GPU, by the library's query of points; and what
// only the study asks: the paper's formula (5), every face, and how many entries of lists a search reads.
#pragma once

#include "engine/engine.h"
#include "grid/triangle_grid.h"
#include "query/nearest_distance.h"
#include "query/sphere.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

struct WeldedMesh;

// The test that says that a point lies over a triangle.
enum class InsideTest {
  exact,
  formula_five    // the paper's
};

struct QuerySettings {
  InsideTest inside = InsideTest::exact;
  // Tries every face for every sphere, whatever the grid holds: the paper's N = all.
  bool every_face = false;
  bool distance = true;    // beside the status; without it a query is faster

  // Is this a question that the library answers?
  bool is_for_library() const { return inside == InsideTest::exact && !every_face; }
};

// Milliseconds of the query alone, without copies.
struct QueryTiming {
  double median_ms = 0, min_ms = 0, max_ms = 0;
  int repeats = 0;
};

// Grid, spheres and answers stay on their device between calls.
class SphereQuery {
 public:
  virtual ~SphereQuery() = default;

  // Copies the grid, which is that of `mesh`.
  virtual void set_grid(const QueryGrid &grid, const WeldedMesh &mesh) = 0;
  // Copies n spheres to the device.
  virtual void set_spheres(const Sphere *spheres, std::size_t n) = 0;

  // Throws InputError where a radius is more than the grid's cutoff, unless every face is
  // tried; and where the settings do not fit the grid: the paper's test needs lists of primitives
  // in double, or every face.
  virtual void run(const QuerySettings &settings) = 0;
  // Does run() once to warm up, and then `repeats` times, which are timed.
  virtual QueryTiming time(const QuerySettings &settings, int repeats) = 0;

  // Answers of the last run, copied to the CPU: kFound and kCertified; distances to the
  // wall, infinite beyond the radius.
  virtual std::vector<std::uint8_t> status() = 0;
  virtual std::vector<Real> distance() = 0;
  // Returns how many entries of lists such a run reads for each sphere.
  virtual std::vector<std::uint32_t> entries(const QuerySettings &settings) = 0;

  virtual std::string device() const = 0;
};

// Device::automatic takes a GPU where there is one. Throws InputError where the device
// is not there.
std::unique_ptr<SphereQuery> make_sphere_query(Device device);

}    // namespace lsdcd
