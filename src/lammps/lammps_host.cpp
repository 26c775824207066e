// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/lammps_host.h"

#include "lammps/fix_wall_lsdcd.h"
#include "lammps/host_box.h"

#include "domain.h"
#include "neighbor.h"


using namespace LAMMPS_NS;

LammpsHost::LammpsHost(FixWallLsdcd &fix) : MpiNodeHost(fix.world), fix(fix) {}

lsdcd::PeriodicBox LammpsHost::box() const
{
  lsdcd::PeriodicBox box = lsdcd::host_box(*fix.domain);
  box.margin = fix.neighbor->skin;
  return box;
}

void LammpsHost::show(const std::string &text, bool is_warning)
{
  if (is_warning)
    fix.warn(text);
  else
    fix.log(text);
}
