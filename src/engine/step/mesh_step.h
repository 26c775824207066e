// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step of one sphere: narrow phase, corner rule, contact law and result. All backends share this source.
#pragma once

#include "engine/step/compiled_law.h"
#include "engine/step/contact_energy.h"
#include "engine/step/impacts.h"
#include "engine/step/step_job.h"

#include <cstdint>

namespace lsdcd {

// Returns the centre of sphere i in the frame of the mesh.
template <class Law>
LSDCD_FN Vec3 centre_of(const StepJob &job, std::size_t i)
{
  const Vec3 x = job.x[i];
  if constexpr (Law::kPosed) return job.settings.pose.to_mesh(x);
  return x;
}

// Turns a result back to the frame of the box.
LSDCD_FN void to_box(const Pose &pose, SphereResult &out)
{
  out.force = pose.turn_to_box(out.force);
  out.torque = pose.turn_to_box(out.torque);
  if (out.weight > 0)
    out.weighted_point = pose.turn_to_box(out.weighted_point) + out.weight * pose.shift;
}

// Returns sphere i at x, without the numbers that only a contact needs: most candidates touch nothing.
template <class Law>
LSDCD_FN SphereState state_at(const Law &law, const StepJob &job, std::size_t i, const Vec3 &x,
                              Real radius)
{
  SphereState s = {};
  s.x = x;
  s.radius = radius;
  if constexpr (Law::kHistory) {
    s.n_springs = job.springs.count[i];
    const std::size_t first = s.n_springs > 0 ? job.springs.first[i] : 0;
    s.springs = job.springs.pool + first;
    if constexpr (Law::kStoresExtra) s.extra = job.springs.extra + first * n_stored(law);
  }
  return s;
}

// Adds the numbers that only a sphere with a contact needs: its velocities, mass and temperature.
template <class Law, class Springs>
LSDCD_FN void add_motion(const Law &law, const StepJob &job, const Pose &pose, std::size_t i,
                         SphereStateWith<Springs> &s)
{
  s.v = job.v[i];
  s.omega = job.omega[i];
  if constexpr (Law::kPosed) {
    s.v = pose.turn_to_mesh(s.v);
    s.omega = pose.turn_to_mesh(s.omega);
  }
  s.mass = job.mass[i];
  if constexpr (Law::kHeat)
    if (law.has_heat()) s.temperature = job.temperature[i];
}

// Reserves the places of n contacts of candidate k, from `first` on. Returns false if there is no memory left.
template <class Law>
LSDCD_FN bool reserve_places(const Law &law, const StepJob &job, std::size_t k, int n, int &first,
                             SphereSink &sink)
{
  const ContactPool &pool = job.pool;
  first = static_cast<int>(k);
  if constexpr (Law::kPosed) first += job.first_slot;
  if constexpr (Law::kHistory || Law::kKeepsContacts) {
    if (n > 1) {
      first = pool.shared + fetch_add(&job.counts->shared_used[pool.which], n);
      if (first > pool.size - n) return false;
    }
    if constexpr (Law::kHistory) sink.springs = pool.springs + first;
    if constexpr (Law::kStoresExtra) sink.extra = pool.extra + std::size_t(first) * n_stored(law);
    if constexpr (Law::kKeepsContacts) sink.contacts = pool.contacts + first;
  }
  return true;
}

template <class Contacts>
LSDCD_FN int count_acting(const Contacts &set, const Real *weight)
{
  int n = 0;
  for (int i = 0; i < set.n; i++) n += weight[i] > 0;
  return n;
}

// Stores the result of candidate k, sphere i at x, and adds force and torque to those of the sphere, unless that is done later.
LSDCD_FN void add_force(const StepJob &job, std::size_t k, std::size_t i, const Vec3 &x,
                        const SphereResult &out)
{
  job.result.put(k, out, cross(x, out.force) + out.torque);
  if (job.result.torque.at) return;
  job.force.add(i, out.force);
  job.torque.add(i, out.torque);
}

// A mesh, and the law that a sphere has with it.
template <class Law>
struct LawAtMesh {
  const Law &law;
  const GridView &grid;
  const ForceSettings &settings;
};

// A sphere that is a candidate of one mesh, for apply_law(): candidate k, sphere i at x in the frame of that mesh.
template <class Law>
struct OneMeshSphere {
  static constexpr bool kSeveral = false;
  const Law &law;
  const StepJob &job;
  std::size_t k, i;
  Vec3 x;
  Real radius;

