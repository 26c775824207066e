// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// An engine for atoms in float (KOKKOS_PREC mixed or single): our engines read and write double, so that this one gives
// them arrays of its own. Doubles of a float are exact, so that the contacts and forces are those of the positions given.
//
// Steps copy candidates only, which are few; where spheres are chosen anew, all are copied.
#pragma once

#include "host_kokkos.h"

#include "backend/owned_array.h"
#include "engine/candidates_in_place.h"
#include "engine/forwarding_engine.h"

#include <utility>
#include <vector>

namespace lsdcd {

// The arrays of a host's atoms, and the same in double.
struct FloatAtoms {
  StridedView<const float> x, v, omega;
  const float *radius, *mass;
  Real *own_x, *own_v, *own_omega, *own_radius, *own_mass;
};

enum class FloatArrays { all, positions, radii };

// Copies those of atom index[k], or of atom k, to double.
struct ToDouble {
  FloatAtoms atoms;
  FloatArrays arrays;
  const int *index;    // null: all
  int n;               // atoms

  static KOKKOS_INLINE_FUNCTION void copy(const StridedView<const float> &from, int i, Real *to)
  {
    const float *p = from.of(i);
    for (int d = 0; d < 3; d++) to[3 * i + d] = static_cast<Real>(p[d * from.column]);
  }
  KOKKOS_INLINE_FUNCTION void operator()(const int k) const
  {
    const int i = index ? index[k] : k;
    if (i >= n) return;    // of a choice that holds no more
    if (arrays != FloatArrays::radii) copy(atoms.x, i, atoms.own_x);
    if (arrays != FloatArrays::positions) atoms.own_radius[i] = static_cast<Real>(atoms.radius[i]);
    if (arrays != FloatArrays::all) return;
    copy(atoms.v, i, atoms.own_v);
    copy(atoms.omega, i, atoms.own_omega);
    atoms.own_mass[i] = static_cast<Real>(atoms.mass[i]);
  }
};

// Adds the vector of atom index[k] in double to that of the host, which is in float, or in double (mixed), and leaves 0.
// Atoms that are several times among the candidates, as those near several meshes, are added once.
template <class Number>
struct AddForces {
  StridedView<Number> to;
  Real *from;
  const int *index;
  int n;

  KOKKOS_INLINE_FUNCTION void operator()(const int k) const
  {
    const int i = index[k];
    if (i >= n) return;
    Number *p = to.of(i);
    for (int d = 0; d < 3; d++) {
      const Real more = Kokkos::atomic_exchange(from + 3 * i + d, Real(0));
      Number &sum = p[d * to.column];
      if (more != 0) sum = static_cast<Number>(static_cast<Real>(sum) + more);
    }
  }
};

// Atoms: AtomKokkos, or what has its arrays.
template <class DeviceType, class Atoms>
class FloatAtomsEngine : public ForwardingEngine {
 public:
  // `engine` computes where DeviceType has the atoms. `deepest` gets the largest overlap (length) of the steps that
  // read_diagnostics() reads. Both outlive this.
  FloatAtomsEngine(std::unique_ptr<WallEngine> engine, Atoms *atoms, Real *deepest) :
      ForwardingEngine(std::move(engine)), chosen_(dynamic_cast<CandidatesInPlace &>(*engine_)),
      atoms_(atoms), deepest_(deepest)
  {
  }

  // The host asks for this before a step whose candidates are likely to be chosen anew.
  Real largest_radius(const Spheres &spheres) override
  {
    copy(FloatArrays::radii);
    all_are_due_ = true;
    return engine_->largest_radius(in_double(spheres));
  }
  Real farthest_past(const Spheres &spheres, const PeriodicFaces &faces) override
  {
    copy(FloatArrays::positions);
    return engine_->farthest_past(in_double(spheres), faces);
  }

  void choose(const Spheres &spheres, Real margin, bool watch) override
  {
    if (!all_are_there_) {
      copy(FloatArrays::all);
      // The engine may be on a stream of its own.
      if (when_ != When::in_turn)
        typename DeviceType::execution_space().fence("lsdcd: atoms in double");
      all_are_there_ = true;
    }
    is_watching_ = watch;
    engine_->choose(in_double(spheres), margin, watch);
  }
  bool has_moved(const Spheres &spheres) override { return engine_->has_moved(in_double(spheres)); }

