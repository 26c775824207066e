// What the fix refuses, warns of, and writes to the log.

#include "fix_wall_lsdcd.h"

#include "effects/effects.h"
#include "input_words.h"
#include "tune/trial_grid.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "group.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using lsdcd::LawStyle;
using lsdcd::number_text;

static constexpr double kStepsPerContact = 10;

void FixWallLsdcd::refuse(const std::string &problem) const
{
  error->all(FLERR, std::string("Fix wall/lsdcd: ") + problem);
}

void FixWallLsdcd::log(const std::string &lines) const
{
  if (comm->me == 0) utils::logmesg(lmp, lines + "\n");
}

double FixWallLsdcd::largest_radius()
{
  // Atoms may enter a dynamic group between two looks.
  const bool all = group->dynamic[igroup];
  double largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    if (all || (atom->mask[i] & groupbit)) largest = std::max(largest, atom->radius[i]);
  return largest;
}

void FixWallLsdcd::check_side() const
{
  const lsdcd::MeshReport &r = wall->report();
  if (settings.side == lsdcd::Side::both || r.oriented) return;
  throw lsdcd::InputError("side in and side out need a closed, oriented mesh; '" +
                          settings.mesh_file + "' has " + std::to_string(r.open_edges) + " open, " +
                          std::to_string(r.nonmanifold_edges) + " non-manifold and " +
                          std::to_string(r.misoriented_edges) +
                          " misoriented edges: repair the mesh or use side both");
}

// A sphere sees the mesh where the mesh stands, not its periodic images.
void FixWallLsdcd::check_box(double reach) const
{
  const lsdcd::MeshReport &r = wall->report();
  const double *boxlo = domain->triclinic ? domain->boxlo_bound : domain->boxlo;
  const double *boxhi = domain->triclinic ? domain->boxhi_bound : domain->boxhi;
  const char name[] = "xyz";
  for (int d = 0; d < 3; d++) {
    const double lo = r.lo[d], hi = r.hi[d];
    const std::string where =
        std::string(1, name[d]) + " from " + number_text(lo) + " to " + number_text(hi);
    const std::string box =
        "the box from " + number_text(boxlo[d]) + " to " + number_text(boxhi[d]);
    // A shrink-wrapped face follows the atoms, wherever the mesh is.
    const bool lo_stays = domain->boundary[d][0] < 2, hi_stays = domain->boundary[d][1] < 2;
    if ((hi < boxlo[d] - reach && lo_stays) || (lo > boxhi[d] + reach && hi_stays))
      refuse("the mesh is outside the box: it spans " + where + ", " + box +
             "; check the units of the file (scale) and the position (move)");

    if (!domain->periodicity[d]) continue;
    const bool clear = lo >= boxlo[d] + reach && hi <= boxhi[d] - reach;
    const bool spans = lo <= boxlo[d] - reach && hi >= boxhi[d] + reach;
    if (clear || (spans && settings.periodic)) continue;
    std::string remedy = ": make the boundary fixed, keep the mesh a radius (" +
                         number_text(reach) + ") inside the box";
    if (spans)
      remedy += ", or add the keyword periodic if the mesh continues itself there";
    else
      remedy += ", or let it continue itself past both faces by a radius and add the keyword "
                "periodic";
    refuse("the mesh meets a periodic boundary: it spans " + where + ", " + box + remedy);
  }
}

