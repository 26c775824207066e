// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays where an engine computes, for tests that stand in for a host code with its
// particles there.
#pragma once

#include <cstddef>
#include <vector>

namespace lsdcd {

void *allocate_on(bool cuda, std::size_t bytes);
void free_on(bool cuda, void *at);
void copy_to(bool cuda, void *to, const void *host, std::size_t bytes);
void copy_from(bool cuda, void *host, const void *from, std::size_t bytes);

template <class T>
class DeviceArray {
 public:
  explicit DeviceArray(bool cuda) : cuda_(cuda) {}
  ~DeviceArray() { free_on(cuda_, data_); }
  DeviceArray(const DeviceArray &) = delete;
  DeviceArray &operator=(const DeviceArray &) = delete;

  T *data() { return data_; }
  T *resize(std::size_t n)
  {
    if (n > room_) {
      free_on(cuda_, data_);
      data_ = static_cast<T *>(allocate_on(cuda_, n * sizeof(T)));
      room_ = n;
    }
    return data_;
  }
  T *put(const T *host, std::size_t n)
  {
    resize(n);
    copy_to(cuda_, data_, host, n * sizeof(T));
    return data_;
  }
  T *put(const std::vector<T> &host) { return put(host.data(), host.size()); }
  std::vector<T> get(std::size_t n) const
  {
    std::vector<T> host(n);
    copy_from(cuda_, host.data(), data_, n * sizeof(T));
    return host;
  }

 private:
  bool cuda_;
  T *data_ = nullptr;
  std::size_t room_ = 0;
};

}    // namespace lsdcd
