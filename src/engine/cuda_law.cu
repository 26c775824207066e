#include "engine/cuda_law.h"

namespace lsdcd {

CudaLaw cuda_law(const EngineSettings &settings)
{
  const ContactLaw &law = settings.law;
  if (law.style != LawStyle::granular) {
    if (settings.precision == Precision::single_)
      return with_classic_law<float>(law, MakeCudaLaw());
    return with_classic_law<Real>(law, MakeCudaLaw());
  }
  switch (law.granular.normal) {
    case NormalModel::hertz:
      return cuda_hertz_law(law);
    case NormalModel::dmt:
      return cuda_dmt_law(law);
    case NormalModel::jkr:
      return cuda_jkr_law(law);
    default:
      return cuda_hooke_law(law);
  }
}

}    // namespace lsdcd
