// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "input/insert_settings.h"

#include "base/input_words.h"
#include "input/keywords.h"

#include <algorithm>
#include <cmath>

namespace lsdcd {

namespace {

// Grains that come all at once find the last places of a dense pack by chance alone; a rate brings few in a step.
constexpr int kAttemptsAtOnce = 1000;

const char *const kInsertSyntax =
    "fix ID group insert/lsdcd mesh FILE [scale s | sx sy sz] [rotate ax ay az degrees] [move "
    "x y z] [matrix m11 m12 m13 tx m21 m22 m23 ty m31 m32 m33 tz] [weld tol] [depth D] | "
    "region ID, with diam one D | range LO HI | poly N D1 F1 ... | mass N D1 F1 ..., or shape SX "
    "SY "
    "SZ [block N1 N2] [spread LO HI] [fraction F | massfraction F] [shape ...] [orient random | AX "
    "AY "
    "AZ DEGREES], dens RHO | LO HI, or mol ID rigid ID [fraction F ... | massfraction F ...] "
    "[orient "
    "...], [massrate R | numberrate R] [mass M | number N] [type T] [vel "
    "X Y Z | normal V] "
    "[jitter [gaussian] V | X Y Z] [temperature T] [wall all | none | ID] [attempts N] [every "
    "N] [seed N]";

constexpr Real kMostInt = 2147483647, kMostExact = 9007199254740992;

void read_sizes(Tokens &w, GrainRecipe &grains)
{
  w.set_context("diam",
                "diam one D | range LO HI | poly N D1 F1 D2 F2 ... | mass N D1 F1 D2 F2 ...");
  const int kind = w.choice({"one", "range", "poly", "mass"});
  if (kind == 0) {
    grains.smallest = grains.largest = w.number("D", kAboveZero);
    grains.sizes = {{grains.largest, 1}};
    return;
  }
  if (kind == 1) {
    grains.smallest = w.number("LO", kAboveZero);
    grains.largest = w.number("HI", grains.smallest);
    return;
  }
  const std::int64_t n = w.whole("N", 1, 1e6);
  Real sum = 0;
  std::vector<GrainRecipe::Size> sizes;
  for (std::int64_t i = 0; i < n; i++) {
    const Real d = w.number("D", kAboveZero), share = w.number("F", kAboveZero, 1);
    sizes.push_back({d, share});
    sum += share;
    grains.largest = std::max(grains.largest, d);
    grains.smallest = i == 0 ? d : std::min(grains.smallest, d);
  }
  if (std::fabs(sum - 1) > 1e-3)
    w.fail("the fractions add up to " + number_text(sum) + ", not to 1");
  for (GrainRecipe::Size &size : sizes) size.share /= sum;
  if (kind == 2)
    grains.sizes = sizes;
  else
    grains.set_mass_shares(sizes);
}

void read_molecules(Tokens &w, InsertSettings &s)
{
  w.set_context("mol", "mol ID [fraction F1 F2 ... | massfraction F1 F2 ...]");
  if (w.done()) w.fail("the ID of a molecule template is missing");
  s.molecules = w.take();
  if (w.done()) return;
  s.shares_are_by_mass = w.peek() == "massfraction";
  if (w.peek() != "fraction" && !s.shares_are_by_mass) return;
  w.take();
  do {
    s.shares.push_back(w.number("F", kAboveZero, 1));
  } while (w.number_follows());
  Real sum = 0;
  for (const Real share : s.shares) sum += share;
  if (std::fabs(sum - 1) > 1e-3)
    w.fail("the fractions add up to " + number_text(sum) + ", not to 1");
}

// Kinds of grains as they are read; `sum` is of their shares.
struct ReadKinds {
  std::vector<GrainKind> kinds;
  int by_number = 0, by_mass = 0;    // how many have a share of that

