// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix wall/lsdcd: a wall of triangle meshes in LAMMPS's schedule. It translates; lsdcd::Wall does the work.
#ifndef LMP_FIX_WALL_LSDCD_H
#define LMP_FIX_WALL_LSDCD_H

#include "fix.h"

#include "lammps/lammps_host.h"
#include "lammps/node_atoms.h"
#include "lammps/output_variables.h"
#include "lammps/own_messages.h"
#include "lammps/rerun_watch.h"
#include "lammps/run_speed.h"
#include "lammps/shape_atoms.h"
#include "lammps/wall_picture.h"
#include "wall/spec/run_files.h"
#include "wall/wall.h"

#include <deque>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixWallLsdcd : public Fix, protected OwnMessages {
 public:
  FixWallLsdcd(class LAMMPS *, int, char **, const lsdcd::WallBackend & = lsdcd::WallBackend());
  ~FixWallLsdcd() override;

  // schedule
  int setmask() override;
  void init() override;
  void setup(int) override;
  void min_setup(int) override;
  void setup_pre_exchange() override { pre_exchange(); }
  void setup_pre_force_respa(int, int) override;
  void pre_exchange() override;
  void pre_force(int) override;
  void post_force(int) override;
  void post_force_respa(int, int, int) override;
  void end_of_step() override;
  void post_run() override;

  // history of contacts and rows of the contacts array: between processes, when atoms are sorted, and in
  // restart files
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  // state of the wall in restart files
  void write_restart(FILE *) override;
  void restart(char *) override;

  // outputs
  double compute_scalar() override;
  double compute_vector(int) override;
  double compute_array(int, int) override;
  double memory_usage() override;
  int image(int *&, double **&) override;

  int modify_param(int, char **) override;

  const lsdcd::WallSpec &spec() const { return wall->spec(); }
  const std::deque<lsdcd::MeshPart> &meshes() const { return wall->meshes(); }
  // Returns what the wall's contacts have done with energy, over all meshes. Collective.
  lsdcd::BookedEnergy booked() { return wall->energy().of_all(); }
  std::vector<lsdcd::RunFile> files() const;    // that it reads and writes; of the first process

  // Notes that another fix has deleted n atoms of all processes, so that the change of their number does not count as new atoms.
  void note_deleted(bigint n) { counted_atoms -= n; }

  // The following functions are for fixes that come before the wall in a step. Collective.
  void prepare_meshes();                                 // as the wall will before it moves them
  std::vector<lsdcd::Vec3> places_of_nodes(int mesh);    // where the atoms are that are its nodes

 protected:
  friend class LammpsHost;
  LammpsHost host{*this};
  std::unique_ptr<ShapeAtoms> shape_atoms;    // null: all atoms are spheres
  std::unique_ptr<lsdcd::Wall> wall;
  OutputVariables variables;
  void name_outputs(const std::vector<std::string> &words, int mesh);
  std::vector<std::string> material_files;    // that the first process has read

  lsdcd::RunSpeed speed{lmp};
  RerunWatch watch;
  bool rerun = false;           // this is a snapshot of one
  bigint set_up_at = -1;        // the step in which a run was set up
  int nlevels_respa = 0;        // 0 under verlet
  bigint counted_atoms = -1;    // how many there were when the wall was told of new spheres
  bool adapts = false;          // some fix changes radii
  bool looks_anew = false;      // there may be new spheres, or others than before, in this step
  std::vector<int> changing;    // see steps_between_changes()
  bool rigid = false;           // some rigid fix holds atoms: damping_mass replaces rmass
  std::vector<double> damping_mass;
  std::deque<NodeAtoms> node_atoms;    // of each mesh that has nodes
  const double *gravity = nullptr;     // of the script's fix gravity, where there are bodies
  bool callbacks = false;              // registered with Atom
  int room = 0;                        // this wall's part of maxexchange
  bool wall_in_minimize_warned = false, doubled_warned = false, pairs_warned = false;
  WallPicture picture;
  std::vector<double> contact_rows;    // of the local array, size_local_cols numbers each
  std::vector<double *> contact_row_at;

  // wall/lsdcd/kk has its own forms of the following functions.
  virtual void begin_step(lsdcd::StepInput &);
  virtual void finish_step();
  virtual lsdcd::HostSpheres spheres();
  virtual void fill_masses();
  virtual void need_on_cpu() {}       // before atom data are read outside of a step
  virtual void need_masses() {}       // before fill_masses() reads them
  virtual void need_positions() {}    // before check_wrapping()
  virtual void need_nodes() {}        // before atoms that are nodes are read
  virtual void need_ids() {}          // before atom IDs are read
  virtual void need_inputs() {}       // before variables are evaluated in a step
  virtual void add_node_forces();
  virtual void make_exchange_room();

  lsdcd::HostSpheres spheres_in_atom();
  lsdcd::Step step_now() const;
  lsdcd::StepInput step_input(bool look);
  lsdcd::SphereDrift sphere_drift() const;
  bool begins_late() const;    // does a step begin in post_force?
  bool lammps_looks_at_spheres() const;
  bool spheres_go_far() const;
  void begin(bool look);
  int find_variable(const std::string &) const;
  std::vector<double> read_inputs();
  void fill_contacts();
  void fill_each_contact();

  bool has_history() { return has_springs(); }
  bool has_springs() const { return spec().law().has_history(); }
  lsdcd::ContactHistory &history_on_cpu() { return wall->history().on_cpu(); }
  int row_size() const { return spec().contacts ? size_peratom_cols : 0; }
  void ask_for_room(int);
  void ask_for_most_room();

  void check_atoms() const;
  void check_suffix() const;
  void check_heat() const;
  void init_bodies();
  void init_nodes();
  void check_node_tags();
  void note(const std::string &);
  void warn_of_pairs();
  void check_types(const lsdcd::WallSpec &) const;
};

}    // namespace LAMMPS_NS

#endif
