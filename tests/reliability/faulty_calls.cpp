// A library for LD_PRELOAD: a program's calls to the system fail as on a bad day. It stands between
// the program and the C library, so that the program is the one that people run.
//
//   SWARMSMITH_FAULT      what happens, one of
//     kill-before=CALL:N    SIGKILL instead of the N-th CALL (sync, write, send)
//     kill-after=CALL:N     SIGKILL right after it
//     power=N:SEED          the power goes at the N-th change of a store's file: what was synced
//                           stays, of the later writes any part; then SIGKILL
//     slow=FROM-TO:SEED     each sync takes so many milliseconds more
//   SWARMSMITH_FAULT_LOG  where the number of calls of each kind is written when the program ends
//
// Only files whose path has ".db" in it count as a store's.

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <algorithm>
#include <array>
#include <chrono>
#include <climits>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <map>
#include <mutex>
#include <random>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace {

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

ssize_t real_pwrite(int fd, const void* bytes, std::size_t size, off_t offset) {
  static auto* const function = real<ssize_t(int, const void*, std::size_t, off_t)>("pwrite64");
  return function(fd, bytes, size, offset);
}

int real_truncate(int fd, off_t size) {
  static auto* const function = real<int(int, off_t)>("ftruncate64");
  return function(fd, size);
}

/// A change of a file that is not synced yet, with what is needed to take it back.
struct Change {
  std::string path;
  off_t offset = 0;
  std::string before;  ///< what was there
  std::string after;   ///< what was written
  off_t size_before = 0;
  bool truncation = false;
};

enum class What { Nothing, KillBefore, KillAfter, Power, Slow };

class Faults {
 public:
  Faults() {
    const char* text = std::getenv("SWARMSMITH_FAULT");
    if (text == nullptr) return;
    std::array<char, 16> call{};
    unsigned seed = 0;
    if (std::sscanf(text, "kill-before=%15[a-z]:%ld", call.data(), &first_) == 2) {
      what_ = What::KillBefore;
    } else if (std::sscanf(text, "kill-after=%15[a-z]:%ld", call.data(), &first_) == 2) {
      what_ = What::KillAfter;
    } else if (std::sscanf(text, "power=%ld:%u", &first_, &seed) == 2) {
      what_ = What::Power;
    } else if (std::sscanf(text, "slow=%ld-%ld:%u", &first_, &last_, &seed) == 3) {
      what_ = What::Slow;
    } else {
      std::fprintf(stderr, "faulty_calls: cannot read SWARMSMITH_FAULT=%s\n", text);
      std::abort();
    }
    call_ = call.data();
    random_.seed(seed);
  }
  void write_log() {
    const std::unique_lock guard(mutex_);
    const char* path = std::getenv("SWARMSMITH_FAULT_LOG");
    std::FILE* file = path != nullptr ? std::fopen(path, "w") : nullptr;
    if (file == nullptr) return;
    for (const auto& [name, count] : counts_)
      std::fprintf(file, "%s %ld\n", name.c_str(), count);
    std::fclose(file);
  }

  /// Around a call of this kind; the lock keeps other changes out while one is made.
  template <class Call>
  auto around(const char* name, const Call& call) {
    const std::unique_lock guard(mutex_);
    const bool now = ++counts_[name] == first_ && call_ == name;
    if (now && what_ == What::KillBefore) die();
    const auto result = call();
    if (now && what_ == What::KillAfter) die();
    return result;
  }

  /// Before a change of a store's file.
  void change(Change change) {
    if (what_ != What::Power) return;
    const std::unique_lock guard(mutex_);
    if (++changes_ >= first_) {
      pending_.push_back(std::move(change));
      cut_power();
    }
    pending_.push_back(std::move(change));
  }

  void sync(const std::string& path) {
    if (what_ == What::Slow) {
      std::uniform_int_distribution<long> time(first_, last_);
      std::unique_lock guard(mutex_);
      const auto delay = std::chrono::milliseconds(time(random_));
      guard.unlock();
      std::this_thread::sleep_for(delay);
    }
    if (what_ != What::Power) return;
    const std::unique_lock guard(mutex_);
    if (++changes_ >= first_) cut_power();
    std::erase_if(pending_, [&](const Change& change) { return change.path == path; });
  }

  bool keeps_changes() const { return what_ == What::Power; }

 private:
  [[noreturn]] static void die() {
    kill(getpid(), SIGKILL);
    std::abort();
  }

