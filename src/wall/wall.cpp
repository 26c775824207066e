// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/wall.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "base/number_words.h"
#include "wall/checks/mesh_checks.h"
#include "wall/reports/creation_text.h"
#include "wall/spec/mesh_name.h"
#include "wall/spec/spec_units.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace lsdcd {

Wall::Wall(Host &host, WallSpec spec, const WallUnits &units, WallBackend backend,
           const std::string &material, const StepClock &clock, const HostSpheres &there) :
    host_(host),
    spec_(in_units(std::move(spec), units.pressure, units.velocity)), laws_(law_table(spec_)),
    backend_(std::move(backend)), clock_(clock), pressure_unit_(units.pressure),
    coats_(host, spec_, meshes_), engine_input_(host, spec_, laws_, meshes_, units.velocity),
    history_(host, spec_.law()), totals_(host, spec_), means_(host, spec_), energy_(host, spec_),
    loads_(host, spec_), records_(host, spec_), files_(host, spec_, units.pressure),
    overlaps_(host, spec_), search_(host), times_(host), timestep_(host, laws_, units.velocity),
    snapshots_(host, spec_), box_checks_(host, spec_, meshes_),
    grids_(host, spec_, laws_, meshes_, coats_, box_checks_, history_, times_),
    keeper_(host, spec_, {meshes_, coats_, grids_, totals_, means_, loads_, energy_, records_})
{
  for (std::size_t k = 0; k < spec_.meshes.size(); k++) {
    MeshPart &m = meshes_.emplace_back(host_, spec_, laws_, static_cast<int>(k), units.velocity,
                                       Step{clock.last_step, clock.dt});
    if (m.nodes()) with_nodes_.push_back(m.nodes());
    check_weld(host_, spec_, m);
    check_side(spec_, m);
    check_pressure(spec_, m);
    check_plane(host_, spec_, m);
    check_stays_closed(host_, spec_, m);
    poses_.push_back(m.pose());
    note_mobility(m);
  }
  list_meshes();
  // Where the spheres are says it in place, and nodes that move stay on their device.
  const bool is_fixed = backend_.in_place || !with_nodes_.empty();
  device_ = DeviceChoice(spec_.device, is_fixed ? 0 : cuda_devices(), host_.ranks().node_size);
  coats_.make(engine_settings(), units.velocity);
  make_engine();
  log_creation(material, backend_);

  // Without spheres there is no telling how far outside is too far.
  Real radius = 0;
  for (int i = 0; i < there.n; i++)
    if (there.may_be_in_group(i)) radius = std::max(radius, there.radius[i]);
  host_.max(&radius, 1);
  if (spec_.rmax > 0) radius = spec_.rmax;
  for (const MeshPart &m : meshes_) {
    box_checks_.check_scale(m, grids_.box());
    box_checks_.check_periodic(m, grids_.box());
    if (radius > 0) box_checks_.check_outside(m, grids_.box(), cutoff_of(laws_, radius));
    check_surface_motion(host_, spec_, m);
  }
  if (meshes_.size() > 1 && spec_.corner == Corner::sum)
    host_.warn("with corner sum both meshes push a sphere over a seam where they meet: use corner "
               "blend, or one mesh of all triangles");
}

std::string Wall::named(const MeshPart &m, const std::string &text) const
{
  return with_mesh_name(spec_, m.index, text);
}

void Wall::list_meshes()
{
  for (std::vector<MeshPart *> *list :
       {&placed_, &moving_, &changing_, &bodies_, &servos_, &recorded_, &with_energy_records_})
    list->clear();
  for (MeshPart &m : meshes_) {
    if (m.moves()) placed_.push_back(&m);
    if (m.moves() || m.spec.surface_varies()) moving_.push_back(&m);
    if (m.surface->changes()) changing_.push_back(&m);
    if (m.body) bodies_.push_back(&m);
    if (m.servo().present) servos_.push_back(&m);
    if (spec_.has_loads(m.spec)) recorded_.push_back(&m);
    if (spec_.records_energy()) with_energy_records_.push_back(&m);
  }
}

