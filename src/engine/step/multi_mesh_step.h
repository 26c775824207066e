// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step over multi-mesh spheres, which are candidates of more than one mesh: their contacts with all of these
// share their overlap as those with one mesh do.
#pragma once

#include "engine/step/mesh_step.h"

namespace lsdcd {

// The springs of a sphere in the frame of one mesh: those of other meshes are turned to it.
struct SpringsInFrame {
  const Spring *springs;
  const MeshWork *meshes;
  std::uint32_t mesh;

  LSDCD_FN Spring operator[](int k) const;
};
LSDCD_FN bool is_own(const SpringsInFrame &seen, int k)
{
  return seen.springs[k].mesh == seen.mesh;
}
LSDCD_FN Vec3 in_own_frame(const SpringsInFrame &seen, int k, const Vec3 &h)
{
  if (is_own(seen, k)) return h;
  const Pose &from = seen.meshes[seen.springs[k].mesh].settings.pose;
  return seen.meshes[seen.mesh].settings.pose.turn_to_mesh(from.turn_to_box(h));
}
LSDCD_FN Spring SpringsInFrame::operator[](int k) const
{
  Spring s = springs[k];
  s.normal = in_own_frame(*this, k, s.normal);
  s.shear = in_own_frame(*this, k, s.shear);
  return s;
}

// A multi-mesh sphere in the frame of the box; it has one slot for each mesh.
struct MultiMeshSphere {
  int begin, end;
  std::size_t i;
  int kind;    // of the wall's laws
  Vec3 x;
  Real radius, cutoff;    // cutoff: the largest
};

template <class Law>
LSDCD_FN const Law &law_with(const StepJob &job, const MultiMeshSphere &s, int mesh)
{
  return job.multi_mesh.laws.of(mesh, s.kind).law.in_kernel<Law>();
}

// From how far it feels a mesh.
template <bool kBeyondContact>
LSDCD_FN Real cutoff_with(const StepJob &job, const MultiMeshSphere &s, int mesh)
{
  if constexpr (kBeyondContact)
    return cutoff_of(s.radius, job.multi_mesh.laws.of(mesh, s.kind).pull_off);
  else
    return s.radius;
}

template <bool kBeyondContact>
LSDCD_FN MultiMeshSphere multi_mesh_sphere(const StepJob &job, std::size_t g)
{
  MultiMeshSphere s;
  s.begin = job.multi_mesh.first[g];
  s.end = job.multi_mesh.first[g + 1];
  s.i = sphere_of(job, s.begin);
  s.x = job.x[s.i];
  s.radius = job.radius[s.i];
  s.kind = job.multi_mesh.laws.kind[s.i];
  s.cutoff = s.radius;
  if constexpr (kBeyondContact)
    for (int k = s.begin; k < s.end; k++)
      s.cutoff = fmax(s.cutoff, cutoff_with<true>(job, s, job.multi_mesh.mesh[k]));
  return s;
}

// Returns the query for it in the frame of the mesh of slot k.
template <bool kBeyondContact>
LSDCD_FN QuerySphereWith<SpringsInFrame> in_frame_of(const StepJob &job, const MultiMeshSphere &s,
                                                     int k)
{
  const int mesh = job.multi_mesh.mesh[k];
  const SpringsView &springs = job.springs;
  QuerySphereWith<SpringsInFrame> seen = {
      job.multi_mesh.meshes[mesh].settings.pose.to_mesh(s.x),
      s.radius,
      cutoff_with<kBeyondContact>(job, s, mesh),
      {springs.pool, job.multi_mesh.meshes, std::uint32_t(mesh)},
      0};
  if (springs.count.at) seen.n_springs = springs.count[s.i];
  if (seen.n_springs > 0) seen.springs.springs += springs.first[s.i];
  return seen;
}

// Takes contact c out; the others keep their order. `end`: of the contacts of n meshes.
template <int kCapacity>
LSDCD_FN void remove_contact(ContactSet<kCapacity> &all, int c, int *end, int n)
{
  for (int m = 0; m < n; m++)
    if (end[m] > c) end[m]--;
  all.n--;
  for (; c < all.n; c++) {
    all.feature[c] = all.feature[c + 1];
    all.normal[c] = all.normal[c + 1];
    all.distance[c] = all.distance[c + 1];
  }
}

// Adds the contacts of the n-th mesh to those of the meshes before it, which end at `end`. Two contacts with the
// same closest point are one. It is the nearer one; if both are equally near, a face before an edge before a
// vertex; if these are equal, that of the earlier mesh.
template <int kCapacity>
LSDCD_FN void add_mesh(const Pose &pose, const ContactSet<kCapacity> &of_mesh, Real tolerance,
                       ContactSet<kCapacity> &all, int *end, int n)
{
  for (int c = 0; c < of_mesh.n; c++) {
    const Vec3 normal = pose.turn_to_box(of_mesh.normal[c]);
    const Real distance = of_mesh.distance[c];
    bool is_new = true;
    for (int b = n > 0 ? end[n - 1] - 1 : -1; b >= 0 && is_new; b--) {
      const Vec3 apart = all.distance[b] * all.normal[b] - distance * normal;
      if (norm_sq(apart) > kSamePoint * kSamePoint * tolerance * tolerance) continue;
      if (distance < all.distance[b] ||
          (distance == all.distance[b] &&
           feature_kind(of_mesh.feature[c]) < feature_kind(all.feature[b])))
        remove_contact(all, b, end, n);
      else
        is_new = false;
    }
    if (is_new) all.add(of_mesh.feature[c], normal, distance);
  }
}

// The contacts of the sphere with their weights, mesh after mesh, in the frame of the box: those of slot begin + k
// end at end[k]. `of_mesh` and `rule`: memory.
template <bool kBeyondContact, int kCapacity>
LSDCD_FN void narrow_phase_of_meshes(const StepJob &job, const MultiMeshSphere &s,
                                     WeightedContacts<kCapacity> &of_mesh,
                                     CornerRule<kCapacity> &rule, WeightedContacts<kCapacity> &all,
                                     int *end)
{
  Real tolerance = 0;
  all.exact_within = kAnyDistance;
  for (int k = s.begin; k < s.end; k++) {
    const MeshWork &mesh = job.multi_mesh.meshes[job.multi_mesh.mesh[k]];
    const QuerySphereWith<SpringsInFrame> seen = in_frame_of<kBeyondContact>(job, s, k);
    const ListedFeatures list = {job.lists, static_cast<std::size_t>(k)};
    const bool holds = job.lists.n && job.lists.holds(k, seen.x, s.cutoff);
    if (job.lists.n && !holds) count_one(&job.counts->by_cells);
    of_mesh.set.clear();
    find_filtered<kBeyondContact, false>(mesh.grid, mesh.settings.search, seen,
                                         holds ? &list : nullptr, of_mesh);
    tolerance = fmax(tolerance, mesh.grid.tolerance);
    if (!of_mesh.set.overflow)
      add_mesh(mesh.settings.pose, of_mesh.set, tolerance, all.set, end, k - s.begin);
    all.set.overflow |= of_mesh.set.overflow;
    if (all.set.overflow) return;
    if (of_mesh.exact_within < all.exact_within) all.exact_within = of_mesh.exact_within;
    end[k - s.begin] = all.set.n;
  }
  share_overlap(job.settings.search, s.cutoff, tolerance, rule, all);
}
// A function of its own, so that it is compiled once however many laws there are.
template <bool kBeyondContact>
LSDCD_NOINLINE void narrow_phase_of_meshes(const StepJob &job, const MultiMeshSphere &s,
                                           MultiMeshMemory &memory,
                                           WeightedContacts<kContacts> &all, int *end)
{
  narrow_phase_of_meshes<kBeyondContact>(job, s, memory.of_mesh, memory.rule, all, end);
}
template <bool kBeyondContact>
LSDCD_NOINLINE void narrow_phase_of_meshes(const StepJob &job, const MultiMeshSphere &s,
                                           OverflowScratch &scratch, int *end)
{
  scratch.contacts.set.clear();
  narrow_phase_of_meshes<kBeyondContact>(job, s, scratch.of_mesh, scratch.rule, scratch.contacts,
                                         end);
}

// Applies the law to its contacts, in the frame of the mesh of each.
template <class Law, int kCapacity>
LSDCD_FN void apply_multi_mesh_law(const StepJob &job, const MultiMeshSphere &s,
                                   WeightedContacts<kCapacity> &all, const int *end)
{
  for (int k = s.begin; k < s.end; k++) job.result.n_contacts[k] = 0;
  if (all.set.n == 0) {
    put_no_contact(job, s.begin, s.i);
    return;
  }
  int first = 0, n_done = 0;
  Real deepest = 0;
  std::uint32_t deepest_mesh = 0, touched = 0;
  SphereSink sink = {};
  const int n_acting = count_acting(all.set.view(), all.weight);
  // All laws of a wall store the same numbers of a contact.
  if (!reserve_places(law_with<Law>(job, s, job.multi_mesh.mesh[s.begin]), job, s.begin, n_acting,
                      first, sink)) {
    does_not_fit(job, s.begin, s.i, job.counts->no_places);
    return;
  }
  for (int k = s.begin, from = 0; k < s.end; k++) {
    const int to = end[k - s.begin], n = to - from;
    if (n == 0) continue;
    const MeshWork &mesh = job.multi_mesh.meshes[job.multi_mesh.mesh[k]];
    const Law &law = law_with<Law>(job, s, job.multi_mesh.mesh[k]);
    const Pose &pose = mesh.settings.pose;
    for (int c = from; c < to; c++) all.set.normal[c] = pose.turn_to_mesh(all.set.normal[c]);
    const ContactsView set = {n, all.set.feature.data() + from, all.set.normal.data() + from,
                              all.set.distance.data() + from};

    const QuerySphereWith<SpringsInFrame> seen = in_frame_of<Law::kBeyondContact>(job, s, k);
    SphereStateWith<SpringsInFrame> state = {};
    state.x = seen.x;
    state.radius = s.radius;
    state.springs = seen.springs;
    state.n_springs = seen.n_springs;
    if constexpr (Law::kExtra > 0)
      if (seen.n_springs > 0)
        state.extra = job.springs.extra + std::size_t(job.springs.first[s.i]) * n_extra(law);
    add_motion(law, job, pose, s.i, state);

    SphereSink to_mesh = sink;
    if constexpr (Law::kHistory) to_mesh.springs += n_done;
    if constexpr (Law::kExtra > 0) to_mesh.extra += n_done * n_extra(law);
    if constexpr (Law::kContacts) to_mesh.contacts += n_done;
    if constexpr (Law::kHeat)
      if (law.has_heat()) {
        to_mesh.heat = job.heat + k;
        *to_mesh.heat = 0;
      }
    SphereResult out = {};
    add_contacts(mesh.grid, law, mesh.settings, state, set, all.weight + from, to_mesh, out);
    from = to;
    if (out.overlap_ratio > 0) touched |= 1u << mesh.settings.mesh;
    if (out.overlap_ratio > deepest) {
      deepest = out.overlap_ratio;
      deepest_mesh = mesh.settings.mesh;
    }
    if (out.n_contacts == 0) continue;
    if constexpr (Law::kContacts) job.pool.first_contact[k] = first + n_done;
    if constexpr (Law::kHeat)
      if (law.has_heat()) job.heat_flow[s.i] += *to_mesh.heat;
    n_done += out.n_contacts;
    if (pose.placed) to_box(pose, out);
    add_force(job, k, s.i, s.x, out);
  }
  if (record_overlap(job, s.i, deepest_mesh, deepest))
    raise_to(&job.counts->deepest_meshes, DeepestOverlap::ratio(deepest) | touched);
  if constexpr (Law::kHistory)
    if (job.settings.update) {
      if (n_done > 0) job.pool.first[s.i] = first;
      job.pool.count[s.i] = n_done;
    }
}

template <class Law>
LSDCD_FN void multi_mesh_contacts(const StepJob &job, std::size_t g, MultiMeshMemory &memory)
{
  const MultiMeshSphere s = multi_mesh_sphere<Law::kBeyondContact>(job, g);
  check_cutoff(job, s.i, s.cutoff);
  int end[kMaxMeshes];
  WeightedContacts<kContacts> some;
  narrow_phase_of_meshes<Law::kBeyondContact>(job, s, memory, some, end);
  if (job.uncertain)
    for (int k = s.begin + 1; k < s.end; k++) job.uncertain[k] = 0;
  if (!some.set.overflow) {
    count_uncertain(job, s.begin, may_miss(s.cutoff, some.exact_within), s.radius);
    apply_multi_mesh_law<Law>(job, s, some, end);
    return;
  }
  // As in any_contacts().
  for (bool done = false; !done;) {
    OverflowScratch *scratch = job.overflow + g % kOverflowScratches;
    if (!try_lock(&scratch->locked)) continue;
    narrow_phase_of_meshes<Law::kBeyondContact>(job, s, *scratch, end);
    if (!scratch->contacts.set.overflow) {
      count_uncertain(job, s.begin, may_miss(s.cutoff, scratch->contacts.exact_within), s.radius);
      apply_multi_mesh_law<Law>(job, s, scratch->contacts, end);
    } else {
      for (int k = s.begin; k < s.end; k++) job.result.n_contacts[k] = 0;
      does_not_fit(job, s.begin, s.i, job.counts->no_scratch);
    }
    unlock(&scratch->locked);
    done = true;
  }
}

// The work of it for Backend::step(), of sphere g.
template <class Law>
struct MultiMeshStep {
  StepJob job;

