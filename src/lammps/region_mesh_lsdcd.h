// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// region mesh/lsdcd: the inside of a closed mesh as a region of LAMMPS.
#ifndef LMP_REGION_MESH_LSDCD_H
#define LMP_REGION_MESH_LSDCD_H

#include "region.h"

#include "input/region_settings.h"
#include "lammps/own_messages.h"
#include "mesh/winding_number.h"
#include "tree/triangle_tree.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

// Every process has the whole mesh.
class RegionMeshLsdcd : public Region, protected OwnMessages {
 public:
  RegionMeshLsdcd(class LAMMPS *, int, char **);

  void init() override;
  int inside(double, double, double) override;
  int surface_interior(double *, double) override;
  int surface_exterior(double *, double) override;

  const std::string &mesh_file() const { return settings.mesh.file; }

 private:
  void read_host_words();
  void refuse_rotating_whole() const;
  void set_bounds(const lsdcd::MeshReport &);
  void log_mesh(const lsdcd::WeldedMesh &) const;
  [[noreturn]] void refuse_surface() const;

  // The mesh, with what distances from its surface need.
  struct Distances {
    lsdcd::WeldedMesh mesh;
    lsdcd::TriangleTable names;
    lsdcd::TriangleTree tree;

    explicit Distances(const lsdcd::WeldedMesh &from) : mesh(from), names(mesh), tree(mesh, names)
    {
    }
  };

  lsdcd::RegionSettings settings;
  lsdcd::Box mesh_bounds;    // as placed, before the region moves
  bool scale_warned = false;
  std::unique_ptr<lsdcd::WindingNumber> winding;
  std::unique_ptr<Distances> distances;    // where there is a gap
};

}    // namespace LAMMPS_NS

#endif