std::vector<int> Wall::inputs_read() const
{
  std::vector<int> all;
  for (const MeshPart &m : meshes_)
    for (const int input : m.mover.inputs()) all.push_back(input);
  for (const MeshPart &m : meshes_)
    if (m.spec.temperature_input != kNoInput) all.push_back(m.spec.temperature_input);
  for (const MeshPart &m : meshes_)
    if (m.spec.pressure_input != kNoInput) all.push_back(m.spec.pressure_input);
  return all;
}

std::size_t Wall::bytes() const
{
  std::size_t bytes =
      engine_->bytes() + loads_.bytes() + records_.bytes() + history_.bytes() + coats_.bytes();
  for (const MeshPart &m : meshes_) bytes += m.grid.bytes() + m.surface->bytes();
  return bytes;
}

// ---- the engine --------------------------------------------------------------------------

void Wall::make_engine()
{
  const EngineSettings want = engine_settings();
  engine_moves_ = want.moves;
  engine_contacts_ = want.contacts || want.bodies || want.nodes;
  std::unique_ptr<WallEngine> made;
  run_collectively(host_, true, [&] { made = backend_.make_engine(want); });
  give_nodes(host_, with_nodes_, engine_.get(), *made);
  loads_.set_engine(made->loads());    // while the last one is there
  records_.set_engine(made->energies());
  engine_ = std::move(made);
  reads_loads_ = false;
  for (const MeshPart *m : recorded_)
    reads_loads_ = reads_loads_ || !engine_->loads() || spec_.recedes(m->spec);
  history_.set_engine(*engine_, backend_.in_place);
  grids_.set_engine(*engine_);
  for (const MeshPart *m : placed_) engine_->set_pose(m->pose(), m->index);
}

// Replaces the engine where one for other settings, or on another device, is due. What the last one knows of its step is asked for first.
void Wall::replace_engine_if_due(const HostSpheres &spheres, const StepInput &input)
{
  const bool chooses_device =
      (input.look || is_set_up_) && input.step.kind == Step::step && device_.is_open();
  const Real near = chooses_device ? most_candidates() : 0;
  const bool goes_elsewhere = chooses_device && device_.update(static_cast<std::int64_t>(near)),
             lacks_settings =
                 (!moving_.empty() && !engine_moves_) || (virial_ && !engine_contacts_);
  if (!goes_elsewhere && !lacks_settings) return;
  sums();
  run_collectively(host_, true, [&] { poll_diagnostics(spheres); });
  history_.on_cpu();
  make_engine();
  if (goes_elsewhere) log_device(near);
}

void Wall::log_creation(const std::string &material, const WallBackend &backend) const
{
  if (!host_.is_first()) return;
  std::string device = engine_->backend(), why;
  if (!spec_.brief && !backend.in_place && spec_.device == Device::automatic &&
      !cuda_available(&why))
    device += " (no CUDA: " + why + ")";
  host_.log(
      creation_text(host_.names(), spec_, meshes_, coats_, engine_settings(), material, device));
}

// Runs what this process does alone in a step. A process whose step has failed takes part in what all processes do together, with no
// contacts, so that the others do not wait for it; finish() then throws the error.
template <class Work>
void Wall::guard(const HostSpheres &spheres, Work &&work)
{
  if (failure_) return;
  try {
    work();
  } catch (const std::exception &) {
    const InputError failure = failure_here(spheres);
    if (host_.processes() == 1) throw failure;
    failure_ = failure;
  }
}

// Returns the exception that was caught as an error of this process, in which a sphere has the name that the host has for it.
InputError Wall::failure_here(const HostSpheres &spheres) const
{
  InputError failure(error_of([&] {
    try {
      throw;
    } catch (const InputError &e) {
      if (e.sphere < 0) throw;
      throw InputError(host_.sphere_text(on_cpu(spheres).tag(e.sphere)) + " " + e.problem);
    }
  }));
  failure.is_local = true;
  return failure;
}

// ---- a step ------------------------------------------------------------------------------

void Wall::begin_run(std::int64_t step, bool virial)
{
  for (const MeshPart &m : meshes_)
    if (cutoff() > 0) box_checks_.check_outside(m, grids_.box(), cutoff());
  virial_ = virial;
  files_.begin_run(step);
  deepest_overlap_ = 0;
}

