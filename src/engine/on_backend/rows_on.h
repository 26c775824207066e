// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows that follow grains, in the memory of a backend, and the kernels that write them to messages and read them there. The type Rows has
//   size()               returns how many numbers a row has
//   write(place, to)     writes the row of a place
//   read(place, from)    reads the row of a place
#pragma once

#include "backend/backend.h"
#include "base/countable.h"
#include "base/packed_integer.h"
#include "engine/resident_rows.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Returns the k-th of some grains, or of all grains if `grains` is null.
LSDCD_FN int kth_grain(const int *grains, std::size_t k)
{
  return grains ? grains[k] : static_cast<int>(k);
}

struct ReadInt {
  const int *at;
  LSDCD_FN int operator()(std::size_t i) const { return at[i]; }
};

struct SizeOfPacked {
  const int *which, *count;
  int row_size;
  std::int64_t *to;

  LSDCD_FN void operator()(std::size_t k) const
  {
    to[k] = 1 + std::int64_t(row_size) * count[kth_grain(which, k)];
  }
};

template <class Rows>
struct PackRows {
  std::size_t n;
  const int *which, *from;    // null: all grains, which stay
  const std::int64_t *at;
  int *first, *count;
  Rows rows;
  double *buffer;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = kth_grain(which, k), size = rows.size();
    const std::int64_t begin = static_cast<std::int64_t>(n) + at[k];
    buffer[k] = as_double(begin);
    double *to = buffer + begin;
    *to++ = count[i];
    for (int c = 0; c < count[i]; c++, to += size) rows.write(std::size_t(first[i]) + c, to);
    if (!from) return;
    const int j = from[k];
    if (j >= 0) {
      first[i] = first[j];
      count[i] = count[j];
    }
    count[j >= 0 ? j : i] = 0;    // the grain no longer exists
  }
};

struct CountUnpacked {
  const int *to;
  const double *buffer;
  int n_first, second;
  std::int64_t *count;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const bool arrives = kth_grain(to, k) >= 0;
    count[k] = arrives ? static_cast<int>(buffer[place_in_message(buffer, k, n_first, second)]) : 0;
  }
};

template <class Rows>
struct UnpackRows {
  const int *to;
  const double *buffer;
  int n_first, second;
  const std::int64_t *at;
  std::int64_t begin;
  int *first, *count;
  Rows rows;

  LSDCD_FN void operator()(std::size_t k) const
  {
    const int i = kth_grain(to, k), size = rows.size();
    if (i < 0) return;
    const double *from = buffer + place_in_message(buffer, k, n_first, second);
    first[i] = static_cast<int>(begin + at[k]);
    count[i] = static_cast<int>(*from++);
    for (int c = 0; c < count[i]; c++, from += size) rows.read(std::size_t(first[i]) + c, from);
  }
};

template <class B, class Rows>
class RowsOn : public ResidentRows {
 public:
  template <class T>
  using Array = typename B::template Array<T>;

  // `things`: what rows are of, in errors. The backend must outlive this object.
  RowsOn(B &backend, const char *things) : b_(backend), things_(things) {}

  int *first() override { return first_.data(); }
  int *count() override { return count_.data(); }

  void grow(int n_grains) override
  {
    const std::size_t n = n_grains, before = count_.size();
    if (n <= before) return;
    Array<int> first(with_spare(n)), count(with_spare(n));
    put_all(b_, first.data(), first.size(), 0);
    put_all(b_, count.data(), count.size(), 0);
    copy_all(b_, first_.data(), first.data(), before);
    copy_all(b_, count_.data(), count.data(), before);
    b_.wait();
    first_ = std::move(first);
    count_ = std::move(count);
  }

  void to_cpu(KeptRows &to, int n) override
  {
    grow(n);
    const auto size = static_cast<std::size_t>(n + find_places(n, nullptr));
    Array<double> message(size);
    write(n, nullptr, nullptr, message.data());
    const std::vector<double> all = lsdcd::to_cpu(b_, message, size);
    to.begin(rows().size());
    to.grow(n);
    for (int i = 0; i < n; i++) to.unpack(i, all.data() + as_integer(all[i]));
  }

  void from_cpu(const KeptRows &from, int n) override
  {
    std::vector<double> message(static_cast<std::size_t>(n));
    for (int i = 0; i < n; i++) {
      const std::size_t at = message.size();
      message[i] = as_double(static_cast<std::int64_t>(at));
      message.resize(at + from.packed_size(i));
      from.pack(i, message.data() + at);
    }
    grow(n);
    forget();
    unpack(n, nullptr, lsdcd::from_cpu(b_, message).data(), n, 0);
  }

  int largest_packed_size(int n) override
  {
    grow(n);
    return 1 + rows().size() * b_.template largest<int>(n, ReadInt{count_.data()});
  }

  int pack(int n, const int *which, const int *from, double *buffer) override
  {
    const int size = numbered(n + find_places(n, which));
    write(n, which, from, buffer);
    b_.wait();
    return size;
  }

  void unpack(int n, const int *to, const double *buffer, int n_first, int second) override
  {
    place_.reserve(n);
    b_.for_each(n, CountUnpacked{to, buffer, n_first, second, place_.data()});
    const std::size_t end = end_ + b_.exclusive_scan(place_.data(), n);
    numbered(static_cast<std::int64_t>(end));
    make_room(end);
    b_.for_each(n, UnpackRows<Rows>{to, buffer, n_first, second, place_.data(),
                                    static_cast<std::int64_t>(end_), first_.data(), count_.data(),
                                    rows()});
    b_.wait();
    end_ = end;
  }

  // Forgets the rows of all grains.
  void forget()
  {
    put_all(b_, count_.data(), count_.size(), 0);
    end_ = 0;
  }

  virtual Rows rows() = 0;

 protected:
  // Makes room for n rows, and keeps those before end_.
  virtual void make_room(std::size_t n) = 0;

  int numbered(std::int64_t n) const { return countable_here(n, things_, "use more processes"); }

  B &b_;
  Array<int> first_, count_;
  std::size_t end_ = 0;    // end of the used places

 private:
  // Finds where the numbers of each grain begin behind the offsets of a message. Returns how many numbers there are.
  std::int64_t find_places(int n, const int *which)
  {
    place_.reserve(n);
    b_.for_each(n, SizeOfPacked{which, count_.data(), rows().size(), place_.data()});
    return b_.exclusive_scan(place_.data(), n);
  }
  void write(int n, const int *which, const int *from, double *buffer)
  {
    b_.for_each(n, PackRows<Rows>{static_cast<std::size_t>(n), which, from, place_.data(),
                                  first_.data(), count_.data(), rows(), buffer});
  }

  const char *things_;
  Array<std::int64_t> place_;
};

}    // namespace lsdcd
