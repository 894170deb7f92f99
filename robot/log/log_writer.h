#pragma once

#include <condition_variable>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "base/clock.h"
#include "base/expected.h"
#include "robot/log/log_file.h"

namespace swarmsmith {

/// Writes the log of one run from a thread of its own, each second: adding a row never waits
/// for the disk. What cannot be written is kept and tried again.
class LogWriter {
 public:
  /// Makes both files. Conflict: one of them exists. Unavailable: they cannot be made.
  static Expected<std::unique_ptr<LogWriter>> open(const LogFiles& files, const LogHead& head);
  /// Writes what is there, once, and waits for that.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// By one thread.
  void add(LogRow row);
  /// There are no more rows; the head gets its end. Does not wait.
  void finish(const LogHead& head);
  /// After `finish`: nothing is written any more, all of it or what could be.
  bool is_done() const;
  /// Waits for that, until then at most.
  void wait_done(TimePoint until);
  /// Why the last rows could not be written; empty: they were.
  std::string trouble() const;

 private:
  LogWriter(LogFiles files, int descriptor);
  void run();
  /// Whether all of it is in the file.
  bool write_out();

  const LogFiles files_;
  const int descriptor_;
  std::vector<LogRow> added_;  ///< of the adding thread, while it could not pass them on
  std::string bytes_;          ///< of the writing thread: not written yet

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable ended_;
  std::vector<LogRow> rows_;
  std::string end_;  ///< the head's last text
  bool finishing_ = false;
  bool done_ = false;
  std::string trouble_;

  std::thread thread_;
};

}  // namespace swarmsmith
