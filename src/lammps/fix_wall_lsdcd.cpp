// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/fix_wall_lsdcd.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "input/wall_change.h"
#include "input/wall_command.h"
#include "lammps/host_atoms.h"
#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/host_respa.h"
#include "lammps/other_fixes.h"
#include "lammps/own_wall_gran.h"
#include "wall/spec/spec_check.h"
#include "wall/spec/spec_text.h"
#include "wall/wall_outputs.h"

#include "atom.h"
#if __has_include("atom_masks.h")
#include "atom_masks.h"
#endif
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "group.h"
#include "input.h"
#include "memory.h"
#include "modify.h"
#include "neighbor.h"
#include "timer.h"
#include "update.h"
#include "variable.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <initializer_list>

using namespace LAMMPS_NS;
using namespace FixConst;

FixWallLsdcd::FixWallLsdcd(LAMMPS *lmp, int narg, char **arg, const lsdcd::WallBackend &place) :
    Fix(lmp, narg, arg), OwnMessages(lmp, "Fix", id, "wall/lsdcd"),
    variables(lmp, std::string("f_") + id)
{
#if __has_include("atom_masks.h")
  // A host with its atoms on a GPU brings all for this fix, as variables, nodes and ellipsoids may read any, and takes these back.
  datamask_modify = F_MASK | TORQUE_MASK;
#endif
  check_atoms();
  if (atom->ellipsoid_flag && place.in_place)
    fatal("the wall has ellipsoids on a CPU alone: use wall/lsdcd without /kk");
  if (atom->ellipsoid_flag) shape_atoms = std::make_unique<ShapeAtoms>(lmp, id);

  run_core([&] {
    lsdcd::MaterialsRead read;
    lsdcd::WallCommand command = lsdcd::parse_wall(
        words_of(arg + 3, arg + narg),
        [&](const lsdcd::WallMaterials &materials, const std::vector<lsdcd::MaterialPair> &pairs) {
          return read_laws(host, materials, pairs, update->unit_style, read);
        });
    material_files = read.files;
    command.wall.shapes = atom->ellipsoid_flag;
    const lsdcd::WallSpec &spec = command.wall;
    picture.spec = command.picture;
    if (picture.spec.type > atom->ntypes)
      throw lsdcd::InputError("in 'draw', there is no atom type " +
                              std::to_string(picture.spec.type));
    check_types(spec);
    if (modify->nfix_restart_global == 0) lsdcd::check_begin(spec);    // else a state may follow
#if !HOST_HAS_HEAT
    if (spec.law().has_heat())
      throw lsdcd::InputError(
          "the sub-model heat needs a LAMMPS with fix heat/flow, of 2 Aug 2023 or later: that of "
          "Debian trixie or sid, or one built from source");
#endif
    const double now = update->atime + (update->ntimestep - update->atimestep) * update->dt;
    wall = std::make_unique<lsdcd::Wall>(
        host, spec, lsdcd::WallUnits{force->nktv2p, force->ftm2v}, place, read.report,
        lsdcd::StepClock{now, update->ntimestep, update->ntimestep, update->dt}, spheres_in_atom());
    const std::string differs =
        lsdcd::wall_gran_difference(LSDCD_HOST_VERSION, spec.laws.front().name, spec.law());
    if (!differs.empty() && !spec.brief)
      log("fix wall/gran of this LAMMPS gives different forces for this law: " + differs);
  });

  const bool contacts = spec().contacts;
  restart_global = 1;
  if (wall->files_every() > 0) nevery = wall->files_every();
  create_attribute = has_history() || contacts;
  restart_peratom = has_history();
  maxexchange_dynamic = has_history() || contacts;
  dynamic_group_allow = 1;

  scalar_flag = vector_flag = 1;
  array_flag =
      meshes().size() > 1;    // F_ID[1] of an atom-style variable is its column in 29Sep2021
  size_vector = size_array_cols = lsdcd::n_outputs(spec());
  size_array_rows = static_cast<int>(meshes().size());
  global_freq = 1;
  extscalar = 1;
  extvector = -1;
  extarray = 0;
  std::vector<int> adds_up;
  for (const lsdcd::WallOutput &row : lsdcd::wall_outputs())
    adds_up.insert(adds_up.end(), row.row.n, row.adds_up);
  extlist = new int[adds_up.size()];
  std::copy(adds_up.begin(), adds_up.end(), extlist);
  energy_global_flag = 1;
  virial_global_flag = 1;
  if (contacts) {
    peratom_flag = 1;
    size_peratom_cols = spec().contact_columns();
    peratom_freq = 1;
  }

  if (spec().each_contact) {
    local_flag = 1;
    size_local_rows = 0;
    size_local_cols = lsdcd::n_elements(lsdcd::each_contact_outputs(spec().energy));
    local_freq = 1;
  }

  // Last: Atom would call a fix that was refused after this.
  if (has_history() || contacts) {
    FixWallLsdcd::grow_arrays(atom->nmax);
    for (int i = 0; i < atom->nlocal; i++) FixWallLsdcd::set_arrays(i);
    atom->add_callback(Atom::GROW);
    if (has_history()) atom->add_callback(Atom::RESTART);
    callbacks = true;
    ask_for_most_room();
  }
}

