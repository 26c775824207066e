// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "engine/step/law_for.h"
#include "engine/step/run_step_gpu.h"

namespace lsdcd {

template CompiledLaw<CudaBackend> law_for<CudaBackend>(const EngineSettings &);

}    // namespace lsdcd
