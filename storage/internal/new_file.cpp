#include "storage/internal/new_file.h"

#include <fcntl.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "storage/internal/file_checks.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

Unexpected taken(const fs::path& path) {
  return bad_input("there is a file of that name, and nothing is overwritten; name another",
                   path.string());
}

/// Makes what was done to the file or folder outlive a power cut, as far as the system can.
void sync(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  ::fsync(descriptor);
  ::close(descriptor);
}

}  // namespace

Expected<NewFile> NewFile::beside(const fs::path& wanted) {
  if (auto folder = check_folder(wanted); !folder) return Unexpected(folder.error());
  std::error_code trouble;
  if (fs::exists(fs::symlink_status(wanted, trouble))) return taken(wanted);
  NewFile file(wanted, fmt::format("{}.part-{}", wanted.string(), ::getpid()));
  file.remove();  // of a process of that number, which was killed
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
    // Some file systems do not know the flag.
    const bool knows_not = errno == EINVAL || errno == ENOSYS;
    if (knows_not && fs::exists(wanted_)) return taken(wanted_);
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