  LSDCD_FN std::size_t begin() const { return k; }
  LSDCD_FN int n_meshes() const { return 1; }
  LSDCD_FN LawAtMesh<Law> mesh(std::size_t) const { return {law, job.grid, job.settings}; }
  LSDCD_FN SphereState state(const Law &, std::size_t) const
  {
    return state_at(law, job, i, x, radius);
  }
  LSDCD_FN Vec3 in_box() const
  {
    if constexpr (Law::kPosed)
      if (job.settings.pose.placed) return job.x[i];
    return x;
  }
  // Returns where the contacts of candidate k end, of n.
  LSDCD_FN int contacts_end(std::size_t, int n) const { return n; }
};

// Does the work of close_books() for a grain of a law with kShapes (grain_energy.h).
template <class Law, class Springs>
void close_grain(const Law &law, const StepJob &job, const LawAtMesh<Law> &mesh, std::size_t i,
                 const SphereStateWith<Springs> &s, const MarksOf<Law> &marks,
                 EnergyBook<Law> &book);

// Completes the energy balance at each mesh of a sphere by its contacts of the last step, after those of this step were added.
template <class Law, class Sphere>
LSDCD_FN void close_books(const StepJob &job, const Sphere &sphere, const MarksOf<Law> &marks)
{
  for (int m = 0; m < sphere.n_meshes(); m++) {
    const auto k = sphere.begin() + m;
    const LawAtMesh<Law> mesh = sphere.mesh(k);
    auto state = sphere.state(mesh.law, k);
    if (state.n_springs == 0) continue;
    add_motion(mesh.law, job, mesh.settings.pose, sphere.i, state);
    if (!job.is_booked[k]) job.energy[k] = EnergyRows();
    EnergyBook<Law> book = {job.energy[k]};
    if constexpr (Law::kShapes)
      close_grain(mesh.law, job, mesh, sphere.i, state, marks, book);
    else
      book.close(mesh.law, mesh.grid.wall, mesh.settings, state, marks, job.records);
    if constexpr (Law::kHeat)
      if (mesh.law.has_heat() && mesh.settings.update && job.friction_heat > 0) {
        const Real heat = job.friction_heat *
                          (book.rows[EnergyRow::slider] - job.energy[k][EnergyRow::slider]) /
                          mesh.settings.dt;
        job.heat_flow[sphere.i] += heat;
        if (job.is_booked[k]) job.heat[k] += heat;    // the sphere has contacts in this step, too
      }
    job.energy[k] = book.rows;
    job.is_booked[k] = 1;
  }
}

// The largest overlap of a sphere among its meshes, and which of these it touches.
struct DeepestAtMeshes {
  Real ratio = 0;    // to the radius
  std::uint32_t mesh = 0, touched = 0;

