// Registers fixes wall/lsdcd and massflow/lsdcd with the LAMMPS that loads this file; nothing else.

#include "lammps/fix_massflow_lsdcd.h"
#include "lammps/fix_wall_lsdcd.h"
#include "lammps/plugin_styles.h"

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *regfunc)
{
  if (!lsdcd::host_matches(lmp)) return;
  lsdcd::add_fix_style(lmp, handle, regfunc, "wall/lsdcd",
                       "fix wall/lsdcd: DEM walls from an STL mesh",
                       lsdcd::create_fix<LAMMPS_NS::FixWallLsdcd>);
  lsdcd::add_fix_style(lmp, handle, regfunc, "massflow/lsdcd",
                       "fix massflow/lsdcd: what passes a surface from an STL mesh",
                       lsdcd::create_fix<LAMMPS_NS::FixMassflowLsdcd>);
}
