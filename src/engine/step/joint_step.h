// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step over the spheres that are near several meshes of a wall: their contacts with all of these
// share their overlap as those with one mesh do.
#pragma once

#include "engine/step/law_step.h"

namespace lsdcd {

// The springs of a sphere as one mesh sees them: those of other meshes turned to its frame.
struct SpringsSeen {
  const Spring *springs;
  const MeshWork *meshes;
  std::uint32_t mesh;

  LSDCD_FN Spring operator[](int k) const;
};
LSDCD_FN bool is_own(const SpringsSeen &seen, int k)
{
  return seen.springs[k].mesh == seen.mesh;
}
LSDCD_FN Vec3 in_own_frame(const SpringsSeen &seen, int k, const Vec3 &h)
{
  if (is_own(seen, k)) return h;
  const Pose &from = seen.meshes[seen.springs[k].mesh].settings.pose;
  return seen.meshes[seen.mesh].settings.pose.turn_to_mesh(from.turn_to_box(h));
}
LSDCD_FN Spring SpringsSeen::operator[](int k) const
{
  Spring s = springs[k];
  s.normal = in_own_frame(*this, k, s.normal);
  s.shear = in_own_frame(*this, k, s.shear);
  return s;
}

// A sphere near several meshes, in the frame of the box: one slot for each mesh.
struct JointSphere {
  int begin, end;
  std::size_t i;
  int kind;    // of the wall's laws
  Vec3 x;
  Real radius, cutoff;    // cutoff: the largest
};

template <class Law>
LSDCD_FN const Law &law_with(const LawJob &job, const JointSphere &s, int mesh)
{
  return job.joint.laws.of(mesh, s.kind).law.in_kernel<Law>();
}

// From how far it feels a mesh.
template <bool kBeyondContact>
LSDCD_FN Real cutoff_with(const LawJob &job, const JointSphere &s, int mesh)
{
  if constexpr (kBeyondContact)
    return cutoff_of(s.radius, job.joint.laws.of(mesh, s.kind).pull_off);
  else
    return s.radius;
}

template <bool kBeyondContact>
LSDCD_FN JointSphere joint_sphere(const LawJob &job, std::size_t g)
{
  JointSphere s;
  s.begin = job.joint.first[g];
  s.end = job.joint.first[g + 1];
  s.i = sphere_of(job, s.begin);
  s.x = job.x[s.i];
  s.radius = job.radius[s.i];
  s.kind = job.joint.laws.kind[s.i];
  s.cutoff = s.radius;
  if constexpr (kBeyondContact)
    for (int k = s.begin; k < s.end; k++)
      s.cutoff = fmax(s.cutoff, cutoff_with<true>(job, s, job.joint.mesh[k]));
  return s;
}

// It, as the mesh of slot k sees it.
template <bool kBeyondContact>
LSDCD_FN QuerySphereWith<SpringsSeen> seen_from(const LawJob &job, const JointSphere &s, int k)
{
  const int mesh = job.joint.mesh[k];
  const SpringsView &springs = job.springs;
  QuerySphereWith<SpringsSeen> seen = {job.joint.meshes[mesh].settings.pose.to_mesh(s.x),
                                       s.radius,
                                       cutoff_with<kBeyondContact>(job, s, mesh),
                                       {springs.pool, job.joint.meshes, std::uint32_t(mesh)},
                                       0};
  if (springs.count.at) seen.n_springs = springs.count[s.i];
  if (seen.n_springs > 0) seen.springs.springs += springs.first[s.i];
  return seen;
}

// Takes contact c out; the others keep their order. `end`: of the contacts of n meshes.
template <int kCapacity>
LSDCD_FN void take_out(ContactSet<kCapacity> &all, int c, int *end, int n)
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

// What the n-th mesh adds to the contacts of those before it, whose contacts end at `end`. Where two
// have the same closest point it is one contact: of the nearer mesh, or of the one with the larger kind
// of feature there, or of the earlier.
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
        take_out(all, b, end, n);
      else
        is_new = false;
    }
    if (is_new) all.add(of_mesh.feature[c], normal, distance);
  }
}

