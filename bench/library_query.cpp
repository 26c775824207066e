#include "library_query.h"

#include "lsdcd.h"

#if defined(LSDCD_HAVE_CUDA)
#include "on_cuda.h"
#endif

#include <stdexcept>

namespace lsdcd {

namespace {

void check(int code)
{
  if (code != LSDCD_OK) throw std::runtime_error(lsdcd_last_error());
}

}    // namespace

LibraryQuery::LibraryQuery(const TriangleSoup &mesh, Real cell, Real cutoff, bool in_floats,
                           bool cuda) :
    cuda_(cuda),
    spheres_(cuda), distance_(cuda), status_(cuda)
{
  lsdcd_mesh *read = nullptr;
  check(lsdcd_mesh_from_corners(&mesh.corners[0].x, mesh.n_triangles(), -1, &read));
  lsdcd_grid_options options = {};
  options.size = sizeof options;
  options.cutoff = cutoff;
  options.cell = cell;
  options.precision = in_floats ? LSDCD_FLOAT : LSDCD_DOUBLE;
  options.memory = 16e9;
  options.device = cuda ? LSDCD_CUDA : LSDCD_CPU;
  lsdcd_grid *grid = nullptr;
  const int code = lsdcd_grid_build(read, &options, &grid);
  lsdcd_mesh_free(read);
  check(code);
  grid_.reset(grid, [](void *at) { lsdcd_grid_free(static_cast<lsdcd_grid *>(at)); });
  lsdcd_grid_facts facts = {};
  facts.size = sizeof facts;
  check(lsdcd_grid_get_facts(grid, &facts));
  cell_ = facts.cell;
  grid_bytes_ = static_cast<double>(facts.bytes);
  if (!cuda) return;
  lsdcd_stream *stream = nullptr;
  check(lsdcd_stream_open(grid, nullptr, &stream));
  stream_.reset(stream, [](void *at) { lsdcd_stream_free(static_cast<lsdcd_stream *>(at)); });
}

Timing LibraryQuery::time(const Sphere *spheres, std::size_t n, bool with_radii, int repeats)
{
  return time_of(spheres, n, with_radii, repeats, LSDCD_DOUBLE);
}
Timing LibraryQuery::time(const FloatSphere *spheres, std::size_t n, bool with_radii, int repeats)
{
  return time_of(spheres, n, with_radii, repeats, LSDCD_FLOAT);
}

template <class T>
Timing LibraryQuery::time_of(const SphereOf<T> *spheres, std::size_t n, bool with_radii,
                             int repeats, int type)
{
  n_ = n;
  floats_ = type == LSDCD_FLOAT;
  lsdcd_query q = {};
  q.size = sizeof q;
  q.n = n;
  q.type = type;
  q.points = spheres_.put(reinterpret_cast<const char *>(spheres), n * sizeof *spheres);
  q.points_row = 4;
  q.points_column = 1;
  if (with_radii) q.radii = static_cast<const T *>(q.points) + 3;
  q.radii_step = 4;
  q.distance = distance_.resize(n * sizeof(T));
  q.status = status_.resize(n);
#if defined(LSDCD_HAVE_CUDA)
  if (cuda_) {
    const auto ask = [&] {
      check(lsdcd_query_stream(static_cast<lsdcd_stream *>(stream_.get()), &q));
    };
    cuda_milliseconds(ask);
    std::vector<double> ms;
    for (int k = 0; k < repeats; k++) ms.push_back(cuda_milliseconds(ask));
    return timing_of(std::move(ms));
  }
#endif
  return time_it(repeats,
                 [&] { check(lsdcd_query_host(static_cast<lsdcd_grid *>(grid_.get()), &q)); });
}

std::vector<double> LibraryQuery::distances() const
{
  const std::vector<char> raw = distance_.get(n_ * (floats_ ? sizeof(float) : sizeof(double)));
  if (!floats_) {
    const auto *at = reinterpret_cast<const double *>(raw.data());
    return {at, at + n_};
  }
  const auto *at = reinterpret_cast<const float *>(raw.data());
  return {at, at + n_};
}

}    // namespace lsdcd
