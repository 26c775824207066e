// What plugin files of this library share: the check of the host, and telling it a style.
#pragma once

#include "fix.h"

#include "lammps/plugin_api.h"

namespace lsdcd {

// LAMMPS's classes change their layout from version to version and nothing in the loader
// compares them: a plugin of another version would crash later. Says on the first process
// why it does not match. Touches no object of LAMMPS.
bool host_matches(void *lmp);

void add_fix_style(void *lmp, void *handle, void *regfunc, const char *name, const char *info,
                   lammpsplugin_factory2 *create);

template <class Fix>
void *create_fix(void *lmp, int narg, char **arg)
{
  return new Fix(static_cast<LAMMPS_NS::LAMMPS *>(lmp), narg, arg);
}

}    // namespace lsdcd
