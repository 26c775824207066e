// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/grid_manager.h"

#include "base/input_error.h"
#include "base/input_words.h"
#include "wall/spec/mesh_name.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace lsdcd {

PeriodicBox GridManager::box() const
{
  PeriodicBox box = host_.box();
  box.margin = std::max(box.margin, farthest_out_);
  return box;
}

FeatureCode GridManager::without_image(int mesh, FeatureCode feature) const
{
  const MeshGrid &grid = meshes_[mesh].grid;
  return cutoff() > 0 && grid.has_images() ? own_feature(grid.view().wall, feature) : feature;
}

void GridManager::set_engine(WallEngine &engine)
{
  engine_ = &engine;
  for (const MeshPart &m : meshes_) {
    if (cutoff() == 0 || m.nodes()) continue;    // the next step builds those of nodes
    run_collectively(host_, true, [&] { put_grid(m); });
  }
}

void GridManager::put_grid(const MeshPart &m)
{
  engine_->set_grid(m.view(), m.index);
  if (m.grid.tree()) engine_->set_tree(*m.grid.tree(), m.index);
}

namespace {

// Engines have lengths over the radius as floats: those of a mesh of size 1 vanish at 1.4e45, and lose digits from 1e38 on.
constexpr Real kLongestReach = 1e36;

void check_reach(Real reach)
{
  if (!(reach <= kLongestReach))
    throw InputError("the largest radius, of a sphere, rmax or a coat, is " + number_text(reach) +
                     ", beyond " + number_text(kLongestReach) +
                     ", up to which the wall finds contacts: correct it, or take a larger unit of "
                     "length");
}

}    // namespace

bool GridManager::fit_spheres(Real radius, const SpheresOnCpu &spheres, std::int64_t step)
{
  constexpr Real kHeadroom = 1.1;    // once radii are known to grow
  const Real old = cutoff(), of_coats = cutoff_of_coats();
  if (std::max(cutoff_of(radius, reach_), of_coats) <= old) return fit_box(step);
  check_rmax(radius, spheres);
  const Real largest =
      settings_.rmax > 0 ? settings_.rmax : (old > 0 ? kHeadroom * radius : radius);
  const Real reach = std::max(cutoff_of(largest, reach_), of_coats);
  check_reach(reach);
  if (old == 0 && radius > 0) checks_.check_radius(box(), radius);
  rebuild(reach, step);
  return true;
}

Real GridManager::cutoff_of_coats() const
{
  return coats_.any() ? cutoff_of(coats_.largest_radius(), reach_) : 0;
}

void GridManager::check_rmax(Real radius, const SpheresOnCpu &spheres) const
{
  if (settings_.rmax == 0 || radius <= settings_.rmax) return;
  const HostSpheres s = spheres.all();
  Real first = -INFINITY;    // the negative of a tag: the lowest of all processes is named
  for (int i = 0; i < s.n; i++)
    if (s.radius[i] == radius && s.may_be_in_group(i))
      first = std::max(first, -static_cast<Real>(s.tag[i]));
  host_.max(&first, 1);
  throw InputError(host_.sphere_text(static_cast<std::int64_t>(-first)) + " has radius " +
                   number_text(radius) + ", more than rmax " + number_text(settings_.rmax) +
                   ": raise rmax or use rmax auto");
}

// A wall acts through periodic faces by images of its triangles, and its grid is there where
// spheres can be: both are those of a box.
bool GridManager::fit_box(std::int64_t step)
{
  if (cutoff() == 0) return false;
  if (std::all_of(meshes_.begin(), meshes_.end(), [this](const MeshPart &m) { return fits(m); }))
    return false;
  rebuild(cutoff(), step);
  return true;
}