FixWallLsdcd::~FixWallLsdcd()
{
  if (callbacks) {
    atom->delete_callback(id, Atom::GROW);
    if (has_history()) atom->delete_callback(id, Atom::RESTART);
  }
  memory->destroy(array_atom);
  delete[] extlist;
  extlist = nullptr;
}

// ---- what the host has -------------------------------------------------------------------

void FixWallLsdcd::check_atoms() const
{
  if (atom->ellipsoid_flag) {
    const std::string why = ShapeAtoms::why_not(*atom);
    if (!why.empty()) fatal(why);
  } else if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    fatal("atoms need a radius, omega and torque: use atom_style sphere");
  const std::string shape = lsdcd::shape_of_atoms(*atom);
  if (!shape.empty() && shape != lsdcd::kEllipsoids)
    fatal("the atom style has " + shape +
          ", which the wall would take for spheres: use atom_style sphere without them");
}

void FixWallLsdcd::check_types(const lsdcd::WallSpec &spec) const
{
  for (const lsdcd::MeshSpec &mesh : spec.meshes)
    for (const lsdcd::LawOfTypes &row : mesh.laws) {
      const int last = row.last_type == lsdcd::kAnyType ? row.first_type : row.last_type;
      if (last > atom->ntypes)
        throw lsdcd::InputError("in 'types " + lsdcd::types_text(row) +
                                "', there is no atom type " + std::to_string(last) +
                                ": there are " + std::to_string(atom->ntypes));
    }
}

void FixWallLsdcd::check_heat() const
{
#if HOST_HAS_HEAT
  if (spec().law().has_heat() && (!atom->temperature_flag || !atom->heatflow_flag))
    fatal("the sub-model heat needs a temperature and a heat flow per atom: fix ID all "
          "property/atom temperature heatflow ghost yes, and fix heat/flow to change them");
#endif
}

// Bodies take half steps in verlet's schedule, and the acceleration that fix gravity gives to atoms.
void FixWallLsdcd::init_bodies()
{
  if (update->whichflag == 2)
    fatal("a body does not move in a minimization: unfix the wall before, or leave out body");
  if (std::strncmp(update->integrate_style, "respa", 5) == 0)
    fatal("a body moves in the steps of run_style verlet only, not in those of respa");
  gravity = nullptr;
  const bool all_have = std::all_of(meshes().begin(), meshes().end(), [](const lsdcd::MeshPart &m) {
    return !m.spec.body.present || m.spec.body.has_gravity;
  });
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    int dim;
    if (all_have || std::strncmp(fix->style, "gravity", 7) != 0) continue;
    if (gravity)
      fatal("there are several fixes gravity: give the acceleration of a body by gravity gx gy gz");
    gravity = static_cast<const double *>(fix->extract("gvec", dim));
    if (!gravity)
      fatal("the fix cannot read the acceleration of fix gravity from this LAMMPS: give that of a "
            "body by gravity gx gy gz");
  }
}

// Atoms of a group are the nodes of a mesh.
void FixWallLsdcd::init_nodes()
{
  if (node_atoms.empty())
    for (const lsdcd::MeshPart &m : meshes())
      if (m.nodes()) node_atoms.emplace_back(lmp, m.index);
  if (!node_atoms.empty() && update->whichflag == 2)
    throw lsdcd::InputError(
        "the wall has no effect in a minimization, and its nodes would move without it: unfix the "
        "wall before");
  if (!node_atoms.empty()) need_nodes();
  for (NodeAtoms &nodes : node_atoms)
    note(nodes.init(*wall, groupbit, watch.may_be_snapshot(*update)));
}

