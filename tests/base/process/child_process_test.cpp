#include "base/process/child_process.h"

#include <gmock/gmock.h>
#include <sys/wait.h>
#include <csignal>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Streams = ChildProcess::Streams;

/// How it ended, within a minute.
int end_of(ChildProcess& child) {
  const TimePoint until = SystemClock().now() + seconds(60);
  while (SystemClock().now() < until) {
    child.last_line();
    if (const auto status = child.ended()) return *status;
    std::this_thread::yield();
  }
  ADD_FAILURE() << "it never ended";
  return -1;
}

TEST(ChildProcess, IsHeldByItsInput) {
  ChildProcess child;
  ASSERT_TRUE(
      child.start({"sh", "-c", "cat >/dev/null; echo out; echo last >&2; exit 3"}, Streams::Held));
  EXPECT_TRUE(child.runs());
  EXPECT_FALSE(child.ended());
  child.end_input();
  const int status = end_of(child);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 3);
  EXPECT_FALSE(child.runs());
  EXPECT_EQ(child.last_line(), "last");
}

TEST(ChildProcess, DoesNotHoldTheInputOfAnother) {
  ChildProcess first;
  ChildProcess second;
  ASSERT_TRUE(first.start({"cat"}, Streams::Held));
  ASSERT_TRUE(second.start({"cat"}, Streams::Held));
  first.end_input();
  EXPECT_EQ(end_of(first), 0);
  EXPECT_TRUE(second.runs());
  second.signal(SIGTERM);
  EXPECT_TRUE(WIFSIGNALED(end_of(second)));
}

TEST(ChildProcess, MayWriteAsMuchAsItLikes) {
  ChildProcess child;
  ASSERT_TRUE(child.start({"sh", "-c", "yes | head -c 1000000 >&2; echo end >&2"}, Streams::Held));
  EXPECT_EQ(end_of(child), 0);
  EXPECT_EQ(child.last_line(), "end");
}

TEST(ChildProcess, LosesNoLineOfManyNorALastOneWithoutAnEnd) {
  ChildProcess child;
  ASSERT_TRUE(child.start({"sh", "-c", "seq 1 2000; printf end"}, Streams::Held));
  // All lines wait in the pipe.
  std::optional<int> status;
  const TimePoint until = SystemClock().now() + seconds(60);
  while (!(status = child.ended()) && SystemClock().now() < until)
    std::this_thread::yield();
  EXPECT_EQ(status, 0);
  const std::vector<std::string> lines = child.take_lines();
  ASSERT_EQ(lines.size(), 2001U);
  EXPECT_EQ(lines[1999], "2000");
  EXPECT_EQ(lines[2000], "end");
  EXPECT_EQ(child.last_line(), "end");
}

TEST(ChildProcess, IsKilledWhenItDoesNotEndInTime) {
  ChildProcess child;
  ASSERT_TRUE(child.start({"sh", "-c", "trap '' TERM; while :; do sleep 1; done"}, Streams::Held));
  const pid_t pid = child.pid();
  child.signal(SIGTERM);
  child.finish_by(SystemClock().now() + milliseconds(50));
  EXPECT_FALSE(child.runs());
  EXPECT_EQ(kill(pid, 0), -1);
}

TEST(ChildProcess, IsKilledWithThoseThatItStarted) {
  ChildProcess child;
  ASSERT_TRUE(child.start({"sh", "-c", "sleep 1000 | sleep 1000"}, Streams::Held));
  const pid_t group = child.pid();
  child.finish_by({});
  const TimePoint until = SystemClock().now() + seconds(60);
  while (kill(-group, 0) == 0 && SystemClock().now() < until)
    std::this_thread::yield();
  EXPECT_EQ(kill(-group, 0), -1);
  kill(-group, SIGKILL);
}

TEST(ChildProcess, ThatCannotBeStartedSaysWhy) {
  ChildProcess child;
  const auto started = child.start({"/nonexistent/program"}, Streams::Held);
  ASSERT_FALSE(started);
  EXPECT_EQ(to_string(started.error()),
            "/nonexistent/program: cannot be started: No such file or directory");
  EXPECT_FALSE(child.runs());
  EXPECT_TRUE(child.start({"true"}, Streams::Inherited));
  EXPECT_EQ(end_of(child), 0);
}

TEST(Backoff, GrowsWithJitterAndStartsAnew) {
  Backoff one(seconds(1), seconds(8), Rng(1));
  Backoff other(seconds(1), seconds(8), Rng(2));
  bool differ = false;
  for (const int expected : {1, 2, 4, 8, 8}) {
    const Duration pause = one.next();
    EXPECT_GE(pause, 0.75 * seconds(expected));
    EXPECT_LE(pause, 1.25 * seconds(expected));
    differ = differ || pause != other.next();
  }
  EXPECT_TRUE(differ);
  one.reset();
  EXPECT_LE(one.next(), 1.25 * seconds(1));
}

}  // namespace
}  // namespace swarmsmith
