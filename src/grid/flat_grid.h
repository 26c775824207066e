// A grid as one flat block in memory of its own, aligned as views want it.
#pragma once

#include "grid/triangle_grid.h"

#include <cstdint>
#include <vector>

namespace lsdcd {

class FlatGrid {
 public:
  FlatGrid() = default;
  explicit FlatGrid(const TriangleGrid &grid) : FlatGrid(flat_bytes(grid))
  {
    flatten(grid, block());
  }
  // For a block that the caller fills.
  explicit FlatGrid(std::size_t bytes) : memory_(bytes + kAlign)
  {
    const auto at = reinterpret_cast<std::uintptr_t>(memory_.data());
    begin_ = (kAlign - at % kAlign) % kAlign;
  }
  // Moving keeps the memory where it is, copying would not.
  FlatGrid(FlatGrid &&) = default;
  FlatGrid &operator=(FlatGrid &&) = default;

  char *block() { return memory_.data() + begin_; }
  std::size_t bytes() const { return memory_.size() - kAlign; }
  GridView view() const { return flat_view(memory_.data() + begin_); }

 private:
  static constexpr std::size_t kAlign = 64;    // bytes

  std::vector<char> memory_;
  std::size_t begin_ = 0;
};

}    // namespace lsdcd
