// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/point_answers.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "engine/wall_engine.h"
#include "grid/flat_grid.h"
#include "query/point_sides.h"

#include <algorithm>
#include <chrono>
#include <optional>

#if defined(LSDCD_HAVE_CUDA)
#include <cuda_runtime_api.h>
#endif

namespace lsdcd {

namespace {

template <class T>
StridedView<T> packed(T *at)
{
  return {at, 3, 1};
}

void estimate(const PointSides &sides, const PointBlock &points, AnswerBlock &a)
{
  estimate_sides(sides, points.size(), packed<const double>(points.xyz.data()),
                 {a.winding.data(), 1}, a.side.data(), nullptr);
}

SideKind sides_of(const WallMesh &mesh, bool estimate)
{
  return has_inside(mesh) ? SideKind::exact : estimate ? SideKind::estimated : SideKind::none;
}

class CpuAnswers : public PointAnswers {
 public:
  CpuAnswers(const WallMesh &mesh, Real cutoff, const ProgressListener &progress) :
      cutoff_(cutoff), names_(mesh), tree_(mesh, names_, progress), sides_(mesh)
  {
    if (cutoff > 0) near_.emplace(tree_, mesh, cutoff, progress);
    report.bytes = bytes_of(&tree_, near_ ? &*near_ : nullptr);
    report.device = CpuBackend().name();
  }
  void answer(const PointBlock &points, AnswerBlock &a) override
  {
    a.resize(points.size(), sides);
    PointArrays<double> io;
    io.n = points.size();
    io.radius = cutoff_ > 0 ? cutoff_ : kAnyDistance;
    io.points = packed(points.xyz.data());
    io.distance = {a.distance.data(), 1};
    io.closest = packed(a.closest.data());
    io.triangle = a.triangle.data();
    io.feature = a.feature.data();
    if (sides == SideKind::exact) io.side = a.side.data();
    answer_with_sides(tree_, near_ ? &*near_ : nullptr, names_, sides_, io.radius, io);
    if (sides == SideKind::estimated) estimate(sides_, points, a);
  }

 private:
  Real cutoff_;
  TriangleTable names_;
  TriangleTree tree_;
  std::optional<NearBoxes> near_;
  PointSides sides_;
};

#if defined(LSDCD_HAVE_CUDA)

void check(cudaError_t status, const char *what)
{
  if (status != cudaSuccess)
    throw InputError(std::string("CUDA, ") + what + ": " + cudaGetErrorString(status) +
                     "; try --device cpu, or a smaller --block");
}

// Memory of the device that grows with what it holds.
template <class T>
class DeviceArray {
 public:
  DeviceArray() = default;
  DeviceArray(const DeviceArray &) = delete;
  DeviceArray &operator=(const DeviceArray &) = delete;
  ~DeviceArray() { cudaFree(at_); }

  T *of(std::size_t n)
  {
    if (n > n_) {
      cudaFree(at_);
      at_ = nullptr;
      n_ = 0;
      check(cudaMalloc(reinterpret_cast<void **>(&at_), n * sizeof(T)), "memory for a block");
      n_ = n;
    }
    return at_;
  }
  void take(const std::vector<T> &from)
  {
    check(cudaMemcpy(of(from.size()), from.data(), from.size() * sizeof(T), cudaMemcpyDefault),
          "copying points");
  }
  void give(std::vector<T> &to)
  {
    check(cudaMemcpy(to.data(), at_, to.size() * sizeof(T), cudaMemcpyDefault), "copying answers");
  }

 private:
  T *at_ = nullptr;
  std::size_t n_ = 0;
};

class CudaAnswers : public PointAnswers {
 public:
  CudaAnswers(const WallMesh &mesh, const TriangleGrid &grid) : sides_(mesh)
  {
    const FlatGrid flat(grid);
    radius_ = flat.view().cutoff;
    query_ = make_stream_query(copy_to_cuda(flat.view(), TriangleTable(mesh)), nullptr);
  }
  void answer(const PointBlock &points, AnswerBlock &a) override
  {
    const std::size_t n = points.size();
    a.resize(n, sides);
    if (n == 0) return;
    points_.take(points.xyz);
    PointArrays<double> io;
    io.n = n;
    io.radius = radius_;
    io.points = packed<const double>(points_.of(3 * n));
    io.distance = {distance_.of(n), 1};
    io.closest = packed(closest_.of(3 * n));
    io.triangle = triangle_.of(n);
    io.feature = feature_.of(n);
    if (sides_by_normals) io.side = side_.of(n);
    query_->answer(io);
    check(cudaStreamSynchronize(nullptr), "answering");
    distance_.give(a.distance);
    closest_.give(a.closest);
    triangle_.give(a.triangle);
    feature_.give(a.feature);
    if (sides_by_normals)
      side_.give(a.side);
    else
      std::fill(a.side.begin(), a.side.end(), std::int8_t(0));
    if (sides == SideKind::exact) fill_sides(sides_, n, points.xyz.data(), a.side.data());
    if (sides == SideKind::estimated) estimate(sides_, points, a);
  }

 private:
  PointSides sides_;
  Real radius_ = 0;
  std::unique_ptr<StreamQuery> query_;
  DeviceArray<double> points_, distance_, closest_;
  DeviceArray<std::uint32_t> triangle_, feature_;
  DeviceArray<std::int8_t> side_;
};

#else

#endif

}    // namespace

std::unique_ptr<PointAnswers> make_point_answers(const WallMesh &mesh, const GridSettings &settings,
                                                 const std::string &device, bool estimate)
{
  std::string why;
  const bool on_cuda =
      (device == "cuda" || (device == "auto" && settings.cutoff > 0)) && cuda_available(&why);
  if (device == "cuda" && !on_cuda)
    throw InputError("--device cuda: " + why + "; use --device cpu");
  if (on_cuda && !(settings.cutoff > 0))
    throw InputError(
        "--device cuda finds distances up to a radius: give --radius, or use --device cpu");
  const auto start = std::chrono::steady_clock::now();
  if (!on_cuda) {
    auto made = std::make_unique<CpuAnswers>(mesh, settings.cutoff, settings.progress);
    made->sides = sides_of(mesh, estimate);
    made->report.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    return made;
  }
#if defined(LSDCD_HAVE_CUDA)
  GridSettings of_grid = settings;
  of_grid.sides = mesh.report.closed && mesh.report.oriented;
  of_grid.purpose = GridPurpose::points;
  const TriangleGrid grid = build_grid(mesh, of_grid, true);
  auto made = std::make_unique<CudaAnswers>(mesh, grid);
  made->sides_by_normals = of_grid.sides && grid.outside != 0;
  made->sides = made->sides_by_normals ? SideKind::exact : sides_of(mesh, estimate);
  made->report = grid.report;
  return made;
#else
  return nullptr;    // there is no CUDA
#endif
}

}    // namespace lsdcd
