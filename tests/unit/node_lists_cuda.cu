// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lists and records of a mesh whose nodes move, made on a GPU.
#include "support/moved_records.h"
#include "support/node_lists.h"

#include "backend/backend_cuda.h"

namespace lsdcd {

NodeLists node_lists_on_cuda(const WeldedMesh &mesh, const MovingGridSettings &settings)
{
  return node_lists_by(CudaBackend(), mesh, settings);
}

MeshFeatures moved_records_on_cuda(const WeldedMesh &mesh, const WeldedMesh &after)
{
  return moved_records_by(CudaBackend(), mesh, after);
}

}    // namespace lsdcd
