// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Messages of our fixes, computes and regions: kind, ID and style stand before each.
#ifndef LMP_OWN_MESSAGES_H
#define LMP_OWN_MESSAGES_H

#include "base/input_error.h"
#include "host/host.h"

#include <new>
#include <stdexcept>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class OwnMessages {
 protected:
  // kind: "Fix", style: "wall/lsdcd".
  OwnMessages(class LAMMPS *lmp, const std::string &kind, const std::string &id,
              const std::string &style) :
      lammps(lmp),
      begin(kind + " " + id + " " + style + ": ")
  {
  }

  // Returns the words of a command from `first` on. Throws InputError for an '&' that continues no line.
  static std::vector<std::string> words_of(char **first, char **end);

  // Write to the log, by the first process.
  void log(const std::string &) const;
  void warn(const std::string &) const;
  // End LAMMPS; fatal_here() if only this process knows of the problem.
  [[noreturn]] void fatal(const std::string &) const;
  [[noreturn]] void fatal_here(const std::string &) const;

  // Runs work of the core, returns what it returns, and ends LAMMPS with what it throws. Exceptions of LAMMPS pass.
  // Memory may run out on one process alone, and so may errors that are local.
  template <class Work>
  auto run_core(Work &&work) const -> decltype(work());
  // Runs work of the core as run_core() does, where only this process does it: its errors are local.
  template <class Work>
  auto run_core_here(Work &&work) const -> decltype(work());

 private:
  class LAMMPS *lammps;
  std::string begin;
};

template <class Work>
auto OwnMessages::run_core(Work &&work) const -> decltype(work())
{
  try {
    return work();
  } catch (const lsdcd::InputError &e) {
    if (e.is_local) fatal_here(e.what());
    fatal(e.what());
  } catch (const std::bad_alloc &) {
    fatal_here("out of memory");
  } catch (const std::runtime_error &e) {
    fatal(e.what());
  } catch (const std::logic_error &e) {
    fatal(e.what());
  }
}

template <class Work>
auto OwnMessages::run_core_here(Work &&work) const -> decltype(work())
{
  try {
    return work();
  } catch (const std::bad_alloc &) {
    fatal_here("out of memory");
  } catch (const std::runtime_error &e) {
    fatal_here(e.what());
  } catch (const std::logic_error &e) {
    fatal_here(e.what());
  }
}

}    // namespace LAMMPS_NS

#endif
