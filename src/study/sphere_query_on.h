// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The study's query on one backend: one source for all.
#pragma once

#include "base/input_error.h"
#include "grid/flat_grid.h"
#include "grid/lookup/grid_on.h"
#include "mesh/welded_mesh.h"
#include "query/point_query.h"
#include "study/counted_search.h"
#include "study/sphere_query.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <type_traits>

namespace lsdcd {

template <class B>
class SphereQueryOn : public SphereQuery {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  explicit SphereQueryOn(B backend) : b_(std::move(backend)) {}

  void set_grid(const QueryGrid &grid, const WeldedMesh &mesh) override
  {
    n_faces_ = static_cast<std::uint32_t>(grid.wall.faces.size());
    flat_ = FlatOf<QueryGrid>(grid);
    own_.reset();
    names_.emplace(mesh);
    if constexpr (B::kOnCpu)
      library_.emplace(flat_.view());
    else
      library_ = copy_to_cuda(flat_.view(), *names_)->query_on(nullptr);
  }

  void set_spheres(const Sphere *spheres, std::size_t n) override
  {
    n_ = n;
    if (spheres_.size() < n) spheres_ = Array<Sphere>(n);
    b_.copy_in(spheres, spheres_.data(), n);
    b_.wait();
  }

  void run(const QuerySettings &settings) override
  {
    prepare(settings);
    start(settings);
    b_.wait();
  }

  QueryTiming time(const QuerySettings &settings, int repeats) override
  {
    run(settings);
    std::vector<double> ms(std::max(repeats, 1));
    for (double &t : ms) t = b_.milliseconds([&] { start(settings); });
    std::sort(ms.begin(), ms.end());
    return {ms[ms.size() / 2], ms.front(), ms.back(), static_cast<int>(ms.size())};
  }

  std::vector<std::uint8_t> status() override { return to_cpu(b_, status_, n_); }
  std::vector<Real> distance() override
  {
    return to_cpu(b_, distance_, distance_.size() >= n_ ? n_ : 0);
  }
  std::vector<std::uint32_t> entries(const QuerySettings &settings) override
  {
    check(settings);
    Array<std::uint32_t> read(n_);
    start_own(settings, nullptr, nullptr, read.data());
    return to_cpu(b_, read, n_);
  }
  std::string device() const override { return b_.name(); }

  // The steps of run(). Public because nvcc takes no device lambda from a private function.

  void start(const QuerySettings &settings)
  {
    if (n_ == 0) return;
    Real *distance = settings.distance ? distance_.data() : nullptr;
    if (settings.is_for_library())
      ask_library(distance);
    else
      start_own(settings, status_.data(), distance, nullptr);
  }

  // Writes to those arrays that are not null.
  void start_own(const QuerySettings &settings, std::uint8_t *status, Real *distance,
                 std::uint32_t *entries)
  {
    if (!own_) own_.emplace(b_, flat_.view());
    if (settings.inside == InsideTest::formula_five)
      search_all<FormulaFiveDistances>(settings, status, distance, entries);
    else if (own_->view.in_floats)
      search_all<BrickDistances>(settings, status, distance, entries);
    else
      search_all<MeshDistances>(settings, status, distance, entries);
  }

  template <class Distances>
  void search_all(const QuerySettings &settings, std::uint8_t *status, Real *distance,
                  std::uint32_t *entries)
  {
    const GridView grid = own_->view;
    const Sphere *spheres = spheres_.data();
    const std::uint32_t n_faces = n_faces_;
    const bool every_face = settings.every_face;
    b_.for_each(n_, [=] LSDCD_LAMBDA(std::size_t i) {
      const Vec3 q = spheres[i].centre();
      const Real radius = spheres[i].r;
      const CountedAnswer a = every_face ? search_every_face<Distances>(grid, n_faces, q, radius)
                              : grid.list_kind.is_complete()
                                  ? search_counted<true, Distances>(grid, q, radius)
                                  : search_counted<false, Distances>(grid, q, radius);
      if (status) status[i] = a.status();
      if (distance) distance[i] = a.distance < kAnyDistance ? a.distance : HUGE_VAL;
      if (entries) entries[i] = a.entries;
    });
  }

 private:
  void check(const QuerySettings &settings) const
  {
    const bool paper = settings.inside == InsideTest::formula_five;
    const GridView grid = flat_.view();
    if (paper && !settings.every_face && (grid.list_kind.is_complete() || grid.in_floats))
      throw InputError("the paper's inside test needs lists of triangles in double: give a "
                       "grid of `nearest N`, or try every face");
    if (settings.every_face && grid.in_floats)
      throw InputError("every face can be tried in double only; give a grid without records "
                       "in float");
  }

  void prepare(const QuerySettings &settings)
  {
    check(settings);
    if (status_.size() < n_) status_ = Array<std::uint8_t>(n_);
    if (!settings.distance)
      distance_ = Array<Real>();
    else if (distance_.size() < n_)
      distance_ = Array<Real>(n_);
  }

  void ask_library(Real *distance)
  {
    PointArrays<Real> io;
    io.n = n_;
    io.points = {&spheres_.data()->x, 4, 1};
    io.radii = {&spheres_.data()->r, 4};
    io.status = status_.data();
    io.distance = {distance, 1};
    if constexpr (B::kOnCpu)
      query_grid(*library_, *names_, io);
    else
      library_->enqueue(io);
  }

  B b_;
  FlatOf<QueryGrid> flat_;    // on the CPU
  std::optional<TriangleTable> names_;
  std::conditional_t<B::kOnCpu, std::optional<CpuGrid>, std::unique_ptr<StreamQuery>> library_;
  std::optional<GridOn<B>> own_;    // what the study's own search reads, made where it is asked for
  std::uint32_t n_faces_ = 0;
  std::size_t n_ = 0;
  Array<Sphere> spheres_;
  Array<std::uint8_t> status_;
  Array<Real> distance_;
};

}    // namespace lsdcd
