// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cpu.h"
#include "grid/build/build_grid.h"

namespace lsdcd {

#if defined(LSDCD_HAVE_CUDA)
TriangleGrid build_grid_cuda(const WeldedMesh &mesh, const AnyGridSettings &settings);
#endif

TriangleGrid build_any_grid(const WeldedMesh &mesh, const AnyGridSettings &settings, bool on_cuda)
{
#if defined(LSDCD_HAVE_CUDA)
  if (on_cuda) return build_grid_cuda(mesh, settings);
#else
  if (on_cuda) throw InputError("this build has no CUDA engine; use device cpu");
#endif
  return build_grid_on(CpuBackend(), mesh, settings);
}

}    // namespace lsdcd
