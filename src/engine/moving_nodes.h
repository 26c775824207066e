// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The nodes of a mesh in the memory of an engine that has copies of its records, as on a GPU: in a step only their
// places and velocities are copied there, and the records are made anew by the source that a host has
// (mesh/moving_records.h). Faces that are too thin for the digits of Real come back to the host, which has wider ones.
#pragma once

#include "backend/atomic.h"
#include "backend/backend.h"
#include "engine/wall_engine.h"
#include "mesh/mesh_features.h"
#include "mesh/node_spin.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace lsdcd {

template <class B>
class MovingNodes {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  bool are_there() const { return at_.size() > 0; }

  // The records of the mesh are those of the host.
  void start(B &b, const NodesNow &now)
  {
    const WeldedMesh &mesh = *now.mesh;
    const std::size_t n = mesh.vertices.size();
    if (!are_there()) {
      put_topology(b, topology_of(mesh), mesh);
      put_faces_around(b, mesh);
      at_ = Array<Vec3>(n);
      before_ = from_host(b, mesh.vertices);
      velocity_ = Array<Vec3>(n);
      spin_ = from_host(b, std::vector<Vec3>(n, Vec3{0, 0, 0}));
      edge_acts_ = Array<char>(mesh.edges.size());
      vertex_acts_ = Array<char>(n);
      left_ = Array<FeatureCode>(mesh.faces.size() + mesh.edges.size());
      n_left_ = Array<int>(1);
    }
    put_nodes(b, now);
    if (now.with_spins) find_spins(b, now);
    b.wait();
  }

  // Makes `records`, which are in the memory of the backend, anew.
  void move(B &b, const MeshFeaturesView &records, const NodesNow &now)
  {
    std::swap(at_, before_);
    put_nodes(b, now);
    const MovedMesh moved = {topology_,
                             moving_records(records, edge_acts_.data(), vertex_acts_.data()),
                             at_.data(), before_.data(), now.far};
    move_planes(b, moved);
    make_left(b, moved, *now.mesh);
    const MeshTopologyView &of = topology_;
    b.for_each(of.n_edges, [=] LSDCD_LAMBDA(std::size_t i) {
      put_faces_of_edge(moved, static_cast<std::uint32_t>(i));
    });
    b.for_each(of.n_vertices, [=] LSDCD_LAMBDA(std::size_t i) {
      move_vertex(moved, static_cast<std::uint32_t>(i));
    });
    b.for_each(of.n_faces, [=] LSDCD_LAMBDA(std::size_t f) {
      put_parts(moved, static_cast<std::uint32_t>(f));
    });
    if (now.with_spins) find_spins(b, now);
  }

  // The same field where the backend computes.
  NodeField field(Real going) const { return {velocity_.data(), spin_.data(), going}; }
  TurningMesh turning(const MeshFeaturesView &records) const
  {
    return {topology_, records.faces, before_.data(), at_.data()};
  }

  std::size_t bytes() const
  {
    return 4 * at_.size() * sizeof(Vec3) + edge_acts_.size() + vertex_acts_.size() +
           left_.size() * sizeof(FeatureCode) +
           (topology_numbers_.size() + face_first_.size() + face_around_.size()) * sizeof(int);
  }

  // The steps of the above. Public because nvcc takes no device lambda from a private function.

  // The faces of a node in the order of their numbers, as a host adds them.
  void find_spins(B &b, const NodesNow &now)
  {
    const int *faces = topology_.faces, *first = face_first_.data(), *around = face_around_.data();
    const Vec3 *at = at_.data(), *velocity = velocity_.data();
    Vec3 *spin = spin_.data();
    const Real back = now.back;
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

  // Faces and segments that are left to the host are put into left_.
  void move_planes(B &b, const MovedMesh &moved)
  {
    FeatureCode *left = left_.data();
    int *n_left = n_left_.data();
    const std::uint32_t n_faces = topology_.n_faces;
    b.for_each(1, [=] LSDCD_LAMBDA(std::size_t) { *n_left = 0; });
    b.for_each(std::size_t(n_faces) + topology_.n_edges, [=] LSDCD_LAMBDA(std::size_t k) {
      const auto i = static_cast<std::uint32_t>(k);
      if (i < n_faces) {
        if (!move_face(moved, i)) left[fetch_add(n_left, 1)] = feature_code(FeatureKind::face, i);
      } else if (!move_segment(moved, i - n_faces)) {
        left[fetch_add(n_left, 1)] = feature_code(FeatureKind::edge, i - n_faces);
      }
    });
  }

  // In the order of their numbers, so that the first face without area is the error.
  void make_left(B &b, const MovedMesh &moved, const WeldedMesh &mesh)
  {
    const int n = read_one(b, n_left_.data());
    if (n == 0) return;
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
    const Array<FeatureCode> code = from_host(b, codes);
    const Array<FeatureRecord> record = from_host(b, made);
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
  }

 private:
  // By memory that copies without a wait, which the last step's copy has left: move() waits for it.
  void put_nodes(B &b, const NodesNow &now)
  {
    const std::size_t n = at_.size();
    const Vec3 *at = now.mesh->vertices.data(), *velocity = now.velocity;
    if constexpr (!B::kOnHost) {
      if (staged_.size() == 0) staged_ = typename B::template HostArray<Vec3>(2 * n);
      std::copy_n(at, n, staged_.data());
      std::copy_n(velocity, n, staged_.data() + n);
      at = staged_.data();
      velocity = at + n;
    }
    b.copy_in(at, at_.data(), n);
    b.copy_in(velocity, velocity_.data(), n);
  }

  void put_topology(B &b, const MeshTopologyView &on_host, const WeldedMesh &mesh)
  {
    std::vector<int> all;
    const auto add = [&](const int *from, std::size_t n) {
      const std::size_t at = all.size();
      all.insert(all.end(), from, from + n);
      return at;
    };
    const std::size_t at[] = {add(on_host.faces, 3 * mesh.faces.size()),
                              add(on_host.face_edges, 3 * mesh.faces.size()),
                              add(on_host.edges, 2 * mesh.edges.size()),
                              add(on_host.edge_first, mesh.edge_first.size()),
                              add(on_host.edge_face, mesh.edge_face.size()),
                              add(on_host.vertex_first, mesh.vertex_first.size()),
                              add(on_host.vertex_edge, mesh.vertex_edge.size())};
    topology_numbers_ = from_host(b, all);
    const int *to = topology_numbers_.data();
    topology_ = {to + at[0], to + at[1], to + at[2],      to + at[3],      to + at[4],
                 to + at[5], to + at[6], on_host.n_faces, on_host.n_edges, on_host.n_vertices};
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
    face_first_ = from_host(b, first);
    face_around_ = from_host(b, around);
  }

  Array<int> topology_numbers_;
  Array<int> face_first_, face_around_;    // the faces around each vertex
  MeshTopologyView topology_ = {};
  Array<Vec3> at_, before_, velocity_, spin_;
  typename B::template HostArray<Vec3> staged_;
  Array<char> edge_acts_, vertex_acts_;
  Array<FeatureCode> left_;
  Array<int> n_left_;
};

}    // namespace lsdcd
