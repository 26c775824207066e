// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/clump_templates.h"

#include "base/countable.h"
#include "base/input_error.h"
#include "base/number_words.h"

#include "atom.h"
// Debian's package of LAMMPS does not have this header.
#if __has_include("molecule.h")
#include "molecule.h"
#define HOST_HAS_MOLECULES 1
#else
#define HOST_HAS_MOLECULES 0
#endif

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using lsdcd::InputError;
using lsdcd::Vec3;

ClumpTemplates::ClumpTemplates(LAMMPS *lmp, const std::string &id) : Pointers(lmp), id_(id)
{
#if HOST_HAS_MOLECULES
  while (first_ < atom->nmolecule && id != atom->molecules[first_]->id) first_++;
  if (first_ == atom->nmolecule)
    throw InputError("in 'mol', there is no template '" + id + "': write 'molecule " + id +
                     " FILE' before this fix");
  for (int k = 0; k < atom->molecules[first_]->nset; k++) add(*atom->molecules[first_ + k]);
#else
  throw InputError(
      "'mol' needs a plugin that was built with the sources of LAMMPS: the headers with "
      "which this one was built have no molecules");
#endif
}

void ClumpTemplates::add(Molecule &molecule)
{
#if HOST_HAS_MOLECULES
  const std::string name =
      "in 'mol', molecule " + std::to_string(clumps_.size() + 1) + " of template '" + id_ + "' ";
  for (const auto &[has, what] : {std::pair<int, const char *>{molecule.xflag, "Coords"},
                                  {molecule.typeflag, "Types"},
                                  {molecule.radiusflag, "Diameters"},
                                  {molecule.rmassflag, "Masses"}})
    if (!has)
      throw InputError(name + "has no section " + what +
                       ", and a clump is of spheres: make the file by lsdcd clump");
  if (molecule.bondflag || molecule.bodyflag)
    throw InputError(name + "has bonds or bodies: a clump has spheres alone");
  molecule.compute_center();
  molecule.compute_mass();
  molecule.compute_com();
  molecule.compute_inertia();
  Clump clump = {&molecule, molecule.masstotal, 0, {}, {}, {}};
  const double *com = molecule.com, *middle = molecule.center;
  for (int d = 0; d < 3; d++) clump.to_geometric[d] = middle[d] - com[d];
  for (int i = 0; i < molecule.natoms; i++) {
    const double *x = molecule.x[i];
    const int type = molecule.type[i];
    if (type < 1 || type > atom->ntypes)
      throw InputError(name + "has atoms of type " + std::to_string(type) + ": there are " +
                       lsdcd::counted(atom->ntypes, "type"));
    if (!(molecule.radius[i] > 0) || !(molecule.rmass[i] > 0))
      throw InputError(name + "has an atom " + std::to_string(i + 1) +
                       " without a diameter or a mass above 0");
    clump.balls.push_back({{x[0] - com[0], x[1] - com[1], x[2] - com[2]}, molecule.radius[i]});
    clump.types.push_back(type);
    clump.sum += molecule.rmass[i];
  }
  clumps_.push_back(clump);
#else
  (void) molecule;
#endif
}

std::vector<lsdcd::GrainKind> ClumpTemplates::kinds(const std::vector<double> &shares) const
{
  if (!shares.empty() && shares.size() != clumps_.size())
    throw InputError("in 'mol', there are " + lsdcd::counted(shares.size(), "fraction") +
                     ", and template '" + id_ + "' has " +
                     lsdcd::counted(clumps_.size(), "molecule") + ": give a fraction of each");
  std::vector<lsdcd::GrainKind> all(clumps_.size());
  for (std::size_t k = 0; k < all.size(); k++) {
    all[k].balls = clumps_[k].balls;
    all[k].clump_mass = clumps_[k].mass;
    if (!shares.empty()) all[k].share = shares[k];
  }
  return all;
}

double ClumpTemplates::largest_radius(int type) const
{
  double most = 0;
  for (const Clump &clump : clumps_)
    for (std::size_t i = 0; i < clump.balls.size(); i++)
      if (clump.types[i] == type) most = std::max(most, clump.balls[i].radius);
  return most;
}

std::string ClumpTemplates::other_mass() const
{
  for (std::size_t k = 0; k < clumps_.size(); k++)
    if (std::fabs(clumps_[k].sum / clumps_[k].mass - 1) > 1e-6)
      return "molecule " + std::to_string(k + 1) + " of template " + id_ + " has a mass of " +
             lsdcd::number_text(clumps_[k].mass) + ", and its atoms have " +
             lsdcd::number_text(clumps_[k].sum) +
             " together, which LAMMPS gives the body as the next run begins: make the file by "
             "lsdcd "
             "clump, whose two are the same";
  return "";
}

std::string ClumpTemplates::why_not(Fix &rigid) const
{
  const std::string name = "fix " + std::string(rigid.id) + " of style " + rigid.style;
  int dim = 0;
  const void *theirs = rigid.extract("onemol", dim);
  if (!rigid.rigid_flag || !theirs)
    return name + " takes no new bodies: give the ID of a fix 'rigid/small molecule mol " + id_ +
           "'";
#if HOST_HAS_MOLECULES
  // LAMMPS keeps where in its list the template is, and the list moves where a molecule is added.
  if (theirs != atom->molecules + first_)
    return name + " has another template than '" + id_ +
           "', or a molecule command stands behind it: write all molecule commands before it, and "
           "'mol " +
           id_ + "' in it";
#endif
  return "";
}

void ClumpTemplates::fill(std::size_t kind, std::size_t i, int m, tagint before) const
{
  atom->add_molecule_atom(clumps_[kind].molecule, static_cast<int>(i), m, before);
}

void ClumpTemplates::tell(Fix &rigid, std::size_t kind, int first, tagint before, const Vec3 &x,
                          const Vec3 &v, const lsdcd::Quaternion &turn) const
{
  const Vec3 middle = x + rotate(turn, clumps_[kind].to_geometric);
  double at[3] = {middle.x, middle.y, middle.z}, velocity[3] = {v.x, v.y, v.z},
         quaternion[4] = {turn.w, turn.v.x, turn.v.y, turn.v.z};
  rigid.set_molecule(first, before, static_cast<int>(kind), at, velocity, quaternion);
}