// A run without setup begins with atoms that may have other IDs.
void FixWallLsdcd::check_node_tags()
{
  if (node_atoms.empty()) return;
  need_nodes();
  run_core([&] {
    for (NodeAtoms &nodes : node_atoms) note(nodes.check_tags(*wall));
  });
}

void FixWallLsdcd::note(const std::string &text)
{
  if (!text.empty()) warn(text);
}

void FixWallLsdcd::prepare_meshes()
{
  run_core([&] {
    wall->change_surfaces(step_now());
    if (spec().has_bodies()) wall->body(0);    // completes the last step of all
  });
}

std::vector<lsdcd::Vec3> FixWallLsdcd::places_of_nodes(int mesh)
{
  std::vector<lsdcd::Vec3> at;
  need_nodes();
  run_core([&] {
    for (NodeAtoms &nodes : node_atoms)
      if (nodes.is_of(mesh)) at = nodes.places(*wall);
  });
  return at;
}

// LAMMPS knows which pairs are left out once it has set up its lists.
void FixWallLsdcd::warn_of_pairs()
{
  const bool pairs =
      force->pair && force->pair_style && std::strcmp(force->pair_style, "zero") != 0;
  if (node_atoms.empty() || !pairs || pairs_warned) return;
  bool meet = !neighbor->exclude;
  if (!meet) need_nodes();
  for (const lsdcd::MeshPart &m : meshes())
    if (m.nodes() && !meet)
      meet = lsdcd::pairs_act_between(*neighbor, *atom, groupbit,
                                      group->bitmask[group->find(m.spec.node_group.c_str())], host);
  if (!meet) return;
  pairs_warned = true;
  warn("pair_style " + std::string(force->pair_style) +
       " also acts between the spheres and the nodes of the wall, in addition to the wall: switch "
       "this off by neigh_modify exclude group");
}

std::vector<lsdcd::RunFile> FixWallLsdcd::files() const
{
  std::vector<lsdcd::RunFile> all = lsdcd::files_of(spec());
  for (const std::string &file : material_files) all.push_back({"material", file});
  return all;
}

// ---- schedule ----------------------------------------------------------------------------

int FixWallLsdcd::setmask()
{
  return PRE_FORCE | PRE_FORCE_RESPA | POST_FORCE | POST_FORCE_RESPA | POST_RUN | PRE_EXCHANGE |
         (wall->files_every() > 0 ? END_OF_STEP : 0);
}

void FixWallLsdcd::init()
{
  watch.init(*update);
  speed.begin_run();
  nlevels_respa = 0;
  rigid = adapts = false;
  for (const Fix *fix : lsdcd::host_fixes(*modify)) {
    if (fix->rigid_flag) rigid = true;
    if (std::strncmp(fix->style, "adapt", 5) == 0) adapts = true;
  }
  const std::string doubt = rigid ? doubtful_bodies(*modify, force->pair_style) : "";
  if (!doubt.empty()) warn(doubt);
  changing = steps_between_changes(*modify);
  if (!rigid) std::vector<double>().swap(damping_mass);
  check_heat();
  if (spec().energy && std::strncmp(update->integrate_style, "respa", 5) == 0)
    fatal("energy is recorded with velocities that are the same in a whole step, which those of "
          "run_style respa are not: use run_style verlet, or leave out energy");
  if (spec().has_bodies()) init_bodies();
  for (const int k : wall->inputs_read()) find_variable(spec().inputs[k]);
  wall->begin_run(update->ntimestep, thermo_virial);
  // For fixes that are made after it, too. The exchange before setup(), and commands, may send all atoms of a process, and in messages of
  // Kokkos each takes all this room.
  if (callbacks) make_exchange_room();
  check_files_apart(*this, *lmp, host);
  init_nodes();
  if (doubled_warned) return;
  need_on_cpu();
  const std::string doubled = doubled_mesh(*this, *modify, *atom, world);
  if (doubled.empty()) return;
  doubled_warned = true;
  warn(doubled);
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
  set_up_at = update->ntimestep;
  rerun = watch.sees_snapshot(*update);
  if (callbacks) ask_for_most_room();
  Respa *respa = reinterpret_cast<Respa *>(update->integrate);
  const int outer = nlevels_respa - 1;
  if (nlevels_respa) respa->copy_flevel_f(outer);
  warn_of_pairs();
  begin(true);
  finish_step();
  if (nlevels_respa) respa->copy_f_flevel(outer);
}

