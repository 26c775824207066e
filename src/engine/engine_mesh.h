// One mesh of a wall, as an engine has it.
#pragma once

#include "engine/force/force_settings.h"
#include "engine/force/law_job.h"
#include "grid/lookup/brick_filter.h"

#include <stdexcept>
#include <vector>

namespace lsdcd {

template <class B>
struct EngineMesh {
  GridView grid = {};
  typename B::template Array<char> block;    // the grid's, where the host's memory is another
  typename B::template Array<BrickWord> words;
  BrickTable table;
  WallPose pose, chosen;    // chosen: at the last choice

  void set_grid(B &b, const GridView &on_host)
  {
    if (B::kOnHost) {
      grid = on_host;
    } else {
      if (!on_host.block) throw std::logic_error("an engine needs the view of a flat grid block");
      block = typename B::template Array<char>(on_host.block_bytes);
      b.copy_in(on_host.block, block.data(), on_host.block_bytes);
      grid = moved_view(on_host, block.data());
    }
    const std::vector<BrickWord> host_words = brick_words(on_host);
    words = b.from_host(host_words);
    table = BrickTable(host_words, words.data());
  }

  MeshWork work(const EngineSettings &settings, const StepSettings &step, int mesh) const
  {
    return {grid, force_settings(settings, step, pose, mesh)};
  }

  std::size_t bytes() const { return block.size() + words.size() * sizeof(BrickWord); }
};

}    // namespace lsdcd
