// The version of LSDCD. CMakeLists.txt has it; nothing else in `src` but lsdcd.h says it again.
#pragma once

namespace lsdcd {

// "0.9.0".
const char *version();

}    // namespace lsdcd
