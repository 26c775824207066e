// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The wall's part of the pressure, where fix_modify virial yes asks for it.

#include "lammps/fix_wall_lsdcd.h"

using namespace LAMMPS_NS;

// Only an engine that keeps records of contacts can tell. Collective.
void FixWallLsdcd::make_engine_with_virial()
{
  if (!thermo_virial || engine_records) return;
  make_engine_anew();
}

// Arm times force on the sphere, over the contacts of the step just computed, as LAMMPS's flat walls
// have it: the arm goes from the wall's closest point to the sphere's centre.
void FixWallLsdcd::add_virial()
{
  if (cutoff() == 0) return;
  const lsdcd::ContactRecord *record = engine->records();
  for (int k = 0; k < engine->n_records(); k++) {
    const lsdcd::WallPose &pose = parts[record[k].mesh].motion.pose();
    const lsdcd::Vec3 r = pose.turn_to_box(record[k].arm), f = -pose.turn_to_box(record[k].force);
    double part[6] = {r.x * f.x, r.y * f.y, r.z * f.z, r.x * f.y, r.x * f.z, r.y * f.z};
    for (int c = 0; c < 6; c++) virial[c] += part[c];
  }
}
