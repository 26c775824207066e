// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

// Memory of a grid where no processes share any.
#pragma once

#include "backend/owned_array.h"
#include "base/large_memory.h"
#include "wall/host.h"

namespace lsdcd {

// Each process has a copy of its own.
class OwnMemory : public NodeMemory {
 public:
  // The host must outlive it. `node_rank`: which of the GPUs of its node this process takes.
  explicit OwnMemory(Host &host, int node_rank = 0) : host_(host), node_rank_(node_rank) {}
  char *allocate(std::size_t bytes) override
  {
    memory_ = OwnedArray<char, LargeMemory>(bytes);
    return memory_.data();
  }
  void publish() override {}
  void broadcast_to_writers(void *data, std::size_t bytes) override
  {
    host_.broadcast(data, bytes, 0);
  }
  bool writes() const override { return true; }
  int node_rank() const override { return node_rank_; }
  int node_size() const override { return 1; }
  bool is_shared() const override { return false; }
  const char *block() const override { return memory_.data(); }
  std::size_t bytes() const override { return memory_.size(); }

 private:
  Host &host_;
  int node_rank_;
  OwnedArray<char, LargeMemory> memory_;
};

}    // namespace lsdcd
