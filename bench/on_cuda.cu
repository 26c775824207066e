// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "on_cuda.h"

#include "backend/backend_cuda.h"

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

double cuda_query_ms(const lsdcd_grid *grid, lsdcd_query q)
{
  CudaBackend b;
  CudaBackend::Array<double> points(4 * q.n), distance(q.n);
  double *const on_cpu = static_cast<double *>(q.distance);
  b.copy_in(static_cast<const double *>(q.points), points.data(), points.size());
  q.points = points.data();
  q.distance = distance.data();
  lsdcd_stream *stream = nullptr;
  const auto check = [](int code) {
    if (code != LSDCD_OK) throw std::runtime_error(lsdcd_last_error());
  };
  check(lsdcd_stream_open(grid, b.stream, &stream));
  const std::unique_ptr<lsdcd_stream, void (*)(lsdcd_stream *)> owned(stream, lsdcd_stream_free);
  const auto ask = [&] { check(lsdcd_query_stream(stream, &q)); };
  ask();
  const double ms = b.milliseconds(ask);
  b.copy_out(distance.data(), on_cpu, distance.size());
  b.wait();
  return ms;
}

}    // namespace lsdcd
