// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Checks a query's radii in the memory of a backend.
#pragma once

#include "backend/backend.h"
#include "query/point_work.h"
#include "query/radius_error.h"

namespace lsdcd {

template <class B>
class RadiusCheck {
 public:
  // `cutoff`: the largest radius that is allowed.
  explicit RadiusCheck(Real cutoff) : cutoff_(cutoff), first_(1) {}

  // Returns the check that the kernels of the next query make.
  template <class S>
  TooLarge<S> begin(B &b)
  {
    std::uint64_t *first = first_.data();
    put_one(b, first, 0);
    return {static_cast<decltype(S::r)>(cutoff_), first};
  }
  // Waits if a query has radii, and throws InputError if one of them is bad.
  template <class T>
  void end(B &b, const PointArrays<T> &io)
  {
    if (!io.radii.at) return;
    const std::uint64_t first = read_one(b, first_.data());
    if (first == 0) return;
    throw_bad_radius("point", ~first,
                     read_one(b, io.radii.at + static_cast<std::ptrdiff_t>(~first) * io.radii.step),
                     cutoff_);
  }

 private:
  const Real cutoff_;
  typename B::template Array<std::uint64_t> first_;
};

}    // namespace lsdcd
