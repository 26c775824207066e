// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"
#include "lammps/mpi_material.h"

#include "atom.h"
#if __has_include("atom_masks.h")
#include "atom_masks.h"
#endif
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

// LAMMPS does not install respa.h. These two functions have had this name since
// 2005 and no data of the class is touched.
namespace LAMMPS_NS {
class Respa {
 public:
  void copy_f_flevel(int);
  void copy_flevel_f(int);
};
}    // namespace LAMMPS_NS

static constexpr int kContactColumns = 8;

FixWallLsdcd::FixWallLsdcd(LAMMPS *lmp, int narg, char **arg, EngineMaker *maker) :
    Fix(lmp, narg, arg), new_engine(maker)
{
#if __has_include("atom_masks.h")
  // All that a host with its atoms on a GPU has to bring for this fix, and take back.
  datamask_read = X_MASK | V_MASK | OMEGA_MASK | RADIUS_MASK | RMASS_MASK | MASK_MASK | TAG_MASK |
                  F_MASK | TORQUE_MASK;
  datamask_modify = F_MASK | TORQUE_MASK;
#endif

  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    fatal("atoms need a radius, omega and torque: use atom_style sphere");

  try {
    const lsdcd::FilledTokens filled = lsdcd::fill_material(
        world, std::vector<std::string>(arg + 3, arg + narg), update->unit_style);
    material = filled.report;
    for (int i = 3; i + 1 < narg && !material.empty() && material_file.empty(); i++)
      if (std::strcmp(arg[i], "material") == 0) material_file = arg[i + 1];
    settings = lsdcd::parse_settings(filled.tokens);
    if (settings.draw_type > atom->ntypes)
      throw lsdcd::InputError("in 'draw', there is no atom type " +
                              std::to_string(settings.draw_type));
    // A pressure in some unit systems is not a force per area in the same units.
    if (settings.law.is_classic() && settings.law.is(lsdcd::NormalModel::hertz)) {
      settings.law.k_normal /= force->nktv2p;
      settings.law.k_tangent /= force->nktv2p;
    }
    settings.wear.per_work *= force->nktv2p;
    settings.law.cohesion.numbers[0] /= force->nktv2p;    // sjkr's; a pressure
    run_clock = {update->atime + (update->ntimestep - update->atimestep) * update->dt,
                 update->ntimestep, update->ntimestep, update->dt};
    history = std::make_unique<lsdcd::HistoryExchange>(host, settings);
    totals = std::make_unique<lsdcd::StepTotals>(host, settings);
    for (std::size_t k = 0; k < settings.meshes.size(); k++) {
      MeshPart &m = parts.emplace_back(world, host, settings, static_cast<int>(k), step_now());
      check_side(m);
      check_plane(m);
      check_motion(m);
    }

    make_engine();
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }

  records = settings.has_loads();
  loads = std::make_unique<lsdcd::LoadRecorder>(host, settings);
  wall_files = std::make_unique<lsdcd::WallFiles>(host, settings, force->nktv2p);
  restart_global = 1;
  if (wall_files->every() > 0) nevery = wall_files->every();
  create_attribute = history->is_kept() || settings.contacts;
  restart_peratom = history->is_kept();
  maxexchange_dynamic = history->is_kept() || settings.contacts;
  dynamic_group_allow = 1;

  scalar_flag = vector_flag = 1;
  array_flag = several();    // F_ID[1] of an atom-style variable is its column in 29Sep2021
  size_vector = size_array_cols = kVector;
  size_array_rows = static_cast<int>(parts.size());
  global_freq = 1;
  extscalar = 1;
  extvector = -1;
  extarray = 0;
  extlist = new int[kVector + kServo];
  std::fill(extlist, extlist + kVector + kServo, 1);
  extlist[7] = 0;    // the largest overlap is not a sum
  show_servo();
  energy_global_flag = 1;
  virial_global_flag = 1;

  if (settings.contacts) {
    peratom_flag = 1;
    size_peratom_cols = kContactColumns + settings.law.has_heat();
    peratom_freq = 1;
  }
  // Without spheres there is no telling how far outside is too far.
  double radius = FixWallLsdcd::largest_radius();
  MPI_Allreduce(MPI_IN_PLACE, &radius, 1, MPI_DOUBLE, MPI_MAX, world);
  if (settings.rmax > 0) radius = settings.rmax;
  log_creation();
  for (const MeshPart &m : parts) {
    check_scale(m);
    check_periodic(m);
    if (radius > 0) check_box(m, lsdcd::cutoff_of(settings.law, radius));
    check_surface(m);
  }
  if (several() && settings.corner == lsdcd::Corner::sum)
    warn("with corner sum a sphere over a seam where two meshes meet is pushed by both: use corner "
         "blend, or one mesh of all triangles");

  // Last: Atom would call a fix that was refused after this.
  if (history->is_kept() || settings.contacts) {
    FixWallLsdcd::grow_arrays(atom->nmax);
    for (int i = 0; i < atom->nlocal; i++) FixWallLsdcd::set_arrays(i);
    atom->add_callback(Atom::GROW);
    if (history->is_kept()) atom->add_callback(Atom::RESTART);
    callbacks = true;
    ask_for_most_room();
  }
}

FixWallLsdcd::~FixWallLsdcd()
{
  if (callbacks) {
    atom->delete_callback(id, Atom::GROW);
    if (history->is_kept()) atom->delete_callback(id, Atom::RESTART);
  }
  memory->destroy(array_atom);
  delete[] extlist;
  extlist = nullptr;
}

