// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The loads of contacts on a mesh over time: forces on its parts, and the volume worn off.
#pragma once

#include "engine/results/step_results.h"
#include "mesh/mesh_features.h"
#include "mesh/welded_mesh.h"
#include "output/by_feature.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// The load of one face, edge or vertex. Integrals over the time of an average, except
// `worn`, which is since the beginning.
struct Load {
  Real normal = 0;           // force time; of the normal forces, < 0 where they pull
  Real shear = 0;            // force time; of the sizes of the forces along the wall
  Real contacts = 0;         // time; of the number of contacts
  Real worn = 0;             // length^3
  Vec3 force = {0, 0, 0};    // force time; on the wall, in the frame of the mesh
};

class MeshLoads {
 public:
  // Adds a step of duration dt; per_work is that of Wear. Records are summed in their order, so
  // that the same records give the same bits. Records on a periodic image count for the part of
  // the mesh that it is an image of; `wall` may be empty without images. Records of other
  // meshes are left out.
  void add(const StepContact *records, int n, Real dt, Real per_work,
           const MeshFeaturesView &wall = {}, std::uint32_t mesh = 0);

  // Begins a new average: forgets all but what has worn off.
  void begin_average();

  Real time() const { return time_; }    // of the average
  void set_time(Real time) { time_ = time; }
  Real worn() const;    // length^3, in all
  std::size_t bytes() const { return loads_.bytes(); }

  // Rows of kPacked numbers, by feature; add_packed() adds to what is there.
  static constexpr int kPacked = 8;
  std::vector<double> packed() const;
  void add_packed(const std::vector<double> &rows);

  // Returns the load of every face. The faces that meet at an edge or a vertex share its load evenly; the load of an edge
  // or vertex without a face, which only a dropped triangle leaves behind, is not in.
  std::vector<Load> of_faces(const WeldedMesh &mesh) const;

 private:
  Real time_ = 0;
  ByFeature<Load> loads_;
};

}    // namespace lsdcd
