// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Shared by the tests of the library's wall in several processes.
#pragma once

#include "lsdcd_behind_core.h"
#include "support/fake_host.h"

#include <cstddef>
#include <exception>

// A process of FakeHost as a program with MPI is one. It throws where calls of processes differ.
struct Process {
  lsdcd_host callbacks = {};
  lsdcd::WallOptions options;

  template <class Call>
  static int code_of_call(const Call &call)
  {
    try {
      call();
      return 0;
    } catch (const std::exception &) {
      return 1;
    }
  }

  Process(const Process &) = delete;    // options point into it
  explicit Process(lsdcd::FakeHost &host)
  {
    callbacks.size = sizeof callbacks;
    callbacks.rank = host.rank();
    callbacks.processes = 2;
    callbacks.data = &host;
    callbacks.sum = [](void *h, double *numbers, int n) {
      return code_of_call([&] { static_cast<lsdcd::FakeHost *>(h)->sum(numbers, n); });
    };
    callbacks.max = [](void *h, double *numbers, int n) {
      return code_of_call([&] { static_cast<lsdcd::FakeHost *>(h)->max(numbers, n); });
    };
    callbacks.broadcast = [](void *h, void *bytes, size_t n, int from) {
      return code_of_call([&] { static_cast<lsdcd::FakeHost *>(h)->broadcast(bytes, n, from); });
    };
    options.host = &callbacks;
  }
};
