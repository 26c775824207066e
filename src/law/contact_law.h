// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A contact law: one sub-model of each family and its numbers. sub_models.h has the table of all.
#pragma once

#include "law/reach.h"
#include "law/submodels/cohesion.h"
#include "law/submodels/damping.h"
#include "law/submodels/heat.h"
#include "law/submodels/normal.h"
#include "law/submodels/plastic.h"
#include "law/submodels/rolling.h"
#include "law/submodels/tangential.h"
#include "law/submodels/twisting.h"

namespace lsdcd {

constexpr int kMaxNumbers = 4;    // of a sub-model that may be left out

// A sub-model that may be left out, and its numbers in the order of its row.
template <class Model>
struct Chosen {
  Model model = Model::none;
  Real numbers[kMaxNumbers] = {};

  bool is_on() const { return model != Model::none; }
  Chosen &operator=(Model other)    // the numbers stay
  {
    model = other;
    return *this;
  }
};

// The numbers of a law, after NULLs and units are resolved. The default is the style `hooke`.
struct ContactLaw {
  NormalModel normal = NormalModel::hooke;
  Real k_normal = 0;          // force/length (hooke), force/length^2 (others)
  Real modulus = 0;           // of the contact, 3/4 k_normal; force/length^2 (dmt, jkr)
  Real surface_energy = 0;    // energy/length^2 (dmt, jkr)
  // The numbers of a normal sub-model that yields, in the order of its model (plastic.h). Its k_normal is 0.
  Real plastic[kPlasticNumbers] = {};

  DampingModel damping = DampingModel::classic;
  Real eta = 0;    // see DampingModel

  TangentialModel tangential = TangentialModel::linear_nohistory_classic;
  Real k_tangent = 0;        // force/length (linear), force/length^2 (mindlin, hertz/history)
  Real gamma_tangent = 0;    // 1/time, or 1/(time length) (hertz/history); 0 but in classic styles
  Real xgammat = 0;          // tangential damping per normal damping; 0 in classic styles
  Real mu = 0;               // sliding friction coefficient

  Chosen<RollingModel> rolling;
  Chosen<TwistingModel> twisting;
  Chosen<HeatModel> heat;
  Chosen<CohesionModel> cohesion;

  bool limit_damping = false;
  // The law acts on grains that may be no spheres, too: a contact with a history keeps the arm of its grain.
  bool for_shapes = false;
  // A contact keeps its forces for the next step (KeptForces), in which the energy balance needs them.
  bool keeps_forces = false;
  // A contact also keeps KeptAtNodes.
  bool keeps_at_nodes = false;
  // A contact also keeps KeptLosses, behind all other numbers. Histories with KeptLosses and without are of one kind.
  bool keeps_losses = false;
  // A contact that keeps nothing else keeps that it touched, so that the next step knows which contacts begin.
  bool keeps_touch = false;

  bool is(NormalModel model) const { return normal == model; }
  // Returns whether the law is one of LAMMPS's styles before `granular`, which have formulas of their own.
  bool is_classic() const { return damping == DampingModel::classic; }
  bool has_heat() const { return heat.is_on(); }
  bool is_adhesive() const { return facts_of(normal).is_adhesive; }
  // Returns whether cohesion acts beyond touch.
  bool reaches() const { return acts_beyond_touch(cohesion.model); }
  // Returns whether contacts yield, and keep how far.
  bool yields() const { return facts_of(normal).yields; }
  // Returns whether the tangential spring shrinks as the contact unloads.
  bool rescales() const { return tangential >= TangentialModel::mindlin_rescale; }
  // Returns whether friction stretches a spring, in a law of `granular`.
  bool has_spring() const { return tangential >= TangentialModel::linear_history; }
  // Returns whether friction is that of LIGGGHTS, at the middle of the overlap.
  bool is_at_midpoint() const
  {
    return tangential == TangentialModel::linear_nohistory_liggghts ||
           tangential == TangentialModel::linear_history_liggghts ||
           tangential == TangentialModel::mindlin_liggghts;
  }
  // Returns whether the law has rolling or cohesion beside a classic style, or a sub-model of LIGGGHTS in `granular`. Such laws are
  // compiled in groups of their own.
  bool is_extended() const
  {
    const bool rolls = rolling.is_on() && (is_classic() || rolling.model != RollingModel::sds);
    return rolls || cohesion.is_on() || is_at_midpoint();
  }

  // Returns whether a contact has a history. With adhesion beyond contact it has one, because only what has touched is held.
  bool has_history() const;
  // Returns how many numbers a contact's history has beside its shear displacement.
  int n_extra() const;
  // Returns which of the numbers of a contact's history change sign where the two spheres of a pair change places: bit k is
  // of the k-th, the shear displacement first, then vectors, then scalars.
  unsigned flips() const;
  // Returns a number for restart files. It is equal for laws whose histories mean the same.
  int history_kind() const;

  // Returns how far beyond touch the law acts.
  LawReach reach() const;
};

// Returns the law of `hooke`, `hooke/history` or `hertz/history`, without numbers.
ContactLaw classic_law(NormalModel normal, bool history);
// Returns the law of `granular` with its default damping and linear_nohistory, without numbers.
ContactLaw granular_law(NormalModel normal);

// Returns the damping, per square root of mass times secant stiffness, that gives the restitution e. tsuji: a fit for
// Hertz contacts, right to 1.1e-3 (Tsuji, Tanaka and Ishida 1992). Their mass is that of one of two equal spheres, twice
// the effective mass: hence the root of 2. The other is exact for hooke and for Hertz contacts (Brilliantov et al. 1996).
Real tsuji_damping(Real e);
Real restitution_damping(NormalModel normal, Real e);

// Returns how far from its centre a sphere can feel the wall.
Real cutoff_of(const ContactLaw &law, Real radius);

}    // namespace lsdcd
