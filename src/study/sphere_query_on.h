// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The query on one backend: one source for all.
#pragma once

#include "base/input_error.h"
#include "grid/lookup/grid_on.h"
#include "query/grid_work.h"
#include "query/radius_error.h"
#include "study/one_pass.h"
#include "study/sphere_query.h"

#include <algorithm>

namespace lsdcd {

// `Way`: how a backend runs a query that reads the grid.
template <class B, class Way = OnePass>
class QueryOn : public SphereQuery {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  explicit QueryOn(B backend) : b_(std::move(backend)) {}

  void set_grid(const TriangleGrid &grid) override
  {
    n_faces_ = static_cast<std::uint32_t>(grid.wall.faces.size());
    grid_ = GridOn<B>(b_, FlatGrid(grid), true);
  }

  void set_spheres(const Sphere *spheres, std::size_t n) override
  {
    b_.copy_in(spheres, room(n), n);
    b_.wait();
  }
  void set_spheres(const FloatSphere *spheres, std::size_t n) override
  {
    b_.copy_in(spheres, float_room(n), n);
    b_.wait();
  }

  // Memory on the device for n spheres that the caller fills there, of either kind.
  Sphere *room(std::size_t n) { return room_in(sphere_, float_sphere_, n); }
  FloatSphere *float_room(std::size_t n) { return room_in(float_sphere_, sphere_, n); }

  void run(const QuerySettings &settings) override
  {
    prepare(settings);
    start(settings);
    b_.wait();
    if (settings.every_face || n_ == 0) return;
    if (in_float_)
      refuse_bad_radius(float_sphere_);
    else
      refuse_bad_radius(sphere_);
  }

  QueryTiming time(const QuerySettings &settings, int repeats) override
  {
    run(settings);
    std::vector<double> ms(std::max(repeats, 1));
    for (double &t : ms) t = b_.milliseconds([&] { start(settings); });
    std::sort(ms.begin(), ms.end());
    return {ms[ms.size() / 2], ms.front(), ms.back(), static_cast<int>(ms.size())};
  }

  std::vector<std::uint8_t> status() override { return to_host(b_, status_, n_); }
  std::vector<Real> distance() override
  {
    if (float_distance_.size() < n_) return to_host(b_, distance_, distance_.size() >= n_ ? n_ : 0);
    const std::vector<float> kept = to_host(b_, float_distance_, n_);
    return {kept.begin(), kept.end()};
  }
  std::vector<std::uint32_t> read() override
  {
    return to_host(b_, read_, read_.size() >= n_ ? n_ : 0);
  }
  std::string device() const override { return b_.name(); }

  // The arrays of the last run, on the device.
  AnswerArrays answers()
  {
    return {status_.data(), distance_.data(), float_distance_.data(), read_.data()};
  }
  const GridView &grid() const { return grid_.view; }
  std::size_t n() const { return n_; }
  B &backend() { return b_; }

  // The steps of run(). Public because nvcc takes no device lambda from a private function.

  void prepare(const QuerySettings &settings)
  {
    const bool paper = settings.inside == InsideTest::formula_five;
    if (paper && !settings.every_face && (grid_.view.nearest == 0 || grid_.view.in_floats))
      throw InputError("the paper's inside test needs lists of triangles in double: give a "
                       "grid of `nearest N`, or try every face");
    if (settings.every_face && grid_.view.in_floats)
      throw InputError("every face can be tried in double only; give a grid without records "
                       "in float");
    fit(status_, true);
    fit(distance_, settings.distance && !grid_.view.in_floats);
    fit(float_distance_, settings.distance && grid_.view.in_floats);
    fit(read_, settings.read);
    const std::uint64_t none = 0;
    if (too_large_.size() == 0) too_large_ = Array<std::uint64_t>(1);
    b_.copy_in(&none, too_large_.data(), 1);
    b_.wait();
    if (in_float_)
      way_.template reserve<FloatSphere>(n_);
    else
      way_.template reserve<Sphere>(n_);
  }

  void start(const QuerySettings &settings)
  {
    if (n_ == 0) return;
    if (in_float_)
      start_on(float_sphere_.data(), settings);
    else
      start_on(sphere_.data(), settings);
  }

  template <class S>
  void start_on(const S *spheres, const QuerySettings &settings)
  {
    if (settings.inside == InsideTest::formula_five)
      start_with<FormulaFiveDistances>(spheres, settings);
    else if (grid_.view.in_floats)
      start_with<BrickDistances>(spheres, settings);
    else
      start_with<MeshDistances>(spheres, settings);
  }

  template <class Distances, class S>
  void start_with(const S *spheres, const QuerySettings &settings)
  {
    const GridView grid = grid_.view;
    const AnswerArrays out = answers();
    const std::uint32_t n_faces = n_faces_;
    if (settings.every_face)
      b_.for_each(n_, [=] LSDCD_LAMBDA(std::size_t i) {
        const S s = spheres[i];
        out.keep(i, nearest_of_all<Distances>(grid, n_faces, s.centre(), s.r));
      });
    else if (grid.nearest == 0)
      run_grid<GridWork<Distances, S, true>>(spheres);
    else
      run_grid<GridWork<Distances, S, false>>(spheres);
  }

 private:
  template <class Work, class S>
  void run_grid(const S *spheres)
  {
    using Filter = typename Work::Filter;
    const TooLarge<S> too_large = {static_cast<decltype(S::r)>(grid_.view.cutoff),
                                   too_large_.data()};
    way_.run(b_, n_,
             Work{grid_.view, grid_.table, spheres, answers(), Filter(grid_.view), grid_.coarse,
                  too_large, 0});
  }

  template <class S>
  void refuse_bad_radius(const Array<S> &spheres)
  {
    const std::uint64_t first = read_one(b_, too_large_.data());
    if (first == 0) return;
    const std::size_t i = ~first;
    throw_bad_radius("sphere", i, read_one(b_, spheres.data() + i).r, grid_.view.cutoff);
  }

  template <class T, class Other>
  T *room_in(Array<T> &to, Array<Other> &other, std::size_t n)
  {
    n_ = n;
    in_float_ = sizeof(T) == sizeof(FloatSphere);
    other = Array<Other>();
    if (to.size() < n) to = Array<T>(n);
    return to.data();
  }

  template <class T>
  void fit(Array<T> &kept, bool wanted)
  {
    if (!wanted)
      kept = Array<T>();
    else if (kept.size() < n_)
      kept = Array<T>(n_);
  }

  B b_;
  Way way_;
  GridOn<B> grid_;
  std::uint32_t n_faces_ = 0;
  Array<Sphere> sphere_;
  Array<FloatSphere> float_sphere_;
  std::size_t n_ = 0;
  bool in_float_ = false;
  Array<std::uint8_t> status_;
  Array<Real> distance_;
  Array<float> float_distance_;
  Array<std::uint32_t> read_;
  Array<std::uint64_t> too_large_;    // one: TooLarge::first
};

}    // namespace lsdcd
