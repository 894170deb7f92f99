#include "coordinator/launchers/launch_text.h"

#include "base/process/process.h"
#include "coordinator/launchers/host_file.h"
#include "coordinator/launchers/launcher.h"
#include "coordinator/launchers/slurm_script.h"
#include "coordinator/launchers/slurm_workers.h"
#include "coordinator/launchers/ssh_workers.h"
#include "coordinator/launchers/worker_program.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using Kind = LaunchOptions::Kind;

TEST(LauncherStatus, CountsOneWorkerAsOne) {
  EXPECT_EQ(to_text(LauncherStatus{.name = "ssh", .wanted = 1, .pending = 1}),
            "ssh: 0 of 1 worker runs, 1 waits");
  EXPECT_EQ(to_text(LauncherStatus{.name = "ssh", .wanted = 4, .running = 2, .pending = 2}),
            "ssh: 2 of 4 workers run, 2 wait");
}

TEST(WorkersOption, NamesALauncher) {
  const LaunchOptions file{.kind = Kind::Slurm, .slurm = {.jobs = 9, .cpus_per_task = 8}};
  EXPECT_EQ(parse_workers("auto", file)->kind, Kind::Local);
  EXPECT_EQ(parse_workers("auto", file)->processes, 1);
  EXPECT_EQ(parse_workers("auto", file)->slots, 0) << "all cores";
  EXPECT_EQ(parse_workers("3", file)->processes, 3);
  EXPECT_EQ(parse_workers("3", file)->slots, 3) << "and no more";
  EXPECT_EQ(parse_workers("local:1_0", file)->processes, 10);
  EXPECT_EQ(parse_workers("ssh:a b/hosts", file)->ssh.hosts, "a b/hosts");
  EXPECT_EQ(parse_workers("slurm", {}).value().kind, Kind::Slurm);
  EXPECT_EQ(parse_workers("slurm", file)->slurm, file.slurm);
  EXPECT_EQ(parse_workers("slurm:16x64", file)->slurm.jobs, 16);
  EXPECT_EQ(parse_workers("slurm:16x64", file)->slurm.cpus_per_task, 64);
  EXPECT_EQ(parse_workers("slurm:2", file)->slurm.cpus_per_task, 8);
}

TEST(WorkersOption, SaysWhatIsWrong) {
  for (const char* text : {"", "0", "-1", "1001", "many", "local:", "local:x", "Slurm", "slurmx"}) {
    EXPECT_THAT(why_not(parse_workers(text, {})).message,
                StartsWith("Value " + std::string(text) + " is not one of: auto, N"));
  }
  for (const char* text : {"slurm:", "slurm:x", "slurm:4x", "slurm:0x4", "slurm:4x4x4"})
    EXPECT_THAT(parse_workers(text, {}).error().message, HasSubstr("is not slurm:JOBSxCPUS"));
  EXPECT_THAT(parse_workers("ssh", {}).error().message, HasSubstr("write ssh:HOSTFILE"));
  EXPECT_TRUE(parse_workers("ssh", {.ssh = {.hosts = "h"}}));
  EXPECT_FALSE(parse_workers("ssh:", {.ssh = {.hosts = "h"}}));
}

TEST(HostFile, HasAHostALine) {
  const auto hosts =
      value_of(parse_hosts("# the lab\nnode1\n\n  me@node2 \tslots=16   # the large one\r\n"
                           "node3 program=/opt/x key=/k coordinator=/c",
                           "hosts"));
  EXPECT_THAT(
      hosts,
      ElementsAre(SshHost{.name = "node1"}, SshHost{.name = "me@node2", .slots = 16},
                  SshHost{.name = "node3", .program = "/opt/x", .key = "/k", .coordinator = "/c"}));
}

TEST(HostFile, ReportsEveryMistakeWithItsPlace) {
  const auto hosts = parse_hosts(
      "slots=4\nnode1 slot=4\nnode2  slots=0\nnode1\n-oProxyCommand=x\nnode5 program=bin/x\n"
      "node6 slots=4.5 more\n",
      "in/hosts");
  ASSERT_FALSE(hosts);
  EXPECT_THAT(
      lines_of(hosts.error()),
      ElementsAre(HasSubstr("in/hosts:1:1: a line must begin with the name of a host"),
                  HasSubstr("in/hosts:2:7: `slot=4` is not one of slots=N, program=PATH, key=PATH, "
                            "coordinator=PATH (did you mean \"slots\"?)"),
                  HasSubstr("in/hosts:3:8: `slots` must be a number from 1 to 1024"),
                  HasSubstr("in/hosts:4:1: `node1` is given twice"),
                  HasSubstr("in/hosts:5:1: a line must begin"),
                  HasSubstr("in/hosts:6:7: `program` must be an absolute path on that host"),
                  HasSubstr("in/hosts:7:7: `slots` must be"), HasSubstr("in/hosts:7:17: `more`")));
}

