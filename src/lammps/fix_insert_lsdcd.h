// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix insert/lsdcd: grains through a flat mesh or into a region. It translates; lsdcd::Insertion says which
// grains come, and where.
#ifndef LMP_FIX_INSERT_LSDCD_H
#define LMP_FIX_INSERT_LSDCD_H

#include "fix.h"

#include "input/insert_settings.h"
#include "insert/inlet_face.h"
#include "lammps/clump_templates.h"
#include "lammps/output_variables.h"
#include "lammps/own_messages.h"
#include "lammps/shape_atoms.h"
#include "lammps/wall_clearance.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixInsertLsdcd : public Fix, protected OwnMessages {
 public:
  FixInsertLsdcd(class LAMMPS *, int, char **);
  ~FixInsertLsdcd() override;

  void post_constructor() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_pre_force_respa(int, int level) override { n_levels = level + 1; }
  void initial_integrate(int) override;
  void initial_integrate_respa(int, int, int) override;
  void pre_exchange() override;
  void reset_dt() override;
  void post_run() override;

  double compute_vector(int) override;
  int modify_param(int, char **) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

  const std::string &mesh_file() const { return settings.face.file; }    // empty: a region
  double largest_radius(int type) const;    // of grains to come; 0: none of this type

 protected:
  bool is_due() const;    // in this step

 private:
  friend class LammpsSite;

  lsdcd::InsertSettings settings;
  OutputVariables variables;
  std::unique_ptr<lsdcd::InletFace> face;    // without it: a region
  class Region *region = nullptr;
  lsdcd::Vec3 velocity = {0, 0, 0};
  std::unique_ptr<lsdcd::Insertion> insertion;
  std::unique_ptr<lsdcd::WallClearance> walls;
  std::string radii_id;           // of the fix that tells radii to pair styles
  lsdcd::Refused refused_seen;    // before this run
  std::int64_t inserted_before = 0;
  std::unique_ptr<ShapeAtoms> shape_atoms;    // null: grains are spheres or clumps of them
  std::unique_ptr<ClumpTemplates> clumps;     // null: grains are no clumps
  Fix *rigid = nullptr;                       // of clumps
  // Of each kind: the largest radius of grains that have places beside the walls. On the first process.
  std::vector<double> radius_with_room;
  bool told = false;    // in this run, that grains have no place
  bool seed_warned = false;
  double schedule_dt = 0;
  int n_levels = 0;    // of run_style respa; 0 under verlet

  void read_face();
  void find_region();
  lsdcd::Box zone() const;
  void check_atoms() const;
  void check_atoms_of_clumps() const;
  void find_rigid(const std::vector<Fix *> &fixes);
  double touch_radius(const lsdcd::Grain &) const;
  std::vector<double> gather_grains(const lsdcd::Box &) const;
  std::vector<lsdcd::Insertion::Placed> choose(lsdcd::Refused &);
  void create(const std::vector<lsdcd::Insertion::Placed> &);
  int create_grain(const lsdcd::Grain &, const lsdcd::Insertion::Placed &, tagint tag);
  int create_clump(const lsdcd::Grain &, const lsdcd::Insertion::Placed &, tagint before,
                   tagint molecule);
  int new_atom(int type, double *x, imageint image, const lsdcd::Vec3 &v, tagint tag);
  std::size_t n_atoms(const lsdcd::Grain &) const;
  bool owns(double *) const;
  void begin_schedule(bigint step);
  void follow_schedule();
  void begin_report();
  void check_temperature() const;
  void warn_of_seed(const std::vector<Fix *> &fixes);
  tagint last_id(bigint n) const;
  tagint last_molecule(bigint n) const;
  void set_properties(int) const;
  void clear_levels(int n_new) const;
  std::string late_text(const std::string &, const lsdcd::Refused &) const;
  std::string inserted_text() const;
  std::string grain_text(const lsdcd::Grain &) const;
  std::string no_room_text(const lsdcd::Grain &, int tries) const;
  std::string remedy(const lsdcd::Refused &) const;
};

// Pair styles of LAMMPS ask fixes of the style `pour` for the largest radius of a type that will come, and make
// cutoffs of it. This fix answers for all fixes insert/lsdcd.
class FixInsertRadii : public Fix {
 public:
  FixInsertRadii(class LAMMPS *, int, char **);
  int setmask() override { return 0; }
  void *extract(const char *, int &) override;

 private:
  double radius = 0;
};

}    // namespace LAMMPS_NS

#endif
