#include "base/version.h"

namespace lsdcd {

const char *version()
{
  return LSDCD_VERSION;
}

}    // namespace lsdcd
