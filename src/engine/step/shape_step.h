// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step of grains that may be no spheres, on a CPU. Spheres are computed as in other steps, other grains by the signed distance from
// them.
#pragma once

#include "base/input_error.h"
#include "contact/grain_contacts.h"
#include "contact/grain_rule.h"
#include "contact/shape_passes.h"
#include "contact/shape_search.h"
#include "engine/step/grain_energy.h"
#include "engine/step/multi_mesh_step.h"
#include "engine/step/shape_law.h"
#include "engine/step/step_cpu.h"

#include <memory>
#include <vector>

namespace lsdcd {

// Returns the radius from which a law computes the size of a contact with this overlap: that of the mean curvature. For a flat side it
// is no larger than the radius of the sphere around the grain.
inline Real contact_curvature_radius(const Superellipsoid &shape, const Vec3 &own_point,
                                     Real overlap)
{
  const Real most = shape.farthest * (shape.farthest / overlap);
  const Real mean = curvature_at(shape, own_point).mean;
  return mean * most > 1 ? 1 / mean : most;
}

// Returns the radius that a law reads for a contact.
template <class Law>
Real radius_for(const Law &law, const Superellipsoid &shape, const Vec3 &own_point, Real overlap,
                Real radius)
{
  return law.reads_radius ? contact_curvature_radius(shape, own_point, overlap) : radius;
}

// The contacts of a grain that is no sphere, as SphereContacts has those of a sphere. Velocity and force are at the grain's point.
struct GrainContactsInStep : GrainContactsView {
  using Arm = const GrainContact *;

  template <class Law, class Springs>
  Transfer transfer(const GridView &grid, const Law &law, int i,
                    const SphereStateWith<Springs> &s) const
  {
    const OldGrainContacts<Springs> old = {s.springs, s.extra, n_stored(law), *at[i].metric};
    return transfer_of(grid.wall, view(), i, old, s.n_springs);
  }
  template <class Springs>
  Real reported_radius(const SphereStateWith<Springs> &) const
  {
    return shape->nearest;
  }
  template <class Law, class Springs>
  Real law_radius(const Law &law, int i, const SphereStateWith<Springs> &s) const
  {
    return radius_for(law, *shape, at[i].metric->to_own(at[i].arm), at[i].overlap, s.radius);
  }
  template <class Law, class Springs>
  Arm add_spin(const Law &, int i, const SphereStateWith<Springs> &s, Real away, const Vec3 &along,
               Contact &c) const
  {
    const Vec3 turning = cross(s.omega, at[i].arm);
    const Real turning_away = dot(turning, c.normal);
    c.v_normal = away + turning_away;
    c.v_tangent = along + (turning - turning_away * c.normal);
    return &at[i];
  }
  static void add_torque(Arm at, const Vec3 &, const Vec3 &force, const Vec3 &, Vec3 &torque)
  {
    torque += cross(at->arm, force) + at->couple;
  }
  static Real booked_distance(int, const Contact &c) { return c.radius; }
  static Real booked_arm(Arm, const Contact &c) { return c.overlap; }
  template <class Law, class Springs>
  void book(EnergyBook<Law> &book, const Law &law, const MeshFeaturesView &wall,
            const ForceSettings &settings, const SphereStateWith<Springs> &s, int i,
            const BookedContact<Law> &booked, const Transfer &in, EnergyMarks &marks,
            Real *to) const
  {
    add_grain(book, law, wall, settings, s, booked, at[i], in, marks, to);
  }

 private:
  const GrainContactsView &view() const { return *this; }
};
inline GrainContactsInStep contacts_in_step(const GrainContactsView &set)
{
  return {set};
}

// The memory of a thread for grains that are no spheres.
struct ShapeMemory {
  struct OfMesh {
    explicit OfMesh(const TriangleTree &tree) : search(tree), passes(tree) {}
    ShapeSearch search;
    ShapePasses passes;
  };
  std::vector<std::unique_ptr<OfMesh>> of_mesh;
  std::vector<PlacedGrain> placed;    // at each mesh
  std::vector<FoundGrainContact> found;
  std::vector<GrainContact> contacts;
  std::vector<GrainMetric> metric;
  std::vector<Real> weight;
  std::vector<SharingContact> sharing;
  std::vector<PassEnd> ends;
  GrainRule rule;
};
static_assert(GrainRule::kMost == kMaxContacts, "all contacts of a grain share");

// Finds the contacts of a grain, mesh after mesh, each in the frame of its mesh, and applies the law.
template <class Law, class Sphere>
class ShapeAtMeshes {
 public:
  ShapeAtMeshes(const StepJob &job, const Sphere &sphere, ShapeWork &work, int *ends,
                ShapeMemory &memory) :
      job_(job),
      sphere_(sphere), work_(work), row_(work.rows[sphere.i]), shape_(work.shape[sphere.i]),
      centre_(sphere.in_box()), ends_(ends), memory_(memory)
  {
  }

