// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "engine/step/law_for.h"
#include "engine/step/run_step_cuda.h"

namespace lsdcd {

template CompiledLaw<CudaBackend> law_for<CudaBackend>(const EngineSettings &);

}    // namespace lsdcd
