// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Points at any range by a tree on a GPU.
#include "backend/backend_cuda.h"
#include "backend/cuda_device.h"
#include "base/curve.h"
#include "mesh/welded_mesh.h"
#include "query/point_query.h"
#include "query/radius_check.h"
#include "query/tree_answers.h"
#include "tree/tree_search.h"
#include "tree/triangle_tree.h"

#include <algorithm>

namespace lsdcd {

class DeviceTree : public DeviceCopy {
 public:
  explicit DeviceTree(const TriangleTree &tree) : view(tree.view())
  {
    const WeldedMesh &mesh = tree.mesh();
    const std::size_t n_faces = mesh.faces.size(), n_edges = mesh.edges.size(),
                      n_vertices = mesh.vertices.size();
    bring(view.nodes, tree.n_nodes());
    bring(view.leaves, tree.n_leaves());
    bring(view.sides, tree.n_leaves());
    bring(view.primitives, view.n_primitives);
    bring(view.vertices, n_vertices);
    bring(view.edges, 2 * n_edges);
    bring(view.edge_first, n_edges + 1);
    bring(view.edge_face, mesh.edge_face.size());
    bring(view.faces, 3 * n_faces);
    bring(view.vertex_first, n_vertices + 1);
    bring(view.vertex_edge, mesh.vertex_edge.size());
    bring(view.face_primitive, n_faces);
    bring(view.names.of_face, n_faces);
    bring(view.names.of_edge, n_edges);
    bring(view.names.of_vertex, n_vertices);
    CudaBackend().wait();
  }

  std::unique_ptr<StreamQuery> query_on(void *stream) const override;

  TreeView view;

 private:
  // Copies n things to the device and points there.
  template <class T>
  void bring(const T *&at, std::size_t n)
  {
    arrays_.emplace_back(n * sizeof(T));
    CudaBackend().copy_in(reinterpret_cast<const char *>(at), arrays_.back().data(), n * sizeof(T));
    at = reinterpret_cast<const T *>(arrays_.back().data());
  }

  std::vector<CudaBackend::Array<char>> arrays_;
};

// Threads that search for a point together.
constexpr unsigned kTogether = kTreeWidth;

// Searches for the points of a turn, from the one at `from` on, by `order`.
template <class T>
struct SearchPoints {
  static constexpr unsigned kThreads = 128, kBlocksAtOnce = 8, kPoints = kThreads / kTogether;

  TreeAnswers<T> answers;
  std::size_t from, n;
  const std::uint32_t *order;    // null: as they come

  LSDCD_GPU_FN void operator()(const Block &block) const
  {
    LSDCD_SHARED TreeWaiting stacks[kPoints][kTreeStack];
    const unsigned mine = block.thread() / kTogether;
    const std::size_t turn = std::size_t(block.number()) * kPoints + mine;
    if (turn >= n) return;
    const std::size_t i = from + (order ? order[turn] : turn);
    const Warp<kTogether> warp;
    const TreeAnswer best = nearest(i, warp, stacks[mine]);
    if (warp.rank() != 0) return;
    answers.check(i);
    // Read again: kept in registers while it is searched for, the point would leave room for fewer blocks.
    const Vec3 q = answers.io.points[i];
    answers.store(i, q, best, answers.tree.times_nearer(q));
  }

 private:
  LSDCD_GPU_FN TreeAnswer nearest(std::size_t i, const Warp<kTogether> &warp,
                                  TreeWaiting *stack) const
  {
    const TreeView &tree = answers.tree;
    const Vec3 q = answers.io.points[i];
    const Real times = tree.times_nearer(q);
    const Vec3 nearer = (1 / times) * q;
    TreeAnswer best = {answers.radius(i, times), kNoFeature, kNoPrimitive};
    const TreeSearch search = tree.search_for(tree.scaled(nearer));
    if (search == TreeSearch::in_float)
      search_tree<TreeBoundsFloat>(tree, warp, nearer, stack, best);
    else if (search == TreeSearch::in_double)
      search_tree<TreeBoundsDouble>(tree, warp, nearer, stack, best);
    return best;
  }
};

class CudaTreeQuery : public StreamQuery {
 public:
  CudaTreeQuery(std::shared_ptr<const DeviceTree> tree, void *stream) :
      tree_(std::move(tree)), b_(stream), radii_(HUGE_VAL)
  {
  }
  ~CudaTreeQuery() override { wait_for_gpu(tree_->device); }

  void enqueue(const PointArrays<float> &io) override { enqueue_any(io); }
  void enqueue(const PointArrays<double> &io) override { enqueue_any(io); }

  template <class T>
  void enqueue_any(const PointArrays<T> &io)
  {
    const OnGpu current(tree_->device);
    const TreeAnswers<T> answers = {tree_->view, io, radii_.template begin<SphereOf<T>>(b_),
                                    io.only_distance()};
    for (std::size_t from = 0; from < io.n; from += kTurn) {
      const std::size_t n = std::min(kTurn, io.n - from);
      const std::uint32_t *order = n > kFewPoints ? along_curve(io, from, n) : nullptr;
      b_.for_each_block(
          {static_cast<unsigned>((n + SearchPoints<T>::kPoints - 1) / SearchPoints<T>::kPoints),
           SearchPoints<T>::kThreads},
          SearchPoints<T>{answers, from, n, order});
    }
    radii_.end(b_, io);
  }

  // The order of some points along a curve through the mesh, so that neighbours read the same triangles.
  template <class T>
  const std::uint32_t *along_curve(const PointArrays<T> &io, std::size_t from, std::size_t n)
  {
    pairs_.reserve(n);
    const TreeView &tree = tree_->view;
    const StridedView<const T> points = io.points;
    std::uint32_t *key = pairs_.keys[0].data(), *number = pairs_.values[0].data();
    b_.for_each(n, [=] LSDCD_LAMBDA(std::size_t i) {
      key[i] = number_on_curve(tree.share_of_box(points[from + i]), kCurveBits);
      number[i] = static_cast<std::uint32_t>(i);
    });
    return b_.sort_in(n, 3 * kCurveBits, pairs_).values;
  }

 private:
  static constexpr std::size_t kTurn = std::size_t(1)
                                       << 22;           // points that are put in order at once
  static constexpr std::size_t kFewPoints = 1 << 14;    // that need no order
  static constexpr int kCurveBits = 8;

  std::shared_ptr<const DeviceTree> tree_;
  CudaBackend b_;
  RadiusCheck<CudaBackend> radii_;
  SortMemory<CudaBackend> pairs_;
};

std::unique_ptr<StreamQuery> DeviceTree::query_on(void *stream) const
{
  const OnGpu current(device);
  return std::make_unique<CudaTreeQuery>(
      std::static_pointer_cast<const DeviceTree>(shared_from_this()), stream);
}

std::shared_ptr<const DeviceCopy> copy_to_cuda(const TriangleTree &tree)
{
  return std::make_shared<const DeviceTree>(tree);
}

}    // namespace lsdcd
