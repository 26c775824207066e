// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lists of a mesh whose nodes move, built on a GPU.
#include "support/node_lists.h"

#include "backend/backend_cuda.h"

namespace lsdcd {

NodeLists node_lists_on_cuda(const WeldedMesh &mesh, const MovingGridSettings &settings)
{
  return node_lists_by(CudaBackend(), mesh, settings);
}

}    // namespace lsdcd
