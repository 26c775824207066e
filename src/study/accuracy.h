// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The paper's experiment: how often a list of N triangles gives the status of a sphere
// that the cylinder's formula gives, and that the complete wall gives; and how fast.
#pragma once

#include "mesh/welded_mesh.h"
#include "study/cylinder.h"
#include "study/sphere_query.h"
#include "study/spheres.h"

#include <memory>
#include <string>
#include <vector>

namespace lsdcd {

struct StudySettings {
  Device device = Device::automatic;
  InsideTest inside = InsideTest::exact;
  Order order = Order::random;
  std::uint64_t seed = 1;
  int repeats = 5;    // repeats of a timed query; 1 if every face is tried
  std::size_t memory_budget = std::size_t(16) << 30;    // of the grid, bytes
};

// The lists that a measurement reads.
struct StudyLists {
  int nearest = 0;            // N triangles; 0: complete lists
  bool every_face = false;    // no lists: the paper's N = all
  Real length = 0;            // cell edge
};

struct StudyRow {
  std::string device;
  std::size_t triangles = 0, spheres = 0;
  InsideTest inside = InsideTest::exact;
  StudyLists lists;
  // Formula (6) of the paper: the share of spheres with the status that the formula (3) of the
  // cylinder, or without one the wall itself, gives. `best`: of exact distances to the
  // wall; `never`: of the answer that no sphere touches.
  Real accuracy = 0, best = 0, never = 0;
  // Against exact distances to the wall.
  std::size_t touching = 0;          // spheres that do
  std::size_t missed = 0;            // touch and are not found
  std::size_t false_ones = 0;        // are found and do not touch
  Real largest_overlap_error = 0;    // over the largest radius
  // Errors of the overlap, thus of a Hooke force, over the overlap itself; of touching spheres.
  Real median_force_error = 0, mean_force_error = 0;
  Real certified = 0;    // share of answers
  Real entries = 0;      // of lists, per sphere that reads any
  double build_s = 0;    // the grid
  std::size_t bytes = 0;
  QueryTiming query;
  double upload_ms = 0, download_ms = 0;    // spheres to the device, status back

  // Formula (7) of the paper, per cent.
  Real error() const { return 100 * (best - accuracy) / best; }
};

class AccuracyStudy {
 public:
  // The cylinder of `shape`, with spheres in a cube of side `cube` around its middle.
  AccuracyStudy(const CylinderMesh &shape, Real cube, Real largest, const StudySettings &settings);
  // Any wall, with spheres in its box widened by their largest radius.
  AccuracyStudy(const TriangleSoup &soup, Real largest, const StudySettings &settings);

  void set_spheres(std::size_t n);
  StudyRow measure(const StudyLists &lists);

  const std::vector<Sphere> &spheres() const { return spheres_; }
  const WeldedMesh &mesh() const { return mesh_; }
  // Returns the status that (6) compares with, by sphere.
  const std::vector<std::uint8_t> &truth() const { return truth_; }
  // Returns the grid of the last measurement.
  const QueryGrid &grid() const { return grid_; }
  Real agreement(const std::vector<std::uint8_t> &touching) const;

 private:
  void set_grid(const StudyLists &lists);
  void compare(StudyRow &row, const std::vector<std::uint8_t> &status,
               const std::vector<Real> &distance) const;

  StudySettings settings_;
  bool is_cylinder_;
  CylinderMesh shape_;
  WeldedMesh mesh_;
  SphereBox box_;
  std::unique_ptr<SphereQuery> query_;
  std::vector<Sphere> spheres_;
  double upload_ms_ = 0;
  std::vector<std::uint8_t> truth_;
  std::vector<Real> exact_;    // distances from complete lists
  Real best_ = 0, never_ = 0;
  QueryGrid grid_;
  StudyLists of_grid_;
  bool has_grid_ = false;
};

}    // namespace lsdcd
