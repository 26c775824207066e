// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The records of a mesh whose nodes have moved, made by a backend and brought to the CPU.
#pragma once

#include "engine/nodes/moving_nodes.h"
#include "mesh/mesh_features.h"
#include "mesh/welded_mesh.h"
#include "support/meshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace lsdcd {

// Waves, with triangles of one size.
inline WeldedMesh waves(int n = 16)
{
  WeldedMesh mesh = weld(floor_mesh(n, 8, 3), -1);
  for (Vec3 &x : mesh.vertices) x.z = std::sin(x.x) * std::cos(2 * x.y);
  return mesh;
}
// Waves before and after a move in which some faces bend, some are only shifted, and one becomes too thin for Real. The number of
// faces is no multiple of a warp.
struct MovedWaves {
  WeldedMesh mesh = waves(13), after = mesh;

  MovedWaves()
  {
    for (Vec3 &x : after.vertices)
      x = x.x < 0 ? x + Vec3{0.25, -0.5, 0.125} : Vec3{x.x, x.y, x.z + 0.1 * std::sin(3 * x.y)};
    const auto &thin = mesh.faces.back();
    after.vertices[thin[2]] =
        Real(0.5) * (after.vertices[thin[0]] + after.vertices[thin[1]]) + Vec3{0, 0, 1e-3};
  }
};

template <class Row>
void expect_same_bytes(const std::vector<Row> &a, const std::vector<Row> &b)
{
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(0, std::memcmp(static_cast<const void *>(a.data()), static_cast<const void *>(b.data()),
                           a.size() * sizeof(Row)));
}

inline void expect_same_records(const MeshFeatures &a, const MeshFeatures &b)
{
  const auto bytes_of = [](const MeshFeatures &records) {
    std::vector<std::string> all;
    MeshFeaturesView::each_array(records, [&](const auto &rows) {
      all.emplace_back(reinterpret_cast<const char *>(rows.data()), rows.size() * sizeof rows[0]);
    });
    return all;
  };
  const std::vector<std::string> of_a = bytes_of(a), of_b = bytes_of(b);
  for (std::size_t k = 0; k < of_a.size(); k++) EXPECT_TRUE(of_a[k] == of_b[k]) << "array " << k;
}

// Computes as Base, and has no engine but the one below.
template <class Base>
struct NodesAlone : Base {
  NodesAlone() = default;
  explicit NodesAlone(Base base) : Base(std::move(base)) {}
};

// What nodes ask of their engine: it keeps which springs were to turn.
template <class Base>
class EngineOn<NodesAlone<Base>> {
 public:
  using B = NodesAlone<Base>;

  struct Springs {
    std::vector<TurningMesh> turned;
    void grow(int) {}
    const StepContact *contacts() const { return nullptr; }
    void turn(int, std::uint32_t, const TurningMesh &turning) { turned.push_back(turning); }
  };
  struct BroadPhase {
    void set_lists(B &, const GridView &, int) {}
  };
  struct Results {
    NodeContacts node_contacts(const StepContact *, int, const MeshFeaturesView &, const Vec3 *)
    {
      return {};
    }
  };

  explicit EngineOn(Base base, bool with_sides = true) : b_(std::move(base))
  {
    settings_.side = with_sides ? Side::out : Side::both;
  }
  template <class F>
  void where_step_runs(const F &run)
  {
    run();
  }

  EngineSettings settings_;
  StepSettings step_;
  B b_;
  Springs springs_;
  BroadPhase broad_phase_;
  Results results_;
};

template <class B>
MeshFeatures records_on_cpu(B &b, const MovingNodes<B> &nodes, const WeldedMesh &mesh)
{
  std::vector<const void *> from;
  MeshFeaturesView::each_array(nodes.records(), [&](const auto *rows) { from.push_back(rows); });
  MeshFeatures to = make_moving_features(mesh, true);
  auto its = from.begin();
  MeshFeaturesView::each_array(to, [&](auto &rows) {
    b.copy_out(static_cast<decltype(rows.data())>(const_cast<void *>(*its++)), rows.data(),
               rows.size());
  });
  b.wait();
  return to;
}

// `mesh`: before it moves to where `after` is.
template <class Base>
MeshFeatures moved_records_by(Base base, const WeldedMesh &mesh, const WeldedMesh &after)
{
  EngineOn<NodesAlone<Base>> engine(std::move(base));
  MovingNodes<NodesAlone<Base>> nodes(engine, 0);
  nodes.start(mesh);
  nodes.give(after.vertices.data(), nullptr);
  nodes.move(0);
  return records_on_cpu(engine.b_, nodes, mesh);
}

// In a build with CUDA.
MeshFeatures moved_records_on_cuda(const WeldedMesh &mesh, const WeldedMesh &after);

}    // namespace lsdcd
