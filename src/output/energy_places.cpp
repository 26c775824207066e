// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "output/energy_places.h"

namespace lsdcd {

namespace {

void add_part(const PlaceEnergy &row, Real part, PlaceEnergy &to)
{
  to.dissipated += part * row.dissipated;
  to.impacts += part * row.impacts;
  to.impact_energy += part * row.impact_energy;
  to.impact_speed = std::max(to.impact_speed, row.impact_speed);
}

}    // namespace

void EnergyPlaces::add(const EnergyRecords &records, const MeshFeaturesView &wall,
                       std::uint32_t mesh)
{
  for (int k = 0; k < records.n; k++) {
    const EnergyRecord &r = records.at[k];
    if (r.mesh != mesh) continue;
    add_part({r.dissipated, r.impact > 0 ? Real(1) : Real(0), r.impact, r.speed}, 1,
             places_.at(own_feature(wall, r.feature)));
  }
}

std::vector<double> EnergyPlaces::packed() const
{
  std::vector<double> rows;
  rows.reserve(kPacked * places_.rows().size());
  places_.in_order([&](FeatureCode feature, const PlaceEnergy &p) {
    rows.insert(rows.end(), {static_cast<double>(feature), p.dissipated, p.impacts, p.impact_energy,
                             p.impact_speed});
  });
  return rows;
}

void EnergyPlaces::add_packed(const std::vector<double> &rows)
{
  for (std::size_t k = 0; k + kPacked <= rows.size(); k += kPacked) {
    const double *const r = rows.data() + k;
    add_part({r[1], r[2], r[3], r[4]}, 1, places_.at(static_cast<FeatureCode>(r[0])));
  }
}

std::vector<PlaceEnergy> EnergyPlaces::of_faces(const WeldedMesh &mesh) const
{
  std::vector<PlaceEnergy> faces(mesh.faces.size());
  places_.on_faces(mesh, [&](int face, const PlaceEnergy &row, Real part) {
    add_part(row, part, faces[static_cast<std::size_t>(face)]);
  });
  return faces;
}

}    // namespace lsdcd
