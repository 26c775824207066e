#include "lammps/fix_wall_lsdcd.h"

#include "base/input_words.h"
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
#include "update.h"

#include <algorithm>
#include <cstring>
#include <numeric>

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
static constexpr double kHeadroom = 1.1;    // in cutoff, once radii are known to grow

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
    refuse("atoms need a radius, omega and torque: use atom_style sphere");

  try {
    const lsdcd::FilledTokens filled = lsdcd::fill_material(
        world, std::vector<std::string>(arg + 3, arg + narg), update->unit_style);
    material = filled.report;
    settings = lsdcd::parse_settings(filled.tokens);
    if (settings.draw_type > atom->ntypes)
      throw lsdcd::InputError("in 'draw', there is no atom type " +
                              std::to_string(settings.draw_type));
    // A pressure in some unit systems is not a force per area in the same units.
    if (settings.law.style == lsdcd::LawStyle::hertz_history) {
      settings.law.k_normal /= force->nktv2p;
      settings.law.k_tangent /= force->nktv2p;
    }
    settings.wear.per_work *= force->nktv2p;
    settings.law.added.cohesion /= force->nktv2p;
    wall = std::make_unique<lsdcd::SharedWall>(world, settings);
    check_side();
    check_plane();
    run_clock = {update->atime + (update->ntimestep - update->atimestep) * update->dt,
                 update->ntimestep, update->ntimestep, update->dt};
    begin_motion();

    make_engine();
  } catch (const lsdcd::InputError &e) {
    refuse(e.what());
  }

  history = settings.law.has_history();
  springs = lsdcd::SpringStore(settings.law.n_extra());
  records = settings.has_loads();
  restart_global = records || settings.motion.any();
  // Of either file; end_of_step() knows which.
  if (settings.fields.every > 0 || settings.stl.every > 0)
    nevery = std::gcd(settings.fields.every, settings.stl.every);
  create_attribute = history || settings.contacts;
  restart_peratom = history;
  maxexchange_dynamic = history || settings.contacts;
  dynamic_group_allow = 1;

  scalar_flag = vector_flag = 1;
  size_vector = kVector;
  global_freq = 1;
  extscalar = 1;
  extvector = -1;
  extlist = new int[kVector + kServo];
  std::fill(extlist, extlist + kVector + kServo, 1);
  extlist[7] = 0;    // the largest overlap is not a sum
  show_servo();
  energy_global_flag = 1;
  energy = power = 0;
  std::fill(totals, totals + kTotals, 0.0);

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
  check_scale();
  check_periodic();
  if (radius > 0) check_box(lsdcd::cutoff_of(settings.law, radius));
  check_surface();

  // Last: Atom would call a fix that was refused after this.
  if (history || settings.contacts) {
    FixWallLsdcd::grow_arrays(atom->nmax);
    for (int i = 0; i < atom->nlocal; i++) FixWallLsdcd::set_arrays(i);
    atom->add_callback(Atom::GROW);
    if (history) atom->add_callback(Atom::RESTART);
    callbacks = true;
    ask_for_most_room();
  }
}

FixWallLsdcd::~FixWallLsdcd()
{
  if (callbacks) {
    atom->delete_callback(id, Atom::GROW);
    if (history) atom->delete_callback(id, Atom::RESTART);
  }
  memory->destroy(array_atom);
  delete[] extlist;
  extlist = nullptr;
}

int FixWallLsdcd::setmask()
{
  return PRE_FORCE | PRE_FORCE_RESPA | POST_FORCE | POST_FORCE_RESPA | POST_RUN | PRE_EXCHANGE |
         (settings.fields.every > 0 || settings.stl.every > 0 ? END_OF_STEP : 0);
}

void FixWallLsdcd::init()
{
  nlevels_respa = 0;
  rigid = adapts = false;
  for (int i = 0; i < modify->nfix; i++) {
    if (modify->fix[i]->rigid_flag) rigid = true;
    if (std::strncmp(modify->fix[i]->style, "adapt", 5) == 0) adapts = true;
  }
  if (!rigid) std::vector<double>().swap(mass_seen);
  if (wall->cutoff() > 0) check_box(wall->cutoff());
  if (settings.law.has_heat()) check_heat();
  check_variables();
  check_file("mesh_fields", settings.fields);
  check_file("mesh_stl", settings.stl);
  file_warned = false;
}

// Respa calls this once per level before setup(): the only way to its number of
// levels without its header.
void FixWallLsdcd::setup_pre_force_respa(int /*vflag*/, int ilevel)
{
  nlevels_respa = ilevel + 1;
}

void FixWallLsdcd::setup(int /*vflag*/)
{
  list_is_old = true;
  set_up_at = update->ntimestep;
  prepare_springs();
  if (!springs_checked) check_springs();
  if (callbacks) ask_for_most_room();

  Respa *respa = reinterpret_cast<Respa *>(update->integrate);
  const int outer = nlevels_respa - 1;
  if (nlevels_respa) respa->copy_flevel_f(outer);
  begin_step(true);
  collect();
  check_inserted();
  if (nlevels_respa) respa->copy_f_flevel(outer);
}

