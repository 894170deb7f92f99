#include "base/process/process.h"

#include <dirent.h>
#include <sys/wait.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <thread>

#include "base/process/guard.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const std::string kHostile = std::string(SWARMSMITH_BIN_DIR) + "/hostile_program";

ProcessCall hostile(std::vector<std::string> words) {
  words.insert(words.begin(), kHostile);
  return {
      .words = std::move(words), .term_grace = milliseconds(50), .pipe_grace = milliseconds(50)};
}

/// Gone, or about to be reaped by its parent of now.
bool is_dead(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string text;
  if (!std::getline(stat, text)) return true;
  return text.find(") Z") != std::string::npos;
}

std::size_t open_descriptors() {
  const auto folder = std::filesystem::directory_iterator("/proc/self/fd");
  return static_cast<std::size_t>(std::distance(begin(folder), end(folder)));
}

class Programs : public ::testing::Test {
 protected:
  ProcessEnd run(const ProcessCall& call) { return value_of(run_process(call, never)); }
  std::filesystem::path script(const std::string& name, const std::string& text, bool may = true) {
    std::ofstream(folder / name) << text;
    if (may) std::filesystem::permissions(folder / name, std::filesystem::perms::owner_all);
    return folder / name;
  }

  TemporaryFolder folder;
  Interrupt never;
};

TEST_F(Programs, GiveTheirOutputsApart) {
  const ProcessEnd end = run(hostile({"--print", "12", "--complain", "warning", "--exit", "3"}));
  EXPECT_EQ(end.output.text, "12\n");
  EXPECT_EQ(end.errors.text, "warning\n");
  EXPECT_EQ(end.exit_code, 3);
  EXPECT_EQ(end.signal, 0);
  EXPECT_EQ(end.why, ProcessEnd::Why::Itself);
}

TEST_F(Programs, RunInTheirFolderWithNothingOfOurs) {
  ProcessCall call{.words = {"/bin/sh", "-c", "pwd; echo $#; echo \"$1\"", "sh", "a b"},
                   .folder = folder.path().string()};
  EXPECT_EQ(run(call).output.text, folder.path().string() + "\n1\na b\n");
  EXPECT_EQ(run(hostile({"--input", ""})).output.text, "0\n");
  EXPECT_EQ(run(hostile({"--descriptors", ""})).output.text, "");
  std::signal(SIGPIPE, SIG_IGN);
  EXPECT_EQ(run(hostile({"--pipe-default", ""})).output.text, "yes\n");
  std::signal(SIGPIPE, SIG_DFL);
}

TEST_F(Programs, MayDieBySignals) {
#ifdef SWARMSMITH_SANITIZED
  GTEST_SKIP() << "skipped: sanitizers catch the signal in the program itself";
#endif
  const ProcessEnd end = run(hostile({"--print", "1", "--raise", "11"}));
  EXPECT_EQ(end.signal, SIGSEGV);
  EXPECT_EQ(end.output.text, "1\n");
}

/// Long enough for a program to begin, also where everything is slow.
#ifdef SWARMSMITH_SANITIZED
constexpr milliseconds kBeginning{2000};
#else
constexpr milliseconds kBeginning{200};
#endif

TEST_F(Programs, AreEndedWhenTheirTimeIsOver) {
  ProcessCall call = hostile({"--print", "1", "--hang", ""});
  call.limit = kBeginning;
  call.term_grace = seconds(20);
  const ProcessEnd end = run(call);
  EXPECT_EQ(end.why, ProcessEnd::Why::Limit);
  EXPECT_EQ(end.signal, SIGTERM);
  EXPECT_EQ(end.output.text, "1\n");
}

TEST_F(Programs, AreKilledWhenTheyIgnoreTheirEnd) {
  ProcessCall call = hostile({"--ignore", "15", "--hang", ""});
  call.limit = kBeginning;
  const ProcessEnd end = run(call);
  EXPECT_EQ(end.why, ProcessEnd::Why::Limit);
  EXPECT_EQ(end.signal, SIGKILL);
}

TEST_F(Programs, LeaveNoProcessBehind) {
  // Ended by itself, with a grandchild that holds the pipes open.
  const ProcessEnd end = run(hostile({"--grandchild", "", "--print", "5"}));
  EXPECT_EQ(end.output.text, "5\n");
  EXPECT_TRUE(eventually([&] { return is_dead(std::stoi(end.errors.text)); }));
  // Ended by us, with a grandchild that ignores it.
  ProcessCall call = hostile({"--ignore", "15", "--grandchild", "", "--hang", ""});
  call.limit = kBeginning;
  const ProcessEnd killed = run(call);
  EXPECT_TRUE(eventually([&] { return is_dead(std::stoi(killed.errors.text)); }));
}

TEST_F(Programs, WaitForProcessesThatStillWrite) {
  const ProcessEnd end =
      run({.words = {"/bin/sh", "-c", "(printf late) & exit 0"}, .pipe_grace = seconds(20)});
  EXPECT_EQ(end.output.text, "late");
}

