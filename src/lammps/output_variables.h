// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Numbers of our fixes and computes under names of their own, which scripts read as variables.
#ifndef LMP_LSDCD_OUTPUT_VARIABLES_H
#define LMP_LSDCD_OUTPUT_VARIABLES_H

#include "output/output_row.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class OutputVariables {
 public:
  // `reference`: what LAMMPS calls the style's numbers, "f_ID" of a fix and "c_ID" of a compute.
  OutputVariables(class LAMMPS *lmp, const std::string &reference);
  // Deletes the variables that it has made.
  ~OutputVariables();
  OutputVariables(const OutputVariables &) = delete;
  OutputVariables &operator=(const OutputVariables &) = delete;

  // Makes an equal-style variable PREFIX_NAME of each number that `words` ask for: names PREFIX NAME [NAME ...], or names PREFIX all, which
  // stand up to the end of the words. `known`: the numbers that there are. `row`: of which row of the style's array, from 1; 0: of its
  // vector and scalar. `why_not`: why there is no number of a name. Throws InputError, and makes none then.
  void make(const std::vector<std::string> &words, const std::vector<lsdcd::NamedElement> &known,
            int row, const std::function<std::string(const std::string &)> &why_not);
  // Makes variables, as above, of a style whose numbers do not depend on its settings.
  void make(const std::vector<std::string> &words, const std::vector<lsdcd::NamedElement> &known,
            int row = 0);

 private:
  class LAMMPS *lammps;
  std::string reference;
  std::vector<std::string> made;
};

}    // namespace LAMMPS_NS

#endif
