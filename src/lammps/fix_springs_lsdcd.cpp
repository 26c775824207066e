// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/fix_springs_lsdcd.h"

#include "base/input_error.h"
#include "lammps/host_box.h"
#include "lammps/mpi_host.h"
#include "lammps/restart_data.h"
#include "law/force_parts.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "force.h"
#include "memory.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_map>
#include <utility>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

constexpr int kRoom = 64;    // numbers of an atom in a message, at first
const char *const kSpringsOfPairs = "springs of pairs";
const char *const kWithoutSprings = "give the pair style without the restart file's springs";

// Are there several among these texts, which end with ';'?
bool differ(const std::string &texts)
{
  const std::string first = texts.substr(0, texts.find(';') + 1);
  for (std::size_t at = 0; at < texts.size(); at += first.size())
    if (texts.compare(at, first.size(), first) != 0) return true;
  return false;
}

// What partners are told of atoms. `type`: of the pairs' laws.
struct AtomsOfPairs {
  const Atom &atom;
  const int *type;
  const std::function<unsigned(int, int)> &flips_of;
  const std::function<int(int, int)> &kind_of;

  lsdcd::Partners::Name name(int i) const { return atom.tag[i]; }
  unsigned flips(int i, int j) const { return flips_of(type[i], type[j]); }
  int kind(int i, int j) const { return kind_of(type[i], type[j]); }
  lsdcd::Vec3 offset(int i, int j) const
  {
    const double *const a = atom.x[i], *const b = atom.x[j];
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
  }
};

// To the process that answers for an ID: an atom's IDs before and now, or the question of partner `at` of process `asks` for the
// latter.
struct NewName {
  tagint before, now;
  int asks, at;
};

// Answers the questions among n messages; see Comm::rendezvous().
int answer(int n, char *messages, int &flag, int *&to, char *&answers, void *lmp)
{
  const auto *const all = reinterpret_cast<const NewName *>(messages);
  std::unordered_map<tagint, tagint> now;
  int asked = 0;
  for (int k = 0; k < n; k++) {
    if (all[k].asks < 0)
      now[all[k].before] = all[k].now;
    else
      asked++;
  }
  Memory *const memory = static_cast<LAMMPS *>(lmp)->memory;
  memory->create(to, asked, "lsdcd:answers");
  auto *next = static_cast<NewName *>(
      memory->smalloc(static_cast<bigint>(asked) * sizeof(NewName), "lsdcd:answers"));
  answers = reinterpret_cast<char *>(next);
  int *process = to;
  for (int k = 0; k < n; k++) {
    if (all[k].asks < 0) continue;
    const auto found = now.find(all[k].before);
    *process++ = all[k].asks;
    *next = all[k];
    next++->now = found == now.end() ? 0 : found->second;
  }
  flag = 2;    // answers are in memory of their own
  return asked;
}

// Adds the impacts whose halves have come together; see Comm::rendezvous().
int add_halves(int n, char *messages, int &flag, int *&, char *&, void *spectra)
{
  const auto *const all = reinterpret_cast<const lsdcd::HalfImpact *>(messages);
  std::vector<lsdcd::HalfImpact> halves(all, all + n);
  static_cast<lsdcd::PairSpectra *>(spectra)->add(halves);
  flag = 0;    // there are no answers
  return 0;
}

}    // namespace

FixSpringsLsdcd::FixSpringsLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), OwnMessages(lmp, "Fix", id, "SPRINGS/LSDCD")
{
  create_attribute = 1;
  maxexchange_dynamic = 1;
  restart_global = restart_peratom = 1;
  comm_reverse = 1;
  maxexchange = kRoom;
  FixSpringsLsdcd::grow_arrays(atom->nmax);
  known_as.assign(atom->tag, atom->tag + atom->nlocal);
  known_as.resize(atom->nmax);
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
}

