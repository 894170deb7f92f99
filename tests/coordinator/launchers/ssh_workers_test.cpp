// The launcher with a script in the place of ssh; real ones are in tests/slurm/ssh_test.py.

#include "coordinator/launchers/ssh_workers.h"

#include <algorithm>
#include <fstream>
#include <functional>
#include <thread>

#include "tests/support/checks.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

const std::string kConnected = "echo swarmsmith-worker: connected\n";

class Ssh : public testing::Test {
 protected:
  /// Starts workers on the hosts by a shell script, whose last two words are host and command.
  SshWorkers start(const std::string& script, std::vector<SshHost> hosts) {
    const auto file = folder / "ssh";
    write_script(file, "for word; do host=$last; last=$word; done\n" + script);
    return value_of(SshWorkers::start({.hosts = std::move(hosts),
                                       .address = {.endpoint = "tcp://h:1"},
                                       .program = "/w",
                                       .ssh = file.string(),
                                       .first_pause = milliseconds(1),
                                       .longest_pause = milliseconds(20)}));
  }

  static bool eventually(SshWorkers& workers, const std::function<bool()>& holds) {
    return swarmsmith::eventually(holds, [&] {
      trouble_of(workers);
      std::this_thread::yield();
    });
  }
  static std::string trouble_of(SshWorkers& workers) { return workers.tend(SystemClock().now()); }

  int starts() const {
    std::ifstream log(folder / "log");
    int count = 0;
    for (std::string line; std::getline(log, line);)
      ++count;
    return count;
  }

  TemporaryFolder folder;
};

TEST_F(Ssh, WorkersRunUntilTheirInputEnds) {
  const std::string log = (folder / "log").string();
  SshWorkers workers = start(kConnected + "cat; echo $host ended >>" + log + "\n", {{"a"}, {"b"}});
  EXPECT_EQ(workers.status().running, 0);
  ASSERT_TRUE(eventually(workers, [&] { return workers.status().running == 2; }));
  EXPECT_EQ(workers.stop(std::chrono::seconds(60)), "");
  EXPECT_EQ(starts(), 2);
}

TEST_F(Ssh, ALongBannerHidesNoWordOfTheWorker) {
  const auto all_said = folder / "all_said";
  SshWorkers workers = start("seq 1 2000\necho swarmsmith-worker: begins\n" + kConnected +
                                 "touch " + all_said.string() + "\ncat\n",
                             {{"a"}});
  ASSERT_TRUE(swarmsmith::eventually([&] { return std::filesystem::exists(all_said); },
                                     [] { std::this_thread::yield(); }));
  trouble_of(workers);
  EXPECT_EQ(workers.status().running, 1);
}

/// A process that runs is not a worker yet, and one that lost its coordinator is none any more.
TEST_F(Ssh, WorkersCountWhenTheyAreConnected) {
  const std::string log = (folder / "log").string();
  const std::string go = (folder / "go").string();
  SshWorkers workers = start("echo x >>" + log + "\n" + kConnected + "while test ! -e " + go +
                                 "; do sleep 0.01; done\necho swarmsmith-worker: alone\ncat\n",
                             {{"a"}});
  ASSERT_TRUE(eventually(workers, [&] { return workers.status().running == 1; }));
  std::ofstream(go).close();
  ASSERT_TRUE(eventually(workers, [&] { return workers.status().pending == 1; }));
  EXPECT_EQ(starts(), 1);
}

/// An sshd refuses more than a few who have not logged in yet.
TEST_F(Ssh, FewLoginsAreUnderWayAtATime) {
  const std::string most = (folder / "most").string();
  const std::string now = (folder / "now").string();
  // A login is a file until it is over.
  std::vector<SshHost> hosts;
  for (int i = 0; i < 24; ++i)
    hosts.push_back({.name = "h" + std::to_string(i)});
  std::filesystem::create_directory(now);
  SshWorkers workers =
      start("touch " + now + "/$host\nset -- " + now + "/*\necho $# >>" + most +
                "\ntest $# -gt 3 && rm " + now + "/$host && exit 255\n" + "sleep 0.02\nrm " + now +
                "/$host\necho swarmsmith-worker: begins\n" + kConnected + "exec cat\n",
            hosts);
  ASSERT_TRUE(eventually(workers, [&] { return workers.status().running == 24; }));
  std::ifstream counts(most);
  int highest = 0;
  for (int count = 0; counts >> count;)
    highest = std::max(highest, count);
  EXPECT_LE(highest, 9);
}

