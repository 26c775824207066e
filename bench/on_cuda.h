// What the benchmarks do on a GPU themselves.
#pragma once

#include "brute_force.h"
#include "query/sphere_query.h"

#include <memory>
#include <string>

namespace lsdcd {

std::string cuda_name();
double cuda_copy_gb_s();
double cuda_brute_force_ms(const TriangleGrid &grid, std::size_t n, std::size_t stride);

// Ways of running a query that the library does not take, to compare with the one it does.
struct OtherWay {
  const char *name;
  std::unique_ptr<SphereQuery> query;
};
std::vector<OtherWay> other_cuda_ways();

}    // namespace lsdcd
