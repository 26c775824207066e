// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/mesh_loads.h"

#include <algorithm>
#include <numeric>

namespace lsdcd {

namespace {

// The faces that meet at an edge or a vertex, each once.
std::vector<int> faces_at(const WeldedMesh &mesh, FeatureCode feature)
{
  const std::uint32_t i = feature_index(feature);
  std::vector<int> faces;
  const auto add_edge = [&](int e) {
    faces.insert(faces.end(), mesh.edge_face.begin() + mesh.edge_first[e],
                 mesh.edge_face.begin() + mesh.edge_first[e + 1]);
  };
  if (feature_kind(feature) == FeatureKind::face) return {static_cast<int>(i)};
  if (feature_kind(feature) == FeatureKind::edge)
    add_edge(static_cast<int>(i));
  else
    for (int k = mesh.vertex_first[i]; k < mesh.vertex_first[i + 1]; k++)
      add_edge(mesh.vertex_edge[k]);
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

}    // namespace

Load &MeshLoads::load(FeatureCode feature)
{
  const auto [at, is_new] = row_of_.try_emplace(feature, load_.size());
  if (is_new) {
    feature_.push_back(feature);
    load_.emplace_back();
  }
  return load_[at->second];
}

void MeshLoads::add(const StepContact *records, int n, Real dt, Real per_work,
                    const MeshFeaturesView &wall, std::uint32_t mesh)
{
  time_ += dt;
  for (int i = 0; i < n; i++) {
    const StepContact &r = records[i];
    if (r.mesh != mesh) continue;
    Load &to = load(own_feature(wall, r.feature));
    to.normal += r.normal * dt;
    to.shear += r.shear * dt;
    to.contacts += dt;
    to.worn += per_work * r.wear_power * dt;
    to.force += dt * r.force;
  }
}

void MeshLoads::begin_average()
{
  time_ = 0;
  for (Load &l : load_) {
    const Real worn = l.worn;
    l = Load();
    l.worn = worn;
  }
}

Real MeshLoads::worn() const
{
  return std::accumulate(load_.begin(), load_.end(), Real(0),
                         [](Real sum, const Load &l) { return sum + l.worn; });
}

std::size_t MeshLoads::bytes() const
{
  return feature_.capacity() * sizeof(FeatureCode) + load_.capacity() * sizeof(Load) +
         row_of_.size() * (sizeof(*row_of_.begin()) + sizeof(void *)) +
         row_of_.bucket_count() * sizeof(void *);
}

std::vector<double> MeshLoads::packed() const
{
  std::vector<std::size_t> order(load_.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return feature_[a] < feature_[b]; });
  std::vector<double> rows;
  rows.reserve(order.size() * kPackedLoad);
  for (std::size_t k : order) {
    const Load &l = load_[k];
    rows.insert(rows.end(), {double(feature_[k]), l.normal, l.shear, l.contacts, l.worn, l.force.x,
                             l.force.y, l.force.z});
  }
  return rows;
}

void MeshLoads::add_packed(const double *rows, std::size_t n_rows)
{
  for (const double *r = rows; r < rows + n_rows * kPackedLoad; r += kPackedLoad) {
    Load &to = load(static_cast<FeatureCode>(r[0]));
    to.normal += r[1];
    to.shear += r[2];
    to.contacts += r[3];
    to.worn += r[4];
    to.force += {r[5], r[6], r[7]};
  }
}

std::vector<Load> MeshLoads::of_faces(const WeldedMesh &mesh) const
{
  std::vector<Load> faces(mesh.faces.size());
  const std::vector<double> rows = packed();
  for (std::size_t at = 0; at < rows.size(); at += kPackedLoad) {
    const double *r = rows.data() + at;
    const std::vector<int> shared = faces_at(mesh, static_cast<FeatureCode>(r[0]));
    const Real part = Real(1) / static_cast<Real>(std::max<std::size_t>(1, shared.size()));
    for (int f : shared) {
      faces[f].normal += part * r[1];
      faces[f].shear += part * r[2];
      faces[f].contacts += part * r[3];
      faces[f].worn += part * r[4];
      faces[f].force += part * Vec3{r[5], r[6], r[7]};
    }
  }
  return faces;
}

}    // namespace lsdcd