void Wall::begin(const HostSpheres &spheres, const StepInput &input)
{
  replace_engine_if_due(spheres, input);
  open_step(spheres, input);
  if (!changing_.empty()) change_surfaces(input.step);
  if (!moving_.empty()) move(spheres);
  // A mesh that rests stays where the last box had it.
  if (input.look || input.box_changes || !moving_.empty()) place_grids(spheres);
  for (const MeshPart *m : moving_) engine_->set_pose(m->pose(), m->index);
  if (input.new_spheres) look_at_new_spheres(spheres);
  failure_.reset();    // that of the last step is asked for until here
  if (cutoff() == 0) return;
  guard(spheres, [&] {
    history_.to_engine(spheres.n);
    engine_->begin(input.when);
  });
}

// Takes over what the host says of a step, and drops what it no longer allows.
void Wall::open_step(const HostSpheres &spheres, const StepInput &input)
{
  const Step &step = input.step;
  input_ = input;
  has_begun_ = is_running_ = true;
  is_set_up_ = step.kind == Step::setup;
  if (history_.room() < spheres.n) history_.grow(spheres.n);
  keeper_.end_restoring();
  if (step.kind == Step::snapshot) {
    snapshots_.check(meshes_, step);
    history_.clear();
  }
  // A candidate search depends on radii, and puts spheres of one law together.
  if (input.look) {
    engine_->expire_choice();
    check_history(spheres.n);
  }
  clock_.advance(step);
}

// A restored history names features of the old mesh and has numbers of the old law: drops what does not fit.
void Wall::check_history(int n)
{
  if (history_.is_checked()) return;
  history_.on_cpu();
  history_.check_restored(n, [this](const Spring &s) {
    return s.mesh < meshes_.size() && meshes_[s.mesh].has(s.feature);
  });
}

// Poses last: what servos ask for is of where meshes were.
void Wall::move(const HostSpheres &spheres)
{
  const Step &step = input_.step;
  if (!bodies_.empty()) {
    if (!range_is_known_) look_at_range(spheres);
    complete_bodies();
  }
  for (MeshPart *m : moving_)
    m->mover.advance(step, input_.inputs, [&] {
      if (!range_is_known_) look_at_range(spheres);
      return servo_load(m->index);
    });
  for (MeshPart *m : moving_) m->mover.place();
  for (MeshPart *m : moving_) {
    m->surface->begin(step, cutoff());
    if (largest_within_ > 0) check_way(host_, spec_, *m, step, largest_within_, on_cpu(spheres));
  }
}

// Builds the grids that do not fit the spheres or the box of this step, and refuses meshes that do not.
void Wall::place_grids(const HostSpheres &spheres)
{
  const std::int64_t step = input_.step.number;
  if (input_.look)
    look_at_spheres(spheres);
  else if (input_.box_changes && grids_.fit_box(step))
    engine_->expire_choice();
  if (placed_.empty()) return;
  box_checks_.check_moving(placed_, grids_.box(), cutoff(), input_.step);
  box_checks_.check_gone(placed_, grids_.box(), cutoff(), step);
}

void Wall::look_at_new_spheres(const HostSpheres &spheres)
{
  if (cutoff() > 0) timestep_.check(input_.step.dt, on_cpu(spheres).all());
  look_at_range(spheres);
}

// Returns how many spheres were near the wall in the last step, on the process that has most.
Real Wall::most_candidates()
{
  Real near = engine_->n_candidates();
  host_.max(&near, 1);
  return near;
}

// Engines of both devices give the same bits.
void Wall::log_device(Real near)
{
  if (spec_.brief || !host_.is_first()) return;
  host_.log("on " + engine_->backend() + " from now on, with " +
            std::to_string(static_cast<std::int64_t>(near)) + " " + host_.names().sphere +
            "s near the wall in one process: a GPU is faster from " +
            std::to_string(device_.least_for_gpu()) + " on");
}

