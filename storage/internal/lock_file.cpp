#include "storage/internal/lock_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <thread>
#include <utility>

#include <fmt/format.h>

#include "storage/store.h"

namespace swarmsmith {
namespace {

std::string read_holder(int descriptor) {
  std::array<char, 300> text{};
  const ssize_t size = ::pread(descriptor, text.data(), text.size(), 0);
  std::string holder(text.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  while (!holder.empty() && holder.back() == '\n')
    holder.pop_back();
  return holder;
}

std::string host_name() {
  std::array<char, 256> name{};
  return ::gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "unknown";
}

}  // namespace

std::string holder_text(const std::string& pid) {
  return fmt::format("pid={} host={}", pid, host_name());
}

std::string in_use_text(const std::string& holder) {
  return fmt::format(
      "another process is writing this store ({}); wait for it to end or stop it, or read with a "
      "read-only command",
      holder.empty() ? "its name is unknown" : holder);
}

namespace {

/// Users who may read the store may know who is writing it. Other users must not be able to open
/// the lock file, since anyone who can open it can hold the lock.
mode_t mode_of(const std::filesystem::path& store) {
  struct stat facts {};
  return ::stat(store.c_str(), &facts) == 0 ? facts.st_mode & 0666U : 0600U;
}

/// Whether the path still names the file that was opened: its last holder may have removed it
/// between our open and our lock.
bool still_there(int descriptor, const std::filesystem::path& path) {
  struct stat opened {};
  struct stat named {};
  return ::fstat(descriptor, &opened) == 0 && ::stat(path.c_str(), &named) == 0 &&
         opened.st_ino == named.st_ino && opened.st_dev == named.st_dev;
}

}  // namespace

Expected<LockFile> LockFile::acquire(const std::filesystem::path& store,
                                     std::chrono::milliseconds patience) {
  constexpr std::chrono::milliseconds kLookAgain{20};
  const std::filesystem::path path = store.string() + ".lock";
  const auto deadline = std::chrono::steady_clock::now() + patience;
  while (true) {
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, mode_of(store));
    if (descriptor < 0) {
      return bad_input(fmt::format("cannot make the lock file: {}; a store can only be written in "
                                   "a folder where files can be made",
                                   std::strerror(errno)),
                       path.string());
    }
    if (::flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
      const std::string holder = read_holder(descriptor);
      ::close(descriptor);
      if (std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(kLookAgain);
        continue;
      }
      return unexpected(ErrorKind::Conflict, in_use_text(holder), store.string());
    }
    if (!still_there(descriptor, path)) {
      ::close(descriptor);
      continue;
    }
    const bool left_behind = !read_holder(descriptor).empty();
    const std::string holder = holder_text(std::to_string(::getpid())) + "\n";
    // The text is only for users: if the disk is so full that this fails, the store can still be
    // opened.
    if (::ftruncate(descriptor, 0) != 0 ||
        ::pwrite(descriptor, holder.data(), holder.size(), 0) < 0) {
      return LockFile(path, descriptor, true);
    }
    return LockFile(path, descriptor, left_behind);
  }
}

LockFile::LockFile(LockFile&& other) noexcept
    : path_(std::move(other.path_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      left_behind_(other.left_behind_),
      suspect_(other.suspect_) {}

LockFile::~LockFile() {
  if (descriptor_ < 0) return;
  if (!suspect_) ::unlink(path_.c_str());
  ::close(descriptor_);
}

bool has_writer(const std::filesystem::path& named) {
  const int descriptor =
      ::open((real_store(named).string() + ".lock").c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const std::string holder = read_holder(descriptor);
  ::close(descriptor);
  constexpr std::string_view kProcess = "pid=";
  if (!holder.starts_with(kProcess)) return false;
  const std::string pid = holder.substr(kProcess.size(), holder.find(' ') - kProcess.size());
  if (holder != holder_text(pid)) return true;
  const auto number = static_cast<pid_t>(std::strtol(pid.c_str(), nullptr, 10));
  return number > 0 && (::kill(number, 0) == 0 || errno == EPERM);
}

}  // namespace swarmsmith
