// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/command.h"

#include "base/input_error.h"
#include "base/input_words.h"

#include <CLI/CLI.hpp>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>

namespace lsdcd {

namespace {

// Is the first word a command, and the next one, too, if that has subcommands? CLI11 would only say that
// one is missing.
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

// Names the first unknown option, and the nearest known one. False: all are known. CLI11 would first
// ask for missing options, and suggests nothing.
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

// A full disk shows when the last of the output is written, or has been by an earlier write.
void check_standard_output()
{
  errno = 0;
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return;
  throw InputError(std::string("the standard output: ") +
                   (errno ? std::strerror(errno) : "not all could be written; is its disk full?"));
}

}    // namespace

void throw_usage_error(const std::string &option, const std::string &what)
{
  throw CLI::ValidationError(option, what);
}

Option &Option::required()
{
  option_->required();
  return *this;
}

Option &Option::shows_default()
{
  option_->capture_default_str();
  return *this;
}

Option &Option::words(int least, int most)
{
  option_->expected(least, most);
  return *this;
}

Option &Option::one_of(const std::vector<std::string> &words)
{
  option_->check(CLI::IsMember(words));
  return *this;
}

Option &Option::range(int least, int most)
{
  option_->check(CLI::Range(least, most));
  return *this;
}

Option &Option::range(std::size_t least, std::size_t most)
{
  option_->check(CLI::Range(least, most));
  return *this;
}

Option &Option::check(const WordCheck &check, const std::string &what)
{
  option_->check(CLI::Validator([check](const std::string &word) { return check(word); }, what));
  return *this;
}

Option &Option::shows_words(const std::string &text)
{
  option_->option_text(text);
  return *this;
}

Option &Option::excludes(const Option &other)
{
  option_->excludes(other.option_);
  return *this;
}

template <class T>
Option Command::option(const std::string &name, T &value, const std::string &help)
{
  return Option(app_->add_option(name, value, help));
}
template Option Command::option(const std::string &, std::string &, const std::string &);
template Option Command::option(const std::string &, int &, const std::string &);
template Option Command::option(const std::string &, std::uint64_t &, const std::string &);
template Option Command::option(const std::string &, double &, const std::string &);
template Option Command::option(const std::string &, std::vector<double> &, const std::string &);
template Option Command::option(const std::string &, std::vector<std::string> &,
                                const std::string &);

void Command::flag(const std::string &name, bool &value, const std::string &help)
{
  app_->add_flag(name, value, help);
}

void Command::footer(const std::string &text)
{
  app_->footer(text);
}

void Command::runs(const std::function<void()> &run)
{
  app_->callback(run);
}

Command Command::command(const std::string &name, const std::string &help)
{
  return Command(app_->add_subcommand(name, help));
}

void Command::needs_a_command()
{
  app_->require_subcommand(1);
}

Program::Program(const std::string &help, const std::string &version) :
    Program(std::make_unique<CLI::App>(help))
{
  app_->set_version_flag("--version", version);
  needs_a_command();
}

Program::Program(std::unique_ptr<CLI::App> app) : Command(app.get()), app_(std::move(app)) {}

Program::~Program() = default;

void Program::passes_on(const std::string &name, const std::string &help,
                        const std::function<void(const std::vector<std::string> &)> &run)
{
  command(name, help);
  passed_on_[name] = run;
}

bool Program::run(int argc, char **argv)
{
  const auto other = argc > 1 ? passed_on_.find(argv[1]) : passed_on_.end();
  if (other != passed_on_.end()) {
    other->second({argv + 2, argv + argc});
    return true;
  }
  try {
    if (argc > 1 && !are_commands(*app_, argv + 1)) return false;
    const char *const help[] = {argv[0], "--help"};
    app_->parse(argc > 1 ? argc : 2, argc > 1 ? argv : help);
  } catch (const CLI::ParseError &e) {
    if (e.get_exit_code() != 0 && is_option_unknown(*app_, "lsdcd")) return false;
    if (app_->exit(e) != 0) return false;
  }
  check_standard_output();
  return true;
}

}    // namespace lsdcd
