// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// fix SPRINGS/LSDCD: what the pairs of pair_style granular/lsdcd keep, while lists are made anew, between processes and in
// restart files. The pair style makes and deletes it.
#ifndef LMP_FIX_SPRINGS_LSDCD_H
#define LMP_FIX_SPRINGS_LSDCD_H

#include "atom.h"
#include "fix.h"

#include "engine/results/booked_energy.h"
#include "lammps/own_messages.h"
#include "lammps/rerun_watch.h"
#include "lammps/run_speed.h"
#include "pair/pair_impacts.h"
#include "pair/partners.h"

#include <functional>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixSpringsLsdcd : public Fix, protected OwnMessages {
 public:
  FixSpringsLsdcd(class LAMMPS *, int, char **);
  ~FixSpringsLsdcd() override;

  int setmask() override;
  void init() override;
  void setup_pre_exchange() override;
  void setup_post_neighbor() override { post_neighbor(); }
  void pre_exchange() override;
  void post_neighbor() override;
  void min_pre_exchange() override { pre_exchange(); }
  void min_post_neighbor() override { post_neighbor(); }
  void post_run() override;
  void setup_pre_force_respa(int, int ilevel) override { level = ilevel; }
  void pre_force_respa(int, int ilevel, int) override { level = ilevel; }

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_reverse_comm_size(int, int) override;
  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;

  void write_restart(FILE *) override;
  void restart(char *) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  double memory_usage() override;

 protected:
  // The pair style reads and calls what follows, and exists as long as this fix does.
  friend class PairGranularLsdcd;
  // What the fix asks of the law of two types: which numbers of a pair change sign if its grains change places, and
  // ContactLaw::history_kind().
  struct LawsOfTypes {
    std::function<unsigned(int type, int other)> flips;
    std::function<int(int type, int other)> kind;
  };
  // Sets the laws before a run. `width`: how many numbers laws keep of a pair; 0: none. `for_energy`: how many more each pair keeps
  // behind these for the energy balance. `kinds`: of all pairs of types, with a ';' behind each.
  virtual void set_laws(int width, int for_energy, const std::string &kinds,
                        const LawsOfTypes &laws);
  // Says before set_laws() that impacts are recorded which are faster than this (length/time); 0: none are.
  void record_impacts(double least_speed);
  // Adds the impacts of a step of pairs that has run. Collective.
  void add_impacts(const lsdcd::PairJob &step);
  // Prepares for a step of the pairs in this list. `types_changed`: types may have changed since the last step, with the same list.
  void begin_step(const lsdcd::PairList &list, bool types_changed);
  const lsdcd::PairHistory &old() const { return history[1 - now]; }
  lsdcd::PairHistory &next() { return history[now]; }
  // Returns what the pair of row and place of the last list keeps; nothing if it does not touch.
  std::vector<double> numbers_of(int row, int place);

  bool keeps() const { return partners.width() > 0; }
  // Brings what the pairs of the last step keep to their atoms.
  virtual void collect();
  void tell_owners();
  // Forgets what pairs have kept.
  virtual void forget();
  // Returns the IDs of atoms on the CPU.
  virtual const tagint *tags() { return atom->tag; }
  virtual const double *radii() { return atom->radius; }
  // Keeps the IDs that atoms have, for rename_partners().
  void keep_names();
  // Returns half of the least way from an image of a grain to another; 0: none can touch two.
  double near_images() const;
  // Notes that types may have changed since the last step, with the same lists. Returns whether numbers were cleared, because they were of
  // another law.
  virtual bool note_types();
  void tell_cleared();
  virtual int largest_packed_size() const { return partners.largest_packed_size(); }
  // Returns the partners on the CPU, for atoms that LAMMPS moves one by one and for restart files.
  virtual lsdcd::Partners &of_atoms() { return partners; }

  lsdcd::Partners partners;
  int law_width = 0;             // numbers of the laws, which are in restart files
  lsdcd::BookedEnergy energy;    // of pairs on this process, if it is recorded
  bool books = false;
  lsdcd::PairSpectra impacts;    // of pairs on this process
  bool has_impacts = false;
  // If impacts are recorded, and pairs keep nothing else, they keep a 0, so that the next step knows which contacts begin.
  bool keeps_touch = false;
  lsdcd::PairHistory history[2];
  int now = 0;              // which of them the last step has written
  lsdcd::PairList list;     // of the last step
  int own = 0;              // atoms of this process then
  bool in_pairs = false;    // history[now] is newer than partners
  bool moved = false;       // atoms have other places than in the last list
  bool new_list = true;     // since the last step
  std::vector<std::size_t>
      row_start;    // the number of a row's first pair in the list, of as many rows as were asked for
  int level = 0;        // of run_style respa, whose forces come next
  std::string kinds;    // of the laws, or of those of a restart file
  bool from_file =
      false;    // partners are those of a restart file, whose laws have not been checked
  LawsOfTypes laws;
  // by_law: laws of types keep numbers of several kinds. cleared: numbers were cleared, which the log has not told yet. listed_type: types
  // of atoms in the last step of a list.
  bool by_law = false, cleared = false;
  std::vector<int> listed_type;
  double largest_pair =
      0;    // the distance at which the two largest grains touch, however they may grow
  // Commands between runs may give atoms other IDs. known_as: the ID by which partners know an atom; 0: the atom is new.
  bool between_runs = true;
  std::vector<tagint> known_as;
  lsdcd::RunSpeed speed{lmp};
  RerunWatch watch;
  // The radii of atoms when the list was made, if fix adapt changes radii before the step of pairs.
  bool watches_radii = false;
  std::vector<double> listed_radius;

 private:
  void bring_to_atoms();
  void rename_partners();
  lsdcd::KeptRows &told() { return contacts_told ? *contacts_told : of_atoms(); }

  lsdcd::KeptRows *contacts_told =
      nullptr;    // while owners are told of contacts in place of partners
};

}    // namespace LAMMPS_NS

#endif
