// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/pair_granular_lsdcd.h"

#include "base/input_words.h"
#include "input/pair_words.h"
#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/fix_springs_lsdcd.h"
#include "lammps/host_atoms.h"
#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/host_pairs.h"
#include "lammps/mpi_host.h"
#include "lammps/other_fixes.h"
#include "law/coarse_grain.h"
#include "law/contact_time.h"
#include "law/force_parts.h"
#include "law/make_law.h"
#include "pair/compile_pair.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "update.h"
#include "utils.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <sstream>

using namespace LAMMPS_NS;

namespace {

constexpr int kSingleNumbers = 12;    // of LAMMPS's pair granular
constexpr int kOfGhost = 3;           // type, radius, mass

std::string types_text(int i, int j)
{
  return std::to_string(i) + " and " + std::to_string(j);
}

#if HOST_HAS_HEAT
// Returns whether LAMMPS sends the heat of ghost atoms to their owners.
bool heat_goes_back(Modify &modify)
{
  const std::vector<Fix *> fixes = lsdcd::host_fixes(modify);
  return std::any_of(fixes.begin(), fixes.end(), [](const Fix *fix) {
    return std::strcmp(fix->style, "heat/flow") == 0 && fix->comm_reverse > 0;
  });
}
#endif

}    // namespace

PairGranularLsdcd::PairGranularLsdcd(LAMMPS *lmp) :
    Pair(lmp), OwnMessages(lmp, "Pair", "style", "granular/lsdcd")
{
  single_enable = 1;
  restartinfo =
      0;    // LAMMPS would write the style's name without its suffix, and read it as its own
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  finitecutflag = 1;
  comm_forward = kOfGhost;
  single_extra = kSingleNumbers;
  svector = new double[kSingleNumbers];

  // A place before the fixes of the script that delete or add atoms. A restart file finds its springs by this ID, whatever pair styles a
  // script has had before.
  int k = 0;
  do {
    springs_id = "SPRINGS_LSDCD_" + std::to_string(k++);
    dummy_id = springs_id + "_DUMMY";
  } while (lsdcd::host_fix(*modify, springs_id) || lsdcd::host_fix(*modify, dummy_id));
  modify->add_fix(dummy_id + " all DUMMY");
}

// The commands unfix and 'plugin clear' may have deleted the fix.
PairGranularLsdcd::~PairGranularLsdcd()
{
  for (const std::string &id : {springs_id, dummy_id})
    if (lsdcd::host_fix(*modify, id)) modify->delete_fix(id);
  delete[] svector;
  if (!allocated) return;
  memory->destroy(setflag);
  memory->destroy(cutsq);
}

void PairGranularLsdcd::allocate()
{
  allocated = 1;
  n_types = atom->ntypes;
  const int n = n_types + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) setflag[i][j] = 0;
  law_of.assign(static_cast<std::size_t>(n) * n, 0);
}

// ---- what a script gives -----------------------------------------------------------------

void PairGranularLsdcd::settings(int narg, char **arg)
{
  const std::vector<std::string> words(arg, arg + narg);
  lsdcd::Tokens w(words);
  w.set_context("pair_style granular/lsdcd", "pair_style granular/lsdcd [CUTOFF] [coarse_grain L]");
  const auto is_coarse = [&] { return !w.done() && w.peek() == "coarse_grain"; };
  cutoff = w.done() || is_coarse() ? -1 : w.number("the cutoff", 0);
  coarse_grain = 1;
  if (is_coarse()) {
    w.take();
    coarse_grain = w.number("L", lsdcd::kAboveZero);
  }
  if (!w.done()) w.fail("'" + w.peek() + "' is not expected");
}

std::vector<std::string>
PairGranularLsdcd::words_of_materials(const std::vector<std::string> &words)
{
  lsdcd::MpiHost host(world);
  std::string text;
  lsdcd::MaterialsRead read;
  lsdcd::run_collectively(host, comm->me == 0, [&] {
    for (const std::string &word : lsdcd::read_pair_materials(words, update->unit_style, read))
      text += word + " ";
  });
  lsdcd::broadcast_text(host, text);
  log("\n" + read.report);
  material_files.insert(read.files.begin(), read.files.end());
  std::istringstream in(text);
  return {std::istream_iterator<std::string>(in), {}};
}

