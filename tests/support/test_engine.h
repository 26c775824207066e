// The engine that a run of a test program is for.
#pragma once

#include "engine/resident_engine.h"

#include <memory>

namespace lsdcd {

// By LSDCD_TEST_DEVICE: cpu, cuda; resident, resident_cuda: an engine for particles that
// live where it computes, behind the door of one for a host's.
std::unique_ptr<WallEngine> make_test_engine(EngineSettings settings);

// A resident engine behind the door of one for a host's particles; `cuda`: they are on a GPU.
std::unique_ptr<WallEngine> for_host(std::unique_ptr<ResidentEngine> engine, bool has_history,
                                     bool cuda);

// The same, by name. `settings.device` says where.
std::unique_ptr<WallEngine> make_resident_test_engine(const EngineSettings &settings);

// What tests compare: an engine for a host's particles on the CPU, and a resident one on
// the device that the run is for.
std::unique_ptr<WallEngine> on_host(EngineSettings settings);
std::unique_ptr<WallEngine> in_place(EngineSettings settings);

}    // namespace lsdcd
