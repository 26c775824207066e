// The file: a front that every version has, the rest of the header, then frames of
// zstd, each the image of kFrameBytes of the block.
#include "grid/cache/grid_cache.h"

#include "base/input_error.h"
#include "base/whole_file.h"
#include "parallel/threads.h"

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <type_traits>
#include <unistd.h>
#include <xxhash.h>
#include <zstd.h>

namespace lsdcd {

namespace {

constexpr char kMagic[16] = {'L', 'S', 'D', 'C', 'D', ' ', 'g', 'r',
                             'i', 'd', ' ', 'c', 'a', 'c', 'h', 'e'};
constexpr std::uint64_t kFormat = 1;
constexpr std::size_t kFrameBytes = std::size_t(1) << 20;
constexpr int kLevel = 1;    // of zstd

struct Front {
  char magic[16];
  std::uint64_t format;
  std::uint64_t header_bytes;    // front included
  Hash check;                    // of the header with this field zero
};

Hash hash_of(const void *data, std::size_t bytes)
{
  const XXH128_hash_t h = XXH3_128bits(data, bytes);
  return {h.low64, h.high64};
}

// The check of a header whose front has a zero there.
Hash check_of(std::vector<char> header)
{
  const Hash zero = {0, 0};
  std::memcpy(header.data() + offsetof(Front, check), &zero, sizeof zero);
  return hash_of(header.data(), header.size());
}

class Packer {
 public:
  template <class T>
  void operator()(const T &value)
  {
    static_assert(std::is_trivially_copyable<T>::value, "kept as bytes");
    const char *at = reinterpret_cast<const char *>(&value);
    bytes.insert(bytes.end(), at, at + sizeof value);
  }
  void operator()(const std::string &text)
  {
    (*this)(std::uint64_t(text.size()));
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  std::vector<char> bytes;
};

class Unpacker {
 public:
  Unpacker(const std::vector<char> &bytes, std::size_t at) : bytes_(bytes), at_(at) {}
  template <class T>
  void operator()(T &value)
  {
    if (!has(sizeof value)) return;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
  }
  void operator()(std::string &text)
  {
    std::uint64_t size = 0;
    (*this)(size);
    if (!has(size)) return;
    text.assign(bytes_.data() + at_, size);
    at_ += size;
  }
  bool done() const { return good_ && at_ == bytes_.size(); }
  bool has(std::uint64_t n) { return good_ = good_ && n <= bytes_.size() - at_; }

