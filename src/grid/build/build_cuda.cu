// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "grid/build/build_grid.h"

namespace lsdcd {

TriangleGrid build_grid_cuda(const WeldedMesh &mesh, const GridSettings &settings)
{
  return build_grid_on(CudaBackend(), mesh, settings);
}

}    // namespace lsdcd