// Collective where `worst` is the largest of all processes.
void FixWallLsdcd::check_overlap(double worst)
{
  if (overlap_warned || worst <= kLargeOverlap) return;
  overlap_warned = true;
  struct {
    double value;
    int rank;
  } most = {worst_overlap, comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  bigint which[2] = {worst_tag, worst_step};
  MPI_Bcast(which, 2, MPI_LMP_BIGINT, most.rank, world);
  if (comm->me == 0)
    error->warning(FLERR, "Fix wall/lsdcd: atom " + std::to_string(which[0]) +
                              " sank into the wall by " + number_text(100 * most.value) +
                              " % of its radius at step " + std::to_string(which[1]) +
                              ": stiffen the contact (kn) or lower speeds; shown once");
}

// Does the stiffness grow with the overlap?
static bool is_hertzian(const lsdcd::ContactLaw &law)
{
  if (law.style == LawStyle::granular) return !law.is(lsdcd::NormalModel::hooke);
  return law.style == LawStyle::hertz_history;
}

// Duration of a binary contact: half a period of the damped spring between a
// sphere and the wall (undamped with granular, whose damping may be anything). A hertz
// spring is taken at an overlap of 1 % of the radius.
double FixWallLsdcd::contact_time(double mass, double radius) const
{
  const lsdcd::ContactLaw &law = settings.law;
  const bool granular = law.style == LawStyle::granular;
  double k = granular ? law.granular.k_normal : law.k_normal;
  double gamma = granular ? 0 : law.gamma_normal;
  if (is_hertzian(law)) {
    const double root = std::sqrt(0.01 * radius * radius);
    k *= 1.5 * root;
    gamma *= root;
  }
  const double omega_sq = force->ftm2v * k / mass, half = 0.5 * force->ftm2v * gamma;
  const double damped_sq = omega_sq - half * half;
  return M_PI / std::sqrt(damped_sq > 0 ? damped_sq : omega_sq);
}

void FixWallLsdcd::check_timestep()
{
  if (update->dt == checked_dt || wall->reach() == 0) return;
  need_on_host();
  double shortest = INFINITY;
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit)
      shortest = std::min(shortest, contact_time(atom->rmass[i], atom->radius[i]));
  MPI_Allreduce(MPI_IN_PLACE, &shortest, 1, MPI_DOUBLE, MPI_MIN, world);
  checked_dt = update->dt;
  if (update->dt <= shortest / kStepsPerContact || comm->me) return;
  error->warning(
      FLERR, "Fix wall/lsdcd: timestep " + number_text(update->dt) +
                 " is more than a tenth of the shortest contact time " + number_text(shortest) +
                 (is_hertzian(settings.law) ? " (hertz, at an overlap of 1 % of the radius)" : "") +
                 ": contacts will not be resolved");
}

// Springs of a restart file name features of the mesh it was written with, and hold what
// the law that it was written with keeps.
void FixWallLsdcd::check_springs()
{
  restarted = false;
  int lost[2] = {0, other_law};
  for (int i = 0; i < atom->nlocal; i++)
    for (int k = 0; k < springs.count(i); k++)
      if (!wall->has(springs.of(i)[k].feature)) {
        lost[0]++;
        springs.clear(i);
        break;
      }
  other_law = 0;
  MPI_Allreduce(MPI_IN_PLACE, lost, 2, MPI_INT, MPI_SUM, world);
  const char *const other[] = {"mesh", "contact law"};
  for (int k = 0; k < 2; k++)
    if (lost[k] && comm->me == 0)
      error->warning(FLERR, "Fix wall/lsdcd: " + std::to_string(lost[k]) +
                                " atoms lose their springs: the restart file was written with "
                                "another " +
                                other[k]);
}

