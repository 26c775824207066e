// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The nodes of a mesh in the memory of an engine that has copies of its records, as on a GPU: in a step the records are
// made again by the source that a host has (mesh/moving_records.h), and a small record of how far nodes have gone is all
// that the CPU waits for. Faces that are too thin for the digits of Real come back to the CPU, which has wider ones.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "backend/warp.h"
#include "engine/nodes/node_engine.h"
#include "grid/build/moving_grid.h"
#include "mesh/mesh_features.h"
#include "mesh/node_spin.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <utility>
#include <vector>

namespace lsdcd {

// A number as bits that ascend with it, and back; one that is no number is behind all others.
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

// What a step finds of the nodes: maxima as ascending bits.
struct NodesSeen {
  std::uint64_t way_sq, way_sq_of_grid, speed_sq;
  std::uint64_t hi[3], minus_lo[3];
  int n_left, pad;

  // Returns the largest coordinate, without its sign.
  LSDCD_FN Real far() const
  {
    std::uint64_t most = hi[0];
    for (int d = 0; d < 3; d++) {
      if (hi[d] > most) most = hi[d];
      if (minus_lo[d] > most) most = minus_lo[d];
    }
    return from_ascending_number(most);
  }
};

// Looks at all nodes, in one pass: a thread at several of them, and a warp raises each number once, so that few wait for
// each other.
constexpr std::size_t kMostLooking = 1 << 15;
struct LookAtNodes {
  const Vec3 *at, *before, *built_at, *velocity;
  std::size_t n, n_threads;
  NodesSeen *seen;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t t) const
  {
    NodesSeen of = {};
    for (std::size_t i = t; mine && i < n; i += n_threads) {
      const Vec3 x = at[i];
      raise(of.way_sq, norm_sq(x - before[i]));
      raise(of.way_sq_of_grid, norm_sq(x - built_at[i]));
      raise(of.speed_sq, norm_sq(velocity[i]));
      for (int d = 0; d < 3; d++) {
        raise(of.hi[d], x[d]);
        raise(of.minus_lo[d], -x[d]);
      }
    }
    raise_in_warp(warp, &seen->way_sq, of.way_sq);
    raise_in_warp(warp, &seen->way_sq_of_grid, of.way_sq_of_grid);
    raise_in_warp(warp, &seen->speed_sq, of.speed_sq);
    for (int d = 0; d < 3; d++) {
      raise_in_warp(warp, &seen->hi[d], of.hi[d]);
      raise_in_warp(warp, &seen->minus_lo[d], of.minus_lo[d]);
    }
  }

 private:
  LSDCD_FN static void raise(std::uint64_t &to, Real value)
  {
    const std::uint64_t bits = ascending_number(value);
    if (bits > to) to = bits;
  }
  template <unsigned kSize>
  LSDCD_FN static void raise_in_warp(const Warp<kSize> &warp, std::uint64_t *to,
                                     std::uint64_t value)
  {
    value = warp.largest(value);
    if (warp.rank() == 0) raise_to(to, value);
  }
};

// Make the records again, in this order. A face or edge that a CPU has to make is put into left[].

struct MoveFaces {
  MovedMesh moved;
  FeatureCode *left;
  NodesSeen *seen;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t f) const
  {
    MovedMesh mesh = moved;
    mesh.far = seen->far();
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

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t i) const
  {
    move_vertex(warp, mine, moved, static_cast<std::uint32_t>(i));
  }
};

struct PutParts {
  MovedMesh moved;
  NodesSeen *seen;

  template <unsigned kSize>
  LSDCD_FN void operator()(const Warp<kSize> &warp, bool mine, std::size_t f) const
  {
    if (mine && f == 0) *seen = NodesSeen();    // for the next step; the CPU has it
    put_parts(warp, mine, moved, static_cast<std::uint32_t>(f));
  }
};

template <class B>
class MovingNodes {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  // The records of the mesh are those of the host.
  void start(B &b, const NodesNow &now)
  {
    const WeldedMesh &mesh = *now.mesh;
    const std::size_t n = mesh.vertices.size();
    put_topology(b, topology_of(mesh), mesh);
    put_faces_around(b, mesh);
    primitives_ = from_cpu(b, *now.primitives);
    at_ = from_cpu(b, mesh.vertices);
    before_ = from_cpu(b, mesh.vertices);
    next_ = Array<Vec3>(n);
    built_at_ = Array<Vec3>(n);
    velocity_ = Array<Vec3>(n);
    next_velocity_ = Array<Vec3>(n);
    b.copy_in(now.velocity, velocity_.data(), n);
    spin_ = from_cpu(b, std::vector<Vec3>(n, Vec3{0, 0, 0}));
    edge_acts_ = Array<char>(mesh.edges.size());
    vertex_acts_ = Array<char>(n);
    left_ = Array<FeatureCode>(mesh.faces.size() + mesh.edges.size());
    seen_ = from_cpu(b, std::vector<NodesSeen>(1, NodesSeen()));
    seen_on_cpu_ = typename B::template CpuArray<NodesSeen>(1);
    if (now.with_spins) find_spins(b, now.back);
    b.wait();
  }

