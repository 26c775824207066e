// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Messages of our fixes, computes and regions: kind, ID and style stand before each.
#ifndef LMP_OWN_MESSAGES_H
#define LMP_OWN_MESSAGES_H

#include <string>

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

  // By the first process.
  void log(const std::string &) const;
  void warn(const std::string &) const;
  // They end LAMMPS; the second one where this process alone knows of the problem.
  [[noreturn]] void fatal(const std::string &) const;
  [[noreturn]] void fatal_here(const std::string &) const;

 private:
  class LAMMPS *lammps;
  std::string begin;
};

}    // namespace LAMMPS_NS

#endif