  void set(Tokens &w, GrainRecipe &grains) const;
};

void read_shape(Tokens &w, ReadKinds &read)
{
  w.set_context("shape",
                "shape SX SY SZ [block N1 N2] [spread LO HI] [fraction F | massfraction F]");
  Vec3 half;
  for (int k = 0; k < 3; k++) half[k] = w.number("the length along an axis", kAboveZero) / 2;
  GrainKind kind;
  Real n1 = 2, n2 = 2;
  std::vector<std::string> seen;
  while (!w.done()) {
    const std::string &word = w.peek();
    const bool is_mass = word == "massfraction";
    if (word != "block" && word != "spread" && word != "fraction" && !is_mass) break;
    if (is_twice(word, seen)) w.fail("'" + word + "' is given twice");
    const std::string option = w.take();
    if (option == "block") {
      n1 = w.number("N1");
      n2 = w.number("N2");
    } else if (option == "spread") {
      kind.least = w.number("LO", kAboveZero);
      kind.most = w.number("HI", kind.least);
    } else {
      kind.share = w.number("F", kAboveZero, 1);
      (is_mass ? read.by_mass : read.by_number)++;
    }
  }
  try {
    kind.shape = make_superellipsoid(half, n1, n2);
  } catch (const InputError &e) {
    w.fail(e.what());
  }
  read.kinds.push_back(kind);
}

void ReadKinds::set(Tokens &w, GrainRecipe &grains) const
{
  w.set_context("shape",
                "shape SX SY SZ [block N1 N2] [spread LO HI] [fraction F | massfraction F]");
  const int n = static_cast<int>(kinds.size());
  if (by_number > 0 && by_mass > 0)
    w.fail(
        "'fraction' is of the number of grains and 'massfraction' of their mass: give one of the "
        "two to all shapes");
  if (n > 1 && by_number + by_mass < n)
    w.fail("there are " + std::to_string(n) + " shapes, and " +
           std::to_string(n - by_number - by_mass) +
           " of them without 'fraction F' or 'massfraction F'");
  Real sum = 0;
  for (const GrainKind &kind : kinds) sum += kind.share;
  if (std::fabs(sum - 1) > 1e-3)
    w.fail("the fractions add up to " + number_text(sum) + ", not to 1");
  grains.set_kinds(kinds, by_mass > 0);
}

void read_orientation(Tokens &w, GrainRecipe &grains)
{
  w.set_context("orient", "orient random | AX AY AZ DEGREES");
  grains.is_turned_at_random = !w.done() && w.peek() == "random";
  if (grains.is_turned_at_random) {
    w.take();
    return;
  }
  Vec3 axis;
  for (int k = 0; k < 3; k++) axis[k] = w.number("a component of the axis");
  if (!(norm(axis) > 0))
    w.fail("the axis is 0 0 0: give the direction about which grains are turned");
  grains.turn = rotation_about((1 / norm(axis)) * axis, w.number("DEGREES") * kPi / 180);
}

void read_velocity(Tokens &w, InsertSettings &s)
{
  w.set_context("vel", "vel X Y Z | vel normal V");
  s.along_normal = !w.done() && w.peek() == "normal";
  if (s.along_normal) {
    w.take();
    s.speed = w.number("V", 0);
    return;
  }
  s.velocity.x = w.number("X");
  s.velocity.y = w.number("Y");
  s.velocity.z = w.number("Z");
}

void read_jitter(Tokens &w, GrainRecipe &grains)
{
  w.set_context("jitter", "jitter [gaussian] V | X Y Z");
  grains.gaussian = !w.done() && w.peek() == "gaussian";
  if (grains.gaussian) w.take();
  const Real x = w.number("V", 0);
  grains.jitter = {x, x, x};
  if (!w.number_follows()) return;
  grains.jitter.y = w.number("Y", 0);
  grains.jitter.z = w.number("Z", 0);
}

void read_wall(Tokens &w, InsertSettings &s)
{
  w.set_context("wall", "wall all | none | ID");
  if (w.done()) w.fail("the ID of a fix wall/lsdcd is missing");
  const std::string word = w.take();
  s.all_walls = word == "all";
  if (word != "all" && word != "none") s.walls.push_back(word);
}

void read_rate(Tokens &w, const std::string &word, FeedSettings &feed)
{
  w.set_context(word, word + " R");
  if (feed.kind != FeedSettings::at_once)
    w.fail("massrate and numberrate are both given: leave one out");
  feed.kind = word == "massrate" ? FeedSettings::by_mass : FeedSettings::by_number;
  feed.rate = w.number("R", kAboveZero);
}

bool read_word(const std::string &word, Tokens &w, InsertSettings &s)
{
  if (word == "region") {
    w.set_context("region", "region ID");
    if (w.done()) w.fail("the ID of a region is missing");
    s.region = w.take();
  } else if (word == "diam") {
    read_sizes(w, s.plan.grains);
  } else if (word == "mol") {
    read_molecules(w, s);
  } else if (word == "rigid") {
    w.set_context("rigid", "rigid ID");
    if (w.done()) w.fail("the ID of a rigid fix is missing");
    s.rigid = w.take();
  } else if (word == "orient") {
    read_orientation(w, s.plan.grains);
  } else if (word == "dens") {
    w.set_context("dens", "dens RHO | LO HI");
    GrainRecipe &grains = s.plan.grains;
    grains.density_lo = grains.density_hi = w.number("RHO", kAboveZero);
    if (w.number_follows()) grains.density_hi = w.number("HI", grains.density_lo);
  } else if (word == "massrate" || word == "numberrate") {
    read_rate(w, word, s.plan.feed);
  } else if (word == "mass") {
    w.set_context("mass", "mass M");
    s.plan.feed.mass = w.number("M", kAboveZero);
  } else if (word == "number") {
    w.set_context("number", "number N");
    s.plan.feed.number = w.whole("N", 1, kMostExact);
  } else if (word == "type") {
    w.set_context("type", "type T");
    s.type = static_cast<int>(w.whole("T", 1, kMostInt));
  } else if (word == "vel") {
    read_velocity(w, s);
  } else if (word == "jitter") {
    read_jitter(w, s.plan.grains);
  } else if (word == "temperature") {
    w.set_context("temperature", "temperature T");
    s.has_temperature = true;
    s.temperature = w.number("T");
  } else if (word == "depth") {
    w.set_context("depth", "depth D");
    s.depth = w.number("D", 0);
  } else if (word == "wall") {
    read_wall(w, s);
  } else if (word == "attempts") {
    w.set_context("attempts", "attempts N");
    s.plan.attempts = static_cast<int>(w.whole("N", 1, kMostInt));
  } else if (word == "every") {
    w.set_context("every", "every N");
    s.plan.feed.every = static_cast<int>(w.whole("N", 1, kMostInt));
  } else if (word == "seed") {
    w.set_context("seed", "seed N");
    s.plan.seed = w.whole("N", 1, kMostExact);
  } else {
    return false;
  }
  return true;
}

// Throws InputError where masses leave the range of numbers.
void check_masses(const Tokens &w, const GrainRecipe &grains)
{
  Real least = Grain{0, grains.smallest / 2, grains.density_lo}.mass();
  Real most = Grain{0, grains.largest / 2, grains.density_hi}.mass();
  for (const GrainKind &kind : grains.kinds) {
    const auto mass = [&](Real factor, Real density) {
      return volume(kind.shape) * factor * factor * factor * density;
    };
    least = std::min(least, mass(kind.least, grains.density_lo));
    most = std::max(most, mass(kind.most, grains.density_hi));
  }
  if (!(least > 0) || !std::isfinite(most))
    w.fail(std::string(grains.kinds.empty() ? "diam" : "shape") +
           " and dens give the grains masses from " + number_text(least) + " to " +
           number_text(most) + ": write both in the units of the script");
}

void check(Tokens &w, const InsertSettings &s)
{
  w.set_context("fix insert/lsdcd", kInsertSyntax);
  const FeedSettings &feed = s.plan.feed;
  if (s.face.file.empty() == s.region.empty())
    w.fail(s.region.empty() ? "mesh FILE or region ID is missing"
                            : "give mesh FILE or region ID, not both");
  if (s.has_clumps()) {
    if (s.rigid.empty())
      w.fail("rigid is missing: give the ID of the fix rigid/small that moves the clumps");
  } else {
    if (s.plan.grains.largest <= 0) w.fail("diam, shape or mol is missing");
    if (s.plan.grains.density_hi <= 0) w.fail("dens is missing");
    check_masses(w, s.plan.grains);
  }
  if (feed.kind == FeedSettings::at_once && feed.mass <= 0 && feed.number == 0)
    w.fail("the amount is missing: give massrate, numberrate, mass or number");
  if (feed.mass > 0 && feed.number > 0)
    w.fail("mass and number are both given, and each of them sets the amount: leave one out");
  if (s.face.file.empty() && s.along_normal)
    w.fail("vel normal needs a mesh: write vel X Y Z if you give a region");
  if (s.face.file.empty() && s.depth > 0)
    w.fail("depth needs a mesh: leave it out if you give a region");
}

}    // namespace

InsertSettings parse_insert(const std::vector<std::string> &tokens)
{
  InsertSettings settings;
  Tokens w(tokens);
  std::vector<std::string> seen;
  ReadKinds kinds;
  while (!w.done()) {
    const std::string word = w.take();
    w.set_context("fix insert/lsdcd", kInsertSyntax);
    const bool may_repeat = word == "wall" || word == "shape";
    if (is_twice(word, seen) && !may_repeat) w.fail("the keyword '" + word + "' is given twice");
    if (word == "shape")
      read_shape(w, kinds);
    else if (!read_mesh_word(word, w, settings.face) && !read_word(word, w, settings))
      w.fail("'" + word + "' is not a keyword");
  }
  const auto tells = [&seen](const char *word) {
    return std::find(seen.begin(), seen.end(), word) != seen.end();
  };
  w.set_context("fix insert/lsdcd", kInsertSyntax);
  if (tells("mol"))
    for (const char *other : {"diam", "shape", "dens", "type"})
      if (tells(other))
        w.fail("mol has sizes, masses and types of its own: leave " + std::string(other) + " out");
  if (tells("rigid") && !tells("mol"))
    w.fail("rigid is of clumps: give mol ID, or leave rigid out");
  if (tells("diam") && tells("shape")) {
    w.fail("diam is of spheres and shape of other grains: leave one out; a ball among them is a "
           "shape with three equal lengths");
  }
  if (tells("orient") && !tells("shape") && !tells("mol")) {
    w.fail("orient turns grains with a shape and clumps: leave it out");
  }
  if (tells("shape")) kinds.set(w, settings.plan.grains);
  check(w, settings);
  const bool tells_attempts = tells("attempts");
  if (settings.plan.feed.kind == FeedSettings::at_once && !tells_attempts)
    settings.plan.attempts = kAttemptsAtOnce;
  return settings;
}

}    // namespace lsdcd
