// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The times of a setting on one backend: one source for all.
#pragma once

#include "backend/backend.h"
#include "backend/threads.h"
#include "contact/find_contacts.h"
#include "grid/lookup/grid_on.h"
#include "study/sample_timer.h"

#include <cstdint>
#include <ctime>
#include <optional>
#include <utility>
#include <vector>

namespace lsdcd {

struct FoundContacts {
  Real nearest;         // length
  Real exact_within;    // length
  int n;
};

// Searches for the contacts of sphere i, with room for more than any sphere of a sample has. kComplete: in lists of all
// features, else in those of the nearest primitives; each is a kernel with no more registers than its search needs.
template <bool kComplete>
struct SearchWork {
  GridView grid;
  const Real *x, *radius;
  FoundContacts *found;

  LSDCD_FN void operator()(std::size_t i) const
  {
    ContactSet<32> set;
    const Vec3 q = {x[3 * i], x[3 * i + 1], x[3 * i + 2]};
    Real exact_within = kAnyDistance;
    if constexpr (kComplete)
      find_in_complete<PackedEntries>(grid, q, radius[i], set);
    else
      exact_within = find_in_nearest(grid, q, radius[i], set);
    Real nearest = radius[i];
    for (int k = 0; k < set.n; k++) nearest = fmin(nearest, set.distance[k]);
    found[i] = {nearest, exact_within, set.n};
  }
};

// Puts coordinate k where it is after so many steps.
struct MoveWork {
  const Real *start, *way;    // way: of one step
  Real *x;
  Real steps;

  LSDCD_FN void operator()(std::size_t k) const { x[k] = start[k] + steps * way[k]; }
};

// Changes 32 MB, line by line.
inline void fill_caches()
{
  static std::vector<std::int64_t> other(std::size_t(4) << 20);
  for (std::size_t i = 0; i < other.size(); i += 8) other[i]++;
}

// Returns the time that this thread's processor has worked for it.
inline double thread_milliseconds()
{
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e3 * t.tv_sec + 1e-6 * t.tv_nsec;
}

// Returns by how far each coordinate moves in a step.
inline std::vector<Real> ways_of(const SphereSample &sample)
{
  Random random(1);
  std::vector<Real> ways;
  for (int i = 0; i < sample.n(); i++) {
    Vec3 to;
    do {
      for (int k = 0; k < 3; k++) to[k] = 2 * uniform_below_one(random) - 1;
    } while (norm_sq(to) > 1 || norm_sq(to) < Real(1e-6));
    const Real speed = kMargin / kChosenEvery * sample.radius[i] * uniform_below_one(random);
    for (int k = 0; k < 3; k++) ways.push_back(speed / norm(to) * to[k]);
  }
  return ways;
}

template <class B>
class SampleTimerOn : public SampleTimer {
  template <class T>
  using Array = typename B::template Array<T>;
  using MakeEngine = std::unique_ptr<WallEngine> (*)(const EngineSettings &);

 public:
  // `make_engine`: in place, for arrays of the backend on its stream.
  SampleTimerOn(const SphereSample &sample, B backend, MakeEngine make_engine) :
      b_(std::move(backend)), make_engine_(make_engine), n_(sample.n())
  {
    std::vector<Real> x;
    for (const Vec3 &p : sample.x) x.insert(x.end(), {p.x, p.y, p.z});
    const std::vector<Real> zero(x.size(), 0), one(n_, 1);
    start_ = from_cpu(b_, x);
    x_ = from_cpu(b_, x);
    way_ = from_cpu(b_, ways_of(sample));
    radius_ = from_cpu(b_, sample.radius);
    mass_ = from_cpu(b_, one);
    still_ = from_cpu(b_, zero);
    force_ = from_cpu(b_, zero);
    torque_ = from_cpu(b_, zero);
    found_ = Array<FoundContacts>(n_);
    for (const Real r : sample.radius) margin_ = r > margin_ ? r : margin_;
    margin_ *= kMargin;
    spheres_.n = sample.n();
    spheres_.x = x_.data();
    spheres_.v = spheres_.omega = still_.data();
    spheres_.radius = radius_.data();
    spheres_.mass = mass_.data();
    spheres_.force = force_.data();
    spheres_.torque = torque_.data();
  }

