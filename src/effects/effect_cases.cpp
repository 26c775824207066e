// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "effects/effects.h"

#include "contact/spring.h"

#include <algorithm>
#include <array>

namespace lsdcd {

namespace {

EngineSettings classic(NormalModel normal, bool history)
{
  EngineSettings s;
  s.law() = classic_law(normal, history);
  s.law().k_normal = 1e5;
  s.law().k_tangent = 3e4;
  s.law().eta = 50;
  s.law().gamma_tangent = 25;
  s.law().mu = 0.5;
  return s;
}

EngineSettings granular(NormalModel normal, TangentialModel tangential)
{
  EngineSettings s;
  s.law() = granular_law(NormalModel::hooke);
  ContactLaw &g = s.law();
  g.normal = normal;
  g.k_normal = 1e5;
  g.modulus = 7.5e4;
  g.surface_energy = 0.1;
  g.damping = DampingModel::none;
  g.eta = 0.1;
  g.tangential = tangential;
  g.k_tangent = 3e4;
  g.xgammat = 0.5;
  g.mu = 0.5;
  return s;
}

}    // namespace

std::vector<EffectCase> effect_cases()
{
  std::vector<EffectCase> cases;
  // Adds a case that is `over` with a change.
  const auto add = [&](const char *name, const char *words, const char *over, auto change) {
    EngineSettings s;
    for (const EffectCase &c : cases)
      if (c.name == over) s = c.settings;
    change(s);
    cases.push_back({name, words, over, s});
  };
  const auto begin = [&](const char *name, const char *words, const char *over,
                         const EngineSettings &s) {
    cases.push_back({name, words, over, s});
  };

  begin("hooke", "hooke", "", classic(NormalModel::hooke, false));
  begin("tangential spring", "hooke/history", "hooke", classic(NormalModel::hooke, true));
  begin("hertz stiffness", "hertz/history", "tangential spring", classic(NormalModel::hertz, true));
  add("rolling cdt", "rolling cdt", "hooke", [](EngineSettings &s) {
    s.law().rolling = {RollingModel::cdt, {0.1}};
  });
  add("rolling epsd2", "rolling epsd2", "tangential spring", [](EngineSettings &s) {
    s.law().rolling = {RollingModel::epsd2, {0.1}};
  });
  add("rolling epsd", "rolling epsd", "tangential spring", [](EngineSettings &s) {
    s.law().rolling = {RollingModel::epsd, {0.1, 0.3}};
  });
  add("rolling epsd3", "rolling epsd3", "tangential spring", [](EngineSettings &s) {
    s.law().rolling = {RollingModel::epsd3, {0.1, 0.3, 1}};
  });
  add("cohesion sjkr", "cohesion sjkr", "hooke", [](EngineSettings &s) {
    s.law().cohesion = {CohesionModel::sjkr, {1e3}};
  });
  add("moving surface", "surface_vel, surface_angvel", "hooke", [](EngineSettings &s) {
    s.surface = {{1, 0, 0}, {0, 0, 0.1}, {0, 0, 0}};
  });
  add("loads of triangles", "mesh_fields", "hooke", [](EngineSettings &s) { s.contacts = true; });
  add("rigid body", "body", "hooke", [](EngineSettings &s) { s.moves = s.bodies = true; });
  add("wear archard", "wear archard", "loads of triangles",
      [](EngineSettings &s) { s.wear = WearModel::archard; });
  add("wear finnie", "wear finnie", "loads of triangles",
      [](EngineSettings &s) { s.wear = WearModel::finnie; });
  add("wear oka", "wear oka", "loads of triangles", [](EngineSettings &s) {
    s.law().keeps_touch = true;
    s.wear = WearModel::oka;
    s.oka = {1.2, 0.73, 2, 2.3, 0.19, 1, 1, 0.01};
  });

  add("energy balance", "energy, compute lsdcd/energy", "tangential spring",
      [](EngineSettings &s) { s.law().keeps_forces = true; });
  add("energy of triangles", "energy, mesh_fields", "energy balance",
      [](EngineSettings &s) { s.energy_places = true; });
  add("energy of contacts", "energy, each_contact", "energy balance",
      [](EngineSettings &s) { s.law().keeps_losses = true; });
  add("impacts", "impacts", "tangential spring", [](EngineSettings &s) {
    s.law().keeps_touch = true;
    s.impact_speed = 0.01;
  });

  begin("granular hooke", "granular hooke ... linear_nohistory", "hooke",
        granular(NormalModel::hooke, TangentialModel::linear_nohistory));
  const auto normal = [](NormalModel n) { return [n](EngineSettings &s) { s.law().normal = n; }; };
  add("hertz", "granular hertz, hertz/material", "granular hooke", normal(NormalModel::hertz));
  add("dmt", "granular dmt", "hertz", normal(NormalModel::dmt));
  add("jkr", "granular jkr", "hertz", normal(NormalModel::jkr));
  const auto yielding = [](NormalModel n, const std::array<Real, kPlasticNumbers> &numbers) {
    return [n, numbers](EngineSettings &s) {
      s.law().normal = n;
      s.law().damping = DampingModel::none;
      std::copy(numbers.begin(), numbers.end(), s.law().plastic);
    };
  };
  add("hysteretic", "granular hysteretic", "granular hooke",
      yielding(NormalModel::hysteretic, {1e5, 0.5}));
  add("hysteretic/size", "granular hysteretic/size", "granular hooke",
      yielding(NormalModel::hysteretic_size, {2e5, 0.5}));
  add("hysteretic/edem", "granular hysteretic/edem", "granular hooke",
      yielding(NormalModel::hysteretic_edem, {5e5, 0.5}));
  add("eepa", "granular eepa", "hertz", yielding(NormalModel::eepa, {1e5, 4e5, 10, 1.5, 2, 0}));
  add("lepa", "granular lepa", "granular hooke", yielding(NormalModel::lepa, {1e5, 4e5, 1e5, 0.1}));
  add("thornton", "granular thornton", "hertz", yielding(NormalModel::thornton, {7.5e4, 1e4}));
  const auto cohesion = [](CohesionModel model, const std::array<Real, kMaxNumbers> &numbers) {
    return [model, numbers](EngineSettings &s) {
      s.law().cohesion = model;
      std::copy(numbers.begin(), numbers.end(), s.law().cohesion.numbers);
    };
  };
  add("cohesion capillary", "cohesion capillary", "granular hooke",
      cohesion(CohesionModel::capillary, {1, 20, 20, 1e-6}));
  add("cohesion capillary/share", "cohesion capillary/share", "granular hooke",
      cohesion(CohesionModel::capillary_share, {1, 20, 20, 1e-5}));
  add("cohesion constant", "cohesion constant", "granular hooke",
      cohesion(CohesionModel::constant, {10, 0.01}));
  add("cohesion constant/weight", "cohesion constant/weight", "granular hooke",
      cohesion(CohesionModel::constant_weight, {1, 10, 0.01}));
  add("cohesion linear", "cohesion linear", "granular hooke",
      cohesion(CohesionModel::linear, {1e3, 0.01}));
  const auto damping = [](DampingModel d) {
    return [d](EngineSettings &s) { s.law().damping = d; };
  };
  add("damping velocity", "damping velocity", "hertz", damping(DampingModel::velocity));
  add("damping mass_velocity", "damping mass_velocity", "hertz",
      damping(DampingModel::mass_velocity));
  add("damping viscoelastic", "damping viscoelastic", "hertz", damping(DampingModel::viscoelastic));
  add("damping tsuji", "damping tsuji, coeff_restitution", "hertz",
      damping(DampingModel::stiffness));
  const auto tangential = [](TangentialModel t) {
    return [t](EngineSettings &s) { s.law().tangential = t; };
  };
  add("linear_history", "tangential linear_history", "hertz",
      tangential(TangentialModel::linear_history));
  add("linear_history_slip", "tangential linear_history_slip", "hertz",
      tangential(TangentialModel::linear_history_slip));
  add("linear_nohistory_liggghts", "tangential linear_nohistory_liggghts", "hertz",
      tangential(TangentialModel::linear_nohistory_liggghts));
  add("linear_history_liggghts", "tangential linear_history_liggghts", "hertz",
      tangential(TangentialModel::linear_history_liggghts));
  add("mindlin", "tangential mindlin", "hertz", tangential(TangentialModel::mindlin));
  add("mindlin/force", "tangential mindlin/force", "hertz",
      tangential(TangentialModel::mindlin_force));
  add("mindlin_slip", "tangential mindlin_slip", "hertz",
      tangential(TangentialModel::mindlin_slip));
  add("mindlin_liggghts", "tangential mindlin_liggghts", "hertz",
      tangential(TangentialModel::mindlin_liggghts));
  add("mindlin_rescale", "tangential mindlin_rescale", "mindlin",
      tangential(TangentialModel::mindlin_rescale));
  add("mindlin_rescale/force", "tangential mindlin_rescale/force", "mindlin/force",
      tangential(TangentialModel::mindlin_rescale_force));
  add("rolling sds", "rolling sds", "mindlin", [](EngineSettings &s) {
    s.law().rolling = {RollingModel::sds, {1e4, 10, 0.1}};
  });
  const auto twisting = [](TwistingModel t) {
    return [t](EngineSettings &s) { s.law().twisting = {t, {1e4, 10, 0.1}}; };
  };
  add("twisting marshall", "twisting marshall", "mindlin", twisting(TwistingModel::marshall));
  add("twisting sds", "twisting sds", "mindlin", twisting(TwistingModel::sds));
  const auto heat = [](HeatModel h) { return [h](EngineSettings &s) { s.law().heat = {h, {1}}; }; };
  add("heat radius", "heat radius", "hertz", heat(HeatModel::radius));
  add("heat area", "heat area", "hertz", heat(HeatModel::area));

  // In common combinations.
  EngineSettings s = classic(NormalModel::hertz, true);
  s.law().rolling = {RollingModel::epsd2, {0.1}};
  s.law().cohesion = {CohesionModel::sjkr, {1e3}};
  begin("sticky grains", "hertz/history, rolling epsd2, cohesion sjkr", "", s);
  s = classic(NormalModel::hertz, true);
  s.surface.velocity = {1, 0, 0};
  s.contacts = true;
  s.wear = WearModel::archard;
  begin("belt that wears", "hertz/history, surface_vel, wear archard", "", s);
  s = granular(NormalModel::hertz, TangentialModel::mindlin);
  s.law().damping = DampingModel::stiffness;
  begin("dry grains", "granular hertz, tsuji, mindlin", "", s);
  s.law().rolling = {RollingModel::sds, {1e4, 0, 0.1}};
  s.law().twisting = TwistingModel::marshall;
  begin("rough grains", "granular hertz, tsuji, mindlin, rolling sds, twisting marshall", "", s);
  s.law().normal = NormalModel::jkr;
  s.law().heat = {HeatModel::area, {0}};
  begin("hot powder", "granular jkr, tsuji, mindlin, rolling sds, twisting marshall, heat area", "",
        s);
  return cases;
}

bool acts_on_pairs(const EngineSettings &s)
{
  return !(s.surface.moves() || s.moves || s.bodies || s.contacts || s.records_energy());
}

int bytes_per_atom(const EngineSettings &settings)
{
  return settings.law().has_history() ? 2 * sizeof(int) : 0;    // where its springs are
}

int bytes_per_contact(const EngineSettings &settings)
{
  if (!settings.law().has_history()) return 0;
  return static_cast<int>(sizeof(Spring) + settings.law().n_extra() * sizeof(Real));
}

}    // namespace lsdcd