std::vector<lsdcd::RunFile> PairGranularLsdcd::files() const
{
  std::vector<lsdcd::RunFile> all;
  for (const std::string &file : material_files) all.push_back({"material", file});
  return all;
}

void PairGranularLsdcd::coeff(int narg, char **arg)
{
  if (narg < 3)
    throw lsdcd::InputError("pair_coeff needs two atom types and a law, such as 1 1 hertz/material "
                            "1e7 0.5 0.3 tangential mindlin NULL 1 0.5 damping tsuji");
  if (!allocated) allocate();
  int ilo, ihi, jlo, jhi;
  utils::bounds(FLERR, arg[0], 1, n_types, ilo, ihi, error);
  utils::bounds(FLERR, arg[1], 1, n_types, jlo, jhi, error);
  std::vector<std::string> words(arg + 2, arg + narg);
  const bool by_material = lsdcd::has_pair_materials(words);
  if (by_material) words = words_of_materials(words);
  lsdcd::PairCoeff coeff = lsdcd::read_pair_coeff(words);
  lsdcd::law_of(coeff, coarse_grain);    // throws where it is not known for larger grains
  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = std::max(jlo, i); j <= jhi; j++) {
      given[{i, j}] = coeff;
      of_material[{i, j}] = by_material;
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    throw lsdcd::InputError(std::string("pair_coeff ") + arg[0] + " " + arg[1] +
                            " is of no pair of types: write the lower type first");
}

// ---- before a run ------------------------------------------------------------------------

void PairGranularLsdcd::init_style()
{
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    fatal("atoms need a radius, omega and torque: use atom_style sphere");
  if (atom->ellipsoid_flag)
    fatal("all atoms are taken for spheres, and there are ellipsoids: use atom_style sphere");
  if (!atom->tag_enable) fatal("atoms need IDs: leave out 'atom_modify id no'");
  if (comm->ghost_velocity == 0)
    fatal("forces depend on the velocities of ghost atoms: write 'comm_modify vel yes'");
  find_fixes();
  find_radii();
  const std::vector<Compute *> computes = lsdcd::host_computes(*modify);
  books = std::any_of(computes.begin(), computes.end(), [](const Compute *compute) {
    return std::strcmp(compute->style, "lsdcd/energy") == 0;
  });
  find_impacts();

  const int n = n_types + 1;
  coeffs.clear();
  numbers.clear();
  laws.clear();
  flips_of.clear();
  without_law.clear();
  std::fill(law_of.begin(), law_of.end(), 0);
  const auto add = [&](const lsdcd::PairCoeff &coeff, int i, int j) {
    // Pairs of one law are computed together.
    for (std::size_t k = 0; k < coeffs.size(); k++)
      if (lsdcd::are_equal(coeffs[k], coeff)) return static_cast<int>(k);
    lsdcd::ContactLaw law = lsdcd::law_of(coeff, coarse_grain);
    try {
      lsdcd::check_dashpots(law, force->ftm2v);
    } catch (const lsdcd::LawError &e) {
      fatal("in the law of types " + types_text(i, j) + ", " + e.what());
    }
    // The stiffnesses of hertz/history are pressures.
    if (law.is_classic() && law.is(lsdcd::NormalModel::hertz)) {
      law.k_normal /= force->nktv2p;
      law.k_tangent /= force->nktv2p;
    }
    coeffs.push_back(coeff);
    numbers.push_back(law);
    flips_of.push_back(law.flips());
    law.keeps_forces = books;
    laws.push_back(lsdcd::pair_law(law));
    return static_cast<int>(laws.size()) - 1;
  };
  for (int i = 1; i < n; i++)
    for (int j = i; j < n; j++) {
      const auto own = given.find({i, j});
      int law;
      if (own != given.end()) {
        law = add(own->second, i, j);
      } else {
        const auto a = given.find({i, i}), b = given.find({j, j});
        std::string &why = without_law[{i, j}];
        if (a == given.end() || b == given.end()) continue;    // LAMMPS tells what is missing
        lsdcd::PairCoeff mixed;
        try {
          mixed = lsdcd::mixed(a->second, b->second, types_text(i, j));
        } catch (const lsdcd::InputError &e) {
          why = e.what();
          continue;
        }
        without_law.erase({i, j});
        law = add(mixed, i, j);
      }
      law_of[i * n + j] = law_of[j * n + i] = law;
    }
  has_heat = std::any_of(numbers.begin(), numbers.end(),
                         [](const lsdcd::ContactLaw &law) { return law.has_heat(); });
#if HOST_HAS_HEAT
  if (has_heat && (!atom->temperature_flag || !atom->heatflow_flag))
    fatal("the sub-model heat needs a temperature and a heat flow per atom: fix ID all "
          "property/atom temperature heatflow ghost yes, and fix heat/flow to change them");
  if (has_heat && force->newton_pair && !heat_goes_back(*modify))
    fatal("with newton on fix heat/flow sends the heat of ghost atoms to their owners, and there "
          "is none: write that fix, or 'newton off'");
#else
  if (has_heat)
    fatal("the sub-model heat needs a LAMMPS with fix heat/flow, of 2 Aug 2023 or later: that of "
          "Debian trixie or sid, or one built from source");
#endif
  beyond_contact = std::any_of(numbers.begin(), numbers.end(),
                               [](const lsdcd::ContactLaw &law) { return law.reach().acts(); });
  set_springs();
  constexpr int kTiled = 1;
  if (kept_width() > 0 && force->newton_pair && comm->style == kTiled)
    fatal("with newton on LAMMPS cannot send springs to their grains by comm_style tiled: write "
          "newton off");
  request_list();
  set_limits();
  if (!told) tell_laws();
  told = true;
  check_step();
}