// Gives bodies the second half of the last step, before others ask for it. Inputs still have its values.
void Wall::complete_bodies()
{
  if (std::none_of(bodies_.begin(), bodies_.end(),
                   [](const MeshPart *m) { return m->body->is_half_done(); }))
    return;
  const Real *g = input_.gravity;
  const Vec3 gravity = g ? Vec3{g[0], g[1], g[2]} : Vec3{0, 0, 0};
  for (MeshPart *m : bodies_)
    if (m->body->is_half_done())
      totals_.set_power(m->index, m->body->complete(sums().mesh(m->index), gravity));
  for (MeshPart *m : bodies_)
    m->body->check_step(touch(*m), [&](bool of_coat) {
      return coats_.fastest_touched(m->index, [&](const MeshPart &other) {
        return other.body ? other.body->rates(touch(other), of_coat) : ModeRates();
      });
    });
}

Touch Wall::touch(const MeshPart &m)
{
  return {sums().mesh(m.index), range_, coats_.load(m.index)};
}

const BodyMover *Wall::body(int mesh)
{
  complete_bodies();
  return meshes_[mesh].body;
}

void Wall::look_at_spheres(const HostSpheres &spheres)
{
  Spheres s = spheres;
  if (spheres.group_changes) s.mask = nullptr;    // others may join between two looks
  Real most[3] = {engine_->largest_radius(s), overlaps_.worst(), 0};
  most[2] = spheres.shapes ? largest_within(spheres) : most[0];
  host_.max(most, 3);
  const SpheresOnCpu there = on_cpu(spheres);
  overlaps_.check_sunk(most[1], timestep_.worst_ratio(), there);
  overlaps_.check_sharp();
  largest_within_ = most[2];
  if (most[0] == 0 && !points_warned_) points_warned_ = warn_of_points(host_, there);
  if ((most[0] > 0 || coats_.any()) && grids_.fit_spheres(most[0], there, input_.step.number))
    engine_->expire_choice();
}

// For gains of servos and the timestep of bodies.
void Wall::look_at_range(const HostSpheres &spheres)
{
  if (bodies_.empty() && servos_.empty()) return;
  range_ = range_of(host_, on_cpu(spheres));
  range_is_known_ = true;
}

ServoLoad Wall::servo_load(int mesh)
{
  const MeshTotals &t = sums().mesh(mesh);
  const CoatLoad &coat = coats_.load(mesh);
  return {t.force,
          t.torque_at_origin,
          t.contacts + coat.contacts,
          std::max(t.overlap, coat.overlap),
          std::max(range_.radius, coat.radius),
          std::max(range_.mass, coat.mass),
          meshes_[mesh].bounds(0)};
}

void Wall::search_if_due(const Spheres &spheres)
{
  if (!with_nodes_.empty()) place_nodes(with_nodes_, *engine_, cutoff(), spheres.n);
  std::vector<MovingMesh> moving;
  for (const MeshPart *m : moving_)
    if (m->spec.motion.any()) moving.push_back({m->pose(), m->bounds(cutoff())});
  if (!engine_->choose_if_due(spheres, input_.drift, moving)) return;
  for (MeshNodes *nodes : with_nodes_) nodes->note_choice();
  search_.count_update();
}

// Before the meshes move, so that the step is all of the new surface.
void Wall::change_surfaces(const Step &step)
{
  for (MeshPart *m : changing_) {
    if (!m->surface->change(step)) continue;
    grids_.follow_surface(*m);
    engine_->expire_choice();
    if (!spec_.energy) continue;
    receded_.resize(meshes_.size());
    receded_[m->index] = m->surface->receded();
  }
}

Real Wall::pressure(int mesh) const
{
  const MeshSpec &spec = spec_.meshes[mesh];
  if (spec.pressure_input == kNoInput) return spec.pressure;
  const std::size_t k = static_cast<std::size_t>(spec.pressure_input);
  if (k >= input_.inputs.size())
    throw InputError("the pressure of mesh '" + spec.name + "' is v_" + spec_.inputs[k] +
                     ", which has had no value in a step yet: ask for forces on nodes after one");
  return input_.inputs[k] / pressure_unit_;
}

const std::vector<Real> &Wall::node_forces(int mesh)
{
  return nodes(mesh).forces(pressure(mesh));
}

bool Wall::put_node_forces(int mesh, Real *to, const std::vector<int> &node_of_row)
{
  return nodes(mesh).put_forces(pressure(mesh), to, node_of_row);
}

void Wall::clear_totals()
{
  totals_.clear();
  for (MeshNodes *nodes : with_nodes_) nodes->clear_forces();
}

