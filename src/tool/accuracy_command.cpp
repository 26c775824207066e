// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "tool/accuracy_tables.h"
#include "tool/number_options.h"
#include "tool/output_file.h"

#include <algorithm>
#include <cstdio>
#include <optional>

namespace lsdcd {

namespace {

Device device_of(const std::string &name)
{
  if (name == "cpu") return Device::cpu;
  if (name == "cuda") return Device::cuda;
  return Device::automatic;
}

constexpr int kMaxRows = 1000000;    // more than any memory has triangles for

// Spheres are counted in 32 bits.
std::string sphere_count(const std::string &word)
{
  double n;
  return is_number(word, &n) && n >= 1 && n < 4294967296.
             ? ""
             : word + " is not a number from 1 to 4294967295";
}

void run_accuracy(AccuracyOptions &o)
{
  if (o.rim_caps) o.shape.caps = Caps::rim;
  check_outputs({{"--csv", o.csv, ".csv"}});
  std::vector<std::string> tables = o.tables;
  if (std::find(tables.begin(), tables.end(), "all") != tables.end()) tables = kAccuracyTables;
  std::optional<AtomicFile> file;
  if (!o.csv.empty()) file.emplace(o.csv);    // now, rather than fail when all is done
  AccuracyRows rows;
  for (const std::string &device : o.devices)
    for (const std::string &order : o.orders)
      make_accuracy_tables(o, tables, device_of(device),
                           order == "sorted" ? Order::sorted : Order::random, rows);
  if (file) {
    const std::string text = rows.csv();
    file->write_at(0, text.data(), text.size());
    file->commit();
    std::printf("\n%s\n", o.csv.c_str());
  }
}

const char *kAbout =
    "The paper's study (Yong et al. 2017) with its numbers beside ours. A cylinder of radius 50\n"
    "and height 100 in triangles; spheres uniform in a cube round it, radii uniform in (0, 1].\n"
    "Accuracy is the share of spheres whose status, touching or not, is what the formula of the\n"
    "true cylinder says (its function (3) and formula (6)); error is the loss against the exact\n"
    "wall in per cent (7). missed and false count against the triangles themselves. Times are of\n"
    "queries of status, which search cells with N triangles and with all of them; a step of the\n"
    "fix with all reads lists that were made before, and is timed by lsdcd tradeoff.\n\n"
    "tables:\n"
    "  table2        N = 1, 2, 3 and all triangles, L = 0.2 .. 0.5\n"
    "  figure9       1e3 .. 6e7 spheres (as far as --most-spheres)\n"
    "  figure10      cell lengths 0.179 .. 1; with --device cpu cuda also figures 11 and 12\n"
    "  tessellation  which cylinder and cube the paper may have had\n"
    "  one-triangle  guesses at the paper's row N = 1\n"
    "  formula5      what its inside test costs, on meshes with and without obtuse triangles\n"
    "  mesh          finer cylinders, up to --most-triangles, against their own triangles\n"
    "  all           every one of them";

}    // namespace

void add_accuracy_command(Command &program)
{
  static AccuracyOptions o;
  Command c =
      program.command("accuracy", "repeats the study of the 2017 paper and prints both results");
  std::vector<std::string> names = kAccuracyTables;
  names.push_back("all");
  c.option("table", o.tables, "tables to make (default: table2)").one_of(names);
  c.option("--spheres", o.spheres, "how many (1e7 in the paper)")
      .check(sphere_count)
      .shows_default();
  c.option("--most-spheres", o.most_spheres, "where figure9 ends (default: --spheres)")
      .check(sphere_count);
  c.option("--most-triangles", o.most_triangles, "where mesh ends (1e6 takes a GPU)")
      .check(above_zero)
      .shows_default();
  c.option("--segments", o.shape.segments, "flat sides of the cylinder")
      .range(3, kMaxRows)
      .shows_default();
  c.option("--along", o.shape.along, "rows of triangles along its axis")
      .range(1, kMaxRows)
      .shows_default();
  c.option("--slant", o.shape.slant, "more rows that diagonals climb: obtuse triangles")
      .range(0, kMaxRows)
      .shows_default();
  c.flag("--rim-caps", o.rim_caps, "cut the ends from a corner of the rim: obtuse too");
  c.option("--cube", o.cube, "side of the cube that spheres are in")
      .check(above_zero)
      .shows_default();
  c.option("--radius", o.largest, "largest radius").check(above_zero).shows_default();
  c.option("--inside", o.inside, "exact, or paper: its formula (5)")
      .one_of({"exact", "paper"})
      .shows_default();
  c.option("--order", o.orders, "random, sorted (along a Z-curve) or both")
      .one_of({"random", "sorted"})
      .words(1, 2)
      .shows_default();
  c.option("--device", o.devices, "auto, cpu, cuda; several one after another")
      .one_of({"auto", "cpu", "cuda"})
      .words(1, 2)
      .shows_default();
  c.option("--repeats", o.repeats, "timed runs after one to warm up")
      .range(1, 10000)
      .shows_default();
  c.option("--seed", o.seed, "seed of the spheres").shows_default();
  c.option("--memory", o.memory, "memory budget of a grid in MB").check(above_zero).shows_default();
  c.option("--csv", o.csv, "write all rows to this file");
  c.option("--commit", o.commit, "what was built, for the CSV").shows_default();
  c.footer(std::string(kAbout) +
           "\nCPU runs use OMP_NUM_THREADS threads, or one if it is not set.\n"
           "Example:\n  lsdcd accuracy table2 --spheres 1e5 --csv table2.csv");
  c.runs([] { run_accuracy(o); });
}

}    // namespace lsdcd