int FixWallLsdcd::setmask()
{
  // Where a fix asks for the end of steps, Kokkos's integrators no longer join two halves to one kernel.
  return PRE_FORCE | PRE_FORCE_RESPA | POST_FORCE | POST_FORCE_RESPA | POST_RUN | PRE_EXCHANGE |
         (wall_files->every() > 0 ? END_OF_STEP : 0);
}

void FixWallLsdcd::init()
{
  watch.init(*update);
  nlevels_respa = 0;
  rigid = adapts = false;
  for (int i = 0; i < modify->nfix; i++) {
    if (modify->fix[i]->rigid_flag) rigid = true;
    if (std::strncmp(modify->fix[i]->style, "adapt", 5) == 0) adapts = true;
  }
  if (!rigid) std::vector<double>().swap(mass_seen);
  for (const MeshPart &m : parts)
    if (cutoff() > 0) check_box(m, cutoff());
  if (settings.law.has_heat()) check_heat();
  make_engine_with_virial();
  check_variables();
  try {
    wall_files->begin_run(update->ntimestep);
  } catch (const lsdcd::InputError &e) {
    fatal(e.what());
  }
  check_files_apart();
  check_doubled();
}

// Respa calls this once per level before setup(): the only way to its number of
// levels without its header.
void FixWallLsdcd::setup_pre_force_respa(int /*vflag*/, int ilevel)
{
  nlevels_respa = ilevel + 1;
}

void FixWallLsdcd::setup(int vflag)
{
  v_init(vflag);
  schedule.expire();
  set_up_at = update->ntimestep;
  rerun = watch.sees_snapshot(*update);
  if (rerun) begin_snapshot();
  prepare_springs();
  if (!history->is_checked()) check_springs();
  if (callbacks) ask_for_most_room();

  Respa *respa = reinterpret_cast<Respa *>(update->integrate);
  const int outer = nlevels_respa - 1;
  if (nlevels_respa) respa->copy_flevel_f(outer);
  begin_step(true);
  collect();
  check_new_spheres();
  if (nlevels_respa) respa->copy_f_flevel(outer);
  if (!rerun) times.begin_run();    // as the loop time, which has the snapshots of a rerun
}

void FixWallLsdcd::min_setup(int /*vflag*/)
{
  if (callbacks) ask_for_most_room();
  clear_outputs();
  if (wall_in_minimize_warned) return;
  wall_in_minimize_warned = true;
  warn("no effect in a minimization, as fix wall/gran has none");
}

void FixWallLsdcd::pre_exchange()
{
  poll_diagnostics();
  check_wrapping();
  if (history->is_kept()) make_exchange_room();
}

// An atom that arrives may leave again in the next direction: room for the
// largest of all processes.
void FixWallLsdcd::make_exchange_room()
{
  int largest = springs_on_host().largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  ask_for_room(1 + largest);    // and its offset, which messages of Kokkos tell
}

// Radii may have been set before a run that has no setup.
void FixWallLsdcd::pre_force(int vflag)
{
  v_init(vflag);
  rerun = false;
  if (neighbor->ago == 0 && callbacks) ask_for_most_room();
  const bool anew = neighbor->ago == 0 ||
                    (update->ntimestep == update->firststep + 1 && set_up_at != update->firststep);
  if (anew || adapts) {
    schedule.expire();
    prepare_springs();
  }
  if (!adapts) begin_step(anew);
}

// Fix adapt may come after this fix in pre_force.
void FixWallLsdcd::post_force(int /*vflag*/)
{
  if (adapts) begin_step(true);
  collect();
  check_new_spheres();
}

void FixWallLsdcd::post_force_respa(int vflag, int ilevel, int /*iloop*/)
{
  if (ilevel != nlevels_respa - 1) return;
  pre_force(vflag);
  post_force(vflag);
}

// `look`: may there be new spheres, or other radii?
void FixWallLsdcd::begin_step(bool look)
{
  run_clock.advance(step_now());
  move_wall();
  if (look)
    update_cutoff();
  else if (domain->box_change)
    follow_box();
  check_moving_box();
  check_gone();
  for (const MeshPart &m : parts)
    if (engine_moves) engine->place_wall(m.motion.pose(), m.index);
  if (rigid) fill_masses();
  if (update->setupflag || (neighbor->ago == 0 && (adapts || atom->natoms != checked_atoms))) {
    check_timestep();
    look_at_servo_spheres();
    may_be_new = true;
  }
  start();
}

void FixWallLsdcd::end_of_step()
{
  times.begin();
  std::vector<lsdcd::PlacedMesh> meshes;
  for (const MeshPart &m : parts) meshes.push_back({m.wall.mesh(), m.motion.pose()});
  wall_files->write_due(update->ntimestep, static_cast<double>(run_clock.now()), meshes,
                        rerun ? nullptr : loads.get());
  times.end(lsdcd::TimeReport::files);
}

void FixWallLsdcd::post_run()
{
  poll_diagnostics();
  double worst = overlaps.worst();
  host.max(&worst, 1);
  overlaps.check_sunk(worst);
  check_wrapping();
  log_rebuilds();
  search.end_run(settings.brief,
                 sphere_drift().kind == lsdcd::SphereDrift::bounded
                     ? ""
                     : " (neigh_modify delay 0 every 1 check yes saves looking at all atoms)");
  if (settings.nearest > 0) search.log_uncertified(settings.nearest, settings.brief);
  times.end_run(settings.brief, timer->get_wall(Timer::TOTAL));
}