TEST(HostFile, OfTheExamplesIsRight) {
  const auto hosts = value_of(read_hosts(SWARMSMITH_SOURCE_DIR "/examples/cluster/hosts"));
  EXPECT_EQ(hosts.size(), 3U);
}

TEST(HostFile, WithoutHostsIsAMistake) {
  EXPECT_THAT(parse_hosts("# none\n", "h").error().front().message, HasSubstr("no host"));
  EXPECT_EQ(read_hosts("/nonexistent/h").error().front().where, "/nonexistent/h");
  EXPECT_FALSE(read_hosts("/"));
}

TEST(SshCommand, HasFilesAndNoSecretsAndTheUsersOptionsFirst) {
  const SshWorkersOptions options{.hosts = {},
                                  .options = {"-F", "my config"},
                                  .address = {.endpoint = "tcp://h:1",
                                              .coordinator = "/shared/c.toml",
                                              .key = "/shared/it's.key"},
                                  .program = "/opt/swarmsmith-worker"};
  const auto words = ssh_words(options, {.name = "me@node1", .slots = 8});
  EXPECT_EQ(words[0], "ssh");
  EXPECT_EQ(words[1], "-F");
  EXPECT_EQ(words[words.size() - 3], "--");
  EXPECT_EQ(words[words.size() - 2], "me@node1");
  EXPECT_EQ(words.back(),
            "echo swarmsmith-worker: begins; exec '/opt/swarmsmith-worker' '--watch-input' "
            "'--coordinator' '/shared/c.toml' "
            "'--key' '/shared/it'\\''s.key' '--slots' '8'");
  const auto elsewhere =
      ssh_words(options, {.name = "n", .program = "/bin/w", .key = "/k", .coordinator = "/c"});
  EXPECT_THAT(elsewhere.back(),
              EndsWith("exec '/bin/w' '--watch-input' '--coordinator' '/c' '--key' '/k'"));
}

TEST(ShellLine, IsTakenApartIntoTheSameWords) {
  const std::vector<std::string> words{"printf", "%s|", "a b", "", "it's", "$HOME `x` \"q\" \\",
                                       "\n"};
  const Interrupt never;
  const auto end = value_of(run_process({.words = {"/bin/sh", "-c", shell_line(words)}}, never));
  EXPECT_EQ(end.output.text, "a b||it's|$HOME `x` \"q\" \\|\n|");
}

TEST(SlurmScript, HoldsAllThatSbatchNeeds) {
  const std::string text = text_of({.job_name = "swarmsmith-1",
                                    .folder = "/lab/100% mine",
                                    .command = {"/opt/worker", "--key", "/k"},
                                    .options = {.jobs = 16,
                                                .cpus_per_task = 64,
                                                .time = "8:00:00",
                                                .partition = "long",
                                                .options = {"--account=x y"}}});
  EXPECT_THAT(text, StartsWith("#!/bin/sh\n"));
  for (const char* line :
       {"\n#SBATCH '--job-name=swarmsmith-1'\n", "\n#SBATCH '--array=0-15'\n",
        "\n#SBATCH '--cpus-per-task=64'\n", "\n#SBATCH '--requeue'\n",
        "\n#SBATCH '--signal=B:TERM@60'\n", "\n#SBATCH '--output=/lab/100%% mine/%A_%a.log'\n",
        "\n#SBATCH '--time=8:00:00'\n", "\n#SBATCH '--partition=long'\n",
        "\n#SBATCH '--account=x y'\nexec '/opt/worker' '--key' '/k'\n"}) {
    EXPECT_THAT(text, HasSubstr(line));
  }
}

TEST(SlurmJobName, IsThatOfACampaignInAStore) {
  const std::string name = slurm_job_name("digest", "a.db");
  EXPECT_EQ(name, slurm_job_name("digest", "./a.db"));
  EXPECT_NE(name, slurm_job_name("digest", "b.db"));
  EXPECT_NE(name, slurm_job_name("other", "a.db"));
  EXPECT_THAT(name, StartsWith("swarmsmith-"));
}

}  // namespace
}  // namespace swarmsmith
