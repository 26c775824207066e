// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Rows by feature of a wall's meshes, added up over the steps on all processes: by the engine where it adds up rows itself, else
// here.
#pragma once

#include "engine/loads/feature_engine.h"
#include "host/host.h"
#include "output/feature_rows.h"

#include <cstddef>
#include <vector>

namespace lsdcd {

// A mesh in a step.
struct RecordedMesh {
  int index;
  FeatureCounts counts = {};
  MeshFeaturesView features = {};    // with periodic images; empty where there are no contacts
};

// Meshes are counted from 0. A class derived from this one adds steps, by engine() or to rows().
template <class Row>
class MeshRecorder {
 public:
  // The host must outlive this object.
  MeshRecorder(Host &host, std::size_t n_meshes) : host_(host), rows_(n_meshes) {}
  virtual ~MeshRecorder() = default;

  // Takes what the last engine has added up, and sets the engine from now on; null: it adds up nothing. The last engine must still be
  // there.
  void set_engine(FeatureEngine<Row> *engine)
  {
    for (int mesh = 0; mesh < n_meshes(); mesh++) taken(mesh);
    engine_ = engine;
  }

  // Returns the rows of all processes, on the first one. Collective.
  FeatureRows<Row> gathered(int mesh)
  {
    FeatureRows<Row> all;
    all.add_packed(host_.gather(taken(mesh).packed()));
    return all;
  }

  // Restores rows of a saved state, before the first step: FeatureRows::packed(), the same on all processes. The first process keeps them.
  void restore(int mesh, const std::vector<double> &packed)
  {
    taken(mesh) = FeatureRows<Row>();
    if (host_.is_first()) rows(mesh).add_packed(packed);
  }

  std::size_t bytes() const    // of this process
  {
    std::size_t bytes = 0;
    for (const FeatureRows<Row> &of_mesh : rows_) bytes += of_mesh.bytes();
    return bytes;
  }

 protected:
  int n_meshes() const { return static_cast<int>(rows_.size()); }
  FeatureEngine<Row> *engine() const { return engine_; }

  // Returns the rows of this process without what the engine has added up since the last time.
  FeatureRows<Row> &rows(int mesh) { return rows_[static_cast<std::size_t>(mesh)]; }
  // Returns the rows of this process with what the engine has added up.
  FeatureRows<Row> &taken(int mesh)
  {
    if (engine_)
      for (const RowOfFeature<Row> &of : engine_->take(mesh))
        rows(mesh).add(of.feature, from_engine(mesh, of.row));
    return rows(mesh);
  }
  // Returns the row that is added for a row of the engine.
  virtual Row from_engine(int /* mesh */, const Row &row) const { return row; }

  Host &host_;

 private:
  FeatureEngine<Row> *engine_ = nullptr;
  std::vector<FeatureRows<Row>> rows_;    // of each mesh, on this process
};

}    // namespace lsdcd
