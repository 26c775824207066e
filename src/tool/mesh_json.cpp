// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/mesh_json.h"

#include "base/number_words.h"

namespace lsdcd {

void print_json(std::FILE *to, const nlohmann::json &all)
{
  constexpr auto kReplace = nlohmann::json::error_handler_t::replace;
  std::fprintf(to, "%s\n", all.dump(2, ' ', false, kReplace).c_str());
}

nlohmann::json as_json(const Vec3 &v)
{
  return {v.x, v.y, v.z};
}

nlohmann::json as_json(const MeshReport &r)
{
  return {{"facets", r.facets},
          {"vertices", r.vertices},
          {"degenerate_facets", r.degenerate_facets},
          {"duplicate_facets", r.duplicate_facets},
          {"two_sided_faces", r.two_sided_faces},
          {"edges", r.edges},
          {"open_edges", r.open_edges},
          {"nonmanifold_edges", r.nonmanifold_edges},
          {"misoriented_edges", r.misoriented_edges},
          {"inverted_facets", r.inverted_facets},
          {"meeting_pairs", r.meeting_pairs},
          {"closed", r.closed},
          {"oriented", r.oriented},
          {"weld_tolerance", r.weld_tolerance},
          {"closed_cracks", r.closed_cracks},
          {"widest_crack", r.widest_crack},
          {"coarse_corners", r.coarse_corners},
          {"coordinate_step", r.coordinate_step},
          {"collapsed_facets", r.collapsed_facets},
          {"collapsed_area", r.collapsed_area},
          {"area", r.area},
          {"volume", r.volume},
          {"lo", as_json(r.lo)},
          {"hi", as_json(r.hi)},
          {"smallest_edge", r.smallest_edge},
          {"median_edge", r.median_edge},
          {"largest_edge", r.largest_edge},
          {"smallest_height", r.smallest_height},
          {"largest_fold_degrees", r.largest_fold},
          {"feature_edges", r.feature_edges},
          {"clean", problems_of(r).empty()},
          {"problems", problems_of(r)}};
}

std::vector<std::string> problems_of(const MeshReport &report)
{
  std::vector<std::string> found;
  const auto count = [&](std::size_t n, const char *one, const char *many) {
    if (n > 0) found.push_back(counted(n, one, many));
  };
  count(report.degenerate_facets, "degenerate facet", "degenerate facets");
  count(report.duplicate_facets, "duplicate facet", "duplicate facets");
  count(report.two_sided_faces, "facet in both windings", "facets in both windings");
  // Where solids touch along edges these have more than two facets, and that is no problem.
  if (!report.closed || report.misoriented_edges > 0)
    count(report.nonmanifold_edges, "edge of more than two facets",
          "edges of more than two facets");
  count(report.misoriented_edges, "edge along which windings disagree",
        "edges along which windings disagree");
  count(report.inverted_facets, "facet of a closed shell wound against the others",
        "facets of closed shells wound against the others");
  count(report.meeting_pairs, "pair of facets that cut or touch each other",
        "pairs of facets that cut or touch each other");
  if (report.oriented && report.volume < 0) found.push_back("normals that point in");
  return found;
}

std::string verdict_line(const MeshReport &report)
{
  std::string why;
  for (const std::string &problem : problems_of(report)) why += (why.empty() ? "" : ", ") + problem;
  const std::string open = report.closed ? "" : ", but open";
  return "  clean       " + (why.empty() ? "yes" + open : "no: " + why);
}

}    // namespace lsdcd
