// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Normal models of contacts that yield: they unload along another line than they load, and keep numbers that say which.
//
// A model is a struct with
//   kStored                     how many numbers a contact keeps for it, the first of which says how far it has yielded
//   kHeals                      does that number shrink as the contact opens?
//   update(n, c, own)           moves what a contact keeps to its overlap
//   force(n, c, own)            elastic force, > 0 where it pushes
//   held(n, c, own)             elastic energy
//   yielded(n, c, own)          the energy that loading has lost when it has come to `own` for the first time
//   turns(n, c, own)            the overlap at which unloading comes to the adhesive branch; 0: it has none
//   pulled(n, c, own, overlap)  the work of the adhesive branch from this overlap to 0
//   pull(n, c, own)             the pull of the adhesive branch at the overlap of the contact, which friction sees beside the force
//   loading(n, c)               stiffness of loading, force over overlap
//   unloading(n, c)             the steepest slope of the force
// where n are the numbers of the law (ContactLaw::plastic), c is a Contact or a PairContact, and `own` is what it keeps. After update()
// the other functions are those of the overlap to which it moved. PlasticNormal, below, lists the models.
//
// Formulas have products and roots alone, so that a GPU returns the same bits as a CPU.
#pragma once

#include "base/cube_root.h"
#include "law/submodels/cohesion.h"
#include "law/submodels/normal.h"

#include <cmath>

namespace lsdcd {

constexpr int kPlasticNumbers = 6;    // of a law that yields
constexpr int kPlasticStored = 2;     // at most so many does a contact keep for it

// Returns x^(2/3) for x >= 0.
LSDCD_FN Real two_thirds_power(Real x)
{
  const Real root = cube_root(x);
  return root * root;
}
// Returns x to the power of half of a whole number, for x >= 0.
LSDCD_FN Real half_power(Real x, int halves)
{
  Real power = halves % 2 ? sqrt(x) : Real(1);
  for (int k = 0; k < halves / 2; k++) power *= x;
  return power;
}

// The adhesive branch of a model that has none.
struct WithoutBranch {
  template <class C>
  LSDCD_FN static Real turns(const Real *, const C &, const Real *)
  {
    return 0;
  }
  template <class C>
  LSDCD_FN static Real pulled(const Real *, const C &, const Real *, Real)
  {
    return 0;
  }
  template <class C>
  LSDCD_FN static Real pull(const Real *, const C &, const Real *)
  {
    return 0;
  }
};

// `hysteretic` k1 e (Walton and Braun 1986): a linear spring that unloads along a line of the slope k1/e^2. The contact keeps the overlap
// at which the force vanishes. It heals: as it opens further, the force stays 0, and loading begins anew from where it turns.
// kPerRadius: k1 is a pressure, times the radius of the contact.
template <NormalModel kModel_, bool kPerRadius>
struct HystereticNormal : WithoutBranch {
  static constexpr NormalModel kModel = kModel_;
  static constexpr int kStored = 1;
  static constexpr bool kHeals = true;

  template <class C>
  LSDCD_FN static Real loading(const Real *n, const C &c)
  {
    return kPerRadius ? n[0] * c.radius : n[0];
  }
  template <class C>
  LSDCD_FN static Real unloading(const Real *n, const C &c)
  {
    return loading(n, c) / (n[1] * n[1]);
  }
  template <class C>
  LSDCD_FN static void update(const Real *n, const C &c, Real *own)
  {
    const Real d = c.overlap, k2 = unloading(n, c);
    if (k2 * (d - own[0]) > loading(n, c) * d)
      own[0] = (1 - n[1] * n[1]) * d;
    else if (d < own[0])
      own[0] = d;
  }
  template <class C>
  LSDCD_FN static Real force(const Real *n, const C &c, const Real *own)
  {
    return unloading(n, c) * (c.overlap - own[0]);
  }
  template <class C>
  LSDCD_FN static Real held(const Real *n, const C &c, const Real *own)
  {
    const Real apart = c.overlap - own[0];
    return 0.5 * unloading(n, c) * apart * apart;
  }
  template <class C>
  LSDCD_FN static Real yielded(const Real *n, const C &c, const Real *own)
  {
    const Real share = 1 - n[1] * n[1];    // of the overlap that stays
    return share > 0 ? 0.5 * loading(n, c) / share * own[0] * own[0] : 0;
  }
};

// `eepa`, the Edinburgh elasto-plastic adhesion model (Thakur et al. 2014; Morrissey 2013). Numbers: k1, k2 (force/length^n), surface energy
// (energy/length^2), n, chi, f0 (force, <= 0). Loading f0 + k1 d^n, unloading f0 + k2 (d^n - q), and then the adhesive branch
// f0 - ka d^chi. A contact keeps q, which is its plastic overlap to the power n, and ka.
struct EepaNormal {
  static constexpr NormalModel kModel = NormalModel::eepa;
  static constexpr int kStored = 2;
  static constexpr bool kHeals = true;

