#include "engine/backend_cuda.h"
#include "grid/build_grid.h"

namespace lsdcd {

TriangleGrid build_grid_cuda(const WallMesh &mesh, const GridSettings &settings)
{
  return build_grid_on(CudaBackend(), mesh, settings);
}

}    // namespace lsdcd