  void begin(When when) override
  {
    when_ = when;
    all_are_there_ = all_are_due_;
    if (all_are_due_) {
      copy(FloatArrays::all);
    } else {
      copy(FloatArrays::all, chosen_.candidates(), engine_->n_candidates());
      if (is_watching_) copy(FloatArrays::positions);
    }
    all_are_due_ = false;
    engine_->begin(when);
    state_ = engine_->state();
  }
  void submit(const Spheres &spheres, const StepSettings &step) override
  {
    engine_->submit(in_double(spheres), step);
    state_ = engine_->state();
    if (when_ == When::beside_adding_early) add_forces();
  }
  void collect() override
  {
    engine_->collect();
    state_ = engine_->state();
    if (when_ != When::beside_adding_early) add_forces();
  }

  StepDiagnostics read_diagnostics() override
  {
    const StepDiagnostics seen = engine_->read_diagnostics();
    if (seen.deepest_sphere >= 0) {
      Real radius = 0;
      Kokkos::deep_copy(radius, Kokkos::subview(radius_, seen.deepest_sphere));
      *deepest_ = std::max(*deepest_, seen.deepest * radius);
    }
    return seen;
  }

  std::size_t bytes() const override
  {
    return engine_->bytes() +
           sizeof(Real) * (x_.size() + v_.size() + omega_.size() + force_.size() + torque_.size() +
                           radius_.size() + mass_.size());
  }

 private:
  using Numbers = Kokkos::View<Real *, DeviceType>;
  using Policy = Kokkos::RangePolicy<typename DeviceType::execution_space>;

  void make_room()
  {
    const std::size_t n = static_cast<std::size_t>(atoms_->nlocal);
    if (radius_.extent(0) >= n && n > 0) return;
    const std::size_t room = with_spare(n) + 1;
    const auto numbers = [](const char *name, std::size_t count) {
      return Numbers(std::string("lsdcd:") + name, count);
    };
    x_ = numbers("x", 3 * room);
    v_ = numbers("v", 3 * room);
    omega_ = numbers("omega", 3 * room);
    radius_ = numbers("radius", room);
    mass_ = numbers("mass", room);
    force_ = numbers("force", 3 * room);
    torque_ = numbers("torque", 3 * room);
  }

  // `index`: of these `count` atoms; null: of all.
  void copy(FloatArrays arrays, const int *index = nullptr, int count = -1)
  {
    make_room();
    const int n = atoms_->nlocal;
    if (count < 0) count = n;
    const FloatAtoms atoms = {rows_of(atoms_->k_x.template view<DeviceType>()),
                              rows_of(atoms_->k_v.template view<DeviceType>()),
                              rows_of(atoms_->k_omega.template view<DeviceType>()),
                              atoms_->k_radius.template view<DeviceType>().data(),
                              atoms_->k_rmass.template view<DeviceType>().data(),
                              x_.data(),
                              v_.data(),
                              omega_.data(),
                              radius_.data(),
                              mass_.data()};
    Kokkos::parallel_for("lsdcd:to_double", Policy(0, count), ToDouble{atoms, arrays, index, n});
  }

  void add_forces()
  {
    add_forces(rows_of(atoms_->k_f.template view<DeviceType>()), force_);
    add_forces(rows_of(atoms_->k_torque.template view<DeviceType>()), torque_);
  }
  template <class Number>
  void add_forces(const StridedView<Number> &to, const Numbers &from)
  {
    Kokkos::parallel_for("lsdcd:add_forces", Policy(0, engine_->n_candidates()),
                         AddForces<Number>{to, from.data(), chosen_.candidates(), atoms_->nlocal});
  }

  // Masses of rigid bodies, groups and types are where the host says.
  Spheres in_double(const Spheres &spheres) const
  {
    Spheres own = spheres;
    own.x = x_.data();
    own.v = v_.data();
    own.omega = omega_.data();
    own.radius = radius_.data();
    if (!own.mass) own.mass = mass_.data();
    own.force = force_.data();
    own.torque = torque_.data();
    return own;
  }

  CandidatesInPlace &chosen_;    // by engine_
  Atoms *atoms_;
  Real *deepest_;
  Numbers x_, v_, omega_, radius_, mass_;
  Numbers force_, torque_;    // 0 but between a step's forces and add_forces()
  bool all_are_due_ = false, all_are_there_ = false, is_watching_ = false;
  When when_ = When::in_turn;    // of the step that was begun
};

}    // namespace lsdcd
