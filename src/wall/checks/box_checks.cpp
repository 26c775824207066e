// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/checks/box_checks.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "box/likely_scale.h"
#include "box/outside_box.h"
#include "wall/spec/mesh_name.h"
#include "wall/spec/spec_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>

namespace lsdcd {

namespace {

Vec3 extents(const MeshPart &m)
{
  const Box bounds = m.bounds(0);
  return bounds.hi - bounds.lo;
}

// In parts of the box.
Real extent_along(const MeshPart &m, const PeriodicBox &box, int k)
{
  Real lo = HUGE_VAL, hi = -HUGE_VAL;
  for_corners(m.bounds(0), [&](const Vec3 &corner) {
    lo = std::min(lo, box.fraction(corner)[k]);
    hi = std::max(hi, box.fraction(corner)[k]);
  });
  return hi - lo;
}

std::string capital(std::string text)
{
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

// In place of a radius that does not fit the box or a mesh.
std::string radius_remedy(const Host &host, Real radius)
{
  return radius == host.names().unset_radius ? host.names().set_radii
                                             : host.names().give_other_radii;
}

}    // namespace

std::string BoxChecks::named(const MeshPart &m, const std::string &text) const
{
  return with_mesh_name(settings_, m.index, text);
}

void BoxChecks::check_scale(const MeshPart &m, const PeriodicBox &box) const
{
  const std::string wrong = too_large_text(extents(m), m.bounds(0), box);
  if (wrong.empty()) return;
  constexpr Real kFlat = 1e-6;    // images of what is flat are one plane
  const Vec3 size = extents(m);
  if (std::min({size.x, size.y, size.z}) <= kFlat * norm(size)) return host_.warn(named(m, wrong));
  const PeriodicBox of_images = m.effective_box(box);
  for (int k = 0; k < 3; k++)
    if (of_images.periodic[k] && extent_along(m, box, k) > 1)
      throw InputError(named(m, wrong + ". Its periodic images would lie over one another in " +
                                    std::string(1, "xyz"[k])));
  host_.warn(named(m, wrong));
}

// Where its motion allows no images check_moving() refuses it.
void BoxChecks::check_periodic(const MeshPart &m, const PeriodicBox &box) const
{
  if (settings_.periodic || !host_.is_first()) return;    // the first process has the mesh
  const Real tolerance = m.grid.report().weld_tolerance;
  std::string axes;
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k] || (m.moves() && !m.keeps_edge(box, k))) continue;
    Real past = 0;
    for (const Vec3 &x : m.grid.mesh()->vertices) {
      const Real at = box.fraction(x)[k];
      past = std::max({past, -at * box.width(k), (at - 1) * box.width(k)});
    }
    if (past > tolerance)
      axes += (axes.empty() ? "" : ", ") + std::string(1, "xyz"[k]) + " by " + number_text(past);
  }
  if (axes.empty()) return;
  host_.warn(named(m, "the mesh reaches past the periodic face in " + axes +
                          ": what lies there acts inside the box as well, by its periodic images. "
                          "Add the keyword periodic if you want that, or make the boundary fixed"));
}

void BoxChecks::check_radius(const PeriodicBox &box, Real radius) const
{
  const Box bounds = box.bounds({0, 0, 0});
  Real widest = 0;
  for (int k = 0; k < box.dimension; k++)
    widest = std::max(widest, box.follows(k) ? INFINITY : bounds.hi[k] - bounds.lo[k]);
  if (2 * radius > widest)
    host_.warn("spheres have radius " + number_text(radius) + ", and the box spans " +
               extents_text(bounds) + ": no such sphere fits in it; " +
               radius_remedy(host_, radius));
  else
    for (const MeshPart &m : meshes_) check_small(m, box, radius);
}

void BoxChecks::check_small(const MeshPart &m, const PeriodicBox &box, Real radius) const
{
  Vec3 size = extents(m);
  if (box.dimension == 2) size.z = 0;    // an outline may be of any thickness
  if (norm(size) >= radius) return;
  const std::string units = !m.spec.placement.stretches()
                                ? "the file is probably in different units: add a scale"
                                : std::string("the file is probably in ") + host_.names().units +
                                      ", and the scale in '" + placement_text(m.spec.placement) +
                                      "' is not needed";
  host_.warn(named(
      m, "the mesh is " + number_text(norm(size)) + " across, and spheres have radius " +
             number_text(radius) + ": " + units +
             (radius == host_.names().unset_radius ? "; or " + radius_remedy(host_, radius) : "")));
}

void BoxChecks::check_outside(const MeshPart &m, const PeriodicBox &box, Real cutoff) const
{
  if (m.moves()) return;    // it may come in later
  const std::string wrong = outside_box(m.bounds(0), box, cutoff + box.margin);
  if (!wrong.empty()) throw InputError(named(m, wrong));
}

void BoxChecks::check_within_cutoff(const MeshPart &m, const PeriodicBox &box)
{
  if (!m.grid.out_of_reach()) return;
  const std::string what =
      named(m, "no grain in the box can touch the mesh: it spans " + extents_text(m.bounds(0)) +
                   ", the box " + extents_text(box.bounds({0, 0, 0})) +
                   likely_scale_text(extents(m), box));
  if (!box.any_follows()) throw InputError(what + "; check scale and move");
  bool &warned = warned_[m.index].out_of_reach_warned;
  if (!warned) host_.warn(what);
  warned = true;
}

void BoxChecks::check_ends(const MeshPart &m, bool box_changed)
{
  const std::string &wrong = m.grid.ends_warning();
  bool &warned = warned_[m.index].ends_warned;
  if (wrong.empty()) return;
  if (settings_.periodic && (m.grid.has_parted() || (box_changed && !warned)))
    throw InputError(named(m, "the box has changed, and " + wrong));
  if (warned) return;
  warned = true;
  host_.warn(named(m, wrong));
}

