// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "material/material_law.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "law/coarse_grain.h"
#include "law/make_law.h"
#include "material/contact_moduli.h"
#include "material/material_file.h"
#include "material/material_units.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>

namespace lsdcd {

namespace {

// The number that tsuji in a pair style of LAMMPS needs for the restitution e. The fit is for the mass
// of one of two equal spheres; LAMMPS uses the effective mass, half of that. The damping falls as the
// number grows: the number 0 gives the least restitution, 0.11.
Real tsuji_number(Real e)
{
  const Real wanted = std::sqrt(Real(2)) * restitution_damping(NormalModel::hertz, e);
  Real low = 0, high = 1;
  for (int halved = 0; halved < 60; halved++) {
    const Real middle = (low + high) / 2;
    (tsuji_damping(middle) > wanted ? low : high) = middle;
  }
  return std::round(1e6 * low) / 1e6;
}

const SubModel &granular_row(Family family, const std::string &name)
{
  for (const SubModel *row : sub_models(family))
    if (row->name == name) return *row;
  throw InputError("'" + name + "' is not a sub-model");
}

class LawFiller {
 public:
  LawFiller(const MaterialPair &pair, const std::string &units, const MaterialWords &words) :
      c_(pair), units_(units), words_(words), with_(std::string("'") + words.with + " "),
      file_(read_materials(find_material_file(c_.file))), particle_(file_.material(c_.particle)),
      wall_(file_.material(c_.wall)), pair_(file_.pair(c_.particle, c_.wall)),
      same_(c_.particle == c_.wall)
  {
    for (const GivenSubModel &given : c_.beside)
      if (given.row->family == Family::damping)
        damping_ = given.row->name;
      else if (given.row->family == Family::tangential)
        has_tangential_ = true;
    for (const Override &o : c_.overrides) check_meant(o);
    tell("material    " + both() + ", " + file_.path + ", in units " + units_);
    set_contact();
  }

  MaterialLaw make()
  {
    MaterialLaw made;
    GivenSubModel normal = {&granular_row(Family::normal, c_.normal), {}};
    for (const Parameter &p : normal.row->parameters) normal.numbers.push_back(normal_number(p));
    made.sub_models.push_back(normal);
    if (damping_.empty())
      made.sub_models.push_back({&granular_row(Family::damping, default_damping()), {}});
    if (!has_tangential_)
      made.sub_models.push_back(
          {&granular_row(Family::tangential, "mindlin"), tangential_numbers()});
    for (const GivenSubModel &given : c_.beside) made.sub_models.push_back(filled(given));
    made.law = law_of(made.sub_models);
    made.name = "granular " + text_of(made.sub_models) + (c_.limit_damping ? " limit_damping" : "");
    made.becomes = coarse_grain_text(made.sub_models, c_.coarse_grain);
    made.report = report_;
    made.files = file_.files;
    return made;
  }

  // After make(): does a sub-model take it? It is one of the pair.
  bool reads(const Override &o) const { return read_.count(&o) > 0; }

  [[noreturn]] void refuse_unread(const Override &o) const
  {
    fail(with_ + (o.of.empty() ? "" : o.of + " ") + o.key +
         "' changes nothing, as no sub-model here takes it: leave it out, or name one that does");
  }

  // The damping of classic styles is divided by the mass, which no material has.
  [[noreturn]] void refuse_style(const std::string &style) const
  {
    std::string numbers;
    if (style == "hertz/history") {
      const Property &p = *find_property("youngs_modulus");
      numbers = " Of its numbers, " + both() + " gives kn " +
                exact_text(in_units(contact_.youngs * 4 / 3, p, units_)) + " and kt " +
                exact_text(in_units(contact_.shear * 8, p, units_)) + " in units " + units_ + ".";
    }
    throw InputError("in 'material', " + style +
                     " cannot be filled: its damping (and the stiffness of hooke) depends on how "
                     "large and fast the grains are, not only on what they are made of." +
                     numbers + " Use 'granular material', whose damping takes a restitution");
  }

 private:
  std::string both() const { return c_.particle + " on " + c_.wall; }

  void check_meant(const Override &o) const
  {
    const Property *p = find_property(o.key);
    if (p && !p->of_pair && !same_ && o.of.empty() && particle_.find(o.key) && wall_.find(o.key))
      fail("'" + o.key + "' of both materials is in the file: write which one you mean, as in " +
           with_ + c_.wall + " " + o.key + " VALUE'");
  }

