// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The nodes of a mesh in an engine. In each step the records are made again (mesh/moving_records.h), and the CPU waits
// only for a small record of how far nodes have moved. Faces that are too thin for the digits of Real are made by the CPU,
// which has wider numbers.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "backend/warp.h"
#include "contact/feature_turn.h"
#include "contact/node_field.h"
#include "engine/nodes/node_engine.h"
#include "engine/nodes/node_forces.h"
#include "engine/nodes/shared_items.h"
#include "grid/build/moving_grid.h"
#include "grid/lookup/grid_on.h"
#include "mesh/mesh_features.h"
#include "mesh/node_spin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace lsdcd {

// Converts a number to bits that ascend with it, and back. A value that is not a number comes after all others.
LSDCD_FN std::uint64_t ascending_number(Real value)
{
  constexpr std::uint64_t kSign = std::uint64_t(1) << 63;
  std::uint64_t bits;
  memcpy(&bits, &value, sizeof bits);
  if (value != value) return ~std::uint64_t(0);
  return bits & kSign ? ~bits : bits | kSign;
}
LSDCD_FN Real from_ascending_number(std::uint64_t bits)
{
  constexpr std::uint64_t kSign = std::uint64_t(1) << 63;
  bits = bits & kSign ? bits & ~kSign : ~bits;
  Real value;
  memcpy(&value, &bits, sizeof value);
  return value;
}

// What a step finds out about the nodes: maxima as ascending bits. They are not numbers if a place or a velocity is not a
// number.
struct NodesSeen {
  std::uint64_t way_sq, way_sq_of_grid, speed_sq;
  std::uint64_t far;    // the largest coordinate, without its sign
  std::uint64_t hi[3], minus_lo[3];
  int n_left, pad;
};

// Reads all nodes in one pass. A thread reads several nodes, and a warp raises each number once, so that few threads wait
// for each other.
constexpr std::size_t kMostLooking = 1 << 15;
struct LookAtNodes {
  const Vec3 *at, *before, *built_at, *velocity;
  std::size_t n, n_threads;
  NodesSeen *seen;
  std::uint32_t *n_parts;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t t) const
  {
    Real way_sq = 0, way_sq_of_grid = 0, speed_sq = 0;
    Vec3 hi = {-HUGE_VAL, -HUGE_VAL, -HUGE_VAL}, minus_lo = hi;
    bool are_places = true, are_velocities = true;
    for_each_of_thread(warp, t, n_threads, mine ? n : 0, [&](std::size_t i) {
      const Vec3 x = at[i];
      const Real way = norm_sq(x - before[i]), of_grid = norm_sq(x - built_at[i]),
                 speed = norm_sq(velocity[i]);
      are_places = are_places && way == way;
      are_velocities = are_velocities && speed == speed;
      raise(way_sq, way);
      raise(way_sq_of_grid, of_grid);
      raise(speed_sq, speed);
      for (int d = 0; d < 3; d++) {
        raise(hi[d], x[d]);
        raise(minus_lo[d], -x[d]);
      }
    });
    if (!are_places) way_sq = way_sq_of_grid = NAN;
    if (!are_velocities) speed_sq = NAN;
    Real far = hi.x;
    for (int d = 0; d < 3; d++) {
      raise(far, hi[d]);
      raise(far, minus_lo[d]);
      raise_in_warp(warp, &seen->hi[d], hi[d]);
      raise_in_warp(warp, &seen->minus_lo[d], minus_lo[d]);
    }
    raise_in_warp(warp, &seen->way_sq, way_sq);
    raise_in_warp(warp, &seen->way_sq_of_grid, way_sq_of_grid);
    raise_in_warp(warp, &seen->speed_sq, speed_sq);
    raise_in_warp(warp, &seen->far, far);
    if (t == 0) *n_parts = 0;
  }

 private:
  LSDCD_FN static void raise(Real &to, Real value) { to = value > to ? value : to; }
  template <unsigned kSize>
  LSDCD_FN static void raise_in_warp(const Warp<kSize> &warp, std::uint64_t *to, Real value)
  {
    const std::uint64_t most = warp.largest(ascending_number(value));
    if (warp.rank() == 0) raise_to(to, most);
  }
};

// The kernels that make the records again, in this order. A face or edge that a CPU has to make is put into left[].

