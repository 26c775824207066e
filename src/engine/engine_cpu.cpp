// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "engine/broad_phase/selection_cpu.h"
#include "engine/engine_on.h"
#include "engine/step/compile_law.h"

namespace lsdcd {

template class EngineOn<CpuBackend>;

std::unique_ptr<WallEngine> make_cpu_engine(const EngineSettings &settings)
{
  return std::make_unique<EngineOn<CpuBackend>>(settings, law_for<CpuBackend>(settings),
                                                CpuBackend());
}

}    // namespace lsdcd
