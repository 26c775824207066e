// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/sums/load_recorder.h"

namespace lsdcd {

LoadRecorder::LoadRecorder(Host &host, const WallSpec &settings) :
    MeshRecorder(host, settings.meshes.size()), settings_(settings),
    times_(settings.meshes.size(), 0)
{
}

// Volume per work.
Real LoadRecorder::wear_per_work(int mesh) const
{
  return settings_.meshes[static_cast<std::size_t>(mesh)].wear_factor * settings_.wear.per_work;
}

// Engines add up the work of wear.
Load LoadRecorder::from_engine(int mesh, const Load &load) const
{
  Load here = load;
  here.worn *= wear_per_work(mesh);
  return here;
}

void LoadRecorder::add(const RecordedMesh &mesh, const std::vector<StepContact> *contacts, Real dt)
{
  const std::size_t k = static_cast<std::size_t>(mesh.index);
  if (!settings_.has_loads(settings_.meshes[k])) return;
  times_[k] += dt;
  if (!contacts) return;
  if (engine())
    engine()->add(mesh.index, mesh.counts, dt);
  else
    rows(mesh.index)
        .add(contacts->data(), static_cast<int>(contacts->size()),
             LoadOf{dt, wear_per_work(mesh.index)}, mesh.features,
             static_cast<std::uint32_t>(mesh.index));
}

Real LoadRecorder::worn(int mesh)
{
  Real worn = taken(mesh).total().worn;
  host_.sum(&worn, 1);
  return worn;
}

void LoadRecorder::begin_average(int mesh)
{
  taken(mesh).replace([](const Load &load) {
    Load begun;
    begun.worn = load.worn;
    return begun;
  });
  times_[static_cast<std::size_t>(mesh)] = 0;
}

void LoadRecorder::restore(int mesh, Real time, const std::vector<double> &packed)
{
  MeshRecorder::restore(mesh, packed);
  times_[static_cast<std::size_t>(mesh)] = time;
}

}    // namespace lsdcd
