// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "pair/pair_engine_on.h"

namespace lsdcd {

std::unique_ptr<PairEngine> make_cpu_pair_engine()
{
  return std::make_unique<PairEngineOn<CpuBackend>>(CpuBackend());
}

}    // namespace lsdcd
