// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "bodies/collide_on.h"

namespace lsdcd {

std::unique_ptr<BodyCollision> make_cuda_body_collision()
{
  return std::make_unique<BodyCollisionOn<CudaBackend>>(CudaBackend());
}

}    // namespace lsdcd