 private:
  const std::vector<char> &bytes_;
  std::size_t at_;
  bool good_ = true;
};

// The bindings name every member: one that is added does not compile until it is
// listed here too.
template <class Report, class Visit>
void each_field(Report &r, Visit &visit)
{
  auto &[length, reach, length_chosen, nearest, lists, complete, records, record_bytes, bytes,
         seconds, device] = r;
  const auto all = [&](auto &...field) { (visit(field), ...); };
  all(length, reach, length_chosen, nearest, lists, complete, records, record_bytes, bytes, seconds,
      device);
}

std::size_t frames_in(std::size_t bytes)
{
  return (bytes + kFrameBytes - 1) / kFrameBytes;
}

std::size_t frame_size(std::size_t frame, std::size_t bytes)
{
  return std::min(kFrameBytes, bytes - frame * kFrameBytes);
}

// All of it, or false with errno set; a file that ends early leaves errno 0.
bool read_at(int file, std::uint64_t offset, void *to, std::size_t bytes)
{
  char *at = static_cast<char *>(to);
  while (bytes > 0) {
    const ssize_t n = pread(file, at, bytes, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n == 0) errno = 0;
    if (n <= 0) return false;
    at += n;
    offset += n;
    bytes -= n;
  }
  return true;
}

// Damage may have reached the magic itself: most of it counts.
bool looks_like_ours(const char *start, std::size_t bytes)
{
  std::size_t same = 0;
  for (std::size_t i = 0; i < bytes; i++) same += start[i] == kMagic[i];
  return 2 * same >= bytes;
}

}    // namespace

bool cache_available(std::string *)
{
  return true;
}

CachedGrid::CachedGrid(const std::string &path, const GridKey &wanted)
{
  open_and_check(path, wanted);
}

CachedGrid::~CachedGrid()
{
  if (file_ >= 0) close(file_);
}

void CachedGrid::refuse(CacheState state, const std::string &problem)
{
  state_ = state;
  problem_ = problem;
}

void CachedGrid::open_and_check(const std::string &path, const GridKey &wanted)
{
  // A pipe must not make us wait for someone to write to it.
  file_ = open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  struct stat about;
  if (file_ < 0 && errno == ENOENT) return;    // missing
  if (file_ < 0 || fstat(file_, &about) != 0)
    return refuse(CacheState::foreign, std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(about.st_mode)) return refuse(CacheState::foreign, "is not a file");
  file_bytes_ = about.st_size;

  Front front = {};
  const std::size_t have = std::min(file_bytes_, sizeof front);
  if (!read_at(file_, 0, &front, have))
    return refuse(CacheState::foreign, std::string("cannot be read: ") + std::strerror(errno));
  if (!looks_like_ours(front.magic, std::min(have, sizeof front.magic)))
    return refuse(CacheState::foreign, "is not a grid cache");
  const bool magic = std::memcmp(front.magic, kMagic, sizeof kMagic) == 0;
  if (have < sizeof front || !magic || front.header_bytes < sizeof front ||
      front.header_bytes > file_bytes_)
    return refuse(CacheState::damaged, "is damaged: its first bytes are wrong");

  std::vector<char> header(front.header_bytes);
  if (!read_at(file_, 0, header.data(), header.size()) || !(check_of(header) == front.check))
    return refuse(CacheState::damaged, "is damaged: its header fails the checksum");

  Unpacker take(header, sizeof front);
  GridKey key = {};
  take(key);
  if (front.format != kFormat || !(key.version == wanted.version))
    return refuse(CacheState::other_version, "was written by another version of LSDCD");
  if (!(key.mesh == wanted.mesh)) return refuse(CacheState::other_mesh, "is of another mesh");
  if (!(key.settings == wanted.settings))
    return refuse(CacheState::other_settings, "is of other settings or radii");

  std::uint64_t block_bytes = 0;
  take(block_bytes);
  each_field(report_, take);
  const std::size_t n_frames = frames_in(block_bytes);
  std::uint64_t end = header.size();
  for (std::size_t i = 0; i < n_frames && take.has(1); i++) {
    Frame frame = {end, 0, {0, 0}};
    take(frame.bytes);
    take(frame.content);
    end += frame.bytes;
    frames_.push_back(frame);
  }
  if (!take.done()) return refuse(CacheState::damaged, "is damaged: its header is too short");
  if (end != file_bytes_)
    return refuse(CacheState::damaged, "is damaged: it has " + std::to_string(file_bytes_) +
                                           " bytes, " + std::to_string(end) + " were written");
  block_bytes_ = block_bytes;
  state_ = CacheState::usable;
}

bool CachedGrid::read_frame(const Frame &frame, std::vector<char> &packed, char *to,
                            std::size_t size) const
{
  return read_at(file_, frame.offset, packed.data(), frame.bytes) &&
         ZSTD_decompress(to, size, packed.data(), frame.bytes) == size &&
         hash_of(to, size) == frame.content;
}

bool CachedGrid::read(char *block)
{
  if (state_ != CacheState::usable) return false;
  std::size_t room = 0;
  for (const Frame &frame : frames_) room = std::max<std::size_t>(room, frame.bytes);
  const std::int64_t n = frames_.size(), at_once = threads();
  std::vector<std::vector<char>> packed(at_once, std::vector<char>(room));
  std::vector<char> good(n, 0);
  for (std::int64_t first = 0; first < n; first += at_once) {
    const std::int64_t last = std::min(n, first + at_once);
#pragma omp parallel for schedule(static, 1) num_threads(at_once) if (at_once > 1)
    for (std::int64_t i = first; i < last; i++)
      good[i] = read_frame(frames_[i], packed[i - first], block + i * kFrameBytes,
                           frame_size(i, block_bytes_));
    for (std::int64_t i = first; i < last; i++)
      if (!good[i]) {
        refuse(CacheState::damaged, "is damaged: part " + std::to_string(i + 1) + " of " +
                                        std::to_string(n) + " fails its checksum");
        return false;
      }
  }
  return true;
}

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
  WholeFile file(path);
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