// What nearest lists may have cost in the run that ends. Collective.
void FixWallLsdcd::log_uncertified()
{
  bigint sum = 0;
  double worst = 0;
  MPI_Allreduce(&uncertified_sum, &sum, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  MPI_Allreduce(&worst_uncertain, &worst, 1, MPI_DOUBLE, MPI_MAX, world);
  uncertified_sum = 0;
  worst_uncertain = 0;
  std::string t = "Fix " + std::string(id) + " wall/lsdcd: nearest " +
                  std::to_string(settings.nearest) + ": " + std::to_string(sum) +
                  " answers were not certified exact";
  if (sum > 0)
    t += "; contacts overlapping by up to " + number_text(100 * worst) +
         " % of a radius may have been missed (nearest N exact or nearest all certify all)";
  log(t);
}

// In the columns of the mesh report.
void FixWallLsdcd::log_creation() const
{
  if (comm->me) return;
  const lsdcd::ContactLaw &l = settings.law;
  std::string t = "Fix " + std::string(id) + " wall/lsdcd: " + wall->mesh_text();
  if (!settings.placement_words.empty()) t += "\n  placement   " + settings.placement_words;
  if (!material.empty()) t += "\n" + material;
  t += "\n  contact     " + settings.law_name;
  if (l.style != LawStyle::granular)
    t += ", kn " + number_text(l.k_normal) + ", kt " + number_text(l.k_tangent) + ", gamman " +
         number_text(l.gamma_normal) + ", gammat " + number_text(l.gamma_tangent) + ", xmu " +
         number_text(l.mu) + (l.limit_damping ? ", limit_damping" : "");
  std::string effects, kept;
  for (const lsdcd::Effect &e : lsdcd::effects_of(engine_settings())) {
    const auto cost = lsdcd::kept_costs().find(e.kind);
    const bool first = effects.empty();
    effects += (first ? "" : ", ") + e.name;
    if (cost != lsdcd::kept_costs().end())
      effects +=
          (first ? " " : " +") +
          number_text(std::max(0.0, std::round(first ? cost->second.ns : cost->second.over_ns))) +
          " ns";
    if (e.bytes_per_contact > 0)
      kept += ", " + std::to_string(e.bytes_per_contact) + " for " + e.name;
  }
  t += "\n  effects     " + effects;
  if (!lsdcd::kept_costs().empty())
    t += "\n              (times per contact, as measured on " + lsdcd::kept_costs_where() + ")";
  t += "\n  per atom    ";
  if (history)
    t += "8 bytes, and per contact " + std::to_string(sizeof(lsdcd::Spring)) +
         " for its spring and place" + kept + ", which move and restart with the atom";
  else
    t += "nothing stored, exchanged or restarted";
  if (settings.contacts)
    t += "; " + std::to_string(size_peratom_cols * sizeof(double)) + " bytes for contacts";
  t += "\n  search      ";
  if (settings.tune >= 0)
    t += "tuned once there are particles, for errors below " + number_text(settings.tune);
  else {
    if (settings.nearest > 0)
      t += "nearest " + std::to_string(settings.nearest) +
           (settings.exact ? ", complete lists where that is not certified" : "");
    else
      t += "all that can touch";
    t += std::string(", precision ") + lsdcd::precision_name(settings.precision);
  }
  const char *const sides[] = {"both", "in", "out"};
  t += std::string("\n  corners     ") +
       (settings.corner == lsdcd::Corner::blend ? "blend" : "sum") + ", side " +
       sides[static_cast<int>(settings.side)];
  t += "\n  device      " + engine->backend();
  std::string why;
  if (new_engine == lsdcd::make_engine && settings.device == lsdcd::Device::automatic &&
      !lsdcd::cuda_available(&why))
    t += " (no CUDA: " + why + ")";
  log(t);
}

void FixWallLsdcd::log_build(bool again) const
{
  std::string t = "Fix " + std::string(id) + " wall/lsdcd: ";
  if (again)
    t += "larger particles, grid rebuilt for radius " + number_text(wall->reach());
  else
    t += (wall->tune_text().empty() ? "" : wall->tune_text() + "\n  ") + "grid for radius " +
         number_text(wall->reach()) + "\n" + wall->grid_text();
  if (!again && wall->shared().node_size() > 1)
    t += wall->shared().is_shared() ? "\n  one copy per node" : "\n  one copy per process";
  if (!wall->cache_text().empty()) t += "\n  " + wall->cache_text();
  log(t);
  if (!wall->cache_warning().empty())
    error->warning(FLERR, "Fix wall/lsdcd: " + wall->cache_warning());
}
