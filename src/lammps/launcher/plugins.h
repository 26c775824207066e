// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The plugin command for a LAMMPS that was built without it.
#pragma once

#include <string>
#include <vector>

namespace LAMMPS_NS {
class LAMMPS;
}

namespace lsdcd {

// Registers the plugin command, then loads ../lib/lsdcdplugin.so beside this
// executable and every *plugin.so of LAMMPS_PLUGIN_PATH. To be called for each
// new set of style maps: after construction and after LAMMPS's clear.
void provide_plugins(LAMMPS_NS::LAMMPS *lmp);

// plugin load FILES | unload STYLE NAME | list | clear
void run_plugin_command(LAMMPS_NS::LAMMPS *lmp, const std::vector<std::string> &tokens);

}    // namespace lsdcd
