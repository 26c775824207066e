// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "support/device.h"

#include <cstdio>
#include <gtest/gtest.h>

// Exit code 77 tells CTest that the whole program was skipped; the reason is printed.
int main(int argc, char **argv)
{
  testing::InitGoogleTest(&argc, argv);
  std::string why;
  if (lsdcd::test_on_cuda() && !lsdcd::cuda_available(&why)) {
    std::printf("skipped on CUDA: %s\n", why.c_str());
    return 77;
  }
  return RUN_ALL_TESTS();
}