  LSDCD_FN void add(Real at_mesh, std::uint32_t number)
  {
    if (at_mesh > 0) touched |= 1u << number;
    if (!(at_mesh > ratio)) return;
    ratio = at_mesh;
    mesh = number;
  }
  LSDCD_FN void record(const StepJob &job, std::size_t i) const
  {
    if (record_overlap(job, i, mesh, ratio))
      raise_to(&job.counts->deepest_meshes, DeepestOverlap::ratio(ratio) | touched);
  }
};

// Returns the sink of a mesh's contacts behind `done` contacts with other meshes.
template <class Law>
LSDCD_FN SinkOf<Law> sink_behind([[maybe_unused]] const Law &law, const SinkOf<Law> &sink,
                                 [[maybe_unused]] int done)
{
  SinkOf<Law> to = sink;
  if constexpr (Law::kHistory) to.springs += done;
  if constexpr (Law::kStoresExtra) to.extra += done * n_stored(law);
  if constexpr (Law::kKeepsContacts) to.contacts += done;
  return to;
}

// Applies the law to the contacts of a sphere with one mesh or several, mesh after mesh, each in the frame of its mesh: computes force,
// torque, springs and contacts. The moment about the origin is stored, too, so that totals can be made after spheres have moved on. The
// sphere is a OneMeshSphere, or a MultiMeshSphere with its contacts (AtMeshes), which is a candidate of each of its meshes: results are by
// slot, one for each mesh, of which callers have set n_contacts to 0. `weight` null: there is at most one contact, with one mesh.
template <class Law, class Sphere, class Contacts>
LSDCD_FN void apply_law(const StepJob &job, const Sphere &sphere, const Contacts &set,
                        const Real *weight)
{
  const auto begin = sphere.begin();
  const std::size_t i = sphere.i;
  [[maybe_unused]] MarksOf<Law> marks;
  if constexpr (Law::kLosses) marks.sphere = static_cast<int>(i);
  if constexpr (Law::kEnergy)
    for (int m = 0; m < sphere.n_meshes(); m++) job.is_booked[begin + m] = 0;
  if (set.n == 0) {
    if constexpr (Law::kEnergy) close_books<Law>(job, sphere, marks);
    // After the books, which read the number of springs of the last step that it sets to 0.
    put_no_contact(job, begin, i);
    return;
  }
  int first = 0;    // place in the pool of contacts; reserve_places() sets it and the sink
  SinkOf<Law> sink = {};
  // All laws of a wall store the same numbers of a contact.
  if (!reserve_places(sphere.mesh(begin).law, job, begin,
                      weight ? count_acting(set, weight) : set.n, first, sink)) {
    does_not_fit(job, begin, i, job.counts->no_places);    // an error of the step
    return;
  }
  [[maybe_unused]] bool may_have_impacts = false;
  if constexpr (Law::kEnergy) {
    sink.marks = &marks;
    sink.friction_heat = job.friction_heat;
  }
  if constexpr (Law::kRecords) {
    sink.records = job.records;
    sink.may_have_impacts = &may_have_impacts;
  }
  int n_done = 0;    // contacts that are stored
  [[maybe_unused]] DeepestAtMeshes deepest;
  for_each_touched_mesh(sphere, set, [&](auto slot, const Contacts &of_mesh, int from) {
    const LawAtMesh<Law> mesh = sphere.mesh(slot);
    const Law &law = mesh.law;
    const ForceSettings &settings = mesh.settings;
    auto state = sphere.state(law, slot);
    add_motion(law, job, settings.pose, i, state);

    SinkOf<Law> mesh_sink = sink_behind<Law>(law, sink, n_done);
    [[maybe_unused]] EnergyBook<Law> book = {};
    if constexpr (Law::kEnergy) mesh_sink.book = &book;
    if constexpr (Law::kHeat)
      if (law.has_heat()) {
        mesh_sink.heat = job.heat + slot;
        *mesh_sink.heat = 0;
      }
    SphereResult out = {};
    add_contacts(mesh.grid, law, settings, state, contacts_in_step(of_mesh),
                 weight ? weight + from : nullptr, mesh_sink, out);
    if constexpr (Law::kEnergy) {
      job.energy[slot] = book.rows;
      job.is_booked[slot] = 1;
    }
    if constexpr (Sphere::kSeveral)
      deepest.add(out.overlap_ratio, settings.mesh);
    else
      record_overlap(job, i, settings.mesh, out.overlap_ratio);
    job.result.n_contacts[slot] = out.n_contacts;
    if (out.n_contacts == 0) return;    // none of this mesh bears; on to the next mesh
    if constexpr (Law::kKeepsContacts) job.pool.first_contact[slot] = first + n_done;
    if constexpr (Law::kHeat)
      if (law.has_heat()) job.heat_flow[i] += *mesh_sink.heat;
    n_done += out.n_contacts;
    if constexpr (Law::kPosed)
      if (settings.pose.placed) to_box(settings.pose, out);
    add_force(job, slot, i, sphere.in_box(), out);
  });
  if constexpr (Law::kLosses) {    // where close_books() finds the contacts of this step that go on
    marks.springs = sink.springs;
    marks.extra = sink.extra;
    marks.n = n_done;
  }
  if constexpr (Law::kEnergy) close_books<Law>(job, sphere, marks);
  if constexpr (Law::kRecords && !Contacts::kHasArms)
    if (may_have_impacts) record_impacts<Law>(job, sphere, set, weight, sink.contacts);
  if constexpr (Sphere::kSeveral) deepest.record(job, i);
  if constexpr (Law::kHistory)
    if (job.settings.stores) {    // the same for all meshes
      if (n_done > 0) job.pool.first[i] = first;
      job.pool.count[i] = n_done;
    }
}

// Finds the contacts of a sphere, item k of the step, by find(memory, contacts), and applies the law to them. If the stack has no space for
// all contacts, they are found once more in a scratch memory. Returns their number, or at most the number that a stack has space for.
template <class Law, class Sphere, class Memory, class Find>
LSDCD_FN int apply_to_all(const StepJob &job, const Sphere &sphere, std::size_t k, Real cutoff,
                          Memory &memory, Find &find)
{
  WeightedContacts<kContacts> some;
  find(memory, some);
  ContactsView set = some.set.view();
  const Real *weight = some.weight;
  Real exact_within = some.exact_within;
  // A scratch memory is locked, used and unlocked in one pass of the loop: on a GPU threads that wait for it must not hold up the thread
  // that has it.
  for (bool done = false; !done;) {
    OverflowScratch *scratch = nullptr;
    bool fits = true;
    if (some.set.overflow) {
      scratch = job.overflow + k % kOverflowScratches;
      if (!try_lock(&scratch->locked)) continue;
      scratch->contacts.set.clear();
      find(*scratch, scratch->contacts);
      set = scratch->contacts.set.view();
      weight = scratch->contacts.weight;
      exact_within = scratch->contacts.exact_within;
      fits = !scratch->contacts.set.overflow;
    }
    if (fits) {
      count_uncertain(job, sphere.begin(), may_miss(cutoff, exact_within), sphere.radius);
      apply_law<Law>(job, sphere, set, weight);
    } else {
      does_not_fit(job, sphere.begin(), sphere.i, job.counts->no_scratch);
    }
    if (scratch) unlock(&scratch->locked);
    done = true;
  }
  return some.set.n;
}

// Returns the query for candidate k.
template <class Law>
LSDCD_FN QuerySphere query_sphere_of_candidate(const Law &law, const StepJob &job, std::size_t k)
{
  const std::size_t i = sphere_of(job, k);
  return query_sphere_of(job, law, i, centre_of<Law>(job, i), job.radius[i]);
}

// Returns whether candidate k needs a new list.
template <class Law>
LSDCD_FN bool needs_list(const Law &law, const StepJob &job, std::size_t k)
{
  if (!job.lists.n) return false;
  const QuerySphere s = query_sphere_of_candidate(law, job, k);
  return !job.lists.holds(k, s.x, s.cutoff);
}

// Makes a new list of candidate-mesh pair k, whose sphere is s. The list is for no smaller radius than at the candidate search, because a
// sphere that has shrunk may grow to that radius again. This is a function of its own, so that its list is not on the stack of the rest.
template <unsigned kSize>
LSDCD_NOINLINE void put_list(const StepJob &job, const Warp<kSize> &warp, bool mine,
                             const GridView &grid, QuerySphere s, std::size_t k)
{
  FeatureList made;
  const Real chosen = mine ? job.lists.cutoff(k) : 0;
  const bool has_grown = s.cutoff > chosen;
  if (!has_grown) s.cutoff = chosen;
  gather(warp, mine, grid, s, kAnyDistance, made);
  if (!mine) return;
  if (has_grown) raise_to(&job.counts->grown, kNoSphere - sphere_of(job, k));
  count_one(&job.counts->lists);
  add_to(&job.counts->listed, made.n);
  job.lists.put(k, made, grid.wall, !has_grown);
}

// Makes a new list of candidate-mesh pair k if the nodes of the mesh move. Candidates have no list yet after a candidate search.
template <unsigned kSize>
LSDCD_NOINLINE void put_node_list(const StepJob &job, const Warp<kSize> &warp, bool mine,
                                  const QuerySphere &s, std::size_t k)
{
  FeatureList made;
  gather_nodes(warp, mine, job.grid, s, job.settings.nodes.going, made);
  if (!mine) return;
  count_one(&job.counts->lists);
  add_to(&job.counts->listed, made.n);
  job.lists.put(k, made, job.grid.wall);
}

// Does candidate k with any number of contacts. If it has no valid list, its cell is searched. Returns true if it has more than one
// contact. This is a function of its own, so that it takes no registers from the fast path.
template <class Law>
LSDCD_NOINLINE bool any_contacts(const Law &law, const StepJob &job, std::size_t k,
                                 GeneralMemory &memory)
{
  const std::size_t i = sphere_of(job, k);
  const Vec3 x = centre_of<Law>(job, i);
  const Real radius = job.radius[i];
  const QuerySphere s = query_sphere_of(job, law, i, x, radius);
  check_cutoff(job, i, s.cutoff);
  const ListedFeatures listed = {job.lists, k};
  const ListedFeatures *list = job.lists.n ? &listed : nullptr;
  if (list && !job.lists.holds(k, x, s.cutoff)) {
    count_one(&job.counts->by_cells);
    list = nullptr;
  }

  auto find = [&](auto &with, auto &contacts) {
    narrow_phase<Law::kBeyondContact, Law::kNodes>(with.rule, job.grid, job.settings.search, s,
                                                   list, contacts);
    if (is_at_nodes<Law::kNodes>(job.grid))
      list = nullptr;    // if it overflows, contacts are found in the cell
  };
  const OneMeshSphere<Law> sphere = {law, job, k, i, x, radius};
  return apply_to_all<Law>(job, sphere, k, s.cutoff, memory, find) > 1;
}

// The candidates of one mesh, for run_step(); this is function (2) of the paper. Each candidate takes fast_path(), and then general_path()
// if that returns false or does not exist.
template <class Law>
struct MeshStep {
  Law law;
  StepJob job;

