// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The styles as LAMMPS makes them: an exception of the core leaves none of their functions, but ends LAMMPS with its
// text. tests/tool/check_guards.py sees to it that no function is left out. Constructors call run_core() themselves.
#ifndef LMP_GUARDED_STYLES_H
#define LMP_GUARDED_STYLES_H

#include "compute.h"
#include "fix.h"
#include "pair.h"
#include "region.h"

#include <cstdio>

namespace LAMMPS_NS {

template <class Style>
class GuardedFix : public Style {
 public:
  using Style::Style;

  // The following functions are called on all processes.
  void post_constructor() override
  {
    this->run_core([&] { Style::post_constructor(); });
  }
  int setmask() override
  {
    return this->run_core([&] { return Style::setmask(); });
  }
  void init() override
  {
    this->run_core([&] { Style::init(); });
  }
  void setup(int vflag) override
  {
    this->run_core([&] { Style::setup(vflag); });
  }
  void min_setup(int vflag) override
  {
    this->run_core([&] { Style::min_setup(vflag); });
  }
  void setup_pre_exchange() override
  {
    this->run_core([&] { Style::setup_pre_exchange(); });
  }
  void setup_pre_force_respa(int vflag, int level) override
  {
    this->run_core([&] { Style::setup_pre_force_respa(vflag, level); });
  }
  void initial_integrate(int vflag) override
  {
    this->run_core([&] { Style::initial_integrate(vflag); });
  }
  void initial_integrate_respa(int vflag, int level, int loop) override
  {
    this->run_core([&] { Style::initial_integrate_respa(vflag, level, loop); });
  }
  void pre_exchange() override
  {
    this->run_core([&] { Style::pre_exchange(); });
  }
  void pre_force(int vflag) override
  {
    this->run_core([&] { Style::pre_force(vflag); });
  }
  void pre_reverse(int eflag, int vflag) override
  {
    this->run_core([&] { Style::pre_reverse(eflag, vflag); });
  }
  void post_force(int vflag) override
  {
    this->run_core([&] { Style::post_force(vflag); });
  }
  void post_force_respa(int vflag, int level, int loop) override
  {
    this->run_core([&] { Style::post_force_respa(vflag, level, loop); });
  }
  void end_of_step() override
  {
    this->run_core([&] { Style::end_of_step(); });
  }
  void setup_post_neighbor() override
  {
    this->run_core([&] { Style::setup_post_neighbor(); });
  }
  void post_neighbor() override
  {
    this->run_core([&] { Style::post_neighbor(); });
  }
  void min_pre_exchange() override
  {
    this->run_core([&] { Style::min_pre_exchange(); });
  }
  void min_post_neighbor() override
  {
    this->run_core([&] { Style::min_post_neighbor(); });
  }
  void pre_force_respa(int vflag, int level, int loop) override
  {
    this->run_core([&] { Style::pre_force_respa(vflag, level, loop); });
  }
  void post_run() override
  {
    this->run_core([&] { Style::post_run(); });
  }
  void reset_dt() override
  {
    this->run_core([&] { Style::reset_dt(); });
  }
  void write_restart(FILE *file) override
  {
    this->run_core([&] { Style::write_restart(file); });
  }
  void restart(char *buffer) override
  {
    this->run_core([&] { Style::restart(buffer); });
  }
  int maxsize_restart() override
  {
    return this->run_core([&] { return Style::maxsize_restart(); });
  }
  double compute_scalar() override
  {
    return this->run_core([&] { return Style::compute_scalar(); });
  }
  double compute_vector(int i) override
  {
    return this->run_core([&] { return Style::compute_vector(i); });
  }
  double compute_array(int i, int j) override
  {
    return this->run_core([&] { return Style::compute_array(i, j); });
  }
  double memory_usage() override
  {
    return this->run_core([&] { return Style::memory_usage(); });
  }
  int image(int *&kinds, double **&rows) override
  {
    return this->run_core([&] { return Style::image(kinds, rows); });
  }
  int modify_param(int narg, char **arg) override
  {
    return this->run_core([&] { return Style::modify_param(narg, arg); });
  }

