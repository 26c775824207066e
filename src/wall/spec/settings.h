// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// The settings of a wall that are one number, flag or word, a row each: keywords of scripts, fields of lsdcd_wall_spec and the
// comparison of saved states are made of these. What takes more, as lists, vectors, motions and values that may be variables, is
// read by hand.
#pragma once

#include "wall/spec/spec_ranges.h"
#include "wall/spec/spec_words.h"
#include "wall/spec/wall_spec.h"

#include <cstddef>

namespace lsdcd {

// Kinds of settings: how a script and a struct say a value, in which 0 is the default.
struct WordSetting {    // one of these words; in a struct its number
  const char *const *words;
  std::size_t n;
  const char *names;    // of the numbers in lsdcd.h
};
struct FlagSetting {};       // a keyword without values; 1 or 0
struct LengthSetting {};     // "auto" and 0: chosen
struct NearestSetting {};    // "all" and 0; or 1 to kMaxNearest
struct MemorySetting {};     // in MiB; in bytes, 0: as it is without
struct StepsSetting {        // a whole number; 0 is `none`
  const char *none;
};
struct SpeedSetting {};     // a number above 0; 0 in a struct: off
struct ShareSetting {};     // a number from 0 to 1
struct FactorSetting {};    // a number; 0 is once and -1 never

template <std::size_t n>
constexpr WordSetting word_setting(const char *const (&words)[n], const char *names)
{
  return {words, n, names};
}

// When a saved state is of another wall where the setting differs: always, never as no number hangs on it, where the
// search is not exact, as with `nearest`, or where meshes wear.
enum class OfState { compared, free, with_nearest, with_wear };

constexpr const char *kLogWords[] = {"full", "brief"};

// SETTING(field of lsdcd_wall_spec, member of WallSpec, kind, rule of saved states, and as in Keyword: name, values, unit, range,
// fallback, help). WITHOUT_KEYWORD has the first four.
#define LSDCD_WALL_SETTINGS(SETTING, WITHOUT_KEYWORD)                                              \
  SETTING(cell, grid_length, LengthSetting{}, with_nearest, "grid", "L | auto", "length", "> 0",   \
          "auto", "cell edge of the grid")                                                         \
  SETTING(rmax, rmax, LengthSetting{}, with_nearest, "rmax", "R | auto", "length", "> 0",          \
          "auto: the largest radius in the group", "largest radius that the grid is made for")     \
  SETTING(memory, memory_budget, MemorySetting{}, with_nearest, "memory", "M", "MiB", ">= 1",      \
          "1024 beside the mesh's own records", "budget for the grid of each mesh")                \
  SETTING(nearest, nearest, NearestSetting{}, compared, "nearest", "all | N", "", "1 to 32",       \
          "all",                                                                                   \
          "a cell lists everything that a sphere can touch, or the N triangles nearest to its "    \
          "centre")                                                                                \
  SETTING(corner, corner, word_setting(kCornerWords, "LSDCD_BLEND or LSDCD_SUM"), compared,        \
          "corner", "blend | sum", "", "", "blend",                                                \
          "contacts at one place share their overlap, or their forces simply add")                 \
  SETTING(side, side, word_setting(kSideWords, "LSDCD_BOTH_SIDES, LSDCD_INSIDE or LSDCD_OUTSIDE"), \
          compared, "side", "both | in | out", "", "", "both",                                     \
          "where spheres belong; in and out need a closed, oriented mesh")                         \
  SETTING(each_contact, each_contact, FlagSetting{}, free, "each_contact", "", "", "", "off",      \
          "local array with a row for each contact: sphere, mesh, force, point, overlap")          \
  SETTING(average_every, average_every, StepsSetting{"there are no means"}, compared, "average",   \
          "N", "steps", "N >= 1", "off",                                                           \
          "means of force and torque over N steps, as more numbers of the vector")                 \
  SETTING(energy, energy, FlagSetting{}, compared, "energy", "", "", "", "off",                    \
          "what contacts dissipate, by cause, and an energy balance that closes, as more numbers " \
          "of the vector")                                                                         \
  SETTING(friction_heat, friction_heat, ShareSetting{}, compared, "friction_heat", "F", "",        \
          "0 to 1", "0",                                                                           \
          "the share of the heat of friction that goes into the grains; with energy "              \
          "and the sub-model heat")                                                                \
  SETTING(impact_speed, impact_speed, SpeedSetting{}, compared, "impacts", "V", "velocity", "> 0", \
          "off",                                                                                   \
          "number and energy of impacts faster than V, as more numbers of the vector, in "         \
          "mesh_fields and in impact_spectrum")                                                    \
  SETTING(periodic_ends, periodic, FlagSetting{}, free, "periodic", "", "", "", "off",             \
          "no warning if the mesh reaches past periodic faces, or does not continue there; it "    \
          "acts through them in any case")                                                         \
  SETTING(brief, brief, word_setting(kLogWords, "0 or 1"), free, "log", "full | brief", "", "",    \
          "full", "brief: one line instead of the full report")                                    \
  WITHOUT_KEYWORD(shapes, shapes, FlagSetting{}, compared)

// The settings of a mesh, with the field of lsdcd_wall_mesh and the member of MeshSpec first.
#define LSDCD_MESH_SETTINGS(SETTING, WITHOUT_KEYWORD)                                              \
  SETTING(wear_factor, wear_factor, FactorSetting{}, with_wear, "wear_factor", "F", "", ">= 0",    \
          "1", "this mesh wears F times as fast as wear says; 0: it does not")                     \
  WITHOUT_KEYWORD(nodes_by_caller, has_nodes, FlagSetting{}, free)

}    // namespace lsdcd
