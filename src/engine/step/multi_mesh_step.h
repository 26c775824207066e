// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step over multi-mesh spheres, which are candidates of more than one mesh: their contacts with all of these meshes share their
// overlap in the same way as contacts with one mesh.
#pragma once

#include "engine/step/mesh_step.h"

namespace lsdcd {

// The springs of a sphere in the frame of one mesh: springs of other meshes are turned to that frame.
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

// A multi-mesh sphere in the frame of the box. It has one candidate-mesh pair (slot) for each mesh.
struct MultiMeshSphere {
  int begin, end;
  std::size_t i;
  int kind;    // index into the wall's laws
  Vec3 x;
  Real radius, cutoff;    // cutoff: the largest of its meshes
};

template <class Law>
LSDCD_FN const Law &law_with(const StepJob &job, const MultiMeshSphere &s, int mesh)
{
  return job.multi_mesh.laws.of(mesh, s.kind).law.in_kernel<Law>();
}

// Returns the distance from which the sphere feels a mesh.
template <bool kBeyondContact>
LSDCD_FN Real cutoff_with(const StepJob &job, const MultiMeshSphere &s, int mesh)
{
  if constexpr (kBeyondContact)
    return cutoff_of(s.radius, job.multi_mesh.laws.of(mesh, s.kind).reach);
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

// Returns the query for the sphere in the frame of the mesh of candidate-mesh pair k.
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
  if constexpr (kBeyondContact)
    if (job.multi_mesh.laws.of(mesh, s.kind).reach.of == LawReach::Of::near)
      seen.radius = seen.cutoff;
  return seen;
}

// A contact of a sphere with a mesh.
struct MeshContact {
  FeatureCode feature;
  Real distance;    // length; below 0: an overlap
  Vec3 closest;     // its closest point, or the vector from it to a point common to all
};

// Returns whether a contact of the n-th mesh is kept beside those of the meshes before it, which end at `end`. Two contacts with
// the same closest point count as one. The nearer one is kept; if both are equally near, a face before an edge before a vertex; if
// these are equal, too, the contact of the earlier mesh. Calls remove(b) for contacts that are dropped, and the others keep their
// order. at(b) returns a MeshContact.
template <class At, class Remove>
LSDCD_FN bool outlasts_earlier(const MeshContact &later, Real tolerance, int *end, int n,
                               const At &at, const Remove &remove)
{
  for (int b = n > 0 ? end[n - 1] - 1 : -1; b >= 0; b--) {
    const MeshContact earlier = at(b);
    if (!is_same_point(earlier.closest - later.closest, tolerance)) continue;
    if (!(later.distance < earlier.distance ||
          (later.distance == earlier.distance &&
           feature_kind(later.feature) < feature_kind(earlier.feature))))
      return false;
    for (int m = 0; m < n; m++)
      if (end[m] > b) end[m]--;
    remove(b);
  }
  return true;
}

// Removes contact c; the others keep their order.
template <int kCapacity>
LSDCD_FN void remove_contact(ContactSet<kCapacity> &all, int c)
{
  all.n--;
  for (; c < all.n; c++) {
    all.feature[c] = all.feature[c + 1];
    all.normal[c] = all.normal[c + 1];
    all.distance[c] = all.distance[c + 1];
  }
}

// Adds the contacts of the n-th mesh to those of the meshes before it, which end at `end`. `turn` turns their normals to the frame
// of the others.
template <int kCapacity, class Turn>
LSDCD_FN void add_mesh(const Turn &turn, const ContactSet<kCapacity> &of_mesh, Real tolerance,
                       ContactSet<kCapacity> &all, int *end, int n)
{
  for (int c = 0; c < of_mesh.n; c++) {
    const Vec3 normal = turn(of_mesh.normal[c]);
    const Real distance = of_mesh.distance[c];
    if (outlasts_earlier(
            {of_mesh.feature[c], distance, distance * normal}, tolerance, end, n,
            [&](int b) -> MeshContact {
              return {all.feature[b], all.distance[b], all.distance[b] * all.normal[b]};
            },
            [&](int b) { remove_contact(all, b); }))
      all.add(of_mesh.feature[c], normal, distance);
  }
}

// Finds the contacts of the sphere with their weights, mesh after mesh, in the frame of each: those of candidate-mesh pair begin +
// k end at end[k]. This is a function of its own, so that it is compiled once however many laws there are. If only one mesh is
// touched, all is computed in its frame, as in a MeshStep: whether the sphere is also a candidate of others depends on the time of
// the candidate search, and must change no bit.
template <bool kBeyondContact, class Memory, int kCapacity>
LSDCD_NOINLINE void narrow_phase_of_meshes(const StepJob &job, const MultiMeshSphere &s,
                                           Memory &memory, WeightedContacts<kCapacity> &all,
                                           int *end)
{
  WeightedContacts<kCapacity> &of_mesh = memory.of_mesh;
  Real tolerance = 0, cutoff = 0;    // the largest of the meshes that are touched
  int touched = -1;                  // candidate-mesh pair of the first of these meshes
  bool in_box = false;               // more than one is touched: normals are in the box's frame
  const auto pose_of = [&](int k) -> const Pose & {
    return job.multi_mesh.meshes[job.multi_mesh.mesh[k]].settings.pose;
  };
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
    if (of_mesh.set.n > 0 && !of_mesh.set.overflow) {
      tolerance = fmax(tolerance, mesh.grid.tolerance);
      cutoff = fmax(cutoff, seen.cutoff);
      if (touched >= 0 && !in_box) {
        for (int c = 0; c < all.set.n; c++)
          all.set.normal[c] = pose_of(touched).turn_to_box(all.set.normal[c]);
        in_box = true;
      }
      if (touched < 0) touched = k;
      const auto turn = [&](const Vec3 &n) { return in_box ? pose_of(k).turn_to_box(n) : n; };
      add_mesh(turn, of_mesh.set, tolerance, all.set, end, k - s.begin);
    }
    all.set.overflow |= of_mesh.set.overflow;
    if (all.set.overflow) return;
    if (of_mesh.exact_within < all.exact_within) all.exact_within = of_mesh.exact_within;
    end[k - s.begin] = all.set.n;
  }
  share_overlap(job.settings.search, cutoff, tolerance, memory.rule, all);
  if (!in_box) return;
  for (int k = s.begin, c = 0; k < s.end; k++)
    for (; c < end[k - s.begin]; c++)
      all.set.normal[c] = pose_of(k).turn_to_mesh(all.set.normal[c]);
}