const lsdcd::BookedEnergy &PairGranularLsdcd::booked() const
{
  return springs->energy;
}

void PairGranularLsdcd::add_booked(const lsdcd::EnergyRows &rows, bool is_setup, double dt)
{
  springs->energy.add_step(rows, is_setup, dt);
}

int PairGranularLsdcd::kept_width() const
{
  return springs ? springs->partners.width() : 0;
}

// How far beyond touch adhesion may hold grains, be they as large as any that are known.
double PairGranularLsdcd::longest_hold()
{
  double largest = std::max(cutoff, 0.0) / 2;
  for (const lsdcd::PairCoeff &coeff : coeffs) largest = std::max(largest, coeff.cutoff / 2);
  for (const Radii &r : radii) largest = std::max({largest, r.moving, r.frozen});
  return radii2cut(largest, largest) - 2 * largest;
}

// A list by radii reaches beyond touch by the skin. With half of it grains that adhesion holds are in the list, also those that part in
// the step in which it is made; the other half is for grains that grow, where they may. A pull that acts on what has not touched begins
// where no half of the skin is left for motion. A list by types has the same for all grains of a type, though the large ones alone reach
// so far.
void PairGranularLsdcd::request_list()
{
  const bool from_afar =
      std::any_of(numbers.begin(), numbers.end(), [](const lsdcd::ContactLaw &law) {
        return law.reach().acts() && !law.reach().needs_touch();
      });
  const bool may_grow = adapts || !changing.empty();
  lsdcd::request_half_list(*neighbor, this, instance_me,
                           longest_hold() == 0 ||
                               (!may_grow && !from_afar && longest_hold() <= neighbor->skin / 2));
}

