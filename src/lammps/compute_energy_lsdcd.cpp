// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/compute_energy_lsdcd.h"

#include "engine/results/booked_energy.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "lammps/pair_granular_lsdcd.h"

#include "atom.h"
#include "domain.h"
#include "force.h"
#include "modify.h"
#include "update.h"
#if __has_include("fix_nve_sphere.h")
#include "fix_nve_sphere.h"
#endif

#include <cstring>

using namespace LAMMPS_NS;
using lsdcd::BookedEnergy;
using lsdcd::EnergyRow;

namespace {

constexpr int kSystem = 17;                         // the first element of the whole system, from 0
constexpr double kOfSphere = 0.4, kOfDisc = 0.5;    // moments of inertia over m r^2

// What fix nve/sphere does not tell: the moment of inertia with which it turns grains, over m r^2.
#if __has_include("fix_nve_sphere.h")
class NveSphere : public FixNVESphere {
 public:
  static double inertia_of(const Fix *fix)
  {
    const auto *const sphere = dynamic_cast<const FixNVESphere *>(fix);
    return sphere ? sphere->*(&NveSphere::inertia) : 0;
  }
};
#else
// LAMMPS installs no fix_nve_sphere.h. These are the members that it has since 2018.
class NveSphere : public Fix {
 public:
  static double inertia_of(const Fix *fix)
  {
    return reinterpret_cast<const NveSphere *>(fix)->inertia;
  }

 private:
  double dtv, dtf;
  double *step_respa;
  int mass_require;
  double inertia;
};
#endif

}    // namespace

ComputeEnergyLsdcd::ComputeEnergyLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Compute(lmp, narg, arg), OwnMessages(lmp, "Compute", id, "lsdcd/energy"),
    variables(lmp, std::string("c_") + id)
{
  const char *const kSyntax = "compute ID all lsdcd/energy [names PREFIX NAME ...]";
  if (narg > 3 && std::strcmp(arg[3], "names") != 0)
    fatal(std::string("'") + arg[3] + "' is not expected: " + kSyntax);
  if (igroup != 0) fatal("pairs are of all atoms: compute ID all lsdcd/energy");

  scalar_flag = vector_flag = 1;
  extscalar = extvector = 1;
  size_vector = lsdcd::n_elements(lsdcd::energy_outputs()) - 1;
  vector = new double[size_vector];
  run_core([&] {
    if (narg > 3)
      variables.make(words_of(arg + 3, arg + narg),
                     lsdcd::named_elements(lsdcd::energy_outputs(), true));
  });
}

ComputeEnergyLsdcd::~ComputeEnergyLsdcd()
{
  delete[] vector;
}

const PairGranularLsdcd &ComputeEnergyLsdcd::pair() const
{
  const auto *const found = dynamic_cast<const PairGranularLsdcd *>(force->pair);
  if (!found)
    fatal("it records the energy of pair_style granular/lsdcd, which is missing or within a hybrid "
          "style: for walls alone use the keyword energy of fix wall/lsdcd");
  return *found;
}

std::vector<FixWallLsdcd *> ComputeEnergyLsdcd::walls() const
{
  std::vector<FixWallLsdcd *> found;
  for (Fix *fix : lsdcd::host_fixes(*modify))
    if (auto *const wall = dynamic_cast<FixWallLsdcd *>(fix)) found.push_back(wall);
  return found;
}

// The pair style, whose init comes first, has found this compute.
void ComputeEnergyLsdcd::init()
{
  watch.init(*update);
  pair();
  find_discs();
  if (std::strncmp(update->integrate_style, "respa", 5) == 0)
    fatal("the work of a step is that of one timestep: use run_style verlet");
  for (const FixWallLsdcd *wall : walls())
    if (!wall->spec().energy && !told) {
      warn(std::string("fix ") + wall->id +
           " has no keyword energy: what its contacts do with energy is not in the balance");
      told = true;
    }
}

void ComputeEnergyLsdcd::setup()
{
  if (!watch.sees_snapshot(*update) || told_of_rerun) return;
  warn("a rerun has no steps, and records nothing of contacts: only the kinetic and the potential "
       "energy are those of its snapshots");
  told_of_rerun = true;
}

// Only two-dimensional grains may be discs.
void ComputeEnergyLsdcd::find_discs()
{
  discs = 0;
  if (domain->dimension != 2) return;
  for (const Fix *fix : lsdcd::host_fixes(*modify)) {
    if (std::strncmp(fix->style, "nve/sphere", 10) != 0) continue;
    const double inertia = NveSphere::inertia_of(fix);
    if (inertia == kOfDisc)
      discs |= fix->groupbit;
    else if (inertia != kOfSphere)
      fatal(std::string("this LAMMPS does not say as it used to whether fix ") + fix->id +
            " has spheres or discs: leave this compute out");
  }
}

double ComputeEnergyLsdcd::kinetic() const
{
  double twice = 0;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *const v = atom->v[i], *const w = atom->omega[i];
    const double radius = atom->radius[i];
    const double inertia = atom->mask[i] & discs ? kOfDisc : kOfSphere;
    twice +=
        atom->rmass[i] * (v[0] * v[0] + v[1] * v[1] + v[2] * v[2] +
                          inertia * radius * radius * (w[0] * w[0] + w[1] * w[1] + w[2] * w[2]));
  }
  double all = 0;
  MPI_Allreduce(&twice, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return 0.5 * force->mvv2e * all;
}

double ComputeEnergyLsdcd::potential() const
{
  double all = 0;
  for (Fix *fix : lsdcd::host_fixes(*modify))
    if (std::strncmp(fix->style, "gravity", 7) == 0) all += fix->compute_scalar();
  return all;
}

void ComputeEnergyLsdcd::compute_vector()
{
  invoked_vector = update->ntimestep;
  lsdcd::MpiHost host(world);
  BookedEnergy pairs = pair().booked();
  lsdcd::sum_over_processes(host, &pairs, 1);
  double *next = vector;
  for (const EnergyRow cause : lsdcd::kCauses) *next++ = pairs.power(cause);
  for (const EnergyRow cause : lsdcd::kCauses) *next++ = pairs.rows[cause];
  for (const EnergyRow row : lsdcd::kOtherLosses) *next++ = pairs.rows[row];
  *next++ = pairs.rows[EnergyRow::work];
  *next++ = pairs.rows[EnergyRow::held];
  *next++ = pairs.remainder();

  BookedEnergy all = pairs;
  for (FixWallLsdcd *wall : walls()) all.add(wall->booked());
  *next++ = kinetic();
  *next++ = potential();
  *next++ = all.rows[EnergyRow::held];
  *next++ = all.lost();
  *next++ = all.rows[EnergyRow::drive];
  *next++ = pairs.power(EnergyRow::plastic);
  *next++ = pairs.rows[EnergyRow::plastic];
}

// A vector that a variable has asked for as the step began is of that time: LAMMPS has cleared its flag since.
double ComputeEnergyLsdcd::compute_scalar()
{
  invoked_scalar = update->ntimestep;
  const bool has_vector = (invoked_flag & INVOKED_VECTOR) && invoked_vector == update->ntimestep;
  if (!has_vector) compute_vector();
  const double *const of = vector + kSystem;
  scalar = of[0] + of[1] + of[2] + of[3] - of[4];
  return scalar;
}
