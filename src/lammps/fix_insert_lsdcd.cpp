// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/fix_insert_lsdcd.h"

#include "base/input_words.h"
#include "base/vector_text.h"
#include "box/likely_scale.h"
#include "box/outside_box.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_atom_vec.h"
#include "lammps/host_atoms.h"
#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/host_respa.h"
#include "lammps/mpi_host.h"
#include "lammps/mpi_mesh.h"
#include "lammps/other_fixes.h"
#include "lammps/restart_data.h"
#include "shape/shapes_made.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "modify.h"
#include "neighbor.h"
#include "region.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

// LAMMPS 29Sep2021 does not tell fixes that the command timestep has changed it, and a run may have no setup. Later ones do; in
// them a fix that acts as steps begin has Kokkos copy all atoms in each step, or not fuse its integration.
static constexpr bool kHostTellsTimestep = LSDCD_HOST_VERSION >= 20220601;

using lsdcd::Insertion;
using lsdcd::number_text;
using lsdcd::PackedSphere;
using lsdcd::Vec3;

namespace LAMMPS_NS {

// Asked by the first process alone.
class LammpsSite : public lsdcd::InsertionSite {
 public:
  explicit LammpsSite(FixInsertLsdcd &fix) :
      fix_(fix), zone_(fix.zone()), box_(lsdcd::host_box(*fix.domain))
  {
  }

  bool draw(lsdcd::RandomStream &random, double radius, Vec3 &at) override
  {
    for (int k = 0; k < kTries; k++) {
      if (fix_.face) {
        if (!fix_.face->draw(random, radius, at)) return false;
      } else {
        for (int d = 0; d < 3; d++) at[d] = random.uniform(zone_.lo[d], zone_.hi[d]);
        if (!fix_.region->match(at.x, at.y, at.z)) continue;
      }
      if (is_in_box(at)) return true;
    }
    return false;
  }

  bool is_clear_of_walls(const PackedSphere &grain) override
  {
    return has_all_in_box(grain) && fix_.walls->is_clear(grain, box_);
  }

  // Beside walls that have never moved: others may yet make room.
  void check_has_room(const lsdcd::Grain &grain) override
  {
    double &radius_with_room = fix_.radius_with_room[grain.kind];
    if (grain.radius <= radius_with_room) return;
    const lsdcd::GrainSource &source = fix_.insertion->source();
    lsdcd::RandomStream random({fix_.settings.plan.seed, kRoom});
    for (int k = 0; k < kTriesOfRoom; k++) {
      Vec3 at = {0, 0, 0};
      if (!draw(random, grain.radius, at)) {
        k += kTries;
        continue;
      }
      const lsdcd::Quaternion turn = source.has_kinds() ? source.turn(random) : lsdcd::Quaternion();
      const PackedSphere here = fix_.insertion->packed(grain, at, turn, 0);
      if (has_all_in_box(here) && fix_.walls->is_clear_at_rest(here, box_)) {
        radius_with_room = grain.radius;
        return;
      }
    }
    throw lsdcd::InputError(fix_.no_room_text(grain, kTriesOfRoom));
  }

  double touch_radius(const lsdcd::Grain &grain) const override { return fix_.touch_radius(grain); }

 private:
  static constexpr int kTries = 10000, kTriesOfRoom = 100000;
  static constexpr std::int64_t kRoom = 4;    // part of a key, as in insertion.cpp

  // A mesh may reach past a periodic face; LAMMPS's regions end there.
  bool is_in_box(const Vec3 &at) const { return is_in_box(at, fix_.face != nullptr); }

  // Atoms of clumps may be past a periodic face, and LAMMPS loses those past another one.
  bool has_all_in_box(const PackedSphere &grain) const
  {
    if (!fix_.clumps) return true;
    for (const lsdcd::Ball &ball : grain.shape->balls)
      if (!is_in_box(grain.at + ball.centre, true)) return false;
    return true;
  }

  bool is_in_box(const Vec3 &at, bool may_be_periodic) const
  {
    const Vec3 part = box_.fraction(at);
    for (int k = 0; k < 3; k++) {
      if (box_.periodic[k] && may_be_periodic) continue;
      if ((part[k] < 0 && !box_.face_follows[k][0]) || (part[k] >= 1 && !box_.face_follows[k][1]))
        return false;
    }
    return true;
  }

  FixInsertLsdcd &fix_;
  const lsdcd::Box zone_;
  const lsdcd::PeriodicBox box_;
};

}    // namespace LAMMPS_NS

