// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// A grid in the memory of a backend, with the tables that searches there read.
#pragma once

#include "grid/flat_grid.h"
#include "grid/lookup/brick_words.h"
#include "grid/lookup/coarse_table.h"

#include <stdexcept>
#include <utility>
#include <vector>

namespace lsdcd {

template <class B>
class GridOn {
  template <class T>
  using Array = typename B::template Array<T>;

 public:
  GridView view = {};
  BrickTable table;
  CoarseTable coarse;    // where asked for

  GridOn() = default;
  // Borrows a block that lies where B computes, and copies it elsewhere.
  GridOn(B &b, const GridView &on_cpu, bool with_coarse = false) : view(on_cpu)
  {
    if constexpr (!B::kOnCpu) {
      if (!on_cpu.block) throw std::logic_error("a device needs the view of a flat grid block");
      block_ = Array<char>(on_cpu.block_bytes);
      b.copy_in(on_cpu.block, block_.data(), block_.size());
      b.wait();
      view = moved_view(on_cpu, block_.data());
    }
    put_table(b, on_cpu);
    if (!with_coarse) return;
    coarse = CoarseTable(on_cpu);
    coarse_words_ = from_cpu(b, coarse_words(on_cpu, coarse));
    coarse.words = coarse_words_.data();
  }
  // Makes what the constructor above makes, but owns the flat grid, which that one borrows.
  GridOn(B &b, FlatGrid &&flat, bool with_coarse = false) : GridOn(b, flat.view(), with_coarse)
  {
    if constexpr (B::kOnCpu) flat_ = std::move(flat);
  }

  // Other lists for the wall that is there: `with` lies where B computes, in memory of the caller's.
  void set_lists(B &b, const GridView &with)
  {
    view = with;
    std::vector<std::int32_t> brick_of(std::size_t(with.n_bricks[0]) * with.n_bricks[1] *
                                       with.n_bricks[2]);
    b.copy_out(with.lists.brick_of, brick_of.data(), brick_of.size());
    b.wait();
    GridView on_cpu = with;
    on_cpu.lists.brick_of = brick_of.data();
    put_table(b, on_cpu);
  }

  std::size_t bytes() const { return block_.size() + words_.size() * sizeof(BrickWord); }

 private:
  void put_table(B &b, const GridView &on_cpu)
  {
    const std::vector<BrickWord> words = brick_words(on_cpu);
    words_ = from_cpu(b, words);
    table = BrickTable(words, words_.data());
  }

  FlatGrid flat_;
  Array<char> block_;
  Array<BrickWord> words_;
  Array<std::uint32_t> coarse_words_;
};

}    // namespace lsdcd
