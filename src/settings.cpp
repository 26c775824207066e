#include "settings.h"

#include "granular_words.h"
#include "input_words.h"
#include "keywords.h"
#include "material/material_command.h"

#include <algorithm>

namespace lsdcd {

namespace {

// What is given is kept, the rest is tuned.
void check_tune(Words &w, const WallSettings &s)
{
  if (s.tune < 0) return;
  w.expect("tune", "tune E");
  if (s.nearest > 0 && !s.exact)
    w.fail("nothing bounds the error of 'nearest " + std::to_string(s.nearest) +
           "'; use 'nearest " + std::to_string(s.nearest) + " exact' or leave nearest out");
  if (s.length_given && s.nearest_given && s.precision_given)
    w.fail("grid, nearest and precision are all given and nothing is left to choose");
}

const char *const kLawSyntax =
    "hooke|hooke/history|hertz/history kn kt|NULL gamman gammat|NULL xmu dampflag [limit_damping] "
    "mesh FILE [keywords], or granular NORMAL ... mesh FILE [keywords]";

void read_law(Words &w, WallSettings &s)
{
  const std::vector<std::string> names = {"hooke", "hooke/history", "hertz/history", "granular"};
  w.expect("fix wall/lsdcd", kLawSyntax);
  if (w.done()) w.fail("the contact style is missing");
  const auto found = std::find(names.begin(), names.end(), w.peek());
  if (found == names.end()) w.fail("'" + w.peek() + "' is not a contact style");
  s.law_name = w.take();
  s.law.style = static_cast<LawStyle>(found - names.begin());
  if (s.law.style == LawStyle::granular) {
    s.law = read_granular(w, s.law_name);
    return;
  }

  // The numbers, NULLs and limits of fix wall/gran.
  w.expect(s.law_name, kLawSyntax);
  ContactLaw &law = s.law;
  law.k_normal = w.number("kn", 0);
  law.k_tangent = w.number_or("NULL", law.k_normal * 2 / 7, "kt", 0);
  law.gamma_normal = w.number("gamman", 0);
  law.gamma_tangent = w.number_or("NULL", law.gamma_normal / 2, "gammat", 0);
  law.mu = w.number("xmu", 0, 10000);
  const Real dampflag = w.number("dampflag", 0, 1);
  if (dampflag != 0 && dampflag != 1) w.fail("dampflag must be 0 or 1");
  if (dampflag == 0) law.gamma_tangent = 0;
  if (!w.done() && w.peek() == "limit_damping") {
    law.limit_damping = true;
    w.take();
  }
}

// `families`: words of `granular` that come before keywords; empty with other styles.
[[noreturn]] void refuse_keyword(const std::string &word, const std::vector<std::string> &names,
                                 const std::vector<std::string> &families)
{
  std::vector<std::string> known = families;
  known.insert(known.end(), names.begin(), names.end());
  const std::string near = nearest(word, known);
  const bool family = std::find(families.begin(), families.end(), near) != families.end();
  const auto row = std::find(names.begin(), names.end(), near);
  throw InputError("'" + word + "' is not a keyword; the nearest is '" +
                   (family ? near + "', which comes before mesh and other keywords"
                           : syntax_of(keywords()[row - names.begin()]) + "'"));
}

}    // namespace

WallSettings parse_settings(const std::vector<std::string> &words)
{
  WallSettings settings;
  Words w(words);
  read_law(w, settings);

  std::vector<std::string> seen, names;
  for (const Keyword &row : keywords()) names.push_back(row.name);
  const bool granular = settings.law.style == LawStyle::granular;
  const std::vector<std::string> families =
      granular ? granular_families() : std::vector<std::string>();
  while (!w.done()) {
    const std::string word = w.take();
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) refuse_keyword(word, names, families);
    const Keyword &row = keywords()[found - names.begin()];
    w.expect(row.name, syntax_of(row));
    const bool repeats = word == "scale" || word == "rotate" || word == "move";
    if (!repeats && std::find(seen.begin(), seen.end(), word) != seen.end())
      w.fail("the keyword is given twice");
    seen.push_back(word);
    row.read(w, settings);
  }
  w.expect("fix wall/lsdcd", granular ? granular_syntax() : kLawSyntax);
  if (settings.mesh_file.empty()) w.fail("mesh FILE is missing");
  w.expect("temperature", "granular ... heat radius|area ... mesh FILE temperature T|v_NAME");
  if (settings.law.has_heat() && !settings.has_temperature)
    w.fail("the wall's temperature is missing, which the sub-model heat needs");
  if (settings.has_temperature && !settings.law.has_heat())
    w.fail("a temperature is given, but no sub-model heat uses it");
  check_tune(w, settings);
  return settings;
}

std::string settings_help()
{
  std::string help = std::string("fix ID group wall/lsdcd ") + kLawSyntax + "\n  " +
                     granular_syntax() + ", of\n" + granular_help() +
                     "  or, with numbers from a file, " + kMaterialSyntax + "\n  keywords\n";
  for (const Keyword &row : keywords()) {
    std::string line = "  " + syntax_of(row);
    line.resize(std::max<std::size_t>(line.size() + 1, 38), ' ');
    line += row.help;
    std::string facts;
    for (const char *fact : {row.unit, row.range})
      if (*fact) facts += std::string(fact) + "; ";
    help += line + " (" + facts + "default " + row.fallback + ")\n";
  }
  return help;
}

}    // namespace lsdcd
