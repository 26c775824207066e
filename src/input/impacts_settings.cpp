// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/impacts_settings.h"

#include "base/input_words.h"
#include "input/keywords.h"
#include "input/value_words.h"

namespace lsdcd {

namespace {

const char *const kImpactsSyntax =
    "compute ID all lsdcd/impacts V [impact_spectrum FILE every N] [names PREFIX NAME ...]";

}    // namespace

ImpactsSettings parse_impacts(const std::vector<std::string> &tokens)
{
  ImpactsSettings settings;
  Tokens w(tokens);
  w.set_context("compute lsdcd/impacts", kImpactsSyntax);
  settings.least_speed = w.number("V", kAboveZero);
  while (!w.done()) {
    const std::string word = w.take();
    if (word != "impact_spectrum") w.fail("'" + word + "' is not expected");
    if (settings.spectrum.every > 0) w.fail("the keyword '" + word + "' is given twice");
    w.set_context(word, "impact_spectrum FILE every N");
    settings.spectrum = read_file_every(w, ".csv");
    w.set_context("compute lsdcd/impacts", kImpactsSyntax);
  }
  return settings;
}

}    // namespace lsdcd
