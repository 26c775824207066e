// Which backend this run of a test program is for.
#pragma once

#include "engine/wall_engine.h"

#include <cstdlib>
#include <cstring>

namespace lsdcd {

inline bool test_on_cuda()
{
  const char *device = std::getenv("LSDCD_TEST_DEVICE");
  return device && std::strcmp(device, "cuda") == 0;
}
inline Device test_device()
{
  return test_on_cuda() ? Device::cuda : Device::cpu;
}

}    // namespace lsdcd