// A multi-mesh sphere and its contacts, for apply_law(): those of candidate-mesh pair begin + k end at ends[k].
template <class Law>
struct AtMeshes {
  static constexpr bool kSeveral = true;
  const StepJob &job;
  const MultiMeshSphere &s;
  const int *ends;
  std::size_t i;
  Real radius;

  LSDCD_FN int begin() const { return s.begin; }
  LSDCD_FN int n_meshes() const { return s.end - s.begin; }
  LSDCD_FN LawAtMesh<Law> mesh(int k) const
  {
    const int m = job.multi_mesh.mesh[k];
    const MeshWork &work = job.multi_mesh.meshes[m];
    return {law_with<Law>(job, s, m), work.grid, work.settings};
  }
  LSDCD_FN SphereStateWith<SpringsInFrame> state(const Law &law, int k) const
  {
    const QuerySphereWith<SpringsInFrame> seen = in_frame_of<Law::kBeyondContact>(job, s, k);
    SphereStateWith<SpringsInFrame> state = {};
    state.x = seen.x;
    state.radius = radius;
    state.springs = seen.springs;
    state.n_springs = seen.n_springs;
    if constexpr (Law::kStoresExtra)
      if (seen.n_springs > 0)
        state.extra = job.springs.extra + std::size_t(job.springs.first[i]) * n_stored(law);
    return state;
  }
  LSDCD_FN Vec3 in_box() const { return s.x; }
  LSDCD_FN int contacts_end(int k, int) const { return ends[k - s.begin]; }
};

// Does multi-mesh sphere g with any number of contacts.
template <class Law>
LSDCD_FN void multi_mesh_contacts(const StepJob &job, std::size_t g, MultiMeshMemory &memory)
{
  const MultiMeshSphere s = multi_mesh_sphere<Law::kBeyondContact>(job, g);
  check_cutoff(job, s.i, s.cutoff);
  if (job.uncertain)
    for (int k = s.begin + 1; k < s.end; k++) job.uncertain[k] = 0;
  for (int k = s.begin; k < s.end; k++) job.result.n_contacts[k] = 0;
  int ends[kMaxMeshes];
  auto find = [&](auto &with, auto &contacts) {
    narrow_phase_of_meshes<Law::kBeyondContact>(job, s, with, contacts, ends);
  };
  const AtMeshes<Law> sphere = {job, s, ends, s.i, s.radius};
  apply_to_all<Law>(job, sphere, g, s.cutoff, memory, find);
}

// The multi-mesh spheres, for run_step(): all take general_path().
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
  // Returns the centre in the frame of the mesh of candidate-mesh pair k.
  LSDCD_FN Vec3 centre_in_frame(const MultiMeshSphere &s, int k) const
  {
    return in_frame_of<Law::kBeyondContact>(job, s, k).x;
  }
  LSDCD_FN const WorkLists &work_lists() const { return job.work_lists; }
};

}    // namespace lsdcd