// LAMMPS's order of fixes is that in which they were made: the springs take the place that was kept for them.
void PairGranularLsdcd::set_springs()
{
  int width = 0;
  bool any = false;
  std::string kinds;
  for (int i = 1; i <= n_types; i++)
    for (int j = i; j <= n_types; j++) {
      if (laws.empty()) continue;
      const lsdcd::ContactLaw &law = numbers[law_index(i, j)];
      kinds += std::to_string(law.history_kind()) + ";";
      if (!law.has_history()) continue;
      any = true;
      width = std::max(width, 3 + law.n_extra());
    }
  any = any || books || adapts || has_impacts();
  kept = {width, books ? lsdcd::n_kept_of_pairs(numbers) : 0};
  if (books)
    for (unsigned &flips : flips_of) flips |= kept.flips() << width;
  if (any && !springs)
    springs = dynamic_cast<FixSpringsLsdcd *>(
        modify->replace_fix(dummy_id, springs_id + " all " + springs_style()));
  else if (springs && lsdcd::host_fix(*modify, springs_id) != springs)
    fatal("fix " + springs_id + ", which keeps the springs of pairs, is gone: do not unfix it");
  if (!springs) return;
  check_order();
  springs->watches_radii = adapts;
  springs->record_impacts(impacts_asked.least_speed);
  springs->set_laws(width, kept.n, kinds,
                    {[this](int i, int j) { return flips_of[law_index(i, j)]; },
                     [this](int i, int j) { return numbers[law_index(i, j)].history_kind(); }});
  double largest = 0;
  for (const Radii &r : radii) largest = std::max({largest, r.moving, r.frozen});
  const bool may_grow = adapts || !changing.empty();
  springs->largest_pair = radii2cut(largest, largest) + (may_grow ? neighbor->skin : 0);
}

// Before lists are made anew the springs go from pairs to atoms, whose indices must be those of the last step.
void PairGranularLsdcd::check_order() const
{
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    if (fix == springs) return;
    if (!(fix->setmask() & FixConst::PRE_EXCHANGE)) continue;
    const auto *flow = dynamic_cast<const FixMassflowLsdcd *>(fix);
    if (flow && !flow->deletes()) continue;
    for (const char *style : {"evaporate", "deposit", "pour", "insert/lsdcd", "massflow/lsdcd"})
      if (std::strncmp(fix->style, style, std::strlen(style)) == 0)
        fatal("fix " + std::string(fix->id) + " " + style +
              " creates or deletes atoms before springs are with theirs, and they would go to "
              "others: write pair_style before that fix");
  }
}

// A grain of fix freeze does not move; damping of an atom in a rigid body reads the mass of the body.
void PairGranularLsdcd::find_fixes()
{
  frozen = 0;
  rigid = nullptr;
  adapts = false;
  changing = steps_between_changes(*modify);
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    if (std::strncmp(fix->style, "adapt", 5) == 0) adapts = true;
    if (std::strncmp(fix->style, "freeze", 6) == 0) {
      if (frozen) fatal("there are two fixes freeze: only one is allowed");
      frozen = fix->groupbit;
    }
    if (fix->rigid_flag) {
      if (rigid) fatal("there are two rigid fixes: only one is allowed, for all bodies");
      rigid = fix;
    }
  }
  if (!rigid) std::vector<double>().swap(masses);
}

