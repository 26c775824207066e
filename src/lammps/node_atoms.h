// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The atoms that are the nodes of one mesh: found once at the welded vertices, known by their tags from then on,
// wherever LAMMPS sorts them or sends them.
#pragma once

#include "lammps/own_messages.h"
#include "wall/wall.h"

#include "lmptype.h"

#include <string>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

class NodeAtoms {
 public:
  // `mesh`: of the wall, which has_nodes.
  NodeAtoms(class LAMMPS *lmp, int mesh) : lmp(lmp), mesh(mesh) {}

  // Before a run: finds them where that was not done, and checks what may have changed. `wall_bit`: of the group of the
  // spheres. Throws InputError, the same on all processes, where a vertex has no atom or two, and where an atom is a
  // sphere of the wall, too. Collective.
  void init(lsdcd::Wall &wall, int wall_bit);

  // Before a step: gives the wall the places and velocities of all nodes. `look`: atoms may have other indices since
  // the last time. Throws InputError where one is lost. Collective.
  void send(lsdcd::Wall &wall, bool look);
  // After it: adds the forces on them. Collective.
  void add_forces(lsdcd::Wall &wall);

 private:
  void set_tags(const std::vector<double> &);
  void find(const lsdcd::Wall &wall);
  void find_local();

  class LAMMPS *lmp;
  int mesh, bit = 0;
  std::vector<tagint> tag_of;                 // of each node
  std::unordered_map<tagint, int> node_of;    // of each tag
  struct Local {
    int atom, node;
  };
  std::vector<Local> local;    // nodes of this process
  std::vector<double> numbers;
};

}    // namespace LAMMPS_NS