  const Real *override_of(const std::string &key, const std::string &of = "") const
  {
    for (const Override &o : c_.overrides) {
      if (o.key != key || o.of != of) continue;
      read_.insert(&o);
      return &o.value;
    }
    return nullptr;
  }

  // The value that the caller gives in place of the material file's; null: none.
  const Real *given(const MaterialSection &m, const char *key) const
  {
    if (const Real *number = override_of(key, m.first)) return number;
    return same_ || !m.find(key) ? override_of(key) : nullptr;
  }

  // A value in SI; one from the caller is as it was.
  Real in_script(const char *key, Real si, const Real *number = nullptr) const
  {
    return number ? *number : in_units(si, *find_property(key), units_);
  }
  Real in_script(const MaterialSection &m, const char *key, Real si) const
  {
    return in_script(key, si, given(m, key));
  }

  void tell(const std::string &line) { report_ += (report_.empty() ? "  " : "\n  ") + line; }
  void tell_more(const std::string &line) { tell("            " + line); }

  void tell(const std::string &of, const std::string &key, Real number, const Stated *stated)
  {
    const std::string line = of + ": " + key + " " + exact_text(number);
    if (!stated) return tell_more(line + ", " + words_.as_given);
    const std::string unit = stated->property->unit;
    const std::string si = unit == "1" ? "" : number_text(stated->value) + " " + unit + ", ";
    tell_more(line + " (" + si + stated->place.substr(stated->place.rfind('/') + 1) +
              "): " + (stated->source.empty() ? "no source" : stated->source));
  }

  // SI
  Real of_one(const MaterialSection &m, const char *key)
  {
    const Property &p = *find_property(key);
    const Real *number = given(m, key);
    const Stated *s = number ? nullptr : m.find(key);
    if (!number && !s)
      throw InputError("in 'material', " + m.place + ": '" + m.first + "' has no " + key +
                       ": add it there, or write " + with_ + (same_ ? "" : m.first + " ") + key +
                       " VALUE'");
    const Real si = number ? *number / in_units(1, p, units_) : s->value;
    tell(m.first, key, in_script(m, key, si), s);
    return si;
  }

  // In the caller's units.
  Real of_pair(const char *key)
  {
    const Real *number = override_of(key);
    const Stated *s = pair_ && !number ? pair_->find(key) : nullptr;
    if (!number && !s)
      throw InputError("in 'material', " + file_.path + " has no " + key + " of " + both() +
                       ": write " + with_ + key + " VALUE', or add it to the file under 'pair " +
                       c_.particle + " " + c_.wall + "'");
    const Real value = in_script(key, s ? s->value : 0, number);
    tell(both(), key, value, s);
    return value;
  }

  Elastic elastic(const MaterialSection &m)
  {
    const Real modulus = of_one(m, "youngs_modulus");
    return {modulus, of_one(m, "poissons_ratio")};
  }

  void set_contact()
  {
    const Elastic a = elastic(particle_), b = same_ ? a : elastic(wall_);
    contact_ = contact_moduli(a, b);
    const Elastic one = same_ ? a : as_one(a, b);
    modulus_ = same_ ? in_script(particle_, "youngs_modulus", one.youngs_modulus)
                     : in_script("youngs_modulus", one.youngs_modulus);
    ratio_ = one.poissons_ratio;
    if (!same_)
      tell_more("as one material: youngs_modulus " + exact_text(modulus_) + ", poissons_ratio " +
                exact_text(ratio_) + " (the same E* and G*)");
  }

  // The restitution of hysteretic/edem is that of yielding.
  bool yields_by_restitution() const { return c_.normal == "hysteretic/edem"; }

  Real normal_number(const Parameter &p)
  {
    const std::string name = p.name;
    if (name == "E") return modulus_;
    if (name == "nu") return ratio_;
    if (name == "gamma") return surface_energy();
    if (name == "Y") return lesser("yield_strength");
    if (name == "py") return lesser("yield_pressure");
    return name == "e" ? of_pair("restitution") : damping_number();
  }

  // A normal model without E gets the stiffness 8 G* as a number, and has no dashpot along the wall, as it has none along the normal.
  std::vector<Real> tangential_numbers()
  {
    const Real mu = of_pair("sliding_friction");
    if (!yields_by_restitution()) return {NAN, 1, mu};
    const Real kt = in_units(8 * contact_.shear, *find_property("youngs_modulus"), units_);
    tell_more("tangential stiffness " + exact_text(kt) + ", 8 G*");
    return {kt, 0, mu};
  }

