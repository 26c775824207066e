// Whether an array is one that only a GPU can read. Asks the CUDA driver if the process has it
// loaded: without it there are none, and nobody is made to load it.
#pragma once

#include <dlfcn.h>

#include <cstdint>

namespace lsdcd {

inline bool only_on_device(const void *array)
{
  using Ask = int (*)(void *, int, unsigned long long);
  void *driver = dlopen("libcuda.so.1", RTLD_NOLOAD | RTLD_LAZY);
  if (!driver) return false;
  const Ask ask = reinterpret_cast<Ask>(dlsym(driver, "cuPointerGetAttribute"));
  dlclose(driver);    // the process keeps it
  constexpr int kMemoryType = 2, kIsManaged = 8;
  constexpr unsigned kDevice = 2;
  const auto at = static_cast<unsigned long long>(reinterpret_cast<std::uintptr_t>(array));
  unsigned type = 0, managed = 0;
  // A pointer that the driver does not know is the host's.
  if (!ask || ask(&type, kMemoryType, at) != 0 || type != kDevice) return false;
  return ask(&managed, kIsManaged, at) != 0 || managed == 0;
}

}    // namespace lsdcd
