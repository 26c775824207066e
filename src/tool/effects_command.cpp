#include "tool/commands.h"

#include "base/input_error.h"
#include "base/whole_file.h"
#include "effects/effects.h"
#include "tool/output_file.h"

#include <cstdio>
#include <map>
#include <memory>
#include <sstream>

namespace lsdcd {

namespace {

struct Options {
  bool measure = false;
  std::string device = "auto", csv, commit = LSDCD_COMMIT;
  int spheres = 5000, repeats = 201;
};

const char *compiler()
{
#if defined(__clang__)
  return "clang " __clang_version__;
#else
  return "g++ " __VERSION__;
#endif
}

void print_head(const std::string &where)
{
  std::printf("%-22s %-42s %9s %12s  ns per contact (over)\n%s\n", "effect", "turned on by",
              "B/atom", "B/contact", where.c_str());
}

void print_row(const EffectCase &c, const std::string &cost)
{
  std::printf("%-22s %-42s %9d %12d  %s\n", c.name.c_str(), c.words.c_str(),
              bytes_per_atom(c.settings), bytes_per_contact(c.settings), cost.c_str());
}

std::string cost_text(double ns, double over, const std::string &name)
{
  char text[96];
  if (name.empty())
    std::snprintf(text, sizeof text, "%.1f", ns);
  else
    std::snprintf(text, sizeof text, "%.1f (%+.1f over %s)", ns, over, name.c_str());
  return text;
}

// Fields are separated by semicolons: words and devices have commas in them.
std::string csv_of(const std::vector<EffectCase> &cases, const std::vector<EffectCost> &costs,
                   const std::string &commit)
{
  std::ostringstream out;
  out << "name;words;over;contacts;repeats;median_ns;min_ns;max_ns;over_ns;bytes_per_atom;"
         "bytes_per_contact;engine_bytes;device;compiler;commit\n";
  for (std::size_t i = 0; i < cases.size(); i++) {
    const EffectCase &c = cases[i];
    const EffectCost &cost = costs[i];
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "%.2f;%.2f;%.2f;%.2f", cost.median_ns, cost.min_ns,
                  cost.max_ns, cost_over(cases, costs, i));
    out << c.name << ';' << c.words << ';' << c.over << ';' << cost.contacts << ';' << cost.repeats
        << ';' << numbers << ';' << bytes_per_atom(c.settings) << ';'
        << bytes_per_contact(c.settings) << ';' << cost.engine_bytes << ';' << cost.device << ';'
        << compiler() << ';' << commit << '\n';
  }
  return out.str();
}

void measure(const Options &o)
{
  const std::map<std::string, Device> devices = {
      {"auto", Device::automatic}, {"cpu", Device::cpu}, {"cuda", Device::cuda}};
  const std::vector<EffectCase> cases = effect_cases();
  const std::vector<EffectCost> costs =
      measure_effects(cases, devices.at(o.device), o.spheres, o.repeats);
  print_head("measured now on " + costs[0].device + ", " + std::to_string(o.spheres) +
             " spheres with a contact each, least of " + std::to_string(o.repeats));
  for (std::size_t i = 0; i < cases.size(); i++)
    print_row(cases[i], cost_text(costs[i].min_ns, cost_over(cases, costs, i), cases[i].over));
  if (o.csv.empty()) return;
  write_whole_file(o.csv, csv_of(cases, costs, o.commit));
}

// Costs kept in doc/data when this program was built.
void list()
{
  print_head(kept_costs_where().empty()
                 ? "no costs were kept when this was built: lsdcd effects --measure"
                 : "measured on " + kept_costs_where() +
                       "; on this machine: lsdcd effects --measure");
  for (const EffectCase &c : effect_cases()) {
    const auto at = kept_costs().find(c.name);
    print_row(c, at == kept_costs().end() ? "-"
                                          : cost_text(at->second.ns, at->second.over_ns, c.over));
  }
}

}    // namespace

void add_effects_command(Command &program)
{
  const auto o = std::make_shared<Options>();
  Command command = program.command(
      "effects", "every effect of a wall: its words, bytes per atom and contact, and cost");
  command.footer("Example:\n  lsdcd effects --measure --device cpu --csv effects.csv");
  command.flag("--measure", o->measure, "measure costs here, now");
  command.option("--device", o->device, "where to measure")
      .one_of({"auto", "cpu", "cuda"})
      .shows_default();
  command.option("--spheres", o->spheres, "contacts to measure with")
      .range(100, 100000000)
      .shows_default();
  command.option("--repeats", o->repeats, "of which the least is taken")
      .range(1, 10000)
      .shows_default();
  command.option("--csv", o->csv, "file for what was measured");
  command.option("--commit", o->commit, "what to call this build in it");
  command.runs([o] {
    if (!o->csv.empty() && !o->measure) throw InputError("--csv keeps what --measure measures");
    check_outputs({{"--csv", o->csv, ".csv"}});
    if (o->measure)
      measure(*o);
    else
      list();
  });
}

}    // namespace lsdcd
