// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An array in one kind of memory, owned.
#pragma once

#include <cstddef>
#include <utility>

namespace lsdcd {

// Returns n and an eighth more: an array that grows little by little is then seldom made again.
constexpr std::size_t with_spare(std::size_t n)
{
  return n + n / 8;
}

// Memory has static allocate(bytes) and free(pointer). Contents are undefined until
// written; moving swaps.
template <class T, class Memory>
class OwnedArray {
 public:
  OwnedArray() = default;
  explicit OwnedArray(std::size_t n) :
      data_(n > 0 ? static_cast<T *>(Memory::allocate(n * sizeof(T))) : nullptr), n_(n)
  {
  }
  ~OwnedArray()
  {
    if (data_) Memory::free(data_);    // a GPU's driver is asked even of nothing
  }
  OwnedArray(OwnedArray &&other) noexcept { swap(other); }
  OwnedArray &operator=(OwnedArray &&other) noexcept
  {
    swap(other);
    return *this;
  }
  OwnedArray(const OwnedArray &) = delete;
  OwnedArray &operator=(const OwnedArray &) = delete;

  // Allocates it again, with_spare(n) long, where it is shorter than n: its contents are lost then.
  void reserve(std::size_t n)
  {
    if (n_ < n) *this = OwnedArray(with_spare(n));
  }

  T *data() { return data_; }
  const T *data() const { return data_; }
  std::size_t size() const { return n_; }

 private:
  void swap(OwnedArray &other)
  {
    std::swap(data_, other.data_);
    std::swap(n_, other.n_);
  }
  T *data_ = nullptr;
  std::size_t n_ = 0;
};

}    // namespace lsdcd
