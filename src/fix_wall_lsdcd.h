// fix wall/lsdcd: forces of a triangle mesh on spheres, in LAMMPS's schedule.
#ifndef LMP_FIX_WALL_LSDCD_H
#define LMP_FIX_WALL_LSDCD_H

#include "fix.h"

#include "node_wall.h"
#include "output/wall_loads.h"

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
  double memory_usage() override;
  int image(int *&, double **&) override;

 protected:
  lsdcd::WallSettings settings;
  std::string material;    // what a material file filled in, for the log; else empty
  std::unique_ptr<lsdcd::NodeWall> wall;
  EngineMaker *const new_engine;
  std::unique_ptr<lsdcd::WallEngine> engine;
  lsdcd::SpringStore springs;
  lsdcd::WallLoads loads;
  bool history, records;
  bool callbacks = false;    // registered with Atom
  bool restarted = false;    // springs came from a restart file and are not checked yet
  int other_law = 0;         // atoms whose springs did not, being those of another law
  bool running = false;      // between start and collect
  int nlevels_respa = 0;     // 0 under verlet

  bool rigid = false;    // some rigid fix holds atoms: mass_seen replaces rmass
  std::vector<double> mass_seen;

  static constexpr double kLargeOverlap = 0.1;    // of a radius; past it there is a warning
  double worst_overlap = 0;    // overlap / radius since the last look, on this process
  tagint worst_tag = 0;
  bigint worst_step = 0;
  bigint uncertified_sum = 0;    // answers not certified since the last look, on this process
  double worst_uncertain = 0;    // overlap / radius that they may have missed
  bool overlap_warned = false, wall_in_minimize_warned = false;
  double checked_dt = 0;

  int temperature_variable = -1;

  double totals[9], energy;    // over all processes, of the last step
  bool reduced = false;

  std::vector<lsdcd::Stroke> strokes;
  std::vector<int> image_kind;
  std::vector<double> image_data;
  std::vector<double *> image_rows;

  // What wall/lsdcd/kk does in its own way.
  virtual void start();
  virtual void collect();
  virtual void fill_masses();
  virtual double largest_radius();    // of the group, on this process
  virtual void need_on_host() {}      // before atom data are read outside of a step

  lsdcd::StepSettings step_settings(lsdcd::Spheres &);    // gives the spheres their heat, too
  void keep_outputs();
  void update_reach();
  void fill_contacts();
  void reduce_totals();

  lsdcd::EngineSettings engine_settings() const;
  void make_engine();
  void tune(double);    // fix_wall_lsdcd_tune.cpp

  // fix_wall_lsdcd_loads.cpp
  void add_loads();
  lsdcd::WallLoads gathered_loads() const;

  // fix_wall_lsdcd_heat.cpp
  void check_heat();
  void give_heat(lsdcd::Spheres &, lsdcd::StepSettings &);

  // fix_wall_lsdcd_checks.cpp
  void check_box(double) const;
  void check_side() const;
  void check_overlap(double);
  void check_timestep();
  void check_springs();
  double contact_time(double, double) const;
  void log_uncertified();
  void log_creation() const;
  void log_build(bool) const;
  void log(const std::string &) const;
  [[noreturn]] void refuse(const std::string &) const;
};

}    // namespace LAMMPS_NS

#endif