// Where the wall does not act, as in a minimization, outputs of the last step would be added to its
// energy and pressure.
void FixWallLsdcd::min_setup(int /*vflag*/)
{
  if (callbacks) ask_for_most_room();
  std::fill(virial, virial + 6, 0.0);
  wall->clear_totals();
  for (int i = 0; spec().contacts && i < atom->nlocal; i++)
    std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
  size_local_rows = 0;
  if (wall_in_minimize_warned) return;
  wall_in_minimize_warned = true;
  warn("the wall has no effect in a minimization, like fix wall/gran");
}

void FixWallLsdcd::pre_exchange()
{
  speed.see_new_list();
  if (spheres_go_far()) need_positions();
  const lsdcd::HostSpheres s = spheres();
  wall->poll_diagnostics(s);
  if (spheres_go_far()) wall->check_wrapping(s);
  if (has_history()) make_exchange_room();
}

// Radii may have been set before a run that has no setup.
void FixWallLsdcd::pre_force(int vflag)
{
  v_init(vflag);
  rerun = false;
  if (neighbor->ago == 0 && callbacks) ask_for_most_room();
  const bool without_setup =
      update->ntimestep == update->firststep + 1 && set_up_at != update->firststep;
  if (without_setup) check_node_tags();
  looks_anew = adapts || neighbor->ago == 0 || without_setup ||
               atoms_may_have_changed(changing, update->ntimestep);
  if (!begins_late()) begin(looks_anew);
}

// Fix adapt may come after this fix in pre_force, and LAMMPS says which atoms are in dynamic groups as post_force begins.
bool FixWallLsdcd::begins_late() const
{
  return adapts || group->dynamic[igroup];
}

void FixWallLsdcd::post_force(int /*vflag*/)
{
  if (begins_late()) begin(looks_anew);
  finish_step();
}

void FixWallLsdcd::post_force_respa(int vflag, int ilevel, int /*iloop*/)
{
  if (ilevel != nlevels_respa - 1) return;
  pre_force(vflag);
  post_force(vflag);
}

void FixWallLsdcd::end_of_step()
{
  wall->write_due_files();
}

void FixWallLsdcd::post_run()
{
  watch.end_run(*update);
  const std::string advice =
      lsdcd::atoms_stay_close(*neighbor)
          ? ""
          : " (neigh_modify delay 0 every 1 check yes saves checking all atoms)";
  if (spheres_go_far()) need_positions();
  set_up_at = -1;
  wall->end_run(spheres(), spheres_go_far(), advice, timer->get_wall(Timer::TOTAL));
  for (const std::string &words : speed.end_run(this)) log(words);
}

// ---- a step ------------------------------------------------------------------------------

lsdcd::Step FixWallLsdcd::step_now() const
{
  return {update->ntimestep, update->dt,
          rerun               ? lsdcd::Step::snapshot
          : update->setupflag ? lsdcd::Step::setup
                              : lsdcd::Step::step};
}

// Under respa atoms move on between LAMMPS's look at them and the force of the wall.
bool FixWallLsdcd::lammps_looks_at_spheres() const
{
  return nlevels_respa == 0 && lsdcd::atoms_stay_close(*neighbor);
}

// Half the skin is for atoms, and as much again for a wall that moves.
lsdcd::SphereDrift FixWallLsdcd::sphere_drift() const
{
  lsdcd::SphereDrift drift;
  if (group->dynamic[igroup]) return drift;
  drift.distance = 0.5 * neighbor->skin;
  drift.has_begun = neighbor->ago > 0;
  if (lammps_looks_at_spheres())
    drift.kind = lsdcd::SphereDrift::bounded;
  else if (neighbor->skin > 0)
    drift.kind = lsdcd::SphereDrift::watched;
  drift.host_has_looked =
      !update->setupflag && nlevels_respa == 0 && lsdcd::has_looked_at_atoms(*neighbor);
  return drift;
}

bool FixWallLsdcd::spheres_go_far() const
{
  return !update->setupflag && !lammps_looks_at_spheres();
}

