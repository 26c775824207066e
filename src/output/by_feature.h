// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Numbers of the features of a mesh that have any.
#pragma once

#include "geometry/feature_code.h"
#include "mesh/welded_mesh.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace lsdcd {

// Returns the faces that meet at an edge or a vertex, each once; of a face itself.
std::vector<int> faces_at(const WeldedMesh &mesh, FeatureCode feature);

template <class Row>
class ByFeature {
 public:
  // Returns the row of a feature, which is made where there is none.
  Row &at(FeatureCode feature)
  {
    const auto [place, is_new] = row_of_.try_emplace(feature, rows_.size());
    if (is_new) {
      feature_.push_back(feature);
      rows_.emplace_back();
    }
    return rows_[place->second];
  }

  std::vector<Row> &rows() { return rows_; }
  const std::vector<Row> &rows() const { return rows_; }

  // Calls f(feature, row) for each, in the order of their codes.
  template <class F>
  void in_order(const F &f) const
  {
    std::vector<std::size_t> order(rows_.size());
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(),
              [&](std::size_t a, std::size_t b) { return feature_[a] < feature_[b]; });
    for (const std::size_t k : order) f(feature_[k], rows_[k]);
  }

  // Calls f(face, row, part) for each face of a feature, of which each has the same part, in the order of features.
  template <class F>
  void on_faces(const WeldedMesh &mesh, const F &f) const
  {
    in_order([&](FeatureCode feature, const Row &row) {
      const std::vector<int> shared = faces_at(mesh, feature);
      const Real part = Real(1) / static_cast<Real>(std::max<std::size_t>(1, shared.size()));
      for (const int face : shared) f(face, row, part);
    });
  }

  std::size_t bytes() const
  {
    return feature_.capacity() * sizeof(FeatureCode) + rows_.capacity() * sizeof(Row) +
           row_of_.size() * (sizeof(*row_of_.begin()) + sizeof(void *)) +
           row_of_.bucket_count() * sizeof(void *);
  }

 private:
  std::unordered_map<FeatureCode, std::size_t> row_of_;
  std::vector<FeatureCode> feature_;
  std::vector<Row> rows_;
};

}    // namespace lsdcd
