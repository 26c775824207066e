// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Preloaded, makes a process that waits for another one sleep. Open MPI calls sched_yield() while it waits; Linux lets such a process
// go on at once as long as others that wait do the same, so that more processes than cores take ten to forty times as long.
#include <sched.h>
#include <time.h>

extern "C" __attribute__((visibility("default"))) int sched_yield() noexcept
{
  const timespec least = {0, 1000};    // a kernel makes some 50 microseconds of it
  nanosleep(&least, nullptr);
  return 0;
}
