// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "variable_formula.h"

#include <cctype>
#include <cstddef>
#include <set>

namespace lsdcd {

namespace {

// Mathematical and special functions of LAMMPS whose arguments are formulas.
const std::set<std::string> kFunctions = {
    "sqrt",   "exp",     "ln",        "log",     "abs",     "sign",    "sin",      "cos",
    "tan",    "asin",    "acos",      "atan",    "atan2",   "random",  "normal",   "ceil",
    "floor",  "round",   "ternary",   "ramp",    "stagger", "logfreq", "logfreq2", "logfreq3",
    "stride", "stride2", "vdisplace", "swiggle", "cwiggle"};
const std::set<std::string> kOfTheRun = {
    "step",      "elapsed", "elaplong",   "dt",  "time", "cpu", "tpcpu", "spcpu",
    "cpuremain", "part",    "timeremain", "vol", "lx",   "ly",  "lz",    "xlo",
    "xhi",       "ylo",     "yhi",        "zlo", "zhi",  "xy",  "xz",    "yz",
    "PI",        "version", "yes",        "no",  "on",   "off", "true",  "false"};

bool is_name(char c)
{
  return std::isalnum(static_cast<unsigned char>(c)) || c == '_';
}

// Returns where the number that begins at `at` ends.
std::size_t end_of_number(const std::string &s, std::size_t at)
{
  const auto is_digit = [&](std::size_t k) {
    return k < s.size() && (std::isdigit(static_cast<unsigned char>(s[k])) || s[k] == '.');
  };
  while (is_digit(at)) at++;
  if (at < s.size() && (s[at] == 'e' || s[at] == 'E')) {
    at++;
    if (at < s.size() && (s[at] == '+' || s[at] == '-')) at++;
    while (is_digit(at)) at++;
  }
  return at;
}

}    // namespace

bool formula_reads_atoms(const std::string &formula,
                         const std::function<bool(const std::string &)> &variable_does,
                         const std::function<bool(const std::string &)> &compute_does)
{
  for (std::size_t at = 0; at < formula.size();) {
    const char c = formula[at];
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.') {
      at = end_of_number(formula, at);
      continue;
    }
    if (!is_name(c)) {
      at++;
      continue;
    }
    std::size_t end = at;
    while (end < formula.size() && is_name(formula[end])) end++;
    const std::string name = formula.substr(at, end - at), kind = name.substr(0, 2);
    const char next = end < formula.size() ? formula[end] : ' ';
    bool reads = false;
    if (kind == "v_")
      reads = variable_does(name.substr(2));
    else if (kind == "c_" || kind == "C_")
      reads = compute_does(name.substr(2));
    else if (kind == "f_" || kind == "F_")
      reads = false;
    else if (next == '(')
      reads = kFunctions.count(name) == 0;
    else
      reads = next == '[' || kOfTheRun.count(name) == 0;
    if (reads) return true;
    at = end;
  }
  return false;
}

}    // namespace lsdcd
