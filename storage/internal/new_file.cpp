#include "storage/internal/new_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

Unexpected taken(const fs::path& path) {
  return bad_input("a file with this name exists, and nothing is overwritten; choose another name",
                   path.string());
}

/// Makes changes of the file or folder survive a power cut, as far as the system allows.
void sync(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

/// Whether `number` is the id of a process that no longer exists on this host. A part file of
/// another host can only be on a shared file system, which check_folder refuses.
bool is_of_the_dead(const std::string& number) {
  if (number.empty() || number.find_first_not_of("0123456789") != std::string::npos) return false;
  const auto pid = static_cast<pid_t>(std::strtol(number.c_str(), nullptr, 10));
  return pid > 0 && ::kill(pid, 0) != 0 && errno == ESRCH;
}

/// Removes what killed processes have left of files with this name: "NAME.part-PID", and all files
/// whose names begin in this way ("-wal", ".store-2.part-PID").
void clear_left_behind(const fs::path& wanted) {
  const std::string beginning = wanted.filename().string() + ".part-";
  std::error_code trouble;
  const fs::path folder = wanted.parent_path().empty() ? fs::path(".") : wanted.parent_path();
  std::vector<fs::path> left;
  for (fs::directory_iterator entry(folder, trouble), end; !trouble && entry != end;
       entry.increment(trouble)) {
    const std::string name = entry->path().filename().string();
    if (!name.starts_with(beginning)) continue;
    const std::string rest = name.substr(beginning.size());
    const std::string number = rest.substr(0, rest.find_first_of("-."));
    if (is_of_the_dead(number)) left.push_back(entry->path());
  }
  for (const fs::path& part : left)
    fs::remove(part, trouble);
}

}  // namespace

Expected<NewFile> NewFile::beside(const fs::path& wanted) {
  if (auto folder = check_folder(wanted); !folder) return Unexpected(folder.error());
  std::error_code trouble;
  if (fs::exists(fs::symlink_status(wanted, trouble))) return taken(wanted);
  clear_left_behind(wanted);
  NewFile file(wanted, fmt::format("{}.part-{}", wanted.string(), ::getpid()));
  file.remove();  // left by a killed process with the same id
  return file;
}

NewFile::NewFile(NewFile&& other) noexcept
    : wanted_(std::move(other.wanted_)), part_(std::exchange(other.part_, {})) {}

NewFile::~NewFile() {
  if (!part_.empty()) remove();
}

void NewFile::remove() {
  std::error_code ignored;
  for (const char* ending : {"", "-wal", "-shm", "-journal"})
    fs::remove(part_.string() + ending, ignored);
}

Expected<void> NewFile::publish() {
  sync(part_);
  if (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, wanted_.c_str(), RENAME_NOREPLACE) != 0) {
    if (errno == EEXIST) return taken(wanted_);
    // Some file systems do not support the flag.
    const bool knows_not = errno == EINVAL || errno == ENOSYS;
    if (std::error_code none; knows_not && fs::exists(wanted_, none)) return taken(wanted_);
    if (!knows_not || ::rename(part_.c_str(), wanted_.c_str()) != 0) {
      return unexpected(ErrorKind::Unavailable,
                        fmt::format("cannot be made: {}", std::strerror(errno)), wanted_.string());
    }
  }
  sync(wanted_.parent_path().empty() ? fs::path(".") : wanted_.parent_path());
  std::error_code ignored;
  for (const char* ending : {"-wal", "-shm", "-journal"})
    fs::remove(part_.string() + ending, ignored);
  part_.clear();
  return {};
}

}  // namespace swarmsmith