void Wall::submit(const HostSpheres &spheres)
{
  if (step_state() != StepState::begun || failure_) return;
  guard(spheres, [&] {
    const StepSettings step = step_settings();
    times_.begin();
    search_if_due(spheres);
    times_.end(TimeReport::choice);
    engine_->submit(spheres, step);
    if (engine_->is_under_way()) times_.end(TimeReport::forces);
  });
}

StepSettings Wall::step_settings()
{
  const auto any = [](const std::vector<MeshPart *> &list, const auto &has) {
    return std::any_of(list.begin(), list.end(), has);
  };
  const bool asked = any(bodies_, [](const MeshPart *m) { return m->body->asks_for_contacts(); });
  const bool sums =
      !bodies_.empty() || any(servos_, [](const MeshPart *m) { return m->mover.servo_acts(); });
  StepSettings step = engine_input_.step(input_, {!bodies_.empty(), asked, reads_loads_, sums});
  if (!receded_.empty()) step.receded = receded_.data();
  return step;
}

void Wall::collect(int n)
{
  if (step_state() == StepState::submitted) {
    const bool waits = engine_->is_under_way();
    times_.begin();
    engine_->collect();
    times_.end(waits ? TimeReport::waiting : TimeReport::forces);
    history_.set_spheres_of_engine(n);
    search_.count_step(input_.step.kind != Step::step);
  }
  for (MeshNodes *nodes : with_nodes_) {
    if (cutoff() > 0)
      nodes->see_forces();
    else
      nodes->clear_forces();
  }
}

void Wall::finish(const HostSpheres &spheres)
{
  submit(spheres);    // nothing, if the host has submitted
  if (!bodies_.empty() && coats_.any()) {
    times_.begin();
    coats_.step(input_.step, receded_);
    times_.end(TimeReport::forces);
  }
  guard(spheres, [&] { collect(spheres.n); });
  receded_.clear();
  totals_.expire();
  if (!moving_.empty()) note_poses();
  for (MeshPart *m : bodies_) m->body->end(input_.step, results());
  if (!with_nodes_.empty() && cutoff() > 0)
    agree_on_forces(host_, with_nodes_, failure_.has_value());
  note_step(spheres);
  if (failure_) throw InputError(*failure_);
}

// Keeps where meshes are in this step. One that has come to rest has nothing to do in the next.
void Wall::note_poses()
{
  for (const MeshPart *m : moving_) poses_[m->index] = m->pose();
  moving_.erase(std::remove_if(moving_.begin(), moving_.end(),
                               [](const MeshPart *m) { return m->is_at_rest(); }),
                moving_.end());
}

// Returns what the last step left on this process, or null where there is none.
StepResults *Wall::results() const
{
  return cutoff() > 0 && !failure_ ? &engine_->results() : nullptr;
}

// Adds a step to all that goes over steps.
void Wall::note_step(const HostSpheres &spheres)
{
  const Step &step = input_.step;
  StepResults *const left = results();
  if (spec_.average_every > 0 && step.kind == Step::step)
    means_.add(step, left, poses_, node_loads(), coats_.loads());
  if (spec_.energy) energy_.add(left, coats_.energy(), step);
  if (step.kind == Step::step) record(left);    // what sets a run up has no duration
  for (const MeshPart *m : changing_)
    if (left) m->surface->end(*left, step);
  if (step.kind == Step::setup) log_new_springs(step);
  if (input_.new_spheres) check_new_spheres(spheres);    // throws on one process alone
  if (step.kind == Step::setup) times_.begin_run();      // as the host's loop time
}

// Adds a step to what is recorded by triangle.
void Wall::record(const StepResults *of_step)
{
  const Real dt = input_.step.dt;
  const EnergyRecords records = of_step ? of_step->energy_records() : EnergyRecords();
  const std::vector<EnergyRecord> &of_coats = coats_.energy().records;
  const bool has_contacts = of_step || !of_coats.empty();
  const auto part = [&](const MeshPart &m) -> RecordedMesh {
    return {m.index, m.feature_counts(), has_contacts ? m.records() : MeshFeaturesView()};
  };
  for (const MeshPart *m : recorded_)
    loads_.add(part(*m), of_step ? &of_step->contacts() : nullptr, dt);
  for (const MeshPart *m : with_energy_records_)
    records_.add(part(*m), of_step ? &records : nullptr,
                 {of_coats.data(), static_cast<int>(of_coats.size())}, dt);
}