FixInsertLsdcd::FixInsertLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), OwnMessages(lmp, "Fix", id, "insert/lsdcd"),
    variables(lmp, std::string("f_") + id)
{
  if (domain->dimension == 2)
    fatal("the simulation has two dimensions: there is no insertion there");
  run_core([&] {
    settings = lsdcd::parse_insert(words_of(arg + 3, arg + narg));
    if (settings.has_clumps()) {
      check_atoms_of_clumps();
      clumps = std::make_unique<ClumpTemplates>(lmp, settings.molecules);
      lsdcd::GrainRecipe &grains = settings.plan.grains;
      grains.set_kinds(clumps->kinds(settings.shares), settings.shares_are_by_mass);
      grains.density_lo = grains.density_hi = 1;    // as GrainKind::solid() has it
      const std::string other = clumps->other_mass();
      if (!other.empty()) warn(other);
    } else {
      check_atoms();
    }
    if (settings.type > atom->ntypes)
      throw lsdcd::InputError("in 'type', there is no atom type " + std::to_string(settings.type) +
                              ": there are " + std::to_string(atom->ntypes));
    if (settings.has_shapes()) shape_atoms = std::make_unique<ShapeAtoms>(lmp, id);
    insertion = std::make_unique<Insertion>(settings.plan, update->ntimestep, update->dt);
    walls = std::make_unique<lsdcd::WallClearance>();
    if (settings.region.empty())
      read_face();
    else
      find_region();
  });
  const double mean = settings.plan.grains.mean_mass();
  const lsdcd::FeedSettings &feed = settings.plan.feed;
  if (feed.kind != lsdcd::FeedSettings::at_once)
    log("a grain every " +
        number_text((feed.kind == lsdcd::FeedSettings::by_mass ? mean : 1) / feed.rate) +
        " time units, with a mass of " + number_text(mean) + " on average");

  force_reneighbor = 1;
  time_depend = 1;
  restart_global = 1;
  vector_flag = 1;
  size_vector = lsdcd::n_elements(lsdcd::insertion_outputs());
  extvector = 0;
  global_freq = 1;
  dynamic_group_allow = 1;
  follow_schedule();
}

void FixInsertLsdcd::check_atoms() const
{
  const std::string shape = lsdcd::shape_of_atoms(*atom);
  if (!shape.empty() && shape != lsdcd::kEllipsoids)
    fatal("the atom style has " + shape +
          ", and grains would have no shape: use atom_style sphere without them");
  if (!settings.has_shapes()) {
    if (!shape.empty())
      fatal("the atom style has ellipsoids, and the spheres of 'diam' would have no shape: give "
            "'shape SX SY SZ', with three equal lengths for balls, or use atom_style sphere");
    if (!atom->radius_flag || !atom->rmass_flag)
      fatal("atoms need a radius and a mass each: use atom_style sphere");
    return;
  }
  if (shape.empty())
    fatal("'shape' is given, and the atom style has no shapes: use atom_style ellipsoid, or 'diam' "
          "for spheres");
  const std::string why = ShapeAtoms::why_not(*atom);
  if (!why.empty()) fatal(why);
  if (std::string(style).find("/kk") != std::string::npos)
    fatal("grains with a 'shape' come on a CPU alone: use insert/lsdcd without /kk");
  for (const lsdcd::GrainKind &kind : settings.plan.grains.kinds)
    if (!kind.shape.is_ellipsoid() && !ShapeAtoms::has_superellipsoids(*atom))
      fatal("in 'shape', 'block' makes superellipsoids, which the atom style does not have: use "
            "atom_style ellipsoid superellipsoid, of LAMMPS 30 Mar 2026 or later");
}

void FixInsertLsdcd::check_atoms_of_clumps() const
{
  if (!lsdcd::shape_of_atoms(*atom).empty() || !atom->radius_flag || !atom->rmass_flag)
    fatal("clumps are of spheres, and atoms need a radius and a mass each and no shapes: use "
          "atom_style sphere");
  if (atom->molecular == 2)
    fatal("atom_style template keeps molecules of its own: use atom_style sphere for clumps");
  if (!atom->molecule_flag || !atom->tag_enable)
    fatal("atoms of clumps need the ID of their molecule, and one of their own: write 'fix ID all "
          "property/atom mol ghost yes' before this fix, and leave out atom_modify id no");
}

// The bodies of new clumps are those of this fix.
void FixInsertLsdcd::find_rigid(const std::vector<Fix *> &fixes)
{
  rigid = nullptr;
  for (Fix *fix : fixes)
    if (fix && settings.rigid == fix->id) rigid = fix;
  if (!rigid)
    fatal("in 'rigid', there is no fix '" + settings.rigid + "': write 'fix " + settings.rigid +
          " all rigid/small molecule mol " + settings.molecules + "'");
  const std::string why = clumps->why_not(*rigid);
  if (!why.empty()) fatal("in 'rigid', " + why);
  if (!(rigid->groupbit & (1 | groupbit)))
    fatal("in 'rigid', fix " + settings.rigid +
          " acts on a group in which new atoms are not: they join all and that of this fix");
  if (std::string(rigid->style).find("/kk") != std::string::npos)
    warn("fix " + settings.rigid + " of style " + rigid->style +
         " has not been tried with new clumps: compare a short run with one of rigid/small");
}

