// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "motion/step_clock.h"

namespace lsdcd {

void StepClock::advance(const Step &to)
{
  const std::int64_t elapsed = to.kind == Step::setup ? 0 : 1;
  if (to.kind != Step::snapshot && (to.number != last_step + elapsed || to.dt != dt)) {
    base = now();
    base_step = to.number - elapsed;
  }
  dt = to.dt;
  last_step = to.number;
}

}    // namespace lsdcd
