// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Names of the files that a command writes, checked before its work.
#pragma once

#include "base/atomic_file.h"
#include "base/input_error.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace lsdcd {

struct OutputFile {
  const char *option;
  std::string path;           // empty: not asked for
  const char *ending = "";    // that the name needs; empty: the writer checks it
};

// Throws InputError if one would replace a file that the command reads, or another output, or has
// the wrong ending.
inline void check_outputs(const std::vector<OutputFile> &outputs,
                          const std::vector<std::string> &inputs = {})
{
  namespace fs = std::filesystem;
  std::error_code failed;    // of a file that does not exist yet
  for (std::size_t i = 0; i < outputs.size(); i++) {
    const OutputFile &o = outputs[i];
    if (o.path.empty()) continue;
    const std::string what = std::string(o.option) + " " + o.path;
    if (*o.ending && !ends_in(o.path, o.ending))
      throw InputError(what + ": end the name in " + o.ending);
    for (const std::string &input : inputs)
      if (!input.empty() && fs::equivalent(o.path, input, failed))
        throw InputError(what + " would replace " + input +
                         ", which this command reads: give another name");
    for (std::size_t k = 0; k < i; k++)
      if (!outputs[k].path.empty() && fs::weakly_canonical(fs::absolute(o.path)) ==
                                          fs::weakly_canonical(fs::absolute(outputs[k].path)))
        throw InputError(std::string(outputs[k].option) + " and " + o.option +
                         " are the same file, " + o.path + ": give two names");
  }
}

}    // namespace lsdcd
