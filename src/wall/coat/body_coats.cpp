// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/coat/body_coats.h"

#include <algorithm>

namespace lsdcd {

void BodyCoats::make(const EngineSettings &engine, Real force)
{
  for (const MeshPart &m : meshes_) {
    if (!m.has_coat()) continue;
    coats_.emplace_back(host_, wall_, m.index, m.grid, engine, force);
    for (MeshPart &other : meshes_) other.coat_feels_it |= other.index != m.index;
  }
  loads_.resize(meshes_.size());
}

BodyCoat *BodyCoats::of(int mesh)
{
  const auto at = std::find_if(coats_.begin(), coats_.end(),
                               [mesh](const BodyCoat &coat) { return coat.mesh() == mesh; });
  return at == coats_.end() ? nullptr : &*at;
}

Real BodyCoats::largest_radius() const
{
  Real most = 0;
  for (const BodyCoat &coat : coats_) most = std::max(most, coat.radius());
  return most;
}

std::string BodyCoats::text(int mesh) const
{
  for (const BodyCoat &coat : coats_)
    if (coat.mesh() == mesh) return coat.text();
  return "";
}

void BodyCoats::rename_features(const BodyCoat::FeatureName &name)
{
  for (BodyCoat &coat : coats_) coat.rename_features(name);
}

void BodyCoats::set_grid(const MeshPart &m)
{
  for (BodyCoat &coat : coats_) coat.set_grid(m);
}

void BodyCoats::step(const Step &step, const BodyCoat::Receded &receded)
{
  loads_.assign(meshes_.size(), CoatLoad());
  if (wall_.energy) energy_ = {std::vector<EnergyRows>(meshes_.size()), {}};
  CoatPushes pushes(meshes_.size());
  for (BodyCoat &coat : coats_) coat.begin(meshes_, step, pushes);
  for (BodyCoat &coat : coats_) coat.finish(meshes_, step, pushes, receded, loads_, energy_);
}

const CoatLoad &BodyCoats::load(int mesh) const
{
  return loads_[static_cast<std::size_t>(mesh)];
}

ModeRates BodyCoats::fastest_touched(int mesh,
                                     const std::function<ModeRates(const MeshPart &)> &rates) const
{
  ModeRates most;
  for (const MeshPart &other : meshes_) {
    if (!(load(mesh).bodies >> other.index & 1)) continue;
    const ModeRates of = rates(other);
    most = {std::max(most.stiffness, of.stiffness), std::max(most.damping, of.damping)};
  }
  return most;
}

void BodyCoats::save(int mesh, MeshState &to, const BodyCoat::FeatureName &name)
{
  if (BodyCoat *const coat = of(mesh)) to.coat = coat->save(name);
}

// Loads of coats that are gone act no more.
void BodyCoats::restore(int mesh, const MeshState &was)
{
  if (any())
    loads_[static_cast<std::size_t>(mesh)] = was.last.empty() ? CoatLoad() : was.last.front().coat;
  if (BodyCoat *const coat = of(mesh)) coat->restore(was.coat);
}

std::size_t BodyCoats::bytes() const
{
  std::size_t bytes = 0;
  for (const BodyCoat &coat : coats_) bytes += coat.bytes();
  return bytes;
}

}    // namespace lsdcd
