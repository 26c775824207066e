// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "grid/build/build_grid.h"

namespace lsdcd {

TriangleGrid build_grid_cuda(const WeldedMesh &mesh, const AnyGridSettings &settings)
{
  // A build takes more for a while than its grid has. The host may need that memory for its own spheres.
  struct GiveBack {
    ~GiveBack() { CudaBackend::PooledMemory::give_back(); }
  } after_the_build;
  return build_grid_on(CudaBackend(), mesh, settings);
}

}    // namespace lsdcd
