// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "law/make_law.h"

#include "base/input_words.h"

#include <algorithm>

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
  return row.family == Family::style || draft.young != 0;
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
