// Memory that was freed, given back to the operating system.
#pragma once

#include <cstdlib>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace lsdcd {

// glibc keeps freed arrays of up to 32 MB for itself; a wall's set-up frees most of what it takes.
inline void give_back_memory()
{
#if defined(__GLIBC__)
  malloc_trim(0);
#endif
}

}    // namespace lsdcd
