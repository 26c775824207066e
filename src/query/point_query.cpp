// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/point_query.h"

#include "backend/backend_cpu.h"
#include "mesh/welded_mesh.h"
#include "query/cell_query_cpu.h"
#include "query/radius_error.h"

namespace lsdcd {

template <class T>
void query_grid(const CpuGrid &grid, const TriangleTable &names, const PointArrays<T> &io)
{
  std::uint64_t too_large = 0;
  CpuBackend b;
  with_point_work(grid.view, grid.table, io, names.view(), &too_large,
                  [&](const auto &work) { CellQueryCpu().run(b, io.n, work); });
  if (too_large != 0) throw_bad_radius("point", ~too_large, io.radii[~too_large], grid.view.cutoff);
}
template void query_grid(const CpuGrid &, const TriangleTable &, const PointArrays<float> &);
template void query_grid(const CpuGrid &, const TriangleTable &, const PointArrays<double> &);

}    // namespace lsdcd
