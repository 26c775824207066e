// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Compares a wall's query with the oracle on one backend, where spheres, oracle and counts stay.
#pragma once

#include "support/query_oracle.h"

#include "study/sphere_query_on.h"
#include "study/spheres.h"

#include <memory>
#include <string>

namespace lsdcd {

// Counts over spheres; `near` have any entries to read.
struct QueryCounts {
  std::size_t spheres = 0, near = 0, touching = 0, uncertified = 0, entries = 0;
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
  virtual QueryCounts check(const TriangleGrid &grid) = 0;
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

template <class B, class Way = OnePass>
class QueryChecksOn : public QueryChecks {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  QueryChecksOn(const Bins &bins, const QueryCheckSettings &s) :
      s_(s), query_(B()), corners_(from_host(b(), bins.corners)),
      first_(from_host(b(), bins.first)), triangle_(from_host(b(), bins.triangle)),
      truth_(s.n_spheres)
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

  QueryCounts check(const TriangleGrid &grid) override
  {
    QueryCounts total;
    total.spheres = s_.n_spheres;
    query_.set_grid(grid);
    for (std::size_t from = 0; from < s_.n_spheres; from += s_.chunk) {
      const std::size_t n = std::min(s_.chunk, s_.n_spheres - from);
      fill(from, n);
      QuerySettings settings;
      settings.read = true;
      query_.prepare(settings);
      total.query_ms += b().milliseconds([&] { query_.start(settings); });
      count(from, n, total);
    }
    return total;
  }

  double oracle_error(std::size_t n) override
  {
    n = std::min(n, s_.n_spheres);
    Array<double> error(n);
    write_errors(error.data(), n);
    const std::vector<double> host = to_host(b(), error, n);
    return *std::max_element(host.begin(), host.end());
  }

  Sphere sphere(std::size_t i) override
  {
    fill(i, 1);
    Array<Sphere> one(1);
    copy_one(one.data());
    return to_host(b(), one, 1)[0];
  }

  std::string device() const override { return query_.device(); }

  // Public because nvcc takes no device lambda from a private function.

  void find_truth()
  {
    const BinsView bins = bins_;
    const SphereBox box = s_.box;
    double *truth = truth_.data();
    b().for_each(s_.n_spheres, [=] LSDCD_LAMBDA(std::size_t i) {
      truth[i] = bin_distance(bins, box.sphere(i).centre());
    });
    b().wait();
  }

  void fill(std::size_t from, std::size_t n)
  {
    Sphere *to = query_.room(n);
    const SphereBox box = s_.box;
    b().for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to[i] = box.sphere(from + i); });
  }

  void copy_one(Sphere *to)
  {
    const Sphere *from = query_.room(1);
    b().for_each(1, [=] LSDCD_LAMBDA(std::size_t i) { to[i] = from[i]; });
    b().wait();
  }

  void write_errors(double *to, std::size_t n)
  {
    const BinsView bins = bins_;
    const SphereBox box = s_.box;
    const double *truth = truth_.data();
    const double cutoff = s_.cutoff;
    b().for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const double brute = brute_distance(bins, box.sphere(i).centre());
      to[i] = truth[i] <= cutoff || brute <= cutoff ? fabs(brute - truth[i]) : 0;
    });
    b().wait();
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

  void count(std::size_t from, std::size_t n, QueryCounts &total)
  {
    const AnswerArrays a = query_.answers();
    const double *truth = truth_.data() + from;
    const Real tolerance = s_.tolerance;
    const SphereBox box = s_.box;
    Array<std::uint32_t> flag(n);
    std::uint32_t *flags = flag.data();
    b().for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const Real r = box.sphere(from + i).r;
      const bool found = a.status[i] & kTouching, certified = a.status[i] & kCertified;
      std::uint32_t f = 0;
      if (a.read[i] > 0) f |= near_bit;
      if (truth[i] < r) f |= touching_bit;
      if (!found && truth[i] < r - tolerance) f |= missed_bit;
      if (found && !(truth[i] < r + tolerance)) f |= false_bit;
      if (found && !(fabs(a.distance_of(i) - truth[i]) <= tolerance)) f |= wrong_bit;
      if (certified)
        f |= (f & bad_bits) << certified_shift;
      else
        f |= uncertified_bit;
      flags[i] = f;
    });
    total.entries += b().exclusive_scan(a.read, n);
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
    b().for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { to[i] = flags[i] & bit ? 1 : 0; });
    return b().exclusive_scan(to, n);
  }

 private:
  B &b() { return query_.backend(); }

  QueryCheckSettings s_;
  QueryOn<B, Way> query_;
  Array<Vec3> corners_;
  Array<std::uint32_t> first_, triangle_;
  Array<double> truth_;
  BinsView bins_ = {};
};

}    // namespace lsdcd
