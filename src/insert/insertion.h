// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Grains that are due, and where they are put.
#pragma once

#include "insert/feed_schedule.h"
#include "insert/grain_source.h"
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
};

// How many places were no good, by what was there.
struct Refused {
  std::int64_t no_place = 0, grains = 0, walls = 0;

  std::int64_t all() const { return no_place + grains + walls; }
  void add(const Refused &more);
};

// All processes keep the same state. In a step each calls draw_due(); one calls place(), and all are told
// the result by accept().
class Insertion {
 public:
  struct Placed {
    std::size_t index;    // of owed()
    Vec3 at;
  };
  static constexpr int kRetry = 20;    // steps, after one that left a grain without a place

  Insertion(const InsertionPlan &plan, std::int64_t step, Real dt);

  const GrainSource &source() const { return source_; }
  // The next step with something to do, or FeedSchedule::kNever.
  std::int64_t next_step() const { return next_step_; }

  void draw_due(std::int64_t step);
  // The largest first. A grain that finds no place leaves the others of about its size to the next try.
  std::vector<Placed> place(std::int64_t step, InsertionSite &site, Packing &packing,
                            Refused &refused) const;
  void accept(std::int64_t step, const std::vector<Placed> &placed, const Refused &refused);

  // Before a run from this step, and where the timestep changes. Steps without it are counted as time.
  void begin_run(std::int64_t step, Real dt);

  // Since the fix was defined.
  std::int64_t inserted() const { return drawn_.number - static_cast<std::int64_t>(owed_.size()); }
  Real inserted_mass() const { return inserted_mass_; }
  const std::vector<Grain> &owed() const { return owed_; }    // due, without a place
  Real owed_mass() const;
  const Refused &refused() const { return refused_; }

  // Numbers for a restart file.
  std::vector<Real> state() const;
  // False: the state is of something else, and nothing was done.
  bool restore(const std::vector<Real> &state, std::int64_t step);

 private:
  void find_next_step(std::int64_t now);

  InsertionPlan plan_;
  GrainSource source_;
  FeedSchedule schedule_;
  Drawn drawn_;
  std::vector<Grain> owed_;    // the largest first
  Real inserted_mass_ = 0;
  Refused refused_;
  std::int64_t next_step_ = 0;
};

}    // namespace lsdcd