struct MoveFaces {
  MovedMesh moved;
  FeatureCode *left;
  NodesSeen *seen;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t f) const
  {
    MovedMesh mesh = moved;
    mesh.far = from_ascending_number(seen->far);
    if (!move_face(warp, mine, mesh, static_cast<std::uint32_t>(f)))
      left[fetch_add(&seen->n_left, 1)] =
          feature_code(FeatureKind::face, static_cast<std::uint32_t>(f));
  }
};

struct MoveEdges {
  MovedMesh moved;
  FeatureCode *left;
  NodesSeen *seen;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t i) const
  {
    if (!move_edge(warp, mine, moved, static_cast<std::uint32_t>(i)))
      left[fetch_add(&seen->n_left, 1)] =
          feature_code(FeatureKind::edge, static_cast<std::uint32_t>(i));
  }
};

struct MoveVertices {
  MovedMesh moved;
  NodesSeen *seen;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t i) const
  {
    if (mine && i == 0) *seen = NodesSeen();    // for the next step; the CPU has read it
    move_vertex(warp, mine, moved, static_cast<std::uint32_t>(i));
  }
};

struct PutParts {
  MovedMesh moved;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t f) const
  {
    put_parts(warp, mine, moved, static_cast<std::uint32_t>(f));
  }
};

// Where nodes were when springs were last turned: there were none; where they are now; where they were before the last
// move; or earlier.
enum class SpringsAt { nowhere, now, before, earlier };

template <class B>
class EngineOn;

template <class B>
class MovingNodes : public NodeEngine {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // Manages the nodes of the mesh with this number. The engine must outlive this object, unless set_engine() is called
  // first.
  MovingNodes(EngineOn<B> &engine, int mesh) : e_(&engine), mesh_(mesh) {}
  // Continues in another engine on the same backend, whose grids have to be built.
  void set_engine(EngineOn<B> &engine) { e_ = &engine; }

  void start(const WeldedMesh &mesh) override
  {
    const EngineSettings &settings = e_->settings_;
    with_spins_ = settings.law().rolling.is_on() || settings.law().twisting.is_on();
    const MeshFeatures features = make_moving_features(mesh, settings.side != Side::both);
    GridView view = {};
    view.wall = features.view();
    view.list_kind = ListKind::every();
    records_ = GridOn<B>(b(), FlatGrid(GridParts{features, CellLists(), BrickRecords(), view}));
    put_topology(topology_of(mesh), mesh);
    put_faces_around(mesh);
    const std::size_t n = mesh.vertices.size();
    const std::vector<Vec3> none(n, Vec3{0, 0, 0});
    primitives_ = from_cpu(b(), features.primitives);
    at_ = from_cpu(b(), mesh.vertices);
    built_at_ = from_cpu(b(), mesh.vertices);
    before_ = Array<Vec3>(n);
    earlier_ = Array<Vec3>(n);
    next_ = Array<Vec3>(n);
    next_velocity_ = Array<Vec3>(n);
    velocity_ = from_cpu(b(), none);
    spin_ = from_cpu(b(), none);
    // The value 2 is neither yes nor no, so that the first move writes all parts.
    edge_acts_ = from_cpu(b(), std::vector<char>(mesh.edges.size(), 2));
    vertex_acts_ = from_cpu(b(), std::vector<char>(n, 2));
    n_parts_ = from_cpu(b(), std::vector<std::uint32_t>(1, 0));
    left_ = Array<FeatureCode>(mesh.faces.size() + mesh.edges.size());
    seen_ = from_cpu(b(), std::vector<NodesSeen>(1, NodesSeen()));
    seen_on_cpu_ = typename B::template CpuArray<NodesSeen>(1);
    b().wait();
  }

  // Copies by way of memory from which a GPU can copy without a wait.
  void give(const Vec3 *x, const Vec3 *v) override
  {
    const std::size_t n = at_.size();
    if constexpr (!B::kOnCpu) {
      if (staged_.size() == 0) staged_ = typename B::template CpuArray<Vec3>(2 * n);
      is_copied_.wait();
      x = std::copy_n(x, n, staged_.data()) - n;
      if (v) v = std::copy_n(v, n, staged_.data() + n) - n;
    }
    b().copy_in(x, next_.data(), n);
    if (v)
      b().copy_in(v, next_velocity_.data(), n);
    else
      put_all(b(), next_velocity_.data(), n, Vec3{0, 0, 0});
    is_copied_.record(b());
  }

