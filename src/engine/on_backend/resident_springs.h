// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The springs of a process's spheres in the memory of the engine. A step reads one pool and writes the other.
#pragma once

#include "backend/backend.h"
#include "contact/feature_turn.h"
#include "contact/spring.h"
#include "engine/on_backend/rows_on.h"
#include "engine/step/step_job.h"

#include <algorithm>

namespace lsdcd {

// The springs of a pool as rows: a row is a spring as pack_spring() writes it, followed by its n_extra numbers.
struct SpringRows {
  Spring *springs;
  Real *extra;
  int n_extra;

  LSDCD_FN int size() const { return kPackedSpring + n_extra; }
  LSDCD_FN void write(std::size_t place, double *to) const
  {
    to = pack_spring(springs[place], to);
    for (int e = 0; e < n_extra; e++) to[e] = extra[place * n_extra + e];
  }
  LSDCD_FN void read(std::size_t place, const double *from) const
  {
    from = unpack_spring(from, springs[place]);
    for (int e = 0; e < n_extra; e++) extra[place * n_extra + e] = from[e];
  }
};

template <class B>
class ResidentSprings : public RowsOn<B, SpringRows> {
  using Base = RowsOn<B, SpringRows>;
  using Base::b_;
  using Base::count_;
  using Base::end_;
  using Base::first_;
  template <class T>
  using Array = typename Base::template Array<T>;

  struct Pool {
    Array<Spring> springs;
    Array<Real> extra;
    Array<StepContact> contacts;
    std::size_t size = 0;
    std::size_t shared = 0;    // where the shared places of its last step began
  };

 public:
  // `counts`: the counts in which kernels note how much of a pool a step has used. Backend and counts must outlive this object.
  ResidentSprings(B &backend, const LawTraits &traits, StepCounts *counts) :
      Base(backend, "springs in one process"), traits_(traits), counts_(counts)
  {
  }

  SpringsView view() const
  {
    const Pool &pool = pool_[now_];
    return {{first_.data()}, {count_.data()}, pool.springs.data(), pool.extra.data()};
  }

  SpringRows rows() override
  {
    Pool &pool = pool_[now_];
    return {pool.springs.data(), pool.extra.data(), traits_.n_extra};
  }

  // A law that keeps nothing has neither springs nor counts of them.
  void grow(int n_spheres) override
  {
    if (traits_.history) Base::grow(n_spheres);
  }
  void to_cpu(KeptRows &to, int n_spheres) override
  {
    if (traits_.history) Base::to_cpu(to, n_spheres);
  }
  void from_cpu(const KeptRows &from, int n_spheres) override
  {
    if (traits_.history) Base::from_cpu(from, n_spheres);
  }
  void unpack(int n, const int *to, const double *buffer, int n_first, int second) override
  {
    if (end_ == kUnknown) end_ = pool_[now_].shared + read_one(b_, counts_).shared_used[now_];
    Base::unpack(n, to, buffer, n_first, second);
  }

  // Reserves places for steps over n candidate spheres, each of which has a place of its own for a single contact. Spheres with
  // more contacts share the places after these: three for each sphere, as in the corner of a box, or twice as many as were
  // shared last, and some for spheres with many contacts.
  void reserve_places(std::size_t n, const StepCounts &last)
  {
    n_candidates_ = n;
    wanted_ = 0;
    if (!traits_.history && !traits_.contacts) return;
    const std::size_t shared = std::max(last.shared_used[0], last.shared_used[1]);
    wanted_ = n + std::max(3 * n, 2 * shared) + kSparePlaces;
  }

