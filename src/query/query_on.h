// The query on one backend: one source for all.
#pragma once

#include "base/input_error.h"
#include "grid/flat_grid.h"
#include "query/nearest_distance.h"
#include "query/sphere_query.h"

#include <algorithm>

namespace lsdcd {

// Arrays of one query; which of them are null says what is kept.
struct AnswerArrays {
  std::uint8_t *status;
  Real *distance;
  std::uint32_t *read;

  LSDCD_FN void keep(std::size_t i, const Answer &a) const
  {
    status[i] = (a.distance < kAnyDistance ? kTouching : 0) | (a.certified ? kCertified : 0);
    if (distance) distance[i] = a.distance;
    if (read) read[i] = a.read;
  }
};

template <class B>
class QueryOn : public SphereQuery {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  explicit QueryOn(B backend) : b_(std::move(backend)) {}

  void set_grid(const TriangleGrid &grid) override
  {
    n_faces_ = static_cast<std::uint32_t>(grid.wall.faces.size());
    const FlatGrid flat(grid);
    const GridView view = flat.view();
    Array<char> block(view.block_bytes);
    b_.copy_in(view.block, block.data(), block.size());
    block_ = std::move(block);
    grid_ = moved_view(view, block_.data());
  }

  void set_spheres(const Sphere *spheres, std::size_t n) override
  {
    b_.copy_in(spheres, room(n), n);
  }
  void set_spheres(const FloatSphere *spheres, std::size_t n) override
  {
    b_.copy_in(spheres, float_room(n), n);
  }

  // Memory on the device for n spheres that the caller fills there, of either kind.
  Sphere *room(std::size_t n) { return room_in(sphere_, float_sphere_, n); }
  FloatSphere *float_room(std::size_t n) { return room_in(float_sphere_, sphere_, n); }

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

  std::vector<std::uint8_t> status() override { return b_.to_host(status_, n_); }
  std::vector<Real> distance() override
  {
    return b_.to_host(distance_, distance_.size() >= n_ ? n_ : 0);
  }
  std::vector<std::uint32_t> read() override
  {
    return b_.to_host(read_, read_.size() >= n_ ? n_ : 0);
  }
  std::string device() const override { return b_.name(); }

  // The arrays of the last run, on the device.
  AnswerArrays answers() { return {status_.data(), distance_.data(), read_.data()}; }
  const GridView &grid() const { return grid_; }
  std::size_t n() const { return n_; }
  B &backend() { return b_; }

  // The steps of run(). Public because nvcc takes no device lambda from a private function.

  void prepare(const QuerySettings &settings)
  {
    const bool paper = settings.inside == InsideTest::formula_five;
    if (paper && !settings.every_face && (grid_.nearest == 0 || grid_.in_floats))
      throw InputError("the paper's inside test needs lists of triangles in double: give a "
                       "grid of `nearest N`, or try every face");
    if (settings.every_face && grid_.in_floats)
      throw InputError("every face can be tried in double only; give a grid without records "
                       "in float");
    if (status_.size() < n_) status_ = Array<std::uint8_t>(n_);
    if (!settings.distance)
      distance_ = Array<Real>();
    else if (distance_.size() < n_)
      distance_ = Array<Real>(n_);
    if (!settings.read)
      read_ = Array<std::uint32_t>();
    else if (read_.size() < n_)
      read_ = Array<std::uint32_t>(n_);
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
      start_with<WallDistances<InsideTest::formula_five>>(spheres, settings);
    else if (grid_.in_floats)
      start_with<BrickDistances>(spheres, settings);
    else
      start_with<WallDistances<InsideTest::exact>>(spheres, settings);
  }

  template <class Distances, class S>
  void start_with(const S *spheres, const QuerySettings &settings)
  {
    const GridView grid = grid_;
    const AnswerArrays out = answers();
    const std::uint32_t n_faces = n_faces_;
    if (settings.every_face)
      b_.for_each(n_, [=] LSDCD_LAMBDA(std::size_t i) {
        const S s = spheres[i];
        out.keep(i, nearest_of_all<Distances>(grid, n_faces, s.centre(), s.r));
      });
    else
      b_.for_each(n_, [=] LSDCD_LAMBDA(std::size_t i) {
        const S s = spheres[i];
        out.keep(i, nearest_distance<Distances>(grid, s.centre(), s.r));
      });
  }

 private:
  template <class T, class Other>
  T *room_in(Array<T> &to, Array<Other> &other, std::size_t n)
  {
    n_ = n;
    in_float_ = sizeof(T) == sizeof(FloatSphere);
    other = Array<Other>();
    if (to.size() < n) to = Array<T>(n);
    return to.data();
  }

  B b_;
  GridView grid_ = {};
  Array<char> block_;
  std::uint32_t n_faces_ = 0;
  Array<Sphere> sphere_;
  Array<FloatSphere> float_sphere_;
  std::size_t n_ = 0;
  bool in_float_ = false;
  Array<std::uint8_t> status_;
  Array<Real> distance_;
  Array<std::uint32_t> read_;
};

}    // namespace lsdcd
