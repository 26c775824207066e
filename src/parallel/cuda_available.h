// Whether this process can compute on an NVIDIA GPU.
#pragma once

#include <string>

namespace lsdcd {

// True if this build has the CUDA engine and a usable GPU is present; `why`
// says what is missing otherwise.
bool cuda_available(std::string *why);

}    // namespace lsdcd