  void run()
  {
    find();
    const int n = static_cast<int>(memory_.contacts.size());
    if (n > kMaxContacts) {
      does_not_fit(job_, sphere_.begin(), sphere_.i, job_.counts->no_scratch);
      return;
    }
    if (n > 0) share();
    apply_law<Law>(job_, sphere_, GrainContactsView{n, memory_.contacts.data(), &shape_},
                   memory_.weight.data());
  }

 private:
  const ForceSettings &settings(int m) const { return sphere_.mesh(sphere_.begin() + m).settings; }

  void find()
  {
    const int n = sphere_.n_meshes();
    memory_.contacts.clear();
    memory_.metric.resize(n);
    memory_.placed.resize(n);
    tolerance_ = 0;
    for (int m = 0; m < n; m++) {
      find_at(m);
      ends_[m] = static_cast<int>(memory_.contacts.size());
    }
  }
  void find_at(int m)
  {
    const ForceSettings &of = settings(m);
    tolerance_ = std::fmax(tolerance_, sphere_.mesh(sphere_.begin() + m).grid.tolerance);
    GrainMetric &metric = memory_.metric[m];
    metric = metric_of(row_, of.pose);
    PlacedGrain &grain = memory_.placed[m];
    grain = {shape_, of.pose.to_mesh(centre_), {metric.row[0], metric.row[1], metric.row[2]}};
    if (memory_.of_mesh.size() <= of.mesh) memory_.of_mesh.resize(of.mesh + 1);
    std::unique_ptr<ShapeMemory::OfMesh> &with = memory_.of_mesh[of.mesh];
    if (!with) with = std::make_unique<ShapeMemory::OfMesh>(*work_.trees[of.mesh]);
    memory_.found.clear();
    NearList &near = work_.near[job_.first_slot + sphere_.begin() + m];
    if (!near.holds(grain.centre, shape_.farthest)) {
      near.from = grain.centre;
      near.reach = (1 + kWay) * shape_.farthest;
      with->search.find_near(grain, near.reach, near.features);
    }
    with->search.contacts(grain, near.features, memory_.found);
    for (const FoundGrainContact &c : memory_.found) {
      const Vec3 arm = c.of_grain - grain.centre;
      add({c.feature, c.normal, -c.distance, arm, c.point, metric.direction(c.normal, arm),
           &metric},
          m);
    }
  }

  // Adds a contact of mesh m, unless an earlier mesh has the same one.
  void add(const GrainContact &c, int m)
  {
    std::vector<GrainContact> &all = memory_.contacts;
    const auto seen = [&](const GrainContact &of, int mesh) -> MeshContact {
      return {of.feature, -of.overlap, settings(mesh).pose.to_box(of.foot)};
    };
    if (outlasts_earlier(
            seen(c, m), tolerance_, ends_, m, [&](int b) { return seen(all[b], mesh_of(b)); },
            [&](int b) { all.erase(all.begin() + b); }))
      all.push_back(c);
  }
  int mesh_of(int contact) const
  {
    int m = 0;
    while (ends_[m] <= contact) m++;
    return m;
  }

  // Gives each contact its weight by the corner rule, and its part of the couples.
  void share()
  {
    const std::size_t n = memory_.contacts.size();
    memory_.weight.assign(n, 1);
    memory_.sharing.clear();
    bool is_deep = false;
    for (const GrainContact &c : memory_.contacts) {
      is_deep |= c.overlap >= shape_.rho;
      memory_.sharing.push_back(
          {c.feature, -c.metric->to_own(c.normal), c.metric->to_own(c.arm), c.overlap});
    }
    if (is_deep) check_depths();
    if (n < 2 || settings(0).search.corner != Corner::blend) return;
    memory_.rule.begin(shape_, memory_.sharing);
    for (int m = 0, first = 0; m < sphere_.n_meshes(); first = ends_[m++]) add_passes(m, first);
    memory_.rule.solve(tolerance_, memory_.weight.data());
    add_couples();
  }

