// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/make_law.h"

#include "base/input_words.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

bool gives_restitution(const ContactLaw &law)
{
  switch (law.damping) {
    case DampingModel::none:
    case DampingModel::velocity:
    case DampingModel::mass_velocity:
    case DampingModel::viscoelastic:
    case DampingModel::classic:
      return false;
    case DampingModel::stiffness:
      break;
  }
  return law.eta != 0;
}

bool rolls_with_part_of_critical(const ContactLaw &law)
{
  switch (law.rolling.model) {
    case RollingModel::none:
    case RollingModel::sds:
    case RollingModel::cdt:
    case RollingModel::epsd2:
      return false;
    case RollingModel::epsd:
    case RollingModel::epsd3:
      break;
  }
  return law.rolling.numbers[1] != 0;
}

// Throws LawError where the numbers of a normal sub-model that yields, or its damping, do not go together.
void check_yielding(const LawDraft &d)
{
  const ContactLaw &law = d.law;
  const std::string name = "'" + std::string(d.normal_name) + "'";
  const Real *const n = law.plastic;
  switch (law.normal) {
    case NormalModel::hysteretic:
    case NormalModel::hysteretic_size:
    case NormalModel::hysteretic_edem:
      if (law.damping != DampingModel::none)
        throw LawError("damping", name +
                                      " has no number for a damping, as its e is that of yielding: "
                                      "leave the damping out, or write 'damping none'");
      return;
    case NormalModel::eepa:
      if (n[3] != 1 && n[3] != 1.5)
        throw LawError("normal", "n = " + number_text(n[3]) + ", which must be 1 or 1.5");
      if (2 * n[4] != std::floor(2 * n[4]))
        throw LawError("normal",
                       "chi = " + number_text(n[4]) +
                           ", which must be a multiple of 0.5: 1, 1.5, 2 and so on, up to 10");
      if (d.damping_name == std::string("tsuji"))
        throw LawError("damping", "tsuji is a fit for Hertz contacts: write 'damping "
                                  "coeff_restitution', which " +
                                      name + " has by default");
      return;
    case NormalModel::lepa:
      if (n[1] < n[0])
        throw LawError("normal", "kp = " + number_text(n[1]) +
                                     " is below k1 = " + number_text(n[0]) +
                                     ": unloading cannot be softer than loading");
      return;
    default:
      return;
  }
}

// Returns a stiffness of loading that holds grains apart at any overlap; 0: the model has none that is so low at small overlaps.
Real linear_stiffness(const ContactLaw &law)
{
  if (law.is(NormalModel::hooke)) return law.k_normal;
  const bool is_linear = law.is(NormalModel::hysteretic) || law.is(NormalModel::lepa) ||
                         (law.is(NormalModel::eepa) && law.plastic[3] == 1);
  return is_linear ? law.plastic[0] : 0;
}

// Throws LawError where a cohesion that acts beyond touch does not go with the law.
void check_cohesion(const LawDraft &d)
{
  const ContactLaw &law = d.law;
  if (!law.reaches()) return;
  if (law.is_classic())
    throw LawError("cohesion", "a cohesion that acts beyond touch goes with the sub-models of "
                               "granular, such as hooke and hertz, and not with the styles hooke, "
                               "hooke/history and hertz/history: write 'granular hooke ...'");
  if (law.is(NormalModel::jkr))
    throw LawError("cohesion", "'jkr' acts beyond touch itself, and does so without a second pull: "
                               "take another normal sub-model, such as hertz/material or dmt");
  const Real k = linear_stiffness(law), pull = law.cohesion.numbers[0];
  if (law.cohesion.model == CohesionModel::linear && k > 0 && pull >= k)
    throw LawError("cohesion", "K = " + number_text(pull) + " of 'linear' is not below " +
                                   number_text(k) +
                                   ", the stiffness of loading, so that nothing holds the grains "
                                   "apart: make it a small part of that");
}

template <class Model>
void choose(Chosen<Model> &chosen, const SubModel &row, const std::vector<Real> &given)
{
  chosen.model = static_cast<Model>(row.model);
  std::copy(given.begin(), given.end(), chosen.numbers);
}

}    // namespace

