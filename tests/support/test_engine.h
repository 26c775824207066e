// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engine that a test program tests.
#pragma once

#include "engine/engine.h"

#include <functional>
#include <memory>

namespace lsdcd {

// By LSDCD_TEST_DEVICE: cpu; cuda, which takes a host's particles;
// cuda_in_place, for particles in the GPU's memory, where this brings those of the test.
std::unique_ptr<WallEngine> make_test_engine(EngineSettings settings);

// Engines to compare with: that of the CPU, and one for particles in the memory of the tested device, with
// other layouts.
std::unique_ptr<WallEngine> on_cpu(EngineSettings settings);
std::unique_ptr<WallEngine> in_place(EngineSettings settings);
// Its begin() calls `before_begin` first, which may throw.
std::unique_ptr<WallEngine> in_place_after(EngineSettings settings,
                                           std::function<void()> before_begin);
// One on the CPU that copies as if it were on a GPU.
std::unique_ptr<WallEngine> with_mirror(EngineSettings settings);

}    // namespace lsdcd
