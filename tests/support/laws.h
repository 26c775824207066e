// Contact laws for tests.
#pragma once

#include "engine/wall_engine.h"

namespace lsdcd {

inline EngineSettings hooke(Real k, Real gamma_normal = 0, Real gamma_tangent = 0, Real mu = 0)
{
  EngineSettings s;
  s.law.style = LawStyle::hooke;
  s.law.k_normal = k;
  s.law.gamma_normal = gamma_normal;
  s.law.gamma_tangent = gamma_tangent;
  s.law.mu = mu;
  return s;
}

inline EngineSettings hooke_history(Real k, Real k_tangent, Real gamma_normal, Real gamma_tangent,
                                    Real mu)
{
  EngineSettings s = hooke(k, gamma_normal, gamma_tangent, mu);
  s.law.style = LawStyle::hooke_history;
  s.law.k_tangent = k_tangent;
  return s;
}

inline EngineSettings hertz_history(Real k, Real k_tangent, Real gamma_normal, Real gamma_tangent,
                                    Real mu)
{
  EngineSettings s = hooke_history(k, k_tangent, gamma_normal, gamma_tangent, mu);
  s.law.style = LawStyle::hertz_history;
  return s;
}

}    // namespace lsdcd