  std::string device() const override
  {
    const OnOneThread one_thread;
    return b_.name();
  }

  Spread search(const ViewOf<StepGrid> &grid, int repeats) override
  {
    const OnOneThread one_thread;
    const GridOn<B> there(b_, grid);
    return there.view.list_kind.is_complete() ? time_search<true>(there.view, repeats)
                                              : time_search<false>(there.view, repeats);
  }

  StepTimes steps(const ViewOf<StepGrid> &grid, const EngineSettings &settings,
                  int repeats) override
  {
    const OnOneThread one_thread;
    const auto engine = make_engine_(settings);
    engine->set_grid(grid);
    StepTimes times;
    for (int r = -1; r < repeats; r++) {    // once to warm up
      const double choice = milliseconds([&] { engine->choose(spheres_, margin_); });
      const StepDiagnostics made = engine->read_diagnostics();
      if (made.lists > 0) times.listed = double(made.listed) / made.lists;
      if (r < 0) {
        engine->step(spheres_, {});
        continue;
      }
      const double step = time_way(*engine, made.lists > 0);
      engine->read_diagnostics();    // throws where a sphere was left out
      times.choice.add(ns_of(choice));
      times.step.add(ns_of(step + choice / kChosenEvery));
    }
    times.kept_bytes = engine->bytes();
    return times;
  }

 private:
  struct OnOneThread {
    OnOneThread()
    {
      if (B::kOnCpu) one.emplace();
    }
    std::optional<OneThread> one;
  };

  // Milliseconds of f(), of kernels on a GPU.
  template <class F>
  double milliseconds(const F &f)
  {
    if constexpr (B::kOnCpu) {
      fill_caches();
      const double start = thread_milliseconds();
      f();
      return thread_milliseconds() - start;
    } else {
      return b_.milliseconds(f);
    }
  }
  double ns_of(double ms) const { return 1e6 * ms / (n_ > 0 ? n_ : 1); }

  template <bool kComplete>
  Spread time_search(const GridView &grid, int repeats)
  {
    const SearchWork<kComplete> work = {grid, x_.data(), radius_.data(), found_.data()};
    constexpr int kAtOnce = B::kOnCpu ? 1 : 10;    // so that starting kernels takes no time
    Spread spread;
    for (int r = -1; r < repeats; r++) {    // once to warm up
      const double ms = milliseconds([&] {
        for (int k = 0; k < kAtOnce; k++) b_.for_each(n_, work);
      });
      if (r >= 0) spread.add(ns_of(ms / kAtOnce));
    }
    return spread;
  }

  void move(int steps)
  {
    b_.for_each(3 * n_, MoveWork{start_.data(), way_.data(), x_.data(), Real(steps)});
  }

  // Milliseconds of a step, the mean over the way between two choices; spheres are back where they were then. `keeps_lists`:
  // what a step finds depends on those before it.
  double time_way(WallEngine &engine, bool keeps_lists)
  {
    double ms = 0;
    if constexpr (B::kOnCpu) {
      // A few of the steps: to fill caches takes as long as many steps.
      constexpr int kTimed = 12, kEvery = kChosenEvery / kTimed;
      for (int s = 0; s < kChosenEvery; s++) {
        const bool is_timed = s % kEvery == kEvery / 2;
        if (!is_timed && !keeps_lists) continue;
        move(s);
        if (is_timed)
          ms += milliseconds([&] { engine.step(spheres_, {}); });
        else
          engine.step(spheres_, {});
      }
      ms /= kTimed;
    } else {
      // All of them, without waiting, and less what it takes to move the spheres.
      const auto all = [&](const auto &work) {
        return milliseconds([&] {
          for (int s = 0; s < kChosenEvery; s++) {
            move(s);
            work();
          }
        });
      };
      const double with_steps = all([&] { engine.step(spheres_, {}); });
      ms = (with_steps - all([] {})) / kChosenEvery;
    }
    move(0);
    return ms;
  }

  B b_;
  MakeEngine make_engine_;
  std::size_t n_;
  Array<Real> start_, way_, x_, radius_, mass_, still_, force_, torque_;
  Array<FoundContacts> found_;
  Real margin_ = 0;
  Spheres spheres_;
};

}    // namespace lsdcd
