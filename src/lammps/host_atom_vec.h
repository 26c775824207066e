// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// How LAMMPS makes an atom, and copies one over another, by which it deletes one.
#pragma once

#include "atom.h"
#if __has_include("atom_vec.h")
#include "atom_vec.h"
#else
// Packages of LAMMPS do not install atom_vec.h. These functions have had these names since 2008, no
// class but those of Kokkos 2021 has its own, and no data of the class is touched.
namespace LAMMPS_NS {
class AtomVec {
 public:
  void copy(int, int, int);
  void create_atom(int, double *);
};
}    // namespace LAMMPS_NS
#endif
#if __has_include("atom_vec_ellipsoid.h")
#include "atom_vec_ellipsoid.h"
#else
namespace LAMMPS_NS {
// As above: it has had this function since 2010, and no data of the class is touched.
class AtomVecEllipsoid {
 public:
  int unpack_exchange_bonus(int, double *);
};
}    // namespace LAMMPS_NS
#endif

namespace lsdcd {

// Returns LAMMPS's ellipsoids; null: the atom style has none.
inline LAMMPS_NS::AtomVecEllipsoid *host_ellipsoids(LAMMPS_NS::Atom &atom)
{
  LAMMPS_NS::AtomVec *style = atom.style_match("ellipsoid");
#if __has_include("atom_vec_ellipsoid.h")
  return dynamic_cast<LAMMPS_NS::AtomVecEllipsoid *>(style);
#else
  // AtomVec is a virtual base in some versions: the object begins where its table of functions says.
  struct WithFunctions {
    virtual ~WithFunctions() = default;
  };
  return style ? static_cast<LAMMPS_NS::AtomVecEllipsoid *>(
                     dynamic_cast<void *>(reinterpret_cast<WithFunctions *>(style)))
               : nullptr;
#endif
}

}    // namespace lsdcd