lsdcd::StepInput FixWallLsdcd::step_input(bool look)
{
  lsdcd::StepInput input;
  input.step = step_now();
  input.look = look;
  const bool changes = adapts || !changing.empty();
  input.new_spheres =
      update->setupflag || (neighbor->ago == 0 && (changes || atom->natoms != counted_atoms));
  input.box_changes = domain->box_change;
  input.drift = sphere_drift();
  input.virial = vflag_global;
  input.gravity = gravity;
  return input;
}

// `look`: may there be new spheres, or other radii, types or masses?
void FixWallLsdcd::begin(bool look)
{
  if (rigid && look) fill_masses();
  lsdcd::StepInput input = step_input(look);
  input.inputs = read_inputs();
  if (!node_atoms.empty()) need_nodes();
  for (NodeAtoms &nodes : node_atoms) nodes.send(*wall, look, input.step);
  begin_step(input);
  if (input.new_spheres && wall->cutoff() > 0) counted_atoms = atom->natoms;
}

int FixWallLsdcd::find_variable(const std::string &name) const
{
  Variable &all = *input->variable;
  const int variable = all.find(name.c_str());
  if (variable < 0)
    throw lsdcd::InputError("there is no variable '" + name + "', which the wall reads");
  if (!all.equalstyle(variable))
    throw lsdcd::InputError("variable '" + name + "', which the wall reads, is not of style equal");
  return variable;
}

// The variables that the wall reads in this step. Those of style equal are the same on all processes. A variable's
// computes keep their values until they are cleared. Where one is no number nothing would touch the wall, or a
// servo would run away.
std::vector<double> FixWallLsdcd::read_inputs()
{
  const std::vector<int> read = wall->inputs_read();
  std::vector<double> values(spec().inputs.size(), 0);
  if (read.empty()) return values;
  need_inputs();
  modify->clearstep_compute();
  for (const int k : read) {
    const std::string &name = spec().inputs[k];
    values[k] = input->variable->compute_equal(find_variable(name));
    if (!std::isfinite(values[k]))
      throw lsdcd::InputError("variable '" + name + "', which the wall reads, is " +
                              lsdcd::number_text(values[k]) + " in step " +
                              std::to_string(update->ntimestep) +
                              ": it must be a finite number in every step");
  }
  modify->addstep_compute(update->ntimestep + 1);
  return values;
}

void FixWallLsdcd::begin_step(lsdcd::StepInput &input)
{
  const lsdcd::HostSpheres s = spheres();
  wall->begin(s, input);
  wall->submit(s);
}

void FixWallLsdcd::finish_step()
{
  wall->finish(spheres());
  add_node_forces();
  if (vflag_global) wall->add_virial(virial);
  if (spec().contacts) fill_contacts();
  if (spec().each_contact) fill_each_contact();
}

void FixWallLsdcd::add_node_forces()
{
  for (NodeAtoms &nodes : node_atoms) nodes.add_forces(*wall);
}

lsdcd::HostSpheres FixWallLsdcd::spheres_in_atom()
{
  lsdcd::HostSpheres s;
  s.n = atom->nlocal;
  if (s.n) {
    s.x = atom->x[0];
    s.v = atom->v[0];
    if (atom->omega_flag) s.omega = atom->omega[0];
    s.force = atom->f[0];
    s.torque = atom->torque[0];
  }
  s.radius = atom->radius;
  s.mass = rigid ? damping_mass.data() : atom->rmass;
  s.mask = igroup ? atom->mask : nullptr;
  s.type = atom->type;
  s.group_bit = groupbit;
  s.group = group->names[igroup];
  s.group_changes = group->dynamic[igroup] != 0;
  if (atom->tag_enable) s.tag = atom->tag;
  if (shape_atoms) shape_atoms->put(s);
#if HOST_HAS_HEAT
  s.temperature = atom->temperature;
  s.heat_flow = atom->heatflow;
#endif
  return s;
}

lsdcd::HostSpheres FixWallLsdcd::spheres()
{
  return spheres_in_atom();
}

// Damping of an atom in a rigid body reads the mass of the body.
void FixWallLsdcd::fill_masses()
{
  need_masses();
  const int nlocal = atom->nlocal;
  damping_mass.assign(atom->rmass, atom->rmass + nlocal);
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    if (!fix->rigid_flag) continue;
    int dim;
    const int *body = (const int *) fix->extract("body", dim);
    const double *mass = (const double *) fix->extract("masstotal", dim);
    if (!body || !mass) continue;
    for (int i = 0; i < nlocal; i++)
      if (body[i] >= 0 && mass[body[i]] > 0.0) damping_mass[i] = mass[body[i]];
  }
}

