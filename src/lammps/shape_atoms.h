// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Shapes of LAMMPS's ellipsoids and superellipsoids, as rows for the wall.
#ifndef LSDCD_SHAPE_ATOMS_H
#define LSDCD_SHAPE_ATOMS_H

#include "pointers.h"
#include "wall/spheres/host_spheres.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

// Reads the atoms of this process by a compute property/atom of its own, because not every host has the header of their
// atom style.
class ShapeAtoms : protected Pointers {
 public:
  // `fix`: an ID, from which that of the compute is made.
  ShapeAtoms(LAMMPS *lmp, const std::string &fix);
  ~ShapeAtoms() override;
  ShapeAtoms(const ShapeAtoms &) = delete;
  ShapeAtoms &operator=(const ShapeAtoms &) = delete;

  // Returns why the wall cannot have the atoms of this style, or an empty text.
  static std::string why_not(const Atom &atom);

  // Returns whether atoms have exponents and a radius of the sphere around them; else, where they have a radius, it is of the sphere
  // as which they touch each other.
  static bool has_superellipsoids(const Atom &atom);

  // Gives the local atom m, which has a mass and no shape yet, that of the row.
  void make(int m, const lsdcd::GrainShape &row);

  // Gives rows, radii of spheres around the grains, and angular velocities to `to`, which has the spheres of the atom style, if it
  // has any. They hold until the next call.
  void put(lsdcd::HostSpheres &to);

  double bytes() const;

 private:
  class Compute &compute() const;

  std::string id_;
  std::vector<lsdcd::GrainShape> rows_;
  std::vector<double> radius_, omega_;
};

}    // namespace LAMMPS_NS

#endif
