#include "robot/log/log_writer.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>

#include "base/output_file.h"
#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using std::chrono::seconds;

LogHead head_of() {
  return {.run = "run07",
          .robot = "rvr1",
          .machine = "m",
          .machine_digest = "d",
          .flavour = "watermelon",
          .turn_clock = "cycles",
          .max_mps = 0.35,
          .program = "p",
          .host = "h",
          .scheduling = "s"};
}

LogRow row_of(int cycle) {
  LogRow row;
  row.cycle = cycle;
  row.clock_s = 0.1 * cycle;
  return row;
}

TimePoint soon() {
  return SystemClock().now() + seconds(20);
}

TEST(LogWriter, WritesRowsWhileTheRunGoesOnAndTheEndAtItsEnd) {
  const TemporaryFolder folder;
  const LogFiles files = log_files_of(folder.path(), "run07", "rvr1");
  auto writer = value_of(LogWriter::open(files, head_of()));
  auto record = read_robot_log(files.head);
  ASSERT_TRUE(record) << "the head is there from the start";
  EXPECT_FALSE(record->head.end) << "as of a node that was killed";
  forget_input(files.head);  // who writes a log does not read it
  for (int cycle = 1; cycle <= 50; ++cycle)
    writer->add(row_of(cycle));
  LogHead head = head_of();
  head.end = RunEnd{.state = "ended", .stepped = 50};
  writer->finish(head);
  writer->wait_done(soon());
  ASSERT_TRUE(writer->is_done());
  EXPECT_EQ(writer->trouble(), "");
  record = read_robot_log(files.rows);
  ASSERT_TRUE(record);
  EXPECT_EQ(record->head, head);
  EXPECT_EQ(record->rows.size(), 50U);
}

TEST(LogWriter, WritesWhatIsThereWhenItGoes) {
  const TemporaryFolder folder;
  const LogFiles files = log_files_of(folder.path(), "run07", "rvr1");
  {
    auto writer = value_of(LogWriter::open(files, head_of()));
    writer->add(row_of(1));
  }
  EXPECT_EQ(read_robot_log(files.rows).value().rows.size(), 1U);
}

TEST(LogWriter, NeverWritesOverALogThatIsThere) {
  const TemporaryFolder folder;
  const LogFiles files = log_files_of(folder.path(), "run07", "rvr1");
  std::ofstream(files.head) << "precious";
  EXPECT_EQ(why_not(LogWriter::open(files, head_of())).kind, ErrorKind::Conflict);
  EXPECT_FALSE(std::filesystem::exists(files.rows));
  EXPECT_FALSE(LogWriter::open(log_files_of(folder / "no", "run07", "rvr1"), head_of()));
}

/// The disk of this process is full above so many bytes a file, for as long as it lives.
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes) {
    before_signal_ = std::signal(SIGXFSZ, SIG_IGN);
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit limit{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, before_signal_);
  }

 private:
  rlimit before_{};
  void (*before_signal_)(int) = SIG_DFL;
};

TEST(LogWriter, SaysWhenTheDiskIsFullAndGoesOnWhenThereIsRoom) {
  const TemporaryFolder folder;
  const LogFiles files = log_files_of(folder.path(), "run07", "rvr1");
  auto writer = value_of(LogWriter::open(files, head_of()));
  {
    const FullDisk full(2000);
    for (int cycle = 1; cycle <= 200; ++cycle)
      writer->add(row_of(cycle));
    while (writer->trouble().empty())
      writer->wait_done(SystemClock().now() + std::chrono::milliseconds(5));
    EXPECT_THAT(writer->trouble(), HasSubstr("large"));
  }
  LogHead head = head_of();
  head.end = RunEnd{.state = "ended", .stepped = 200};
  writer->finish(head);
  writer->wait_done(soon());
  EXPECT_EQ(writer->trouble(), "");
  EXPECT_EQ(read_robot_log(files.rows).value().rows.size(), 200U);
}

TEST(LogWriter, EndsWithTroubleWhenTheDiskStaysFull) {
  const TemporaryFolder folder;
  const LogFiles files = log_files_of(folder.path(), "run07", "rvr1");
  auto writer = value_of(LogWriter::open(files, head_of()));
  const FullDisk full(2000);
  for (int cycle = 1; cycle <= 200; ++cycle)
    writer->add(row_of(cycle));
  writer->finish(head_of());
  writer->wait_done(soon());
  EXPECT_TRUE(writer->is_done());
  EXPECT_THAT(writer->trouble(), HasSubstr("large"));
  EXPECT_LT(read_robot_log(files.rows).value().rows.size(), 200U) << "and what is there is whole";
}

}  // namespace
}  // namespace swarmsmith
