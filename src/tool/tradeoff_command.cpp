// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "tool/commands.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "base/number_words.h"
#include "study/tradeoff.h"
#include "tool/csv_file.h"
#include "tool/load_mesh.h"
#include "tool/number_options.h"
#include "tool/output_file.h"
#include "tool/python_script.h"
#include "wall/spec/spec_words.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <memory>

namespace lsdcd {

namespace {

struct TradeoffOptions {
  std::string file, device = "auto", csv = "tradeoff.csv", plot;
  PlacementOptions place;
  double weld = -1, memory = 1024, below = 0;
  TradeoffSettings settings;
};

const char *const kHelp =
    "Tries cells of half to four times the default length, lists of 1, 2, 3, 4 and 8 nearest "
    "triangles, and all; corner blend and sum; on each device. "
    "Spheres are placed at random beside the wall. Columns of the CSV:\n"
    "  missed          contacts missed / contacts; against `nearest all`\n"
    "  uncertified     spheres whose answer is not certified exact / spheres\n"
    "  force_median, force_largest   error of a sphere's force / that force, or that of an\n"
    "                  overlap of 1 % of the radius where that is larger\n"
    "  force_mean      sum of all errors / sum of all forces\n"
    "  bounce_drift    energy that a sphere bouncing without friction gains or loses in ten\n"
    "                  bounces / its energy; median of --moving spheres on random faces, each\n"
    "                  pulled along its face's normal. One that leaves the wall counts with what\n"
    "                  it had gained or lost until then; one that goes through it 1\n"
    "  roll_drift      the same for spheres that roll without slip over five radii\n"
    "  search_ns       of finding the contacts of a sphere in the list of its cell, with nothing\n"
    "                  kept between steps. Nanoseconds a sphere, the smallest of --repeats; the\n"
    "                  largest is search_most_ns\n"
    "  step_ns         of a step with what a setting keeps: with all a list for each sphere, "
    "which\n"
    "                  steps read; with nearest N which spheres are near, whose cells are "
    "searched.\n"
    "                  Spheres move by up to 0.2 radii before the next search, after 336\n"
    "                  steps, and the share of that is in it. The largest is step_most_ns\n"
    "  choice_ns       of one search for the spheres near the wall, with their lists\n"
    "  listed          entries in the list of a sphere in the mean; 0: no list is kept\n"
    "  bytes           of the grid\n"
    "  kept_bytes      of the engine; on the GPU its copy of the grid is in it\n"
    "  front           1 where no setting on the device is better in time of a step or mean force\n"
    "                  error and as good in the other\n"
    "  default         1 for what the fix does by itself\n"
    "On a core times are those of its thread, with caches filled by something else before each; "
    "on\n"
    "the GPU those of kernels alone, with the spheres in its memory.\n"
    "--below E takes nearest N only where all its answers are certified, and of settings within a\n"
    "tenth of the fastest the one with the smallest error.";

std::string formatted(const char *format, double value)
{
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

// "CPU, 1 thread, AMD EPYC", where the system has the name.
std::string device_name(const TradeoffRow &row)
{
  if (row.on_cuda) return row.device;
  std::ifstream info("/proc/cpuinfo");
  for (std::string line; std::getline(info, line);)
    if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
      return row.device + ", " + line.substr(line.find(": ") + 2);
  return row.device;
}

std::string csv_of(const Tradeoff &tradeoff, const WeldedMesh &mesh,
                   const TradeoffSettings &settings)
{
  Real least = settings.radii[0], most = least;
  for (Real r : settings.radii) {
    least = std::min(least, r);
    most = std::max(most, r);
  }
  std::string out =
      "mesh,triangles,least_radius,largest_radius,kind,device,grid,nearest,corner,missed,"
      "uncertified,force_median,force_largest,force_mean,bounce_drift,roll_drift,search_ns,"
      "search_most_ns,step_ns,step_most_ns,choice_ns,listed,bytes,kept_bytes,front,default,"
      "contacts,"
      "spheres,moving,repeats,order,seed,commit\n";
  const auto number = [](double value) { return formatted("%.5g", value); };
  const std::string name = std::filesystem::path(mesh.source).filename().string();
  for (const TradeoffRow &r : tradeoff.rows) {
    const std::vector<std::string> fields = {csv_quoted(name),
                                             std::to_string(mesh.faces.size()),
                                             number(least),
                                             number(most),
                                             r.on_cuda ? "cuda" : "cpu",
                                             csv_quoted(device_name(r)),
                                             number(r.choice.length),
                                             nearest_word(r.choice),
                                             word_of(r.corner, kCornerWords),
                                             number(r.error.missed_share()),
                                             number(double(r.error.uncertified) / r.checked),
                                             number(r.error.median),
                                             number(r.error.largest),
                                             number(r.error.mean),
                                             number(r.bounce_drift),
                                             number(r.roll_drift),
                                             number(r.search.least),
                                             number(r.search.most),
                                             number(r.times.step.least),
                                             number(r.times.step.most),
                                             number(r.times.choice.least),
                                             number(r.times.listed),
                                             std::to_string(r.bytes),
                                             std::to_string(r.times.kept_bytes),
                                             r.on_front ? "1" : "0",
                                             r.is_default ? "1" : "0",
                                             std::to_string(r.error.contacts),
                                             std::to_string(r.spheres),
                                             std::to_string(settings.moving),
                                             std::to_string(settings.repeats),
                                             "sorted",
                                             std::to_string(settings.seed),
                                             csv_quoted(LSDCD_COMMIT)};
    for (std::size_t i = 0; i < fields.size(); i++) out += (i ? "," : "") + fields[i];
    out += "\n";
  }
  return out;
}

void draw(const std::string &csv, const std::string &plot)
{
  const char *const name = "plot_tradeoff.py";
  if (run_script(name, {csv, plot})) return;
  throw InputError("the rows are in '" + csv +
                   "', but no plot was drawn: it needs python3 and "
                   "matplotlib (Debian: python3-matplotlib); then run " +
                   python_program() + " " + python_script(name) + " " + csv + " " + plot);
}

// Prints the words for an input script. Returns what is wrong; empty: nothing.
std::string print_words(const Tradeoff &result, double below, bool on_cuda)
{
  const TradeoffRow *row = fastest_below(result.rows, below, on_cuda);
  if (!row)
    return "no setting that was measured keeps errors below " + formatted("%g", below) +
           " on the " + (on_cuda ? "GPU" : "CPU") +
           ": give a larger --below, or more --memory or --seconds where settings were left out";
  std::printf("below %g on the %s: %s\n", below, on_cuda ? "GPU" : "CPU",
              words_of(row->choice).c_str());
  return "";
}

void tradeoff(TradeoffOptions &o)
{
  std::string why;
  const bool gpu = cuda_available(&why);
  o.settings.cpu = o.device != "cuda";
  o.settings.cuda = o.device == "cuda" || (o.device == "auto" && gpu);
  if (o.settings.cuda && !gpu) throw InputError("--device cuda: " + why + "; use cpu or auto");
  o.settings.memory_budget = static_cast<std::size_t>(o.memory * 1048576);
  if (o.plot.empty()) o.plot = std::filesystem::path(o.csv).replace_extension(".png").string();
  check_outputs({{"--csv", o.csv, ".csv"}, {"--plot", o.plot == "none" ? "" : o.plot, ".png"}},
                {o.file});
  const WeldedMesh mesh = load_wall(o.file, o.place, o.weld);
  AtomicFile file(o.csv);    // now, rather than fail when all is done
  std::printf("%s, %s\n", o.file.c_str(), counted(mesh.faces.size(), "triangle").c_str());
  std::printf("      grid  nearest  corner  device   missed %%  force error: mean  "
              "largest  bounce    roll  search, ns  step, ns        MB\n");
  const Tradeoff result = measure_tradeoff(mesh, o.settings, [](const TradeoffRow &r) {
    std::printf("%10.4g  %-7s  %-6s  %-6s  %8.3g  %17.2g  %7.2g  %6.1g  %6.1g  %10.3g  %8.3g  "
                "%8.3g%s\n",
                r.choice.length, nearest_word(r.choice).c_str(), word_of(r.corner, kCornerWords),
                r.on_cuda ? "cuda" : "cpu", 100 * r.error.missed_share(), r.error.mean,
                r.error.largest, r.bounce_drift, r.roll_drift, r.search.least, r.times.step.least,
                r.bytes / 1e6, r.is_default ? "  default" : "");
    std::fflush(stdout);
  });
  for (const std::string &what : result.left_out)
    std::fprintf(stderr, "left out: %s\n", what.c_str());
  const std::string text = csv_of(result, mesh, o.settings);
  file.write_at(0, text.data(), text.size());
  file.commit();
  std::printf("rows in %s\n", o.csv.c_str());
  // Rows and plot are written even if no device has a setting that is good enough.
  std::string none;
  for (const bool gpu_ones : {false, true})
    if (o.below > 0 && (gpu_ones ? o.settings.cuda : o.settings.cpu)) {
      const std::string error = print_words(result, o.below, gpu_ones);
      none += (none.empty() || error.empty() ? "" : "; ") + error;
    }
  std::fflush(stdout);
  if (o.plot != "none") {
    draw(o.csv, o.plot);
    std::printf("plot in %s\n", o.plot.c_str());
  }
  if (none.empty() && result.rows.empty()) none = "no setting was measured: give more --memory";
  if (!none.empty()) throw InputError(none);
}

}    // namespace

void add_tradeoff_command(Command &program)
{
  const auto o = std::make_shared<TradeoffOptions>();
  Command command = program.command(
      "tradeoff", "measures error, time and memory of each setting on a mesh: a CSV and a plot");
  command.footer(std::string(kHelp) +
                 "\nExample:\n  lsdcd tradeoff wall.stl --radius 0.004 0.005 --below 1e-3");
  command.option("file", o->file, "mesh: .stl, .obj, .ply or .off").required();
  command.option("--radius", o->settings.radii, "sphere radii, one or several, all equally likely")
      .required()
      .words(1, -1)
      .check(above_zero);
  command
      .option("--below", o->below,
              "print the keywords for an input script: the fastest setting with missed contacts / "
              "contacts "
              "and all errors of forces below this")
      .check(above_zero);
  add_placement_options(command, o->place, "mesh");
  add_weld_option(command, o->weld);
  command
      .option("--memory", o->memory,
              "memory budget of a grid in MB, also while it is built; the default grid becomes as "
              "coarse as this needs, all other settings above it are left out")
      .shows_default()
      .check(above_zero);
  command
      .option("--device", o->device,
              "auto: the CPU, and the GPU where there is one; cpu; cuda: the GPU alone")
      .shows_default()
      .one_of({"auto", "cpu", "cuda"});
  command
      .option(
          "--seconds", o->settings.seconds,
          "stop building and trying settings after so many seconds; the default is tried first, "
          "however long it takes")
      .shows_default()
      .check(above_zero);
  command
      .option("--spheres", o->settings.spheres,
              "spheres beside the wall, for errors and times (50 times as many for times on a GPU)")
      .shows_default()
      .range(1, 10000000);
  command.option("--moving", o->settings.moving, "spheres that bounce, and that roll")
      .shows_default()
      .range(1, 100000);
  command.option("--repeats", o->settings.repeats, "runs that are timed, after one to warm up")
      .shows_default()
      .range(1, 1000);
  command.option("--seed", o->settings.seed, "seed of positions and radii").shows_default();
  command.option("--csv", o->csv, "file for the rows, written whole or not at all").shows_default();
  command.option("--plot", o->plot,
                 "picture, .png, or `none` (default: the name of the CSV with .png)");
  command.runs([o] { tradeoff(*o); });
}

}    // namespace lsdcd