  LSDCD_FN static bool is_linear(const Real *n) { return n[3] == 1; }
  // Returns overlap^n, and the overlap of such a power.
  LSDCD_FN static Real to_n(const Real *n, Real d) { return is_linear(n) ? d : d * sqrt(d); }
  LSDCD_FN static Real from_n(const Real *n, Real q)
  {
    return is_linear(n) ? q : two_thirds_power(q);
  }
  LSDCD_FN static Real to_chi(const Real *n, Real d)
  {
    return half_power(d, static_cast<int>(2 * n[4] + 0.5));
  }
  LSDCD_FN static Real plastic_share(const Real *n) { return 1 - n[0] / n[1]; }

  // Returns the slope of the adhesive branch of a contact that has yielded to q. The branch begins where the pull is that of the
  // surfaces along the rim of the circle in which they cut each other at the plastic overlap, or half of what unloading can reach.
  template <class C>
  LSDCD_FN static Real adhesive_slope(const Real *n, const C &c, Real q)
  {
    if (!(n[2] > 0)) return 0;
    C plastic = c;
    plastic.overlap = from_n(n, q);
    const Real rim = sqrt(SjkrCohesion{1}.pull(plastic) / kPi);
    const Real most = 0.5 * n[1] * q, of_rim = 1.5 * kPi * n[2] * rim;
    const Real pull = of_rim < most ? of_rim : most;
    return pull / to_chi(n, from_n(n, q - pull / n[1]));
  }
  template <class C>
  LSDCD_FN static void update(const Real *n, const C &c, Real *own)
  {
    const Real powered = to_n(n, c.overlap), yields = plastic_share(n) * powered;
    if (yields > own[0]) {
      own[0] = yields;
      own[1] = adhesive_slope(n, c, yields);
    }
    const Real branch = own[1] * to_chi(n, c.overlap);
    if (n[1] * (powered - own[0]) < -branch) own[0] = powered + branch / n[1];
  }
  template <class C>
  LSDCD_FN static Real force(const Real *n, const C &c, const Real *own)
  {
    return n[5] + n[1] * (to_n(n, c.overlap) - own[0]);
  }
  template <class C>
  LSDCD_FN static Real held(const Real *n, const C &c, const Real *own)
  {
    const Real d = c.overlap, plastic = from_n(n, own[0]), q = own[0];
    return n[1] * ((to_n(n, d) * d - q * plastic) / (n[3] + 1) - q * (d - plastic)) + n[5] * d;
  }
  template <class C>
  LSDCD_FN static Real yielded(const Real *n, const C &, const Real *own)
  {
    const Real plastic = from_n(n, own[0]), whole = plastic / from_n(n, plastic_share(n));
    const Real left = whole - plastic;
    return (n[0] * to_n(n, whole) * whole - n[1] * (to_n(n, whole) * whole - own[0] * plastic)) /
               (n[3] + 1) +
           n[1] * own[0] * left;
  }
  // Where chi is not n, the overlap is found by halving.
  template <class C>
  LSDCD_FN static Real turns(const Real *n, const C &, const Real *own)
  {
    if (n[4] == n[3]) return from_n(n, own[0] / (1 + own[1] / n[1]));
    Real below = 0, above = from_n(n, own[0]);
    for (int k = 0; k < 60; k++) {
      const Real d = 0.5 * (below + above);
      if (n[1] * (to_n(n, d) - own[0]) + own[1] * to_chi(n, d) < 0)
        below = d;
      else
        above = d;
    }
    return above;
  }
  template <class C>
  LSDCD_FN static Real pulled(const Real *n, const C &, const Real *own, Real overlap)
  {
    return own[1] * to_chi(n, overlap) * overlap / (n[4] + 1) - n[5] * overlap;
  }
  template <class C>
  LSDCD_FN static Real pull(const Real *n, const C &c, const Real *own)
  {
    return own[1] * to_chi(n, c.overlap) - n[5];
  }
  template <class C>
  LSDCD_FN static Real loading(const Real *n, const C &c)
  {
    return is_linear(n) ? n[0] : n[0] * sqrt(c.overlap);
  }
  template <class C>
  LSDCD_FN static Real unloading(const Real *n, const C &c)
  {
    return is_linear(n) ? n[1] : 1.5 * n[1] * sqrt(c.overlap);
  }
};

// `lepa`, linear elasto-plastic adhesion (Luding 2008; Singh et al. 2013). Numbers: k1, kp, kc (force/length), phi. Loading k1 d; unloading
// along a slope that grows with the greatest overlap x from k1 to kp, which it reaches at x = kp/(kp - k1) phi 2 R'; then the adhesive
// branch -kc d. A contact keeps x, which shrinks along that branch so that reloading begins there.
struct LepaNormal {
  static constexpr NormalModel kModel = NormalModel::lepa;
  static constexpr int kStored = 1;
  static constexpr bool kHeals = true;

