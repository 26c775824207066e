// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/region_mesh_lsdcd.h"

#include "base/input_error.h"
#include "base/number_words.h"
#include "box/likely_scale.h"
#include "lammps/host_box.h"
#include "lammps/host_fixes.h"
#include "lammps/mpi_host.h"
#include "lammps/mpi_mesh.h"

#include "comm.h"
#include "domain.h"

#include <cstdio>
#include <string>
#include <vector>

using namespace LAMMPS_NS;
using lsdcd::Vec3;

#if LSDCD_HOST_VERSION < 20260501
namespace {

bool has_part(Domain &domain, const Region &whole, const Region *part)
{
  const std::string style = whole.style;
  if (style != "union" && style != "intersect") return false;
#if LSDCD_HOST_VERSION < 20220601
  for (int k = 0; k < whole.nregion; k++)
    if (domain.regions[whole.list[k]] == part) return true;
#else
  (void) domain;
  for (int k = 0; k < whole.nregion; k++)
    if (whole.reglist[k] == part) return true;
#endif
  return false;
}

}    // namespace
#endif

RegionMeshLsdcd::RegionMeshLsdcd(LAMMPS *lmp, int narg, char **arg) :
    Region(lmp, narg, arg), OwnMessages(lmp, "Region", id, "mesh/lsdcd")
{
  cmax = tmax = 0;
  contact = nullptr;
  run_core([&] {
    settings = lsdcd::parse_region(words_of(arg + 2, arg + narg));
    read_host_words();
    lsdcd::MpiHost mpi(world);
    const lsdcd::WeldedMesh mesh = lsdcd::read_together(mpi, settings.mesh);
    lsdcd::run_collectively(mpi, true, [&] {
      winding = std::make_unique<lsdcd::WindingNumber>(mesh);
      if (settings.gap > 0) distances = std::make_unique<Distances>(mesh);
    });
    mesh_bounds = {mesh.report.lo, mesh.report.hi};
    set_bounds(mesh.report);
    log_mesh(mesh);
  });
}

// The mesh is in lengths of the box, as that of the fix, unless the script says lattice.
void RegionMeshLsdcd::read_host_words()
{
  std::vector<char *> words;
  for (std::string &word : settings.host_words) words.push_back(&word[0]);
  options(static_cast<int>(words.size()), words.data());
  if (!scaleflag) return;
  settings.mesh.placement.scale({xscale, yscale, zscale});
  settings.gap *= xscale;
}

// Where the region moves they are not known before.
void RegionMeshLsdcd::set_bounds(const lsdcd::MeshReport &mesh)
{
  bboxflag = interior && !dynamic;
  extent_xlo = mesh.lo.x;
  extent_ylo = mesh.lo.y;
  extent_zlo = mesh.lo.z;
  extent_xhi = mesh.hi.x;
  extent_yhi = mesh.hi.y;
  extent_zhi = mesh.hi.z;
}

// LAMMPS calls it before each use of the region; by then there is a box.
void RegionMeshLsdcd::init()
{
  Region::init();
  refuse_rotating_whole();
  if (scale_warned || !domain->box_exist) return;
  const std::string wrong =
      lsdcd::too_large_text(mesh_bounds.hi - mesh_bounds.lo, mesh_bounds, lsdcd::host_box(*domain));
  scale_warned = !wrong.empty();
  if (scale_warned) warn(wrong);
}

// LAMMPS before May 2026 also turns the points that it asks a union or an intersection for, where a part rotates, but about
// an axis that it never sets.
void RegionMeshLsdcd::refuse_rotating_whole() const
{
#if LSDCD_HOST_VERSION < 20260501
  for (const Region *const whole : lsdcd::host_regions(*domain))
    if (whole->rotateflag && has_part(*domain, *whole, this))
      fatal("region " + std::string(whole->id) + " of style " + whole->style +
            " has a part that rotates, and this LAMMPS would turn it about an axis that it never "
            "sets: put the meshes into one file, whose shells are a union, or use the regions "
            "one by one");
#endif
}

// As LAMMPS asks it: of the mesh's inside with its surface, for either side. With a gap the points near
// the surface are on neither side.
int RegionMeshLsdcd::inside(double x, double y, double z)
{
  const Vec3 q = {x, y, z};
  const lsdcd::WindingNumber::Answer at = winding->at(q);
  const bool is_in = at.on_surface || at.number != 0;
  if (!distances || is_in != (interior == 1)) return is_in;
  const bool is_near = distances->tree.nearest(q, settings.gap, lsdcd::kNoPrimitive).found();
  return is_near ? !interior : is_in;
}

int RegionMeshLsdcd::surface_interior(double *, double)
{
  refuse_surface();
}

int RegionMeshLsdcd::surface_exterior(double *, double)
{
  refuse_surface();
}

void RegionMeshLsdcd::refuse_surface() const
{
  fatal_here("the region is no wall: use fix wall/lsdcd with its mesh in place of "
             "fix wall/region or fix wall/gran/region");
}

void RegionMeshLsdcd::log_mesh(const lsdcd::WeldedMesh &mesh) const
{
  if (comm->me != 0) return;
  char text[160];
  std::snprintf(
      text, sizeof text, "%s, %.3g MB on each process",
      lsdcd::counted(mesh.faces.size(), "triangle").c_str(),
      1e-6 * static_cast<double>(winding->bytes() + (distances ? distances->tree.bytes() : 0)));
  log(text);
}
