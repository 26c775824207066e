// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "study/sphere_query_on.h"

namespace lsdcd {

std::unique_ptr<SphereQuery> make_cuda_query()
{
  return std::make_unique<SphereQueryOn<CudaBackend>>(CudaBackend());
}

}    // namespace lsdcd
