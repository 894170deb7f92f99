#include "proto/access/secret_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <cerrno>
#include <cstring>

namespace swarmsmith {
namespace {

constexpr std::size_t kMostBytes = 1U << 20U;

/// A descriptor that the destructor closes.
class Descriptor {
 public:
  explicit Descriptor(int number) : number_(number) {}
  ~Descriptor() {
    if (number_ >= 0) ::close(number_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  int number() const { return number_; }

 private:
  int number_;
};

std::string reason() {
  return std::strerror(errno);
}

/// Why other users could use the file; empty if they cannot.
std::string objection_to(const struct stat& status, const std::filesystem::path& file,
                         Privacy privacy) {
  if (!S_ISREG(status.st_mode)) return "this is not a file";
  if (privacy == Privacy::Secret) {
    if (status.st_uid != geteuid()) {
      return "the file belongs to another user (id " + std::to_string(status.st_uid) +
             "); change its owner: chown " + std::to_string(geteuid()) + " " + file.string();
    }
    if ((status.st_mode & 077U) != 0) {
      return "other users can read this secret; forbid it: chmod 600 " + file.string();
    }
    return "";
  }
  // A file of root is as safe as a file of this user.
  if (status.st_uid != geteuid() && status.st_uid != 0) {
    return "the file belongs to another user (id " + std::to_string(status.st_uid) +
           "), who could let anyone connect; change its owner: chown " + std::to_string(geteuid()) +
           " " + file.string();
  }
  if ((status.st_mode & 022U) != 0) {
    return "other users can change this file; forbid it: chmod go-w " + file.string();
  }
  return "";
}

/// Writes the whole text; false, with errno set, when the system refuses.
bool write_all(int descriptor, std::string_view text) {
  while (!text.empty()) {
    const ssize_t written = ::write(descriptor, text.data(), text.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) return false;
    text.remove_prefix(static_cast<std::size_t>(written));
  }
  return fsync(descriptor) == 0;
}

}  // namespace

Expected<std::string> read_private_file(const std::filesystem::path& file, const std::string& what,
                                        Privacy privacy) {
  // O_NONBLOCK: do not wait for the other end of a pipe.
  const Descriptor opened(::open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK));
  if (opened.number() < 0) {
    const bool missing = errno == ENOENT || errno == ENOTDIR;
    return unexpected(
        missing ? ErrorKind::NotFound : ErrorKind::BadInput,
        missing ? "there is no such " + what : "the " + what + " cannot be read: " + reason(),
        file.string());
  }
  struct stat status = {};
  if (fstat(opened.number(), &status) != 0) return bad_input(reason(), file.string());
  const std::string objection = objection_to(status, file, privacy);
  if (!objection.empty()) return bad_input(objection, file.string());
  std::string bytes(kMostBytes + 1, '\0');
  std::size_t size = 0;
  while (size < bytes.size()) {
    const ssize_t got = ::read(opened.number(), bytes.data() + size, bytes.size() - size);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) return bad_input("the " + what + " cannot be read: " + reason(), file.string());
    if (got == 0) break;
    size += static_cast<std::size_t>(got);
  }
  if (size > kMostBytes) return bad_input("the file is larger than 1 MB", file.string());
  bytes.resize(size);
  return bytes;
}

Expected<void> write_new_file(const std::filesystem::path& file, std::string_view text) {
  const Descriptor made(
      ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0600));
  if (made.number() < 0) {
    if (errno == EEXIST) {
      return unexpected(ErrorKind::Conflict, "already exists, and keys are never overwritten",
                        file.string());
    }
    return unexpected(ErrorKind::Unavailable, "cannot be made: " + reason(), file.string());
  }
  if (!write_all(made.number(), text)) {
    const std::string why = reason();
    ::unlink(file.c_str());
    return unexpected(ErrorKind::Unavailable, "cannot be written: " + why, file.string());
  }
  return {};
}

Expected<void> replace_file(const std::filesystem::path& file, std::string_view text,
                            unsigned mode) {
  std::string name = file.string() + ".XXXXXX";
  const Descriptor made(::mkostemp(name.data(), O_CLOEXEC));
  if (made.number() < 0) {
    return unexpected(ErrorKind::Unavailable, "cannot be written: " + reason(), file.string());
  }
  if (fchmod(made.number(), mode) != 0 || !write_all(made.number(), text) ||
      ::rename(name.c_str(), file.c_str()) != 0) {
    const std::string why = reason();
    ::unlink(name.c_str());
    return unexpected(ErrorKind::Unavailable, "cannot be written: " + why, file.string());
  }
  return {};
}

}  // namespace swarmsmith