// ---- outputs -----------------------------------------------------------------------------

double FixWallLsdcd::compute_scalar()
{
  return wall->totals().of_all().energy;
}

double FixWallLsdcd::compute_array(int mesh, int i)
{
  return lsdcd::output_of(*wall, mesh, i);
}

double FixWallLsdcd::compute_vector(int i)
{
  return lsdcd::output_of(*wall, -1, i);
}

// The only mesh of a wall has the numbers of the wall.
void FixWallLsdcd::name_outputs(const std::vector<std::string> &words, int mesh)
{
  std::vector<lsdcd::NamedElement> known = lsdcd::named_outputs(spec());
  const int row = array_flag && mesh >= 0 ? mesh + 1 : 0;
  if (row > 0) known.pop_back();    // the scalar, which is of the wall
  variables.make(words, known, row, [&](const std::string &name) {
    if (row > 0 && name == lsdcd::named_outputs(spec()).back().name)
      return "'" + name + "' is of all meshes together: leave out mesh K";
    return lsdcd::why_no_output(spec(), name);
  });
}

void FixWallLsdcd::fill_contacts()
{
  for (int i = 0; i < atom->nlocal; i++)
    std::fill(array_atom[i], array_atom[i] + size_peratom_cols, 0.0);
  wall->for_contact_rows(
      [this](int i, const double *row) { std::copy_n(row, size_peratom_cols, array_atom[i]); });
}

void FixWallLsdcd::fill_each_contact()
{
  need_ids();
  contact_rows.clear();
  const auto put = [this](std::initializer_list<double> numbers) {
    contact_rows.insert(contact_rows.end(), numbers);
  };
  wall->for_contacts([&](const lsdcd::WallContact &c) {
    put({static_cast<double>(atom->tag[c.sphere]), c.mesh + 1.0, c.force.x, c.force.y, c.force.z,
         c.point.x, c.point.y, c.point.z, c.overlap});
    if (!c.losses) return;
    for (int k = 0; k < lsdcd::kListedCauses; k++) put({c.losses->power[k]});
    for (int k = 0; k < lsdcd::kListedCauses; k++) put({c.losses->energy[k]});
    put({c.has_ended ? 1.0 : 0.0});
  });
  contact_row_at.clear();
  for (std::size_t at = 0; at < contact_rows.size(); at += size_local_cols)
    contact_row_at.push_back(contact_rows.data() + at);
  array_local = contact_row_at.data();
  size_local_rows = static_cast<int>(contact_row_at.size());
}

double FixWallLsdcd::memory_usage()
{
  double bytes = wall->bytes() + (shape_atoms ? shape_atoms->bytes() : 0) +
                 damping_mass.capacity() * sizeof(double);
  bytes += (double) contact_rows.capacity() * sizeof(double) +
           (double) contact_row_at.capacity() * sizeof(double *);
  if (spec().contacts) bytes += (double) atom->nmax * size_peratom_cols * sizeof(double);
  return bytes;
}

// Processes merge their pictures, so the first one draws.
int FixWallLsdcd::image(int *&kinds, double **&rows)
{
  const bool first = !picture.is_drawn();
  const int n = comm->me == 0 ? picture.draw(*wall, kinds, rows) : 0;
  // LAMMPS does not say which diameter the script gives.
  if (comm->me == 0 && first && !spec().brief && picture.spec.draw != lsdcd::Draw::faces)
    host.log(
        "dump image draws the mesh as " + std::to_string(n) +
        " lines; if you do not see them, or they hide all else, their diameter is 0, or far too "
        "large: write fix " +
        std::string(id) + " type DIAMETER 0, with DIAMETER in units of length");
  return n;
}

int FixWallLsdcd::modify_param(int narg, char **arg)
{
  std::vector<std::string> words = words_of(arg, arg + narg);
  int mesh;
  if (lsdcd::asks_for_names(*wall, words, mesh)) {
    name_outputs(words, mesh);
    return narg;
  }
  const int taken = lsdcd::change_wall(*wall, words, step_now());
  size_vector = size_array_cols = lsdcd::n_outputs(spec());
  return taken;
}
