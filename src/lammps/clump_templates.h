// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Clumps of spheres that are the molecules of a template of LAMMPS, and the rigid fix that moves them.
#ifndef LSDCD_CLUMP_TEMPLATES_H
#define LSDCD_CLUMP_TEMPLATES_H

#include "insert/grain_source.h"

#include "fix.h"
#include "pointers.h"

#include <cstddef>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class ClumpTemplates : protected Pointers {
 public:
  // Takes all molecules of the template. Throws InputError where one is no clump, or where the headers of LAMMPS have no class Molecule.
  ClumpTemplates(LAMMPS *lmp, const std::string &id);

  // Returns a kind of grains for each molecule. `shares`: of them; empty: equal ones. Throws InputError where their number is another.
  std::vector<lsdcd::GrainKind> kinds(const std::vector<double> &shares) const;
  std::size_t n_atoms(std::size_t kind) const { return clumps_[kind].balls.size(); }
  int type(std::size_t kind, std::size_t i) const { return clumps_[kind].types[i]; }
  // Returns the largest radius of atoms of a type; 0: there are none.
  double largest_radius(int type) const;
  // Returns a text that names a molecule whose mass is not that of its atoms, which LAMMPS sums at each run; empty: there is none.
  std::string other_mass() const;

  // Returns why the fix makes no bodies of these molecules, or an empty text.
  std::string why_not(Fix &rigid) const;
  // Gives the local atom m, which is new, the mass and the diameter that the atom i of the molecule has. `before`: the ID before that
  // of its first atom.
  void fill(std::size_t kind, std::size_t i, int m, tagint before) const;
  // Tells the fix of a clump whose centre of mass is at x (length, in the box) with the velocity v. The local atoms from `first` on
  // are those of it that this process has. Collective.
  void tell(Fix &rigid, std::size_t kind, int first, tagint before, const lsdcd::Vec3 &x,
            const lsdcd::Vec3 &v, const lsdcd::Quaternion &turn) const;

 private:
  struct Clump {
    class Molecule *molecule;
    double mass, sum;                  // of the molecule, and of its atoms
    lsdcd::Vec3 to_geometric;          // from the centre of mass to the mean of the atoms' places
    std::vector<lsdcd::Ball> balls;    // about the centre of mass
    std::vector<int> types;
  };
  void add(class Molecule &molecule);

  std::string id_;
  int first_ = 0;    // index among all molecules
  std::vector<Clump> clumps_;
};

}    // namespace LAMMPS_NS

#endif
