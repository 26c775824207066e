// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/load_recorder.h"

namespace lsdcd {

LoadRecorder::LoadRecorder(Host &host, const WallSpec &settings) :
    host_(host), settings_(settings), loads_(settings.meshes.size())
{
}

void LoadRecorder::set_engine(LoadEngine *engine)
{
  for (int mesh = 0; mesh < static_cast<int>(loads_.size()); mesh++) taken(mesh);
  engine_ = engine;
}

// Volume per work.
Real LoadRecorder::wear_per_work(int mesh) const
{
  return settings_.meshes[mesh].wear_factor * settings_.wear.per_work;
}

// Returns the loads with what the engine has added up since the last time.
MeshLoads &LoadRecorder::taken(int mesh)
{
  MeshLoads &loads = loads_[mesh];
  if (!engine_) return loads;
  constexpr int kRow = LoadEngine::kRow, kWork = 4;
  static_assert(kRow == MeshLoads::kPacked);
  std::vector<Real> rows = engine_->take(mesh);
  for (std::size_t at = kWork; at < rows.size(); at += kRow) rows[at] *= wear_per_work(mesh);
  loads.add_packed(rows);
  return loads;
}

void LoadRecorder::begin_average(int mesh)
{
  taken(mesh).begin_average();
}

void LoadRecorder::add(int mesh, const std::vector<StepContact> &contacts, Real dt,
                       const MeshFeaturesView &features)
{
  if (settings_.has_loads(settings_.meshes[mesh]))
    loads_[mesh].add(contacts.data(), static_cast<int>(contacts.size()), dt, wear_per_work(mesh),
                     features, mesh);
}

Real LoadRecorder::worn(int mesh)
{
  Real worn = taken(mesh).worn();
  host_.sum(&worn, 1);
  return worn;
}

MeshLoads LoadRecorder::gathered(int mesh)
{
  MeshLoads all;
  all.add_packed(host_.gather(taken(mesh).packed()));
  all.set_time(loads_[mesh].time());
  return all;
}

void LoadRecorder::restore(int mesh, Real time, const std::vector<double> &rows)
{
  taken(mesh) = MeshLoads();
  loads_[mesh].set_time(time);
  if (host_.is_first()) loads_[mesh].add_packed(rows);
}

std::size_t LoadRecorder::bytes() const
{
  std::size_t bytes = 0;
  for (const MeshLoads &l : loads_) bytes += l.bytes();
  return bytes;
}

}    // namespace lsdcd