  // No damping model with a restitution goes with a normal model that adheres or yields.
  std::string default_damping()
  {
    if (c_.normal == "hertz/material") return "coeff_restitution";
    if (yields_by_restitution()) return "none";
    tell_more("no damping: " + c_.normal +
              " works with no damping model that takes a restitution; to have damping, write " +
              with_ + "eta VALUE damping velocity'");
    return "none";
  }

  bool takes_restitution() const { return damping_ == "tsuji" || damping_ == "coeff_restitution"; }

  Real damping_number()
  {
    const bool takes = c_.normal == "hertz/material";    // a restitution
    if (const Real *eta = override_of("eta")) {
      if (damping_.empty())
        fail(with_ + "eta' is the number of a damping model: name it, such as 'damping "
                     "velocity'");
      if (damping_ == "none") fail(with_ + "eta' changes nothing beside 'damping none'");
      if (takes && takes_restitution())
        fail("'damping " + damping_ + "' takes the material's restitution: write " + with_ +
             "restitution VALUE' for " + with_ + "eta VALUE'");
      tell("damping " + damping_, "eta", *eta, nullptr);
      return *eta;
    }
    if (damping_ == "none" || (damping_.empty() && !takes)) return 0;
    if (!takes || (!damping_.empty() && !takes_restitution()))
      fail("'damping " + damping_ + "' with " + c_.normal +
           " does not take the material's restitution: give its own number as " + with_ +
           "eta VALUE'" + (takes ? ", or use tsuji or coeff_restitution" : ""));
    return of_pair("restitution");
  }

  // The softer one of two materials yields.
  Real lesser(const char *key)
  {
    const Real a = of_one(particle_, key);
    if (same_) return in_script(particle_, key, a);
    const Real b = of_one(wall_, key);
    const MaterialSection &softer = a < b ? particle_ : wall_;
    tell_more(std::string(key) + " of " + softer.first + ", which is the lesser");
    return in_script(softer, key, std::fmin(a, b));
  }

  // For different materials it is the geometric mean, as for dispersion forces (Israelachvili,
  // Intermolecular and Surface Forces).
  Real surface_energy()
  {
    const char *key = "surface_energy";
    const Real a = of_one(particle_, key);
    if (same_) return in_script(particle_, key, a);
    const Real energy = in_script(key, std::sqrt(a * of_one(wall_, key)));
    tell_more("surface_energy " + exact_text(energy) + ", geometric mean");
    return energy;
  }

  // Two half-spaces in series with a common contact spot: the harmonic mean.
  Real conductivity()
  {
    const char *key = "thermal_conductivity";
    const Real a = of_one(particle_, key);
    if (same_) return in_script(particle_, key, a);
    const Real b = of_one(wall_, key);
    const Real mean = in_script(key, 2 * a * b / (a + b));
    tell_more("thermal_conductivity " + exact_text(mean) + ", harmonic mean");
    return mean;
  }

  // A number of one material, which for one of both sides of the contact is that of this side. That of the wall is left out where the
  // particle's is given or the same, as NULL means that then.
  Real of_material(const Parameter &p, bool first_is_given)
  {
    if (p.mixing == Mixing::first)
      return in_script(particle_, p.property, of_one(particle_, p.property));
    if (p.mixing != Mixing::second) return conductivity();
    if (first_is_given || same_) return NAN;
    return in_script(wall_, p.property, of_one(wall_, p.property));
  }

  // With the numbers that are properties of the materials.
  GivenSubModel filled(GivenSubModel given)
  {
    bool first_is_given = false;
    for (std::size_t k = 0; k < given.numbers.size(); k++) {
      const Parameter &p = given.row->parameters[k];
      if (p.mixing == Mixing::first) first_is_given = !std::isnan(given.numbers[k]);
      if (p.property && std::isnan(given.numbers[k]))
        given.numbers[k] = find_property(p.property)->of_pair ? of_pair(p.property)
                                                              : of_material(p, first_is_given);
    }
    return given;
  }

  ContactLaw law_of(const std::vector<GivenSubModel> &sub_models) const
  {
    try {
      return make_law(coarse_grained(sub_models, c_.coarse_grain), c_.limit_damping);
    } catch (const LawError &e) {
      fail(e.what());
    }
  }

  [[noreturn]] void fail(const std::string &problem) const
  {
    throw InputError("in 'material', " + problem + ". Syntax: " + words_.syntax);
  }

