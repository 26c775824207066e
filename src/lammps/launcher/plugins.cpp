// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

#include "lammps/launcher/plugins.h"

#include "base/atomic_file.h"
#include "lammps/host_fixes.h"
#include "lammps/plugin_api.h"

#include "comm.h"
#include "command.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "input.h"
#include "lammps.h"
#include "modify.h"
#include "region.h"
#include "utils.h"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <dlfcn.h>
#include <filesystem>
#include <sstream>

using namespace LAMMPS_NS;
namespace fs = std::filesystem;

namespace lsdcd {

namespace {

std::vector<lammpsplugin_t> loaded;
bool quiet = false;

class PluginCommand : public Command {
 public:
  explicit PluginCommand(LAMMPS *lmp) : Command(lmp) {}
  void command(int narg, char **arg) override
  {
    run_plugin_command(lmp, std::vector<std::string>(arg, arg + narg));
  }
};

void say(LAMMPS *lmp, const std::string &line)
{
  if (lmp->comm->me == 0) utils::logmesg(lmp, line + "\n");
}

std::vector<lammpsplugin_t>::iterator find(const std::string &style, const std::string &name)
{
  return std::find_if(loaded.begin(), loaded.end(),
                      [&](const lammpsplugin_t &p) { return style == p.style && name == p.name; });
}

// The callback that a plugin's lammpsplugin_init() calls once per style.
void register_style(lammpsplugin_t *plugin, void *host)
{
  LAMMPS *lmp = static_cast<LAMMPS *>(host);
  if (!plugin) return;
  const std::string style = plugin->style, name = plugin->name;
  if (find(style, name) != loaded.end()) {
    if (!quiet)
      say(lmp, "Ignoring load of " + style + " style " + name + ": must unload existing " + name +
                   " plugin first");
    return;
  }
  if (style == "fix")
    (*lmp->modify->fix_map)[name] = (Modify::FixCreator) plugin->creator.v2;
  else if (style == "compute")
    (*lmp->modify->compute_map)[name] = (Modify::ComputeCreator) plugin->creator.v2;
  else if (style == "region")
    (*lmp->domain->region_map)[name] = (Domain::RegionCreator) plugin->creator.v2;
  else if (style == "pair")
    (*lmp->force->pair_map)[name] = (Force::PairCreator) plugin->creator.v1;
  else if (style == "command")
    (*lmp->input->command_map)[name] = (Input::CommandCreator) plugin->creator.v1;
  else {
    say(lmp, "Loading plugins for " + style + " styles is not implemented in lmp-lsdcd");
    return;
  }
  if (!quiet) say(lmp, std::string("Loading plugin: ") + plugin->info + " by " + plugin->author);
  loaded.push_back(*plugin);
}

void delete_regions(Domain &domain, const std::string &style)
{
#if LSDCD_HOST_VERSION < 20220601
  for (int i = domain.nregion - 1; i >= 0; i--)
    if (style == domain.regions[i]->style) domain.delete_region(i);
#else
  for (Region *region : domain.get_region_by_style(style)) domain.delete_region(region);
#endif
}

// Deletes what uses the style, then the style. The file stays open: other styles
// of it, or threads that it started, may be in use.
void unload(LAMMPS *lmp, const std::string &style, const std::string &name)
{
  const auto plugin = find(style, name);
  if (plugin == loaded.end()) {
    say(lmp, "Ignoring unload of " + style + " style " + name + ": not loaded from a plugin");
    return;
  }
  say(lmp, "Unloading " + style + " style " + name);
  loaded.erase(plugin);
  Modify *modify = lmp->modify;
  if (style == "fix") {
    const std::vector<Fix *> fixes = lsdcd::host_fixes(*modify);
    for (auto fix = fixes.rbegin(); fix != fixes.rend(); ++fix)
      if (name == (*fix)->style) modify->delete_fix(std::string((*fix)->id));
    modify->fix_map->erase(name);
  } else if (style == "compute") {
    const std::vector<Compute *> computes = lsdcd::host_computes(*modify);
    for (auto compute = computes.rbegin(); compute != computes.rend(); ++compute)
      if (name == (*compute)->style) modify->delete_compute(std::string((*compute)->id));
    modify->compute_map->erase(name);
  } else if (style == "region") {
    delete_regions(*lmp->domain, name);
    lmp->domain->region_map->erase(name);
  } else if (style == "pair") {
    const char *current = lmp->force->pair_style;
    if (current && (name == current || std::strncmp(current, "hybrid", 6) == 0))
      lmp->force->create_pair("none", 0);
    lmp->force->pair_map->erase(name);
  } else
    lmp->input->command_map->erase(name);
}

bool load(LAMMPS *lmp, const std::string &file)
{
  void *dso = dlopen(file.c_str(), RTLD_NOW | RTLD_GLOBAL);
  if (!dso) {
    const char *why = dlerror();
    say(lmp, "Open of file " + file + " failed: " + (why ? why : "unknown reason"));
    return false;
  }
  const auto init = reinterpret_cast<lammpsplugin_initfunc>(dlsym(dso, "lammpsplugin_init"));
  if (!init) {
    say(lmp, "Plugin symbol lookup failure in file " + file + ": it has no lammpsplugin_init");
    dlclose(dso);
    return false;
  }
  init(lmp, dso, reinterpret_cast<void *>(&register_style));
  return true;
}

std::vector<fs::path> plugin_folders()
{
  std::vector<fs::path> folders;
  const char *path = std::getenv("LAMMPS_PLUGIN_PATH");
  std::istringstream list(path ? path : "");
  for (std::string folder; std::getline(list, folder, ':');)
    if (!folder.empty()) folders.push_back(folder);
  return folders;
}

// The folder of the fix's plugin: in a build, or installed.
fs::path own_folder()
{
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path(),
                 built = program.parent_path() / "lib";
  return fs::exists(built / "lsdcdplugin.so", none) ? built : program / LSDCD_PLUGINS;
}

// A bare name is also looked for where plugins are loaded from at the start.
std::string locate(const std::string &file)
{
  if (file.find('/') != std::string::npos || fs::exists(file)) return fs::absolute(file).string();
  std::vector<fs::path> folders = plugin_folders();
  folders.push_back(own_folder());
  for (const fs::path &folder : folders)
    if (fs::exists(folder / file)) return (folder / file).string();
  return file;
}

}    // namespace

void provide_plugins(LAMMPS *lmp)
{
  loaded.clear();
  (*lmp->input->command_map)["plugin"] = [](LAMMPS *host) -> Command * {
    return new PluginCommand(host);
  };

  quiet = true;
  const std::string own = (own_folder() / "lsdcdplugin.so").string();
  if (!load(lmp, own) || find("fix", "wall/lsdcd") == loaded.end())
    lmp->error->all(FLERR, "lmp-lsdcd needs its own plugin " + own +
                               ", which is built and installed with it: build the target "
                               "lmp-lsdcd, or install it again");
  for (const fs::path &folder : plugin_folders()) {
    int count = 0;
    std::error_code none;
    std::vector<std::string> files;
    for (const auto &entry : fs::directory_iterator(folder, none)) {
      const std::string name = entry.path().string();
      if (ends_in(name, "plugin.so")) files.push_back(name);
    }
    std::sort(files.begin(), files.end());    // the same order on every process
    for (const std::string &file : files) count += load(lmp, file);
    say(lmp, "Loaded " + std::to_string(count) + " plugins from " + folder.string());
  }
  quiet = false;
}

void run_plugin_command(LAMMPS *lmp, const std::vector<std::string> &tokens)
{
  const std::string what = tokens.empty() ? "" : tokens[0];
  if (what == "load" && tokens.size() > 1) {
    for (std::size_t i = 1; i < tokens.size(); i++) load(lmp, locate(tokens[i]));
  } else if (what == "unload" && tokens.size() == 3) {
    unload(lmp, tokens[1], tokens[2]);
  } else if (what == "clear" && tokens.size() == 1) {
    while (!loaded.empty()) {
      const lammpsplugin_t first = loaded.front();
      unload(lmp, first.style, first.name);
    }
  } else if (what == "list" && tokens.size() == 1) {
    say(lmp, "Currently loaded plugins");
    for (std::size_t i = 0; i < loaded.size(); i++)
      say(lmp, "   " + std::to_string(i + 1) + ": " + loaded[i].style + " style plugin " +
                   loaded[i].name);
  } else
    lmp->error->all(FLERR, std::string("Illegal plugin command. Syntax: plugin load FILES | "
                                       "unload STYLE NAME | list | clear"));
}

}    // namespace lsdcd
