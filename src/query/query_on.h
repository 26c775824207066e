// The query on one backend: one source for all.
#pragma once

#include "base/input_error.h"
#include "grid/flat_grid.h"
#include "grid/lookup/brick_filter.h"
#include "parallel/atomic.h"
#include "query/nearest_distance.h"
#include "query/one_pass.h"
#include "query/sphere_query.h"

#include <algorithm>
#include <cstdio>

namespace lsdcd {

// Arrays of one query; which of them are null says what is kept. Distances that were found
// in float are kept in float.
struct AnswerArrays {
  std::uint8_t *status;
  Real *distance;
  float *float_distance;
  std::uint32_t *read;

  static constexpr float kAnyFloatDistance = 3e38f;

  LSDCD_FN void keep(std::size_t i, const Answer &a) const
  {
    const bool touching = a.distance < kAnyDistance;
    status[i] = (touching ? kTouching : 0) | (a.certified ? kCertified : 0);
    if (distance) distance[i] = a.distance;
    if (float_distance)
      float_distance[i] = touching ? static_cast<float>(a.distance) : kAnyFloatDistance;
    if (read) read[i] = a.read;
  }
  // The same of four neighbours from i on, a multiple of 4, where no wall is near.
  LSDCD_FN void keep_four_far(std::size_t i) const
  {
    const std::uint8_t s = kCertified;
    four_at(status, i) = {{s, s, s, s}};
    if (distance) four_at(distance, i) = {{kAnyDistance, kAnyDistance, kAnyDistance, kAnyDistance}};
    const float f = kAnyFloatDistance;
    if (float_distance) four_at(float_distance, i) = {{f, f, f, f}};
    if (read) four_at(read, i) = {{0, 0, 0, 0}};
  }
  // Of the spheres from the n-th on, a multiple of 4.
  AnswerArrays after(std::size_t n) const
  {
    return {status + n, distance ? distance + n : nullptr,
            float_distance ? float_distance + n : nullptr, read ? read + n : nullptr};
  }
  LSDCD_FN static Real widened(float kept)
  {
    return kept < kAnyFloatDistance ? static_cast<Real>(kept) : kAnyDistance;
  }
  LSDCD_FN Real distance_of(std::size_t i) const
  {
    return float_distance ? widened(float_distance[i]) : distance[i];
  }

 private:
  // Aligned so that a GPU stores them in one piece, or two of 16 bytes.
  template <class T>
  struct alignas(sizeof(T) < 4 ? 4 : 16) Four {
    T v[4];
  };
  template <class T>
  LSDCD_FN static Four<T> &four_at(T *kept, std::size_t i)
  {
    return *reinterpret_cast<Four<T> *>(kept + i);
  }
};

// The first sphere with a radius that the grid's lists were not built for, or that is no number.
// Radii are compared in the spheres' digits: in float, the reach is one of them, rounded.
template <class S>
struct TooLarge {
  decltype(S::r) reach;
  std::uint64_t *first;    // ~ of its index, the largest of all; 0: none

  LSDCD_FN bool is(const S &s) const { return !(s.r <= reach); }
  LSDCD_FN void note(std::size_t i, const S &s) const
  {
    if (is(s)) raise_to(first, ~static_cast<std::uint64_t>(i));
  }
};

// What a query asks of each sphere, for the loops that run it: an answer at once; or first
// whether it may be in a brick, then its cell, and then an answer from that cell's list, where
// there are these, and one far from the wall elsewhere. kComplete: grid.nearest is 0.
template <class Distances, class S, bool kComplete>
struct GridWork {
  using Item = S;
  using Filter = BrickFilter<decltype(S::x)>;

  GridView grid;
  BrickTable table;
  const S *spheres;
  AnswerArrays out;
  Filter filter;
  CoarseTable coarse;
  TooLarge<S> too_large;
  std::size_t from;    // spheres before these

  // The same of the spheres from the n-th on, a multiple of 4.
  GridWork after(std::size_t n) const
  {
    return {grid, table, spheres + n, out.after(n), filter, coarse, too_large, from + n};
  }

  LSDCD_FN S sphere(std::size_t i) const { return spheres[i]; }
  LSDCD_FN void check(std::size_t i, const S &s) const { too_large.note(from + i, s); }
  LSDCD_FN void answer(std::size_t i, const S &s) const
  {
    check(i, s);
    out.keep(i, nearest_distance<kComplete, Distances>(grid, s.centre(), s.r));
  }

