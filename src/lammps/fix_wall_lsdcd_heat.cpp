// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// Heat between the wall and the atoms that touch it: LAMMPS's per-atom temperature and
// heat flow, and the wall's temperature, which may be a variable.

#include "lammps/fix_wall_lsdcd.h"

#include "atom.h"

using namespace LAMMPS_NS;

// The first stable LAMMPS with fix heat/flow and what it integrates.
#define HOST_HAS_HEAT (LSDCD_HOST_VERSION >= 20230802)

void FixWallLsdcd::check_heat()
{
#if HOST_HAS_HEAT
  if (!atom->temperature_flag || !atom->heatflow_flag)
    fatal("the sub-model heat needs a temperature and a heat flow per atom: fix ID all "
          "property/atom temperature heatflow ghost yes, and fix heat/flow to change them");
#else
  fatal("the sub-model heat needs a LAMMPS with fix heat/flow, of 2 Aug 2023 or later");
#endif
}

void FixWallLsdcd::give_heat(lsdcd::Spheres &spheres, lsdcd::StepSettings &step)
{
#if HOST_HAS_HEAT
  spheres.temperature = atom->temperature;
  spheres.heat_flow = atom->heatflow;
#else
  (void) spheres;
#endif
  std::vector<std::string> names;
  for (const MeshPart &m : parts)
    if (!m.settings.temperature_variable.empty()) names.push_back(m.settings.temperature_variable);
  const std::vector<double> values = host.variables(names);
  auto next = values.begin();
  temperatures.clear();
  for (const MeshPart &m : parts)
    temperatures.push_back(m.settings.temperature_variable.empty() ? m.settings.temperature
                                                                   : *next++);
  step.wall_temperature = temperatures.front();
  if (several()) step.mesh_temperature = temperatures.data();
}
