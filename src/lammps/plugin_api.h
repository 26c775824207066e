// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: GPL-2.0-only

// The binary interface between LAMMPS and a plugin, as LAMMPS documents it. Written
// here because packages do not install lammpsplugin.h; layout and names are LAMMPS's.
#pragma once

extern "C" {

typedef void *lammpsplugin_factory1(void *);
typedef void *lammpsplugin_factory2(void *, int, char **);

typedef struct {
  const char *version;
  const char *style;
  const char *name;
  const char *info;
  const char *author;
  union {
    lammpsplugin_factory1 *v1;
    lammpsplugin_factory2 *v2;
  } creator;
  void *handle;
} lammpsplugin_t;

typedef void (*lammpsplugin_regfunc)(lammpsplugin_t *, void *);
typedef void (*lammpsplugin_initfunc)(void *, void *, void *);
}