FixInsertLsdcd::~FixInsertLsdcd()
{
  if (!radii_id.empty() && lsdcd::host_fix(*modify, radii_id)) modify->delete_fix(radii_id);
}

// Not in the constructor, where LAMMPS has no place for another fix.
void FixInsertLsdcd::post_constructor()
{
  const std::string name = "insert/lsdcd/radii";
  radii_id = std::string(id) + "_RADII";
  (*modify->fix_map)[name] = [](LAMMPS *lmp, int narg, char **arg) -> Fix * {
    return new FixInsertRadii(lmp, narg, arg);
  };
  modify->add_fix(radii_id + " all " + name);
  modify->fix_map->erase(name);
}

void FixInsertLsdcd::read_face()
{
  lsdcd::MpiHost mpi(world);
  const lsdcd::WeldedMesh mesh = lsdcd::read_together(mpi, settings.face);
  face = std::make_unique<lsdcd::InletFace>(mesh, settings.depth);
  const lsdcd::PeriodicBox box = lsdcd::host_box(*domain);
  const lsdcd::Box spans = {mesh.report.lo, mesh.report.hi};
  const std::string wrong = lsdcd::too_large_text(spans.hi - spans.lo, spans, box);
  if (!wrong.empty()) warn(wrong);
  const std::string outside = lsdcd::outside_box(spans, box, 0);
  if (!outside.empty()) throw lsdcd::InputError(outside);
  const double radius = insertion->source().largest_radius();
  if (!face->has_room(radius))
    throw lsdcd::InputError(settings.face.file + ": no place on the face is " +
                            number_text(radius) + ", the largest radius" +
                            (shape_atoms || clumps ? " of spheres around grains" : "") +
                            ", away from its edges: make the face wider, or its scale larger");
  velocity = settings.along_normal ? settings.speed * face->normal() : settings.velocity;
  log(lsdcd::counted(mesh.faces.size(), "triangle") + ", area " + number_text(face->area()) +
      ", normal " + lsdcd::vector_text(face->normal()));
}

void FixInsertLsdcd::find_region()
{
#if LSDCD_HOST_VERSION < 20220601
  const int i = domain->find_region(settings.region);
  region = i < 0 ? nullptr : domain->regions[i];
#else
  region = domain->get_region_by_id(settings.region);
#endif
  const std::string name = "region " + settings.region;
  if (!region) throw lsdcd::InputError("there is no " + name + ": define it before this fix");
  if (!region->bboxflag || region->varshape || region->dynamic_check())
    throw lsdcd::InputError(
        name +
        " has no bounds, or changes with time: give a region that does neither, with side in");
  velocity = settings.velocity;
}

lsdcd::Box FixInsertLsdcd::zone() const
{
  if (face) return face->zone();
  lsdcd::Box zone = {{region->extent_xlo, region->extent_ylo, region->extent_zlo},
                     {region->extent_xhi, region->extent_yhi, region->extent_zhi}};
  // INF, which is 1e20, reaches to the box.
  const lsdcd::Box box = lsdcd::host_box(*domain).bounds({0, 0, 0});
  for (int k = 0; k < 3; k++) {
    if (zone.lo[k] < -1e19) zone.lo[k] = box.lo[k];
    if (zone.hi[k] > 1e19) zone.hi[k] = box.hi[k];
  }
  return zone;
}

int FixInsertLsdcd::setmask()
{
  return PRE_EXCHANGE | POST_RUN | PRE_FORCE_RESPA |
         (kHostTellsTimestep ? 0 : INITIAL_INTEGRATE | INITIAL_INTEGRATE_RESPA);
}

void FixInsertLsdcd::init()
{
  n_levels = 0;
  const std::string late = late_pair_springs(*this, *modify);
  if (!late.empty()) fatal(late);
  check_temperature();
  std::vector<FixWallLsdcd *> found;
  std::vector<std::string> missing = settings.walls;
  const std::vector<Fix *> fixes = lsdcd::host_fixes(*modify);
  warn_of_seed(fixes);
  for (Fix *fix : fixes) {
    auto *wall = dynamic_cast<FixWallLsdcd *>(fix);
    const auto named = std::find(missing.begin(), missing.end(), fix->id);
    const bool is_named = named != missing.end();
    if (is_named && !wall)
      fatal("in 'wall', fix " + *named + " is of style " + fix->style +
            ": give the ID of a fix wall/lsdcd");
    if (is_named) missing.erase(named);
    // Grains are in the group all and in that of this fix.
    if (wall && (is_named || (settings.all_walls && (wall->groupbit & (1 | groupbit)))))
      found.push_back(wall);
    // The first one answers for all.
    if (LSDCD_HOST_VERSION < 20220601 && std::strcmp(fix->style, "pour") == 0 &&
        !dynamic_cast<FixInsertRadii *>(fix)) {
      bool before = true;
      for (std::size_t k = 0; fixes[k] != fix; k++)
        before = before && !dynamic_cast<FixInsertRadii *>(fixes[k]);
      if (before)
        fatal("this LAMMPS makes neighbour lists for the radii of the first fix that pours only, "
              "which is " +
              std::string(fix->id) + ": define it after this fix");
    }
  }
  if (clumps) find_rigid(fixes);
  if (!missing.empty())
    fatal("in 'wall', there is no fix '" + missing[0] + "': give the ID of a fix wall/lsdcd");
  radius_with_room.assign(settings.plan.grains.n_kinds(), 0);
  if (!settings.region.empty()) find_region();
  lsdcd::MpiHost mpi(world);
  lsdcd::run_collectively(mpi, true, [&] { walls->follow(found, mpi.is_first()); });
}

