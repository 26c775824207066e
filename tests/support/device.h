// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The backend that this run of a test program is for.
#pragma once

#include "engine/engine.h"

#include <cstdlib>
#include <cstring>

namespace lsdcd {

// LSDCD_TEST_DEVICE: cpu (or nothing), cuda, cpu_in_place, cuda_in_place.
inline bool test_device_has(const char *word)
{
  const char *device = std::getenv("LSDCD_TEST_DEVICE");
  return device && std::strstr(device, word);
}
inline bool test_on_cuda()
{
  return test_device_has("cuda");
}
inline bool test_in_place()
{
  return test_device_has("in_place");
}
inline Device test_device()
{
  return test_on_cuda() ? Device::cuda : Device::cpu;
}

// LSDCD_PAIRS: how many pairs a test of random ones takes, 1e6 unless given, or 1e7 on a GPU.
inline double random_pairs()
{
  const char *text = std::getenv("LSDCD_PAIRS");
  return text && *text ? std::atof(text) : test_on_cuda() ? 1e7 : 1e6;
}

}    // namespace lsdcd