// All that the sphere touches, mesh after mesh, in the frame of the box: what is of slot
// begin + k ends at end[k]. `of_mesh` and `rule`: memory.
template <bool kBeyondContact, int kCapacity>
LSDCD_FN void touch_meshes(const LawJob &job, const JointSphere &s, Touch<kCapacity> &of_mesh,
                           CornerRule<kCapacity> &rule, Touch<kCapacity> &all, int *end)
{
  Real tolerance = 0;
  all.exact_within = kAnyDistance;
  for (int k = s.begin; k < s.end; k++) {
    const MeshWork &mesh = job.joint.meshes[job.joint.mesh[k]];
    const QuerySphereWith<SpringsSeen> seen = seen_from<kBeyondContact>(job, s, k);
    const ListedFeatures list = {job.lists, static_cast<std::size_t>(k)};
    const bool holds = job.lists.n && job.lists.holds(k, seen.x, s.cutoff);
    if (job.lists.n && !holds) count_one(&job.counts->by_cells);
    of_mesh.set.clear();
    search<kBeyondContact>(mesh.grid, mesh.settings.search, seen, holds ? &list : nullptr, of_mesh);
    tolerance = fmax(tolerance, tolerance_of(mesh.grid));
    if (!of_mesh.set.overflow)
      add_mesh(mesh.settings.pose, of_mesh.set, tolerance, all.set, end, k - s.begin);
    all.set.overflow |= of_mesh.set.overflow;
    if (all.set.overflow) return;
    if (of_mesh.exact_within < all.exact_within) all.exact_within = of_mesh.exact_within;
    end[k - s.begin] = all.set.n;
  }
  share(job.settings.search, s.cutoff, tolerance, rule, all);
}
// A function of its own, so that it is compiled once however many laws there are.
template <bool kBeyondContact>
LSDCD_NOINLINE void touch_meshes(const LawJob &job, const JointSphere &s, Touch<kContacts> &all,
                                 int *end)
{
  Touch<kContacts> of_mesh;
  CornerRule<kContacts> rule;
  touch_meshes<kBeyondContact>(job, s, of_mesh, rule, all, end);
}
template <bool kBeyondContact>
LSDCD_NOINLINE void touch_meshes(const LawJob &job, const JointSphere &s, OverflowScratch &scratch,
                                 int *end)
{
  scratch.touch.set.clear();
  touch_meshes<kBeyondContact>(job, s, scratch.of_mesh, scratch.rule, scratch.touch, end);
}

// Applies the law to its contacts, in the frame of the mesh of each.
template <class Law, int kCapacity>
LSDCD_FN void apply_joint_law(const LawJob &job, const JointSphere &s, Touch<kCapacity> &all,
                              const int *end)
{
  for (int k = s.begin; k < s.end; k++) job.result.n_contacts[k] = 0;
  if (all.set.n == 0) {
    touches_nothing(job, s.begin, s.i);
    return;
  }
  int first = 0, n_done = 0;
  SphereSink sink = {};
  const int n_acting = count_acting(all.set.view(), all.weight);
  // What is kept of a contact is the same with all laws of a wall.
  if (!take_slots(law_with<Law>(job, s, job.joint.mesh[s.begin]), job, s.begin, n_acting, first,
                  sink)) {
    does_not_fit(job, s.begin, s.i, job.counts->no_slots);
    return;
  }
  for (int k = s.begin, from = 0; k < s.end; k++) {
    const int to = end[k - s.begin], n = to - from;
    if (n == 0) continue;
    const MeshWork &mesh = job.joint.meshes[job.joint.mesh[k]];
    const Law &law = law_with<Law>(job, s, job.joint.mesh[k]);
    const Pose &pose = mesh.settings.pose;
    for (int c = from; c < to; c++) all.set.normal[c] = pose.turn_to_mesh(all.set.normal[c]);
    const ContactsView set = {n, all.set.feature.data() + from, all.set.normal.data() + from,
                              all.set.distance.data() + from};

    const QuerySphereWith<SpringsSeen> seen = seen_from<Law::kBeyondContact>(job, s, k);
    SphereStateWith<SpringsSeen> state = {};
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
    if constexpr (Law::kRecords) to_mesh.records += n_done;
    if constexpr (Law::kHeat)
      if (law.has_heat()) {
        to_mesh.heat = job.heat + k;
        *to_mesh.heat = 0;
      }
    SphereResult out = {};
    add_contacts(mesh.grid, law, mesh.settings, state, set, all.weight + from, to_mesh, out);
    from = to;
    note_overlap(job, s.i, out.overlap_ratio);
    if (out.n_contacts == 0) continue;
    if constexpr (Law::kRecords) job.pool.slot[k] = first + n_done;
    if constexpr (Law::kHeat)
      if (law.has_heat()) job.heat_flow[s.i] += *to_mesh.heat;
    n_done += out.n_contacts;
    if (pose.placed) to_box(pose, out);
    give(job, k, s.i, s.x, out);
  }
  if constexpr (Law::kHistory)
    if (job.settings.update) {
      if (n_done > 0) job.pool.first[s.i] = first;
      job.pool.count[s.i] = n_done;
    }
}