void FixInsertLsdcd::setup(int /*vflag*/)
{
  begin_schedule(update->ntimestep);
  begin_report();
}

void FixInsertLsdcd::reset_dt()
{
  begin_schedule(update->ntimestep);
}

// Called where the host does not tell the timestep (kHostTellsTimestep).
void FixInsertLsdcd::initial_integrate(int /*vflag*/)
{
  if (update->dt != schedule_dt) begin_schedule(update->ntimestep - 1);
}

void FixInsertLsdcd::initial_integrate_respa(int vflag, int /*ilevel*/, int /*iloop*/)
{
  FixInsertLsdcd::initial_integrate(vflag);
}

void FixInsertLsdcd::begin_schedule(bigint step)
{
  schedule_dt = update->dt;
  insertion->begin_run(step, schedule_dt);
  follow_schedule();
}

void FixInsertLsdcd::begin_report()
{
  refused_seen = insertion->refused();
  inserted_before = insertion->inserted();
  told = false;
}

void FixInsertLsdcd::follow_schedule()
{
  const std::int64_t next = insertion->next_step();
  next_reneighbor = next == lsdcd::FeedSchedule::kNever ? 0 : next;
}

double FixInsertLsdcd::largest_radius(int type) const
{
  if (clumps) return clumps->largest_radius(type);
  return type == settings.type ? insertion->source().largest_radius() : 0;
}

// Returns the radius of the sphere as which a grain with a shape touches others, of its volume; 0: grains touch each other by their shapes.
double FixInsertLsdcd::touch_radius(const lsdcd::Grain &grain) const
{
  if (!shape_atoms || !atom->radius_flag || ShapeAtoms::has_superellipsoids(*atom)) return 0;
  return grain.radius * std::cbrt(grain.bulk / lsdcd::kBallVolume);
}

// Numbers of a grain that is there: place and radius; of one that may have a shape also half-axes, exponents, turn and the radius of
// PackedShape::touch.
static constexpr std::size_t kSphereNumbers = 4, kShapeNumbers = 14;

static PackedSphere packed_from(const double *n, bool may_have_shape, lsdcd::ShapesMade &shapes)
{
  const PackedSphere sphere = {{n[0], n[1], n[2]}, n[3]};
  if (!may_have_shape || n[4] == 0) return sphere;
  const lsdcd::Superellipsoid shape = shapes.get({n[4], n[5], n[6]}, n[7], n[8]);
  const lsdcd::Quaternion turn = {n[9], {n[10], n[11], n[12]}};
  return {sphere.at, sphere.radius,
          std::make_shared<const lsdcd::PackedShape>(
              lsdcd::PackedShape{lsdcd::place_grain(shape, sphere.at, turn), n[13]})};
}

// On the first process: of all processes.
std::vector<double> FixInsertLsdcd::gather_grains(const lsdcd::Box &zone) const
{
  const lsdcd::PeriodicBox box = lsdcd::host_box(*domain);
  const double largest = insertion->source().largest_radius();
  lsdcd::HostSpheres with_shapes;
  if (shape_atoms) shape_atoms->put(with_shapes);
  const bool touch_as_spheres = atom->radius_flag && !ShapeAtoms::has_superellipsoids(*atom);
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *x = atom->x[i];
    const double radius = shape_atoms ? with_shapes.radius[i] : atom->radius[i];
    double touch = 0;
    if (shape_atoms && touch_as_spheres) touch = atom->radius[i];
    for (const PackedSphere &s :
         lsdcd::images_in({{x[0], x[1], x[2]}, std::max(radius, touch)}, zone, largest, box)) {
      mine.insert(mine.end(), {s.at.x, s.at.y, s.at.z, s.radius});
      if (!shape_atoms) continue;
      const lsdcd::GrainShape &row = with_shapes.shapes[i];
      mine.insert(mine.end(), {row.half.x, row.half.y, row.half.z, row.n1, row.n2, row.turn.w,
                               row.turn.v.x, row.turn.v.y, row.turn.v.z, touch});
    }
  }
  return lsdcd::MpiHost(world).gather(mine);
}