  // From where nodes are. What it returns lies in memory of this, until the next call.
  GridView build_grid(B &b, const MovingGridSettings &settings, const MeshFeaturesView &records)
  {
    grid_.build(b, records, {primitives_.data(), primitives_.size()}, settings);
    keep_places(b);
    return grid_.view(records);
  }

  // By memory that copies without a wait, which the last step's copy has left: move() waits for it.
  void give(B &b, const Vec3 *x, const Vec3 *v)
  {
    const std::size_t n = at_.size();
    if constexpr (!B::kOnCpu) {
      if (staged_.size() == 0) staged_ = typename B::template CpuArray<Vec3>(2 * n);
      std::copy_n(x, n, staged_.data());
      std::copy_n(v, n, staged_.data() + n);
      x = staged_.data();
      v = x + n;
    }
    b.copy_in(x, next_.data(), n);
    b.copy_in(v, next_velocity_.data(), n);
  }

  // Updates `records`, which are in the memory of the backend, where nodes were given.
  NodesGone move(B &b, const MeshFeaturesView &records, bool with_spins, Real back)
  {
    std::swap(at_, before_);
    std::swap(at_, next_);
    std::swap(velocity_, next_velocity_);
    return remake(b, records, with_spins, back);
  }
  // The last move is taken back.
  NodesGone move_back(B &b, const MeshFeaturesView &records, bool with_spins, Real back)
  {
    std::swap(at_, before_);
    std::swap(velocity_, next_velocity_);
    return remake(b, records, with_spins, back);
  }

  // The same field where the backend computes.
  NodeField field(Real going) const { return {velocity_.data(), spin_.data(), going}; }
  TurningMesh turning(const MeshFeaturesView &records) const
  {
    return {topology_, records.faces, before_.data(), at_.data()};
  }

  void fetch(B &b, NodesAt when, Vec3 *x, Vec3 *v) const
  {
    const bool is_now = when == NodesAt::now;
    const Array<Vec3> &at = is_now ? at_ : when == NodesAt::before ? before_ : next_;
    b.copy_out(at.data(), x, at.size());
    b.copy_out((is_now ? velocity_ : next_velocity_).data(), v, at.size());
    b.wait();
  }

  // Returns the faces around node i, in the order of their numbers: around[first[i]] to around[first[i + 1] - 1].
  const int *face_first() const { return face_first_.data(); }
  const int *faces_around() const { return face_around_.data(); }
  const int *faces() const { return topology_.faces; }
  const Vec3 *at() const { return at_.data(); }
  std::size_t n() const { return at_.size(); }
  // The same in each call.
  const int *rows(B &b, const std::vector<int> &node_of_row)
  {
    if (node_of_row_.size() != node_of_row.size()) node_of_row_ = from_cpu(b, node_of_row);
    return node_of_row_.data();
  }

  std::size_t bytes() const
  {
    return 7 * at_.size() * sizeof(Vec3) + edge_acts_.size() + vertex_acts_.size() +
           (left_.size() + primitives_.size()) * sizeof(FeatureCode) + grid_.bytes() +
           (topology_numbers_.size() + face_first_.size() + face_around_.size() +
            node_of_row_.size()) *
               sizeof(int);
  }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  void keep_places(B &b) { copy_all(b, at_.data(), built_at_.data(), at_.size()); }

  void give_in_place(B &b, const Real *x, const Real *v, const std::vector<int> &node_of_row)
  {
    const int *node = rows(b, node_of_row);
    Vec3 *to = next_.data(), *to_velocity = next_velocity_.data();
    b.for_each(node_of_row.size(), [=] LSDCD_LAMBDA(std::size_t k) {
      const int i = node[k];
      to[i] = {x[3 * k], x[3 * k + 1], x[3 * k + 2]};
      to_velocity[i] = v ? Vec3{v[3 * k], v[3 * k + 1], v[3 * k + 2]} : Vec3{0, 0, 0};
    });
  }

  // The CPU waits until it has what was seen, while the rest goes on.
  NodesGone remake(B &b, const MeshFeaturesView &records, bool with_spins, Real back)
  {
    look(b);
    const MovedMesh moved = moved_mesh(records);
    b.for_each_in_warps(moved.mesh.n_faces, MoveFaces{moved, left_.data(), seen_.data()});
    move_edges(b, moved);
    b.copy_out(seen_.data(), seen_on_cpu_.data(), 1);
    seen_is_there_.record(b);
    move_rest(b, moved);
    if (with_spins) find_spins(b, back);
    seen_is_there_.wait();
    const NodesSeen &seen = *seen_on_cpu_.data();
    const auto way = [](std::uint64_t bits) {
      const Real sq = from_ascending_number(bits);
      return sq >= 0 ? std::sqrt(sq) : HUGE_VAL;
    };
    NodesGone gone = {way(seen.way_sq), way(seen.way_sq_of_grid), way(seen.speed_sq), {}, {},
                      seen.n_left > 0};
    for (int d = 0; d < 3; d++) {
      gone.lo[d] = -from_ascending_number(seen.minus_lo[d]);
      gone.hi[d] = from_ascending_number(seen.hi[d]);
    }
    return gone;
  }

