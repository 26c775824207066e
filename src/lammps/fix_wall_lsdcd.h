// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix wall/lsdcd: forces of triangle meshes on spheres, in LAMMPS's schedule.
#ifndef LMP_FIX_WALL_LSDCD_H
#define LMP_FIX_WALL_LSDCD_H

#include "fix.h"

#include "input/deck_files.h"
#include "lammps/lammps_host.h"
#include "lammps/mesh_part.h"
#include "lammps/rerun_watch.h"
#include "wall/choice_schedule.h"
#include "wall/history_exchange.h"
#include "wall/overlap_monitor.h"
#include "wall/search_report.h"
#include "wall/step_totals.h"
#include "wall/time_report.h"
#include "wall/wall_files.h"

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixWallLsdcd : public Fix {
 public:
  using EngineMaker = std::unique_ptr<lsdcd::WallEngine>(const lsdcd::EngineSettings &);

  FixWallLsdcd(class LAMMPS *, int, char **, EngineMaker * = lsdcd::make_engine);
  ~FixWallLsdcd() override;

  // schedule: fix_wall_lsdcd.cpp
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

  // springs on the move and in restart files: fix_wall_lsdcd_exchange.cpp
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;

  // loads and wear: fix_wall_lsdcd_loads.cpp
  void write_restart(FILE *) override;
  void restart(char *) override;

  // outputs: fix_wall_lsdcd_output.cpp
  double compute_scalar() override;
  double compute_vector(int) override;
  double compute_array(int, int) override;
  double memory_usage() override;
  int image(int *&, double **&) override;

  int modify_param(int, char **) override;    // fix_wall_lsdcd_modify.cpp

  // For compute lsdcd/collide: what there is of each mesh, and where it is in this step.
  const std::deque<MeshPart> &meshes() const { return parts; }
  std::vector<lsdcd::DeckFile> files() const;    // that it reads and writes

 protected:
  friend class LammpsHost;
  LammpsHost host = LammpsHost(*this);
  lsdcd::WallSettings settings;    // of the deck, and motions given later
  std::string material;            // what a material file filled in, for the log; else empty
  std::string material_file;       // as the deck names it
  std::deque<MeshPart> parts;      // where each stays; there is one at least
  EngineMaker *const new_engine;
  std::unique_ptr<lsdcd::WallEngine> engine;
  std::unique_ptr<lsdcd::HistoryExchange> history;
  bool records = false;
  std::unique_ptr<lsdcd::LoadRecorder> loads;
  std::unique_ptr<lsdcd::WallFiles> wall_files;
  bool continued = false;    // from a restart file
  lsdcd::ChoiceSchedule schedule;
  RerunWatch watch;
  bool rerun = false;         // this is a snapshot of one
  bool rerun_told = false;    // what is not known there
  bigint set_up_at = -1;      // the step in which a run was set up
  bool callbacks = false;     // registered with Atom
  int room = 0;               // this wall's part of maxexchange
  bool running = false;       // between start and collect
  int nlevels_respa = 0;      // 0 under verlet

  bool adapts = false;    // some fix changes radii: a step begins in post_force
  bool rigid = false;     // some rigid fix holds atoms: mass_seen replaces rmass
  std::vector<double> mass_seen;

  lsdcd::OverlapMonitor overlaps = lsdcd::OverlapMonitor(host);
  lsdcd::SearchReport search = lsdcd::SearchReport(host);
  lsdcd::TimeReport times = lsdcd::TimeReport(host);
  bool wall_in_minimize_warned = false, points_warned = false;
  bool doubled_warned = false;
  bigint checked_atoms = -1;    // how many there were when the timestep was checked
  bool may_be_new = false;      // spheres, since then
  double worst_dt = 1;          // the largest warned of, over what there should be

  double farthest_out = 0;    // past a face of the box that spheres were seen to go, and more
  bool out_warned = false;
  bigint box_rebuilds = 0;    // in this run, of grids for another box

  // Of the spheres; LAMMPS's own begins anew in some runs from a restart file.
  lsdcd::StepClock run_clock;
  bool engine_moves = false;      // it has laws for a wall that moves
  bool engine_records = false;    // it keeps records of contacts
  // Of each mesh, for the engine.
  std::vector<lsdcd::SurfaceMotion> surfaces;
  std::vector<double> temperatures;

  double servo_radius = 0, servo_mass = 0;    // the largest, for gains of servos

  // Of the vector: force, torque, contacts, largest overlap, uncertified; volume worn off, power; and
  // with a servo three more.
  static constexpr int kTotals = 9, kWorn = kTotals, kPower = kTotals + 1, kVector = kTotals + 2,
                       kServo = 3;
  std::unique_ptr<lsdcd::StepTotals> totals;

  bool drawn = false;    // strokes are there
  std::vector<int> image_kind;
  std::vector<double> image_data;
  std::vector<double *> image_rows;

  // What wall/lsdcd/kk does in its own way.
  virtual void start();
  virtual void collect();
  virtual lsdcd::Spheres spheres();
  virtual void fill_masses();
  virtual double largest_radius();    // of the group, on this process
  virtual void need_on_host() {}      // before atom data are read outside of a step
  tagint tag_on_host(int) const;      // after need_on_host(); 0 where atoms have none
  virtual tagint tag_of(int);         // the same at any time, of few: each is a copy from a GPU
  virtual void make_exchange_room();
  tagint tag_of_radius(double);    // the first of the group that has it

  lsdcd::StepSettings step_settings(lsdcd::Spheres &);    // gives the spheres their heat, too
  void keep_outputs();
  void begin_step(bool);
  void give_step();
  void choose_if_due(const lsdcd::Spheres &);
  lsdcd::SphereDrift sphere_drift() const;
  lsdcd::StepDiagnostics read_notes();
  void poll_diagnostics();
  void check_new_spheres();
  lsdcd::ContactHistory &springs_on_host();
  lsdcd::FeatureCode without_image(int, lsdcd::FeatureCode) const;    // of a mesh
  void prepare_springs();
  void fill_contacts();
  void reduce_totals();
  void clear_outputs();
  double output_of(MeshPart &, int);
  MeshPart *only_servo();

  bool several() const { return parts.size() > 1; }
  double cutoff() const { return parts.front().wall.cutoff(); }    // 0 before there are spheres
  bool any_moves() const;                                          // or was moved
  int row_size() const { return settings.contacts ? size_peratom_cols : 0; }
  void ask_for_room(int);
  void ask_for_most_room();

  // fix_wall_lsdcd_build.cpp
  lsdcd::EngineSettings engine_settings() const;
  void make_engine();
  void make_engine_anew();
  void give_grid(const MeshPart &);
  void update_cutoff();
  void follow_box();
  void rebuild(double);

  // fix_wall_lsdcd_motion.cpp
  lsdcd::Step step_now() const;
  void move_wall();
  void check_variables() const;
  void check_moving_box(MeshPart &, const lsdcd::WallPose &, bool) const;
  void check_moving_box();
  void check_motion(const MeshPart &) const;

  // fix_wall_lsdcd_modify.cpp
  int modify_motion(MeshPart &, const std::vector<std::string> &);
  int modify_servo(MeshPart &, const std::vector<std::string> &);
  void motion_has_changed(const MeshPart &);

  // fix_wall_lsdcd_servo.cpp
  lsdcd::ServoLoad servo_load(const MeshPart &);
  void look_at_servo_spheres();
  void advance_servo(MeshPart &, double);
  double servo_output(const MeshPart &, int);
  void show_servo();

  // fix_wall_lsdcd_rerun.cpp
  void begin_snapshot();

  // fix_wall_lsdcd_virial.cpp
  void make_engine_with_virial();
  void add_virial();

  // fix_wall_lsdcd_loads.cpp
  void add_loads();
  void add_restart_data(const MeshPart &, std::vector<double> &) const;
  void restart_part(MeshPart &, const std::vector<double> &, const std::vector<double> &,
                    const std::vector<double> &, bool);

  // fix_wall_lsdcd_others.cpp
  void check_files_apart() const;
  bool shares_atoms_with(const Fix &);
  void check_doubled();

  // fix_wall_lsdcd_heat.cpp
  void check_heat();
  void give_heat(lsdcd::Spheres &, lsdcd::StepSettings &);

  // the box, its images and its changes: fix_wall_lsdcd_box.cpp
  lsdcd::PeriodicBox simulation_box() const;
  bool spheres_stay_close() const;
  void check_box(const MeshPart &, double) const;
  void check_gone();
  void check_scale(const MeshPart &) const;
  void check_small(const MeshPart &, double) const;
  void check_periodic(const MeshPart &) const;
  void check_within_cutoff(MeshPart &);
  void check_ends(MeshPart &, bool);
  std::string likely_scale_text(const MeshPart &) const;
  void check_wrapping();
  void log_rebuilds();

  // fix_wall_lsdcd_checks.cpp
  void check_points();
  void check_side(const MeshPart &) const;
  void check_plane(const MeshPart &);
  void check_surface(const MeshPart &) const;
  void check_timestep();
  void check_springs();
  void log_creation() const;
  std::function<void(const std::string &)> build_progress(const MeshPart &) const;
  void log_build(const MeshPart &, double) const;
  void log(const std::string &) const;
  void warn(const std::string &) const;    // by the first process
  [[noreturn]] void fatal(const std::string &) const;
  [[noreturn]] void stop(const std::exception &);    // on this process alone
  std::string with_fix_id(const std::string &) const;
  // What is said of one of several meshes, with its name; of the only one as it is.
  std::string of(const MeshPart &, const std::string &) const;
};

}    // namespace LAMMPS_NS

#endif
