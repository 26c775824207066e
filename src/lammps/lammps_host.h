// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// LAMMPS as the host of a wall.
#ifndef LMP_LAMMPS_HOST_H
#define LMP_LAMMPS_HOST_H

#include "lammps/mpi_host.h"
#include "wall/host.h"

namespace LAMMPS_NS {

class LammpsHost : public lsdcd::WallHost, public lsdcd::MpiNodeHost {
 public:
  explicit LammpsHost(class FixWallLsdcd &);

  std::vector<double> variables(const std::vector<std::string> &) override;
  void check_variables(const std::vector<std::string> &) override;
  lsdcd::PeriodicBox box() const override;
  lsdcd::SphereGroup group() const override;
  lsdcd::Spheres spheres_on_cpu() override;
  std::int64_t tag(int) override;
  std::int64_t highest_tag() override;
  double radius_of_tag(std::int64_t) override;

 private:
  void show(const std::string &, bool) override;
  int find_variable(const std::string &) const;

  FixWallLsdcd &fix;
};

}    // namespace LAMMPS_NS

#endif
