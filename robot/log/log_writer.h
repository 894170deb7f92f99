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

/// Writes the log of one run every second in its own thread, so that adding a row never waits for
/// the disk. Rows that cannot be written are kept and tried again.
class LogWriter {
 public:
  /// Creates both files. Conflict: one of them exists. Unavailable: they cannot be created.
  static Expected<std::unique_ptr<LogWriter>> open(const LogFiles& files, const LogHead& head);
  /// Tries once more to write the remaining rows, and waits for that.
  ~LogWriter();
  LogWriter(const LogWriter&) = delete;
  LogWriter& operator=(const LogWriter&) = delete;

  /// Call it from one thread only.
  void add(LogRow row);
  /// Ends the rows, and gives the head its end. Does not wait.
  void finish(const LogHead& head);
  /// After `finish`: whether writing is over, either completely or as far as possible.
  bool is_done() const;
  /// Waits for that, at most until then.
  void wait_done(TimePoint until);
  /// The reason why the last rows could not be written; empty: they were written.
  std::string trouble() const;

 private:
  LogWriter(LogFiles files, int descriptor);
  void run();
  /// Returns whether all rows are in the file.
  bool write_out();

  const LogFiles files_;
  const int descriptor_;
  std::vector<LogRow> added_;  ///< of the adding thread: rows not yet passed on
  std::string bytes_;          ///< of the writing thread: text not yet written

  mutable std::mutex mutex_;
  std::condition_variable wake_;
  std::condition_variable ended_;
  std::vector<LogRow> rows_;
  std::string end_;  ///< the final text of the head
  bool finishing_ = false;
  bool done_ = false;
  std::string trouble_;

  std::thread thread_;
};

}  // namespace swarmsmith
