#include "input/granular_words.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// What sub-models say about one another before all of them are known.
struct Draft {
  ContactLaw law;
  std::string normal_name, damping_name = "viscoelastic";
  Real young = 0, poisson = 0;    // of material sub-models; young 0: there is none
  Real second = 0;                // eta or e, the second number of the normal sub-model
};

struct SubModel {
  const char *family;    // "" for the normal one, which has no word of its own
  const char *name;
  const char *parameters;
  void (*read)(Tokens &, Draft &);
};

GranularLaw &parts(Draft &d)
{
  return d.law.granular;
}

void read_stiffness(Tokens &w, Draft &d, NormalModel model)
{
  parts(d).normal = model;
  parts(d).k_normal = w.number("kn", 0);
  d.second = w.number("eta (or e)", 0);
}

// Effective modulus of a sphere and a wall of one material, as LAMMPS has it since 2023.
void read_material(Tokens &w, Draft &d, NormalModel model)
{
  parts(d).normal = model;
  d.young = w.number("E", kAboveZero);
  d.second = w.number("eta (or e)", 0);
  d.poisson = w.number("nu", -1 + 1e-12, 0.5);
  parts(d).modulus = d.young / (2 * (1 - d.poisson * d.poisson));
  parts(d).k_normal = Real(4) / 3 * parts(d).modulus;
  if (model != NormalModel::hertz) parts(d).cohesion = w.number("gamma", 0);
}

void read_slip(Tokens &w, Draft &d)
{
  parts(d).x_tangent = w.number("x_gammat", 0);
  parts(d).mu = w.number("mu", 0);
}

void read_tangential(Tokens &w, Draft &d, TangentialModel model)
{
  parts(d).tangential = model;
  if (model == TangentialModel::linear_history) {
    parts(d).k_tangent = w.number("kt", 0);
  } else {
    parts(d).k_tangent = w.number_or("NULL", -1, "kt", 0);
    if (parts(d).k_tangent < 0) {
      if (d.young == 0)
        w.fail("kt can be NULL only where the normal sub-model has E and nu, not with '" +
               d.normal_name + "'");
      // 8 G of the contact of a sphere and a wall of one material.
      parts(d).k_tangent = 8 * d.young / (4 * (2 - d.poisson) * (1 + d.poisson));
    }
  }
  read_slip(w, d);
}

void read_damping(Draft &d, DampingModel model, const char *name)
{
  parts(d).damping = model;
  d.damping_name = name;
}

void read_heat(Tokens &w, Draft &d, HeatModel model, const char *what)
{
  parts(d).heat = model;
  parts(d).conductance = w.number(what, 0);
}

const SubModel kSubModels[] = {
    {"", "hooke", "kn eta|e",
     [](Tokens &w, Draft &d) { read_stiffness(w, d, NormalModel::hooke); }},
    {"", "hertz", "kn eta|e",
     [](Tokens &w, Draft &d) { read_stiffness(w, d, NormalModel::hertz); }},
    {"", "hertz/material", "E eta|e nu",
     [](Tokens &w, Draft &d) { read_material(w, d, NormalModel::hertz); }},
    {"", "dmt", "E eta nu gamma",
     [](Tokens &w, Draft &d) { read_material(w, d, NormalModel::dmt); }},
    {"", "jkr", "E eta nu gamma",
     [](Tokens &w, Draft &d) { read_material(w, d, NormalModel::jkr); }},

    {"damping", "none", "",
     [](Tokens &, Draft &d) { read_damping(d, DampingModel::none, "none"); }},
    {"damping", "velocity", "",
     [](Tokens &, Draft &d) { read_damping(d, DampingModel::velocity, "velocity"); }},
    {"damping", "mass_velocity", "",
     [](Tokens &, Draft &d) { read_damping(d, DampingModel::mass_velocity, "mass_velocity"); }},
    {"damping", "viscoelastic", "",
     [](Tokens &, Draft &d) { read_damping(d, DampingModel::viscoelastic, "viscoelastic"); }},
    {"damping", "tsuji", "",
     [](Tokens &, Draft &d) { read_damping(d, DampingModel::stiffness, "tsuji"); }},
    {"damping", "coeff_restitution", "",
     [](Tokens &, Draft &d) { read_damping(d, DampingModel::stiffness, "coeff_restitution"); }},

    {"tangential", "linear_nohistory", "x_gammat mu", read_slip},
    {"tangential", "linear_history", "kt x_gammat mu",
     [](Tokens &w, Draft &d) { read_tangential(w, d, TangentialModel::linear_history); }},
    {"tangential", "mindlin", "kt|NULL x_gammat mu",
     [](Tokens &w, Draft &d) { read_tangential(w, d, TangentialModel::mindlin); }},
    {"tangential", "mindlin/force", "kt|NULL x_gammat mu",
     [](Tokens &w, Draft &d) { read_tangential(w, d, TangentialModel::mindlin_force); }},
    {"tangential", "mindlin_rescale", "kt|NULL x_gammat mu",
     [](Tokens &w, Draft &d) { read_tangential(w, d, TangentialModel::mindlin_rescale); }},
    {"tangential", "mindlin_rescale/force", "kt|NULL x_gammat mu",
     [](Tokens &w, Draft &d) { read_tangential(w, d, TangentialModel::mindlin_rescale_force); }},

    {"rolling", "none", "", [](Tokens &, Draft &) {}},
    {"rolling", "sds", "k gamma mu",
     [](Tokens &w, Draft &d) {
       parts(d).rolling = true;
       parts(d).k_roll = w.number("k", 0);
       parts(d).gamma_roll = w.number("gamma", 0);
       parts(d).mu_roll = w.number("mu", 0);
     }},

    {"twisting", "none", "", [](Tokens &, Draft &) {}},
    {"twisting", "marshall", "",
     [](Tokens &, Draft &d) { parts(d).twisting = TwistingModel::marshall; }},
    {"twisting", "sds", "k gamma mu",
     [](Tokens &w, Draft &d) {
       parts(d).twisting = TwistingModel::sds;
       parts(d).k_twist = w.number("k", 0);
       parts(d).gamma_twist = w.number("gamma", 0);
       parts(d).mu_twist = w.number("mu", 0);
     }},

    {"heat", "none", "", [](Tokens &, Draft &) {}},
    {"heat", "radius", "k", [](Tokens &w, Draft &d) { read_heat(w, d, HeatModel::radius, "k"); }},
    {"heat", "area", "h", [](Tokens &w, Draft &d) { read_heat(w, d, HeatModel::area, "h"); }},
};

