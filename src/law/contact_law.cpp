#include "law/contact_law.h"

#include "law/submodels/normal.h"

#include <cmath>

namespace lsdcd {

Real ContactLaw::pull_off() const
{
  return is(NormalModel::jkr) ? JkrNormal<Real>(granular.modulus, granular.cohesion).pull_off : 0;
}

Real tsuji_damping(Real e)
{
  const Real c[] = {4.8218, -18.022, 27.467, -22.348, 11.087, -4.2783, 1.2728};
  Real sum = 0;
  for (Real each : c) sum = sum * e + each;
  return std::sqrt(Real(2)) * sum;
}

Real restitution_damping(NormalModel normal, Real e)
{
  const Real pi = 3.14159265358979323846, l = std::log(e);
  return -(normal == NormalModel::hooke ? 2 : std::sqrt(Real(5))) * l / std::sqrt(pi * pi + l * l);
}

Real cutoff_of(const ContactLaw &law, Real radius)
{
  return cutoff_of(radius, law.pull_off());
}

}    // namespace lsdcd
