// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/sub_models.h"

#include "base/input_words.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace lsdcd {

namespace {

// ---- numbers of several rows -------------------------------------------------------------

// The powers keep stresses and velocities: lengths and times grow by L, forces by L^2, masses and energies by L^3.
constexpr Parameter share(const char *name, Real least = 0, Real most = Tokens::kHuge,
                          bool may_be_null = false, const char *property = nullptr)
{
  return Parameter{name, "1", least, most, may_be_null, property}.to_power(0);
}

constexpr Parameter kStiffness = Parameter{"kn", "force/length"}.to_power(1);
constexpr Parameter kHertzStiffness = Parameter{"kn", "force/length^2"}.to_power(0);
constexpr Parameter kEta = Parameter{"eta|e", "of the damping"}.to_power(kPowerOfDamping);
constexpr Parameter kEtaAlone = Parameter{"eta", "of the damping"}.to_power(kPowerOfDamping);
constexpr Parameter kYoung = Parameter{"E", "force/length^2", kAboveZero}.to_power(0);
constexpr Parameter kPoisson = share("nu", -1 + 1e-12, 0.5);
constexpr Parameter kSurfaceEnergy = Parameter{"gamma", "energy/length^2"}.to_power(1);
constexpr Parameter kXgammat = share("xgammat");
constexpr Parameter kMu = share("mu", 0, Tokens::kHuge, false, "sliding_friction");
constexpr Parameter kSpring = Parameter{"kt", "force/length"}.to_power(1);
constexpr Parameter kMindlin =
    Parameter{"kt", "force/length^2", 0, Tokens::kHuge, true}.to_power(0);
constexpr Parameter kMindlinDashpot = share("xgammat", 0, Tokens::kHuge, true);
constexpr Parameter kRollingFriction = share("mu", 0, Tokens::kHuge, false, "rolling_friction");
constexpr Parameter kRollingDamping = share("damping", 0, Tokens::kHuge, false, "rolling_damping");
constexpr Parameter kMuRolling = share("MU", 0, Tokens::kHuge, false, "rolling_friction");
constexpr Parameter kRollingStiffness = share("stiffness");
constexpr Parameter kRollingSpring = Parameter{"k", "force/length"}.to_power(1);
constexpr Parameter kRollingDashpot = Parameter{"gamma", "mass/time"}.to_power(2);
constexpr Parameter kTwistingSpring = Parameter{"k", "torque/angle"}.to_power(3);
constexpr Parameter kTwistingDashpot = Parameter{"gamma", "torque time/angle"}.to_power(4);
constexpr Parameter kTwistingLimit = Parameter{"mu", "length"}.to_power(1);
// The conductivity of a bed stays, though not the flow through a grain over its heat: n grains in a row conduct 1/n times as much, and
// those that are L times as large are 1/L as many in a length.
constexpr Parameter kConductivity =
    Parameter{"k", "power/(length temperature)", 0, Tokens::kHuge, false, "thermal_conductivity"}
        .to_power(0);
constexpr Parameter kTransfer = Parameter{"h", "power/(length^2 temperature)"}.to_power(-1);
constexpr Parameter kCohesion =
    Parameter{"K", "energy/volume", 0, Tokens::kHuge, false, "cohesion_energy_density"}.to_power(0);

// Of cohesion that acts beyond touch.
constexpr Parameter kSurfaceTension =
    Parameter{"gamma", "force/length", 0, Tokens::kHuge, false, "surface_tension"}.to_power(1);
constexpr Parameter kContactAngle =
    Parameter{"theta", "degrees", 0, 90, false, "contact_angle"}.to_power(0).mixed_by(
        Mixing::first);
constexpr Parameter kOtherAngle =
    Parameter{"theta2", "degrees", 0, 90, true, "contact_angle"}.to_power(0).mixed_by(
        Mixing::second);
constexpr Parameter kBridgeVolume =
    Parameter{"V", "volume", kAboveZero, Tokens::kHuge, false, "bridge_volume"}.to_power(3);
constexpr Parameter kBridgeShare =
    share("C", kAboveZero, Tokens::kHuge, false, "bridge_volume_share");
constexpr Parameter kConstantPull =
    Parameter{"F0", "force", 0, Tokens::kHuge, false, "adhesive_force"}.to_power(2);
constexpr Parameter kWeightShare = share("f", 0, Tokens::kHuge, false, "adhesive_force_fraction");
constexpr Parameter kGravity = Parameter{"g", "force/mass"}.to_power(-1);
constexpr Parameter kPullingSpring =
    Parameter{"K", "force/length", 0, Tokens::kHuge, false, "adhesive_stiffness"}
        .to_power(1)
        .mixed_by(Mixing::series);
constexpr Parameter kPullingGap =
    Parameter{"delta", "length", kAboveZero, Tokens::kHuge, false, "adhesive_distance"}.to_power(1);

// Of normal sub-models that yield.
constexpr Parameter kLoading =
    Parameter{"k1", "force/length", kAboveZero}.to_power(1).mixed_by(Mixing::series);
constexpr Parameter kSteepest =
    Parameter{"kp", "force/length", kAboveZero}.to_power(1).mixed_by(Mixing::series);
constexpr Parameter kPulling = Parameter{"kc", "force/length"}.to_power(1).mixed_by(Mixing::series);
constexpr Parameter kLoadingByPower = Parameter{"k1", "force/length^n", kAboveZero}
                                          .to_power(kPowerByExponent)
                                          .mixed_by(Mixing::series);
constexpr Parameter kModulusInSeries =
    Parameter{"Y", "pressure", kAboveZero}.to_power(0).mixed_by(Mixing::series);
constexpr Parameter kYieldStrength =
    Parameter{"Y", "pressure", kAboveZero}.to_power(0).mixed_by(Mixing::least);
constexpr Parameter kYieldPressure =
    Parameter{"py", "pressure", kAboveZero}.to_power(0).mixed_by(Mixing::least);
constexpr Parameter kOwnRestitution = share("e", kAboveZero, 1);
constexpr Parameter kPlasticity = share("lambda", 0, 1 - 1e-12);
constexpr Parameter kElasticDepth = share("phi", kAboveZero, 1);
constexpr Parameter kSlopeExponent =
    Parameter{"n", "1 or 1.5", 1, 1.5}.to_power(0).mixed_by(Mixing::equal);
constexpr Parameter kTensileExponent =
    Parameter{"chi", "multiple of 0.5", 1, 10}.to_power(0).mixed_by(Mixing::equal);
constexpr Parameter kPullOff = Parameter{"f0", "force", -Tokens::kHuge, 0}.to_power(2);

// Of kn and kt, and of gamman and gammat.
struct ClassicPowers {
  int stiffness, damping;
};

std::vector<Parameter> classic_numbers(const char *stiffness, const char *damping,
                                       ClassicPowers powers)
{
  const Parameter kn = {"kn", stiffness}, kt = {"kt", stiffness, 0, Tokens::kHuge, true};
  const Parameter gamman = {"gamman", damping},
                  gammat = {"gammat", damping, 0, Tokens::kHuge, true},
                  dampflag = {"dampflag", "0 or 1", 0, 1, false, nullptr, true};
  return {kn.to_power(powers.stiffness),   kt.to_power(powers.stiffness),
          gamman.to_power(powers.damping), gammat.to_power(powers.damping),
          share("xmu", 0, 10000),          dampflag.to_power(0)};
}

// ---- what numbers mean -------------------------------------------------------------------

// The defaults are those of `fix wall/gran`.
template <NormalModel normal, bool history>
void set_classic(const Real *n, LawDraft &d)
{
  d.law = classic_law(normal, history);
  d.law.k_normal = n[0];
  d.law.k_tangent = std::isnan(n[1]) ? n[0] * 2 / 7 : n[1];
  d.law.eta = n[2];
  d.law.gamma_tangent = std::isnan(n[3]) ? n[2] / 2 : n[3];
  d.law.mu = n[4];
  if (n[5] == 0) d.law.gamma_tangent = 0;
}

template <NormalModel model>
void set_stiffness(const Real *n, LawDraft &d)
{
  d.law.normal = model;
  d.law.k_normal = n[0];
  d.second = n[1];
}

// Effective modulus of a sphere and a wall of one material, as LAMMPS has it since 2023.
template <NormalModel model>
void set_material(const Real *n, LawDraft &d)
{
  d.law.normal = model;
  d.young = n[0];
  d.second = n[1];
  d.poisson = n[2];
  d.law.modulus = d.young / (2 * (1 - d.poisson * d.poisson));
  d.law.k_normal = Real(4) / 3 * d.law.modulus;
  if (model != NormalModel::hertz) d.law.surface_energy = n[3];
}

// The loading stiffness is the first number times the factor. A contact that yields by itself has no dashpot.
template <NormalModel model, int factor>
void set_hysteretic(const Real *n, LawDraft &d)
{
  d.law.normal = model;
  d.law.damping = DampingModel::none;
  d.damping_name = "none";
  d.law.plastic[0] = factor * n[0];
  d.law.plastic[1] = n[1];
}

// The third number is the plasticity ratio, from which the stiffness of unloading follows.
void set_eepa(const Real *n, LawDraft &d)
{
  d.law.normal = NormalModel::eepa;
  d.law.damping = DampingModel::stiffness;
  d.damping_name = "coeff_restitution";
  d.second = n[1];
  const Real numbers[] = {n[0], n[0] / (1 - n[2]), n[3], n[4], n[5], n[6]};
  std::copy(std::begin(numbers), std::end(numbers), d.law.plastic);
}

void set_lepa(const Real *n, LawDraft &d)
{
  d.law.normal = NormalModel::lepa;
  d.law.damping = DampingModel::velocity;
  d.damping_name = "velocity";
  d.second = n[1];
  const Real numbers[] = {n[0], n[2], n[3], n[4]};
  std::copy(std::begin(numbers), std::end(numbers), d.law.plastic);
}

void set_thornton(const Real *n, LawDraft &d)
{
  set_material<NormalModel::hertz>(n, d);
  d.law.normal = NormalModel::thornton;
  d.law.plastic[0] = d.law.modulus;
  d.law.plastic[1] = n[3];
}

// The numbers of a bridge: without an angle of the other surface both have the same.
template <CohesionModel model>
void set_bridge(const Real *n, LawDraft &d)
{
  d.law.cohesion = {model, {n[0], n[1], std::isnan(n[2]) ? n[1] : n[2], n[3]}};
}

template <DampingModel model>
void set_damping(const Real *, LawDraft &d)
{
  d.law.damping = model;
}

template <TangentialModel model>
void set_slip(const Real *n, LawDraft &d)
{
  d.law.tangential = model;
  d.law.xgammat = n[0];
  d.law.mu = n[1];
}

// NULL for kt: 8 G of the contact of a sphere and a wall of one material. NULL for xgammat: the ratio of the dashpots
// of LIGGGHTS, which damp a motion along the contact by the restitution, too.
template <TangentialModel model>
void set_spring(const Real *n, LawDraft &d)
{
  d.law.tangential = model;
  d.law.k_tangent = std::isnan(n[0]) ? 8 * d.young / (4 * (2 - d.poisson) * (1 + d.poisson)) : n[0];
  d.law.xgammat = std::isnan(n[1]) ? std::sqrt(d.law.k_tangent / (2 * d.law.modulus)) : n[1];
  d.law.mu = n[2];
}

// ---- the table ---------------------------------------------------------------------------

// The number of a model in its family's enum.
template <class Enum>
constexpr int at(Enum model)
{
  return static_cast<int>(model);
}

constexpr Stored kNothing = {};
constexpr Stored kPlasticOverlap = {"plastic overlap", 1};
constexpr Stored kShear = {"shear displacement"}, kShearForce = {"shear force"};

enum Style { hooke, hooke_history, hertz_history };

std::vector<SubModel> make_table()
{
  using F = Family;
  using N = NormalModel;
  using D = DampingModel;
  using T = TangentialModel;
  using R = RollingModel;
  using W = TwistingModel;
  using H = HeatModel;
  using C = CohesionModel;
  constexpr auto copied = nullptr;
  // clang-format off
  return {
      // The styles of LAMMPS before `granular`; their formulas are those of 29Sep2021.
      {F::style, "hooke", Style::hooke, classic_numbers("force/length", "1/time", {1, -1}),
       set_classic<N::hooke, false>, kNothing, "",
       "linear spring, viscous friction (Silbert et al. 2001)"},
      {F::style, "hooke/history", Style::hooke_history, classic_numbers("force/length",
       "1/time", {1, -1}), set_classic<N::hooke, true>, kShear, "",
       "linear springs along and across the normal (Silbert et al. 2001)"},
      {F::style, "hertz/history", Style::hertz_history, classic_numbers("pressure",
       "1/(time length)", {0, -2}), set_classic<N::hertz, true>, kShear, "hertz stiffness",
       "springs that stiffen with the contact radius (Brilliantov et al. 1996)"},

      {F::normal, "hooke", at(N::hooke), {kStiffness, kEta}, set_stiffness<N::hooke>,
       kNothing, "linear spring", "linear spring"},
      {F::normal, "hertz", at(N::hertz), {kHertzStiffness, kEta}, set_stiffness<N::hertz>,
       kNothing, "hertz spring", "elastic sphere on a plane (Hertz 1882)"},
      {F::normal, "hertz/material", at(N::hertz), {kYoung, kEta, kPoisson},
       set_material<N::hertz>, kNothing, "hertz spring", "hertz of one material"},
      {F::normal, "dmt", at(N::dmt), {kYoung, kEtaAlone, kPoisson, kSurfaceEnergy},
       set_material<N::dmt>, kNothing, "dmt adhesion",
       "hertz less a constant pull (Derjaguin, Muller and Toporov 1975)"},
      {F::normal, "jkr", at(N::jkr), {kYoung, kEtaAlone, kPoisson, kSurfaceEnergy},
       set_material<N::jkr>, kNothing, "jkr adhesion",
       "adhesion that holds past touch (Johnson, Kendall and Roberts 1971)"},

      {F::normal, "hysteretic", at(N::hysteretic), {kLoading, kOwnRestitution},
       set_hysteretic<N::hysteretic, 1>, kPlasticOverlap, "yielding",
       "spring that unloads stiffer, with a restitution e at all speeds (Walton and Braun 1986; Rocky)"},
      {F::normal, "hysteretic/size", at(N::hysteretic_size), {kModulusInSeries, kOwnRestitution},
       set_hysteretic<N::hysteretic_size, 2>, kPlasticOverlap, "yielding",
       "hysteretic with k1 = 2 Y R (Rocky)"},
      {F::normal, "hysteretic/edem", at(N::hysteretic_edem), {kYieldStrength, kOwnRestitution},
       set_hysteretic<N::hysteretic_edem, 5>, kPlasticOverlap, "yielding",
       "hysteretic with k1 = 5 Y R, of the lesser yield strength (EDEM)"},
      {F::normal, "eepa", at(N::eepa), {kLoadingByPower, kEta, kPlasticity, kSurfaceEnergy, kSlopeExponent,
       kTensileExponent, kPullOff}, set_eepa,
       {"plastic overlap of eepa, adhesive slope", 2}, "yielding and adhesion",
       "elasto-plastic adhesion (Edinburgh: Thakur et al. 2014; EDEM)"},
      {F::normal, "lepa", at(N::lepa), {kLoading, kEtaAlone, kSteepest, kPulling, kElasticDepth},
       set_lepa, {"greatest overlap of lepa", 1}, "yielding and adhesion",
       "linear elasto-plastic adhesion (Luding 2008)"},
      {F::normal, "thornton", at(N::thornton), {kYoung, kEtaAlone, kPoisson, kYieldPressure}, set_thornton,
       {"greatest overlap of thornton", 1}, "yielding", "elastic, perfectly plastic sphere (Thornton 1997)"},

      {F::damping, "none", at(D::none), {}, set_damping<D::none>, kNothing, "", "none",
       0},
      {F::damping, "velocity", at(D::velocity), {}, set_damping<D::velocity>, kNothing,
       "normal damping", "eta v", 2},
      {F::damping, "mass_velocity", at(D::mass_velocity), {}, set_damping<D::mass_velocity>,
       kNothing, "normal damping", "eta m v", -1},
      {F::damping, "viscoelastic", at(D::viscoelastic), {}, set_damping<D::viscoelastic>,
       kNothing, "normal damping", "eta m a v (Brilliantov et al. 1996)", -2},
      {F::damping, "tsuji", at(D::stiffness), {}, set_damping<D::stiffness>, kNothing,
       "normal damping", "restitution e, by a fit (Tsuji, Tanaka and Ishida 1992)", 0},
      {F::damping, "coeff_restitution", at(D::stiffness), {}, set_damping<D::stiffness>,
       kNothing, "normal damping", "restitution e, exactly (Brilliantov et al. 1996)", 0},

      {F::tangential, "linear_nohistory", at(T::linear_nohistory), {kXgammat, kMu},
       set_slip<T::linear_nohistory>, kNothing, "", "viscous friction"},
      {F::tangential, "linear_nohistory_liggghts", at(T::linear_nohistory_liggghts), {kXgammat, kMu},
       set_slip<T::linear_nohistory_liggghts>, kNothing, "midpoint friction",
       "linear_nohistory at the middle of the overlap (LIGGGHTS)"},
      {F::tangential, "linear_history", at(T::linear_history), {kSpring,
       kXgammat, kMu}, set_spring<T::linear_history>, kShear, "tangential spring",
       "linear spring (Luding 2008)"},
      {F::tangential, "linear_history_slip", at(T::linear_history_slip), {kSpring,
       kXgammat, kMu}, set_spring<T::linear_history_slip>, kShear, "tangential spring",
       "linear_history, its spring cut alone"},
      {F::tangential, "linear_history_liggghts", at(T::linear_history_liggghts), {kSpring,
       kXgammat, kMu}, set_spring<T::linear_history_liggghts>, kShear, "tangential spring",
       "linear_history, without its dashpot while it slips (LIGGGHTS)"},
      {F::tangential, "mindlin", at(T::mindlin), {kMindlin, kXgammat, kMu},
       set_spring<T::mindlin>, kShear, "tangential spring",
       "spring that stiffens with the contact radius (Mindlin 1949)"},
      {F::tangential, "mindlin/force", at(T::mindlin_force), {kMindlin, kXgammat, kMu},
       set_spring<T::mindlin_force>, kShearForce, "tangential spring",
       "mindlin that keeps the force"},
      {F::tangential, "mindlin_slip", at(T::mindlin_slip), {kMindlin, kXgammat, kMu},
       set_spring<T::mindlin_slip>, kShear, "tangential spring",
       "mindlin, its spring cut alone"},
      {F::tangential, "mindlin_liggghts", at(T::mindlin_liggghts), {kMindlin, kMindlinDashpot, kMu},
       set_spring<T::mindlin_liggghts>, kShear, "tangential spring",
       "mindlin, without its dashpot while it slips (LIGGGHTS)"},
      {F::tangential, "mindlin_rescale", at(T::mindlin_rescale), {kMindlin, kXgammat, kMu},
       set_spring<T::mindlin_rescale>, {"shear displacement, contact radius", 1,
       "rescaling on unloading"}, "tangential spring",
       "mindlin that shrinks as the contact unloads (Thornton et al. 2013)"},
      {F::tangential, "mindlin_rescale/force", at(T::mindlin_rescale_force), {kMindlin,
       kXgammat, kMu}, set_spring<T::mindlin_rescale_force>, {"shear force, contact radius", 1,
       "rescaling on unloading"}, "tangential spring", "mindlin_rescale that keeps the force"},

      {F::rolling, "none", at(R::none), {}, copied, kNothing, "", "none"},
      {F::rolling, "sds", at(R::sds), {kRollingSpring, kRollingDashpot, kRollingFriction}, copied, {"rolling displacement", 3},
       "rolling resistance", "spring, dashpot, slider (Luding 2008; Wang et al. 2015)"},
      {F::rolling, "cdt", at(R::cdt), {kMuRolling}, copied, kNothing, "rolling cdt",
       "constant torque (LIGGGHTS; Ai et al. 2011)"},
      {F::rolling, "epsd2", at(R::epsd2), {kMuRolling}, copied, {"rolling torque", 3, nullptr, true},
       "rolling epsd2", "elastic-plastic spring (LIGGGHTS; Ai et al. 2011)"},
      {F::rolling, "epsd", at(R::epsd), {kMuRolling, kRollingDamping}, copied, {"rolling torque of epsd", 3,
       nullptr, true}, "rolling epsd", "elastic-plastic spring and dashpot (LIGGGHTS; Ai et al. 2011)"},
      {F::rolling, "epsd3", at(R::epsd3), {kMuRolling, kRollingDamping, kRollingStiffness}, copied,
       {"rolling torque of epsd3", 3, nullptr, true}, "rolling epsd3",
       "epsd with a number for its 2.25 (LIGGGHTS)"},

      {F::twisting, "none", at(W::none), {}, copied, kNothing, "", "none"},
      {F::twisting, "marshall", at(W::marshall), {}, copied, {"twist angle of marshall", 1},
       "twisting resistance", "spring, dashpot, slider by the tangential ones (Marshall 2009)"},
      {F::twisting, "sds", at(W::sds), {kTwistingSpring, kTwistingDashpot, kTwistingLimit}, copied, {"twist angle of sds", 1},
       "twisting resistance", "spring, dashpot, slider (Luding 2008)"},

      {F::heat, "none", at(H::none), {}, copied, kNothing, "", "none"},
      {F::heat, "radius", at(H::radius), {kConductivity}, copied, kNothing, "heat conduction",
       "2 k a dT (Vargas and McCarthy 2001)"},
      {F::heat, "area", at(H::area), {kTransfer}, copied,
       kNothing, "heat conduction", "h pi a^2 dT"},

      {F::cohesion, "sjkr", at(C::sjkr), {kCohesion}, copied, kNothing,
       "cohesion sjkr", "K times the area of contact (LIGGGHTS)"},
      {F::cohesion, "capillary", at(C::capillary), {kSurfaceTension, kContactAngle, kOtherAngle, kBridgeVolume},
       set_bridge<C::capillary>, kNothing, "cohesion capillary",
       "liquid bridge of constant volume, from touch to its rupture (Willett et al. 2000)"},
      {F::cohesion, "capillary/share", at(C::capillary_share), {kSurfaceTension, kContactAngle, kOtherAngle, kBridgeShare},
       set_bridge<C::capillary_share>, kNothing, "cohesion capillary",
       "capillary with V = C times the volume of the grains"},
      {F::cohesion, "constant", at(C::constant), {kConstantPull, kPullingGap}, copied, kNothing,
       "cohesion constant", "constant pull up to a gap delta (Rocky)"},
      {F::cohesion, "constant/weight", at(C::constant_weight), {kWeightShare, kGravity, kPullingGap}, copied, kNothing,
       "cohesion constant", "constant with F0 = f m g of the lighter grain (Rocky)"},
      {F::cohesion, "linear", at(C::linear), {kPullingSpring, kPullingGap}, copied, kNothing,
       "cohesion linear", "pull that grows by K from a gap delta on (Rocky)"},
  };
  // clang-format on
}

const SubModel &find_row(Family family, int model)
{
  for (const SubModel &row : sub_models())
    if (row.family == family && row.model == model) return row;
  throw std::logic_error("sub_models.cpp has no row of this sub-model");
}

}    // namespace

