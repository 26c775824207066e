// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "library_query.h"

#include "on_cuda.h"

#include <stdexcept>

namespace lsdcd {

namespace {

void check(int code)
{
  if (code != LSDCD_OK) throw std::runtime_error(lsdcd_last_error());
}

}    // namespace

LibraryQuery::LibraryQuery(const TriangleSoup &mesh, const LibraryGrid &wanted) :
    on_cuda_(wanted.on_cuda)
{
  lsdcd_mesh *read = nullptr;
  check(lsdcd_mesh_from_corners(&mesh.corners[0].x, mesh.n_triangles(), -1, &read));
  lsdcd_grid_options options = {};
  options.size = sizeof options;
  options.cutoff = wanted.cutoff;
  options.cell = wanted.cell;
  options.nearest = wanted.nearest;
  options.precision = wanted.in_floats ? LSDCD_FLOAT : LSDCD_DOUBLE;
  if (wanted.cutoff > 0) options.memory = 16e9;    // of cells, which only a cutoff has
  options.device = wanted.on_cuda ? LSDCD_CUDA : LSDCD_CPU;
  lsdcd_grid *grid = nullptr;
  const int code = lsdcd_grid_build(read, &options, &grid);
  lsdcd_mesh_free(read);
  check(code);
  grid_.reset(grid, lsdcd_grid_free);
  lsdcd_grid_facts facts = {};
  facts.size = sizeof facts;
  check(lsdcd_grid_get_facts(grid, &facts));
  cell_ = facts.cell;
}

double LibraryQuery::grid_bytes() const
{
  lsdcd_grid_facts facts = {};
  facts.size = sizeof facts;
  check(lsdcd_grid_get_facts(grid_.get(), &facts));
  return static_cast<double>(facts.bytes);
}

Timing LibraryQuery::time(const Sphere *spheres, std::size_t n)
{
  return time_of(spheres, n, false, true, 1);
}
Timing LibraryQuery::time(const FloatSphere *spheres, std::size_t n)
{
  return time_of(spheres, n, false, true, 1);
}
Timing LibraryQuery::time_spheres(const Sphere *spheres, std::size_t n, bool distance, int repeats)
{
  return time_of(spheres, n, true, distance, repeats);
}
Timing LibraryQuery::time_spheres(const FloatSphere *spheres, std::size_t n, bool distance,
                                  int repeats)
{
  return time_of(spheres, n, true, distance, repeats);
}

template <class T>
Timing LibraryQuery::time_of(const SphereOf<T> *spheres, std::size_t n, bool radii, bool distance,
                             int repeats)
{
  std::vector<T> found(distance ? n : 0);
  status_.resize(n);
  lsdcd_query q = {};
  q.size = sizeof q;
  q.n = n;
  q.type = sizeof(T) == sizeof(float) ? LSDCD_FLOAT : LSDCD_DOUBLE;
  q.points = spheres;
  q.points_row = 4;
  q.points_column = 1;
  if (radii) {
    q.radii = &spheres->r;
    q.radii_step = 4;
  }
  if (distance) q.distance = found.data();
  q.status = status_.data();
  Timing time = {};
#if defined(LSDCD_HAVE_CUDA)
  if (on_cuda_) time = timing_of(cuda_query_ms(grid_.get(), q, sizeof(T), repeats));
#endif
  if (!on_cuda_) time = time_it(repeats, [&] { check(lsdcd_query_host(grid_.get(), &q)); });
  distance_.assign(found.begin(), found.end());
  return time;
}

}    // namespace lsdcd
