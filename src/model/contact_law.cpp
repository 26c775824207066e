#include "model/contact_law.h"

#include "model/normal.h"

namespace lsdcd {

Real ContactLaw::pull_off() const
{
  return is(NormalModel::jkr) ? JkrNormal<Real>(granular.modulus, granular.cohesion).pull_off : 0;
}

Real reach_of(const ContactLaw &law, Real radius)
{
  return reach_of(radius, law.pull_off());
}

}    // namespace lsdcd
