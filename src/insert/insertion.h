// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are due, and where they are put.
#pragma once

#include "insert/feed_schedule.h"
#include "insert/grain_source.h"
#include "insert/insertion_state.h"
#include "insert/packing.h"
#include "insert/random_stream.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

struct InsertionPlan {
  FeedSettings feed;
  GrainRecipe grains;
  std::int64_t seed = 1;
  int attempts = 100;    // for a grain in a step
};

// Where grains may be put.
class InsertionSite {
 public:
  virtual ~InsertionSite() = default;
  virtual bool draw(RandomStream &random, Real radius, Vec3 &at) = 0;    // false: none is found
  virtual bool is_clear_of_walls(const PackedSphere &grain) = 0;
  // Throws InputError where such a grain would find no place without any other grain. Asked of each grain for which
  // a step had none.
  virtual void check_has_room(const Grain &grain) = 0;
  // Returns the radius of the sphere as which a grain with a shape touches others in this host; 0: it touches them by its shape.
  virtual Real touch_radius(const Grain &) const { return 0; }
};

// All processes have the same state. In a step each calls draw_due(); one calls place(), and all pass its result to
// accept(); this is repeated while has_more().
class Insertion {
 public:
  struct Placed {
    std::size_t index;    // of owed()
    Vec3 at;
    Quaternion turn = {};    // of a grain with a shape, from its axes to the box
  };
  // Grains without a place are tried again 1, 2, 4 ... steps later, at most so many, for as long as none of them
  // finds one; and in each step in which another grain is due.
  static constexpr int kLongestWait = 20;
  // So many grains at most are without a place where others that were drawn later have one. This keeps the sizes of
  // what is in those that were drawn, however full the place is, and one grain without a place does not hold back all.
  static constexpr std::size_t kMostPassedOver = 5;
  // No more grains are drawn before these have places, so that a huge amount needs no huge memory.
  static constexpr std::size_t kMostDrawn = 1000000;

  Insertion(const InsertionPlan &plan, std::int64_t step, Real dt);

  const GrainSource &source() const { return source_; }
  // Returns the next step with something to do, or FeedSchedule::kNever.
  std::int64_t next_step() const { return next_step_; }

  void draw_due(std::int64_t step);
  // Is more due in this step, after all that was drawn has found a place?
  bool has_more(std::int64_t step) const;
  // The largest first where all find places that way, but for kMostPassedOver; else in the order in which they were
  // drawn. Where a grain finds no place, those that are no smaller wait for the next try. `packing`: of what is there.
  std::vector<Placed> place(std::int64_t step, InsertionSite &site, const Packing &packing,
                            Refused &refused) const;
  // Returns a grain as it fills its place.
  PackedSphere packed(const Grain &grain, const Vec3 &at, const Quaternion &turn,
                      Real touch_radius) const;
  void accept(std::int64_t step, const std::vector<Placed> &placed, const Refused &refused);

  // Before a run from this step, and where the timestep changes. Steps without it are counted as time.
  void begin_run(std::int64_t step, Real dt);

  // Since the fix was defined.
  std::int64_t inserted() const { return drawn_.number - static_cast<std::int64_t>(owed_.size()); }
  Real inserted_mass() const { return inserted_mass_; }
  // Drawn, without a place.
  const std::vector<Grain> &owed() const { return owed_; }
  // Due, without a place. Grains that are not yet drawn count with the mean mass.
  GrainTotals late() const;
  const Refused &refused() const { return refused_; }
  // The highest ID that the host has given to a grain, so that none gets that of one that has gone; 0: none yet.
  std::int64_t last_id() const { return last_id_; }
  void note_id(std::int64_t id) { last_id_ = id; }
  // The highest ID that the host has given to the molecule of a clump; 0: none yet.
  std::int64_t last_molecule() const { return last_molecule_; }
  void note_molecule(std::int64_t id) { last_molecule_ = id; }
  // Is more in than the total that is asked for?
  bool is_past_total() const;

  // For a restart file, at this step.
  State state(std::int64_t step) const;
  // Goes on in this step, whatever the number of the step was before. Takes at most n numbers of State. False: the amounts
  // or the grains of the plan are others. The grains that are in then stay, and the amount that the former plan has given;
  // those without a place are drawn again. Throws StateError, and nothing has changed.
  bool restore(const Real *numbers, std::size_t n, std::int64_t step);

 private:
  void find_next_step(std::int64_t now);
  struct Attempt {
    Packing packing;
    std::vector<Placed> placed = {};
    Refused refused = {};
  };
  std::vector<std::size_t> by_size() const;
  bool place_in_order(const std::vector<std::size_t> &order, std::int64_t step, InsertionSite &site,
                      Attempt &attempt) const;
  bool finds_place(std::size_t i, std::int64_t step, InsertionSite &site, Attempt &attempt) const;
  bool has_drawn_all() const { return owed_.size() < kMostDrawn; }
  Grain next_grain() const { return source_.grain(next_number_); }
  Real amount_given(std::int64_t step) const;
  std::vector<Real> numbers_of_plan() const;

  InsertionPlan plan_;
  GrainSource source_;
  FeedSchedule schedule_;
  GrainTotals drawn_;
  std::int64_t next_number_ = 0;              // of grains
  std::vector<Grain> owed_;                   // in the order of their numbers
  GrainTotals not_drawn_;                     // due beyond these
  std::size_t late_ = 0;                      // of owed_, before this step's grains were drawn
  std::int64_t first_new_ = 0;                // number of the first of these
  std::int64_t wait_ = 1, retry_step_ = 0;    // for owed grains
  Real inserted_mass_ = 0;
  Refused refused_;
  std::int64_t last_id_ = 0, last_molecule_ = 0;
  std::int64_t next_step_ = 0;
};

}    // namespace lsdcd