std::string with_gap(const std::string &a, const std::string &b)
{
  return a.empty() || b.empty() ? a + b : a + " " + b;
}

// "tangential linear_history kt x_gammat mu"
std::string syntax_of(const SubModel &row)
{
  return with_gap(with_gap(row.family, row.name), row.parameters);
}

// "tangential linear_nohistory|linear_history|..."
std::string choices_of(const std::string &family)
{
  std::string names;
  for (const SubModel &row : kSubModels)
    if (row.family == family) names += (names.empty() ? "" : "|") + std::string(row.name);
  return with_gap(family, names);
}

void read_sub_model(Tokens &w, Draft &d, const std::string &family)
{
  w.expect(with_gap("granular", family), choices_of(family));
  if (w.done()) w.fail("the name of the sub-model is missing");
  for (const SubModel &row : kSubModels) {
    if (row.family != family || w.peek() != row.name) continue;
    w.take();
    w.expect(with_gap("granular", with_gap(row.family, row.name)), syntax_of(row));
    if (family.empty()) d.normal_name = row.name;
    row.read(w, d);
    return;
  }
  w.fail("'" + w.peek() + "' is not a sub-model");
}

// What the second number of the normal sub-model means is known only in the end.
void resolve_damping(Tokens &w, Draft &d)
{
  GranularLaw &g = parts(d);
  g.eta = d.second;
  if (g.damping != DampingModel::stiffness) return;
  w.expect("granular damping " + d.damping_name,
           "granular hooke|hertz kn e, or hertz/material E e nu, with 0 < e <= 1");
  if (g.normal == NormalModel::dmt || g.normal == NormalModel::jkr)
    w.fail("the damping does not go with the adhesive sub-model '" + d.normal_name + "'");
  const bool exact = d.damping_name == "coeff_restitution";
  if (d.second > 1 || (exact && d.second == 0))
    w.fail("e = " + number_text(d.second) +
           " is out of range: it must be above 0 and at most 1, as the second number of the "
           "normal sub-model is the restitution");
  g.eta = exact ? restitution_damping(g.normal, d.second) : tsuji_damping(d.second);
}

}    // namespace

std::vector<std::string> granular_families()
{
  return {"damping", "tangential", "rolling", "twisting", "heat", "limit_damping"};
}

std::string granular_syntax()
{
  return "granular " + choices_of("") +
         " ... tangential MODEL ... [damping MODEL] [rolling MODEL ...] [twisting MODEL ...] "
         "[heat MODEL ...] [limit_damping] mesh FILE [keywords]";
}

std::string granular_help()
{
  std::string help;
  for (const SubModel &row : kSubModels) help += "    " + syntax_of(row) + "\n";
  return help;
}

ContactLaw read_granular(Tokens &w, std::string &text)
{
  Draft d;
  d.law.style = LawStyle::granular;
  const std::size_t first = w.at();
  read_sub_model(w, d, "");

  const std::vector<std::string> families = granular_families();
  std::vector<std::string> seen;
  const auto has = [&](const std::string &word) {
    return std::find(seen.begin(), seen.end(), word) != seen.end();
  };
  while (!w.done() && std::find(families.begin(), families.end(), w.peek()) != families.end()) {
    const std::string word = w.take();
    w.expect("granular " + word, word == "limit_damping" ? word : choices_of(word));
    if (has(word)) w.fail("it is given twice");
    seen.push_back(word);
    if (word == "limit_damping")
      d.law.limit_damping = true;
    else
      read_sub_model(w, d, word);
  }
  text = "granular " + w.between(first);

  if (!has("tangential")) {
    w.expect("granular", choices_of("tangential"));
    w.fail("the tangential sub-model is missing");
  }
  if (d.law.limit_damping && (d.law.is(NormalModel::dmt) || d.law.is(NormalModel::jkr))) {
    w.expect("granular limit_damping", granular_syntax());
    w.fail("an adhesive sub-model, '" + d.normal_name + "', has to pull");
  }
  resolve_damping(w, d);
  return d.law;
}

}    // namespace lsdcd