// The first process chooses, as it has the walls, and tells all.
std::vector<Insertion::Placed> FixInsertLsdcd::choose(lsdcd::Refused &refused)
{
  if (region) region->prematch();
  const lsdcd::Box around = zone();
  const std::vector<double> near = gather_grains(around);
  std::vector<double> message;
  lsdcd::MpiHost mpi(world);
  lsdcd::run_collectively(mpi, mpi.is_first(), [&] {
    std::vector<PackedSphere> there;
    lsdcd::ShapesMade shapes;
    const bool has_shapes = shape_atoms != nullptr;
    const std::size_t width = has_shapes ? kShapeNumbers : kSphereNumbers;
    for (std::size_t i = 0; i < near.size(); i += width)
      there.push_back(packed_from(&near[i], has_shapes, shapes));
    const lsdcd::GrainSource &source = insertion->source();
    const lsdcd::Packing packing(there, around, source.largest_radius(), lsdcd::host_box(*domain),
                                 source.largest_sphere());
    walls->place(update->dt);
    LammpsSite site(*this);
    for (const Insertion::Placed &p : insertion->place(update->ntimestep, site, packing, refused))
      message.insert(message.end(), {double(p.index), p.at.x, p.at.y, p.at.z, p.turn.w, p.turn.v.x,
                                     p.turn.v.y, p.turn.v.z});
    for (const std::int64_t count : {refused.no_place, refused.grains, refused.walls})
      message.push_back(static_cast<double>(count));
  });
  std::uint64_t n = message.size();
  mpi.broadcast(&n, sizeof n, 0);
  message.resize(n);
  mpi.broadcast(message.data(), n * sizeof(double), 0);
  std::vector<Insertion::Placed> placed;
  for (std::size_t i = 0; i + 8 < n; i += 8) {
    const double *of = &message[i];
    placed.push_back(
        {static_cast<std::size_t>(of[0]), {of[1], of[2], of[3]}, {of[4], {of[5], of[6], of[7]}}});
  }
  refused.no_place = static_cast<std::int64_t>(message[n - 3]);
  refused.grains = static_cast<std::int64_t>(message[n - 2]);
  refused.walls = static_cast<std::int64_t>(message[n - 1]);
  return placed;
}

bool FixInsertLsdcd::is_due() const
{
  return update->ntimestep == next_reneighbor;
}

void FixInsertLsdcd::pre_exchange()
{
  if (!is_due()) return;
  const std::int64_t step = update->ntimestep;
  walls->begin_step();
  lsdcd::Refused refused;
  do {
    insertion->draw_due(step);
    refused = {};
    std::vector<Insertion::Placed> placed;
    if (!insertion->owed().empty()) {
      placed = choose(refused);
      create(placed);
    }
    insertion->accept(step, placed, refused);
  } while (insertion->has_more(step));
  follow_schedule();
  if (insertion->owed().empty() || told) return;
  told = true;
  warn(late_text("in step " + std::to_string(step), refused) +
       "; the fix tries again until they have places, and reports at the end of the run how many "
       "have none");
}

// Does this process own the place, a copy of which it may change? One process says so.
bool FixInsertLsdcd::owns(double *x) const
{
  double lamda[3], *at = x;
  const double *lo = domain->boxlo, *hi = domain->boxhi, *sublo = domain->sublo,
               *subhi = domain->subhi;
  if (domain->triclinic) {
    domain->x2lamda(x, lamda);
    at = lamda;
    lo = domain->boxlo_lamda;
    hi = domain->boxhi_lamda;
    sublo = domain->sublo_lamda;
    subhi = domain->subhi_lamda;
  }
  for (int k = 0; k < 3; k++) {
    // Past a face that will follow, it is of the process at that face.
    const double inside = std::min(std::max(at[k], lo[k]), std::nextafter(hi[k], lo[k]));
    if (inside < sublo[k] || inside >= subhi[k]) return false;
  }
  return true;
}

void FixInsertLsdcd::check_temperature() const
{
#if HOST_HAS_HEAT
  const bool wanted = atom->temperature_flag;
#else
  const bool wanted = false;
#endif
  if (wanted && !settings.has_temperature)
    fatal("atoms have a temperature: give that of the grains by 'temperature T'");
  if (!wanted && settings.has_temperature)
    fatal("'temperature' is given, and atoms have none: it needs fix ID all property/atom "
          "temperature heatflow ghost yes, of LAMMPS 2 Aug 2023 or later");
}

void FixInsertLsdcd::warn_of_seed(const std::vector<Fix *> &fixes)
{
  for (const Fix *fix : fixes) {
    if (fix == this || seed_warned) return;
    const auto *other = dynamic_cast<const FixInsertLsdcd *>(fix);
    if (!other || other->settings.plan.seed != settings.plan.seed) continue;
    seed_warned = true;
    warn("fix " + std::string(other->id) + " has the same seed, " +
         std::to_string(settings.plan.seed) +
         ": grain by grain both draw the same random numbers for sizes, places and velocities; "
         "give each a seed of its own");
  }
}

