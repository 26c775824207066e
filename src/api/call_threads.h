// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How many threads a call has.
#pragma once

#include "api/c_border.h"
#include "backend/threads.h"

#include <string>

#include <pthread.h>

namespace lsdcd {

#if defined(_OPENMP)
// OpenMP reuses a thread's helpers from one call to the next. A child of fork() has none of them, and libgomp would
// wait for them for ever. So they end before a fork, and both processes start new ones when they need some.
inline void end_threads_before_forks()
{
  static const int registered =
      pthread_atfork([] { omp_pause_resource_all(omp_pause_hard); }, nullptr, nullptr);
  (void) registered;
}
#endif

// While it lives, work of this thread uses n threads; 0: as many as OMP_NUM_THREADS says, or one. Its
// destructor restores the caller's number. Throws ApiError where that is more than a process can have.
class CallThreads {
#if defined(_OPENMP)
 public:
  explicit CallThreads(int n)
  {
    end_threads_before_forks();
    // Now threads() returns OpenMP's number, which each thread has for itself.
    static const int usual = [] {
      const int before = threads();
      threads_asked_for() = true;
      return before;
    }();
    if (n == 0 && usual > kMostThreads)
      throw ApiError(LSDCD_ERROR_ARGUMENT,
                     "OMP_NUM_THREADS asks for " + std::to_string(usual) + " threads; it is " +
                         std::to_string(kMostThreads) +
                         " at most: set it to the number of cores, or give `threads`");
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
