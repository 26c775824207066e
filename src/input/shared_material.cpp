// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/shared_material.h"

namespace lsdcd {

FilledTokens fill_material(Host &host, const std::vector<std::string> &tokens,
                           const std::string &units)
{
  FilledTokens filled;
  run_collectively(host, host.is_first(), [&] { filled = fill_material(tokens, units); });

  std::string text;    // each word with a NUL, which none can contain
  for (const std::string &word : filled.tokens) text.append(word.c_str(), word.size() + 1);
  broadcast_text(host, text);
  filled.tokens.clear();
  for (std::size_t at = 0; at < text.size(); at += filled.tokens.back().size() + 1)
    filled.tokens.push_back(text.c_str() + at);
  return filled;
}

}    // namespace lsdcd
