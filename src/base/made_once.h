// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// An object that the first thread to ask for it makes.
#pragma once

#include <atomic>
#include <memory>
#include <mutex>

namespace lsdcd {

template <class T>
class MadeOnce {
 public:
  // make() returns a std::unique_ptr<T>. An exception goes to the caller, and the next caller makes it.
  template <class Make>
  const T &get(const Make &make) const
  {
    const T *made = made_.load(std::memory_order_acquire);
    if (made) return *made;
    const std::lock_guard<std::mutex> alone(making_);
    if (!owned_) {
      owned_ = make();
      made_.store(owned_.get(), std::memory_order_release);
    }
    return *owned_;
  }
  const T *made() const { return made_.load(std::memory_order_acquire); }    // null: not yet

 private:
  mutable std::mutex making_;
  mutable std::unique_ptr<const T> owned_;
  mutable std::atomic<const T *> made_{nullptr};
};

}    // namespace lsdcd