template <class Law>
LSDCD_FN void joint_contacts(const LawJob &job, std::size_t g)
{
  const JointSphere s = joint_sphere<Law::kBeyondContact>(job, g);
  note_cutoff(job, s.i, s.cutoff);
  int end[kMaxMeshes];
  Touch<kContacts> some;
  touch_meshes<Law::kBeyondContact>(job, s, some, end);
  if (job.uncertain)
    for (int k = s.begin + 1; k < s.end; k++) job.uncertain[k] = 0;
  if (!some.set.overflow) {
    keep_uncertain(job, s.begin, may_miss(s.cutoff, some.exact_within), s.radius);
    apply_joint_law<Law>(job, s, some, end);
    return;
  }
  // As in several_contacts().
  for (bool done = false; !done;) {
    OverflowScratch *scratch = job.overflow + g % kOverflowScratches;
    if (!try_lock(&scratch->locked)) continue;
    touch_meshes<Law::kBeyondContact>(job, s, *scratch, end);
    if (!scratch->touch.set.overflow) {
      keep_uncertain(job, s.begin, may_miss(s.cutoff, scratch->touch.exact_within), s.radius);
      apply_joint_law<Law>(job, s, scratch->touch, end);
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
struct JointStep {
  LawJob job;

  static constexpr bool kSingle = false;
  static constexpr int kBlocksAtOnce = 2;    // its kernel has all registers that there are
  bool has_single() const { return false; }
  LSDCD_FN void begin() const { clear_next(job); }
  LSDCD_FN bool single(std::size_t) const { return false; }
  LSDCD_FN bool needs_list(std::size_t g) const
  {
    if (!job.lists.n) return false;
    const JointSphere s = joint_sphere<Law::kBeyondContact>(job, g);
    for (int k = s.begin; k < s.end; k++)
      if (!job.lists.holds(k, seen(s, k), s.cutoff)) return true;
    return false;
  }
  template <unsigned kSize>
  LSDCD_FN void make_list(const Warp<kSize> &warp, bool mine, std::size_t g) const
  {
    const JointSphere s = joint_sphere<Law::kBeyondContact>(job, g);
    for (int k = s.begin; warp.vote(mine && k < s.end); k++) {
      const bool in = mine && k < s.end;
      const Vec3 x = in ? seen(s, k) : Vec3{0, 0, 0};
      const bool due = in && !job.lists.holds(k, x, s.cutoff);
      for_each_distinct(warp, due, due ? job.joint.mesh[k] : 0, [&](bool of_mesh, int m) {
        put_list(job, warp, of_mesh, job.joint.meshes[m].grid, {x, s.radius, s.cutoff, nullptr, 0},
                 k);
      });
    }
  }
  LSDCD_FN bool several(std::size_t g) const
  {
    joint_contacts<Law>(job, g);
    return true;
  }
  // Where the mesh of slot k sees it.
  LSDCD_FN Vec3 seen(const JointSphere &s, int k) const
  {
    return seen_from<Law::kBeyondContact>(job, s, k).x;
  }
  LSDCD_FN const StepLists &step_lists() const { return job.step_lists; }
};

// Near spheres [0, n) of one mesh, or the joint spheres [0, n).
template <class Law, class Backend>
void run_compiled_law(const LawBytes &bytes, const LawJob &job, std::size_t n, Backend &backend)
{
  if constexpr (Law::kSurface)
    if (job.joint.meshes) {
      run_step(backend, n, JointStep<Law>{job});
      return;
    }
  run_step(backend, n, LawStep<Law>{bytes.as<Law>(), job});
}

}    // namespace lsdcd
