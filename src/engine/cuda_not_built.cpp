#include "engine/wall_engine.h"

namespace lsdcd {

bool cuda_available(std::string *why)
{
  if (why) *why = "built without the CUDA toolkit";
  return false;
}

}    // namespace lsdcd