  void give_in_place(const Real *x, const Real *v, const std::vector<int> &node_of_row) override
  {
    const int *node = rows(node_of_row);
    Vec3 *to = next_.data(), *to_velocity = next_velocity_.data();
    b().for_each(node_of_row.size(), [=] LSDCD_LAMBDA(std::size_t k) {
      const int i = node[k];
      to[i] = {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
      to_velocity[i] = v ? Vec3{v[3 * k], v[3 * k + 1], v[3 * k + 2]} : Vec3{0, 0, 0};
    });
  }

  NodesGone move(Real back) override
  {
    back_ = back;
    if (springs_ == SpringsAt::before) {
      std::swap(before_, earlier_);
      springs_ = SpringsAt::earlier;
    }
    if (springs_ == SpringsAt::now) springs_ = SpringsAt::before;
    std::swap(at_, before_);
    std::swap(at_, next_);
    std::swap(velocity_, next_velocity_);
    return remake();
  }
  void move_back() override
  {
    if (springs_ == SpringsAt::before) springs_ = SpringsAt::now;
    std::swap(at_, before_);
    std::swap(velocity_, next_velocity_);
    remake();
  }
  NodesGone put(const Vec3 *x, const Vec3 *v, Real back) override
  {
    const std::size_t n = at_.size();
    back_ = back;
    std::swap(at_, before_);
    b().copy_in(x, at_.data(), n);
    b().copy_in(v, velocity_.data(), n);
    springs_ = SpringsAt::now;
    return remake();
  }

  Real velocities_behind() const override { return back_; }

  void build_grid(const MovingGridSettings &settings, Real going) override
  {
    e_->where_step_runs([&] {
      grid_.build(b(), records(), {primitives_.data(), primitives_.size()}, settings);
      copy_all(b(), at_.data(), built_at_.data(), at_.size());
      going_ = going;
      e_->broad_phase_.set_lists(b(), grid_.view(records()), mesh_);
    });
  }

  void turn_springs(int n) override
  {
    const SpringsAt was = std::exchange(springs_, SpringsAt::now);
    if (was != SpringsAt::before && was != SpringsAt::earlier) return;
    const TurningMesh turning = {topology_, records().faces,
                                 (was == SpringsAt::earlier ? earlier_ : before_).data(),
                                 at_.data()};
    e_->where_step_runs([&] {
      e_->springs_.grow(n);
      e_->springs_.turn(n, static_cast<std::uint32_t>(mesh_), turning);
    });
  }

  void see_forces() override
  {
    forces_.see(
        b(),
        e_->results_.node_contacts(e_->springs_.contacts(), mesh_, records(), velocity_.data()),
        at_.size());
  }
  NodeForceRange force_range() override { return forces_.range(); }
  void add_forces(const NodeForceRange *of_all) override { forces_.add(b(), of_all); }
  Real fetch_forces(std::int64_t *sums) override { return forces_.fetch(b(), sums); }
  void put_forces(Real sixth, Real *to, const std::vector<int> &node_of_row) override
  {
    b().for_each(node_of_row.size(),
                 ForceOfNode{topology_.faces, face_first_.data(), face_around_.data(), at_.data(),
                             forces_.sums(), forces_.range_in_place(), rows(node_of_row), sixth,
                             to});
  }

  void fetch(NodesAt when, Vec3 *x, Vec3 *v) override
  {
    const Array<Vec3> *const of[] = {&before_, &at_, &next_};
    b().copy_out(of[static_cast<int>(when)]->data(), x, at_.size());
    if (v) b().copy_out((when == NodesAt::next ? next_velocity_ : velocity_).data(), v, at_.size());
    b().wait();
  }

  // Returns what steps read of the nodes and of the mesh, in the memory of the backend.
  const MeshFeaturesView &records() const { return records_.view.wall; }
  NodeField field() const { return {velocity_.data(), spin_.data(), going_}; }

  std::size_t bytes() const
  {
    return 8 * at_.size() * sizeof(Vec3) + edge_acts_.size() + vertex_acts_.size() +
           (left_.size() + primitives_.size()) * sizeof(FeatureCode) + records_.bytes() +
           grid_.bytes() + forces_.bytes() +
           (topology_numbers_.size() + face_first_.size() + face_around_.size() +
            node_of_row_.size()) *
               sizeof(int);
  }

  // The steps of the functions above. Public because nvcc takes no device lambda from a private function.

  // Makes the records again. The CPU waits until it has the NodesSeen, while the rest of the work continues.
  NodesGone remake()
  {
    look();
    const MovedMesh moved = moved_mesh();
    b().for_each_in_warps(moved.mesh.n_faces, MoveFaces{moved, left_.data(), seen_.data()});
    int without_area = -1;
    if constexpr (B::kOnCpu)    // no count has to be copied first
      without_area = make_left(moved, std::exchange(seen_.data()->n_left, 0));
    move_edges(moved);
    b().copy_out(seen_.data(), seen_on_cpu_.data(), 1);
    seen_is_there_.record(b());
    move_rest(moved);
    seen_is_there_.wait();
    const NodesSeen &seen = *seen_on_cpu_.data();
    if (seen.n_left > 0) {
      without_area = std::max(without_area, make_left(moved, seen.n_left));
      move_edges(moved);
      move_rest(moved);
    }
    const auto way = [](std::uint64_t bits) {
      const Real sq = from_ascending_number(bits);
      return sq >= 0 ? std::sqrt(sq) : HUGE_VAL;
    };
    NodesGone gone = {way(seen.way_sq), way(seen.way_sq_of_grid), way(seen.speed_sq), {}, {},
                      without_area};
    for (int d = 0; d < 3; d++) {
      gone.lo[d] = -from_ascending_number(seen.minus_lo[d]);
      gone.hi[d] = from_ascending_number(seen.hi[d]);
    }
    return gone;
  }

  void look()
  {
    const std::size_t n = at_.size(), n_threads = threads_for<B>(n, kMostLooking);
    b().for_each_in_warps(n_threads, LookAtNodes{at_.data(), before_.data(), built_at_.data(),
                                                 velocity_.data(), n, n_threads, seen_.data(),
                                                 n_parts_.data()});
  }

  void move_edges(const MovedMesh &moved)
  {
    b().for_each_in_warps(moved.mesh.n_edges, MoveEdges{moved, left_.data(), seen_.data()});
  }

  void move_rest(const MovedMesh &moved)
  {
    b().for_each_in_warps(moved.mesh.n_vertices, MoveVertices{moved, seen_.data()});
    b().for_each_in_warps(moved.mesh.n_faces, PutParts{moved}, n_parts_.data());
    if (with_spins_) find_spins();
  }

  // Finds the faces of each node in the order of their numbers, in which a CPU adds them.
  void find_spins()
  {
    const Real back = back_;
    const int *faces = topology_.faces, *first = face_first_.data(), *around = face_around_.data();
    const Vec3 *at = at_.data(), *velocity = velocity_.data();
    Vec3 *spin = spin_.data();
    b().for_each(at_.size(), [=] LSDCD_LAMBDA(std::size_t i) {
      Vec3 sum = {0, 0, 0};
      Real weight = 0;
      for (int k = first[i]; k < first[i + 1]; k++) {
        const FaceSpin of = spin_of_face(faces + 3 * std::size_t(around[k]), at, velocity, back);
        sum += of.size * of.spin;
        weight += of.size;
      }
      spin[i] = weight > 0 ? (1 / weight) * sum : sum;
    });
  }

  // Makes the first n entries of left_. Returns the first face that has no area, or -1.
  int make_left(const MovedMesh &moved, int n)
  {
    if (n == 0) return -1;
    std::vector<FeatureCode> codes(n);
    b().copy_out(left_.data(), codes.data(), n);
    b().wait();
    std::sort(codes.begin(), codes.end());
    const Array<FeatureCode> code = from_cpu(b(), codes);
    const FeatureCode *of = code.data();
    Array<Vec3> corner(3 * codes.size());
    Vec3 *to = corner.data();
    b().for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const std::size_t i = feature_index(of[k]);
      const bool is_face = feature_kind(of[k]) == FeatureKind::face;
      const int *c = is_face ? moved.mesh.faces + 3 * i : moved.mesh.edges + 2 * i;
      for (int d = 0; d < (is_face ? 3 : 2); d++) to[3 * k + d] = moved.at[c[d]];
    });
    std::vector<Vec3> corners = to_cpu(b(), corner, corner.size());
    std::vector<FeatureRecord> made(n);
    int without_area = -1;
    for (int k = n - 1; k >= 0; k--) {
      const Vec3 *c = corners.data() + 3 * std::size_t(k);
      if (feature_kind(codes[k]) == FeatureKind::face) {
        made[k].face = make_face_record(c[0], c[1], c[2]);
        if (!has_area(c[0], c[1], c[2])) without_area = static_cast<int>(feature_index(codes[k]));
      } else {
        made[k].edge = make_segment(c[0], c[1]);
      }
    }
    const Array<FeatureRecord> record = from_cpu(b(), made);
    const FeatureRecord *from = record.data();
    b().for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const std::uint32_t i = feature_index(of[k]);
      if (feature_kind(of[k]) == FeatureKind::face) {
        moved.to.faces[i] = from[k].face;
      } else {
        EdgeRecord &e = moved.to.edges[i];
        e.anchor = from[k].edge.anchor;
        e.direction = from[k].edge.direction;
        e.length = from[k].edge.length;
      }
    });
    b().wait();    // before code and record are freed
    return without_area;
  }

 private:
  B &b() const { return e_->b_; }
  // Returns the rows, which are the same in each call.
  const int *rows(const std::vector<int> &node_of_row)
  {
    if (node_of_row_.size() != node_of_row.size()) node_of_row_ = from_cpu(b(), node_of_row);
    return node_of_row_.data();
  }

  // Returns the moved mesh, with `far` in the memory of the backend, which has found it.
  MovedMesh moved_mesh()
  {
    return {topology_,
            moving_records(records(), edge_acts_.data(), vertex_acts_.data(), n_parts_.data()),
            at_.data(), before_.data(), 0};
  }

  void put_topology(const MeshTopologyView &on_cpu, const WeldedMesh &mesh)
  {
    std::vector<int> all;
    const auto add = [&](const int *from, std::size_t n) {
      const std::size_t at = all.size();
      all.insert(all.end(), from, from + n);
      return at;
    };
    const std::size_t at[] = {add(on_cpu.faces, 3 * mesh.faces.size()),
                              add(on_cpu.face_edges, 3 * mesh.faces.size()),
                              add(on_cpu.edges, 2 * mesh.edges.size()),
                              add(on_cpu.edge_first, mesh.edge_first.size()),
                              add(on_cpu.edge_face, mesh.edge_face.size()),
                              add(on_cpu.vertex_first, mesh.vertex_first.size()),
                              add(on_cpu.vertex_edge, mesh.vertex_edge.size())};
    topology_numbers_ = from_cpu(b(), all);
    const int *to = topology_numbers_.data();
    topology_ = {to + at[0], to + at[1], to + at[2],     to + at[3],     to + at[4],
                 to + at[5], to + at[6], on_cpu.n_faces, on_cpu.n_edges, on_cpu.n_vertices};
  }

  void put_faces_around(const WeldedMesh &mesh)
  {
    std::vector<int> first(mesh.vertices.size() + 1, 0), around(3 * mesh.faces.size());
    for (const auto &face : mesh.faces)
      for (const int v : face) first[v + 1]++;
    for (std::size_t i = 1; i < first.size(); i++) first[i] += first[i - 1];
    std::vector<int> at = first;
    for (std::size_t f = 0; f < mesh.faces.size(); f++)
      for (const int v : mesh.faces[f]) around[at[v]++] = static_cast<int>(f);
    face_first_ = from_cpu(b(), first);
    face_around_ = from_cpu(b(), around);
  }

  EngineOn<B> *e_;
  int mesh_;
  bool with_spins_ = false;
  Real back_ = 0;     // the time before now to which velocities belong
  Real going_ = 0;    // see build_grid()
  Array<int> topology_numbers_;
  Array<int> face_first_, face_around_;    // the faces around each vertex
  MeshTopologyView topology_ = {};
  Array<int> node_of_row_;    // of arrays of a caller
  Array<Vec3> at_, before_, earlier_, next_, built_at_, velocity_, next_velocity_, spin_;
  SpringsAt springs_ = SpringsAt::nowhere;
  typename B::template CpuArray<Vec3> staged_;
  typename B::Event is_copied_;    // the copy from staged_ is done
  GridOn<B> records_;              // a grid without cells
  Array<char> edge_acts_, vertex_acts_;
  Array<std::uint32_t> n_parts_;    // number of faces that get their parts in a step: all or none
  Array<FeatureCode> primitives_, left_;
  MovingGrid<B> grid_;
  Array<NodesSeen> seen_;
  typename B::template CpuArray<NodesSeen> seen_on_cpu_;
  typename B::Event seen_is_there_;
  NodeForces<B> forces_;
};

}    // namespace lsdcd
