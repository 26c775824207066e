// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What of a WallSpec contradicts itself: the same sentences for scripts and for programs, under the names that each has.
#pragma once

#include "wall/spec/wall_spec.h"

#include <cstddef>

namespace lsdcd {

// By what errors call members: the keywords of a script, or the fields of the library's structs.
enum class SpecNames { keywords, fields };

// Throws InputError, which names the mesh and the member, where a wall cannot be made of this. That each number is in its own
// range (spec_ranges.h) is for those who read it.
void check_spec(const WallSpec &wall, SpecNames names = SpecNames::keywords);
// The part of it that a program's array of meshes is read after.
void check_mesh_count(std::size_t n, SpecNames names);

}    // namespace lsdcd
