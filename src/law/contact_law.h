// The parameters of a contact law, as numbers: what input words become.
#pragma once

#include "base/real.h"

namespace lsdcd {

enum class LawStyle { hooke, hooke_history, hertz_history, granular };

enum class NormalModel { hooke, hertz, dmt, jkr };
enum class DampingModel { none, velocity, mass_velocity, viscoelastic, stiffness };
enum class TangentialModel {
  linear_nohistory,
  linear_history,
  mindlin,
  mindlin_force,
  mindlin_rescale,
  mindlin_rescale_force
};
enum class TwistingModel { none, marshall, sds };
enum class HeatModel { none, radius, area };

// The sub-models of `granular`, with what follows from material constants filled in.
struct GranularLaw {
  NormalModel normal = NormalModel::hooke;
  Real k_normal = 0;    // force/length (hooke), force/length^2 (others)
  Real modulus = 0;     // of the contact, 3/4 k_normal; force/length^2 (dmt, jkr)
  Real cohesion = 0;    // surface energy, energy/length^2 (dmt, jkr)

  DampingModel damping = DampingModel::viscoelastic;
  Real eta = 0;    // mass/time, 1/time, 1/(time length), or none (stiffness)

  TangentialModel tangential = TangentialModel::linear_nohistory;
  Real k_tangent = 0;    // force/length (linear), force/length^2 (mindlin)
  Real x_tangent = 0;    // tangential damping per normal damping
  Real mu = 0;           // sliding friction coefficient

  bool rolling = false;
  Real k_roll = 0;        // force/length
  Real gamma_roll = 0;    // mass/time
  Real mu_roll = 0;       // rolling friction coefficient

  TwistingModel twisting = TwistingModel::none;
  Real k_twist = 0;        // torque/angle (sds)
  Real gamma_twist = 0;    // torque time/angle (sds)
  Real mu_twist = 0;       // length (sds)

  HeatModel heat = HeatModel::none;
  Real conductance =
      0;    // power/(length temperature) (radius), power/(length^2 temperature) (area)
};

// Of LIGGGHTS; beside one of the classic styles.
enum class AddedRolling { none, cdt, epsd2 };
struct AddedEffects {
  AddedRolling rolling = AddedRolling::none;
  Real mu_roll = 0;     // rolling friction coefficient
  Real cohesion = 0;    // energy/length^3 (sjkr); 0: none

  bool any() const { return rolling != AddedRolling::none || cohesion > 0; }
};

struct ContactLaw {
  LawStyle style = LawStyle::hooke;

  // The classic styles, after NULLs and unit conversion are resolved.
  Real k_normal = 0;         // force/length (hooke), force/length^2 (hertz)
  Real k_tangent = 0;        // same dimensions as k_normal
  Real gamma_normal = 0;     // 1/time (hooke), 1/(time length) (hertz)
  Real gamma_tangent = 0;    // same dimensions as gamma_normal; 0 where dampflag is 0
  Real mu = 0;               // friction coefficient

  GranularLaw granular;    // where style is granular
  AddedEffects added;      // where it is not
  bool limit_damping = false;

  bool is(NormalModel model) const
  {
    return style == LawStyle::granular && granular.normal == model;
  }
  bool has_rolling() const { return style == LawStyle::granular && granular.rolling; }
  bool has_twisting() const
  {
    return style == LawStyle::granular && granular.twisting != TwistingModel::none;
  }
  bool has_heat() const { return style == LawStyle::granular && granular.heat != HeatModel::none; }
  bool has_rescale() const
  {
    return style == LawStyle::granular && granular.tangential >= TangentialModel::mindlin_rescale;
  }
  // Is anything kept from step to step? Adhesion past touch is: it holds what touched.
  bool has_history() const
  {
    if (style != LawStyle::granular)
      return style != LawStyle::hooke || added.rolling == AddedRolling::epsd2;
    return granular.tangential != TangentialModel::linear_nohistory || is(NormalModel::jkr) ||
           has_rolling() || has_twisting();
  }
  // Numbers kept beside a contact's tangential spring.
  int n_extra() const
  {
    const bool rolled = has_rolling() || added.rolling == AddedRolling::epsd2;
    return 3 * rolled + has_twisting() + has_rescale();
  }
  // The distance past touch at which adhesion lets go of a sphere of radius 1;
  // it goes with the cube root of the radius. 0: nothing acts past touch.
  Real pull_off() const;
};

// Damping per root of mass times secant stiffness that returns the restitution e.
// tsuji: a fit for Hertz contacts, right to 1.1e-3 (Tsuji, Tanaka and Ishida 1992), whose
// mass is that of one of two equal spheres, twice the effective one: hence its root 2.
// The other is exact: for hooke, and (Brilliantov et al. 1996) for Hertz contacts.
Real tsuji_damping(Real e);
Real restitution_damping(NormalModel normal, Real e);

// How far from its centre a sphere can feel the wall.
Real cutoff_of(const ContactLaw &law, Real radius);

}    // namespace lsdcd
