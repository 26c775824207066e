// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A point in the work of a stream of an NVIDIA GPU.
#pragma once

#include "backend/cuda_check.h"

#include <cuda_runtime.h>

namespace lsdcd {

class CudaEvent {
 public:
  CudaEvent() = default;
  ~CudaEvent()
  {
    if (event_) cudaEventDestroy(event_);
  }
  CudaEvent(const CudaEvent &) = delete;
  CudaEvent &operator=(const CudaEvent &) = delete;

  void record(cudaStream_t stream)
  {
    if (!event_)
      cuda_check(cudaEventCreateWithFlags(&event_, cudaEventDisableTiming), "creating an event");
    cuda_check(cudaEventRecord(event_, stream), "recording an event");
  }
  // Work that `stream` gets from now on runs once this event is reached. One that was never recorded is.
  void hold(cudaStream_t stream) const
  {
    if (event_) cuda_check(cudaStreamWaitEvent(stream, event_, 0), "ordering two streams");
  }
  void wait() const
  {
    if (event_) cuda_check(cudaEventSynchronize(event_), "running on the device");
  }

 private:
  cudaEvent_t event_ = nullptr;
};

}    // namespace lsdcd