// Where a wall comes, or comes again, among spheres that rest on it.
void Wall::log_new_springs(const Step &step)
{
  if (springs_told_) return;
  springs_told_ = true;
  if (continued_ || step.number == 0 || !history_.is_on()) return;
  const auto contacts = static_cast<std::int64_t>(totals().of_all().contacts);
  if (contacts == 0 || spec_.brief) return;
  host_.log(
      "the wall begins in step " + std::to_string(step.number) + " with " +
      counted(contacts, "contact") +
      ", whose springs are 0, as a wall that is made again takes over none of the one before it");
}

// The counts of the steps since the last call, for the log.
StepDiagnostics Wall::read_diagnostics(const HostSpheres &spheres)
{
  StepDiagnostics seen;
  if (cutoff() == 0) return seen;
  try {
    seen = engine_->read_diagnostics();
  } catch (const std::exception &) {
    throw failure_here(spheres);
  }
  search_.add(seen);
  deepest_overlap_ = std::max(deepest_overlap_, seen.deepest * seen.deepest_radius);
  return seen;
}

void Wall::poll_diagnostics(const HostSpheres &spheres)
{
  overlaps_.note(read_diagnostics(spheres), on_cpu(spheres));
}

// An error of this process alone must not keep the others waiting.
void Wall::check_new_spheres(const HostSpheres &spheres)
{
  const std::int64_t step = input_.step.number;
  StepDiagnostics seen;
  const std::string error = error_of([&] { seen = read_diagnostics(spheres); });
  overlaps_.check_new(seen, on_cpu(spheres), step, continued_ || step > 0);
  if (!error.empty()) fail_here(error);
}

void Wall::end_run(const HostSpheres &spheres, bool far, const std::string &advice, Real loop)
{
  totals_with_power();
  is_running_ = false;
  poll_diagnostics(spheres);
  Real worst = overlaps_.worst();
  host_.max(&worst, 1);
  overlaps_.check_sunk(worst, timestep_.worst_ratio(), on_cpu(spheres));
  overlaps_.check_sharp();
  overlaps_.end_run(spec_.brief);
  if (far) grids_.check_wrapping(spheres);
  grids_.end_run();
  search_.end_run(spec_.brief, advice);
  if (spec_.nearest > 0) search_.log_uncertified(spec_.nearest, spec_.brief);
  times_.end_run(spec_.brief, loop);
}

// ---- outputs -----------------------------------------------------------------------------

const StepTotals &Wall::totals()
{
  complete_bodies();
  return sums();
}

const StepTotals &Wall::totals_with_power()
{
  totals();
  for (const MeshPart &m : meshes_) {
    if (!m.nodes() || !is_running_) continue;
    std::optional<Real> on_nodes = host_.power_on_nodes(m.index, m.nodes()->forces(0));
    if (!on_nodes) continue;
    host_.sum(&*on_nodes, 1);
    totals_.set_power(m.index, 0 - *on_nodes);    // not -0 at rest
  }
  return totals_;
}

// Returns the loads of the nodes of each mesh; empty where none has any. Collective.
std::vector<NodeLoad> Wall::node_loads()
{
  std::vector<NodeLoad> loads(with_nodes_.empty() ? 0 : meshes_.size());
  for (const MeshPart &m : meshes_)
    if (MeshNodes *nodes = m.nodes()) loads[m.index] = {true, nodes->power(), nodes->moment()};
  return loads;
}

// The sums of contacts, which bodies need for velocities of the whole step.
const StepTotals &Wall::sums()
{
  if (totals_.are_made()) return totals_;
  totals_.reduce(results(), poses_, node_loads(), coats_.loads());
  return totals_;
}

Real Wall::servo_push(int mesh)
{
  return meshes_[mesh].mover.servo_push(servo_load(mesh));
}

void Wall::add_virial(Real *virial) const
{
  if (cutoff() > 0) lsdcd::add_virial(engine_->results(), poses_, virial);
}

void Wall::for_contact_rows(const std::function<void(int, const Real *)> &row) const
{
  if (cutoff() > 0) lsdcd::for_contact_rows(engine_->results(), row);
}

