#include "effects/effects.h"

namespace lsdcd {

namespace {

constexpr int kNumber = sizeof(Real), kVector = 3 * kNumber;

void add_classic(const ContactLaw &law, std::vector<Effect> &effects)
{
  effects.push_back({"normal spring", 0});
  if (law.style == LawStyle::hertz_history) effects.push_back({"hertz stiffness", 0});
  if (law.gamma_normal > 0) effects.push_back({"normal damping", 0});
  if (law.mu > 0 && law.style != LawStyle::hooke && law.k_tangent > 0)
    effects.push_back({"tangential spring", 0});
  if (law.mu > 0 && law.gamma_tangent > 0) effects.push_back({"tangential damping", 0});
  effects.push_back({law.mu > 0 ? "sliding limit" : "no friction", 0});
  if (law.added.rolling == AddedRolling::cdt) effects.push_back({"rolling cdt", 0});
  if (law.added.rolling == AddedRolling::epsd2) effects.push_back({"rolling epsd2", kVector});
  if (law.added.cohesion > 0) effects.push_back({"cohesion sjkr", 0});
}

void add_granular(const ContactLaw &law, std::vector<Effect> &effects)
{
  const GranularLaw &g = law.granular;
  const char *const normals[] = {"linear spring", "hertz spring", "dmt adhesion", "jkr adhesion"};
  effects.push_back({normals[static_cast<int>(g.normal)], 0});

  const bool damps = g.damping != DampingModel::none && g.eta > 0;
  if (damps) effects.push_back({"normal damping", 0});

  if (g.tangential != TangentialModel::linear_nohistory)
    effects.push_back({"tangential spring", 0});
  if (law.has_rescale()) effects.push_back({"rescaling on unloading", kNumber});
  if (damps && g.x_tangent > 0) effects.push_back({"tangential damping", 0});
  effects.push_back({g.mu > 0 ? "sliding limit" : "no friction", 0});

  if (law.has_rolling()) effects.push_back({"rolling resistance", kVector});
  if (law.has_twisting()) effects.push_back({"twisting resistance", kNumber});
  if (law.has_heat()) effects.push_back({"heat conduction", 0});
}

}    // namespace

std::vector<Effect> effects_of(const EngineSettings &s)
{
  std::vector<Effect> effects;
  if (s.law.style == LawStyle::granular)
    add_granular(s.law, effects);
  else
    add_classic(s.law, effects);
  if (s.surface.moves()) effects.push_back({"moving surface", 0});
  if (s.moves) effects.push_back({"moving wall", 0});
  if (s.records) effects.push_back({"loads of triangles", 0});
  if (s.wear == WearModel::archard) effects.push_back({"wear archard", 0});
  if (s.wear == WearModel::finnie) effects.push_back({"wear finnie", 0});
  return effects;
}

}    // namespace lsdcd
