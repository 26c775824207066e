// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The atoms that are the nodes of one mesh: found once at the welded vertices, known by their tags in a run,
// wherever LAMMPS sorts them or sends them. Between runs a command may give atoms other tags.
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
  // spheres. `keeps_tags`: atoms have the tags that they had and may be anywhere, as in a rerun. Returns what the log should
  // say. Throws InputError, the same on all processes, where a vertex has no atom or two, and where an atom is a sphere of
  // the wall, too. Collective.
  std::string init(lsdcd::Wall &wall, int wall_bit, bool keeps_tags);

  // Checks by the places where the wall has its nodes that the atoms with their tags are still they, and finds them there
  // if they have other tags; returns what the log should say then. Throws InputError where one is lost, and where they may
  // be others. Collective.
  std::string check_tags(lsdcd::Wall &wall);

  bool is_of(int which) const { return which == mesh; }

  // Before a step: gives the wall the places and velocities of all nodes. `look`: atoms may have other indices since
  // the last time. `now`: the step. Throws InputError where one is lost. Collective.
  void send(lsdcd::Wall &wall, bool look, const lsdcd::Step &now);
  // Returns where they are now, in the order of the nodes. Throws InputError where one is lost. Collective.
  std::vector<lsdcd::Vec3> places(const lsdcd::Wall &wall);
  // After it: adds the forces on them. Collective.
  void add_forces(lsdcd::Wall &wall);
  // Returns the sum of force times velocity over the nodes of this process. `force`: x y z, node after node.
  double power(const std::vector<double> &force);

 private:
  // Atoms of the group near places: of each place how many, and the sum of their tags.
  struct Near {
    std::vector<double> count, tag;
  };

  void set_tags(const std::vector<double> &);
  Near atoms_near(const std::vector<lsdcd::Vec3> &places, double tolerance) const;
  void find(const lsdcd::Wall &wall);
  void find_local();
  void gather(const lsdcd::Wall &wall, bool look, const lsdcd::Step &now);
  int lost() const;
  [[noreturn]] void fail_lost(const lsdcd::Wall &wall, int node, const std::string &why = "") const;
  bool may_be_others(const lsdcd::WeldedMesh &was) const;
  int bit_of_fix_move() const;

  class LAMMPS *lmp;
  int mesh, bit = 0;
  std::vector<tagint> tag_of;                 // of each node
  std::unordered_map<tagint, int> node_of;    // of each tag
  struct Local {
    int atom, node;
  };
  std::vector<Local> local;    // nodes of this process
  int moved_bit = 0;           // of the groups that fix move moves
  std::vector<double>
      numbers;    // of all nodes: places, velocities, and where atoms are looked for how many have the tag
};

}    // namespace LAMMPS_NS
