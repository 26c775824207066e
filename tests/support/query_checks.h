// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares the library's query of a wall with the oracle on one backend, where spheres, oracle and counts stay.
#pragma once

#include "support/query_oracle.h"

#include "backend/backend.h"
#include "grid/flat_grid.h"
#include "grid/lookup/grid_on.h"
#include "query/point_query.h"
#include "study/spheres.h"

#include <memory>
#include <string>

namespace lsdcd {

// Counts over spheres; `near` lie in a cell that lists anything.
struct QueryCounts {
  std::size_t spheres = 0, near = 0, touching = 0, uncertified = 0;
  // Further than the tolerance from the oracle's answer; the second only where certified.
  std::size_t missed = 0, false_ones = 0, wrong = 0;
  std::size_t certified_missed = 0, certified_false = 0, certified_wrong = 0;
  double query_ms = 0;
};

// One mesh, its oracle and spheres, in chunks.
class QueryChecks {
 public:
  virtual ~QueryChecks() = default;

  // Queries a grid for all spheres.
  virtual QueryCounts check(const TriangleGrid &grid, const TriangleTable &names) = 0;
  // Largest difference between the oracle and every triangle tried, for the first n
  // spheres, where either is within the cutoff.
  virtual double oracle_error(std::size_t n) = 0;
  // The i-th sphere as the device made it.
  virtual Sphere sphere(std::size_t i) = 0;
  virtual std::string device() const = 0;
};

struct QueryCheckSettings {
  Real cutoff, tolerance;    // lengths
  SphereBox box;
  std::size_t n_spheres, chunk;
};

std::unique_ptr<QueryChecks> query_checks_on_cpu(const Bins &bins, const QueryCheckSettings &s);
std::unique_ptr<QueryChecks> query_checks_on_cuda(const Bins &bins, const QueryCheckSettings &s);

template <class B>
class QueryChecksOn : public QueryChecks {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  QueryChecksOn(const Bins &bins, const QueryCheckSettings &s) :
      s_(s), corners_(from_cpu(b_, bins.corners)), first_(from_cpu(b_, bins.first)),
      triangle_(from_cpu(b_, bins.triangle)), truth_(s.n_spheres),
      spheres_(std::min(s.chunk, s.n_spheres)), status_(spheres_.size()), distance_(spheres_.size())
  {
    bins_ = {corners_.data(),
             static_cast<std::uint32_t>(bins.corners.size() / 3),
             bins.origin,
             bins.side,
             {},
             first_.data(),
             triangle_.data()};
    for (int k = 0; k < 3; k++) bins_.n[k] = bins.n[k];
    find_truth();
  }

  QueryCounts check(const TriangleGrid &grid, const TriangleTable &names) override
  {
    QueryCounts total;
    total.spheres = s_.n_spheres;
    const FlatGrid flat(grid);
    const GridOn<B> on(b_, flat.view());    // for the counts
    const auto query = [&] {
      if constexpr (B::kOnCpu)
        return [on_cpu = CpuGrid(flat.view()), &names](const PointArrays<Real> &io) {
          query_grid(on_cpu, names, io);
        };
      else
        return [stream = copy_to_cuda(flat.view(), names)->query_on(nullptr)](
                   const PointArrays<Real> &io) { stream->enqueue(io); };
    }();
    for (std::size_t from = 0; from < s_.n_spheres; from += s_.chunk) {
      const std::size_t n = std::min(s_.chunk, s_.n_spheres - from);
      fill(from, n);
      PointArrays<Real> io;
      io.n = n;
      io.points = {&spheres_.data()->x, 4, 1};
      io.radii = {&spheres_.data()->r, 4};
      io.status = status_.data();
      io.distance = {distance_.data(), 1};
      total.query_ms += b_.milliseconds([&] { query(io); });
      count(on.view, from, n, total);
    }
    return total;
  }

  double oracle_error(std::size_t n) override
  {
    n = std::min(n, s_.n_spheres);
    Array<double> error(n);
    write_errors(error.data(), n);
    const std::vector<double> host = to_cpu(b_, error, n);
    return *std::max_element(host.begin(), host.end());
  }

