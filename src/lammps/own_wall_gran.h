// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Where LAMMPS's own fix wall/gran gives other forces for the words that fix wall/lsdcd shares with it.
#ifndef LSDCD_OWN_WALL_GRAN_H
#define LSDCD_OWN_WALL_GRAN_H

#include "law/contact_law.h"

#include <string>

namespace lsdcd {

// Returns what differs, as "its hooke/history multiplies kt by the contact radius"; empty: nothing is known to differ. `version`: of
// LAMMPS, as 20210929. `words`: the style's name, with `granular` all its words. doc/other-walls.md has the measured table.
std::string wall_gran_difference(int version, const std::string &words, const ContactLaw &law);

}    // namespace lsdcd

#endif
