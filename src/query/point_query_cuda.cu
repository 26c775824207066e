// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/backend_cuda.h"
#include "backend/cuda_device.h"
#include "query/cell_query_gpu.h"
#include "query/point_query.h"
#include "query/radius_check.h"

#include "grid/lookup/grid_on.h"

namespace lsdcd {

class DeviceGrid : public DeviceCopy, public GridOn<CudaBackend> {
 public:
  DeviceGrid(CudaBackend b, const ViewOf<QueryGrid> &grid, const TriangleTable &names) :
      GridOn(b, grid, true)
  {
    of_face_ = from_cpu(b, names.of_face);
    of_edge_ = from_cpu(b, names.of_edge);
    of_vertex_ = from_cpu(b, names.of_vertex);
    this->names = names.view();
    this->names.of_face = of_face_.data();
    this->names.of_edge = of_edge_.data();
    this->names.of_vertex = of_vertex_.data();
  }

  std::unique_ptr<StreamQuery> query_on(void *stream) const override;

  TriangleNames names;

 private:
  CudaBackend::Array<std::uint32_t> of_face_, of_edge_, of_vertex_;
};

std::shared_ptr<const DeviceCopy> copy_to_cuda(const ViewOf<QueryGrid> &grid,
                                               const TriangleTable &names)
{
  return std::make_shared<const DeviceGrid>(CudaBackend(), grid, names);
}

int current_cuda_device()
{
  return current_gpu();
}

std::string current_cuda_name()
{
  return CudaBackend().name();
}

void check_on_device(int device, const void *array, const char *what)
{
  if (array) check_array(array, what, device, "a stream's query", "the grid's copy");
}

class CudaStreamQuery : public StreamQuery {
 public:
  CudaStreamQuery(std::shared_ptr<const DeviceGrid> grid, void *stream) :
      grid_(std::move(grid)), b_(stream), radii_(grid_->view.cutoff)
  {
    way_.template reserve<Sphere>(1);
  }
  ~CudaStreamQuery() override { wait_for_gpu(grid_->device); }

  void enqueue(const PointArrays<float> &io) override { enqueue_any(io); }
  void enqueue(const PointArrays<double> &io) override { enqueue_any(io); }

  // Public because nvcc takes no device lambda from a private function.

  template <class T>
  void enqueue_any(const PointArrays<T> &io)
  {
    const OnGpu current(grid_->device);
    const auto check = radii_.template begin<SphereOf<T>>(b_);
    if (io.only_distance())
      distances_alone(io, check);
    else
      with_point_work(grid_->view, grid_->table, io, grid_->names, check.first,
                      [&](const auto &work) { start(work, io.n); });
    radii_.end(b_, io);
  }

  template <class Work>
  void start(const Work &work, std::size_t n)
  {
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) { work.find_nearest(i, work.sphere(i)); });
  }

  // Distances alone have kernels of their own, for spheres in the layout that these read.
  template <class T>
  void distances_alone(const PointArrays<T> &io, const TooLarge<SphereOf<T>> &check)
  {
    using S = SphereOf<T>;
    const S *spheres = packed(io);
    way_.template reserve<S>(io.n);
    const DistanceArrays<T> out = answers(io);
    const DeviceGrid &g = *grid_;
    with_list_search(g.view, [&](auto search) {
      using Work = GridWork<decltype(search), S>;
      way_.run(
          b_, io.n,
          Work{g.view, g.table, spheres, out, typename Work::Filter(g.view), g.coarse, check, 0});
    });
    copy_back(io, out);
  }

  // The points with their radii as x y z radius x y z radius; the caller's array if it has this layout.
  template <class T>
  const SphereOf<T> *packed(const PointArrays<T> &io)
  {
    using S = SphereOf<T>;
    const StridedView<const T> points = io.points;
    const Column<const T> radii = io.radii;
    if (points.row == 4 && points.column == 1 && radii.at == points.at + 3 && radii.step == 4 &&
        reinterpret_cast<std::uintptr_t>(points.at) % alignof(S) == 0)
      return reinterpret_cast<const S *>(points.at);
    S *to = static_cast<S *>(room(spheres_, io.n * sizeof(S)));
    const T radius = static_cast<T>(io.radius);
    b_.for_each(io.n, [=] LSDCD_LAMBDA(std::size_t i) {
      const T *at = points.of(i);
      to[i] = {at[0], at[points.column], at[2 * points.column], radii.at ? radii[i] : radius};
    });
    return to;
  }

  // The arrays that kernels write: the caller's if they are packed and aligned.
  template <class T>
  DistanceArrays<T> answers(const PointArrays<T> &io)
  {
    DistanceArrays<T> out = {io.status, io.distance.at};
    if (!out.status || !aligned(out.status, 4))
      out.status = static_cast<std::uint8_t *>(room(status_, io.n));
    if (out.distance && (io.distance.step != 1 || !aligned(out.distance, 16)))
      out.distance = static_cast<T *>(room(distance_, io.n * sizeof(T)));
    return out;
  }
  template <class T>
  void copy_back(const PointArrays<T> &io, const DistanceArrays<T> &out)
  {
    const Column<T> distance = out.distance != io.distance.at ? io.distance : Column<T>();
    std::uint8_t *status = out.status != io.status ? io.status : nullptr;
    if (!distance.at && !status) return;
    b_.for_each(io.n, [=] LSDCD_LAMBDA(std::size_t i) {
      if (distance.at) distance[i] = out.distance[i];
      if (status) status[i] = out.status[i];
    });
  }

 private:
  static bool aligned(const void *at, std::size_t bytes)
  {
    return reinterpret_cast<std::uintptr_t>(at) % bytes == 0;
  }
  // Memory that grows. Waits for kernels that may still read the old one.
  void *room(CudaBackend::Array<char> &array, std::size_t bytes)
  {
    if (array.size() < bytes) {
      b_.wait();
      array = CudaBackend::Array<char>();
      array = CudaBackend::Array<char>(bytes);
    }
    return array.data();
  }
  std::shared_ptr<const DeviceGrid> grid_;
  CudaBackend b_;
  CellQuery<CudaBackend> way_;
  RadiusCheck<CudaBackend> radii_;
  CudaBackend::Array<char> spheres_, status_, distance_;
};

std::unique_ptr<StreamQuery> DeviceGrid::query_on(void *stream) const
{
  const OnGpu current(device);
  return std::make_unique<CudaStreamQuery>(
      std::static_pointer_cast<const DeviceGrid>(shared_from_this()), stream);
}

}    // namespace lsdcd
