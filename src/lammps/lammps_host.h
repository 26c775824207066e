// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// LAMMPS as the host of a wall.
#ifndef LMP_LAMMPS_HOST_H
#define LMP_LAMMPS_HOST_H

#include "lammps/mpi_host.h"

#include <optional>
#include <vector>

namespace LAMMPS_NS {

class LammpsHost : public lsdcd::MpiNodeHost {
 public:
  explicit LammpsHost(class FixWallLsdcd &);

  lsdcd::PeriodicBox box() const override;
  std::optional<double> power_on_nodes(int mesh, const std::vector<double> &force) override;

 private:
  void show(const std::string &, bool) override;
  FixWallLsdcd &fix;
};

}    // namespace LAMMPS_NS

#endif
