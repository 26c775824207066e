// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/fill_material.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "law/sub_models.h"
#include "material/contact_moduli.h"
#include "material/material_units.h"

#include <charconv>
#include <cmath>

namespace lsdcd {

namespace {

// With the fewest digits that read back as the same number.
std::string exact_text(Real value)
{
  char buffer[40];
  return std::string(buffer, std::to_chars(buffer, buffer + sizeof buffer, value).ptr);
}

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

class Filler {
 public:
  Filler(const MaterialCommand &command, const std::string &units, const MaterialWords &words) :
      c_(command), units_(units), words_(words), with_(std::string("'") + words.with + " "),
      file_(read_materials(find_material_file(c_.file))), particle_(file_.material(c_.particle)),
      wall_(file_.material(c_.wall)), pair_(file_.pair(c_.particle, c_.wall)),
      same_(c_.particle == c_.wall)
  {
  }

  // In place of `material ...`.
  FilledTokens fill()
  {
    // A second name without `on` is a likely mistake.
    for (const MaterialSection &m : file_.materials)
      if (c_.sub_models.empty() && !c_.rest.empty() && c_.rest[0] == m.first)
        fail("write '" + std::string(words_.on) + " " + m.first + "' for the wall's material");

    for (const Override &o : c_.overrides)
      if (const Property *p = find_property(o.key);
          p && !p->of_pair && !same_ && o.of.empty() && particle_.find(o.key) && wall_.find(o.key))
        fail("'" + o.key +
             "' of both materials is in the file: write which one you mean, for example " + with_ +
             c_.wall + " " + o.key + " VALUE'");

    tell("material    " + both() + ", " + file_.path + ", in units " + units_);
    set_contact();
    if (c_.normal.empty()) refuse_style();
    std::vector<std::string> out = {"granular", c_.normal, modulus_, damping_number(), ratio_};
    if (c_.normal != "hertz/material") out.push_back(surface_energy());
    if (c_.damping.empty()) out.insert(out.end(), {"damping", default_damping()});
    if (!c_.has_tangential)
      out.insert(out.end(), {"tangential", "mindlin", "NULL", "1", of_pair("sliding_friction")});
    const std::vector<std::string> sub_models = fill_nulls();
    out.insert(out.end(), sub_models.begin(), sub_models.end());
    return {out, report_};
  }

 private:
  std::string both() const { return c_.particle + " on " + c_.wall; }

  // The value that the script gives in place of the material file's; null: none.
  const Real *given(const MaterialSection &m, const char *key) const
  {
    if (const Real *number = c_.override_of(key, m.first)) return number;
    return same_ || !m.find(key) ? c_.override_of(key) : nullptr;
  }

  // A value in SI; one from the script is written back as it was.
  std::string in_script(const char *key, Real si, const Real *number = nullptr) const
  {
    return exact_text(number ? *number : in_units(si, *find_property(key), units_));
  }
  std::string in_script(const MaterialSection &m, const char *key, Real si) const
  {
    return in_script(key, si, given(m, key));
  }

  void tell(const std::string &line) { report_ += (report_.empty() ? "  " : "\n  ") + line; }
  void tell_more(const std::string &line) { tell("            " + line); }

