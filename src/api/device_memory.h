// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Can only a GPU read an array? Asks the CUDA driver if the process has loaded it. Without it no such
// array exists, and it is not loaded for that.
#pragma once

#include "api/c_border.h"

#include <dlfcn.h>
#include <link.h>

#include <atomic>
#include <cstdint>
#include <string>

namespace lsdcd {

// Looks for the driver. dlopen() takes microseconds, so it is called only if the process has loaded a
// library since the last time, which may have brought the driver.
class DeviceMemory {
 public:
  bool only_there(const void *array) const
  {
    constexpr int kMemoryType = 2, kIsManaged = 8;
    constexpr unsigned kDevice = 2;
    const auto at = static_cast<unsigned long long>(reinterpret_cast<std::uintptr_t>(array));
    unsigned type = 0, managed = 0;
    // A pointer that the driver does not know belongs to the host.
    if (!ask_ || ask_(&type, kMemoryType, at) != 0 || type != kDevice) return false;
    return ask_(&managed, kIsManaged, at) != 0 || managed == 0;
  }

  // Throws where an array, which may be null, is in the memory of a GPU alone. The text ends with the remedy.
  void refuse_there(const void *array, const char *name, const char *remedy) const
  {
    if (array && only_there(array))
      throw ApiError(LSDCD_ERROR_DEVICE,
                     std::string("the array `") + name + "` is in a GPU's memory: " + remedy);
  }

 private:
  using Ask = int (*)(void *, int, unsigned long long);

  // cuPointerGetAttribute(), or null.
  static Ask ask_loaded_driver()
  {
    static std::atomic<Ask> found{nullptr};
    static std::atomic<unsigned long long> asked_at{0};
    if (const Ask ask = found) return ask;
    const unsigned long long loads = n_loads();
    if (asked_at == loads) return nullptr;
    // It stays loaded from here on, as `found` points into it.
    void *driver = dlopen("libcuda.so.1", RTLD_NOLOAD | RTLD_NODELETE | RTLD_LAZY);
    if (driver) {
      found = reinterpret_cast<Ask>(dlsym(driver, "cuPointerGetAttribute"));
      dlclose(driver);
    }
    asked_at = loads;
    return found;
  }
  // Returns how many objects the process has loaded so far, including those unloaded since.
  static unsigned long long n_loads()
  {
    unsigned long long loads = 0;
    dl_iterate_phdr(
        [](dl_phdr_info *info, std::size_t, void *to) {
          *static_cast<unsigned long long *>(to) = info->dlpi_adds;
          return 1;
        },
        &loads);
    return loads;
  }

  Ask ask_ = ask_loaded_driver();
};

}    // namespace lsdcd