TEST_F(Programs, MayPrintAnyAmount) {
  const std::size_t bytes = std::size_t{8} << 20U;
  const ProcessEnd end = run(hostile({"--flood", std::to_string(bytes), "--print", "end"}));
  EXPECT_EQ(end.output.size, bytes + 4);
  EXPECT_FALSE(end.output.complete());
  EXPECT_EQ(end.output.text.size(), ProcessCall{}.keep);
  EXPECT_TRUE(end.output.text.ends_with("xend\n"));
}

TEST_F(Programs, MayCloseTheirOutputAndGoOn) {
  const ProcessEnd end =
      run(hostile({"--print", "7", "--close", "1", "--close", "2", "--exit", "4"}));
  EXPECT_EQ(end.output.text, "7\n");
  EXPECT_EQ(end.exit_code, 4);
}

TEST_F(Programs, GiveNulBytesAsTheyAre) {
  EXPECT_EQ(run(hostile({"--nul", ""})).output.text, std::string("1\0 2\n", 5));
}

TEST_F(Programs, WithoutAFirstLineAreShellScripts) {
  const auto path = script("plain", "echo \"$0 $1\"\n");
  EXPECT_EQ(run({.words = {path.string(), "x"}}).output.text, path.string() + " x\n");
}

TEST_F(Programs, ThatCannotStartSayWhy) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "under TSan vfork is fork: what the child says of its failure is lost";
#endif
  const auto why = [&](const std::filesystem::path& path, const std::string& in = "") {
    const auto end = run_process({.words = {path.string()}, .folder = in}, never);
    return end ? std::string("started") : end.error().message;
  };
  EXPECT_THAT(why(folder / "missing"), HasSubstr("No such file"));
  EXPECT_THAT(why(script("plain", "echo 1\n", false)), HasSubstr("chmod +x"));
  EXPECT_THAT(why(script("lost", "#!/no/such/shell\n")), HasSubstr("first line"));
  EXPECT_THAT(why(script("windows", "#!/bin/sh\r\necho 1\r\n")), HasSubstr("carriage return"));
  EXPECT_THAT(why(folder.path()), HasSubstr("cannot be started"));
  EXPECT_THAT(why("/bin/true", "/no/such/folder"), HasSubstr("/no/such/folder"));
  EXPECT_THAT(why("no-such-program-at-all"), HasSubstr("in PATH"));
  EXPECT_THAT(
      why_not(run_process({.words = {"/bin/true", std::string(1U << 20U, 'x')}}, never)).message,
      HasSubstr("command line is longer"));
}

TEST_F(Programs, EndWhenTheyAreInterrupted) {
  Interrupt interrupt;
  std::jthread later([&] { interrupt.trigger(); });
  const auto end = value_of(run_process(hostile({"--hang", ""}), interrupt));
  EXPECT_EQ(end.why, ProcessEnd::Why::Interrupted);
  EXPECT_EQ(run_process(hostile({"--hang", ""}), interrupt)->why, ProcessEnd::Why::Interrupted);
}

TEST_F(Programs, RunByTheHundredAndLeaveNothing) {
  run(hostile({}));  // whatever is opened once
  const std::size_t before = open_descriptors();
  {
    std::vector<std::jthread> threads;
    for (int i = 0; i < 200; ++i) {
      threads.emplace_back([&, i] {
        const auto end = run_process(
            {.words = {"/bin/sh", "-c", "sleep 0.05; echo " + std::to_string(i)}}, never);
        ASSERT_TRUE(end) << end.error().message;
        EXPECT_EQ(end->output.text, std::to_string(i) + "\n");
      });
    }
  }
  EXPECT_EQ(open_descriptors(), before);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);
  EXPECT_EQ(errno, ECHILD);
}

/// A process with a running program is killed; `guarded` as a worker is.
void kill_with_program(bool guarded, const std::vector<std::string>& words, pid_t& grandchild,
                       const std::filesystem::path& note) {
  const pid_t worker = fork();
  if (worker == 0) {
    if (guarded && !start_guard()) _exit(98);
    const Interrupt never;
    (void)run_process({.words = words}, never);
    _exit(99);
  }
  ASSERT_TRUE(eventually([&] {
    std::ifstream in(note);
    return static_cast<bool>(in >> grandchild) && grandchild > 0;
  }));
  kill(worker, SIGKILL);
  waitpid(worker, nullptr, 0);
}

TEST_F(Programs, DieWithAKilledWorker) {
  const auto note = folder / "pid";
  pid_t pid = 0;
  const std::string script = "echo $$ > " + note.string() + ".new; mv " + note.string() + ".new " +
                             note.string() + "; exec sleep 1000";
  kill_with_program(false, {"/bin/sh", "-c", script}, pid, note);
  EXPECT_TRUE(eventually([&] { return is_dead(pid); }));
}

TEST_F(Programs, AndSoDoesWhatTheyStarted) {
  const auto note = folder / "pid";
  pid_t pid = 0;
  const std::string script = "trap '' TERM; sleep 1000 & echo $! > " + note.string() + ".new; mv " +
                             note.string() + ".new " + note.string() + "; wait";
  kill_with_program(true, {"/bin/sh", "-c", script}, pid, note);
  EXPECT_TRUE(eventually([&] { return is_dead(pid); }));
}

}  // namespace
}  // namespace swarmsmith