  // Makes contacts with mesh m, from `first` on, fade if they end at a fold.
  void add_passes(int m, int first)
  {
    if (ends_[m] - first < 2) return;
    memory_.ends.clear();
    for (int c = first; c < ends_[m]; c++) {
      const SharingContact &at = memory_.sharing[c];
      memory_.ends.push_back({at.feature, at.overlap, at.normal, at.point});
    }
    ShapePasses &passes = memory_.of_mesh[settings(m).mesh]->passes;
    bool has_begun = false;
    for (std::size_t i = 0; i < memory_.ends.size(); i++) {
      const Real overlap = memory_.ends[i].overlap;
      Real above = overlap;
      for (const PassEnd &other : memory_.ends)
        above = std::fmin(above, overlap_without_fade(overlap, other.overlap));
      if (!(above < overlap)) continue;    // no pass is deeper
      if (!has_begun) passes.begin(memory_.placed[m], memory_.ends);
      has_begun = true;
      const std::vector<Real> &pass = passes.find(i, std::fmax(above, Real(0)));
      for (std::size_t j = 0; j < pass.size(); j++)
        if (pass[j] > 0)
          memory_.rule.add_pass(first + static_cast<int>(i), first + static_cast<int>(j), pass[j]);
    }
  }

  // Adds the couple of any two contacts that bear, half of it to each, with the mean of their stiffnesses.
  void add_couples()
  {
    const int n = static_cast<int>(memory_.contacts.size());
    const auto pressed = [&](int i) { return memory_.weight[i] * memory_.contacts[i].overlap; };
    for (int i = 1; i < n; i++)
      for (int j = 0; j < i; j++) {
        const Vec3 &couple = memory_.rule.couple(i, j);
        if (couple == Vec3{0, 0, 0} || !(pressed(i) > 0 && pressed(j) > 0)) continue;
        const Real both = std::sqrt(stiffness(i) * stiffness(j)) * pressed(i) * pressed(j);
        for (const int c : {i, j})
          memory_.contacts[c].couple += memory_.contacts[c].metric->turned(both / 2 * couple);
      }
  }
  // Returns the elastic force of a contact divided by its overlap.
  Real stiffness(int contact) const
  {
    const GrainContact &at = memory_.contacts[contact];
    const Law &law = sphere_.mesh(sphere_.begin() + mesh_of(contact)).law;
    Contact c = {};
    c.normal = at.normal;
    c.overlap = at.overlap;
    c.radius = radius_for(law, shape_, memory_.sharing[contact].point, at.overlap, sphere_.radius);
    c.mass = 1;
    ContactMemory<Law::kExtra> memory = {};
    return law.evaluate(c, memory).normal / at.overlap;
  }

  // Records the depth of contacts that are at least as deep as the least radius of curvature, divided by the depth that is allowed.
  void check_depths()
  {
    for (std::size_t i = 0; i < memory_.contacts.size(); i++)
      if (memory_.contacts[i].overlap >= shape_.rho)
        raise_to(&work_.sharpest, DeepestOverlap::ratio(memory_.contacts[i].overlap / limit_of(i)) |
                                      (sphere_.i + 1));
  }
  // Returns how deep a contact may be so that the force does not jump where it ends: the radius of curvature of the grain's shadow
  // across the fold or edge; length.
  Real limit_of(std::size_t i) const
  {
    const GrainContact &c = memory_.contacts[i];
    const SharingContact &at = memory_.sharing[i];
    Real limit = HUGE_VAL;
    const auto limit_along = [&](const Vec3 &along) {
      const Real size = norm(along);
      if (size > kParallel)
        limit = std::fmin(limit,
                          shadow_radius(shape_, at.normal, cross(at.normal, (1 / size) * along)));
    };
    if (feature_kind(c.feature) == FeatureKind::vertex)
      limit = 1 / curvature_at(shape_, at.point).largest();
    if (feature_kind(c.feature) == FeatureKind::edge) {
      const TreeView &view = work_.trees[settings(mesh_of(static_cast<int>(i))).mesh]->view();
      const int *ends = view.edges + 2 * feature_index(c.feature);
      const Vec3 along = view.vertices[ends[1]] - view.vertices[ends[0]];
      limit_along((1 / norm(along)) * c.metric->to_own(along));
    }
    for (const SharingContact &other : memory_.sharing)
      if (dot(at.normal, other.normal) > 0) limit_along(cross(at.normal, other.normal));
    return limit;
  }
  static constexpr Real kParallel = 1e-9;    // an angle