  // Returns the overlap from which unloading has the slope kp. R' is the radius at a wall, 2 Ri Rj/(Ri + Rj) between grains.
  template <class C>
  LSDCD_FN static Real elastic_from(const Real *n, const C &c)
  {
    return n[1] / (n[1] - n[0]) * n[3] * (C::kPair ? 4 : 2) * c.radius;
  }
  // Returns by how much unloading from the greatest overlap x is steeper than loading.
  template <class C>
  LSDCD_FN static Real steeper(const Real *n, const C &c, Real x)
  {
    return (n[1] - n[0]) / elastic_from(n, c) * x;
  }
  template <class C>
  LSDCD_FN static void update(const Real *n, const C &c, Real *own)
  {
    const Real d = c.overlap, most = elastic_from(n, c);
    if (d > own[0]) own[0] = d;
    if (own[0] > most) own[0] = most;
    const Real more = steeper(n, c, own[0]);
    if ((n[0] + more) * d - more * own[0] < -n[2] * d)
      own[0] = 0.5 * (d + sqrt(d * d + 4 * (n[0] + n[2]) / (n[1] - n[0]) * d * most));
  }
  template <class C>
  LSDCD_FN static Real force(const Real *n, const C &c, const Real *own)
  {
    const Real more = steeper(n, c, own[0]);
    return (n[0] + more) * c.overlap - more * own[0];
  }
  template <class C>
  LSDCD_FN static Real held(const Real *n, const C &c, const Real *own)
  {
    const Real f = force(n, c, own);
    return 0.5 * f * f / (n[0] + steeper(n, c, own[0]));
  }
  template <class C>
  LSDCD_FN static Real yielded(const Real *n, const C &c, const Real *own)
  {
    const Real more = steeper(n, c, own[0]);
    return 0.5 * n[0] * own[0] * own[0] * more / (n[0] + more);
  }
  template <class C>
  LSDCD_FN static Real turns(const Real *n, const C &c, const Real *own)
  {
    const Real more = steeper(n, c, own[0]);
    return more * own[0] / (n[0] + more + n[2]);
  }
  template <class C>
  LSDCD_FN static Real pulled(const Real *n, const C &, const Real *, Real overlap)
  {
    return 0.5 * n[2] * overlap * overlap;
  }
  template <class C>
  LSDCD_FN static Real pull(const Real *n, const C &c, const Real *)
  {
    return n[2] * c.overlap;
  }
  template <class C>
  LSDCD_FN static Real loading(const Real *n, const C &)
  {
    return n[0];
  }
  template <class C>
  LSDCD_FN static Real unloading(const Real *n, const C &)
  {
    return n[1];
  }
};

// `thornton` (Thornton 1997): a sphere of an elastic, perfectly plastic material. Numbers: E* of the contact, and the contact pressure py at
// which it yields. Hertz up to the overlap R (pi py / 2 E*)^2, then loading by pi py R, and unloading by Hertz with the radius to which the
// contact was flattened. A contact keeps its greatest overlap, which stays.
struct ThorntonNormal : WithoutBranch {
  static constexpr NormalModel kModel = NormalModel::thornton;
  static constexpr int kStored = 1;
  static constexpr bool kHeals = false;

