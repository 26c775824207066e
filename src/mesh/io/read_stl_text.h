// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The ASCII kind of STL; private to the mesh room.
#pragma once

#include "mesh/triangle_soup.h"

#include <cstddef>

namespace lsdcd {

// True if the bytes begin as an ASCII STL does: "solid", any name, then "facet" or
// "endsolid" on a later line.
bool begins_as_stl_text(const char *bytes, std::size_t size);

bool begins_with_solid(const char *bytes, std::size_t size);    // the word

// Appends the facets of every solid to `soup`; soup.source is used in messages.
// Throws InputError naming the file, the line, the value and the remedy.
void read_stl_text(const char *bytes, std::size_t size, TriangleSoup &soup);

}    // namespace lsdcd
