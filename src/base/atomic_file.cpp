// SPDX-FileCopyrightText: 2026 LSDCD contributors
// SPDX-License-Identifier: BSD-3-Clause

#include "base/atomic_file.h"

#include "base/input_error.h"

#include <cerrno>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

namespace lsdcd {

namespace {

constexpr int kNameTries = 16;

std::string directory_of(const std::string &path)
{
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? "." : path.substr(0, slash + 1);
}

}    // namespace

AtomicFile::AtomicFile(const std::string &path) : path_(path)
{
  // Replacing a device or a pipe, even /dev/null, would remove it from the system.
  struct stat there;
  if (stat(path.c_str(), &there) == 0 && !S_ISREG(there.st_mode))
    throw InputError("'" + path + "' is not a regular file; give the name of a file, new or old");
  // If it is a link, the file that it leads to is replaced.
  std::error_code not_there;
  const auto target = std::filesystem::canonical(path, not_there);
  if (!not_there) path_ = target.string();

  // The process and the clock make the name unique; the flags guarantee it.
  for (int i = 0; i < kNameTries && file_ < 0; i++) {
    char tail[64];
    const auto now = std::chrono::system_clock::now().time_since_epoch().count();
    std::snprintf(tail, sizeof tail, ".part-%ld-%llx", static_cast<long>(getpid()),
                  static_cast<unsigned long long>(now));
    temporary_ = path_ + tail;
    file_ = open(temporary_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (file_ < 0 && errno != EEXIST) break;
  }
  if (file_ < 0) fail("cannot make a file there");
}

AtomicFile::~AtomicFile()
{
  if (file_ < 0) return;
  close(file_);
  unlink(temporary_.c_str());
}

void AtomicFile::write_at(std::uint64_t offset, const void *data, std::size_t bytes)
{
  const char *from = static_cast<const char *>(data);
  while (bytes > 0) {
    const ssize_t n = pwrite(file_, from, bytes, static_cast<off_t>(offset));
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) fail("cannot write");
    from += n;
    offset += n;
    bytes -= n;
  }
}

void AtomicFile::commit()
{
  if (fsync(file_) != 0) fail("cannot write");
  if (rename(temporary_.c_str(), path_.c_str()) != 0) fail("cannot put the file in place");
  close(file_);
  file_ = -1;
  // The new name should survive a crash, too; else the old file is there.
  const int directory = open(directory_of(path_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) return;
  fsync(directory);
  close(directory);
}

void AtomicFile::fail(const char *what) const
{
  throw InputError("'" + path_ + "': " + what + ": " + std::strerror(errno));
}

void write_whole_file(const std::string &path, const std::string &bytes)
{
  AtomicFile file(path);
  file.write_at(0, bytes.data(), bytes.size());
  file.commit();
}

}    // namespace lsdcd
