// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/point_answers.h"

#include "backend/backend_cpu.h"
#include "base/input_error.h"
#include "engine/engine.h"
#include "mesh/meets_itself.h"
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

SideKind sides_of(const WeldedMesh &mesh, bool estimate)
{
  return has_inside(mesh) ? SideKind::exact : estimate ? SideKind::estimated : SideKind::none;
}

class CpuAnswers : public PointAnswers {
 public:
  CpuAnswers(const WeldedMesh &mesh, Real cutoff, const ProgressListener &progress) :
      cutoff_(cutoff), names_(mesh), tree_(mesh, names_, progress), sides_(mesh)
  {
    if (cutoff > 0) boxes_.emplace(tree_, mesh, cutoff, progress);
    report.bytes = bytes_of(&tree_, boxes_ ? &*boxes_ : nullptr);
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
    query_with_sides(tree_, boxes_ ? &*boxes_ : nullptr, sides_, io.radius, io);
    if (sides == SideKind::estimated) estimate(sides_, points, a);
  }

 private:
  Real cutoff_;
  TriangleTable names_;
  TriangleTree tree_;
  std::optional<CutoffBoxes> boxes_;
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
  CudaAnswers(const WeldedMesh &mesh, Real cutoff, const ProgressListener &progress) :
      cutoff_(cutoff), sides_(mesh),
      sides_by_normals_(mesh.report.closed && mesh.report.oriented && meets_itself(mesh).pairs == 0)
  {
    const TriangleTable names(mesh);
    const TriangleTree tree(mesh, names, progress);
    query_ = copy_to_cuda(tree)->query_on(nullptr);
    report.bytes = tree.bytes();
    report.device = current_cuda_name();
  }
  void answer(const PointBlock &points, AnswerBlock &a) override
  {
    const std::size_t n = points.size();
    a.resize(n, sides);
    if (n == 0) return;
    points_.take(points.xyz);
    PointArrays<double> io;
    io.n = n;
    io.radius = cutoff_ > 0 ? cutoff_ : kAnyDistance;
    io.points = packed<const double>(points_.of(3 * n));
    io.distance = {distance_.of(n), 1};
    io.closest = packed(closest_.of(3 * n));
    io.triangle = triangle_.of(n);
    io.feature = feature_.of(n);
    if (sides_by_normals_) io.side = side_.of(n);
    query_->enqueue(io);
    check(cudaStreamSynchronize(nullptr), "answering");
    distance_.give(a.distance);
    closest_.give(a.closest);
    triangle_.give(a.triangle);
    feature_.give(a.feature);
    if (sides_by_normals_)
      side_.give(a.side);
    else
      std::fill(a.side.begin(), a.side.end(), std::int8_t(0));
    if (sides == SideKind::exact)
      fill_sides(sides_, n, packed<const double>(points.xyz.data()), a.side.data());
    if (sides == SideKind::estimated) estimate(sides_, points, a);
  }

 private:
  Real cutoff_;
  PointSides sides_;
  bool sides_by_normals_;
  std::unique_ptr<StreamQuery> query_;
  DeviceArray<double> points_, distance_, closest_;
  DeviceArray<std::uint32_t> triangle_, feature_;
  DeviceArray<std::int8_t> side_;
};

#endif

}    // namespace

std::unique_ptr<PointAnswers> make_point_answers(const WeldedMesh &mesh, Real cutoff,
                                                 const std::string &device, bool estimate,
                                                 const ProgressListener &progress)
{
  std::string why;
  const bool on_cuda = device != "cpu" && cuda_available(&why);
  if (device == "cuda" && !on_cuda)
    throw InputError("--device cuda: " + why + "; use --device cpu");
  const auto start = std::chrono::steady_clock::now();
  std::unique_ptr<PointAnswers> made;
#if defined(LSDCD_HAVE_CUDA)
  if (on_cuda) made = std::make_unique<CudaAnswers>(mesh, cutoff, progress);
#endif
  if (!made) made = std::make_unique<CpuAnswers>(mesh, cutoff, progress);
  made->sides = sides_of(mesh, estimate);
  made->report.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return made;
}

}    // namespace lsdcd
