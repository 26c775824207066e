// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Triangles, or a mesh where it is, as STL files that read_stl() and other programs read.
#pragma once

#include "mesh/welded_mesh.h"
#include "motion/pose.h"

#include <string>
#include <vector>

namespace lsdcd {

// Returns the bytes of a file, in the order and winding of the soup: binary if all corners are floats, else text with
// every bit.
std::string stl_bytes(const TriangleSoup &soup);

// Binary; corners rounded to float, in the winding of the mesh. The file appears whole or not at all;
// throws InputError that names it.
void write_mesh_stl(const std::string &path, const WeldedMesh &mesh, const Pose &pose = {});

// Returns a corner rounded to float, as in a binary file.
Vec3 rounded_as_in_stl(const Vec3 &corner);

bool are_floats(const std::vector<Vec3> &points);

}    // namespace lsdcd