// Where types may change in a run, an atom of any type may be as large as any other.
void PairGranularLsdcd::find_radii()
{
  std::vector<double> largest(2 * (static_cast<std::size_t>(n_types) + 1), 0);
  std::vector<double> least(largest.size(), INFINITY);    // radius and mass
  for (Fix *fix : lsdcd::host_fixes(*modify)) {
    if (std::strncmp(fix->style, "pour", 4) != 0 && std::strncmp(fix->style, "deposit", 7) != 0)
      continue;
    for (int i = 1; i <= n_types; i++) {
      int type = i;
      const auto *radius = static_cast<const double *>(fix->extract("radius", type));
      if (radius) largest[2 * i] = std::max(largest[2 * i], *radius);
    }
  }
  for (int i = 0; i < atom->nlocal; i++) {
    double &most = largest[2 * atom->type[i] + (atom->mask[i] & frozen ? 1 : 0)];
    most = std::max(most, atom->radius[i]);
    double *const small = &least[2 * atom->type[i]];
    small[0] = std::min(small[0], atom->radius[i]);
    small[1] = std::min(small[1], atom->rmass[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, least.data(), static_cast<int>(least.size()), MPI_DOUBLE, MPI_MIN,
                world);
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX,
                world);
  radii.resize(static_cast<std::size_t>(n_types) + 1);
  for (int i = 0; i <= n_types; i++) {
    radii[i] = {largest[2 * i], largest[2 * i + 1], least[2 * i], least[2 * i + 1]};
    if (!std::isfinite(radii[i].least)) radii[i].least = radii[i].least_mass = 0;
  }
  if (changing.empty()) return;
  const Radii all = largest_radii();
  for (Radii &r : radii) {
    r.moving = all.moving;
    r.frozen = all.frozen;
  }
}

PairGranularLsdcd::Radii PairGranularLsdcd::largest_radii() const
{
  Radii all;
  for (const Radii &r : radii) {
    all.moving = std::max(all.moving, r.moving);
    all.frozen = std::max(all.frozen, r.frozen);
  }
  return all;
}

// LAMMPS takes types for lists that do not ask for radii, and for the cells of neighbor multi.
bool PairGranularLsdcd::lists_are_by_types() const
{
  return beyond_contact || (neighbor->style != Neighbor::NSQ && neighbor->style != Neighbor::BIN);
}

// Lists by radii hold all pairs up to the largest cutoff of two types.
void PairGranularLsdcd::set_limits()
{
  Radii all = largest_radii();
  limits.clear();
  if (lists_are_by_types()) {
    for (const Radii &r : radii) {
      const Radii &most = std::max(r.moving, r.frozen) > 0 ? r : all;    // else see init_one()
      limits.insert(limits.end(), {most.moving, most.frozen});
    }
    return;
  }
  double most = std::max({cutoff, 2 * all.moving, all.moving + all.frozen});
  for (const lsdcd::PairCoeff &coeff : coeffs) most = std::max(most, coeff.cutoff);
  all.frozen = std::max(all.frozen, most / 2);
  all.moving = std::max(all.moving, most - all.frozen);
  for (std::size_t i = 0; i < radii.size(); i++)
    limits.insert(limits.end(), {all.moving, all.frozen});
}

// Up to which distance two grains may act on each other; 0 where there is one of them only.
double PairGranularLsdcd::reach(int i, int j, double radius, double other) const
{
  if (!(radius > 0) || !(other > 0)) return 0;
  const double reduced = radius * other / (radius + other);
  return radius + other +
         numbers[law_index(i, j)].reach().most(reduced, lsdcd::size_of_both(radius, other));
}

double PairGranularLsdcd::init_one(int i, int j)
{
  const auto none = without_law.find({i, j});
  if (none != without_law.end() && !none->second.empty()) throw lsdcd::InputError(none->second);
  const double own = coeffs[law_index(i, j)].cutoff;
  const Radii a = radii[i], b = radii[j];
  // Grains that touch further apart than a given cutoff would do so in one process, and not across a border.
  const double most =
      std::max({reach(i, j, a.moving, b.moving), reach(i, j, a.frozen, b.moving),
                reach(i, j, a.moving, b.frozen), own > 0 ? own : std::max(cutoff, 0.0)});
  if (most > 0) return most;
  // Grains of a type that are not there yet: LAMMPS takes the size of bins from the least cutoff.
  double largest = 0;
  for (const Radii &r : radii) largest = std::max({largest, 2 * r.moving, 2 * r.frozen});
  return largest;
}

double PairGranularLsdcd::atom2cut(int i)
{
  return radii2cut(atom->radius[i], atom->radius[i]);
}

double PairGranularLsdcd::radii2cut(double radius, double other)
{
  lsdcd::LawReach reach;
  for (const lsdcd::ContactLaw &law : numbers) reach = longest(reach, law.reach());
  const double sum = radius + other;
  return sum > 0 ? sum + reach.most(radius * other / sum, lsdcd::size_of_both(radius, other)) : 0;
}

// Lists are made for radii up to limits, and for those that atoms had. Half of the skin is for motion.
void PairGranularLsdcd::check_radii()
{
  const int n = atom->nlocal;
  if (neighbor->ago == 0 && !adapts) listed_radius.assign(atom->radius, atom->radius + n);
  const std::vector<double> &listed = adapts ? springs->listed_radius : listed_radius;
  const double spare = neighbor->skin / 4;
  for (int i = 0; i < n; i++) {
    const double most = limits[2 * atom->type[i] + (atom->mask[i] & frozen ? 1 : 0)];
    const bool is_listed = atom->radius[i] <= spare + listed[i];
    if (is_listed && atom->radius[i] <= spare + most) continue;
    const bool by_types = lists_are_by_types();
    const std::string of_type = by_types ? " of type " + std::to_string(atom->type[i]) : "";
    fatal_here("the radius of atom " + std::to_string(atom->tag[i]) + " is " +
               lsdcd::number_text(atom->radius[i]) + ", for which contacts would be missed: " +
               (is_listed
                    ? "the lists of this run are for grains" + of_type + " of up to " +
                          lsdcd::number_text(most) +
                          "; end the run before the largest radius has grown by a quarter of the "
                          "skin, as by 'run N every M NULL', or make the skin larger (neighbor)" +
                          (by_types ? ""
                                    : ", or give pair_style a cutoff of twice the largest "
                                      "radius that is to come")
                    : "since neighbor lists were made it was " + lsdcd::number_text(listed[i]) +
                          ", and may grow by a quarter of the skin: write 'neigh_modify check "
                          "no' with a smaller 'every', and set radii before the run"));
  }
}

void PairGranularLsdcd::tell_laws()
{
  std::string text;
  bool same = n_types > 1;
  const auto words = [this](int i, int j) { return lsdcd::text_of(coeffs[law_index(i, j)]); };
  for (int i = 1; i <= n_types && !laws.empty(); i++)
    for (int j = i; j <= n_types; j++) {
      if (without_law.count({i, j})) {
        same = false;
        continue;
      }
      same = same && words(i, j) == words(1, 1);
      text += "\n  types " + std::to_string(i) + " " + std::to_string(j) + ": " + words(i, j) +
              (given.count({i, j}) ? "" : " (mixed)");
      if (!given.count({i, j}) && of_material[{i, i}] && of_material[{j, j}])
        text += ", geometric means: what a file says of both materials comes by pair_coeff " +
                std::to_string(i) + " " + std::to_string(j) + " law material FILE A on B";
    }
  if (same) text = "\n  all types: " + words(1, 1);
  if (coarse_grain != 1) {
    std::vector<lsdcd::CoarseGrained> becomes;
    for (int i = 1; i <= n_types && !laws.empty(); i++)
      for (int j = i; j <= n_types; j++)
        if (!without_law.count({i, j}))
          becomes.push_back(
              {"types " + std::to_string(i) + " " + std::to_string(j),
               lsdcd::coarse_grain_text(coeffs[law_index(i, j)].sub_models, coarse_grain)});
    text += "\n  " + lsdcd::coarse_grain_line(coarse_grain, becomes);
  }
  const int width = kept_width();
  log("laws of pairs, " +
      (width ? std::to_string(lsdcd::PairHistory::bytes_per_pair(width)) + " bytes a touching pair"
             : std::string("which keep nothing")) +
      text);
}

// The contact of the smallest grains is the shortest.
void PairGranularLsdcd::check_step()
{
  double shortest = INFINITY;
  bool at_overlap = false;
  std::string of;
  for (int i = 1; i <= n_types; i++)
    for (int j = i; j <= n_types; j++) {
      const Radii a = radii[i], b = radii[j];
      if (!(a.least > 0 && b.least > 0 && a.least_mass > 0 && b.least_mass > 0) || laws.empty() ||
          without_law.count({i, j}))
        continue;
      const lsdcd::ContactLaw &law = numbers[law_index(i, j)];
      const auto reduced = [](double of_a, double of_b) { return of_a * of_b / (of_a + of_b); };
      const double time = lsdcd::contact_time(
          law, reduced(a.least_mass, b.least_mass), reduced(a.least, b.least), force->ftm2v,
          0.4 * reduced(a.least_mass * a.least * a.least, b.least_mass * b.least * b.least));
      if (!(time < shortest)) continue;
      shortest = time;
      at_overlap = lsdcd::stiffens(law);
      of = types_text(i, j);
    }
  if (!std::isfinite(shortest)) return;
  const double longest = shortest / lsdcd::kStepsPerContact;
  const std::string how = at_overlap ? " (at an overlap of 1 % of the reduced radius)" : "";
  if (warned_of == 0)
    log("the shortest contact, of types " + of + ", lasts " + lsdcd::number_text(shortest) + how +
        ": the timestep should be at most " + lsdcd::number_text(longest));
  if (update->dt > longest && update->dt > warned_of)
    warn("timestep " + lsdcd::number_text(update->dt) +
         " is more than a tenth of the shortest contact time " + lsdcd::number_text(shortest) +
         how + ": contacts will not be resolved");
  warned_of = std::max(warned_of, update->dt);
}

// ---- a step ------------------------------------------------------------------------------

// Returns whether types, radii or masses may have changed since the last step, with the same lists: by a fix, or by a command before a
// run without a setup.
bool PairGranularLsdcd::atoms_changed() const
{
  if (update->setupflag || neighbor->ago == 0) return false;
  const bigint now = update->ntimestep;
  return now == update->firststep + 1 || atoms_may_have_changed(changing, now);
}

bool PairGranularLsdcd::radii_are_due() const
{
  return neighbor->ago == 0 || adapts || atoms_changed();
}

// LAMMPS gives ghost atoms types, radii and masses with new lists, and fix adapt changes them there, too. Masses of bodies are ours.
bool PairGranularLsdcd::ghosts_are_due() const
{
  return atoms_changed() || (rigid && radii_are_due());
}

// Else the two processes of a pair would take different laws and overlaps.
void PairGranularLsdcd::share_atoms()
{
  if (!ghosts_are_due()) return;
  if (rigid) {
    int dim;
    const int *const body = static_cast<const int *>(rigid->extract("body", dim));
    const double *const mass = static_cast<const double *>(rigid->extract("masstotal", dim));
    masses.assign(atom->rmass, atom->rmass + atom->nlocal);
    masses.resize(static_cast<std::size_t>(atom->nlocal) + atom->nghost);
    for (int i = 0; body && mass && i < atom->nlocal; i++)
      if (body[i] >= 0 && mass[body[i]] > 0) masses[i] = mass[body[i]];
  }
#if LSDCD_HOST_VERSION < 20220601
  comm->forward_comm_pair(this);
#else
  comm->forward_comm(this);
#endif
}

int PairGranularLsdcd::pack_forward_comm(int n, int *atoms, double *buf, int, int *)
{
  const double *const mass = rigid ? masses.data() : atom->rmass;
  for (int k = 0; k < n; k++) {
    const int i = atoms[k];
    *buf++ = atom->type[i];
    *buf++ = atom->radius[i];
    *buf++ = mass[i];
  }
  return n * kOfGhost;
}

void PairGranularLsdcd::unpack_forward_comm(int n, int first, double *buf)
{
  double *const mass = rigid ? masses.data() : atom->rmass;
  for (int i = first; i < first + n; i++) {
    atom->type[i] = static_cast<int>(*buf++);
    atom->radius[i] = *buf++;
    mass[i] = *buf++;
  }
}

double PairGranularLsdcd::time_step() const
{
  if (!springs || std::strncmp(update->integrate_style, "respa", 5) != 0) return update->dt;
  return lsdcd::step_of_level(*update, springs->level);
}

// A setup computes what is there, and a minimization moves grains by other ways than their velocities.
bool PairGranularLsdcd::time_passes() const
{
  constexpr int kMinimization = 2;
  return update->setupflag == 0 && update->whichflag != kMinimization;
}

lsdcd::PairJob PairGranularLsdcd::job()
{
  lsdcd::PairJob job = {};
  job.n_own = atom->nlocal;
  if (atom->nlocal > 0) {
    job.x = atom->x[0];
    job.v = atom->v[0];
    job.omega = atom->omega[0];
    job.force = atom->f[0];
    job.torque = atom->torque[0];
  }
  job.radius = atom->radius;
  job.mass = rigid ? masses.data() : atom->rmass;
  job.type = atom->type;
  if (frozen) job.mask = atom->mask;
  job.frozen = frozen;
#if HOST_HAS_HEAT
  if (has_heat) {
    job.temperature = atom->temperature;
    job.heat = atom->heatflow;
  }
#endif
  job.both_sides = force->newton_pair != 0;
  job.list = {list->inum, list->ilist, list->numneigh, list->firstneigh, NEIGHMASK, SBBITS};
  job.factor = force->special_lj;
  job.laws = laws.data();
  job.n_laws = static_cast<int>(laws.size());
  job.law_of = law_of.data();
  job.n_types = n_types + 1;
  job.dt = time_step();
  job.update = time_passes();
  return job;
}

void PairGranularLsdcd::compute(int eflag, int vflag)
{
  ev_init(eflag, vflag);
  if (radii_are_due()) check_radii();
  share_atoms();
  lsdcd::PairJob step = job();
  if (kept_width() > 0) {
    springs->begin_step(step.list, atoms_changed());
    step.old = &springs->old();
    step.history = &springs->next();
  }
  record.clear();
  if (evflag) step.record = &record;
  lsdcd::EnergyRows rows;
  if (books) {
    step.energy = &rows;
    step.kept = kept;
  }
  lsdcd::run_pairs(step);
  if (books) add_booked(rows, !step.update, step.dt);
  if (has_impacts()) record_impacts(step);
  for (const lsdcd::RecordedPair &p : record)
    ev_tally_xyz(p.i, p.j, atom->nlocal, force->newton_pair, p.energy, 0, p.force.x, p.force.y,
                 p.force.z, p.offset.x, p.offset.y, p.offset.z);
}

// They may be in the row of either.
std::vector<double> PairGranularLsdcd::kept_numbers(int i, int j)
{
  if (kept_width() == 0) return {};
  for (const auto &[row_of, other] : {std::make_pair(i, j), std::make_pair(j, i)}) {
    int *const end = list->ilist + list->inum;
    int *const at = row_of < list->inum && list->ilist[row_of] == row_of
                        ? list->ilist + row_of
                        : std::find(list->ilist, end, row_of);
    if (at == end) continue;
    std::vector<double> kept;
    for (int place = 0; place < list->numneigh[row_of] && kept.empty(); place++)
      if ((list->firstneigh[row_of][place] & NEIGHMASK) == other)
        kept = springs->numbers_of(static_cast<int>(at - list->ilist), place);
    const unsigned flips = row_of == i ? 0 : flips_of[law_index(atom->type[i], atom->type[j])];
    for (std::size_t k = 0; k < kept.size(); k++)
      if (flips >> k & 1) kept[k] = -kept[k];
    if (!kept.empty()) return kept;
  }
  return {};
}

double PairGranularLsdcd::single(int i, int j, int itype, int jtype, double /*rsq*/,
                                 double /*factor_coul*/, double factor_lj, double &fforce)
{
  fforce = 0;
  std::fill_n(svector, kSingleNumbers, 0.0);
  if (factor_lj == 0) return 0;
  if (rigid && masses.size() < static_cast<std::size_t>(std::max(i, j)) + 1)
    fatal_here("single() is asked for atoms that no step has seen");
  const lsdcd::PairJob now = job();
  if (are_frozen(now, i, j)) return 0;
  const lsdcd::PairLaw &law = laws[law_index(itype, jtype)];

  const int width = kept_width();
  const std::vector<double> kept = kept_numbers(i, j);
  std::vector<double> unused(std::max(3, width));
  const lsdcd::GrainPair pair = lsdcd::grain_pair(now, i, j, false);
  lsdcd::PairForce f;
  if (!law.evaluate(law.law, pair, !kept.empty(), kept.empty() ? nullptr : kept.data(),
                    unused.data(), f))
    return 0;
  const double distance = std::sqrt(pair.distance_sq);
  fforce = f.push / distance;
  const double reduced = pair.radius_i * pair.radius_j / (pair.radius_i + pair.radius_j);
  const lsdcd::Vec3 rolling = (1 / reduced) * cross(f.contact_torque, f.normal);
  const auto put = [this](int at, const lsdcd::Vec3 &a) {
    for (int k = 0; k < 3; k++) svector[at + k] = a[k];
  };
  put(0, f.friction);
  svector[3] = norm(f.friction);
  put(4, rolling);
  svector[7] = norm(rolling);
  svector[8] = dot(f.contact_torque, f.normal);
  put(9, pair.offset);
  return factor_lj * f.energy;
}

double PairGranularLsdcd::memory_usage()
{
  return Pair::memory_usage() +
         static_cast<double>((masses.capacity() + listed_radius.capacity()) * sizeof(double) +
                             record.capacity() * sizeof record[0]);
}
