// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Pairs of spheres and meshes checked on a GPU.
#include "support/properties.h"

#include "backend/backend_cuda.h"

#include <cstring>

namespace lsdcd {

namespace {

// Memory that both sides read: the checker sees the very block of the host.
struct Managed {
  char *data = nullptr;
  explicit Managed(std::size_t bytes)
  {
    cuda_check(cudaMallocManaged(&data, bytes > 0 ? bytes : 1), "allocating managed memory");
  }
  ~Managed() { cudaFree(data); }
};

// A mesh of the host and its grid, where both sides read them.
template <class T>
struct ManagedMesh {
  Managed block, triangles, corners;
  ManagedMesh(const TriangleGrid &grid, PairMesh<T> &mesh) :
      block(flat_bytes(grid)), triangles(mesh.n_triangles * sizeof(*mesh.triangle)),
      corners(3 * mesh.n_triangles * sizeof(Vec3))
  {
    flatten(grid, block.data);
    std::memcpy(triangles.data, mesh.triangle, mesh.n_triangles * sizeof(*mesh.triangle));
    std::memcpy(corners.data, mesh.corners, 3 * mesh.n_triangles * sizeof(Vec3));
    mesh.grid = flat_view(block.data);
    mesh.triangle = reinterpret_cast<LongTriangle<T> *>(triangles.data);
    mesh.corners = reinterpret_cast<Vec3 *>(corners.data);
  }
};

struct Counts {
  unsigned long long touching, missed, not_there, wrong, bad, error_bits, first;
};

}    // namespace

PairTotals check_pairs_on_cuda(const TriangleGrid &grid, PairMesh<DoubleDouble> mesh, long n)
{
  CudaBackend backend;
  const ManagedMesh<DoubleDouble> managed(grid, mesh);
  Managed counts(sizeof(Counts));
  Counts *total = reinterpret_cast<Counts *>(counts.data);
  *total = {0, 0, 0, 0, 0, 0, ~0ull};

  backend.for_each(
      n,
      [=] __device__(std::size_t i) {
        const PairResult r = check_pair<64, 12>(mesh, i);
        if (r.touches) atomicAdd(&total->touching, 1ull);
        if (r.missed) atomicAdd(&total->missed, 1ull);
        if (r.not_there) atomicAdd(&total->not_there, 1ull);
        if (r.wrong) atomicAdd(&total->wrong, 1ull);
        if (r.bad) atomicAdd(&total->bad, 1ull);
        if (r.missed || r.not_there || r.wrong || r.bad)
          atomicMin(&total->first, static_cast<unsigned long long>(i));
        // Bits of positive doubles are ordered as they are.
        if (r.error > 0)
          atomicMax(&total->error_bits,
                    static_cast<unsigned long long>(__double_as_longlong(r.error)));
      },
      128);
  backend.wait();
  PairTotals out;
  out.pairs = n;
  out.touching = static_cast<long>(total->touching);
  out.missed = static_cast<long>(total->missed);
  out.not_there = static_cast<long>(total->not_there);
  out.wrong = static_cast<long>(total->wrong);
  out.bad = static_cast<long>(total->bad);
  std::memcpy(&out.error, &total->error_bits, sizeof out.error);
  if (total->first != ~0ull) out.first_sphere = static_cast<long>(total->first);
  return out;
}

std::vector<Walks> check_walks_on_cuda(const TriangleGrid &grid, WalkMesh<DoubleDouble> mesh,
                                       long n)
{
  CudaBackend backend;
  const ManagedMesh<DoubleDouble> managed(grid, mesh.pairs);
  Managed features(mesh.n_features * sizeof(FeatureCode)), walks(n * sizeof(Walks));
  std::memcpy(features.data, mesh.features, mesh.n_features * sizeof(FeatureCode));
  mesh.features = reinterpret_cast<FeatureCode *>(features.data);
  Walks *to = reinterpret_cast<Walks *>(walks.data);
  backend.for_each(
      n, [=] __device__(std::size_t i) { to[i] = check_walk(mesh, i); }, 128);
  backend.wait();
  return {to, to + n};
}

}    // namespace lsdcd
