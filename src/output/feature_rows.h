// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows (engine/loads/feature_row.h) of the features of a mesh that have any.
#pragma once

#include "engine/loads/feature_row.h"
#include "mesh/mesh_features.h"
#include "mesh/welded_mesh.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <unordered_map>
#include <vector>

namespace lsdcd {

// Returns the faces that meet at an edge or a vertex, each once; of a face itself.
std::vector<int> faces_at(const WeldedMesh &mesh, FeatureCode feature);

template <class Row>
class FeatureRows {
 public:
  void add(FeatureCode feature, const Row &row)
  {
    const auto [place, is_new] = row_of_.try_emplace(feature, rows_.size());
    if (is_new) {
      feature_.push_back(feature);
      rows_.emplace_back();
    }
    add_row(row, 1, rows_[place->second]);
  }

  // Adds row_of(record) for each record of a step that is of this mesh, in their order, so that the same records give the same bits. A
  // record on a periodic image counts for the part of the mesh that it is an image of; `wall` may be empty without images.
  template <class Record, class RowOf>
  void add(const Record *records, int n, const RowOf &row_of, const MeshFeaturesView &wall = {},
           std::uint32_t mesh = 0)
  {
    for (int k = 0; k < n; k++)
      if (records[k].mesh == mesh) add(own_feature(wall, records[k].feature), row_of(records[k]));
  }

  // Replaces each row by f(row).
  template <class F>
  void replace(const F &f)
  {
    for (Row &row : rows_) row = f(row);
  }

  // Returns the row of all features together.
  Row total() const
  {
    Row all;
    for (const Row &row : rows_) add_row(row, 1, all);
    return all;
  }

  // The rows in the order of the features' codes, each as kPacked numbers: the code, and then those of the row. add_packed() adds to
  // what is there.
  static constexpr int kPacked = 1 + RowNumbers<Row>::kNumbers;
  std::vector<double> packed() const
  {
    std::vector<double> numbers;
    numbers.reserve(kPacked * rows_.size());
    in_order([&](FeatureCode feature, const Row &row) {
      const RowNumbers<Row> of_row(row);
      numbers.push_back(static_cast<double>(feature));
      numbers.insert(numbers.end(), std::begin(of_row.of), std::end(of_row.of));
    });
    return numbers;
  }
  void add_packed(const std::vector<double> &numbers)
  {
    for (std::size_t k = 0; k + kPacked <= numbers.size(); k += kPacked) {
      RowNumbers<Row> row;
      std::copy_n(numbers.data() + k + 1, row.kNumbers, row.of);
      add(static_cast<FeatureCode>(numbers[k]), row.row());
    }
  }

  // Returns the row of every face. The faces that meet at an edge or a vertex share its sums evenly, and each has the greatest numbers
  // there. What an edge or vertex without a face has, which only a dropped triangle leaves behind, is not in.
  std::vector<Row> of_faces(const WeldedMesh &mesh) const
  {
    std::vector<Row> faces(mesh.faces.size());
    in_order([&](FeatureCode feature, const Row &row) {
      const std::vector<int> shared = faces_at(mesh, feature);
      const Real part = Real(1) / static_cast<Real>(std::max<std::size_t>(1, shared.size()));
      for (const int face : shared) add_row(row, part, faces[static_cast<std::size_t>(face)]);
    });
    return faces;
  }

  std::size_t bytes() const
  {
    return feature_.capacity() * sizeof(FeatureCode) + rows_.capacity() * sizeof(Row) +
           row_of_.size() * (sizeof(*row_of_.begin()) + sizeof(void *)) +
           row_of_.bucket_count() * sizeof(void *);
  }

 private:
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

  std::unordered_map<FeatureCode, std::size_t> row_of_;
  std::vector<FeatureCode> feature_;
  std::vector<Row> rows_;
};

}    // namespace lsdcd
