// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// How many threads this process may use.
#pragma once

#include <cstdlib>

#if defined(_OPENMP)
#include <omp.h>
#endif

namespace lsdcd {

// Were threads asked for? They are where OMP_NUM_THREADS is set, and by a host code that
// has chosen a number itself.
inline bool &threads_asked_for()
{
  static bool asked = std::getenv("OMP_NUM_THREADS") != nullptr;
  return asked;
}

// As many as OpenMP has where they were asked for. Otherwise one: with several MPI
// processes on a node, all the cores for each of them would be far too many.
inline int threads()
{
#if defined(_OPENMP)
  return threads_asked_for() ? omp_get_max_threads() : 1;
#else
  return 1;
#endif
}

// While it lives, this thread works alone.
class OneThread {
#if defined(_OPENMP)
 public:
  OneThread()
  {
    omp_set_num_threads(1);
  }
  ~OneThread()
  {
    omp_set_num_threads(before_);
  }
  OneThread(const OneThread &) = delete;
  OneThread &operator=(const OneThread &) = delete;

 private:
  int before_ = omp_get_max_threads();
#endif
};

}    // namespace lsdcd
