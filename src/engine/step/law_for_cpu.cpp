// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "engine/step/law_for.h"
#include "engine/step/run_step_cpu.h"

namespace lsdcd {

template CompiledLaw<CpuBackend> law_for<CpuBackend>(const EngineSettings &);

}    // namespace lsdcd
