// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The words of choices of a WallSpec in scripts, options, logs and messages.
#pragma once

#include "engine/settings.h"

#include <cstddef>
#include <iterator>
#include <string>
#include <vector>

namespace lsdcd {

// In the order of their enums.
constexpr const char *kCornerWords[] = {"blend", "sum"}, *kSideWords[] = {"both", "in", "out"},
                     *kDeviceWords[] = {"auto", "cpu", "cuda"},
                     *kWearWords[] = {"none", "archard", "finnie", "oka"};

template <std::size_t n>
std::vector<std::string> all_words(const char *const (&words)[n])
{
  return {std::begin(words), std::end(words)};
}

template <class Choice, std::size_t n>
const char *word_of(Choice choice, const char *const (&words)[n])
{
  return words[static_cast<std::size_t>(choice)];
}

}    // namespace lsdcd