  // The following functions are called on one process, whatever the others do.
  void grow_arrays(int nmax) override
  {
    this->run_core_here([&] { Style::grow_arrays(nmax); });
  }
  void copy_arrays(int i, int j, int delflag) override
  {
    this->run_core_here([&] { Style::copy_arrays(i, j, delflag); });
  }
  void set_arrays(int i) override
  {
    this->run_core_here([&] { Style::set_arrays(i); });
  }
  int pack_exchange(int i, double *buffer) override
  {
    return this->run_core_here([&] { return Style::pack_exchange(i, buffer); });
  }
  int unpack_exchange(int nlocal, double *buffer) override
  {
    return this->run_core_here([&] { return Style::unpack_exchange(nlocal, buffer); });
  }
  int pack_reverse_comm_size(int n, int first) override
  {
    return this->run_core_here([&] { return Style::pack_reverse_comm_size(n, first); });
  }
  int pack_reverse_comm(int n, int first, double *buffer) override
  {
    return this->run_core_here([&] { return Style::pack_reverse_comm(n, first, buffer); });
  }
  void unpack_reverse_comm(int n, int *atoms, double *buffer) override
  {
    this->run_core_here([&] { Style::unpack_reverse_comm(n, atoms, buffer); });
  }
  int pack_restart(int i, double *buffer) override
  {
    return this->run_core_here([&] { return Style::pack_restart(i, buffer); });
  }
  void unpack_restart(int nlocal, int nth) override
  {
    this->run_core_here([&] { Style::unpack_restart(nlocal, nth); });
  }
  int size_restart(int nlocal) override
  {
    return this->run_core_here([&] { return Style::size_restart(nlocal); });
  }
};

template <class Style>
class GuardedPair : public Style {
 public:
  using Style::Style;

  void settings(int narg, char **arg) override
  {
    this->run_core([&] { Style::settings(narg, arg); });
  }
  void coeff(int narg, char **arg) override
  {
    this->run_core([&] { Style::coeff(narg, arg); });
  }
  void init_style() override
  {
    this->run_core([&] { Style::init_style(); });
  }
  double init_one(int i, int j) override
  {
    return this->run_core([&] { return Style::init_one(i, j); });
  }
  void compute(int eflag, int vflag) override
  {
    this->run_core([&] { Style::compute(eflag, vflag); });
  }
  double memory_usage() override
  {
    return this->run_core([&] { return Style::memory_usage(); });
  }

  // The following functions are called on one process, whatever the others do.
  double single(int i, int j, int itype, int jtype, double rsq, double factor_coul,
                double factor_lj, double &fforce) override
  {
    return this->run_core_here(
        [&] { return Style::single(i, j, itype, jtype, rsq, factor_coul, factor_lj, fforce); });
  }
  int pack_forward_comm(int n, int *atoms, double *buffer, int pbc_flag, int *pbc) override
  {
    return this->run_core_here(
        [&] { return Style::pack_forward_comm(n, atoms, buffer, pbc_flag, pbc); });
  }
  void unpack_forward_comm(int n, int first, double *buffer) override
  {
    this->run_core_here([&] { Style::unpack_forward_comm(n, first, buffer); });
  }
};

template <class Style>
class GuardedCompute : public Style {
 public:
  using Style::Style;

  void init() override
  {
    this->run_core([&] { Style::init(); });
  }
  void setup() override
  {
    this->run_core([&] { Style::setup(); });
  }
  double compute_scalar() override
  {
    return this->run_core([&] { return Style::compute_scalar(); });
  }
  void compute_vector() override
  {
    this->run_core([&] { Style::compute_vector(); });
  }
  void compute_array() override
  {
    this->run_core([&] { Style::compute_array(); });
  }
  double memory_usage() override
  {
    return this->run_core([&] { return Style::memory_usage(); });
  }
};

template <class Style>
class GuardedRegion : public Style {
 public:
  using Style::Style;

  void init() override
  {
    this->run_core([&] { Style::init(); });
  }
  // The following functions are called on one process, whatever the others do.
  int inside(double x, double y, double z) override
  {
    return this->run_core_here([&] { return Style::inside(x, y, z); });
  }
  int surface_interior(double *x, double cutoff) override
  {
    return this->run_core_here([&] { return Style::surface_interior(x, cutoff); });
  }
  int surface_exterior(double *x, double cutoff) override
  {
    return this->run_core_here([&] { return Style::surface_exterior(x, cutoff); });
  }
};

}    // namespace LAMMPS_NS

#endif
