// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/load_recorder.h"

namespace lsdcd {

LoadRecorder::LoadRecorder(Host &host, const WallSpec &settings) :
    host_(host), settings_(settings), loads_(settings.meshes.size())
{
}

void LoadRecorder::add(int mesh, const std::vector<StepContact> &contacts, Real dt,
                       const MeshFeaturesView &features)
{
  const MeshSpec &of = settings_.meshes[mesh];
  if (settings_.has_loads(of))
    loads_[mesh].add(contacts.data(), static_cast<int>(contacts.size()), dt,
                     of.wear_factor * settings_.wear.per_work, features, mesh);
}

Real LoadRecorder::worn(int mesh) const
{
  Real worn = loads_[mesh].worn();
  host_.sum(&worn, 1);
  return worn;
}

MeshLoads LoadRecorder::gathered(int mesh) const
{
  const std::vector<Real> rows = host_.gather(loads_[mesh].packed());
  MeshLoads all;
  all.set_time(loads_[mesh].time());
  all.add_packed(rows.data(), rows.size() / MeshLoads::kPackedLoad);
  return all;
}

void LoadRecorder::restore(int mesh, Real time, const std::vector<double> &rows)
{
  loads_[mesh] = MeshLoads();
  loads_[mesh].set_time(time);
  if (host_.is_first()) loads_[mesh].add_packed(rows.data(), rows.size() / MeshLoads::kPackedLoad);
}

std::size_t LoadRecorder::bytes() const
{
  std::size_t bytes = 0;
  for (const MeshLoads &l : loads_) bytes += l.bytes();
  return bytes;
}

}    // namespace lsdcd