  const MaterialPair &c_;
  std::string units_, report_;
  const MaterialWords &words_;
  std::string with_;    // as "'with ", to quote
  MaterialFile file_;
  const MaterialSection &particle_, &wall_;
  const MaterialSection *pair_;
  bool same_;
  mutable std::set<const Override *> read_;    // of those of c_
  std::string damping_;                        // given; empty: none is
  bool has_tangential_ = false;
  ContactModuli contact_;           // SI
  Real modulus_ = 0, ratio_ = 0;    // in the caller's units
};

}    // namespace

MaterialLaw law_of_materials(const MaterialPair &pair, const std::string &units,
                             const MaterialWords &words)
{
  return laws_of_materials({pair}, units, words).front();
}

std::vector<MaterialLaw> laws_of_materials(const std::vector<MaterialPair> &pairs,
                                           const std::string &units, const MaterialWords &words)
{
  std::vector<MaterialLaw> laws;
  std::vector<const Override *> read;
  std::deque<LawFiller> fillers;
  for (const MaterialPair &pair : pairs) {
    laws.push_back(fillers.emplace_back(pair, units, words).make());
    for (const Override &o : pair.overrides)
      if (fillers.back().reads(o)) read.push_back(&o);
  }
  for (std::size_t k = 0; k < pairs.size(); k++)
    for (const Override &o : pairs[k].overrides)
      if (std::none_of(read.begin(), read.end(), [&](const Override *other) {
            return other->of == o.of && other->key == o.key && other->value == o.value;
          }))
        fillers[k].refuse_unread(o);
  return laws;
}

const std::vector<std::string> &normals_of_materials()
{
  static const std::vector<std::string> names = {"hertz/material", "jkr", "dmt", "hysteretic/edem",
                                                 "thornton"};
  return names;
}

void check_normal_of_materials(const std::string &normal)
{
  const std::vector<std::string> &names = normals_of_materials();
  if (std::find(names.begin(), names.end(), normal) != names.end()) return;
  const bool has_stiffness =
      normal == "hysteretic" || normal == "hysteretic/size" || normal == "eepa" || normal == "lepa";
  throw InputError(
      "the normal model '" + normal + "' does not take material constants" +
      (has_stiffness ? ", as its stiffness is calibrated for grains of one size" : "") +
      ": use hertz/material, jkr, dmt, hysteretic/edem or thornton");
}

void check_override(const Override &o)
{
  const Property *p = find_property(o.key);
  if (!p && o.key != "eta") throw InputError(not_a_property(o.key));
  if (!o.of.empty() && (!p || p->of_pair))
    throw InputError("'" + o.key + "' is not a property of " + o.of + " alone: leave the name out");
  if (o.key == "density")
    throw InputError(
        "no contact style takes a density, because each atom has its own: leave it out");
  const Real least = p ? std::nextafter(p->above, Tokens::kHuge) : 0,
             most = p ? p->most : Tokens::kHuge;
  if (!(o.value >= least && o.value <= most))
    throw InputError(o.key + " = " + number_text(o.value) + " is out of range: it is " +
                     (p ? "above " + number_text(p->above) +
                              (most < Tokens::kHuge ? " and at most " + number_text(most) : "")
                        : "0 or more"));
}

void refuse_classic_of_materials(const std::string &style, const MaterialPair &pair,
                                 const std::string &units, const MaterialWords &words)
{
  LawFiller(pair, units, words).refuse_style(style);
}

std::string text_of(const std::vector<GivenSubModel> &sub_models)
{
  std::string text;
  for (const GivenSubModel &given : sub_models) {
    const std::string family = family_word(given.row->family);
    text += (text.empty() ? "" : " ") + (family.empty() ? "" : family + " ") + given.row->name;
    for (const Real number : given.numbers)
      text += " " + (std::isnan(number) ? "NULL" : exact_text(number));
  }
  return text;
}

std::vector<GivenSubModel> sub_models_of_29sep2021(std::vector<GivenSubModel> sub_models)
{
  for (GivenSubModel &given : sub_models) {
    if (given.row->family != Family::damping) continue;
    const std::string name = given.row->name;
    if (name == "none") given.row = &granular_row(Family::damping, "velocity");    // of eta 0
    if (name != "coeff_restitution") continue;
    given.row = &granular_row(Family::damping, "tsuji");
    Real &e = sub_models.front().numbers[1];
    e = tsuji_number(e);
  }
  return sub_models;
}

}    // namespace lsdcd
