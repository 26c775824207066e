// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "pair/pair_coeff.h"

#include "base/input_error.h"
#include "base/number_words.h"
#include "law/coarse_grain.h"
#include "law/make_law.h"
#include "material/contact_moduli.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <iterator>

namespace lsdcd {

namespace {

constexpr Family kPairFamilies[] = {Family::style,      Family::normal,  Family::damping,
                                    Family::tangential, Family::rolling, Family::twisting,
                                    Family::heat,       Family::cohesion};

const GivenSubModel *of_family(const PairCoeff &coeff, Family family)
{
  for (const GivenSubModel &given : coeff.sub_models)
    if (given.row->family == family) return &given;
  return nullptr;
}

bool has_materials(const SubModel &row)
{
  return row.family == Family::normal && std::strcmp(row.parameters[0].name, "E") == 0;
}

// Returns a number of two types. One that is derived makes one that is.
Real mixed(Real a, Real b, const Parameter &p, const std::string &types)
{
  if (a == b) return a;
  switch (p.mixing) {
    case Mixing::series:
      return a + b > 0 ? 2 * a * b / (a + b) : 0;
    case Mixing::least:
      return std::min(a, b);
    case Mixing::equal:
      throw InputError("the laws of types " + types + " cannot be mixed, as " + p.name + " is " +
                       number_text(a) + " and " + number_text(b) +
                       ": give the law of this pair of types by pair_coeff");
    case Mixing::first:
    case Mixing::second:    // `b` is the number before it
      return p.mixing == Mixing::first ? a : b;
    case Mixing::geometric:
      break;
  }
  return a < 0 || b < 0 ? -std::sqrt(a * b) : std::sqrt(a * b);
}

GivenSubModel mixed(const GivenSubModel &a, const GivenSubModel &b, const std::string &types)
{
  GivenSubModel made = a;
  for (std::size_t k = 0; k < made.numbers.size(); k++) {
    const Parameter &p = a.row->parameters[k];
    made.numbers[k] =
        mixed(a.numbers[k], b.numbers[p.mixing == Mixing::second ? k - 1 : k], p, types);
  }
  if (!has_materials(*a.row)) return made;
  const Elastic of_a = {a.numbers[0], a.numbers[2]}, of_b = {b.numbers[0], b.numbers[2]};
  if (of_a.youngs_modulus == of_b.youngs_modulus && of_a.poissons_ratio == of_b.poissons_ratio)
    return made;
  const Elastic one = as_one(of_a, of_b);
  made.numbers[0] = one.youngs_modulus;
  made.numbers[2] = one.poissons_ratio;
  return made;
}

bool are_same(Real a, Real b)    // NULL is no number
{
  return a == b || (std::isnan(a) && std::isnan(b));
}
bool are_same(const GivenSubModel *a, const GivenSubModel *b)
{
  if (!a || !b) return a == b;
  return a->row == b->row &&
         std::equal(a->numbers.begin(), a->numbers.end(), b->numbers.begin(), b->numbers.end(),
                    [](Real x, Real y) { return are_same(x, y); });
}

}    // namespace

bool are_equal(const PairCoeff &a, const PairCoeff &b)
{
  return a.limit_damping == b.limit_damping && a.cutoff == b.cutoff &&
         std::all_of(std::begin(kPairFamilies), std::end(kPairFamilies), [&](Family family) {
           return are_same(of_family(a, family), of_family(b, family));
         });
}

ContactLaw law_of(const PairCoeff &coeff, Real coarse_grain)
{
  return make_law(coarse_grained(coeff.sub_models, coarse_grain), coeff.limit_damping);
}

std::string text_of(const PairCoeff &coeff)
{
  return (of_family(coeff, Family::style) ? "" : "granular ") + text_of(coeff.sub_models) +
         (coeff.limit_damping ? " limit_damping" : "");
}

PairCoeff mixed(const PairCoeff &a, const PairCoeff &b, const std::string &types)
{
  PairCoeff made;
  for (const Family family : kPairFamilies) {
    const GivenSubModel *const of_a = of_family(a, family), *const of_b = of_family(b, family);
    if (!of_a && !of_b) continue;
    if (!of_a || !of_b || of_a->row != of_b->row)
      throw InputError("the laws of types " + types + " cannot be mixed, as one has " +
                       (of_a ? syntax_of(*of_a->row) : std::string("none")) +
                       " and the other has " +
                       (of_b ? syntax_of(*of_b->row) : std::string("none")) +
                       ": give the law of this pair of types by pair_coeff");
    made.sub_models.push_back(mixed(*of_a, *of_b, types));
  }
  made.limit_damping = a.limit_damping || b.limit_damping;
  made.cutoff = std::max(a.cutoff, b.cutoff);
  return made;
}

}    // namespace lsdcd
