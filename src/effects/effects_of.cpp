// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "effects/effects.h"

#include "law/force_parts.h"
#include "law/sub_models.h"

namespace lsdcd {

namespace {

void add_friction(const ContactLaw &law, bool damps, std::vector<Effect> &effects)
{
  if (law.tangential == TangentialModel::linear_history_classic && law.mu > 0 && law.k_tangent > 0)
    effects.push_back({"tangential spring", 0});
  if (law.is_classic() ? law.mu > 0 && law.gamma_tangent > 0 : damps && law.xgammat > 0)
    effects.push_back({"tangential damping", 0});
  effects.push_back({law.mu > 0 ? "sliding limit" : "no friction", 0});
}

void add_law(const ContactLaw &law, std::vector<Effect> &effects)
{
  const bool damps = law.damping != DampingModel::none && law.eta > 0;
  const auto add = [&effects](const char *name, int bytes) {
    if (*name) effects.push_back({name, bytes});
  };
  for (const SubModel *row : rows_of(law)) {
    const int bytes = row->stored.beside_shear * static_cast<int>(sizeof(Real));
    switch (row->family) {
      case Family::style:
        add("normal spring", 0);
        add(row->effect, 0);
        if (damps) add("normal damping", 0);
        add_friction(law, damps, effects);
        break;
      case Family::damping:
        if (damps) add(row->effect, 0);
        break;
      case Family::tangential:
        add(row->effect, 0);
        if (row->stored.effect) add(row->stored.effect, bytes);
        add_friction(law, damps, effects);
        break;
      default:
        add(row->effect, bytes);
    }
  }
}

}    // namespace

std::vector<Effect> effects_of(const EngineSettings &s)
{
  std::vector<Effect> effects;
  add_law(s.law(), effects);
  if (s.surface.moves()) effects.push_back({"moving surface", 0});
  if (s.moves) effects.push_back({"moving wall", 0});
  if (s.bodies) effects.push_back({"rigid body", 0});
  if (s.nodes) effects.push_back({"moving nodes", 0});
  if (s.contacts) effects.push_back({"loads of triangles", 0});
  if (s.law().keeps_forces)
    effects.push_back(
        {"energy balance", (kKeptForces + (s.law().keeps_at_nodes ? kKeptAtNodes : 0)) *
                               static_cast<int>(sizeof(Real))});
  if (s.energy_places) effects.push_back({"energy of triangles", 0});
  if (s.law().keeps_losses)
    effects.push_back({"energy of contacts", kKeptLosses * static_cast<int>(sizeof(Real))});
  if (s.impact_speed > 0) effects.push_back({"impacts", 0});
  if (s.wear == WearModel::archard) effects.push_back({"wear archard", 0});
  if (s.wear == WearModel::finnie) effects.push_back({"wear finnie", 0});
  if (s.wears_by_impact()) effects.push_back({"wear oka", 0});
  return effects;
}

}    // namespace lsdcd