void add_sub_model(const SubModel &row, const std::vector<Real> &given, LawDraft &draft)
{
  if (row.family == Family::normal) draft.normal_name = row.name;
  if (row.family == Family::damping) draft.damping_name = row.name;
  if (row.set) return row.set(given.data(), draft);
  switch (row.family) {
    case Family::rolling:
      return choose(draft.law.rolling, row, given);
    case Family::twisting:
      return choose(draft.law.twisting, row, given);
    case Family::heat:
      return choose(draft.law.heat, row, given);
    default:
      return choose(draft.law.cohesion, row, given);
  }
}

bool can_derive(const SubModel &row, const LawDraft &draft)
{
  return row.family == Family::style || row.family == Family::cohesion || draft.young != 0;
}

void finish_law(LawDraft &d)
{
  if (!d.law.is_classic()) return finish_granular(d);
  check_cohesion(d);
}

void finish_granular(LawDraft &d)
{
  ContactLaw &law = d.law;
  const bool adhesive = law.is_adhesive();
  const std::string normal = "'" + std::string(d.normal_name) + "'";
  if (law.limit_damping && adhesive)
    throw LawError("limit_damping", "the adhesive sub-model " + normal +
                                        " must be able to pull: leave limit_damping out");
  if (law.rolling.model == RollingModel::epsd2 && !law.has_spring())
    throw LawError("rolling", "epsd2 has the stiffness of the tangential sub-model: take one with "
                              "a history, or epsd");
  check_yielding(d);
  check_cohesion(d);
  // The damping says what the second number of the normal sub-model is.
  law.eta = d.second;
  if (law.damping != DampingModel::stiffness) return;
  if (facts_of(law.normal).no_rebound == 0)
    throw LawError("damping",
                   "the damping (tsuji or coeff_restitution) takes a restitution, which no damping "
                   "returns with the " +
                       std::string(adhesive ? "adhesive " : "") + "sub-model " + normal +
                       ": take another one");
  const bool exact = d.damping_name == std::string("coeff_restitution");
  if (d.second > 1 || (exact && d.second == 0))
    throw LawError("damping", "e = " + number_text(d.second) +
                                  " is out of range: it must be above 0 and at most 1, as the "
                                  "second number of the normal sub-model is the restitution");
  law.eta = exact ? restitution_damping(law.normal, d.second) : tsuji_damping(d.second);
}

const SubModel &damping_of(const std::vector<GivenSubModel> &sub_models)
{
  for (const GivenSubModel &given : sub_models)
    if (given.row->family == Family::damping) return *given.row;
  LawDraft draft = {granular_law(NormalModel::hooke)};
  add_sub_model(*sub_models.front().row, sub_models.front().numbers, draft);
  const std::vector<const SubModel *> rows = lsdcd::sub_models(Family::damping);
  return **std::find_if(rows.begin(), rows.end(), [&](const SubModel *row) {
    return row->name == std::string(draft.damping_name);
  });
}

ContactLaw make_law(const std::vector<GivenSubModel> &sub_models, bool limit_damping)
{
  LawDraft draft = {granular_law(NormalModel::hooke)};
  for (const GivenSubModel &given : sub_models) add_sub_model(*given.row, given.numbers, draft);
  draft.law.limit_damping = limit_damping;
  finish_law(draft);
  return draft.law;
}

// The critical dashpot is 2 sqrt(m k / acceleration), and the formulas, which are LAMMPS's and LIGGGHTS's, have 2 sqrt(m k).
void check_dashpots(const ContactLaw &law, Real acceleration)
{
  if (acceleration == 1) return;
  const std::string only =
      " only in units in which a force of 1 gives a mass of 1 the acceleration 1, such as si, cgs, "
      "micro, nano and lj, and in those that are used it gives " +
      number_text(acceleration) + ": use such units, or ";
  if (gives_restitution(law))
    throw LawError("damping", "the damping (tsuji or coeff_restitution) returns the restitution e" +
                                  only + "another damping");
  if (rolls_with_part_of_critical(law))
    throw LawError("rolling",
                   "the number damping of the rolling (epsd or epsd3) is the part of the critical "
                   "dashpot" +
                       only + "0 for it");
}

}    // namespace lsdcd
