// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The springs of a process's spheres in the memory of the engine. A step reads one pool and writes the other.
#pragma once

#include "backend/backend.h"
#include "base/countable.h"
#include "base/packed_integer.h"
#include "contact/contact_history.h"
#include "contact/feature_turn.h"
#include "engine/springs.h"
#include "engine/step/step_job.h"

#include <algorithm>
#include <vector>

namespace lsdcd {

template <class B>
class ResidentSprings : public Springs {
  template <class T>
  using Array = typename B::template Array<T>;

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
      b_(backend), traits_(traits), counts_(counts)
  {
  }

  int *first() override { return first_.data(); }
  int *count() override { return count_.data(); }
  SpringsView view() const
  {
    const Pool &pool = pool_[now_];
    return {{first_.data()}, {count_.data()}, pool.springs.data(), pool.extra.data()};
  }

  void grow(int n_spheres) override
  {
    const std::size_t n = n_spheres;
    if (!traits_.history || n <= count_.size()) return;
    Array<int> first(n), count(n);
    int *to_first = first.data(), *to_count = count.data();
    const int *from_first = first_.data(), *from_count = count_.data();
    const std::size_t before = count_.size();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      to_first[i] = i < before ? from_first[i] : 0;
      to_count[i] = i < before ? from_count[i] : 0;
    });
    b_.wait();
    first_ = std::move(first);
    count_ = std::move(count);
  }

  // Reserves places for steps over n candidate spheres, each of which has a place of its own for a single contact. Spheres with
  // more contacts share the places after these: three for each sphere, as in the corner of a box, or twice as many as were
  // shared last, and some for spheres with many contacts.
  void make_room(std::size_t n, const StepCounts &last)
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

  void to_store(ContactHistory &store, int n_spheres) override
  {
    if (!traits_.history) return;
    const std::size_t n = n_spheres;
    grow(n_spheres);
    Array<int> offset(n);
    const std::size_t total = offsets(n, offset.data());
    Array<Spring> springs(total);
    Array<Real> extra(total * traits_.n_extra);
    const SpringsView from = view();
    const int n_extra = traits_.n_extra;
    const int *at = offset.data();
    Spring *to = springs.data();
    Real *to_extra = extra.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      for (int c = 0; c < from.count[i]; c++) {
        const std::size_t source = std::size_t(from.first[i]) + c, target = std::size_t(at[i]) + c;
        to[target] = from.pool[source];
        for (int e = 0; e < n_extra; e++)
          to_extra[target * n_extra + e] = from.extra[source * n_extra + e];
      }
    });
    store.assign(to_cpu(b_, offset, n), to_cpu(b_, count_, n), to_cpu(b_, springs, total),
                 to_cpu(b_, extra, total * n_extra));
  }

  void from_store(const ContactHistory &store, int n_spheres) override
  {
    if (!traits_.history) return;
    const std::size_t n = n_spheres;
    grow(n_spheres);
    const SpringsView from = store.view();
    Pool &pool = pool_[now_];
    const std::size_t size = store.pool_size();
    if (pool.size < size) pool = make(with_spare(size));
    b_.copy_in(from.first.at, first_.data(), n);
    b_.copy_in(from.count.at, count_.data(), n);
    // Spheres after these have no springs in this pool.
    put_all(b_, count_.data() + n, count_.size() - n, 0);
    b_.copy_in(from.pool, pool.springs.data(), size);
    if (traits_.n_extra > 0) b_.copy_in(from.extra, pool.extra.data(), size * traits_.n_extra);
    b_.wait();
    end_ = size;
  }

  int largest_packed_size(int n) override
  {
    const int *count = count_.data();
    return 1 + per_spring() * b_.template largest<int>(
                                  n, [=] LSDCD_LAMBDA(std::size_t i) -> int { return count[i]; });
  }

  int most_packed_size() const override { return 1 + per_spring() * kMaxContacts; }

  int pack(int n, const int *which, const int *from, double *buffer) override
  {
    Array<int> offset(n);
    int *at = offset.data(), *first = first_.data(), *count = count_.data();
    const SpringsView springs = view();
    const int per_spring = this->per_spring(), n_extra = traits_.n_extra;
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) { at[k] = 1 + per_spring * count[which[k]]; });
    const int total = numbered(std::int64_t(n) + numbered(b_.exclusive_scan(at, n)));
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const int i = which[k];
      const int begin = n + at[k];
      buffer[k] = as_double(begin);
      double *to = buffer + begin;
      *to++ = count[i];
      for (int c = 0; c < count[i]; c++) {
        const std::size_t source = std::size_t(springs.first[i]) + c;
        to = pack_spring(springs.pool[source], to);
        for (int e = 0; e < n_extra; e++) *to++ = springs.extra[source * n_extra + e];
      }
      const int j = from[k];
      if (j >= 0) {
        first[i] = first[j];
        count[i] = count[j];
      }
    });
    b_.wait();
    return total;
  }

  void unpack(int n, const int *to, const double *buffer, int n_first, int second) override
  {
    if (end_ == kUnknown) end_ = pool_[now_].shared + read_one(b_, counts_).shared_used[now_];
    Array<int> offset(n);
    int *at = offset.data(), *first = first_.data(), *count = count_.data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      at[k] =
          to[k] < 0 ? 0 : static_cast<int>(buffer[place_in_message(buffer, k, n_first, second)]);
    });
    const std::size_t total = numbered(b_.exclusive_scan(at, n));
    extend(end_ + total);
    Pool &pool = pool_[now_];
    Spring *springs = pool.springs.data();
    Real *extra = pool.extra.data();
    const int n_extra = traits_.n_extra, begin = static_cast<int>(end_);
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const int i = to[k];
      if (i < 0) return;
      const double *from = buffer + place_in_message(buffer, k, n_first, second);
      first[i] = begin + at[k];
      count[i] = static_cast<int>(*from++);
      for (int c = 0; c < count[i]; c++) {
        const std::size_t target = std::size_t(first[i]) + c;
        from = unpack_spring(from, springs[target]);
        for (int e = 0; e < n_extra; e++) extra[target * n_extra + e] = *from++;
      }
    });
    b_.wait();
    end_ += total;
  }

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

  static int numbered(std::int64_t n)
  {
    return countable_here(n, "numbers of springs in one process", "use more processes");
  }
  int per_spring() const { return kPackedSpring + traits_.n_extra; }

  std::size_t offsets(std::size_t n, int *to)
  {
    copy_all(b_, count_.data(), to, n);
    return numbered(b_.exclusive_scan(to, n));
  }

  // Extends the pool to n springs, and keeps the present ones.
  void extend(std::size_t n)
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
    numbered(n);
    Pool pool;
    if (traits_.history) pool.springs = Array<Spring>(n);
    pool.extra = Array<Real>(traits_.history ? n * traits_.n_extra : 0);
    if (traits_.contacts) pool.contacts = Array<StepContact>(n);
    pool.size = n;
    return pool;
  }

  B &b_;
  LawTraits traits_;
  StepCounts *counts_;
  Array<int> first_, count_;
  Pool pool_[2];
  int now_ = 0, written_ = 0;    // the pool that steps read, and the one that the last step wrote
  std::size_t n_candidates_ = 0, wanted_ = 0;
  std::size_t end_ = 0;    // end of the used places in the pool that is read
};

}    // namespace lsdcd