// A mesh may begin outside of the box and come in. One that was in it and has left acts on nothing.
void BoxChecks::check_gone(const std::vector<MeshPart *> &placed, const PeriodicBox &box,
                           Real cutoff, std::int64_t step)
{
  for (const MeshPart *mesh : placed) {
    const MeshPart &m = *mesh;
    Warned &warned_of_mesh = warned_[m.index];
    if (warned_of_mesh.gone_warned) continue;
    const Box now = placed_bounds(m.pose(), m.bounds(0));
    const bool in_box = outside_box(now, box, cutoff).empty();
    warned_of_mesh.was_in_box |= in_box;
    if (in_box || !warned_of_mesh.was_in_box) continue;
    warned_of_mesh.gone_warned = true;
    host_.warn(named(m, std::string("the mesh has moved out of the box, where it acts on no ") +
                            host_.names().sphere + ": in step " + std::to_string(step) +
                            " it spans " + extents_text(now) + ", the box " +
                            extents_text(box.bounds({0, 0, 0})) +
                            "; check the motion and its units. This warning is shown once"));
  }
}

// Returns whether the mesh cannot have come to the faces since all its vertices were looked at, which takes 0.9 ms for 1e6.
// No point of a mesh goes farther between two poses than the corner of the box around it that goes farthest.
bool BoxChecks::is_still_clear(const MeshPart &m, const Pose &at, const PeriodicBox &box, int k,
                               Real depth) const
{
  const Clear &last = warned_[m.index].clear[k];
  if (m.surface->changes() || last.clear <= 0 || depth > last.depth) return false;
  bool same = norm_sq(box.corner - last.box.corner) == 0;
  for (int j = 0; j < 3; j++) same &= norm_sq(box.edge[j] - last.box.edge[j]) == 0;
  if (!same) return false;
  Real gone = 0;
  for_corners(m.bounds(0), [&](const Vec3 &corner) {
    gone = std::max(gone, norm(at.to_box(corner) - last.at.to_box(corner)));
  });
  return gone < last.clear;
}

void BoxChecks::check_pose(const MeshPart &m, const Pose &at, const PeriodicBox &box, Real cutoff,
                           const std::string &when)
{
  if (!box.any_periodic()) return;
  for (int k = 0; k < 3; k++) {
    if (!box.periodic[k] || (m.keeps_edge(box, k) && !m.has_coat())) continue;
    const Real depth = (cutoff + box.margin) / box.width(k);
    if (is_still_clear(m, at, box, k, depth)) continue;
    Real lo = 0, hi = 0;
    if (!m.reaches(box, k, depth, at, lo, hi)) {
      const Real spare = std::min(lo, 1 - hi) - depth;
      warned_[m.index].clear[k] = {at, box, depth, spare * box.width(k)};
      continue;
    }
    const std::string axis(1, "xyz"[k]);
    if (m.keeps_edge(box, k))
      throw InputError(named(m, "the coat of the body comes to the periodic face in " + axis +
                                    ", through which coats do not act: leave the coat out, make "
                                    "the boundary fixed, or the box larger"));
    throw InputError(named(
        m, "the moving mesh " + std::string(when.empty() ? "will reach" : "reaches") +
               " the periodic face in " + axis + when + ": it goes from " + number_text(lo) +
               " to " + number_text(hi) + " of the box and must stay " + number_text(depth) +
               " away from 0 and 1. " +
               (m.nodes() ? "A mesh whose nodes move acts through no periodic face"
                          : "A mesh acts through a periodic face only where it moves across " +
                                axis + " and turns about nothing but " + axis) +
               ": make the boundary fixed, or the box larger"));
  }
}

void BoxChecks::look_ahead(const MeshPart &m, const PeriodicBox &box, Real cutoff)
{
  constexpr int kSamples = 64;    // points of a turn are missed by a thousandth of its radius
  constexpr Real kPast = 1e-3;    // of the box: a drum that fits it turns within it
  const Real period = m.mover.known_period();
  if (period <= 0) return;
  const auto pose = [&](int i) { return m.mover.pose_in(period * i / kSamples); };
  for (int i = 1; i < kSamples; i++) check_pose(m, pose(i), box, cutoff, "");

  bool &warned = warned_[m.index].turning_out_warned;
  for (int k = 0; k < 3 && !warned; k++) {
    if (box.periodic[k] || box.follows(k) || (k == 2 && box.dimension == 2)) continue;
    Real lo, hi, least = 0, most = 1;
    // One that begins past a face is meant to be there.
    if (m.reaches(box, k, -kPast, pose(0), lo, hi)) continue;
    for (int i = 1; i < kSamples; i++) {
      if (!m.reaches(box, k, -kPast, pose(i), lo, hi)) continue;
      warned = true;
      least = std::min(least, lo);
      most = std::max(most, hi);
    }
    if (!warned) continue;
    const std::string axis(1, "xyz"[k]);
    host_.warn(named(m, "the mesh will turn out of the box: in " + axis + " it will reach from " +
                            number_text(least) + " to " + number_text(most) + " of the box. " +
                            capital(host_.names().sphere) +
                            "s that it carries out of the box are lost: make the box larger in " +
                            axis + ", or " + host_.names().follow_spheres +
                            ". This warning is shown once"));
  }
}

void BoxChecks::check_moving(const std::vector<MeshPart *> &placed, const PeriodicBox &box,
                             Real cutoff, const Step &now)
{
  for (const MeshPart *m : placed) {
    check_pose(*m, m->pose(), box, cutoff, " at step " + std::to_string(now.number));
    if (now.kind != Step::step) look_ahead(*m, box, cutoff);
  }
}

}    // namespace lsdcd