  Sphere sphere(std::size_t i) override
  {
    fill(i, 1);
    return to_cpu(b_, spheres_, 1)[0];
  }

  std::string device() const override { return b_.name(); }

  // Public because nvcc takes no device lambda from a private function.

  void find_truth()
  {
    const BinsView bins = bins_;
    const SphereBox box = s_.box;
    double *truth = truth_.data();
    b_.for_each(s_.n_spheres, [=] LSDCD_LAMBDA(std::size_t i) {
      truth[i] = bin_distance(bins, box.sphere(i).centre());
    });
    b_.wait();
  }

  void fill(std::size_t from, std::size_t n)
  {
    Sphere *to = spheres_.data();
    const SphereBox box = s_.box;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to[i] = box.sphere(from + i); });
  }

  void write_errors(double *to, std::size_t n)
  {
    const BinsView bins = bins_;
    const SphereBox box = s_.box;
    const double *truth = truth_.data();
    const double cutoff = s_.cutoff;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const double brute = brute_distance(bins, box.sphere(i).centre());
      to[i] = truth[i] <= cutoff || brute <= cutoff ? fabs(brute - truth[i]) : 0;
    });
    b_.wait();
  }

  // A bit for each thing that can be said of an answer.
  enum : std::uint32_t {
    near_bit = 1,
    touching_bit = 2,
    uncertified_bit = 4,
    missed_bit = 8,
    false_bit = 16,
    wrong_bit = 32,
    bad_bits = missed_bit | false_bit | wrong_bit,
    certified_shift = 3    // the bad ones once more for certified answers
  };

  void count(const GridView &grid, std::size_t from, std::size_t n, QueryCounts &total)
  {
    const std::uint8_t *status = status_.data();
    const Real *distance = distance_.data();
    const double *truth = truth_.data() + from;
    const Real tolerance = s_.tolerance;
    const SphereBox box = s_.box;
    Array<std::uint32_t> flag(n);
    std::uint32_t *flags = flag.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const Sphere s = box.sphere(from + i);
      const Real r = s.r;
      const bool found = status[i] & kFound, certified = status[i] & kCertified;
      CellAddress at;
      Cell cell;
      std::uint32_t f = 0;
      if (find_cell(grid, s.centre(), at, cell)) f |= near_bit;
      if (truth[i] < r) f |= touching_bit;
      if (!found && truth[i] < r - tolerance) f |= missed_bit;
      if (found && !(truth[i] < r + tolerance)) f |= false_bit;
      if (found && !(fabs(distance[i] - truth[i]) <= tolerance)) f |= wrong_bit;
      if (certified)
        f |= (f & bad_bits) << certified_shift;
      else
        f |= uncertified_bit;
      flags[i] = f;
    });
    total.near += with_bit(flags, n, near_bit);
    total.touching += with_bit(flags, n, touching_bit);
    total.uncertified += with_bit(flags, n, uncertified_bit);
    total.missed += with_bit(flags, n, missed_bit);
    total.false_ones += with_bit(flags, n, false_bit);
    total.wrong += with_bit(flags, n, wrong_bit);
    total.certified_missed += with_bit(flags, n, missed_bit << certified_shift);
    total.certified_false += with_bit(flags, n, false_bit << certified_shift);
    total.certified_wrong += with_bit(flags, n, wrong_bit << certified_shift);
  }

  std::size_t with_bit(const std::uint32_t *flags, std::size_t n, std::uint32_t bit)
  {
    Array<std::uint32_t> has(n);
    std::uint32_t *to = has.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to[i] = flags[i] & bit ? 1 : 0; });
    return b_.exclusive_scan(to, n);
  }

 private:
  QueryCheckSettings s_;
  B b_;
  Array<Vec3> corners_;
  Array<std::uint32_t> first_, triangle_;
  Array<double> truth_;
  Array<Sphere> spheres_;    // of a chunk
  Array<std::uint8_t> status_;
  Array<Real> distance_;
  BinsView bins_ = {};
};

}    // namespace lsdcd