  static constexpr bool kFastPath = false;
  static constexpr int kBlocksAtOnce = 2;    // its kernel has all registers that there are
  bool has_fast_path() const { return false; }
  LSDCD_FN void begin() const { clear_next(job); }
  LSDCD_FN bool fast_path(std::size_t) const { return false; }
  LSDCD_FN bool needs_list(std::size_t g) const
  {
    if (!job.lists.n) return false;
    const MultiMeshSphere s = multi_mesh_sphere<Law::kBeyondContact>(job, g);
    for (int k = s.begin; k < s.end; k++)
      if (!job.lists.holds(k, centre_in_frame(s, k), s.cutoff)) return true;
    return false;
  }
  template <unsigned kSize>
  LSDCD_FN void make_list(const Warp<kSize> &warp, bool mine, std::size_t g) const
  {
    const MultiMeshSphere s = multi_mesh_sphere<Law::kBeyondContact>(job, g);
    for (int k = s.begin; warp.vote(mine && k < s.end); k++) {
      const bool in = mine && k < s.end;
      const Vec3 x = in ? centre_in_frame(s, k) : Vec3{0, 0, 0};
      const bool due = in && !job.lists.holds(k, x, s.cutoff);
      for_each_distinct(warp, due, due ? job.multi_mesh.mesh[k] : 0, [&](bool of_mesh, int m) {
        put_list(job, warp, of_mesh, job.multi_mesh.meshes[m].grid,
                 {x, s.radius, s.cutoff, nullptr, 0}, k);
      });
    }
  }
  using Memory = MultiMeshMemory;
  LSDCD_FN bool general_path(std::size_t g, Memory &memory) const
  {
    multi_mesh_contacts<Law>(job, g, memory);
    return true;
  }
  // Its centre in the frame of the mesh of slot k.
  LSDCD_FN Vec3 centre_in_frame(const MultiMeshSphere &s, int k) const
  {
    return in_frame_of<Law::kBeyondContact>(job, s, k).x;
  }
  LSDCD_FN const WorkLists &work_lists() const { return job.work_lists; }
};

// Candidates [0, n) of one mesh, or the multi-mesh spheres [0, n).
template <class Law, class Backend>
void run_compiled_law(const LawBytes &bytes, const StepJob &job, std::size_t n, Backend &backend)
{
  if constexpr (Law::kSurface)
    if (job.multi_mesh.meshes) {
      run_step(backend, n, MultiMeshStep<Law>{job});
      return;
    }
  run_step(backend, n, MeshStep<Law>{bytes.as<Law>(), job});
}

}    // namespace lsdcd
