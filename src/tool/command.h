// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of a command: its options, its help and what it runs. Only command.cpp includes CLI11, whose
// headers take longer to compile than a command does.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
}    // namespace CLI

namespace lsdcd {

// Ends the program with 2, as wrong words do: names the option, and what is wrong with it.
[[noreturn]] void throw_usage_error(const std::string &option, const std::string &what);

// Why a word is wrong; empty: it is right.
using WordCheck = std::function<std::string(const std::string &)>;

// An option, borrowed from its command. Each function returns the option itself.
class Option {
 public:
  explicit Option(CLI::Option *option) : option_(option) {}

  Option &required();
  Option &shows_default();
  // Returns how many words it takes; `most` -1: any number.
  Option &words(int least, int most);
  Option &one_of(const std::vector<std::string> &words);
  Option &range(int least, int most);
  Option &range(std::size_t least, std::size_t most);
  // `what`: what --help calls a word of the option.
  Option &check(const WordCheck &check, const std::string &what = "");
  // Returns the words that --help shows instead of the type.
  Option &shows_words(const std::string &text);
  Option &excludes(const Option &other);

 private:
  CLI::Option *option_;
};

// A command, borrowed from the program.
class Command {
 public:
  explicit Command(CLI::App *app) : app_(app) {}

  // `name`: "file" is positional, "-o,--output" is an option. `value` holds the default. It must
  // outlive the command, and is a string, a number, or a vector of these.
  template <class T>
  Option option(const std::string &name, T &value, const std::string &help);
  void flag(const std::string &name, bool &value, const std::string &help);
  // Below the options in --help.
  void footer(const std::string &text);
  void runs(const std::function<void()> &run);
  Command command(const std::string &name, const std::string &help);
  void needs_a_command();

 private:
  CLI::App *app_;
};

// All commands.
class Program : public Command {
 public:
  Program(const std::string &help, const std::string &version);
  ~Program();

  // Adds a command that is another program: it gets all words behind its name, `--help` included.
  void passes_on(const std::string &name, const std::string &help,
                 const std::function<void(const std::vector<std::string> &)> &run);
  // Runs the command that the words name, or prints the version or, also where there is no word, the help.
  // Returns whether the words are right; if not, it has printed what is wrong. Throws what a command
  // throws, and InputError where the standard output has not accepted all that was printed.
  bool run(int argc, char **argv);

 private:
  explicit Program(std::unique_ptr<CLI::App> app);

  std::unique_ptr<CLI::App> app_;
  std::map<std::string, std::function<void(const std::vector<std::string> &)>> passed_on_;
};

}    // namespace lsdcd
