// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Options of a grid's cells, which grids and bodies have alike.
#pragma once

#include "api/c_border.h"
#include "base/input_words.h"
#include "grid/triangle_grid.h"

#include <cmath>
#include <string>

namespace lsdcd {

// `options`: an lsdcd_grid_options or lsdcd_body_options, which `name` names.
template <class Options>
void check_cell_options(const std::string &name, const Options &options)
{
  const auto refuse = [&](const std::string &text) { refuse_option(name, text); };
  if (!(options.cell >= 0) || !std::isfinite(options.cell))
    refuse("cell is " + number_text(options.cell) + "; give a length, or 0 to have it chosen");
  if (options.nearest < 0 || options.nearest > kMaxNearest)
    refuse("nearest is " + std::to_string(options.nearest) + "; it is 0, for all, or up to " +
           std::to_string(kMaxNearest));
  if (!(options.memory >= 0) || !(options.memory < 1e18))
    refuse("memory is " + number_text(options.memory) + "; give bytes, or 0 for the default");
  if (options.device != LSDCD_CPU && options.device != LSDCD_CUDA)
    refuse("device is neither LSDCD_CPU nor LSDCD_CUDA");
}

}    // namespace lsdcd
