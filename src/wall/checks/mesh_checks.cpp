// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/mesh_checks.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "base/vector_text.h"
#include "mesh/plane_cut.h"
#include "mesh/split_faces.h"
#include "wall/checks/faces_pushed.h"
#include "wall/spec/mesh_name.h"

#include <algorithm>

namespace lsdcd {

void check_side(const WallSpec &settings, const MeshPart &m)
{
  const MeshReport &r = m.grid.report();
  if (settings.side == Side::both || r.oriented) return;
  if (r.meeting_pairs > 0)
    throw InputError("side in and side out need shells that are apart; those of '" + m.spec.name +
                     "' cut or touch each other at " + std::to_string(r.meeting_pairs) +
                     " pairs of facets: make one shell of them (a boolean union), or use "
                     "side both");
  if (r.closed && r.two_sided_faces > 0)
    throw InputError("side in and side out need facets of one winding; " +
                     std::to_string(r.two_sided_faces) + " of those of '" + m.spec.name +
                     "' are there in both, as in a double-sided export: keep one of each pair "
                     "(lsdcd repair), or use side both");
  throw InputError("side in and side out need a closed, oriented mesh; '" + m.spec.name + "' has " +
                   std::to_string(r.open_edges) + " open, " + std::to_string(r.nonmanifold_edges) +
                   " non-manifold and " + std::to_string(r.misoriented_edges) +
                   " misoriented edges, and " + std::to_string(r.inverted_facets) +
                   " facets of closed shells that are wound against the others: repair the "
                   "mesh (lsdcd repair) or use side both");
}

void check_pressure(const WallSpec &settings, const MeshPart &m)
{
  const MeshReport &r = m.grid.report();
  const bool acts = m.spec.pressure != 0 || m.spec.pressure_input != kNoInput;
  if (!acts || r.misoriented_edges + r.two_sided_faces + r.inverted_facets == 0) return;
  throw InputError(with_mesh_name(
      settings, m.index,
      "a pressure acts along the normals of faces by their winding, and this mesh has " +
          counted(r.misoriented_edges, "misoriented edge") + ", " +
          counted(r.two_sided_faces, "face") + " in both windings and " +
          counted(r.inverted_facets, "facet") +
          " of closed shells wound against the others, so it would push to "
          "both sides: wind all alike with lsdcd repair"));
}

void check_weld(Host &host, const WallSpec &settings, const MeshPart &m)
{
  const std::string doubt = weld_warning(m.grid.report());
  if (!doubt.empty()) host.warn(with_mesh_name(settings, m.index, doubt));
}

void check_plane(Host &host, const WallSpec &settings, const MeshPart &m)
{
  if (host.box().dimension == 3) return;
  m.surface->check_plane();
  m.mover.check_plane();
  const MeshReport &r = m.grid.report();
  if (!(r.lo.z < 0 && r.hi.z > 0))
    throw InputError(with_mesh_name(
        settings, m.index,
        "in two dimensions grains move in the plane z = 0, which the mesh does not "
        "cut: it spans z from " +
            number_text(r.lo.z) + " to " + number_text(r.hi.z) + "; draw the outline out along z" +
            (r.lo.z < r.hi.z ? ", and put its middle at z = 0 (move 0 0 " +
                                   number_text(-(r.lo.z + r.hi.z) / 2) + ")"
                             : "")));
  Real cut[2] = {0, 0};
  if (m.grid.mesh()) {
    const PlaneCut mine = plane_cut(*m.grid.mesh());
    cut[0] = static_cast<Real>(mine.leaning);
    cut[1] = mine.lean;
  }
  host.max(cut, 2);
  if (cut[0] > 0)
    host.warn(with_mesh_name(settings, m.index,
                             number_text(cut[0]) +
                                 " faces lean where the mesh cuts the plane z = 0, by up to " +
                                 number_text(cut[1]) + " degrees: " + host.names().stay_in_plane +
                                 "; draw the outline out along z"));
}

void check_stays_closed(Host &host, const WallSpec &settings, const MeshPart &m)
{
  const WeldedMesh *mesh = m.mesh();
  if (!m.surface->changes() || !mesh) return;
  const auto named = [&](const std::string &text) {
    return with_mesh_name(settings, m.index,
                          text + ": make the triangles on both sides share their edges, for "
                                 "example by lsdcd repair");
  };
  const std::vector<std::array<int, 3>> lines = facets_without_area(*mesh);
  if (m.nodes() && !lines.empty()) {
    const auto [a, b, c] = lines.front();
    const std::vector<Vec3> &x = mesh->vertices;
    throw InputError(named("the facet with the corners " + vector_text(x[a]) + ", " +
                           vector_text(x[b]) + " and " + vector_text(x[c]) + " of '" + m.spec.name +
                           "' has no area, so the wall has no triangle there, and a hole "
                           "would open where its nodes move apart"));
  }
  if (!host.is_first()) return;
  if (!lines.empty())
    host.warn(named("wear does not move the corners of " + counted(lines.size(), "facet") +
                    " of '" + m.spec.name + "' without area, because a hole would open there"));
  if (mesh->report.open_edges == 0) return;
  CutBefore none;
  const std::size_t junctions = split_faces(*mesh, mesh->report.weld_tolerance, none).junctions,
                    open = junctions - std::min(junctions, lines.size());
  if (open > 0)
    host.warn(named(counted(open, "vertex", "vertices") + " of '" + m.spec.name + "' " +
                    (open == 1 ? "lies" : "lie") +
                    " on open edges of other triangles, between the ends of these: where they "
                    "move apart, a gap opens there"));
}

Real largest_within(const HostSpheres &spheres)
{
  Real most = 0;
  for (int i = 0; i < spheres.n; i++) {
    if (!spheres.may_be_in_group(i)) continue;
    const GrainShape &shape = spheres.shapes[i];
    most = std::max(most, shape.is_sphere() ? spheres.radius[i]
                                            : std::min({shape.half.x, shape.half.y, shape.half.z}));
  }
  return most;
}

void check_way(Host &host, const WallSpec &settings, MeshPart &m, const Step &step, Real radius,
               const SpheresOnCpu &spheres)
{
  const Pose &from = m.mover.pose_before(), &to = m.pose();
  const Real way = farthest_between(from, to, m.bounds(0));
  const bool passes = way > 2 * radius;
  const bool stops = passes && !m.mover.may_jump();
  if (way <= radius || (m.way_warned && !stops)) return;
  const Box swept = swept_bounds(from, to, m.bounds(radius));
  const HostSpheres s = spheres.all();
  Real meets = 0;
  for (int i = 0; i < s.n && meets == 0; i++) {
    const Vec3 x = s.x[i];
    meets = s.may_be_in_group(i) && overlap(swept, {x, x});
  }
  host.max(&meets, 1);
  if (meets == 0) return;
  const std::string most = passes ? "diameter " + number_text(2 * radius)
                                  : "radius " + number_text(radius),
                    text = with_mesh_name(settings, m.index,
                                          passed_text("the mesh", way, step, most) +
                                              (m.body ? "" : ", or a motion without jumps"));
  if (stops) throw InputError(text);
  m.way_warned = true;
  host.warn(text + ". Shown once");
}

void check_surface_motion(Host &host, const WallSpec &settings, const MeshPart &m)
{
  if (!host.is_first()) return;    // the first process has the mesh
  const PushReport push = faces_pushed(*m.grid.mesh(), m.spec.surface);
  if (push.area < kSlivers) return;
  host.warn(with_mesh_name(
      settings, m.index,
      "surface_vel and surface_angvel push " + std::to_string(push.faces) + " of " +
          std::to_string(m.grid.report().facets) + " faces, " + number_text(100 * push.area) +
          " % of the area, along their normals, by up to " + number_text(push.component) + " (" +
          number_text(100 * push.share) +
          " % of the speed there). That part is left out: the mesh itself stays where it "
          "is, and lifters, blades and screws convey nothing. To move the mesh itself, "
          "use the keyword motion"));
}

}    // namespace lsdcd