  void tell(const std::string &of, const std::string &key, const std::string &number,
            const Stated *stated)
  {
    const std::string line = of + ": " + key + " " + number;
    if (!stated) return tell_more(line + ", as the input script says");
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

  // Properties of pairs are numbers without a unit.
  std::string of_pair(const char *key)
  {
    const Real *number = c_.override_of(key);
    const Stated *s = pair_ && !number ? pair_->find(key) : nullptr;
    if (!number && !s)
      throw InputError("in 'material', " + file_.path + " has no " + key + " of " + both() +
                       ": write " + with_ + key + " VALUE', or add it to the file under 'pair " +
                       c_.particle + " " + c_.wall + "'");
    const std::string text = exact_text(number ? *number : s->value);
    tell(both(), key, text, s);
    return text;
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
    ratio_ = exact_text(one.poissons_ratio);
    if (!same_)
      tell_more("as one material: youngs_modulus " + modulus_ + ", poissons_ratio " + ratio_ +
                " (the same E* and G*)");
  }

  // The damping of classic styles is divided by the mass, which no material has.
  [[noreturn]] void refuse_style() const
  {
    std::string numbers;
    if (c_.style == "hertz/history") {
      const Property &p = *find_property("youngs_modulus");
      numbers = " Of its numbers, " + both() + " gives kn " +
                exact_text(in_units(contact_.youngs * 4 / 3, p, units_)) + " and kt " +
                exact_text(in_units(contact_.shear * 8, p, units_)) + " in units " + units_ + ".";
    }
    throw InputError("in 'material', " + c_.style +
                     " cannot be filled: its damping (and the stiffness of hooke) depends on how "
                     "large and fast the grains are, not only on what they are made of." +
                     numbers + " Use 'granular material', whose damping takes a restitution");
  }

  // No damping model with a restitution goes with an adhesive normal model.
  std::string default_damping()
  {
    if (c_.normal == "hertz/material") return "coeff_restitution";
    tell_more("no damping: " + c_.normal +
              " works with no damping model that takes a restitution; to have damping, write " +
              with_ + "eta VALUE damping velocity'");
    return "none";
  }

  std::string damping_number()
  {
    const bool takes = c_.normal == "hertz/material";    // a restitution
    if (const Real *eta = c_.override_of("eta")) {
      if (c_.damping.empty())
        fail(with_ + "eta' is the number of a damping model: name it, such as 'damping "
                     "velocity'");
      tell("damping " + c_.damping, "eta", exact_text(*eta), nullptr);
      return exact_text(*eta);
    }
    if (c_.damping == "none" || (c_.damping.empty() && !takes)) return "0";
    if (!takes ||
        (!c_.damping.empty() && c_.damping != "tsuji" && c_.damping != "coeff_restitution"))
      fail("'damping " + c_.damping + "' with " + c_.normal +
           " does not take the material's restitution: give its own number as " + with_ +
           "eta VALUE'" + (takes ? ", or use tsuji or coeff_restitution" : ""));
    return of_pair("restitution");
  }

  // For different materials it is the geometric mean, as for dispersion forces (Israelachvili,
  // Intermolecular and Surface Forces).
  std::string surface_energy()
  {
    const char *key = "surface_energy";
    const Real a = of_one(particle_, key);
    if (same_) return in_script(particle_, key, a);
    const std::string text = in_script(key, std::sqrt(a * of_one(wall_, key)));
    tell_more("surface_energy " + text + ", geometric mean");
    return text;
  }

  // Two half-spaces in series with a common contact spot: the harmonic mean.
  std::string conductivity()
  {
    const char *key = "thermal_conductivity";
    const Real a = of_one(particle_, key);
    if (same_) return in_script(particle_, key, a);
    const Real b = of_one(wall_, key);
    const std::string text = in_script(key, 2 * a * b / (a + b));
    tell_more("thermal_conductivity " + text + ", harmonic mean");
    return text;
  }

  // NULL where a sub-model takes a number that is a property.
  std::vector<std::string> fill_nulls()
  {
    std::vector<std::string> tokens = c_.sub_models;
    for (std::size_t i = 0; i + 1 < tokens.size(); i++)
      for (const SubModel &row : sub_models())
        if (row.with == GoesWith::granular && tokens[i] == family_word(row.family) &&
            tokens[i + 1] == row.name)
          for (std::size_t k = 0; k < row.parameters.size() && i + 2 + k < tokens.size(); k++)
            if (const char *property = row.parameters[k].property;
                property && tokens[i + 2 + k] == "NULL")
              tokens[i + 2 + k] =
                  find_property(property)->of_pair ? of_pair(property) : conductivity();
    return tokens;
  }

  [[noreturn]] void fail(const std::string &problem) const { fail_material(problem, words_); }

  const MaterialCommand &c_;
  std::string units_, report_;
  const MaterialWords &words_;
  std::string with_;    // as "'with ", to quote
  MaterialFile file_;
  const MaterialSection &particle_, &wall_;
  const MaterialSection *pair_;
  bool same_;
  ContactModuli contact_;          // SI
  std::string modulus_, ratio_;    // of the script
};

// The words of the wall, and of each mesh a law for what spheres of each type have with it.
class WallFiller {
 public:
  WallFiller(const MaterialCommand &command, const std::string &units, const MaterialWords &words) :
      c_(command), units_(units), words_(words)
  {
  }

  FilledTokens fill()
  {
    out_ = law(c_);
    std::size_t at = 0;
    for (const MeshMaterial &mesh : c_.meshes) {
      out_.insert(out_.end(), c_.rest.begin() + at, c_.rest.begin() + mesh.at);
      at = mesh.at;
      add_laws(mesh);
    }
    out_.insert(out_.end(), c_.rest.begin() + at, c_.rest.end());
    return {out_, report_};
  }

 private:
  std::vector<std::string> law(const MaterialCommand &pair)
  {
    const FilledTokens filled = Filler(pair, units_, words_).fill();
    if (report_.find(filled.report) == std::string::npos)
      report_ += (report_.empty() ? "" : "\n") + filled.report;
    return filled.tokens;
  }

  void add_laws(const MeshMaterial &mesh)
  {
    MaterialCommand pair = c_;
    if (!mesh.name.empty()) pair.wall = mesh.name;
    pair.overrides.insert(pair.overrides.begin(), mesh.overrides.begin(), mesh.overrides.end());
    if (!mesh.name.empty()) add({"law"}, pair);
    for (const TypesMaterial &of : c_.types) {
      pair.particle = of.name;
      add({"law", "types", of.types}, pair);
    }
  }

  void add(const std::vector<std::string> &begin, const MaterialCommand &pair)
  {
    const std::vector<std::string> words = law(pair);
    out_.insert(out_.end(), begin.begin(), begin.end());
    out_.insert(out_.end(), words.begin(), words.end());
  }

  const MaterialCommand &c_;
  const std::string &units_;
  const MaterialWords &words_;
  std::vector<std::string> out_;
  std::string report_;
};

}    // namespace

FilledTokens fill_material(const std::vector<std::string> &tokens, const std::string &units,
                           const MaterialWords &words)
{
  if (!has_material(tokens)) return {tokens, ""};
  const MaterialCommand command = read_material_command(tokens, words);
  return WallFiller(command, units, words).fill();
}

std::vector<std::string> words_of_29sep2021(std::vector<std::string> filled)
{
  filled.erase(filled.begin());
  for (std::size_t i = 1; i < filled.size(); i++) {
    if (filled[i - 1] != "damping") continue;
    if (filled[i] == "none") filled[i] = "velocity";    // of eta 0
    if (filled[i] != "coeff_restitution") continue;
    filled[i] = "tsuji";
    filled[2] = exact_text(tsuji_number(std::stod(filled[2])));
  }
  return filled;
}

}    // namespace lsdcd