// What fix property/atom has of a new atom, which would be what a ghost had there: LAMMPS does not set it.
void FixInsertLsdcd::set_properties(int m) const
{
  if (atom->molecule_flag) atom->molecule[m] = 0;
  if (atom->q_flag) atom->q[m] = 0;
  for (int k = 0; k < atom->nivector; k++)
    if (atom->ivector[k]) atom->ivector[k][m] = 0;
  for (int k = 0; k < atom->ndvector; k++)
    if (atom->dvector[k]) atom->dvector[k][m] = 0;
  for (int k = 0; k < atom->niarray; k++)
    if (atom->iarray[k]) std::fill_n(atom->iarray[k][m], atom->icols[k], 0);
  for (int k = 0; k < atom->ndarray; k++)
    if (atom->darray[k]) std::fill_n(atom->darray[k][m], atom->dcols[k], 0.0);
#if HOST_HAS_HEAT
  if (atom->temperature_flag) atom->temperature[m] = settings.temperature;
  if (atom->heatflow_flag) atom->heatflow[m] = 0;
#endif
}

// LAMMPS gives new atoms forces of each level of run_style respa that others had there. At this time of a step atom->f is free: each
// level begins with its own.
void FixInsertLsdcd::clear_levels(int n_new) const
{
  if (n_new == 0) return;
  auto *const respa = reinterpret_cast<Respa *>(update->integrate);
  const int first = 3 * (atom->nlocal - n_new), last = 3 * atom->nlocal;
  for (int level = 0; level < n_levels; level++) {
    respa->copy_flevel_f(level);
    std::fill(atom->f[0] + first, atom->f[0] + last, 0.0);
    if (atom->torque_flag) std::fill(atom->torque[0] + first, atom->torque[0] + last, 0.0);
    respa->copy_f_flevel(level);
  }
}

// Of this fix and the others like it, where n more are to come: those of grains that have gone are given again only where there are
// no others.
tagint FixInsertLsdcd::last_id(bigint n) const
{
  std::int64_t last = 0;
  for (const Fix *fix : lsdcd::host_fixes(*modify))
    if (const auto *inlet = dynamic_cast<const FixInsertLsdcd *>(fix))
      last = std::max(last, inlet->insertion->last_id());
  return last > MAXTAGINT - n ? 0 : static_cast<tagint>(last);
}

// As last_id(), of molecules.
tagint FixInsertLsdcd::last_molecule(bigint n) const
{
  std::int64_t last = 0;
  for (const Fix *fix : lsdcd::host_fixes(*modify))
    if (const auto *inlet = dynamic_cast<const FixInsertLsdcd *>(fix))
      last = std::max(last, inlet->insertion->last_molecule());
  tagint most = last > MAXTAGINT - n ? 0 : static_cast<tagint>(last);
  for (int i = 0; i < atom->nlocal; i++) most = std::max(most, atom->molecule[i]);
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (most > MAXTAGINT - n) fatal("molecule IDs end: too many clumps for this LAMMPS");
  return most;
}

std::size_t FixInsertLsdcd::n_atoms(const lsdcd::Grain &grain) const
{
  return clumps ? clumps->n_atoms(grain.kind) : 1;
}

// Returns the index of a new atom of this process at x, which is in the box.
int FixInsertLsdcd::new_atom(int type, double *x, imageint image, const Vec3 &v, tagint tag)
{
  atom->avec->create_atom(type, x);
  const int m = atom->nlocal - 1;
  for (int d = 0; d < 3; d++) atom->v[m][d] = v[d];
  atom->mask[m] = 1 | groupbit;
  atom->image[m] = image;
  if (atom->tag_enable) atom->tag[m] = tag;
  return m;
}

static constexpr imageint kNoImage =
    ((imageint) IMGMAX << IMG2BITS) | ((imageint) IMGMAX << IMGBITS) | IMGMAX;

// Returns how many atoms this process has made.
int FixInsertLsdcd::create_grain(const lsdcd::Grain &grain, const Insertion::Placed &place,
                                 tagint tag)
{
  double x[3] = {place.at.x, place.at.y, place.at.z};
  imageint image = kNoImage;
  domain->remap(x, image);
  if (!owns(x)) return 0;
  const Vec3 v = velocity + insertion->source().velocity_jitter(grain.number);
  const int m = new_atom(settings.type, x, image, v, tag);
  atom->rmass[m] = grain.mass();
  if (shape_atoms) {
    const lsdcd::Superellipsoid s = insertion->source().shape(grain);
    shape_atoms->make(m, {s.half, s.n1, s.n2, place.turn, inertia_over_mass(s)});
    const double touch = touch_radius(grain);
    if (atom->radius_flag) atom->radius[m] = touch > 0 ? touch : grain.radius;
  } else {
    atom->radius[m] = grain.radius;
  }
  set_properties(m);
  modify->create_attribute(m);
  return 1;
}

