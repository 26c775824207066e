// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A step of grains that are no spheres beside one of spheres, on one core: those of shape_bed.h.
#include "bench.h"
#include "shape_bed.h"

#include <string>

using namespace lsdcd;

namespace {

void measure(const BenchOptions &o, BenchRows &rows)
{
  const int n = static_cast<int>(o.spheres > 0 ? o.spheres : o.quick ? 200 : 2000);
  const int repeats = o.repeats > 0 ? o.repeats : o.quick ? 1 : 21;
  rows.begin(Device::cpu);
  for (const ShapePlace place :
       {ShapePlace::face, ShapePlace::edge, ShapePlace::fold, ShapePlace::above}) {
    for (const ShapeKind &kind : kShapeKinds) {
      if (place == ShapePlace::above && kind.is_sphere) continue;    // it has no list
      ShapeBed bed(kind, place, n);
      BenchRow row;
      row.what = std::string(kind.name) + ", " + kShapePlaces[static_cast<int>(place)];
      row.triangles = bed.triangles();
      row.spheres = n;
      row.order = "sorted";
      row.timing = time_it(repeats, [&] { bed.steps(); });
      const double each = 1e6 * row.timing.min_ms / (ShapeBed::kSteps * n);
      row.facts =
          format("steps=%d ns_each=%.1f contacts=%.3f listed=%.1f ns_listed=%.1f", ShapeBed::kSteps,
                 each, bed.contacts() / n, bed.listed(), each / bed.listed());
      rows.add(row);
    }
  }
}

}    // namespace

int main(int argc, char **argv)
{
  return run_bench(argc, argv, "shapes", "Steps of grains that are no spheres: CSV.", measure);
}
