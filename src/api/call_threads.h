// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How many threads a call has.
#pragma once

#include "backend/threads.h"

namespace lsdcd {

// While it lives, work of this thread uses n threads; 0: as many as OMP_NUM_THREADS says, or one. Its
// destructor restores the caller's number.
class CallThreads {
#if defined(_OPENMP)
 public:
  explicit CallThreads(int n)
  {
    // Now threads() returns OpenMP's number, which each thread has for itself.
    static const int usual = [] {
      const int before = threads();
      threads_asked_for() = true;
      return before;
    }();
    omp_set_num_threads(n > 0 ? n : usual);
  }
  ~CallThreads()
  {
    omp_set_num_threads(before_);
  }

 private:
  int before_ = omp_get_max_threads();
#else
 public:
  explicit CallThreads(int) {}
#endif

 public:
  CallThreads(const CallThreads &) = delete;
  CallThreads &operator=(const CallThreads &) = delete;
};

}    // namespace lsdcd