  static constexpr bool kFastPath = true;
  // Number of blocks at once on a GPU's processor: it leaves 128 or 168 registers to a thread. With fewer registers the kernels spill,
  // which costs more than more blocks gain.
  static constexpr bool kLarge =
      Law::kStoresExtra || Law::kContactTorque || Law::kHeat || Law::kBeyondContact;
  static constexpr int kBlocksAtOnce = kLarge ? 3 : 4;

  bool has_fast_path() const { return job.lists.n; }
  LSDCD_FN void begin() const { clear_next(job); }
  // Does candidate k if it has one contact or none, as nearly all have. With memory for one contact nothing is indexed and all is in
  // registers. Returns false, with nothing done, if the candidate has more contacts or no valid list.
  LSDCD_FN bool fast_path(std::size_t k) const
  {
    const std::size_t i = sphere_of(job, k);
    const Vec3 x = centre_of<Law>(job, i);
    const Real radius = job.radius[i];
    const QuerySphere s = query_sphere_of(job, law, i, x, radius);
    if (!job.lists.holds(k, x, s.cutoff)) return false;
    ContactSet<1> set;
    find_listed<Law::kNodes>(job.grid, {job.lists, k}, x, s.cutoff, set);
    filter_contacts<Law::kBeyondContact>(job.grid, job.settings.search, s, set);
    if (set.overflow) return false;
    check_cutoff(job, i, s.cutoff);
    apply_law<Law>(job, OneMeshSphere<Law>{law, job, k, i, x, radius}, set.view(), nullptr);
    return true;
  }
  LSDCD_FN bool needs_list(std::size_t k) const { return lsdcd::needs_list(law, job, k); }
  template <unsigned kSize>
  LSDCD_FN void make_list(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    const QuerySphere s = query_sphere_of_candidate(law, job, k);
    if constexpr (Law::kNodes)
      if (is_at_nodes<Law::kNodes>(job.grid)) return put_node_list(job, warp, mine, s, k);
    put_list(job, warp, mine, job.grid, s, k);
  }
  // Prefetches, for a CPU, what make_list() will read, part by part.
  using Ahead = SearchAhead;
  Ahead list_ahead(std::size_t k) const
  {
    return Ahead(job.grid, centre_of<Law>(job, sphere_of(job, k)));
  }
  void prefetch(Ahead &ahead, int part) const { ahead.prefetch(job.grid, part); }
  using Memory = GeneralMemory;
  LSDCD_FN bool general_path(std::size_t k, Memory &memory) const
  {
    return any_contacts(law, job, k, memory);
  }
  LSDCD_FN const WorkLists &work_lists() const { return job.work_lists; }
};

}    // namespace lsdcd
