// lsdcd: what can be done with a mesh without a simulation.
#include "base/input_error.h"
#include "base/input_words.h"
#include "tool/accuracy_command.h"
#include "tool/collide_command.h"
#include "tool/convert_command.h"
#include "tool/distance_command.h"
#include "tool/effects_command.h"
#include "tool/generate_command.h"
#include "tool/inspect_command.h"
#include "tool/material.h"
#include "tool/repair_command.h"
#include "tool/tradeoff_command.h"

#include <CLI/CLI.hpp>

#include <cstdio>
#include <new>
#include <string>
#include <vector>

using namespace lsdcd;

namespace {

// What the program ends with; doc/tool.md has them too.
constexpr int kDone = 0, kUnusable = 1, kUsage = 2;

// Is the first word a command, and the next one, where that has commands of its own? CLI11 would
// only say that one is missing.
bool are_commands(const CLI::App &app, char **word)
{
  if (!*word || **word == '-') return true;
  std::string all;
  for (const CLI::App *command : app.get_subcommands({})) {
    if (command->get_name() == *word)
      return command->get_subcommands({}).empty() || are_commands(*command, word + 1);
    all += (all.empty() ? "" : ", ") + command->get_name();
  }
  std::fprintf(stderr, "lsdcd: '%s' is not a command; those are %s\n", *word, all.c_str());
  return false;
}

// Names the first option that there is not, and the nearest. False: all are there. CLI11 would ask
// first for what is missing, and does not say what may have been meant.
bool is_option_unknown(const CLI::App &app, const std::string &name)
{
  for (const CLI::App *command : app.get_subcommands())
    if (is_option_unknown(*command, name + " " + command->get_name())) return true;
  std::vector<std::string> names;
  for (const CLI::Option *option : app.get_options()) {
    for (const std::string &one : option->get_lnames()) names.push_back("--" + one);
    for (const std::string &one : option->get_snames()) names.push_back("-" + one);
  }
  for (const std::string &word : app.remaining()) {
    double number;
    if (word.size() < 2 || word[0] != '-' || word == "--" || is_number(word, &number)) continue;
    const std::string given = word.substr(0, word.find('=')), near = nearest(given, names);
    std::fprintf(stderr, "lsdcd: '%s' is not an option of %s; %s\n", given.c_str(), name.c_str(),
                 is_near(given, near) ? ("the nearest is '" + near + "'").c_str()
                                      : (name + " --help has those").c_str());
    return true;
  }
  return false;
}

}    // namespace

int main(int argc, char **argv)
{
  CLI::App app{
      "lsdcd: meshes of DEM walls, their grids, distances to them, bodies in them, and materials"};
  app.require_subcommand(1);
  app.set_version_flag("--version", std::string("lsdcd " LSDCD_VERSION " (" LSDCD_COMMIT ")"));
  app.footer("lsdcd COMMAND --help tells more, with an example.\n"
             "Ends with 0: done; 1: a file or mesh cannot be used; 2: wrong words;\n"
             "3: repair has written what it cannot mend in full.");
  int exit_code = kDone;
  add_inspect_command(app);
  add_repair_command(app, exit_code);
  add_convert_command(app);
  add_generate_command(app);
  add_grid_command(app);
  add_distance_command(app);
  add_collide_command(app);
  add_material_command(app);
  add_tradeoff_command(app);
  add_accuracy_command(app);
  add_effects_command(app);

  try {
    if (argc > 1 && !are_commands(app, argv + 1)) return kUsage;
    app.parse(argc, argv);
  } catch (const CLI::ParseError &e) {
    if (e.get_exit_code() != 0 && is_option_unknown(app, "lsdcd")) return kUsage;
    return app.exit(e) == 0 ? kDone : kUsage;
  } catch (const std::bad_alloc &) {
    std::fprintf(stderr, "lsdcd: no memory left\n");
    return kUnusable;
  } catch (const std::exception &e) {
    std::fprintf(stderr, "lsdcd: %s\n", e.what());
    return kUnusable;
  }
  return exit_code;
}
