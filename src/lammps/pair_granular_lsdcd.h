// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// pair_style granular/lsdcd: the wall's contact laws between grains. It translates; src/pair does the work.
#ifndef LMP_PAIR_GRANULAR_LSDCD_H
#define LMP_PAIR_GRANULAR_LSDCD_H

#include "pair.h"

#include "engine/results/booked_energy.h"
#include "input/impacts_settings.h"
#include "lammps/own_messages.h"
#include "output/impact_spectrum.h"
#include "pair/pair_coeff.h"
#include "pair/pair_job.h"
#include "wall/spec/run_files.h"

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {

class PairGranularLsdcd : public Pair, protected OwnMessages {
 public:
  explicit PairGranularLsdcd(class LAMMPS *);
  ~PairGranularLsdcd() override;

  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  double init_one(int, int) override;
  void compute(int, int) override;
  double single(int, int, int, int, double, double, double, double &) override;
  double atom2cut(int);    // virtual in LAMMPS before 2026
  double radii2cut(double, double);

  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  std::vector<lsdcd::RunFile> files() const;    // that it has read, on the first process
  // Returns what pairs of this process have done with energy, for compute lsdcd/energy.
  const lsdcd::BookedEnergy &booked() const;
  // Returns the spectra of impacts since the beginning of all pairs of types that have some, over all processes, for compute lsdcd/impacts.
  // Collective.
  std::vector<lsdcd::TypesSpectrum> impacts() const;

 protected:
  // Return the name of the fix for springs, ask for the list of pairs, and return what a pair keeps as atom i sees it (empty: nothing).
  virtual std::string springs_style() const { return "SPRINGS/LSDCD"; }
  virtual void request_list();
  virtual std::vector<double> kept_numbers(int i, int j);
  virtual bool lists_are_by_types() const;
  bool atoms_changed() const;
  bool radii_are_due() const;
  void check_radii();
  bool ghosts_are_due() const;
  void share_atoms();
  double time_step() const;
  bool time_passes() const;
  int kept_width() const;    // numbers that a touching pair keeps
  void add_booked(const lsdcd::EnergyRows &rows, bool is_setup, double dt);
  int law_index(int i, int j) const { return law_of[i * (n_types + 1) + j]; }

 private:
  // The largest radii that atoms of a type may have: those that move, and those of fix freeze.
  struct Radii {
    double moving = 0, frozen = 0;
    double least = 0, least_mass = 0;    // of those that are there; 0: none is
  };

  void allocate();
  std::vector<std::string> words_of_materials(const std::vector<std::string> &);
  void find_radii();
  Radii largest_radii() const;
  void find_fixes();
  void set_springs();
  void check_order() const;
  double reach(int i, int j, double radius, double other) const;
  double longest_hold();
  lsdcd::PairJob job();
  void tell_laws();
  void check_step();
  void set_limits();

  // pair_granular_lsdcd_impacts.cpp
  void find_impacts();
  double share_of(int i, int j) const;    // of the energy of an impact that grains of type i take
  void record_impacts(const lsdcd::PairJob &step);

  double cutoff = -1;
  double coarse_grain = 1;    // grains are so many times as large as those of the coefficients
  std::map<std::pair<int, int>, lsdcd::PairCoeff> given;    // i <= j
  std::map<std::pair<int, int>, bool> of_material;          // whether its numbers are of a file
  std::set<std::string> material_files;                     // that the first process has read
  std::vector<lsdcd::PairCoeff> coeffs;                     // of each law
  std::vector<lsdcd::PairLaw> laws;                         // the same, compiled
  std::vector<unsigned> flips_of;                           // the same: see ContactLaw::flips()
  std::map<std::pair<int, int>, std::string>
      without_law;    // types that cannot be mixed, and why; within a hybrid style they may have another style
  std::vector<Radii> radii;
  bool told = false;
  std::vector<int> changing;    // see steps_between_changes()
  double warned_of = 0;         // the timestep that the last warning was about
  std::string springs_id, dummy_id;
  std::vector<lsdcd::RecordedPair> record;
  bool told_of_spectrum = false;    // in this run, that it cannot be written

 protected:
  int n_types = 0;
  std::vector<lsdcd::ContactLaw> numbers;    // of each law
  std::vector<int> law_of;                   // of types i and j at i * (n_types + 1) + j
  bool has_heat = false, books = false;
  lsdcd::KeptOfPair kept;                  // for the energy balance
  lsdcd::ImpactsSettings impacts_asked;    // by a compute
  bool has_impacts() const { return impacts_asked.least_speed > 0; }
  bool adapts = false;    // there is a fix adapt, which may change radii
  // limits: radii up to which lists hold grains of each type, at 2 * type, and those of fix freeze behind it. listed_radius: radii of atoms
  // when lists were made, if there is no fix adapt.
  std::vector<double> limits, listed_radius;
  class FixSpringsLsdcd *springs = nullptr;    // null: no law has kept anything yet
  class Fix *rigid = nullptr;
  int frozen = 0;                // bit of the group of fix freeze
  std::vector<double> masses;    // of atoms, or of the rigid bodies that they are of
};

}    // namespace LAMMPS_NS

#endif
