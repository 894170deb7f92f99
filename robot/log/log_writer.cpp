#include "robot/log/log_writer.h"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <iterator>
#include <system_error>
#include <utility>

#include "base/output_file.h"
#include "base/text/whole_file.h"
#include "robot/log/log_text.h"

namespace swarmsmith {
namespace {

constexpr auto kFlushEvery = std::chrono::seconds(1);

Expected<void> must_not_exist(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::exists(std::filesystem::symlink_status(file, ignored))) return {};
  return unexpected(ErrorKind::Conflict,
                    "already exists, from an earlier run; give the run another name",
                    file.string());
}

}  // namespace

Expected<std::unique_ptr<LogWriter>> LogWriter::open(const LogFiles& files, const LogHead& head) {
  for (const auto& file : {files.rows, files.head}) {
    if (const auto right = must_not_exist(file); !right) return Unexpected(right.error());
  }
  const int descriptor =
      ::open(files.rows.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0666);
  if (descriptor < 0) return Unexpected(cannot_write(files.rows.string()));
  std::unique_ptr<LogWriter> writer(new LogWriter(files, descriptor));
  writer->bytes_ = log_columns();
  Expected<void> written;
  if (!writer->write_out()) {
    written = unexpected(ErrorKind::Unavailable, writer->trouble_, files.rows.string());
  } else {
    written = write_whole_file(files.head.string(), log_head_text(head));
  }
  if (!written) {
    std::error_code ignored;
    std::filesystem::remove(files.rows, ignored);
    return Unexpected(written.error());
  }
  writer->thread_ = std::thread([raw = writer.get()] { raw->run(); });
  return writer;
}

LogWriter::LogWriter(LogFiles files, int descriptor)
    : files_(std::move(files)), descriptor_(descriptor) {}

LogWriter::~LogWriter() {
  {
    const std::lock_guard lock(mutex_);
    std::move(added_.begin(), added_.end(), std::back_inserter(rows_));
    finishing_ = true;
  }
  wake_.notify_one();
  if (thread_.joinable()) thread_.join();
  ::close(descriptor_);
}

void LogWriter::add(LogRow row) {
  added_.push_back(std::move(row));
  // The writing thread holds the lock only briefly, but may be suspended meanwhile.
  std::unique_lock lock(mutex_, std::try_to_lock);
  if (!lock.owns_lock()) return;
  std::move(added_.begin(), added_.end(), std::back_inserter(rows_));
  added_.clear();
}

void LogWriter::finish(const LogHead& head) {
  {
    const std::lock_guard lock(mutex_);
    std::move(added_.begin(), added_.end(), std::back_inserter(rows_));
    added_.clear();
    end_ = log_head_text(head);
    finishing_ = true;
  }
  wake_.notify_one();
}

bool LogWriter::is_done() const {
  const std::lock_guard lock(mutex_);
  return done_;
}

void LogWriter::wait_done(TimePoint until) {
  std::unique_lock lock(mutex_);
  ended_.wait_until(lock, until, [this] { return done_; });
}

std::string LogWriter::trouble() const {
  const std::lock_guard lock(mutex_);
  return trouble_;
}

bool LogWriter::write_out() {
  std::string trouble;
  while (!bytes_.empty()) {
    const ssize_t written = ::write(descriptor_, bytes_.data(), bytes_.size());
    if (written > 0) {
      bytes_.erase(0, static_cast<std::size_t>(written));
    } else if (errno != EINTR) {
      // The rest stays in `bytes_`; the next round tries to write it again.
      trouble = cannot_write(files_.rows.string()).message;
      break;
    }
  }
  if (trouble.empty() && ::fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    trouble = cannot_write(files_.rows.string()).message;
  const std::lock_guard lock(mutex_);
  trouble_ = trouble;
  return trouble.empty();
}

void LogWriter::run() {
  bool finishing = false;
  std::string end;
  while (!finishing) {
    std::vector<LogRow> rows;
    {
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, kFlushEvery, [this] { return finishing_; });
      rows.swap(rows_);
      finishing = finishing_;
      end = end_;
    }
    for (const LogRow& row : rows)
      bytes_ += log_line(row);
    write_out();
  }
  std::string trouble;
  if (!end.empty()) {
    if (const auto written = write_whole_file(files_.head.string(), end); !written)
      trouble = written.error().message;
  }
  const std::lock_guard lock(mutex_);
  if (!trouble.empty()) trouble_ = trouble;
  done_ = true;
  ended_.notify_all();
}

}  // namespace swarmsmith