  // Removes the springs of sphere i on meshes that are not in set[i].
  void forget_others(std::size_t n, const std::uint32_t *set)
  {
    if (!traits_.history) return;
    Pool &pool = pool_[now_];
    const int *first = first_.data();
    int *count = count_.data();
    Spring *springs = pool.springs.data();
    Real *extra = pool.extra.data();
    const int n_extra = traits_.n_extra;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      const std::size_t begin = first[i];
      int n_left = 0;
      for (int c = 0; c < count[i]; c++) {
        if (!(set[i] >> springs[begin + c].mesh & 1)) continue;
        if (n_left < c) {
          springs[begin + n_left] = springs[begin + c];
          for (int e = 0; e < n_extra; e++)
            extra[(begin + n_left) * n_extra + e] = extra[(begin + c) * n_extra + e];
        }
        n_left++;
      }
      if (n_left != count[i]) count[i] = n_left;
    });
  }

  // Turns the springs of the spheres [0, n) on this mesh with their features.
  void turn(std::size_t n, std::uint32_t mesh, const TurningMesh &with)
  {
    if (!traits_.history) return;
    Pool &pool = pool_[now_];
    const int *first = first_.data(), *count = count_.data();
    Spring *springs = pool.springs.data();
    Real *all_extra = pool.extra.data();
    const int n_extra = traits_.n_extra, n_vectors = traits_.n_vectors;
    constexpr std::size_t kAhead = 8;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      if (i + kAhead < n && count[i + kAhead] > 0) prefetch_turn(with, springs[first[i + kAhead]]);
      for (int c = 0; c < count[i]; c++) {
        const std::size_t at = std::size_t(first[i]) + c;
        if (springs[at].mesh != mesh) continue;
        Real *extra = all_extra + at * n_extra;
        Vec3 vectors[kMostVectors];
        for (int k = 0; k < n_vectors; k++)
          vectors[k] = {extra[3 * k], extra[3 * k + 1], extra[3 * k + 2]};
        turn_with_feature(with, springs[at], vectors, n_vectors);
        for (int k = 0; k < n_vectors; k++)
          for (int d = 0; d < 3; d++) extra[3 * k + d] = vectors[k][d];
      }
    });
  }

  // Returns the pool that the next step writes, with no shared place in use.
  ContactPool next()
  {
    // A step clears the counter of the pool that it does not write. After a step that moves no springs, as in setup, the same
    // pool is written again.
    if (written_ == 1 - now_) put_one(b_, &counts_->shared_used[written_], 0);
    written_ = 1 - now_;
    Pool &pool = pool_[written_];
    if (pool.size < wanted_) pool = make(with_spare(wanted_));
    pool.shared = n_candidates_;
    return {static_cast<int>(pool.shared),
            static_cast<int>(pool.size),
            written_,
            first_.data(),
            count_.data(),
            nullptr,
            pool.springs.data(),
            pool.extra.data(),
            pool.contacts.data()};
  }

  // Returns the number of places in both pools: at least as many as there are contacts of the last step and of this one.
  std::size_t places() const { return pool_[0].size + pool_[1].size; }
  // Returns the number of places in the pool that the next step reads.
  std::size_t places_read() const { return pool_[now_].size; }

  void swap()
  {
    now_ = 1 - now_;
    end_ = kUnknown;
  }

  // Return the contacts of the last step, with gaps, and the n_extra numbers of each.
  const StepContact *contacts() const { return pool_[written_].contacts.data(); }
  const Real *extra_of_contacts() const { return pool_[written_].extra.data(); }

  std::size_t bytes() const
  {
    const std::size_t places = pool_[0].size + pool_[1].size;
    return 2 * count_.size() * sizeof(int) +
           places * (traits_.history * (sizeof(Spring) + traits_.n_extra * sizeof(Real)) +
                     traits_.contacts * sizeof(StepContact));
  }

 private:
  static constexpr std::size_t kUnknown = ~std::size_t(0);
  static constexpr std::size_t kSparePlaces = 65536;

  void make_room(std::size_t n) override
  {
    Pool &pool = pool_[now_];
    if (pool.size >= n) return;
    Pool wider = make(with_spare(n));
    copy_all(b_, pool.springs.data(), wider.springs.data(), end_);
    copy_all(b_, pool.extra.data(), wider.extra.data(), end_ * traits_.n_extra);
    b_.wait();
    pool = std::move(wider);
  }

  // Makes a pool of n places. The index of a place must fit in an int.
  Pool make(std::size_t n)
  {
    this->numbered(static_cast<std::int64_t>(n));
    Pool pool;
    if (traits_.history) pool.springs = Array<Spring>(n);
    pool.extra = Array<Real>(traits_.history ? n * traits_.n_extra : 0);
    if (traits_.contacts) pool.contacts = Array<StepContact>(n);
    pool.size = n;
    return pool;
  }

  LawTraits traits_;
  StepCounts *counts_;
  Pool pool_[2];
  int now_ = 0, written_ = 0;    // the pool that steps read, and the one that the last step wrote
  std::size_t n_candidates_ = 0, wanted_ = 0;
};

}    // namespace lsdcd
