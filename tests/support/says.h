// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// What errors and reports say, and words of scripts.
#pragma once

#include "base/input_error.h"

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

namespace lsdcd {

// Splits a line of a script at its spaces.
inline std::vector<std::string> words(const std::string &line)
{
  std::istringstream stream(line);
  std::vector<std::string> all;
  for (std::string word; stream >> word;) all.push_back(word);
  return all;
}

// Is `part` in the text? A failure shows both.
inline testing::AssertionResult has(const std::string &text, const std::string &part)
{
  if (text.find(part) != std::string::npos) return testing::AssertionSuccess() << text;
  return testing::AssertionFailure() << "'" << part << "' is not in '" << text << "'";
}

// Is each of `parts` in the text?
inline testing::AssertionResult says(const std::string &text, const std::vector<std::string> &parts)
{
  for (const std::string &part : parts)
    if (const testing::AssertionResult found = has(text, part); !found) return found;
  return testing::AssertionSuccess();
}

// Does the text begin with `part`?
inline testing::AssertionResult begins(const std::string &text, const std::string &part)
{
  if (text.rfind(part, 0) == 0) return testing::AssertionSuccess() << text;
  return testing::AssertionFailure() << "'" << text << "' does not begin with '" << part << "'";
}

// Returns what the InputError says that `work` throws, or an empty text where it throws none.
template <class Work>
std::string error_of(const Work &work)
{
  try {
    work();
  } catch (const InputError &e) {
    return e.what();
  }
  return "";
}

// Does `work` throw an InputError that says `part`?
template <class Work>
testing::AssertionResult fails_with(const std::string &part, const Work &work)
{
  const std::string error = error_of(work);
  if (error.empty()) return testing::AssertionFailure() << "no error, not '" << part << "'";
  return has(error, part);
}

}    // namespace lsdcd
