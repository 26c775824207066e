#include "grid/build/build_grid.h"
#include "backend/backend_cuda.h"

namespace lsdcd {

TriangleGrid build_grid_cuda(const WallMesh &mesh, const GridSettings &settings)
{
  return build_grid_on(CudaBackend(), mesh, settings);
}

}    // namespace lsdcd
