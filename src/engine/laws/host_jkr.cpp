#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_jkr_law(const ContactLaw &p)
{
  return with_granular_law(p, JkrNormal<Real>(p.granular.modulus, p.granular.cohesion),
                           MakeHostLaw());
}

}    // namespace lsdcd