TEST_F(Ssh, AHostThatDoesNotAnswerIsTriedAgainAndNamed) {
  const std::string log = (folder / "log").string();
  SshWorkers workers = start("test $host = good && exec cat\necho x >>" + log +
                                 "\necho 'connect to host bad port 22: No route to host' >&2\n"
                                 "exit 255\n",
                             {{"bad"}, {"good"}});
  ASSERT_TRUE(eventually(workers, [&] { return starts() >= 4; }));
  ASSERT_TRUE(eventually(workers, [&] { return !workers.status().note.empty(); }));
  EXPECT_THAT(workers.status().note,
              HasSubstr("bad: cannot be reached: connect to host bad port 22: No route to host"));
  EXPECT_EQ(trouble_of(workers), "");
}

TEST_F(Ssh, AHostWhoseWorkerIsRefusedIsLeftAloneAndSaysWhatTheWorkerSaid) {
  const std::string log = (folder / "log").string();
  SshWorkers workers = start(
      "echo x >>" + log + "\ntest $host = old && echo 'no target program /a' >&2 && exit 7\n" +
          kConnected + "exec cat\n",
      {{"old"}, {"new"}});
  ASSERT_TRUE(eventually(workers, [&] {
    return workers.status().running == 1 && starts() == 2 && !workers.status().note.empty();
  }));
  EXPECT_THAT(workers.status().note, HasSubstr("old: the worker there was refused"));
  EXPECT_THAT(workers.status().note, HasSubstr(": no target program /a"));
  EXPECT_THAT(workers.status().note, Not(HasSubstr("build")));
  EXPECT_EQ(trouble_of(workers), "");
}

TEST_F(Ssh, WhenAllAreRefusedNothingCanBeHad) {
  SshWorkers workers = start("echo 'another build' >&2\nexit 7\n", {{"a"}, {"b"}});
  ASSERT_TRUE(eventually(workers, [&] { return !trouble_of(workers).empty(); }));
  EXPECT_THAT(trouble_of(workers), HasSubstr("ssh: a: the worker there was refused"));
  EXPECT_THAT(trouble_of(workers), HasSubstr("another build"));
}

/// Another worker may leave, and a quarantine may end.
TEST_F(Ssh, AHostWhoseWorkerFindsNoPlaceIsTriedAgain) {
  const std::string log = (folder / "log").string();
  SshWorkers workers =
      start("echo x >>" + log + "\necho 'there are 5 workers already' >&2\nexit 8\n", {{"a"}});
  ASSERT_TRUE(eventually(workers, [&] { return starts() >= 3; }));
  EXPECT_EQ(trouble_of(workers), "");
  EXPECT_THAT(workers.status().note, HasSubstr("a: the coordinator has no place for the worker"));
  EXPECT_THAT(workers.status().note, HasSubstr(": there are 5 workers already"));
}

TEST_F(Ssh, AProgramThatEndsAtOnceWithoutAnErrorIsNoWorker) {
  SshWorkers workers = start("exit 0\n", {{"a"}});
  ASSERT_TRUE(eventually(workers, [&] { return !trouble_of(workers).empty(); }));
  EXPECT_THAT(trouble_of(workers), HasSubstr("is it swarmsmith-worker?"));
}

TEST(SshProgram, ThatIsMissingIsSaid) {
  EXPECT_THAT(
      complaint_of(SshWorkers::start({.hosts = {{"a"}}, .program = "/w", .ssh = "no-such-ssh"})),
      HasSubstr("install the package openssh-client"));
}

}  // namespace
}  // namespace swarmsmith