const std::vector<SubModel> &sub_models()
{
  static const std::vector<SubModel> table = make_table();
  return table;
}

std::vector<const SubModel *> sub_models(Family family)
{
  std::vector<const SubModel *> rows;
  for (const SubModel &row : sub_models())
    if (row.family == family) rows.push_back(&row);
  return rows;
}

std::string names_text(Family family)
{
  std::string names;
  for (const SubModel *row : sub_models(family))
    names += (names.empty() ? "" : "|") + std::string(row->name);
  return names;
}

bool is_beside_style(Family family)
{
  return family == Family::rolling || family == Family::cohesion;
}

const char *family_word(Family family)
{
  const char *const words[] = {"",        "",         "damping", "tangential",
                               "rolling", "twisting", "heat",    "cohesion"};
  return words[static_cast<int>(family)];
}

std::vector<const SubModel *> rows_of(const ContactLaw &law)
{
  std::vector<const SubModel *> rows;
  const auto add = [&rows](Family family, int model) { rows.push_back(&find_row(family, model)); };
  if (law.is_classic()) {
    const bool history = law.tangential == TangentialModel::linear_history_classic;
    add(Family::style, law.is(NormalModel::hertz) ? Style::hertz_history
                       : history                  ? Style::hooke_history
                                                  : Style::hooke);
  } else {
    add(Family::normal, at(law.normal));
    add(Family::damping, at(law.damping));
    add(Family::tangential, at(law.tangential));
  }
  if (law.rolling.is_on()) add(Family::rolling, at(law.rolling.model));
  if (law.twisting.is_on()) add(Family::twisting, at(law.twisting.model));
  if (law.heat.is_on()) add(Family::heat, at(law.heat.model));
  if (law.cohesion.is_on()) add(Family::cohesion, at(law.cohesion.model));
  return rows;
}

std::string sub_models_text(const ContactLaw &law)
{
  std::string text;
  for (const SubModel *row : rows_of(law)) {
    const std::string family = family_word(row->family);
    text += (text.empty() ? "" : ", ") + (family.empty() ? "" : family + " ") + row->name;
  }
  return text;
}

std::string parameters_text(const SubModel &row)
{
  std::string text;
  for (const Parameter &p : row.parameters)
    text += (text.empty() ? "" : " ") + std::string(p.name) + (p.may_be_null ? "|NULL" : "");
  return text;
}

std::string syntax_of(const SubModel &row)
{
  const std::string numbers = parameters_text(row);
  return row.name + (numbers.empty() ? "" : " " + numbers);
}

}    // namespace lsdcd
