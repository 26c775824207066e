// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What becomes of energy at the triangles of a mesh, since the beginning: what contacts dissipate, and how hard spheres hit.
#pragma once

#include "engine/results/step_results.h"
#include "mesh/mesh_features.h"
#include "output/by_feature.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lsdcd {

// Of one face, edge or vertex.
struct PlaceEnergy {
  Real dissipated = 0;       // energy
  Real impacts = 0;          // number
  Real impact_energy = 0;    // energy; the sum of m v^2/2
  Real impact_speed = 0;     // length/time; the greatest v
};

class EnergyPlaces {
 public:
  // Adds the records of a step that are of this mesh, in their order. Those on a periodic image count for the part of the mesh
  // that it is an image of; `wall` may be empty without images.
  void add(const EnergyRecords &records, const MeshFeaturesView &wall, std::uint32_t mesh);

  // Rows of kPacked numbers, by feature; add_packed() adds to what is there.
  static constexpr int kPacked = 5;
  std::vector<double> packed() const;
  void add_packed(const std::vector<double> &rows);

  // Returns the numbers of every face. The faces that meet at an edge or a vertex share what is dissipated there, and its impacts,
  // evenly; each has the speed of the fastest.
  std::vector<PlaceEnergy> of_faces(const WeldedMesh &mesh) const;

  std::size_t bytes() const { return places_.bytes(); }

 private:
  ByFeature<PlaceEnergy> places_;
};

}    // namespace lsdcd
