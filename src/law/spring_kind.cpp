#include "law/spring_kind.h"

namespace lsdcd {

namespace {

enum class Shear { unused, displacement, force };
enum class Rolled { none, displacement, torque };

Shear shear_of(const ContactLaw &law)
{
  if (law.style == LawStyle::hooke) return Shear::unused;
  if (law.style != LawStyle::granular) return Shear::displacement;
  switch (law.granular.tangential) {
    case TangentialModel::linear_nohistory:
      return Shear::unused;
    case TangentialModel::mindlin_force:
    case TangentialModel::mindlin_rescale_force:
      return Shear::force;
    default:
      return Shear::displacement;
  }
}

Rolled rolled_of(const ContactLaw &law)
{
  if (law.has_rolling()) return Rolled::displacement;
  return law.added.rolling == AddedRolling::epsd2 ? Rolled::torque : Rolled::none;
}

}    // namespace

// A decimal digit for each.
int spring_kind(const ContactLaw &law)
{
  const TwistingModel twisting = law.has_twisting() ? law.granular.twisting : TwistingModel::none;
  return static_cast<int>(shear_of(law)) + 10 * law.has_rescale() +
         100 * static_cast<int>(rolled_of(law)) + 1000 * static_cast<int>(twisting);
}

}    // namespace lsdcd