  // Of a sphere that is too large nothing is sure: who looks closer checks it.
  LSDCD_FN BrickGuess guess(const S &s) const
  {
    BrickGuess at = filter.guess({s.x, s.y, s.z});
    at.unsure |= too_large.is(s);
    return at;
  }
  // kNoCell where there are no candidates.
  LSDCD_FN std::uint32_t cell(const S &s) const { return occupied_cell(grid, table, s.centre()); }
  LSDCD_FN const Cell *list(std::uint32_t cell) const { return grid.lists.cells + cell; }
  LSDCD_FN void far(std::size_t i) const { out.keep(i, far_answer()); }
  LSDCD_FN void four_far(std::size_t i) const { out.keep_four_far(i); }
  LSDCD_FN void answer(std::size_t i, const S &s, const Cell &cell) const
  {
    const Vec3 q = s.centre();
    out.keep(i, nearest_from<kComplete, Distances>(grid, q, s.r, address_inside(grid, q), cell));
  }

  // Lists that are too long for one thread, as at a vertex of very many facets.
  static constexpr bool kTogether = kComplete && Distances::kBounded;
  static constexpr std::uint32_t kLongForOne = 32;
  LSDCD_FN bool is_long(const Cell &cell) const { return kTogether && cell.count > kLongForOne; }
  template <class Lanes>
  LSDCD_FN void answer_together(std::size_t i, const S &s, const Cell &cell,
                                const Lanes &lanes) const
  {
    if constexpr (kTogether) {
      const Vec3 q = s.centre();
      const Answer a = nearest_together<Distances>(grid, grid.lists, q, s.r,
                                                   address_inside(grid, q), cell, lanes);
      if (lanes.lane() == 0) out.keep(i, a);
    }
  }
};

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
    const FlatGrid flat(grid);
    const GridView view = flat.view();
    Array<char> block(view.block_bytes);
    b_.copy_in(view.block, block.data(), block.size());
    block_ = std::move(block);
    grid_ = moved_view(view, block_.data());
    const std::vector<BrickWord> words = brick_words(view);
    words_ = b_.from_host(words);
    table_ = BrickTable(words, words_.data());
    coarse_ = CoarseTable(view);
    coarse_words_ = b_.from_host(coarse_words(view, coarse_));
    coarse_.words = coarse_words_.data();
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
    if (settings.every_face || n_ == 0) return;
    if (in_float_)
      refuse_too_large(float_sphere_);
    else
      refuse_too_large(sphere_);
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
    if (float_distance_.size() < n_) return b_.to_host(distance_, distance_.size() >= n_ ? n_ : 0);
    std::vector<Real> out;
    for (float kept : b_.to_host(float_distance_, n_)) out.push_back(AnswerArrays::widened(kept));
    return out;
  }
  std::vector<std::uint32_t> read() override
  {
    return b_.to_host(read_, read_.size() >= n_ ? n_ : 0);
  }
  std::string device() const override { return b_.name(); }

  // The arrays of the last run, on the device.
  AnswerArrays answers()
  {
    return {status_.data(), distance_.data(), float_distance_.data(), read_.data()};
  }
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
    fit(status_, true);
    fit(distance_, settings.distance && !grid_.in_floats);
    fit(float_distance_, settings.distance && grid_.in_floats);
    fit(read_, settings.read);
    const std::uint64_t none = 0;
    if (too_large_.size() == 0) too_large_ = Array<std::uint64_t>(1);
    b_.copy_in(&none, too_large_.data(), 1);
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
    const TooLarge<S> too_large = {static_cast<decltype(S::r)>(grid_.reach), too_large_.data()};
    way_.run(b_, n_, Work{grid_, table_, spheres, answers(), Filter(grid_), coarse_, too_large, 0});
  }

  template <class S>
  void refuse_too_large(const Array<S> &spheres)
  {
    const std::uint64_t first = b_.to_host(too_large_, 1)[0];
    if (first == 0) return;
    const std::size_t i = ~first;
    char text[200];
    std::snprintf(
        text, sizeof text,
        "sphere %zu has radius %.9g, more than the grid's reach %.9g: build the grid with "
        "a reach of the largest radius, or try every face",
        i, static_cast<double>(b_.to_host(spheres, i + 1)[i].r), grid_.reach);
    throw InputError(text);
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
  GridView grid_ = {};
  Array<char> block_;
  Array<BrickWord> words_;
  BrickTable table_;
  CoarseTable coarse_;
  Array<std::uint32_t> coarse_words_;
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