// Returns how many atoms of the clump this process has made. `before`: the ID before that of its first atom. The body begins in the
// box, and its atoms have images about it.
int FixInsertLsdcd::create_clump(const lsdcd::Grain &grain, const Insertion::Placed &place,
                                 tagint before, tagint molecule)
{
  double centre[3] = {place.at.x, place.at.y, place.at.z};
  imageint image = kNoImage;
  domain->remap(centre, image);
  const Vec3 at = {centre[0], centre[1], centre[2]};
  const Vec3 v = velocity + insertion->source().velocity_jitter(grain.number);
  const std::vector<lsdcd::Ball> balls = insertion->source().balls(grain, place.turn);
  const int first = atom->nlocal;
  for (std::size_t i = 0; i < balls.size(); i++) {
    const Vec3 of = at + balls[i].centre;
    double x[3] = {of.x, of.y, of.z};
    image = kNoImage;
    domain->remap(x, image);
    if (!owns(x)) continue;
    const int m =
        new_atom(clumps->type(grain.kind, i), x, image, v, before + 1 + static_cast<tagint>(i));
    clumps->fill(grain.kind, i, m, before);
    set_properties(m);
    atom->molecule[m] = molecule;
    modify->create_attribute(m);
  }
  clumps->tell(*rigid, grain.kind, first, before, at, v, place.turn);
  return atom->nlocal - first;
}

// IDs are given in the order in which grains are placed, so that they do not depend on the number of processes.
void FixInsertLsdcd::create(const std::vector<Insertion::Placed> &placed)
{
  if (placed.empty()) return;
  bigint n = 0;    // atoms
  for (const Insertion::Placed &place : placed)
    n += static_cast<bigint>(n_atoms(insertion->owed()[place.index]));
  tagint most = last_id(n);
  for (int i = 0; atom->tag_enable && i < atom->nlocal; i++) most = std::max(most, atom->tag[i]);
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_LMP_TAGINT, MPI_MAX, world);
  if (atom->tag_enable && most > MAXTAGINT - n)
    fatal("atom IDs end: too many grains for this LAMMPS");
  atom->nghost = 0;    // new atoms come where ghosts were
  const tagint molecule = clumps ? last_molecule(static_cast<bigint>(placed.size())) : 0;
  bigint made = 0;
  tagint last = most;
  for (std::size_t k = 0; k < placed.size(); k++) {
    const lsdcd::Grain &grain = insertion->owed()[placed[k].index];
    made += clumps ? create_clump(grain, placed[k], last, molecule + 1 + static_cast<tagint>(k))
                   : create_grain(grain, placed[k], last + 1);
    last += static_cast<tagint>(n_atoms(grain));
  }
  if (clumps) insertion->note_molecule(molecule + static_cast<tagint>(placed.size()));
  clear_levels(static_cast<int>(made));
  MPI_Allreduce(MPI_IN_PLACE, &made, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (made != n)
    fatal("of " + std::to_string(n) + " new atoms " + std::to_string(made) +
          " belong to a process: this is an error in the program");
  if (atom->tag_enable) insertion->note_id(most + n);
  atom->natoms += n;
  if (atom->natoms >= MAXBIGINT) fatal("too many atoms");
  if (atom->map_style == Atom::MAP_NONE) return;
  atom->map_init();
  atom->map_set();
}

std::string FixInsertLsdcd::late_text(const std::string &when, const lsdcd::Refused &refused) const
{
  std::string why;
  const auto add = [&](std::int64_t n, const std::string &what) {
    if (n > 0) why += (why.empty() ? "" : ", ") + std::to_string(n) + " " + what;
  };
  add(refused.grains, "met grains");
  add(refused.walls, "met a wall");
  add(refused.no_place, face ? "found no point of the face off its edges and in the box"
                             : "found no point of the region in the box");
  if (!why.empty()) why = "; of " + lsdcd::counted(refused.all(), "place") + " tried " + why;
  const lsdcd::GrainTotals late = insertion->late();
  return when + ", " + lsdcd::counted(late.number, "grain") + " of mass " + number_text(late.mass) +
         (late.number == 1 ? " is due and has" : " are due and have") + " found no place" + why;
}

std::string FixInsertLsdcd::grain_text(const lsdcd::Grain &grain) const
{
  if (clumps)
    return "the clump of molecule " + std::to_string(grain.kind + 1) + " in template " +
           settings.molecules;
  if (!shape_atoms) return "a grain of diameter " + number_text(2 * grain.radius);
  return "a grain of shape " + lsdcd::vector_text(2 * insertion->source().shape(grain).half);
}

