// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The settings of a wall that are one number, flag or word, a row each: keywords and the comparison of saved states are made of
// these. What takes more, as lists, vectors, motions and values that may be variables, is read by hand.
#pragma once

#include "wall/spec/spec_words.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>

namespace lsdcd {

// Kinds of settings: how words say a value.
struct WordSetting {    // one of these words
  const char *const *words;
  std::size_t n;
};
struct FlagSetting {};       // a keyword without values
struct LengthSetting {};     // "auto": chosen
struct NearestSetting {};    // "all", or 1 to kMaxNearest
struct MemorySetting {};     // in MiB
struct StepsSetting {};      // a whole number
struct SpeedSetting {};      // a number above 0, as a speed
struct ShareSetting {};      // a number from 0 to 1
struct FactorSetting {};     // a number of 0 or more

template <std::size_t n>
constexpr WordSetting word_setting(const char *const (&words)[n])
{
  return {words, n};
}

// When a saved state is of another wall where the setting differs: always, never as no number hangs on it, where the
// search is not exact, as with `nearest`, or where meshes wear.
enum class OfState { compared, free, with_nearest, with_wear };

constexpr const char *kLogWords[] = {"full", "brief"};

// SETTING(member of WallSpec, kind, rule of saved states, and as in Keyword: name, values, unit, range, fallback, help)
#define LSDCD_WALL_SETTINGS(SETTING)                                                               \
  SETTING(coarse_grain, SpeedSetting{}, free, "coarse_grain", "L", "", "> 0", "1",                 \
          "the grains are L times as large as those that the numbers of the law are of")           \
  SETTING(grid_length, LengthSetting{}, with_nearest, "grid", "L | auto", "length", "> 0", "auto", \
          "cell edge of the grid")                                                                 \
  SETTING(rmax, LengthSetting{}, with_nearest, "rmax", "R | auto", "length", "> 0",                \
          "auto: the largest radius in the group", "largest radius that the grid is made for")     \
  SETTING(memory_budget, MemorySetting{}, with_nearest, "memory", "M", "MiB", ">= 1",              \
          "1024 beside the mesh's own records", "budget for the grid of each mesh")                \
  SETTING(nearest, NearestSetting{}, compared, "nearest", "all | N", "", "1 to 32", "all",         \
          "a cell lists everything that a sphere can touch, or the N triangles nearest to its "    \
          "centre")                                                                                \
  SETTING(corner, word_setting(kCornerWords), compared, "corner", "blend | sum", "", "", "blend",  \
          "contacts at one place share their overlap, or their forces simply add")                 \
  SETTING(side, word_setting(kSideWords), compared, "side", "both | in | out", "", "", "both",     \
          "where spheres belong; in and out need a closed, oriented mesh")                         \
  SETTING(each_contact, FlagSetting{}, free, "each_contact", "", "", "", "off",                    \
          "local array with a row for each contact: sphere, mesh, force, point, overlap")          \
  SETTING(average_every, StepsSetting{}, compared, "average", "N", "steps", "N >= 1", "off",       \
          "means of force and torque over N steps, as more numbers of the vector")                 \
  SETTING(energy, FlagSetting{}, compared, "energy", "", "", "", "off",                            \
          "what contacts dissipate, by cause, and an energy balance that closes, as more numbers " \
          "of the vector")                                                                         \
  SETTING(friction_heat, ShareSetting{}, compared, "friction_heat", "F", "", "0 to 1", "0",        \
          "the share of the heat of friction that goes into the grains; with energy "              \
          "and the sub-model heat")                                                                \
  SETTING(impact_speed, SpeedSetting{}, compared, "impacts", "V", "velocity", "> 0", "off",        \
          "number and energy of impacts faster than V, as more numbers of the vector, in "         \
          "mesh_fields and in impact_spectrum")                                                    \
  SETTING(periodic, FlagSetting{}, free, "periodic", "", "", "", "off",                            \
          "no warning if the mesh reaches past periodic faces, or does not continue there; it "    \
          "acts through them in any case")                                                         \
  SETTING(brief, word_setting(kLogWords), free, "log", "full | brief", "", "", "full",             \
          "brief: one line instead of the full report")

// The settings of a mesh, with the member of MeshSpec first.
#define LSDCD_MESH_SETTINGS(SETTING)                                                               \
  SETTING(wear_factor, FactorSetting{}, with_wear, "wear_factor", "F", "", ">= 0", "1",            \
          "this mesh wears F times as fast as wear says; 0: it does not")

}    // namespace lsdcd
