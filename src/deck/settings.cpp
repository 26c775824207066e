#include "deck/settings.h"

#include "base/input_words.h"
#include "deck/granular_words.h"
#include "deck/keywords.h"
#include "deck/material_command.h"

#include <algorithm>

namespace lsdcd {

namespace {

// What is given is kept, the rest is tuned.
void check_tune(Tokens &w, const WallSettings &s)
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

void read_law(Tokens &w, WallSettings &s)
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

// Tokens of fix wall/gran and of LIGGGHTS, and what does their work here.
std::string answer_to(const std::string &word, bool granular)
{
  const char *const kMoves =
      "the words are motion wiggle Ax Ay Az period, and wiggle x|y|z amplitude period";
  const char *const kServo = "the words are servo force|torque x|y|z|axis ax ay az TARGET vmax V";
  const char *const kFlat =
      "the wall is a mesh: write mesh FILE in its place, or use fix wall/gran";
  const char *const kBelt =
      "the words are surface_vel vx vy vz and surface_angvel wx wy wz [cx cy cz]";
  const char *const kSpeed = "it is not needed: folds are measured, and all of them are walls";
  const char *const kReport = "the mesh is always looked through and told in the log: leave it out";
  const char *const kWeld = "the word for joining corners is weld tol";
  const char *const kLoads = "see mesh_fields FILE every N, and force and torque in f_ID[1] to "
                             "f_ID[6]";
  const char *const kNumbers =
      "the contact's numbers stand before mesh, or come from granular material FILE NAME";
  const struct {
    const char *word;
    const char *answer;
  } foreign[] = {
      {"target_val", kServo},
      {"vel_max", kServo},
      {"ctrlPV", kServo},
      {"vibrate", kMoves},
      {"move/mesh", "the words are motion linear, rotate, wiggle, transrot and variable"},
      {"zplane", kFlat},
      {"yplane", kFlat},
      {"xplane", kFlat},
      {"zcylinder", kFlat},
      {"region", kFlat},
      {"primitive", kFlat},
      {"velocity", kBelt},
      {"vel", kBelt},
      {"surface_ang_vel", kBelt},
      {"surface_omega", kBelt},
      {"curvature", kSpeed},
      {"curvature_tolerant", kSpeed},
      {"heal", kReport},
      {"verbose", kReport},
      {"element_exclusion_list", kReport},
      {"min_feature_length", kWeld},
      {"stress", kLoads},
      {"reference_point", "the words are torque_about x y z"},
      {"type", kNumbers},
      {"model", kNumbers},
      {"file", "the word is mesh FILE"},
      {"rolling_friction", "the words are rolling cdt MU and rolling epsd2 MU"},
  };
  for (const auto &row : foreign)
    if (word == row.word) return row.answer;
  for (const std::string &family : granular_families())
    if (word == family)
      return granular || word == "limit_damping" ? "it comes before mesh and other keywords"
                                                 : "it goes with the style granular, before mesh";
  return "";
}

[[noreturn]] void refuse_keyword(const std::string &word, const std::vector<std::string> &names,
                                 bool granular)
{
  const std::string wrong = "'" + word + "' is not a keyword";
  const std::string answer = answer_to(word, granular);
  if (!answer.empty()) throw InputError(wrong + " here: " + answer);
  std::vector<std::string> known = granular_families();
  known.insert(granular ? known.end() : known.begin(), names.begin(), names.end());
  const std::string near = nearest(word, known);
  const auto row = std::find(names.begin(), names.end(), near);
  if (is_like(word, near)) {
    const std::string of_family = granular || row == names.end() ? answer_to(near, granular) : "";
    throw InputError(wrong + "; the nearest is '" +
                     (of_family.empty() ? syntax_of(keywords()[row - names.begin()]) + "'"
                                        : near + "': " + of_family));
  }
  std::string all;
  for (const std::string &name : names) all += (all.empty() ? "" : ", ") + name;
  throw InputError(wrong + "; those are " + all);
}

}    // namespace

WallSettings parse_settings(const std::vector<std::string> &tokens)
{
  WallSettings settings;
  Tokens w(tokens);
  read_law(w, settings);

  std::vector<std::string> seen, names;
  for (const Keyword &row : keywords()) names.push_back(row.name);
  const bool granular = settings.law.style == LawStyle::granular;
  while (!w.done()) {
    const std::string word = w.take();
    const auto found = std::find(names.begin(), names.end(), word);
    if (found == names.end()) refuse_keyword(word, names, granular);
    const Keyword &row = keywords()[found - names.begin()];
    w.expect(row.name, syntax_of(row));
    const bool repeats = word == "scale" || word == "rotate" || word == "move" || word == "motion";
    if (!repeats && std::find(seen.begin(), seen.end(), word) != seen.end())
      w.fail("the keyword is given twice");
    seen.push_back(word);
    row.read(w, settings);
  }
  w.expect("fix wall/lsdcd", granular ? granular_syntax() : kLawSyntax);
  if (settings.mesh_file.empty()) w.fail("mesh FILE is missing");
  if (std::count(seen.begin(), seen.end(), "shear") &&
      std::count(seen.begin(), seen.end(), "surface_vel")) {
    w.expect("shear", "shear x|y|z v");
    w.fail("there is a surface_vel, too, which says the same: give one of them");
  }
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
