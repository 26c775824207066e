// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// LAMMPS as the host of a wall.
#ifndef LMP_LAMMPS_HOST_H
#define LMP_LAMMPS_HOST_H

#include "wall/host.h"

namespace LAMMPS_NS {

class LammpsHost : public lsdcd::Host {
 public:
  explicit LammpsHost(class FixWallLsdcd &fix) : fix(fix) {}

  void sum(double *, int) override;
  void max(double *, int) override;
  int max_rank(double &) override;
  void broadcast(void *, std::size_t, int) override;
  std::vector<double> gather(const std::vector<double> &) override;
  void fail_together(const std::string &) override;
  std::vector<double> variables(const std::vector<std::string> &) override;
  void check_variables(const std::vector<std::string> &) override;
  std::unique_ptr<lsdcd::NodeMemory> node_memory() override;
  int rank() const override;
  lsdcd::PeriodicBox box() const override;
  lsdcd::SphereGroup group() const override;
  lsdcd::Spheres spheres_on_cpu() override;
  std::int64_t tag(int) override;
  std::int64_t highest_tag() override;
  double radius_of_tag(std::int64_t) override;
  void log(const std::string &) override;
  void warn(const std::string &) override;

 private:
  int find_variable(const std::string &) const;

  FixWallLsdcd &fix;
};

}    // namespace LAMMPS_NS

#endif
