#include "tune/tune.h"

#include <cstdio>

namespace lsdcd {

std::string describe(const TuneReport &r)
{
  char line[256];
  std::snprintf(line, sizeof line,
                "tune %g: %d spheres of the scene and %d beside the wall, in %d of %d cubes of "
                "side %.4g round it; %.2f s on %s\n",
                r.bound, r.scene, r.band, r.parts, r.all_parts, r.part_side, r.seconds,
                r.device.c_str());
  std::string text = line;
  text += "  Times are of a step of these spheres alone, with caches filled by other work; missed "
          "contacts and force\n  errors are against complete lists in double.";
  text += r.extrapolated() ? " Only these cubes were built: MB are extrapolated.\n" : "\n";
  text += "        grid  nearest   precision      missed  uncertified  force error: median  largest"
          "  ns/sphere        MB\n";
  for (std::size_t i = 0; i < r.rows.size(); i++) {
    const TuneRow &row = r.rows[i];
    std::snprintf(
        line, sizeof line, "  %10.5g  %-8s  %-9s  %8.3g %%  %11ld  %19.2g  %7.2g  %9.1f  %8.3g%s\n",
        row.choice.length, lists_name(row.choice).c_str(), precision_name(row.choice.precision),
        100 * row.error.missed_share(), row.error.uncertified, row.error.median, row.error.largest,
        row.ns_per_sphere, row.bytes / 1e6,
        static_cast<int>(i) == r.taken ? "  <- taken" : (row.accepted ? "  good" : ""));
    text += line;
  }
  const GridChoice &c = r.choice();
  std::snprintf(line, sizeof line, "  taken: grid %.6g nearest %s precision %s", c.length,
                lists_name(c).c_str(), precision_name(c.precision));
  return text + line;
}

}    // namespace lsdcd
