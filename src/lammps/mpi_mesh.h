// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Meshes that every process has whole.
#pragma once

#include "host/host.h"
#include "mesh/welded_mesh.h"
#include "wall/spec/wall_spec.h"

namespace lsdcd {

// Returns the mesh of a spec on every process. Only the first process reads the file, which may not be there on other nodes. Collective;
// throws InputError on all.
WeldedMesh read_together(Host &host, const MeshSpec &settings);

// Returns a copy of a mesh that the first process has; others give null. Its faces keep their numbers.
WeldedMesh copy_together(Host &host, const WeldedMesh *mesh);

}    // namespace lsdcd
