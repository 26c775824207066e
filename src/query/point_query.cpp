// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "query/point_query.h"

#include "backend/backend_cpu.h"
#include "mesh/welded_mesh.h"
#include "query/cell_query_cpu.h"
#include "query/radius_error.h"

#include <algorithm>

namespace lsdcd {

TriangleTable::TriangleTable(const WeldedMesh &mesh) :
    of_face(mesh.face_facet.begin(), mesh.face_facet.end()),
    of_edge(mesh.edges.size(), kNoTriangle), of_vertex(mesh.vertices.size(), kNoTriangle)
{
  for (std::size_t f = 0; f < mesh.faces.size(); f++)
    for (int k = 0; k < 3; k++) {
      std::uint32_t &edge = of_edge[mesh.face_edges[f][k]], &vertex = of_vertex[mesh.faces[f][k]];
      edge = std::min(edge, of_face[f]);
      vertex = std::min(vertex, of_face[f]);
    }
}

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