FixSpringsLsdcd::~FixSpringsLsdcd()
{
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixSpringsLsdcd::setmask()
{
  return PRE_EXCHANGE | MIN_PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR | POST_RUN |
         PRE_FORCE_RESPA;
}

// ---- for the pair style ------------------------------------------------------------------

void FixSpringsLsdcd::set_laws(int width, int for_energy, const std::string &of_laws,
                               const LawsOfTypes &of_types)
{
  laws = of_types;
  const bool same = width == law_width && of_laws == kinds;
  if (from_file && !same)
    throw lsdcd::InputError(
        "the restart file has springs of other contact laws than pair_coeff gives: give those of "
        "the run that wrote it, or begin without springs by a data file (write_data)");
  from_file = false;
  const bool booked = for_energy > 0;
  const int without = width + for_energy;
  const bool touch = has_impacts && without == 0;
  const int all = without + (touch ? 1 : 0);
  if (!same) {
    if (largest_packed_size() > 1)
      warn("the contact laws have changed, and what pairs had kept is gone: contacts begin anew");
    by_law = differ(of_laws);
    partners = lsdcd::Partners({all, by_law});
    partners.grow(atom->nmax);
  } else if (all != partners.width() || by_law != differ(of_laws)) {
    by_law = differ(of_laws);    // files of older versions do not say of which law springs are
    of_atoms().set_form(
        {all, by_law,
         of_atoms().form().by_image});    // a setup gives pairs the forces that they keep
  }
  if (!same || booked != books || touch != keeps_touch) {
    in_pairs = false;
    new_list = true;
  }
  if (!booked) energy = {};
  books = booked;
  keeps_touch = touch;
  law_width = width;
  kinds = of_laws;
}

void FixSpringsLsdcd::record_impacts(double least_speed)
{
  has_impacts = least_speed > 0;
  if (!has_impacts) impacts = {};
  if (impacts.set(least_speed, force->ftm2v))
    warn("impacts between grains were recorded from another speed on: they are counted anew");
}

// A pair of grains of two processes is known to both of them, or with newton on to one, which tells the other one. What each of the two has
// taken from the speed of the impact comes together on the process that answers for the grain with the lower ID.
void FixSpringsLsdcd::add_impacts(const lsdcd::PairJob &step)
{
  if (keeps_touch)
    std::fill_n(next().column(0), next().size(), 0.0);    // laws without springs write nothing
  if (!step.update) return;
  const lsdcd::StepImpacts found(step, [this](int i) { return atom->tag[i]; });
  const auto anywhere = [this](bool here) {
    int any = here;
    MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
    return any != 0;
  };
  std::size_t n_here = 0;
  std::vector<lsdcd::HalfImpact> halves;
  if (!force->newton_pair) {
    halves = found.halves(nullptr, n_here);
  } else if (anywhere(found.any())) {
    lsdcd::KeptRows contacts = found.contacts_of_copies(atom->nlocal + atom->nghost);
    contacts_told = &contacts;
    tell_owners();
    contacts_told = nullptr;
    halves = found.halves(&contacts, n_here);
  }
  if (comm->nprocs == 1) n_here = halves.size();
  std::vector<lsdcd::HalfImpact> apart(halves.begin() + static_cast<std::ptrdiff_t>(n_here),
                                       halves.end());
  halves.resize(n_here);
  impacts.add(halves);
  if (comm->nprocs == 1 || !anywhere(!apart.empty())) return;
  std::vector<int> to;
  for (const lsdcd::HalfImpact &half : apart)
    to.push_back(static_cast<int>(half.names().first % comm->nprocs));
  char *none = nullptr;
  comm->rendezvous(1, static_cast<int>(apart.size()), reinterpret_cast<char *>(apart.data()),
                   sizeof(lsdcd::HalfImpact), 0, to.data(), add_halves, 0, none,
                   sizeof(lsdcd::HalfImpact), &impacts);
}

void FixSpringsLsdcd::begin_step(const lsdcd::PairList &of_step, bool types_changed)
{
  list = of_step;
  own = atom->nlocal;
  if (by_law && !new_list && types_changed) cleared |= note_types();
  now = 1 - now;
  if (new_list) {
    const AtomsOfPairs atoms = {*atom, atom->type, laws.flips, laws.kind};
    cleared |= partners.hand_out(list, history[1 - now], near_images(), law_width, atoms);
    if (by_law) listed_type.assign(atom->type, atom->type + atom->nlocal + atom->nghost);
    row_start.clear();
  }
  new_list = false;
  in_pairs = true;
  history[now].begin(partners.width());
  if (update->setupflag) tell_cleared();
}

bool FixSpringsLsdcd::note_types()
{
  const int *const type = atom->type, *const was = listed_type.data();
  if (std::equal(listed_type.begin(), listed_type.end(), type)) return false;
  bool any = false;
  lsdcd::for_pairs(list, history[now], [&](int i, int j, std::size_t pair) {
    if (laws.kind(was[i], was[j]) != laws.kind(type[i], type[j]))
      any |= lsdcd::clear_pair(history[now], pair, law_width);
  });
  listed_type.assign(type, type + listed_type.size());
  return any;
}

void FixSpringsLsdcd::tell_cleared()
{
  if (!by_law) return;
  int any = cleared;
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  if (any)
    warn(
        "types of atoms have changed, and contacts whose law keeps other numbers than before begin "
        "anew, without springs");
  cleared = false;
}

double FixSpringsLsdcd::near_images() const
{
  const lsdcd::PeriodicBox box = lsdcd::host_box(*domain);
  // Of two images in a list one may touch. Lists that do not ask for radii, as those of adhesion may, reach as far as a pair style says.
  const double reach =
      largest_pair + std::max(largest_pair + neighbor->skin, neighbor->cutneighmax);
  double least = reach;
  for (int k = 0; k < 3; k++)
    if (box.periodic[k]) least = std::min(least, box.width(k));
  return least < reach ? least / 2 : 0;
}

std::vector<double> FixSpringsLsdcd::numbers_of(int row, int place)
{
  const lsdcd::PairHistory &last = history[now];
  for (auto k = static_cast<int>(row_start.size()); k <= row; k++)
    row_start.push_back(k == 0 ? 0 : row_start[k - 1] + list.length[list.grain[k - 1]]);
  const std::size_t pair = last.find(row_start[row] + static_cast<std::size_t>(place));
  std::vector<double> numbers;
  for (int k = 0; pair < last.size() && k < last.width(); k++)
    numbers.push_back(last.column(k)[pair]);
  return numbers;
}

// ---- from pairs to atoms -----------------------------------------------------------------

void FixSpringsLsdcd::collect()
{
  const bool newton = force->newton_pair;
  const AtomsOfPairs atoms = {*atom, by_law ? listed_type.data() : atom->type, laws.flips,
                              laws.kind};
  partners.collect(list, history[now], newton ? own + atom->nghost : own,
                   {partners.width(), by_law, near_images() > 0}, atoms);
  if (newton) tell_owners();
}

// With newton on a pair is computed by one process alone, which tells the owner of the other atom.
void FixSpringsLsdcd::tell_owners()
{
#if LSDCD_HOST_VERSION < 20220601
  comm->reverse_comm_fix_variable(this);
#else
  comm->reverse_comm_variable(this);
#endif
}

// An atom that arrives may leave again in the next direction: room for the largest of all processes. It is doubled, as LAMMPS with
// Kokkos makes its whole buffer half as large again each time that there is more of it.
void FixSpringsLsdcd::bring_to_atoms()
{
  if (!keeps()) return;
  if (in_pairs && (moved || atom->nlocal != own))
    fatal_here("a fix before pair_style granular/lsdcd in the script has created or deleted atoms, "
               "or given them to other processes, as insert/lsdcd, balance and deform do, and "
               "springs would go to others: write pair_style before such fixes");
  if (in_pairs) collect();
  in_pairs = false;
  int largest = largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  while (maxexchange < 2 + largest) maxexchange *= 2;
}

void FixSpringsLsdcd::pre_exchange()
{
  between_runs = false;
  speed.see_new_list();
  bring_to_atoms();
}

void FixSpringsLsdcd::post_neighbor()
{
  new_list = true;
  moved = false;
  if (!watches_radii) return;
  const double *const radius = radii();
  listed_radius.assign(radius, radius + atom->nlocal);
}

// Atoms may be deleted between runs, and others get their IDs: delete_atoms gives all of them new ones.
void FixSpringsLsdcd::post_run()
{
  bring_to_atoms();
  between_runs = true;
  keep_names();
  tell_cleared();
  for (const std::string &words : speed.end_run(this)) log(words);
}

// No dump has the springs of its snapshots, and what is there is of another time. LAMMPS's write_data calls this between runs, and
// atoms may get other IDs after it.
void FixSpringsLsdcd::setup_pre_exchange()
{
  if (watch.sees_snapshot(*update)) forget();
  const bool stays_between_runs = between_runs && update->setupflag == 0;
  pre_exchange();
  between_runs = stays_between_runs;
}

void FixSpringsLsdcd::forget()
{
  partners = lsdcd::Partners(partners.form());
  partners.grow(atom->nmax);
  in_pairs = false;
}

void FixSpringsLsdcd::init()
{
  watch.init(*update);
  speed.begin_run();
  if (!between_runs) return;
  if (keeps()) rename_partners();
  keep_names();
}

void FixSpringsLsdcd::keep_names()
{
  const tagint *const tag = tags();
  known_as.assign(tag, tag + atom->nlocal);
  known_as.resize(atom->nmax);
}

// Partners that are gone get the name 0, which no atom has.
void FixSpringsLsdcd::rename_partners()
{
  const tagint *const tag = tags();
  int renamed = !std::equal(tag, tag + atom->nlocal, known_as.begin());
  MPI_Allreduce(MPI_IN_PLACE, &renamed, 1, MPI_INT, MPI_MAX, world);
  if (!renamed) return;
  lsdcd::Partners &all = of_atoms();
  std::vector<NewName> messages;
  std::vector<int> to;
  std::vector<std::pair<int, int>> asked;    // an atom, and which of its partners
  const auto send = [&](const NewName &message) {
    messages.push_back(message);
    to.push_back(static_cast<int>(message.before % comm->nprocs));
  };
  for (int i = 0; i < atom->nlocal; i++) {
    if (known_as[i] > 0) send({known_as[i], tag[i], -1, 0});
    for (int k = 0; k < all.count(i); k++) {
      send({static_cast<tagint>(all.name(i, k)), 0, comm->me, static_cast<int>(asked.size())});
      asked.emplace_back(i, k);
    }
  }
  char *answers = nullptr;
  const int n = comm->rendezvous(1, static_cast<int>(messages.size()),
                                 reinterpret_cast<char *>(messages.data()), sizeof(NewName), 0,
                                 to.data(), answer, 0, answers, sizeof(NewName), lmp);
  for (int k = 0; k < n; k++) {
    const NewName &name = reinterpret_cast<const NewName *>(answers)[k];
    all.rename(asked[name.at].first, asked[name.at].second, name.now);
  }
  memory->sfree(answers);
}

int FixSpringsLsdcd::pack_reverse_comm_size(int n, int first)
{
  int size = 0;
  for (int i = first; i < first + n; i++) size += told().packed_size(i);
  return size;
}

int FixSpringsLsdcd::pack_reverse_comm(int n, int first, double *buf)
{
  double *const begin = buf;
  for (int i = first; i < first + n; i++) buf += told().pack(i, buf);
  return static_cast<int>(buf - begin);
}

void FixSpringsLsdcd::unpack_reverse_comm(int n, int *atoms, double *buf)
{
  for (int k = 0; k < n; k++) buf += told().unpack_more(atoms[k], buf);
}

// ---- atoms move --------------------------------------------------------------------------

void FixSpringsLsdcd::grow_arrays(int nmax)
{
  partners.grow(nmax);
  known_as.resize(nmax);
}

void FixSpringsLsdcd::copy_arrays(int i, int j, int /*delflag*/)
{
  moved = true;
  of_atoms().copy(i, j);
  known_as[j] = known_as[i];
}

void FixSpringsLsdcd::set_arrays(int i)
{
  moved = true;
  partners.clear(i);
  known_as[i] = 0;
}

int FixSpringsLsdcd::pack_exchange(int i, double *buf)
{
  moved = true;
  int n = 0;
  if (between_runs) buf[n++] = static_cast<double>(known_as[i]);
  return n + (keeps() ? of_atoms().pack(i, buf + n) : 0);
}

int FixSpringsLsdcd::unpack_exchange(int i, double *buf)
{
  int n = 0;
  if (between_runs) known_as[i] = static_cast<tagint>(buf[n++]);
  return n + (keeps() ? of_atoms().unpack(i, buf + n) : 0);
}

// ---- restart files -----------------------------------------------------------------------

void FixSpringsLsdcd::write_restart(FILE *file)
{
  bring_to_atoms();
  lsdcd::MpiHost host(world);
  lsdcd::BookedEnergy everywhere = energy;
  lsdcd::sum_over_processes(host, &everywhere, 1);
  const lsdcd::PairSpectra struck = impacts.summed(host, atom->ntypes);
  const lsdcd::PartnerForm form = of_atoms().form();
  if (comm->me != 0) return;
  run_core_here([&] {
    lsdcd::State state(kSpringsOfPairs);
    state.add("width", 1, law_width);
    state.add("laws", 1, kinds);
    if (form.by_law) state.add("kinds of springs", 1, true);
    if (form.by_image) state.add("images", 1, true);
    if (books) state.add("energy", 1, everywhere);
    if (has_impacts) state.add("impacts", 1, struck.saved());
    write_state(file, state);
  });
}

void FixSpringsLsdcd::restart(char *buffer)
{
  try {
    const lsdcd::State state(kSpringsOfPairs, reinterpret_cast<const double *>(buffer),
                             kAllNumbers);
    state.read("width", 1, law_width);
    state.read("laws", 1, kinds);
    books = state.find("energy", 1, energy);
    const lsdcd::Real dt = energy.dt;
    if (comm->me != 0) energy = {};
    energy.dt = dt;
    lsdcd::PairSpectra::Saved struck;
    if (state.find("impacts", 1, struck) && comm->me == 0) impacts.restore(struck);
    lsdcd::PartnerForm form = {law_width};
    state.find("kinds of springs", 1, form.by_law);
    state.find("images", 1, form.by_image);
    by_law = form.by_law;
    partners = lsdcd::Partners(form);
    partners.grow(atom->nmax);
    from_file = true;
  } catch (const lsdcd::StateError &e) {
    throw lsdcd::InputError(std::string("the restart file cannot be used: ") + e.what() + ": " +
                            kWithoutSprings);
  }
}

// In restart files the first number is the size, by which other fixes skip it, and the second one the atom's ID. Pairs have no
// KeptForces there: the setup of the next run makes them.
int FixSpringsLsdcd::size_restart(int i)
{
  return 2 + of_atoms().packed_size(i, law_width);
}

int FixSpringsLsdcd::maxsize_restart()
{
  int largest = 2 + of_atoms().largest_packed_size();
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_INT, MPI_MAX, world);
  return largest;
}

int FixSpringsLsdcd::pack_restart(int i, double *buf)
{
  buf[0] = 2 + of_atoms().pack(i, buf + 2, law_width);
  buf[1] = static_cast<double>(atom->tag[i]);
  return static_cast<int>(buf[0]);
}

void FixSpringsLsdcd::unpack_restart(int i, int nth)
{
  constexpr const char *kWhat = "springs";
  const RestartRow row = restart_row(*atom, i, nth, kWhat, kWithoutSprings);
  const double known = row.size > 0 ? row.numbers[0] : -1;
  if (!from_file || !(known >= 0 && known <= MAXTAGINT) || known != std::floor(known) ||
      !partners.is_sound(row.numbers + 1, row.size - 1))
    fail_at_row(*atom, i, kWhat, kWithoutSprings);
  known_as[i] = static_cast<tagint>(known);
  of_atoms().unpack(i, row.numbers + 1);
}

double FixSpringsLsdcd::memory_usage()
{
  return static_cast<double>(partners.bytes() + history[0].bytes() + history[1].bytes() +
                             impacts.bytes() + listed_type.capacity() * sizeof listed_type[0]);
}