void FixWallLsdcd::min_setup(int /*vflag*/)
{
  if (callbacks) ask_for_most_room();
  if (wall_in_minimize_warned) return;
  wall_in_minimize_warned = true;
  warn("no effect in a minimization, as fix wall/gran has none");
}

void FixWallLsdcd::pre_exchange()
{
  look();
  check_wrapping();
  if (history) make_exchange_room();
}

// An atom that arrives may leave again in the next direction: room for the
// largest of all processes.
void FixWallLsdcd::make_exchange_room()
{
  springs_to_host();
  int largest = springs.largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  ask_for_room(1 + largest);    // and its offset, which messages of Kokkos tell
}

// Radii may have been set before a run that has no setup.
void FixWallLsdcd::pre_force(int /*vflag*/)
{
  if (neighbor->ago == 0 && callbacks) ask_for_most_room();
  const bool anew = neighbor->ago == 0 ||
                    (update->ntimestep == update->firststep + 1 && set_up_at != update->firststep);
  if (anew || adapts) {
    list_is_old = true;
    prepare_springs();
  }
  if (!adapts) begin_step(anew);
}

// Fix adapt may come after this fix in pre_force.
void FixWallLsdcd::post_force(int /*vflag*/)
{
  if (adapts) begin_step(true);
  collect();
  check_inserted();
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
  run_clock.advance(*update);
  move_wall();
  if (look)
    update_cutoff();
  else if (domain->box_change)
    follow_box();
  check_moving_box();
  if (engine_moves) engine->place_wall(pose);
  if (rigid) fill_masses();
  if (update->setupflag || (neighbor->ago == 0 && (adapts || atom->natoms != checked_atoms))) {
    check_timestep();
    look_at_servo_spheres();
    may_be_new = true;
  }
  start();
}

void FixWallLsdcd::post_run()
{
  look();
  double worst = worst_overlap;
  MPI_Allreduce(MPI_IN_PLACE, &worst, 1, MPI_DOUBLE, MPI_MAX, world);
  check_overlap(worst);
  check_wrapping();
  log_rebuilds();
  log_lists();
  if (settings.nearest > 0) log_uncertified();
}

lsdcd::StepSettings FixWallLsdcd::step_settings(lsdcd::Spheres &spheres)
{
  lsdcd::StepSettings step;
  step.dt = update->dt;
  step.update_history = !update->setupflag;
  step.per_sphere = settings.contacts;
  if (settings.surface_varies()) step.surface = &surface;
  if (settings.law.has_heat()) give_heat(spheres, step);
  return step;
}

lsdcd::Spheres FixWallLsdcd::spheres()
{
  lsdcd::Spheres s;
  s.n = atom->nlocal;
  if (s.n) {
    s.x = atom->x[0];
    s.v = atom->v[0];
    s.omega = atom->omega[0];
    s.force = atom->f[0];
    s.torque = atom->torque[0];
  }
  s.radius = atom->radius;
  s.mass = rigid ? mass_seen.data() : atom->rmass;
  s.mask = igroup ? atom->mask : nullptr;
  s.group_bit = groupbit;
  return s;
}

// Does LAMMPS reneighbour before any atom has gone farther than half the skin? Elsewhere the
// engine looks at all atoms in every step.
bool FixWallLsdcd::list_keeps() const
{
  return spheres_stay_close() && !group->dynamic[igroup];
}

void FixWallLsdcd::choose_if_due(const lsdcd::Spheres &s)
{
  if (history) springs_to_engine();
  const bool keeps = list_keeps(),
             watches = !keeps && !group->dynamic[igroup] && neighbor->skin > 0;
  // Half the skin is for atoms. One that had gone so far since LAMMPS reneighboured may come back
  // and go as far on the other side. As much again is for a wall that moves.
  const double half = 0.5 * neighbor->skin, for_wall = settings.motion.any() ? half : 0;
  if (!list_is_old && (keeps ? !wall_has_gone(for_wall) : watches && !engine->has_moved(s))) return;
  const double for_atoms = keeps && neighbor->ago > 0 ? 2 * half : half;
  engine->choose(s, keeps || watches ? for_atoms + for_wall : 0.0, watches);
  chosen_pose = pose;
  list_is_old = false;
  choices++;
}

void FixWallLsdcd::start()
{
  if (wall->cutoff() == 0) return;    // no spheres yet

  lsdcd::Spheres s = spheres();
  const lsdcd::StepSettings step = step_settings(s);
  try {
    choose_if_due(s);
    engine->start(s, step);
  } catch (const std::exception &e) {
    stop(e);
  }
  running = true;
}

