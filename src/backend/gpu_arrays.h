// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Arrays of a caller in a GPU's memory, for code that knows nothing of CUDA.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lsdcd {

class GpuArrays {
 public:
  virtual ~GpuArrays() = default;

  virtual int device() const = 0;
  // While `work` runs the device is current, and then the one that was.
  virtual void run(const std::function<void()> &work) const = 0;
  // Throws InputError where an array is neither in the device's memory nor managed. `user`: what takes the array,
  // for the text.
  virtual void check(const void *array, const char *name, const char *user) const = 0;
  // `bytes` bytes, once the stream has done its work so far. Waits.
  virtual void copy_out(const void *from, void *to, std::size_t bytes) const = 0;
  // The other way: from the memory of the host. Waits.
  virtual void copy_in(const void *from, void *to, std::size_t bytes) const = 0;
  virtual void wait() const = 0;
};

// Arrays of the current device, in the order of `stream`, a cudaStream_t of it. Throws InputError in a build
// without CUDA.
std::unique_ptr<GpuArrays> make_gpu_arrays(void *stream);

}    // namespace lsdcd