  // What unloading from the greatest overlap follows.
  struct Line {
    Real yields_at, force_there;    // overlap and force where it yields first
    Real force;                     // at the greatest overlap
    Real radius, begin;    // of the flattened contact, and the overlap at which its force vanishes
  };
  template <class C>
  LSDCD_FN static Line line_of(const Real *n, const C &c, Real greatest)
  {
    const Real root = kPi * n[1] / (2 * n[0]), hertz = Real(4) / 3 * n[0];
    Line line;
    line.yields_at = c.radius * root * root;
    line.force_there = hertz * c.radius * root * line.yields_at;
    line.radius = c.radius;
    line.begin = 0;
    const Real over = greatest - line.yields_at;
    if (!(over > 0)) {
      line.force = hertz * sqrt(c.radius * greatest) * greatest;
      return line;
    }
    line.force = line.force_there + kPi * n[1] * c.radius * over;
    const Real share = (2 * line.force + line.force_there) / (2 * kPi * n[1]);
    line.radius = hertz / line.force * share * sqrt(share);
    line.begin = greatest - two_thirds_power(line.force / (hertz * sqrt(line.radius)));
    return line;
  }
  template <class C>
  LSDCD_FN static void update(const Real *, const C &c, Real *own)
  {
    if (c.overlap > own[0]) own[0] = c.overlap;
  }
  template <class C>
  LSDCD_FN static Real force(const Real *n, const C &c, const Real *own)
  {
    const Line line = line_of(n, c, own[0]);
    const Real d = c.overlap - line.begin;
    return d > 0 ? Real(4) / 3 * n[0] * sqrt(line.radius * d) * d : 0;
  }
  LSDCD_FN static Real hertz_energy(const Real *n, Real radius, Real d)
  {
    return d > 0 ? Real(8) / 15 * n[0] * sqrt(radius * d) * d * d : 0;
  }
  template <class C>
  LSDCD_FN static Real held(const Real *n, const C &c, const Real *own)
  {
    const Line line = line_of(n, c, own[0]);
    return hertz_energy(n, line.radius, c.overlap - line.begin);
  }
  template <class C>
  LSDCD_FN static Real yielded(const Real *n, const C &c, const Real *own)
  {
    const Line line = line_of(n, c, own[0]);
    const Real over = own[0] - line.yields_at;
    if (!(over > 0)) return 0;
    return hertz_energy(n, c.radius, line.yields_at) +
           0.5 * (line.force_there + line.force) * over -
           hertz_energy(n, line.radius, own[0] - line.begin);
  }
  template <class C>
  LSDCD_FN static Real loading(const Real *n, const C &c)
  {
    return c.overlap > 0 ? line_of(n, c, c.overlap).force / c.overlap : 0;
  }
  template <class C>
  LSDCD_FN static Real unloading(const Real *n, const C &c)
  {
    const Line line = line_of(n, c, c.overlap);
    return 2 * n[0] * sqrt(line.radius * (c.overlap - line.begin));
  }
};

// ---- the families ------------------------------------------------------------------------

// A model of TouchingNormal as one of this family, which keeps nothing. Numbers: the stiffness, and for `dmt` the pull per radius.
template <NormalModel kModel_>
struct TouchingModel : WithoutBranch {
  static constexpr NormalModel kModel = kModel_;
  static constexpr int kStored = 0;
  static constexpr bool kHeals = false;

  LSDCD_FN static TouchingNormal normal(const Real *n) { return {kModel, n[0], n[1]}; }
  template <class C>
  LSDCD_FN static void update(const Real *, const C &, Real *)
  {
  }
  template <class C>
  LSDCD_FN static Real force(const Real *n, const C &c, const Real *)
  {
    return normal(n).force(c, normal(n).contact_radius(c));
  }
  template <class C>
  LSDCD_FN static Real held(const Real *n, const C &c, const Real *)
  {
    return normal(n).energy(c, normal(n).contact_radius(c));
  }
  template <class C>
  LSDCD_FN static Real yielded(const Real *, const C &, const Real *)
  {
    return 0;
  }
  template <class C>
  LSDCD_FN static Real pull(const Real *n, const C &c, const Real *)
  {
    return 2 * n[1] * c.radius;
  }
  template <class C>
  LSDCD_FN static Real loading(const Real *n, const C &c)
  {
    return normal(n).secant(c, normal(n).contact_radius(c));
  }
  template <class C>
  LSDCD_FN static Real unloading(const Real *n, const C &c)
  {
    return normal(n).tangent(c, normal(n).contact_radius(c));
  }
};

// The models of one kernel. All contacts of a wall have the same one.
template <class... Models>
struct Plastic {
  static constexpr bool kBeyondContact = false;
  static constexpr int kScalars = kPlasticStored;

  NormalModel model;
  Real numbers[kPlasticNumbers];