void FixWallLsdcd::collect()
{
  if (running) {
    try {
      engine->collect();
    } catch (const std::exception &e) {
      stop(e);
    }
    running = false;
    n_with_springs = atom->nlocal;
    steps_run++;
  }
  keep_outputs();
}

// What steps have noted since the last look, for warnings and the log.
lsdcd::StepDiagnostics FixWallLsdcd::look()
{
  lsdcd::StepDiagnostics diagnostics;
  if (wall->cutoff() == 0) return diagnostics;
  try {
    diagnostics = engine->read_diagnostics();
    uncertified_sum += diagnostics.uncertified;
    worst_uncertain = std::max(worst_uncertain, diagnostics.uncertain);
    lists += diagnostics.lists;
    listed += diagnostics.listed;
    by_cells += diagnostics.by_cells;
    if (diagnostics.deepest <= worst_overlap) return diagnostics;
    worst_overlap = diagnostics.deepest;
    worst_step = update->ntimestep;
    if (!overlap_warned && diagnostics.deepest > kLargeOverlap)
      worst_tag = tag_of(diagnostics.deepest_sphere);
  } catch (const std::exception &e) {
    stop(e);
  }
  return diagnostics;
}

// Of the step just computed.
void FixWallLsdcd::keep_outputs()
{
  reduced = false;
  if (records) add_loads();
  if (settings.contacts) fill_contacts();
}

lsdcd::EngineSettings FixWallLsdcd::engine_settings() const
{
  lsdcd::EngineSettings want;
  want.law = settings.law;
  want.corner = settings.corner;
  want.side = settings.side;
  want.precision = settings.precision;
  want.surface = settings.surface;
  want.moves = moves_or_varies();
  want.records = settings.has_loads();
  want.wear = settings.wear.model;
  want.device = settings.device;
  want.device_rank = wall->shared().node_rank();
  return want;
}

// Collective, and again where tuning has changed the precision.
void FixWallLsdcd::make_engine()
{
  const lsdcd::EngineSettings want = engine_settings();
  engine_moves = want.moves;
  lsdcd::together(world, true, [&] { engine = new_engine(want); });
}

// Builds the grid when the first spheres come, and again when larger ones do or the box has
// changed.
void FixWallLsdcd::update_cutoff()
{
  double most[2] = {largest_radius(), worst_overlap};
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
  check_overlap(most[1]);

  const double radius = most[0], old = wall->cutoff();
  const auto cutoff_of = [this](double r) { return lsdcd::cutoff_of(settings.law, r); };
  if (radius == 0) return;
  if (cutoff_of(radius) <= old) {
    follow_box();
    return;
  }
  if (settings.rmax > 0 && radius > settings.rmax)
    refuse("atom " + std::to_string(tag_of_radius(radius)) + " has radius " +
           lsdcd::number_text(radius) + ", more than rmax " + lsdcd::number_text(settings.rmax) +
           ": raise rmax or use rmax auto");

  rebuild(cutoff_of(settings.rmax > 0 ? settings.rmax : (old > 0 ? kHeadroom * radius : radius)));
}

// The wall acts through periodic faces by images of its triangles, and the grid is there where
// spheres can be: both are those of a box. Collective where the box has changed.
void FixWallLsdcd::follow_box()
{
  if (wall->cutoff() > 0 && !wall->fits(mesh_box())) rebuild(wall->cutoff());
}

void FixWallLsdcd::rebuild(double cutoff)
{
  const double old = wall->cutoff();
  list_is_old = true;
  if (old > 0) {
    springs_to_host();
    // Images get other numbers: a spring on one goes to what that is an image of.
    const lsdcd::WallFeaturesView features = wall->view().wall;
    if (history && wall->has_images())
      springs.rename_features(
          [&](int /*mesh*/, lsdcd::FeatureCode f) { return lsdcd::own_feature(features, f); });
  }
  check_box(cutoff);
  try {
    if (settings.tune >= 0 && old == 0) tune(cutoff);
    wall->build(cutoff, mesh_box());
    lsdcd::together(world, true, [&] { engine->set_grid(wall->view()); });
  } catch (const lsdcd::InputError &e) {
    refuse(e.what());
  }
  if (cutoff == old) box_rebuilds++;
  check_within_cutoff();
  log_build(old);
  check_ends(cutoff == old);
}

// What damping sees of an atom in a rigid body is the mass of the body.
void FixWallLsdcd::fill_masses()
{
  need_on_host();
  const int nlocal = atom->nlocal;
  mass_seen.assign(atom->rmass, atom->rmass + nlocal);
  for (int k = 0; k < modify->nfix; k++) {
    Fix *fix = modify->fix[k];
    if (!fix->rigid_flag) continue;
    int dim;
    const int *body = (const int *) fix->extract("body", dim);
    const double *mass = (const double *) fix->extract("masstotal", dim);
    if (!body || !mass) continue;
    for (int i = 0; i < nlocal; i++)
      if (body[i] >= 0 && mass[body[i]] > 0.0) mass_seen[i] = mass[body[i]];
  }
}