  /// Back to what was synced, then any part of what came later, as a disk may have it.
  [[noreturn]] void cut_power() {
    for (auto change = pending_.rbegin(); change != pending_.rend(); ++change)
      take_back(*change);
    for (const Change& change : pending_) {
      if (random_() % 2 == 0) make(change);
    }
    die();
  }

  static void take_back(const Change& change) {
    const int fd = open(change.path.c_str(), O_RDWR | O_CLOEXEC);
    if (fd < 0) return;
    (void)!real_pwrite(fd, change.before.data(), change.before.size(), change.offset);
    (void)!real_truncate(fd, change.size_before);
    close(fd);
  }

  static void make(const Change& change) {
    const int fd = open(change.path.c_str(), O_RDWR | O_CLOEXEC);
    if (fd < 0) return;
    if (change.truncation) {
      (void)!real_truncate(fd, change.offset);
    } else {
      (void)!real_pwrite(fd, change.after.data(), change.after.size(), change.offset);
    }
    close(fd);
  }

  What what_ = What::Nothing;
  std::string call_;
  long first_ = 0, last_ = 0;
  std::mutex mutex_;
  std::mt19937 random_;
  std::map<std::string, long> counts_;
  long changes_ = 0;
  std::vector<Change> pending_;
};

/// Never destroyed: threads may still send when the program ends.
Faults& faults() {
  static auto* const it = new Faults;
  return *it;
}

/// The file's path if it is a store's, else nothing.
std::string store_path(int fd) {
  std::array<char, PATH_MAX> path{};
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  const ssize_t size = readlink(link.c_str(), path.data(), path.size() - 1);
  std::string text(path.data(), size > 0 ? static_cast<std::size_t>(size) : 0);
  return text.find(".db") == std::string::npos ? std::string() : text;
}

std::string bytes_of(int fd, off_t offset, off_t size) {
  std::string bytes(static_cast<std::size_t>(std::max<off_t>(size, 0)), '\0');
  const ssize_t got = pread(fd, bytes.data(), bytes.size(), offset);
  bytes.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  return bytes;
}

off_t size_of(int fd) {
  struct stat it {};
  return fstat(fd, &it) == 0 ? it.st_size : 0;
}

ssize_t faulty_pwrite(int fd, const void* bytes, std::size_t size, off_t offset) {
  const std::string path = store_path(fd);
  if (path.empty()) return real_pwrite(fd, bytes, size, offset);
  if (faults().keeps_changes()) {
    faults().change({.path = path,
                     .offset = offset,
                     .before = bytes_of(fd, offset, static_cast<off_t>(size)),
                     .after = std::string(static_cast<const char*>(bytes), size),
                     .size_before = size_of(fd)});
  }
  return faults().around("write", [&] { return real_pwrite(fd, bytes, size, offset); });
}

int faulty_truncate(int fd, off_t size) {
  const std::string path = store_path(fd);
  if (!path.empty() && faults().keeps_changes()) {
    const off_t before = size_of(fd);
    faults().change({.path = path,
                     .offset = size,
                     .before = bytes_of(fd, size, before - size),
                     .size_before = before,
                     .truncation = true});
  }
  return real_truncate(fd, size);
}

int faulty_sync(int fd, int (*call)(int)) {
  const std::string path = store_path(fd);
  if (path.empty()) return call(fd);
  faults().sync(path);
  return faults().around("sync", [&] { return call(fd); });
}

/// Counts from the start, so that a program that never comes to a call is seen in its log.
[[gnu::constructor]] void begin() {
  faults();
}
[[gnu::destructor]] void end() {
  faults().write_log();
}

}  // namespace

extern "C" {

ssize_t pwrite(int fd, const void* bytes, size_t size, off_t offset) {
  return faulty_pwrite(fd, bytes, size, offset);
}
ssize_t pwrite64(int fd, const void* bytes, size_t size, off64_t offset) {
  return faulty_pwrite(fd, bytes, size, offset);
}
int ftruncate(int fd, off_t size) noexcept {
  return faulty_truncate(fd, size);
}
int ftruncate64(int fd, off64_t size) noexcept {
  return faulty_truncate(fd, size);
}
int fsync(int fd) {
  static auto* const call = real<int(int)>("fsync");
  return faulty_sync(fd, call);
}
int fdatasync(int fd) {
  static auto* const call = real<int(int)>("fdatasync");
  return faulty_sync(fd, call);
}
ssize_t send(int fd, const void* bytes, size_t size, int flags) {
  static auto* const call = real<ssize_t(int, const void*, size_t, int)>("send");
  return faults().around("send", [&] { return call(fd, bytes, size, flags); });
}

}  // extern "C"