  // How far the grain moves until its list is made again, as a share of the radius of the sphere around it.
  static constexpr Real kWay = 0.2;

  const StepJob &job_;
  const Sphere &sphere_;
  ShapeWork &work_;
  const GrainShape &row_;
  const Superellipsoid &shape_;
  const Vec3 centre_;    // in the box
  int *ends_;            // ends of the contacts of each mesh
  ShapeMemory &memory_;
  Real tolerance_ = 0;
};

// A step of grains. StepOfSpheres is a MeshStep or a MultiMeshStep, which does the grains that are spheres.
template <class Law, class StepOfSpheres>
struct ShapeStep {
  const Law &law;
  StepOfSpheres spheres;

  static constexpr bool kFastPath = false;
  struct Memory {
    typename StepOfSpheres::Memory of_spheres;
    ShapeMemory of_shapes;
  };

  const StepJob &job() const { return spheres.job; }
  bool is_sphere(std::size_t k) const
  {
    const auto slot = job().multi_mesh.meshes ? job().multi_mesh.first[k] : k;
    return law.work->is_sphere(sphere_of(job(), slot));
  }
  bool has_fast_path() const { return false; }
  void begin() const { spheres.begin(); }
  bool fast_path(std::size_t) const { return false; }
  bool needs_list(std::size_t k) const { return is_sphere(k) && spheres.needs_list(k); }
  template <unsigned kSize>
  void make_list(const Warp<kSize> &warp, bool mine, std::size_t k) const
  {
    spheres.make_list(warp, mine, k);
  }
  void general_path(std::size_t k, Memory &memory) const
  {
    if (is_sphere(k)) {
      spheres.general_path(k, memory.of_spheres);
      return;
    }
    int ends[kMaxMeshes];
    if (job().multi_mesh.meshes) {
      const MultiMeshSphere s = multi_mesh_sphere<false>(job(), k);
      for (int slot = s.begin; slot < s.end; slot++) job().result.n_contacts[slot] = 0;
      check_radius(s.begin, s.i, s.radius);
      run(AtMeshes<Law>{job(), s, ends, s.i, s.radius}, ends, memory.of_shapes);
    } else {
      const std::size_t i = sphere_of(job(), k);
      check_radius(k, i, job().radius[i]);
      run(OneMeshSphere<Law>{law, job(), k, i, centre_of<Law>(job(), i), job().radius[i]}, ends,
          memory.of_shapes);
    }
  }

 private:
  // Notes that the grain of a candidate-mesh pair is larger than the reach of the grid, or than it was at the candidate search.
  void check_radius(std::size_t slot, std::size_t i, Real radius) const
  {
    check_cutoff(job(), i, radius);
    if (job().lists.n && radius > job().lists.cutoff(slot))
      raise_to(&job().counts->grown, kNoSphere - i);
  }
  template <class Sphere>
  void run(const Sphere &sphere, int *ends, ShapeMemory &memory) const
  {
    try {
      ShapeAtMeshes<Law, Sphere>(job(), sphere, *law.work, ends, memory).run();
    } catch (const InputError &) {
      raise_to(&law.work->unsure, kNoSphere - sphere.i);
      put_no_contact(job(), sphere.begin(), sphere.i);
    }
  }
};

// Runs a step of n candidates by the law with these bytes, for the engine.
template <class Law, class Backend>
void run_shape_law(const LawBytes &bytes, const StepJob &job, std::size_t n, Backend &backend)
{
  const Law &law = bytes.as<Law>();
  if (job.multi_mesh.meshes)
    run_step(backend, n, ShapeStep<Law, MultiMeshStep<Law>>{law, {job}});
  else
    run_step(backend, n, ShapeStep<Law, MeshStep<Law>>{law, {law, job}});
}

}    // namespace lsdcd
