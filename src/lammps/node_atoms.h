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
  // `mesh`: a mesh of the wall that has_nodes.
  NodeAtoms(class LAMMPS *lmp, int mesh) : lmp(lmp), mesh(mesh) {}

  // Finds the atoms before a run, if they were not found yet, and checks what may have changed. `wall_bit`: of the group of the spheres.
  // `keeps_tags`: atoms have the tags that they had and may be anywhere, as in a rerun. Returns what the log should say. Throws InputError,
  // the same on all processes, if a vertex has no atom or two, or if an atom is also a sphere of the wall. Collective.
  std::string init(lsdcd::Wall &wall, int wall_bit, bool keeps_tags);

  // Checks, by the places of the wall's nodes, that the tags still belong to the same atoms, and finds the atoms there if they have other
  // tags; returns what the log should say then. Throws InputError if an atom is lost, or if they may be other atoms. Collective.
  std::string check_tags(lsdcd::Wall &wall);

  bool is_of(int which) const { return which == mesh; }

  // Gives the wall the places and velocities of all nodes before a step. `look`: atoms may have other indices since the last time. `now`:
  // the step. Throws InputError if an atom is lost. Collective.
  void send(lsdcd::Wall &wall, bool look, const lsdcd::Step &now);
  // Returns where the atoms are now, in the order of the nodes. Throws InputError if one is lost. Collective.
  std::vector<lsdcd::Vec3> places(const lsdcd::Wall &wall);
  // Adds the forces on the nodes to the atoms after a step. Collective.
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
