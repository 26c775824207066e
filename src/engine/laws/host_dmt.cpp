#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_dmt_law(const ContactLaw &p)
{
  return with_granular_law(p, DmtNormal<Real>(p.granular.k_normal, p.granular.cohesion),
                           MakeHostLaw());
}

}    // namespace lsdcd
