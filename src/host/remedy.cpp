// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "host/remedy.h"

namespace lsdcd {

std::string library_remedy(Remedy remedy)
{
  switch (remedy) {
    case Remedy::wrap_sooner:
      return "wrap spheres sooner, or give a larger margin";
    case Remedy::put_clear:
      return "put spheres a radius away from the mesh";
    case Remedy::stay_in_plane:
      return "spheres lose what the faces push along z";
    case Remedy::give_radii:
      return "give radii";
    case Remedy::give_other_radii:
    case Remedy::set_radii:
      return "give `radius` in the units of the mesh";
    case Remedy::follow_spheres:
      return "leave out its bounds";
    case Remedy::make_room:
      return "give a smaller reach, so that they are selected more often, or restore a saved "
             "state, "
             "which makes "
             "room for them";
    case Remedy::announce_growth:
      return "set `changed` in a step with other radii";
    case Remedy::begin_motion:
      return "start another motion, which begins where the mesh is";
    case Remedy::begin_servo:
      return "give another servo, which goes on from there";
    case Remedy::give_velocities:
      return "give velocities as well";
    case Remedy::give_displacements:
      return "give displacements as well";
    case Remedy::begin_replay:
      return "make the wall with the step in which the motion began";
    case Remedy::compute_on_host:
      return "make the wall with `device` cpu";
  }
  return "";
}

}    // namespace lsdcd