void Wall::for_contacts(const std::function<void(const WallContact &)> &found) const
{
  if (cutoff() == 0) return;
  // In a snapshot no time has passed, and springs may be of another one.
  static const KeptLosses none = {};
  const bool is_snapshot = input_.step.kind == Step::snapshot;
  lsdcd::for_contacts(*engine_, poses_, [&](WallContact contact) {
    if (contact.losses && is_snapshot) contact.losses = &none;
    found(contact);
  });
}

void Wall::write_due_files()
{
  times_.begin();
  std::vector<PosedMesh> meshes;
  for (const MeshPart &m : meshes_) meshes.push_back({m.mesh(), m.pose()});
  const bool has_loads = input_.step.kind != Step::snapshot;
  files_.write_due(input_.step.number, static_cast<double>(clock_.now()), meshes,
                   has_loads ? &loads_ : nullptr, records_);
  times_.end(TimeReport::files);
}

// ---- another motion ----------------------------------------------------------------------

void Wall::restore_inputs(const std::vector<Real> &values)
{
  input_.inputs = values;
  for (MeshPart &m : meshes_) m.mover.take_inputs(values);
}

void Wall::set_inputs(const InputNames &inputs)
{
  spec_.inputs = inputs;
}

void Wall::set_motion(int mesh, const RigidMotion &motion, const Step &now)
{
  MeshPart &m = meshes_[mesh];
  m.mover.set_motion(motion, now);
  mover_has_changed(m);
  log_change(m, "motion " + (motion.moves() ? m.mover.text(m.bounds(0)) : "none"));
}

void Wall::check_is_body(int mesh) const
{
  const MeshPart &m = meshes_[mesh];
  if (!m.body)
    throw InputError(named(m, "the mesh is not a body, and cannot become one later: make it a body "
                              "when the wall is made"));
}

void Wall::set_body(int mesh, const BodySpec &to)
{
  MeshPart &m = meshes_[mesh];
  check_is_body(mesh);
  complete_bodies();
  m.body->set_body(to);
  mover_has_changed(m);
  log_change(m, "body " + m.body->body_text());
}

void Wall::set_servo(int mesh, const Servo &servo)
{
  MeshPart &m = meshes_[mesh];
  m.mover.set_servo(servo);
  range_is_known_ = false;    // a run without setup looks then
  mover_has_changed(m);
  log_change(m, "servo " + (servo.present ? m.mover.servo_text() : "none"));
}

void Wall::log_change(const MeshPart &m, const std::string &text)
{
  if (!spec_.brief) host_.log(named(m, text));
}

void Wall::note_mobility(const MeshPart &m)
{
  timestep_.set_mobility(m.index, m.body ? m.body->most_mobility() : 0);
}

// Notes what is so of a mover that was changed or restored.
void Wall::mover_has_changed(const MeshPart &m)
{
  note_mobility(m);
  list_meshes();
  engine_->expire_choice();
}

// ---- saved states ------------------------------------------------------------------------

// The images of another run may have other numbers.
int Wall::pack_saved(int sphere, Real *buffer)
{
  history_.on_cpu();
  return history_.pack_saved(sphere, buffer, [this](int mesh, FeatureCode feature) {
    return grids_.without_image(mesh, feature);
  });
}

WallState Wall::save()
{
  totals_with_power();
  return keeper_.save(clock_.now());
}

void Wall::keep_made()
{
  keeper_.keep_made();
}

void Wall::restore(const WallState &was, const Step &now)
{
  keeper_.check(was);
  continued_ = true;
  files_.continue_lists();
  history_.set_kind_of_file(was.history_kind);
  clock_.base = was.time;
  clear_totals();
  keeper_.restore(was, now);
  for (const MeshPart &m : meshes_) mover_has_changed(m);
}

void Wall::restore_springs(const std::vector<std::vector<Real>> &spheres)
{
  const int n = static_cast<int>(spheres.size());
  history_.grow(std::max(history_.room(), n));
  history_.clear();
  for (int i = 0; i < n; i++)
    history_.unpack_saved(i, spheres[i].data(), static_cast<int>(spheres[i].size()));
  check_history(n);
}

}    // namespace lsdcd
