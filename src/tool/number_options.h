// Options of numbers that several commands have, and their limits.
#pragma once

#include <CLI/CLI.hpp>

#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace lsdcd {

// Checks of words. CLI11's own would print the largest number there is.
inline bool is_number(const std::string &word, double &value)
{
  char *end = nullptr;
  value = std::strtod(word.c_str(), &end);
  return end != word.c_str() && *end == 0 && std::isfinite(value);
}
inline std::string above_zero(const std::string &word)
{
  double value;
  return is_number(word, value) && value > 0 ? "" : word + " is not a number above 0";
}
inline std::string not_below_zero(const std::string &word)
{
  double value;
  return is_number(word, value) && value >= 0 ? "" : word + " is not a number of 0 or more";
}

inline CLI::Option *add_scale_option(CLI::App *command, std::vector<double> &scale)
{
  return command->add_option("--scale", scale, "of the mesh: one factor, or three (x y z)")
      ->expected(1, 3);
}

// `weld` stays below 0 where it is not given.
inline void add_weld_option(CLI::App *command, double &weld)
{
  command
      ->add_option("--weld", weld,
                   "weld corners closer than this (default: 1e-6 of the box diagonal)")
      ->check(not_below_zero);
}

}    // namespace lsdcd
