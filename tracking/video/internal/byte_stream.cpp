#include "tracking/video/internal/byte_stream.h"

extern "C" {
#include <libavutil/mem.h>
}

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <system_error>

#include "base/output_file.h"
#include "tracking/rig/issue.h"

namespace swarmsmith::av {

struct ByteStream::State {
  AVIOContext* io = nullptr;
  int file = -1;           ///< file descriptor, or -1
  std::string_view bytes;  ///< if there is no file
  std::int64_t position = 0;
  std::int64_t size = 0;
  int error = 0;

  State() = default;
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    if (io != nullptr) av_freep(&io->buffer);
    avio_context_free(&io);
    if (file >= 0) ::close(file);
  }

  static int read(void* opaque, std::uint8_t* to, int most) {
    State& state = *static_cast<State*>(opaque);
    if (state.file < 0) {
      const std::int64_t left = state.size - state.position;
      const int count = static_cast<int>(std::clamp<std::int64_t>(left, 0, most));
      if (count == 0) return AVERROR_EOF;
      std::memcpy(to, state.bytes.data() + state.position, static_cast<std::size_t>(count));
      state.position += count;
      return count;
    }
    ssize_t count = 0;
    do {
      count = ::pread(state.file, to, static_cast<std::size_t>(most), state.position);
    } while (count < 0 && errno == EINTR);
    if (count < 0) return AVERROR(errno);
    if (count == 0) return AVERROR_EOF;
    state.position += count;
    return static_cast<int>(count);
  }

  static int write(void* opaque, av::WrittenBytes from, int count) {
    State& state = *static_cast<State*>(opaque);
    for (int done = 0; done < count;) {
      const ssize_t written =
          ::pwrite(state.file, from + done, static_cast<std::size_t>(count - done), state.position);
      if (written < 0 && errno == EINTR) continue;
      if (written < 0) {
        if (state.error == 0) state.error = errno;
        return AVERROR(errno);
      }
      done += static_cast<int>(written);
      state.position += written;
      state.size = std::max(state.size, state.position);
    }
    return count;
  }

  static std::int64_t seek(void* opaque, std::int64_t offset, int whence) {
    State& state = *static_cast<State*>(opaque);
    whence &= ~AVSEEK_FORCE;
    if (whence == AVSEEK_SIZE) return state.size;
    const std::int64_t base = whence == SEEK_CUR   ? state.position
                              : whence == SEEK_END ? state.size
                                                   : 0;
    // Offsets may come from damaged files.
    if (offset > INT64_MAX / 2 || base + offset < 0) return AVERROR(EINVAL);
    state.position = base + offset;
    return state.position;
  }

  void make_io(bool writes) {
    constexpr int kBuffer = 1 << 16;
    auto* buffer = static_cast<unsigned char*>(av_malloc(kBuffer));
    io = avio_alloc_context(buffer, kBuffer, writes ? 1 : 0, this, writes ? nullptr : read,
                            writes ? write : nullptr, seek);
  }
};

ByteStream::ByteStream(std::unique_ptr<State> state) : state_(std::move(state)) {}
ByteStream::ByteStream(ByteStream&&) noexcept = default;
ByteStream& ByteStream::operator=(ByteStream&&) noexcept = default;
ByteStream::~ByteStream() = default;

Expected<ByteStream> ByteStream::reading(const std::string& path) {
  auto state = std::make_unique<State>();
  struct stat about {};
  if (::stat(path.c_str(), &about) == 0 && !S_ISREG(about.st_mode) && !S_ISDIR(about.st_mode)) {
    return Unexpected(error_of(IssueCode::VideoUnreadable,
                               "is a pipe or a device, but a video is read more than once; write "
                               "it to a file first",
                               path));
  }
  state->file = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (state->file < 0 || ::fstat(state->file, &about) != 0) {
    return Unexpected(error_of(IssueCode::VideoUnreadable,
                               "cannot be opened: " + std::generic_category().message(errno),
                               path));
  }
  note_input(path);
  state->size = about.st_size;
  state->make_io(false);
  return ByteStream(std::move(state));
}

ByteStream ByteStream::over(std::string_view bytes) {
  auto state = std::make_unique<State>();
  state->bytes = bytes;
  state->size = static_cast<std::int64_t>(bytes.size());
  state->make_io(false);
  return ByteStream(std::move(state));
}

Expected<ByteStream> ByteStream::writing(const std::string& path) {
  auto state = std::make_unique<State>();
  constexpr int kMode = 0644;
  state->file = ::open(path.c_str(), O_RDWR | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (state->file < 0) {
    return unexpected(ErrorKind::Unavailable,
                      "cannot be written: " + std::generic_category().message(errno), path);
  }
  state->make_io(true);
  return ByteStream(std::move(state));
}

AVIOContext* ByteStream::io() const {
  return state_->io;
}

std::int64_t ByteStream::size() const {
  return state_->size;
}

int ByteStream::failed_with() const {
  return state_->error;
}

int ByteStream::close_after_writing() {
  avio_flush(state_->io);
  if (state_->error != 0) return state_->error;
  if (::fsync(state_->file) != 0 && errno != EINVAL && errno != EROFS) return errno;
  const int closed = ::close(state_->file);
  state_->file = -1;
  return closed == 0 ? 0 : errno;
}

}  // namespace swarmsmith::av