  void look(B &b)
  {
    const std::size_t n = at_.size(), n_threads = std::min(n, kMostLooking);
    b.for_each_in_warps(n_threads, LookAtNodes{at_.data(), before_.data(), built_at_.data(),
                                               velocity_.data(), n, n_threads, seen_.data()});
  }

  void move_edges(B &b, const MovedMesh &moved)
  {
    b.for_each_in_warps(moved.mesh.n_edges, MoveEdges{moved, left_.data(), seen_.data()});
  }

  void move_rest(B &b, const MovedMesh &moved)
  {
    b.for_each_in_warps(moved.mesh.n_vertices, MoveVertices{moved});
    b.for_each_in_warps(moved.mesh.n_faces, PutParts{moved, seen_.data()});
  }

  // The faces of a node in the order of their numbers, as a CPU adds them.
  void find_spins(B &b, Real back)
  {
    const int *faces = topology_.faces, *first = face_first_.data(), *around = face_around_.data();
    const Vec3 *at = at_.data(), *velocity = velocity_.data();
    Vec3 *spin = spin_.data();
    b.for_each(at_.size(), [=] LSDCD_LAMBDA(std::size_t i) {
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

  // In the order of their numbers, so that the first face without area is the error.
  void make_left(B &b, const MeshFeaturesView &records, const WeldedMesh &mesh)
  {
    const MovedMesh moved = moved_mesh(records);
    const int n = seen_on_cpu_.data()->n_left;
    std::vector<FeatureCode> codes(n);
    b.copy_out(left_.data(), codes.data(), n);
    b.wait();
    std::sort(codes.begin(), codes.end());
    std::vector<FeatureRecord> made(n);
    for (int k = 0; k < n; k++) {
      const std::uint32_t i = feature_index(codes[k]);
      if (feature_kind(codes[k]) == FeatureKind::face)
        made[k].face = make_thin_face_record(mesh, i);
      else
        put_far_segment(mesh, i, made[k].edge);
    }
    const Array<FeatureCode> code = from_cpu(b, codes);
    const Array<FeatureRecord> record = from_cpu(b, made);
    const FeatureCode *from_code = code.data();
    const FeatureRecord *from = record.data();
    b.for_each(n, [=] LSDCD_LAMBDA(std::size_t k) {
      const std::uint32_t i = feature_index(from_code[k]);
      if (feature_kind(from_code[k]) == FeatureKind::face) {
        moved.to.faces[i] = from[k].face;
      } else {
        EdgeRecord &e = moved.to.edges[i];
        e.anchor = from[k].edge.anchor;
        e.direction = from[k].edge.direction;
        e.length = from[k].edge.length;
      }
    });
    b.wait();    // before code and record are freed
    move_edges(b, moved);
    move_rest(b, moved);
  }

 private:
  // `far` is where the backend has seen it.
  MovedMesh moved_mesh(const MeshFeaturesView &records)
  {
    return {topology_, moving_records(records, edge_acts_.data(), vertex_acts_.data()), at_.data(),
            before_.data(), 0};
  }

  void put_topology(B &b, const MeshTopologyView &on_cpu, const WeldedMesh &mesh)
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
    topology_numbers_ = from_cpu(b, all);
    const int *to = topology_numbers_.data();
    topology_ = {to + at[0], to + at[1], to + at[2],     to + at[3],     to + at[4],
                 to + at[5], to + at[6], on_cpu.n_faces, on_cpu.n_edges, on_cpu.n_vertices};
  }

  void put_faces_around(B &b, const WeldedMesh &mesh)
  {
    std::vector<int> first(mesh.vertices.size() + 1, 0), around(3 * mesh.faces.size());
    for (const auto &face : mesh.faces)
      for (const int v : face) first[v + 1]++;
    for (std::size_t i = 1; i < first.size(); i++) first[i] += first[i - 1];
    std::vector<int> at = first;
    for (std::size_t f = 0; f < mesh.faces.size(); f++)
      for (const int v : mesh.faces[f]) around[at[v]++] = static_cast<int>(f);
    face_first_ = from_cpu(b, first);
    face_around_ = from_cpu(b, around);
  }

  Array<int> topology_numbers_;
  Array<int> face_first_, face_around_;    // the faces around each vertex
  MeshTopologyView topology_ = {};
  Array<int> node_of_row_;    // of arrays of a caller
  Array<Vec3> at_, before_, next_, built_at_, velocity_, next_velocity_, spin_;
  typename B::template CpuArray<Vec3> staged_;
  Array<char> edge_acts_, vertex_acts_;
  Array<FeatureCode> primitives_, left_;
  MovingGrid<B> grid_;
  Array<NodesSeen> seen_;
  typename B::template CpuArray<NodesSeen> seen_on_cpu_;
  typename B::Event seen_is_there_;
};

}    // namespace lsdcd
