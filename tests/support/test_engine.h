// The engine that a run of a test program is for.
#pragma once

#include "engine/wall_engine.h"

#include <memory>

namespace lsdcd {

// By LSDCD_TEST_DEVICE: cpu; cuda, which takes a host's particles; cuda_in_place: an engine for
// particles in the GPU's memory, where this one brings those of a host.
std::unique_ptr<WallEngine> make_test_engine(EngineSettings settings);

// What tests compare: the engine of the CPU, and the one that the run is for.
std::unique_ptr<WallEngine> on_cpu(EngineSettings settings);

}    // namespace lsdcd
