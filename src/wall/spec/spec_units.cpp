// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/spec/spec_units.h"

#include "law/make_law.h"
#include "wall/spec/spec_check.h"

namespace lsdcd {

WallSpec in_units(WallSpec spec, Real pressure, Real velocity)
{
  check_spec(spec);
  const auto convert = [&](ContactLaw &law) {
    check_dashpots(law, velocity);
    if (law.is_classic() && law.is(NormalModel::hertz)) {
      law.k_normal /= pressure;
      law.k_tangent /= pressure;
    }
    law.for_shapes = spec.shapes;
    law.keeps_forces = spec.energy;
    law.keeps_at_nodes = spec.energy && spec.has_nodes();
    law.keeps_losses = spec.energy && spec.each_contact;
    law.keeps_touch = spec.impact_speed > 0 || spec.wears_by_impact();
  };
  for (LawOfTypes &row : spec.laws) convert(row.law);
  for (MeshSpec &mesh : spec.meshes) {
    for (LawOfTypes &row : mesh.laws) convert(row.law);
    mesh.pressure /= pressure;
  }
  if (!spec.wears_by_impact()) spec.wear.per_work *= pressure;
  if (spec.shapes) spec.device = Device::cpu;
  return spec;
}

}    // namespace lsdcd
