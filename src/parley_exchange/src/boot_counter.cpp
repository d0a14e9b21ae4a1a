// SPDX-License-Identifier: BSD-3-Clause
#include "parley_exchange/boot_counter.h"

#include <fcntl.h>
#include <sodium.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace parley {
namespace {

constexpr std::uint32_t kMaxStarts = (1U << 20) - 1;  // [-]

[[noreturn]] void refuse(const std::string& path, const std::string& reason) {
  throw std::invalid_argument(path + ": " + reason);
}

[[noreturn]] void refuseBySystem(const std::string& path, const std::string& what) {
  refuse(path, what + ": " + std::strerror(errno));
}

std::uint32_t readStarts(const std::string& path) {
  std::ifstream file(path);
  if (!file) {
    if (errno == ENOENT) return 0;
    refuseBySystem(path, "cannot read the boot counter");
  }
  std::string text, more;
  if (!(file >> text) || file >> more || text.size() > 7 || text.find_first_not_of("0123456789") != std::string::npos) {
    refuse(path,
           "holds no boot counter. A robot that starts again from zero is refused by its team; restore the file, or "
           "write a number above the last");
  }
  const auto starts = static_cast<std::uint32_t>(std::stoul(text));
  if (starts >= kMaxStarts) refuse(path, "the boot counter is used up; give the team a new key and remove the file");
  return starts;
}

void writeAll(int descriptor, const std::string& text, const std::string& path) {
  const bool written =
      ::write(descriptor, text.data(), text.size()) == static_cast<ssize_t>(text.size()) && ::fsync(descriptor) == 0;
  const int reason = errno;
  ::close(descriptor);
  errno = reason;
  if (!written) refuseBySystem(path, "cannot write the boot counter");
}

void replace(const std::string& path, const std::string& text) {
  const std::string fresh = path + ".new";
  const int descriptor = ::open(fresh.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) refuseBySystem(fresh, "cannot write the boot counter");
  writeAll(descriptor, text, fresh);
  if (std::rename(fresh.c_str(), path.c_str()) != 0) refuseBySystem(path, "cannot replace the boot counter");
  const std::size_t slash = path.rfind('/');
  const std::string folder = slash == std::string::npos ? "." : path.substr(0, slash + 1);
  const int directory = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (directory < 0) refuseBySystem(folder, "cannot open the folder of the boot counter");
  ::fsync(directory);
  ::close(directory);
}

}  // namespace

std::uint32_t nextBoot(const std::string& path) {
  if (sodium_init() < 0) refuse(path, "libsodium cannot start on this machine");
  const std::uint32_t starts = readStarts(path) + 1;
  replace(path, std::to_string(starts) + "\n");
  return (starts << 12) | (randombytes_random() & 0xfffU);
}

}  // namespace parley
