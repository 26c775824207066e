// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The engine for grains that may be no spheres, on a CPU.
#pragma once

#include "engine/engine.h"

#include <memory>

namespace lsdcd {

// Makes the engine for a law that is ContactLaw::for_shapes. It does all that the engine for spheres does, and each
// step reads Spheres::shapes. Each mesh needs a tree.
std::unique_ptr<WallEngine> make_shape_engine(const EngineSettings &settings);

// Returns why grains that are no spheres cannot have this law, or an empty text.
std::string why_not_for_shapes(const ContactLaw &law);

}    // namespace lsdcd
