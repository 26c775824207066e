// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/shape_atoms.h"

#include "base/input_error.h"
#include "lammps/host_atom_vec.h"
#include "lammps/host_fixes.h"
#include "shape/superellipsoid.h"

#include "atom.h"
#include "modify.h"
#include "update.h"

#include <cstdint>
#include <cstring>

using namespace LAMMPS_NS;

// The first LAMMPS with superellipsoids.
#define HOST_HAS_SUPERELLIPSOIDS (LSDCD_HOST_VERSION >= 20260330)

bool ShapeAtoms::has_superellipsoids([[maybe_unused]] const Atom &atom)
{
#if HOST_HAS_SUPERELLIPSOIDS
  return atom.superellipsoid_flag;
#else
  return false;
#endif
}

// Of property/atom, in the order in which put() reads them.
static constexpr char kOfEllipsoids[] = "shapex shapey shapez quatw quati quatj quatk";
static constexpr char kOfSuperellipsoids[] = " block1 block2 inertiax inertiay inertiaz";

// As fix nve/asphere has it.
static lsdcd::Vec3 inertia_of_ellipsoid(double mass, const lsdcd::Vec3 &half)
{
  const lsdcd::Vec3 square = {half.x * half.x, half.y * half.y, half.z * half.z};
  return 0.2 * mass * lsdcd::Vec3{square.y + square.z, square.z + square.x, square.x + square.y};
}

ShapeAtoms::ShapeAtoms(LAMMPS *lmp, const std::string &fix) :
    Pointers(lmp), id_(fix + "_lsdcd_shapes")
{
  std::string text = id_ + " all property/atom " + kOfEllipsoids;
  if (has_superellipsoids(*atom)) text += kOfSuperellipsoids;
  modify->add_compute(text);
}

// At the end LAMMPS may have deleted it.
ShapeAtoms::~ShapeAtoms()
{
  if (modify && lsdcd::host_compute(*modify, id_)) modify->delete_compute(id_);
}

std::string ShapeAtoms::why_not(const Atom &atom)
{
  if (!atom.rmass_flag || !atom.angmom_flag || !atom.torque_flag)
    return "ellipsoids need a mass, an angular momentum and a torque each: use atom_style "
           "ellipsoid";
  return "";
}

LAMMPS_NS::Compute &ShapeAtoms::compute() const
{
  LAMMPS_NS::Compute *found = lsdcd::host_compute(*modify, id_);
  if (!found)
    throw lsdcd::InputError("the compute " + id_ +
                            ", by which the wall reads shapes, was deleted: leave it there");
  return *found;
}

// By the numbers with which LAMMPS sends the atom to another process: half-axes, turn, and of a superellipsoid exponents and moments of
// inertia.
void ShapeAtoms::make(int m, const lsdcd::GrainShape &row)
{
  const lsdcd::Vec3 inertia = atom->rmass[m] * row.inertia_over_mass;
  double numbers[] = {0,          row.half.x,   row.half.y,   row.half.z,
                      row.turn.w, row.turn.v.x, row.turn.v.y, row.turn.v.z,
                      row.n1,     row.n2,       inertia.x,    inertia.y,
                      inertia.z};
  const std::int64_t has_shape =
      1;    // the first number is one of whole numbers, as ubuf of LAMMPS has it
  std::memcpy(numbers, &has_shape, sizeof has_shape);
  lsdcd::host_ellipsoids(*atom)->unpack_exchange_bonus(m, numbers);
}

void ShapeAtoms::put(lsdcd::HostSpheres &to)
{
  LAMMPS_NS::Compute &read = compute();
  read.compute_peratom();
  const int n = atom->nlocal;
  const bool super = has_superellipsoids(*atom);
  rows_.assign(n, lsdcd::GrainShape());
  radius_.assign(n, 0);
  omega_.assign(3 * static_cast<std::size_t>(n), 0);
  for (int i = 0; i < n; i++) {
    if (atom->ellipsoid[i] < 0) {
      if (atom->radius_flag) radius_[i] = atom->radius[i];
      for (int k = 0; k < 3 && atom->omega_flag; k++) omega_[3 * i + k] = atom->omega[i][k];
      continue;
    }
    const double *at = read.array_atom[i];
    lsdcd::GrainShape &row = rows_[i];
    row.half = {at[0] / 2, at[1] / 2, at[2] / 2};    // LAMMPS gives diameters
    row.turn = {at[3], {at[4], at[5], at[6]}};
    const double mass = atom->rmass[i];
    lsdcd::Vec3 inertia;
    if (super) {
      row.n1 = at[7];
      row.n2 = at[8];
      inertia = {at[9], at[10], at[11]};
    } else {
      inertia = inertia_of_ellipsoid(mass, row.half);
    }
    row.inertia_over_mass = (1 / mass) * inertia;
    radius_[i] = lsdcd::circumscribed_radius(row.half, row.n1, row.n2);
    const double *m = atom->angmom[i];
    const lsdcd::Vec3 own = rotate(inverse(row.turn), {m[0], m[1], m[2]});
    const lsdcd::Vec3 omega =
        rotate(row.turn, {own.x / inertia.x, own.y / inertia.y, own.z / inertia.z});
    for (int k = 0; k < 3; k++) omega_[3 * i + k] = omega[k];
  }
  to.shapes = rows_.data();
  to.radius = radius_.data();
  if (n) to.omega = omega_.data();
}

double ShapeAtoms::bytes() const
{
  return (double) rows_.capacity() * sizeof rows_[0] +
         (double) (radius_.capacity() + omega_.capacity()) * sizeof(double);
}
