// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Lists of numbers under names, as bytes for a restart file.
#pragma once

#include "base/real.h"

#include <map>
#include <string>
#include <vector>

namespace lsdcd {

// A later version may add names: this one passes over those that it does not know.
class NamedNumbers {
 public:
  void set(const std::string &name, std::vector<Real> numbers);
  // At least `least` numbers. Throws InputError with the name where there are fewer, or none.
  const std::vector<Real> &at(const std::string &name, std::size_t least = 0) const;

  // The number of bytes is among them.
  std::string bytes() const;
  static NamedNumbers from(const char *bytes);

 private:
  std::map<std::string, std::vector<Real>> all_;
};

}    // namespace lsdcd
