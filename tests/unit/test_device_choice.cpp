// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Which device computes where none was asked for. The numbers are those of doc/notes/performance.md.
#include "wall/device_choice.h"

#include <gtest/gtest.h>

namespace lsdcd::test_device_choice {
namespace {

TEST(DeviceChoice, is_closed_without_a_gpu)
{
  DeviceChoice choice(Device::automatic, 0, 1);
  EXPECT_FALSE(choice.is_open());
  EXPECT_FALSE(choice.update(1000000));
}

TEST(DeviceChoice, keeps_a_device_that_was_asked_for)
{
  for (const Device asked : {Device::cpu, Device::cuda}) {
    DeviceChoice choice(asked, 1, 1);
    EXPECT_FALSE(choice.update(0));
    EXPECT_FALSE(choice.update(1000000));
    EXPECT_EQ(choice.device(), asked);
  }
}

// 100 spheres take 0.016 ms on a core and 0.043 on the GPU, 900 take 0.199 and 0.143.
TEST(DeviceChoice, takes_the_faster_one_for_a_process_alone)
{
  DeviceChoice choice(Device::automatic, 1, 1);
  EXPECT_TRUE(choice.update(100));
  EXPECT_EQ(choice.device(), Device::cpu);
  EXPECT_TRUE(choice.update(900));
  EXPECT_EQ(choice.device(), Device::cuda);
}

// In each of 16 processes 6 241 spheres take 1.65 ms on its core and 3.28 on the GPU of all, 62 500 take 19.2 and 13.3.
TEST(DeviceChoice, takes_the_faster_one_for_processes_on_one_gpu)
{
  DeviceChoice choice(Device::automatic, 1, 16);
  choice.update(6241);
  EXPECT_EQ(choice.device(), Device::cpu);
  choice.update(62500);
  EXPECT_EQ(choice.device(), Device::cuda);
}

TEST(DeviceChoice, counts_the_processes_of_each_gpu)
{
  EXPECT_EQ(DeviceChoice(Device::automatic, 4, 16).least_for_gpu(),
            DeviceChoice(Device::automatic, 1, 4).least_for_gpu());
  EXPECT_EQ(DeviceChoice(Device::automatic, 2, 3).least_for_gpu(),
            DeviceChoice(Device::automatic, 1, 2).least_for_gpu());
}

TEST(DeviceChoice, does_not_swing_with_the_number)
{
  DeviceChoice choice(Device::automatic, 1, 1);
  choice.update(choice.least_for_gpu());
  EXPECT_FALSE(choice.update(choice.least_for_gpu() - 1));
  EXPECT_TRUE(choice.update(choice.least_for_gpu() / 2 - 1));
  EXPECT_FALSE(choice.update(choice.least_for_gpu() - 1));
}

}    // namespace
}    // namespace lsdcd::test_device_choice
