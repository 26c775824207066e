// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "on_cuda.h"

#include "backend/backend_cuda.h"
#include "query/point_query.h"

#include "lsdcd.h"

#include <algorithm>
#include <memory>
#include <stdexcept>

namespace lsdcd {

double cuda_copy_gb_s()
{
  constexpr std::size_t kBytes = std::size_t(1) << 31;    // forty times an L2 cache
  CudaBackend b;
  CudaBackend::Array<char> from(kBytes), to(kBytes);
  cuda_check(cudaMemset(from.data(), 1, kBytes), "clearing memory");
  double least = 1e300;
  for (int k = 0; k < 12; k++)    // the first ones warm up
    least = std::min(least, b.milliseconds([&] {
      cuda_check(
          cudaMemcpyAsync(to.data(), from.data(), kBytes, cudaMemcpyDeviceToDevice, b.stream),
          "copying on the device");
    }));
  return 2 * double(kBytes) / least / 1e6;
}

std::vector<double> cuda_tree_ms(const TriangleTree &tree, const std::vector<Sphere> &points,
                                 int repeats, std::vector<double> &distance)
{
  CudaBackend b;
  const auto on_gpu = from_cpu(b, points);
  CudaBackend::Array<double> out(points.size());
  PointArrays<double> io;
  io.n = points.size();
  io.points = {&on_gpu.data()->x, 4, 1};
  io.radius = points[0].r;
  io.distance = {out.data(), 1};
  const auto query = copy_to_cuda(tree)->query_on(nullptr);
  query->enqueue(io);    // warms up
  std::vector<double> ms;
  for (int k = 0; k < repeats; k++) ms.push_back(b.milliseconds([&] { query->enqueue(io); }));
  distance = to_cpu(b, out, points.size());
  return ms;
}

std::vector<double> cuda_query_ms(const lsdcd_grid *grid, lsdcd_query q, std::size_t bytes,
                                  int repeats)
{
  CudaBackend b;
  const std::size_t n = q.n;
  CudaBackend::Array<char> points(4 * n * bytes), distance(q.distance ? n * bytes : 0);
  CudaBackend::Array<std::uint8_t> status(n);
  b.copy_in(static_cast<const char *>(q.points), points.data(), points.size());
  char *const on_cpu = static_cast<char *>(q.distance);
  std::uint8_t *const status_on_cpu = q.status;
  q.points = points.data();
  if (q.radii) q.radii = points.data() + 3 * bytes;
  if (q.distance) q.distance = distance.data();
  q.status = status.data();
  lsdcd_stream *stream = nullptr;
  const auto check = [](int code) {
    if (code != LSDCD_OK) throw std::runtime_error(lsdcd_last_error());
  };
  check(lsdcd_stream_open(grid, b.stream, &stream));
  const std::unique_ptr<lsdcd_stream, void (*)(lsdcd_stream *)> owned(stream, lsdcd_stream_free);
  check(lsdcd_query_stream(stream, &q));    // warms up
  std::vector<double> ms;
  for (int k = 0; k < repeats; k++)
    ms.push_back(b.milliseconds([&] { check(lsdcd_query_stream(stream, &q)); }));
  if (on_cpu) b.copy_out(distance.data(), on_cpu, distance.size());
  b.copy_out(status.data(), status_on_cpu, n);
  b.wait();
  return ms;
}

double cuda_brute_force_ms(const TriangleGrid &grid, std::size_t n, std::size_t stride)
{
  CudaBackend b;
  return brute_force_ms(b, grid, n, stride);
}

}    // namespace lsdcd
