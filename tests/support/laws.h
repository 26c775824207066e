// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Contact laws for tests.
#pragma once

#include "engine/engine.h"

namespace lsdcd {

inline EngineSettings hooke(Real k, Real gamma_normal = 0, Real gamma_tangent = 0, Real mu = 0)
{
  EngineSettings s;
  s.law().k_normal = k;
  s.law().eta = gamma_normal;
  s.law().gamma_tangent = gamma_tangent;
  s.law().mu = mu;
  return s;
}

inline EngineSettings hooke_history(Real k, Real k_tangent, Real gamma_normal, Real gamma_tangent,
                                    Real mu)
{
  EngineSettings s = hooke(k, gamma_normal, gamma_tangent, mu);
  s.law().tangential = TangentialModel::linear_history_classic;
  s.law().k_tangent = k_tangent;
  return s;
}

inline EngineSettings hertz_history(Real k, Real k_tangent, Real gamma_normal, Real gamma_tangent,
                                    Real mu)
{
  EngineSettings s = hooke_history(k, k_tangent, gamma_normal, gamma_tangent, mu);
  s.law().normal = NormalModel::hertz;
  return s;
}

// `granular` with one normal sub-model and nothing else: no damping, no friction.
inline EngineSettings granular(NormalModel normal, Real k, Real cohesion = 0)
{
  EngineSettings s;
  s.law() = granular_law(NormalModel::hooke);
  ContactLaw &g = s.law();
  g.normal = normal;
  g.k_normal = k;
  g.modulus = 0.75 * k;
  g.surface_energy = cohesion;
  g.damping = DampingModel::none;
  return s;
}

}    // namespace lsdcd
