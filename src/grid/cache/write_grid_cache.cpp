// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "backend/threads.h"
#include "base/atomic_file.h"
#include "base/input_error.h"
#include "grid/cache/cache_format.h"

#include <cstring>
#include <zstd.h>

namespace lsdcd {

std::size_t write_grid_cache(const std::string &path, const GridKey &key, const GridReport &report,
                             const char *block, std::size_t block_bytes)
{
  const std::int64_t n = frames_in(block_bytes);
  Packer header;
  Front front = {};
  std::memcpy(front.magic, kMagic, sizeof kMagic);
  front.format = kFormat;
  header(front);
  header(key);
  header(std::uint64_t(block_bytes));
  each_field(report, header);
  const std::size_t table = header.bytes.size();
  front.header_bytes = table + n * (sizeof(std::uint64_t) + sizeof(Hash));

  // The header goes in last, when the frames are known.
  AtomicFile file(path);
  std::uint64_t end = front.header_bytes;
  const std::int64_t at_once = threads();
  const std::size_t room = ZSTD_compressBound(kFrameBytes);
  std::vector<std::vector<char>> packed(at_once, std::vector<char>(room));
  std::vector<std::size_t> bytes(at_once);
  std::vector<Hash> content(at_once);
  for (std::int64_t first = 0; first < n; first += at_once) {
    const std::int64_t last = std::min(n, first + at_once);
#pragma omp parallel for schedule(static, 1) num_threads(at_once) if (at_once > 1)
    for (std::int64_t i = first; i < last; i++) {
      const std::int64_t k = i - first;
      const char *from = block + i * kFrameBytes;
      const std::size_t size = frame_size(i, block_bytes);
      content[k] = hash_of(from, size);
      bytes[k] = ZSTD_compress(packed[k].data(), room, from, size, kLevel);
    }
    for (std::int64_t k = 0; k < last - first; k++) {
      if (ZSTD_isError(bytes[k]))
        throw InputError("'" + path + "': cannot compress: " + ZSTD_getErrorName(bytes[k]));
      file.write_at(end, packed[k].data(), bytes[k]);
      end += bytes[k];
      header(std::uint64_t(bytes[k]));
      header(content[k]);
    }
  }
  std::memcpy(header.bytes.data(), &front, sizeof front);
  front.check = check_of(header.bytes);
  std::memcpy(header.bytes.data(), &front, sizeof front);
  file.write_at(0, header.bytes.data(), header.bytes.size());
  file.commit();
  return end;
}

}    // namespace lsdcd