  LSDCD_FN static bool has(NormalModel of) { return ((of == Models::kModel) || ...); }
  // Returns whether a contact keeps the k-th number.
  LSDCD_FN bool stores(int k) const
  {
    return ((model == Models::kModel && k < Models::kStored) || ...);
  }
  // Returns whether what a contact keeps shrinks as it opens.
  LSDCD_FN bool heals() const { return ((model == Models::kModel && Models::kHeals) || ...); }

  // Forgets, as the surfaces part, what a contact that heals keeps.
  LSDCD_FN void forget(Real *own) const
  {
    for (int k = 0; k < kScalars; k++)
      if (heals()) own[k] = 0;
  }

  LSDCD_FN bool uses_contact_radius() const { return false; }    // does the force need it?
  LSDCD_FN Real contact_radius(const Contact &c) const { return sqrt(c.overlap * c.radius); }
  template <class C>
  LSDCD_FN Real secant(const C &c, Real) const
  {
    return of_model([&](auto m) { return m.loading(numbers, c); });
  }
  template <class C>
  LSDCD_FN Real tangent(const C &c, Real) const
  {
    return of_model([&](auto m) { return m.unloading(numbers, c); });
  }
  template <class C>
  LSDCD_FN void update(const C &c, Real *own) const
  {
    of_model([&](auto m) { return m.update(numbers, c, own), Real(0); });
  }
  template <class C>
  LSDCD_FN Real force(const C &c, const Real *own) const
  {
    return of_model([&](auto m) { return m.force(numbers, c, own); });
  }
  template <class C>
  LSDCD_FN Real energy(const C &c, const Real *own) const
  {
    return of_model([&](auto m) { return m.held(numbers, c, own); });
  }
  // Returns the force that friction is proportional to. f: the elastic force; `normal`: with damping.
  template <class C>
  LSDCD_FN Real limit(const C &c, Real f, Real normal, const Real *own) const
  {
    const Real pull = of_model([&](auto m) { return m.pull(numbers, c, own); });
    return fabs(pull > 0 ? f + pull : normal);
  }
  // Returns the energy that a contact has lost, >= 0, since it kept `begun` and its overlap was `before`.
  template <class C>
  LSDCD_FN Real loss(const C &c, const Real *begun, Real before, const Real *own) const
  {
    if (own[0] > begun[0])
      return of_model(
          [&](auto m) { return m.yielded(numbers, c, own) - m.yielded(numbers, c, begun); });
    if (!(own[0] < begun[0])) return 0;
    return loss_of_branch(c, begun, before, c.overlap, energy(c, own));
  }
  // Returns the energy that a contact loses which ends with what it kept, and whose overlap was `before`.
  template <class C>
  LSDCD_FN Real loss_at_end(const C &c, const Real *begun, Real before) const
  {
    return before > 0 ? loss_of_branch(c, begun, before, 0, 0) : 0;
  }

 private:
  // Calls act() with the model that is chosen, and returns what it returns.
  template <class Act>
  LSDCD_FN Real of_model(const Act &act) const
  {
    Real result = 0;
    ((model == Models::kModel ? void(result = act(Models())) : void()), ...);
    return result;
  }
  // Returns what the way along the adhesive branch loses, from where it began to an overlap at which the contact holds `held`.
  template <class C>
  LSDCD_FN Real loss_of_branch(const C &c, const Real *begun, Real before, Real overlap,
                               Real held) const
  {
    return of_model([&](auto m) {
      C at = c;
      const Real turns = m.turns(numbers, c, begun);
      at.overlap = turns < before ? turns : before;
      if (!(at.overlap > overlap)) return Real(0);
      const Real work =
          m.pulled(numbers, c, begun, at.overlap) - m.pulled(numbers, c, begun, overlap);
      return work + m.held(numbers, at, begun) - held;
    });
  }
};

template <class... More>
using PlasticWith = Plastic<More..., HystereticNormal<NormalModel::hysteretic, false>,
                            HystereticNormal<NormalModel::hysteretic_size, true>,
                            HystereticNormal<NormalModel::hysteretic_edem, true>, EepaNormal,
                            LepaNormal, ThorntonNormal>;
using PlasticNormal = PlasticWith<>;
// Those of laws whose cohesion acts beyond touch, whether contacts yield or not.
using ReachingNormal =
    PlasticWith<TouchingModel<NormalModel::hooke>, TouchingModel<NormalModel::hertz>,
                TouchingModel<NormalModel::dmt>>;

}    // namespace lsdcd
