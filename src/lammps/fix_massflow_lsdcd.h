// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix massflow/lsdcd: what passes a surface that is a triangle mesh and exerts no force.
#ifndef LMP_FIX_MASSFLOW_LSDCD_H
#define LMP_FIX_MASSFLOW_LSDCD_H

#include "fix.h"

#include "flow/flow_surface.h"
#include "flow/pass_file.h"
#include "input/massflow_settings.h"
#include "lammps/output_variables.h"
#include "lammps/own_messages.h"
#include "lammps/rerun_watch.h"
#include "wall/spec/run_files.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixMassflowLsdcd : public Fix, protected OwnMessages {
 public:
  FixMassflowLsdcd(class LAMMPS *, int, char **);
  ~FixMassflowLsdcd() override;

  // schedule and counting: fix_massflow_lsdcd.cpp
  int setmask() override;
  void init() override;
  void setup(int) override;
  void end_of_step() override;
  void post_run() override;

  // what goes with an atom, and deletion: fix_massflow_lsdcd_atoms.cpp
  void pre_exchange() override;
  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

  // totals: fix_massflow_lsdcd_output.cpp
  double compute_vector(int) override;
  double compute_array(int, int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  int modify_param(int, char **) override;

  bool deletes() const { return settings.deletes; }
  std::vector<lsdcd::RunFile> files() const;    // that it reads and writes

 protected:
  enum : unsigned { kCounted = 1, kToDelete = 2, kAllFlags = 3 };    // others are a form's own
  // An atom that may have passed, as it is at the end of the step. direction: not yet known.
  struct Passer {
    lsdcd::Passage row;
    double mass;
    int mask;
  };

  // massflow/lsdcd/kk has its own forms of the following functions.
  virtual void begin_at_atoms();    // of a run
  virtual void box_has_changed(const lsdcd::PeriodicBox &before);
  virtual void look_at_atoms();    // all, or those near the surface
  virtual void settle() {}         // counts what waits to be counted
  virtual unsigned &flags_of(int i) { return tracks[i].flags; }

  void count(const Passer &, lsdcd::Passes, unsigned &flags);
  void note_deleted(bigint n, double mass) { note_deleted(n, mass, n); }
  // Of this process: grains, their mass, and the atoms that they are of. Collective.
  void note_deleted(bigint n, double mass, bigint n_atoms);
  [[noreturn]] void lost_sight(std::int64_t id) const;
  double simulated_time() const;
  void forget_tracks() { std::vector<Track>().swap(tracks); }    // for a form with others

  lsdcd::MassflowSettings settings;
  OutputVariables variables;
  std::unique_ptr<lsdcd::FlowSurface> surface;
  double near_within = 0;       // atoms with less clearance are near
  bool look_at_all = true;      // in the next step
  bool all_were_seen = true;    // in the last step
  lsdcd::PeriodicBox box;       // of the last step

 private:
  // Columns of the totals: those of a type, and what follows those of all types.
  enum { kForward, kForwardMass, kBackward, kBackwardMass, kColumns };
  enum { kDeleted, kDeletedMass, kAfterTypes };
  // What is known of an atom. The surface is farther than `clear` from `last`: an atom that has not moved that far has not passed. `clear`
  // not above 0: not known.
  struct Track {
    lsdcd::Vec3 last;    // position when last looked at
    double clear;
    unsigned flags;
    double clump_mass;    // of the first atom of a clump; 0: it is none
  };
  static constexpr int kTrackSize = 6;    // in messages
  // Of flags, with clumps: another atom counts for this one, and whether one does is to be found.
  enum : unsigned { kFollows = 4, kNew = 8 };

  RerunWatch watch;
  std::vector<Track> tracks;
  std::vector<int> near;     // atoms looked at in every step
  double far = 0;            // no clearance is measured beyond
  bool callbacks = false;    // registered with Atom

  // On this process.
  std::vector<double> mine, totals;    // totals: of all processes, where `reduced`
  bool reduced = false;
  // The window over which the rate is an average, on all processes.
  struct Window {
    double time = 0;
    int steps = 0;
    double start = 0, rate = 0;    // start: net mass; rate: of the window before
    template <class Numbers>
    friend void each_number(Numbers &numbers, Window &w)
    {
      numbers(w.time, w.steps, w.start, w.rate);
    }
  } window;
  double time_seen = 0;    // LAMMPS's, at the end of the last step
  bigint step_seen = 0;    // its number
  // The file of the keyword file, and passages of this process that are not in it yet.
  std::unique_ptr<lsdcd::PassFile> rows;
  std::vector<lsdcd::Passage> passages;
  std::int64_t rows_before = 0;    // that a restart file tells of

  lsdcd::WeldedMesh read_mesh();
  void check_size(const lsdcd::WeldedMesh &) const;
  void follow_box();
  void look(int);
  void find_clumps();
  void find_clumps(tagint first, tagint last);
  std::vector<tagint> molecules_to_delete() const;
  Passer passer(int) const;
  void open_rows();
  void keep_row(lsdcd::Passage, lsdcd::Passes);
  void write_rows();
  void reduce();
  double net_mass();
  void end_window();
  double mass_of(int) const;
};

}    // namespace LAMMPS_NS

#endif