// The grids that are too small, or for another box.
void GridManager::rebuild(Real wanted, std::int64_t step)
{
  times_.begin();
  const Real old = cutoff();
  std::vector<MeshPart *> anew;
  for (MeshPart &m : meshes_)
    if (wanted != old || !fits(m)) anew.push_back(&m);
  if (old > 0) {
    history_.on_cpu();
    // Images get other numbers: a spring on one goes to what that is an image of.
    for (const MeshPart *m : anew) {
      const auto name = [&](int mesh, FeatureCode f) {
        return mesh == m->index ? without_image(mesh, f) : f;
      };
      history_.rename_features(name);
      if (m->grid.has_images()) coats_.rename_features(name);
    }
  }
  for (const MeshPart *m : anew) checks_.check_outside(*m, box(), wanted);
  for (MeshPart *m : anew) {
    m->grid.progress = progress(*m);
    m->grid.build(wanted, m->effective_box(box()));
    m->surface->check_grid();
    if (!m->nodes()) run_collectively(host_, true, [&] { put_grid(*m); });
    coats_.set_grid(*m);
  }
  times_.end(TimeReport::grids);
  if (wanted == old) box_rebuilds_++;
  for (const MeshPart *m : anew) {
    checks_.check_within_cutoff(*m, box());
    log_build(*m, old, step);
    checks_.check_ends(*m, wanted == old);
  }
}

// Features keep their names, and springs theirs: a contact sees another place of the surface, as one does whose sphere
// has moved.
void GridManager::follow_surface(MeshPart &m)
{
  if (cutoff() == 0) return;
  times_.begin();
  m.grid.progress = progress(m);
  m.grid.build(cutoff(), m.effective_box(box()));
  m.surface->check_grid();
  run_collectively(host_, true, [&] { put_grid(m); });
  coats_.set_grid(m);
  times_.end(TimeReport::grids);
}

// A line where a grid takes long, each ten seconds; the host shows those of the first process.
ProgressListener GridManager::progress(const MeshPart &m) const
{
  constexpr Real kSeconds = 10;
  return [this, name = with_mesh_name(settings_, m.index, ""),
          last = TimeReport::steady_clock()](const std::string &what, double share) mutable {
    if (TimeReport::steady_clock() - last < kSeconds) return;
    last = TimeReport::steady_clock();
    host_.log(name + progress_text(what, share));
  };
}

void GridManager::log_build(const MeshPart &m, Real old_cutoff, std::int64_t step) const
{
  const MeshGrid &grid = m.grid;
  if (!grid.cache_warning().empty())
    host_.warn(with_mesh_name(settings_, m.index, grid.cache_warning()));
  if (settings_.brief) return;
  const bool again = old_cutoff > 0;
  std::string t = with_mesh_name(settings_, m.index, "");
  if (!again)
    t += "grid for radius " + number_text(grid.cutoff()) +
         (m.nodes() ? ", made again as nodes move" : "\n" + grid.grid_text());
  else if (grid.cutoff() > old_cutoff)
    t += "larger grains, grid rebuilt for radius " + number_text(grid.cutoff());
  else
    t += "the box has changed, grid rebuilt at step " + std::to_string(step) +
         " (more of these in this run are counted at its end)";
  if (!again && host_.ranks().node_size > 1 && !m.nodes())
    t += grid.is_shared() ? "\n  one copy per node" : "\n  one copy per process";
  if (!grid.cache_text().empty()) t += "\n  " + grid.cache_text();
  const bool one_of_many = again && grid.cutoff() == old_cutoff && box_rebuilds_ > 1;
  if (!one_of_many) host_.log(t);
}

void GridManager::check_wrapping(const Spheres &spheres)
{
  const PeriodicBox now = box();
  if (cutoff() == 0 || !now.any_periodic()) return;
  Real out = engine_->farthest_past(spheres, periodic_faces(now));
  host_.max(&out, 1);
  if (out <= now.margin) return;
  farthest_out_ = std::min({1.5 * out, now.width(0), now.width(1), now.width(2)});
  const bool all_fit =
      std::all_of(meshes_.begin(), meshes_.end(), [this](const MeshPart &m) { return fits(m); });
  if (out_warned_ || all_fit) return;    // nothing of the wall is there
  out_warned_ = true;
  host_.warn("a grain was " + number_text(out) +
             " past a periodic face before it was wrapped, more than the " + host_.names().margin +
             " " + number_text(now.margin) + ": contacts there may have been missed; " +
             host_.names().wrap_sooner +
             ". The grid now reaches further; this warning is shown once");
}

void GridManager::end_run()
{
  if (box_rebuilds_ > 1 && !settings_.brief)
    host_.log("the grid was rebuilt " + std::to_string(box_rebuilds_) +
              " times in this run, because the box changed");
  box_rebuilds_ = 0;
}

}    // namespace lsdcd
