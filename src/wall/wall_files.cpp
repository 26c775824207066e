// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "wall/wall_files.h"

#include "base/atomic_file.h"
#include "base/input_error.h"
#include "output/mesh_fields.h"
#include "output/mesh_stl.h"
#include "wall/spec/mesh_name.h"
#include "wall/spec/run_files.h"

#include <numeric>
#include <utility>

namespace lsdcd {

WallFiles::WallFiles(Host &host, const WallSpec &settings, Real pressure_unit) :
    host_(host), settings_(settings), pressure_unit_(pressure_unit), series_(settings.meshes.size())
{
}

int WallFiles::every() const
{
  int every = 0;
  for (const MeshSpec &m : settings_.meshes)
    every = std::gcd(every, std::gcd(m.spectrum.every, std::gcd(m.fields.every, m.stl.every)));
  return every;
}

void WallFiles::check(int mesh, const char *keyword, const FileEvery &file, std::int64_t step)
{
  if (file.every == 0) return;
  try {
    run_collectively(host_, host_.is_first(), [&] { AtomicFile(file_of_step(file.name, step)); });
  } catch (const InputError &e) {
    throw InputError(with_mesh_name(settings_, mesh,
                                    "in '" + std::string(keyword) + "', " + e.what() +
                                        "; make the folder, or name another"));
  }
}

void WallFiles::begin_run(std::int64_t step)
{
  warned_ = false;
  run_collectively(host_, host_.is_first(),
                   [&] { check_apart(files_of(settings_), host_.names().wall, step); });
  for (std::size_t k = 0; k < settings_.meshes.size(); k++) {
    check(static_cast<int>(k), "mesh_fields", settings_.meshes[k].fields, step);
    check(static_cast<int>(k), "impact_spectrum", settings_.meshes[k].spectrum, step);
    check(static_cast<int>(k), "mesh_stl", settings_.meshes[k].stl, step);
  }
}

// Returns whether the first process could. Else it tells what is lost.
bool WallFiles::try_to_write(const std::string &lost, const std::function<void()> &write)
{
  try {
    run_collectively(host_, host_.is_first(), write);
    return true;
  } catch (const InputError &e) {
    if (!warned_)
      host_.warn(
          std::string(e.what()) + ": " + lost +
          "; older files are unchanged. Free disk space, or correct the path: the run goes on and "
          "tries again with the next file. Other files that cannot be written are not reported");
    warned_ = true;
    return false;
  }
}

void WallFiles::write_fields(int mesh, std::int64_t step, double time, const PosedMesh &now,
                             LoadRecorder &loads, EnergyRecorder &energies)
{
  const std::string name = settings_.meshes[mesh].fields.name, file = file_of_step(name, step);
  const FeatureRows<Load> all = loads.gathered(mesh);
  const bool has_energy = settings_.has_energy_places(settings_.meshes[mesh]);
  const FeatureRows<PlaceEnergy> places =
      has_energy ? energies.gathered(mesh) : FeatureRows<PlaceEnergy>();
  const auto write = [&] {
    std::vector<FaceField> fields =
        load_fields(*now.mesh, all, loads.time(mesh), pressure_unit_, settings_.wears(), now.pose);
    if (has_energy)
      for (FaceField &field :
           energy_fields(*now.mesh, places, settings_.energy, settings_.impact_speed > 0))
        fields.push_back(std::move(field));
    write_mesh_fields(file, *now.mesh, fields, step, time, now.pose);
  };
  if (!try_to_write("there are no mesh_fields of this step, and the next file averages over these "
                    "steps, too",
                    write))
    return;
  loads.begin_average(mesh);
  if (file == name) return;
  std::string renamed;    // on the first process
  const auto list = [&] {
    std::unique_ptr<FileSeries> &series = series_[mesh];
    if (!series) {
      FileSeries begun(name);
      renamed = begun.begin(continues_);
      series = std::make_unique<FileSeries>(std::move(begun));
    }
    series->add(step, time);
    series->write();
  };
  try_to_write("the list of mesh_fields lacks this step until it can be written", list);
  if (!renamed.empty()) host_.warn(renamed);
}

void WallFiles::write_due(std::int64_t step, double time, const std::vector<PosedMesh> &meshes,
                          LoadRecorder *loads, EnergyRecorder &energies)
{
  const auto is_due = [step](const FileEvery &file) {
    return file.every > 0 && step % file.every == 0;
  };
  for (std::size_t k = 0; k < meshes.size(); k++) {
    const MeshSpec &m = settings_.meshes[k];
    if (is_due(m.fields) && loads)
      write_fields(static_cast<int>(k), step, time, meshes[k], *loads, energies);
    if (is_due(m.spectrum) && loads) {
      const ImpactSpectrum spectrum = energies.spectrum(static_cast<int>(k));
      try_to_write("there is no impact_spectrum of this step",
                   [&] { write_spectrum(file_of_step(m.spectrum.name, step), spectrum); });
    }
    if (is_due(m.stl))
      try_to_write("there is no mesh_stl of this step", [&] {
        write_mesh_stl(file_of_step(m.stl.name, step), *meshes[k].mesh, meshes[k].pose);
      });
  }
}

}    // namespace lsdcd
