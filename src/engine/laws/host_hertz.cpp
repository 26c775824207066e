#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_hertz_law(const ContactLaw &p)
{
  return with_granular_law(p, HertzNormal<Real>{p.granular.k_normal}, MakeHostLaw());
}

}    // namespace lsdcd
