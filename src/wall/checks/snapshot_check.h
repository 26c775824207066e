// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What a wall does not know in a snapshot of a replay: what follows from the time alone is right, what adds up from step to step
// is not known.
#pragma once

#include "wall/part/mesh_part.h"

#include <deque>

namespace lsdcd {

class SnapshotCheck {
 public:
  // Both arguments must outlive this object.
  SnapshotCheck(Host &host, const WallSpec &wall) : host_(host), wall_(wall) {}

  // Throws InputError if a place, a surface or a mean is not known in this snapshot, and warns once of springs, spins, loads and
  // energies that are not known.
  void check(const std::deque<MeshPart> &meshes, const Step &step);

 private:
  Host &host_;
  const WallSpec &wall_;
  bool warned_ = false;
};

}    // namespace lsdcd