std::string FixInsertLsdcd::no_room_text(const lsdcd::Grain &grain, int tries) const
{
  return "of " + std::to_string(tries) + " places " +
         (face ? "on " + settings.face.file : "in region " + settings.region) +
         " none is clear of the walls for " + grain_text(grain) +
         ", even without other grains, so it would hold back all that come after it: give "
         "smaller grains in '" +
         (clumps        ? "mol"
          : shape_atoms ? "shape"
                        : "diam") +
         "' or a larger " + (face ? "mesh" : "region") +
         ", move it away from the walls, or name by wall ID only the walls that grains must avoid";
}

// By what was in the way most often.
std::string FixInsertLsdcd::remedy(const lsdcd::Refused &refused) const
{
  const std::string place = face ? "mesh" : "region";
  if (refused.no_place > std::max(refused.grains, refused.walls))
    return "The " + place + " has hardly a point " + (face ? "off its edges and " : "") +
           "in the box: make it larger, or move it into the box";
  if (refused.walls > refused.grains)
    return "Walls are in the way: move the " + place +
           " away from them, or name by wall ID only the walls that grains must avoid";
  const std::string attempts =
      "more attempts than " + std::to_string(settings.plan.attempts) + " for each grain";
  if (settings.plan.feed.kind == lsdcd::FeedSettings::at_once)
    return "They do not fit in: give a larger " + place + ", fewer or smaller grains, or " +
           attempts;
  return "Grains are in the way, because they leave more slowly than the rate brings others: give "
         "a larger " +
         place + (face ? ", more depth" : "") +
         ", a higher velocity or a smaller rate. A little can also be gained by " + attempts;
}

std::string FixInsertLsdcd::inserted_text() const
{
  const std::int64_t n = insertion->inserted();
  return lsdcd::counted(n, "grain") + " of mass " + number_text(insertion->inserted_mass()) +
         (n == 1 ? " has" : " have") + " been inserted";
}

void FixInsertLsdcd::post_run()
{
  const std::int64_t came = insertion->inserted() - inserted_before;
  const lsdcd::Refused &all = insertion->refused();
  const lsdcd::Refused in_run = {all.no_place - refused_seen.no_place,
                                 all.grains - refused_seen.grains, all.walls - refused_seen.walls};
  begin_report();
  if (came != 0) log(inserted_text());
  if (insertion->owed().empty()) return;
  warn(late_text("at the end", in_run) + "; this run inserted " + lsdcd::counted(came, "grain") +
       ". " + remedy(in_run));
}

double FixInsertLsdcd::compute_vector(int i)
{
  const lsdcd::Refused &refused = insertion->refused();
  const lsdcd::GrainTotals late = insertion->late();
  const double values[] = {
      double(insertion->inserted()), insertion->inserted_mass(), double(late.number),     late.mass,
      double(refused.grains),        double(refused.walls),      double(refused.no_place)};
  return values[i];
}

int FixInsertLsdcd::modify_param(int narg, char **arg)
{
  const std::vector<std::string> words = words_of(arg, arg + narg);
  if (words[0] != "names") return 0;
  variables.make(words, lsdcd::named_elements(lsdcd::insertion_outputs(), false));
  return narg;
}

void FixInsertLsdcd::write_restart(FILE *file)
{
  if (comm->me == 0) run_core_here([&] { write_state(file, insertion->state(update->ntimestep)); });
}

void FixInsertLsdcd::restart(char *buffer)
{
  bool is_same = false;
  try {
    is_same = insertion->restore(reinterpret_cast<const double *>(buffer), kAllNumbers,
                                 update->ntimestep);
  } catch (const lsdcd::StateError &e) {
    fatal(unusable_state(e, "what was inserted"));
  }
  const std::string in = inserted_text();
  if (insertion->is_past_total())
    warn(in + ", which is more than the total of this fix: it inserts no more");
  else if (!is_same)
    log("amounts or grains differ from those before the restart, and count from here on; " + in);
  follow_schedule();
}

double FixInsertLsdcd::memory_usage()
{
  return static_cast<double>(walls->bytes() + insertion->owed().size() * sizeof(lsdcd::Grain));
}

FixInsertRadii::FixInsertRadii(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg)
{
  delete[] style;
  style = new char[5];
  std::strcpy(style, "pour");
}

void *FixInsertRadii::extract(const char *what, int &type)
{
  if (std::strcmp(what, "radius") != 0) return nullptr;
  radius = 0;
  for (Fix *fix : lsdcd::host_fixes(*modify))
    if (const auto *inlet = dynamic_cast<const FixInsertLsdcd *>(fix))
      radius = std::max(radius, inlet->largest_radius(type));
    else if (!dynamic_cast<const FixInsertRadii *>(fix) && std::strcmp(fix->style, "pour") == 0) {
      int of = type;
      const auto *poured = static_cast<const double *>(fix->extract("radius", of));
      if (poured) radius = std::max(radius, *poured);
    }
  type = 0;
  return &radius;
}
