#include "engine/host_law.h"

namespace lsdcd {

HostLaw host_hooke_law(const ContactLaw &p)
{
  return with_granular_law(p, HookeNormal<Real>{p.granular.k_normal}, MakeHostLaw());
}

}    // namespace lsdcd
