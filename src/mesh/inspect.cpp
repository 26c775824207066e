// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "mesh/welded_mesh.h"

#include "base/input_words.h"

#include <cmath>
#include <cstdio>

namespace lsdcd {
namespace {

std::string text(const Vec3 &a)
{
  return "(" + number_text(a.x) + ", " + number_text(a.y) + ", " + number_text(a.z) + ")";
}

// A line on facets that the file has in both windings; empty where there is none.
std::string two_sided(const MeshReport &report)
{
  if (report.two_sided_faces == 0) return "";
  const std::size_t faces = report.facets - report.degenerate_facets - report.duplicate_facets;
  const bool are_all = report.two_sided_faces == faces;
  std::string text =
      (are_all ? "each facet is" : counted(report.two_sided_faces, "facet is", "facets are")) +
      " there in both windings";
  if (are_all) text += ", as in a double-sided export";
  if (report.closed && report.sheet_faces == faces) text += ", so the mesh encloses nothing";
  if (report.closed || are_all) text += "; lsdcd repair keeps one of each pair";
  return text;
}

// On facets as small as the rounding of the file.
std::string coarse(const MeshReport &report)
{
  return "the coordinates have steps of " + number_text(report.coordinate_step) + " where " +
         counted(report.coarse_corners, "corner") +
         " on open edges have shorter edges than four of these: cracks between them stay";
}

std::string surface(const MeshReport &report)
{
  const std::string both = two_sided(report);
  if (!report.closed) {
    const std::string open = report.open_edges > 0
                                 ? "open"
                                 : "not closed: edges with three facets or another odd number";
    return both.empty() ? open : open + "; " + both;
  }
  if (!both.empty()) return "closed, but " + both;
  if (report.meeting_pairs > 0)
    return "closed, but cuts or touches itself: " +
           counted(report.meeting_pairs, "pair of facets", "pairs of facets");
  if (report.inverted_facets > 0) return "closed, normals of some shells point in, of others out";
  if (!report.oriented) return "closed, not all facets face the same side";
  const std::string touching =
      report.nonmanifold_edges == 0
          ? ""
          : "; solids touch along " + counted(report.nonmanifold_edges, "edge");
  return (report.volume > 0 ? "closed, normals point out" : "closed, normals point in") + touching;
}

}    // namespace

std::string weld_warning(const MeshReport &report)
{
  if (report.coarse_corners == 0) return "";
  return coarse(report) +
         ". Export the mesh with more digits or nearer to the origin, or give weld a length";
}

std::string describe(const MeshReport &report, const std::string &source)
{
  std::string block = "mesh " + source;
  const auto line = [&](const char *name, const std::string &value) {
    char label[24];
    std::snprintf(label, sizeof label, "\n  %-12s", name);
    block += label + value;
  };
  line("facets", std::to_string(report.facets) + ", " + std::to_string(report.degenerate_facets) +
                     " degenerate and " + counted(report.duplicate_facets, "duplicate") +
                     " dropped");
  line("vertices", std::to_string(report.vertices) + ", welded from " +
                       counted(report.corners, "corner") + " (tolerance " +
                       number_text(report.weld_tolerance) + ")");
  if (report.closed_cracks > 0)
    line("cracks", "closed at " + counted(report.closed_cracks, "corner") +
                       ", which moved by up to " + number_text(report.widest_crack));
  if (report.collapsed_facets > 0)
    line("collapsed", counted(report.collapsed_facets, "facet") +
                          " of the degenerate ones, with an area of " +
                          number_text(report.collapsed_area));
  if (report.coarse_corners > 0) line("rounding", coarse(report));
  line("edges", std::to_string(report.edges) + ", " + std::to_string(report.open_edges) +
                    " open, " + std::to_string(report.nonmanifold_edges) + " non-manifold, " +
                    std::to_string(report.misoriented_edges) + " misoriented");
  line("surface", surface(report));
  line("area", number_text(report.area));
  if (report.oriented) line("volume", number_text(std::fabs(report.volume)));
  line("box", text(report.lo) + " to " + text(report.hi));
  line("edge length", number_text(report.smallest_edge) + " smallest, " +
                          number_text(report.median_edge) + " median, " +
                          number_text(report.largest_edge) + " largest");
  line("thinnest", "face " + number_text(report.smallest_height) + " high");
  line("folds", number_text(report.largest_fold) + " degrees at most, " +
                    counted(report.feature_edges, "edge") + " above 30");
  return block;
}

}    // namespace lsdcd
