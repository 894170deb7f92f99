// Real worker processes that run real programs in place of the simulator.

#include <sys/wait.h>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <functional>
#include <set>
#include <thread>

#include "coordinator/launchers/worker_program.h"
#include "proto/scenario/scenario.h"
#include "sim/engine/self_test.h"
#include "sim/engine/simulate.h"
#include "tests/coordinator/service/running_service.h"
#include "tests/support/flat_campaign.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

/// Independent evaluations; candidate n has the switch `-n n`.
std::vector<Task> tasks_of(std::int64_t count) {
  std::vector<Task> tasks;
  for (std::int64_t i = 1; i <= count; ++i) {
    tasks.push_back({{.instance = 1, .seed = i, .machine = "-n " + std::to_string(i)},
                     {{i}, Purpose::Race, 1}});
  }
  return tasks;
}

class ProgramWorkers : public RunningService {
 protected:
  void script(const std::string& text) {
    write_script(folder / "target-runner", text);
    scenario.campaign_digest = "d";
    scenario.engine_version = kEngineVersion;
    scenario.target = Target{};
    scenario.target->runner = (folder / "target-runner").string();
    scenario.target->folder = folder.path().string();
    scenario.instances = {{{"here"}, {}}};
  }
  void open(std::int64_t evaluations) {
    campaign = std::make_unique<FlatCampaign>(tasks_of(evaluations));
    ServiceOptions options;
    options.coordinator.scenario = to_bytes({scenario});
    options.coordinator.scheduler.engine_version = kEngineVersion;
    options.coordinator.scheduler.self_test = self_test_digest();
    options.coordinator.scheduler.evaluates_programs = true;
    options.coordinator.scheduler.campaigns[0].stop_on_failure = stop_on_failure;
    serve_campaign(options, *campaign);
  }
  LocalWorkersOptions allowed() const { return local(1, 4, allow_arguments(*scenario.target)); }
  std::vector<std::string> log() const {
    std::ifstream in(folder / "log");
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);)
      lines.push_back(line);
    return lines;
  }

  TemporaryFolder folder;
  WorkerScenario scenario;
  bool stop_on_failure = false;
  std::unique_ptr<FlatCampaign> campaign;
};

TEST_F(ProgramWorkers, CallTheTargetOnceForEachEvaluation) {
  script("echo $6 >> log; echo $6 0.5\n");
  open(100);
  run_to_the_end(allowed());
  const auto rows = store.rows_of<EvaluationRow>();
  ASSERT_EQ(rows.size(), 100U);
  for (const EvaluationRow& row : rows) {
    EXPECT_EQ(row.measured.score, -static_cast<double>(row.key.candidate.value));
    EXPECT_EQ(row.measured.time, 0.5);
  }
  const auto lines = log();
  EXPECT_EQ(lines.size(), 100U);
  EXPECT_EQ(std::set<std::string>(lines.begin(), lines.end()).size(), 100U);
}

TEST_F(ProgramWorkers, KeepAFailureAndStop) {
  script("[ $6 = 3 ] && { echo broken >&2; echo apples; exit 1; }; echo $6\n");
  stop_on_failure = true;
  open(10);
  run_to_the_end(allowed());
  EXPECT_EQ(end.how, ServiceEnd::How::Stopped);
  EXPECT_THAT(end.reasons.at(0), HasSubstr("exit status 1"));
  EXPECT_THAT(end.reasons.at(0), HasSubstr("3 1 3 here  -n 3"));
  const auto failures = store.rows_of<FailureRow>();
  ASSERT_EQ(failures.size(), 1U);
  EXPECT_EQ(failures[0].key.candidate.value, 3);
  EXPECT_EQ(failures[0].output, "apples\n");
  EXPECT_EQ(failures[0].errors, "broken\n");
}

TEST_F(ProgramWorkers, RejectWhatFails) {
  script("[ $6 = 3 ] && exit 1; [ $6 = 4 ] && echo Inf || echo $6\n");
  open(10);
  run_to_the_end(allowed());
  std::set<std::int64_t> rejected;
  for (const EvaluationRow& row : store.rows_of<EvaluationRow>()) {
    if (row.status == EvaluationStatus::Rejected) rejected.insert(row.key.candidate.value);
  }
  EXPECT_EQ(rejected, (std::set<std::int64_t>{3, 4}));
  EXPECT_EQ(store.rows_of<FailureRow>().size(), 1U);
}

/// The script of docs/targets.md, with a simulator behind it that talks on both outputs and has
/// threads of its own kind.
TEST_F(ProgramWorkers, RunAScriptWithASimulatorBehindIt) {
  write_script(folder / "automode_main",
               "echo '[INFO] loaded'; echo '[WARNING] no light' >&2; (sleep 0.01) &\n"
               "printf '[%s]' \"$@\" >> calls; echo >> calls; wait; echo \"Score $8.5\"\n");
  script(
      "SEED=$3; INSTANCE=$4; shift 4\n"
      "OUT=$(./automode_main -n -c \"$INSTANCE\" --seed \"$SEED\" --fsm-config \"$@\" 2> "
      "run.$$.log) || exit 1\n"
      "echo \"$OUT\" | grep -a '^Score' | tail -1 | awk '{print -$2}'\n");
  scenario.instances = {{{"mission.argos"}, {}}};
  open(8);
  run_to_the_end(allowed());
  ASSERT_EQ(store.rows_of<EvaluationRow>().size(), 8U);
  for (const EvaluationRow& row : store.rows_of<EvaluationRow>()) {
    EXPECT_EQ(row.measured.score, static_cast<double>(row.key.candidate.value) + 0.5);
  }
  EXPECT_THAT(whole_file(folder / "calls"),
              HasSubstr("[-n][-c][mission.argos][--seed][3][--fsm-config][-n][3]"));
}

/// The program, and what it started, in all slots.
TEST_F(ProgramWorkers, TakeTheirProgramsWithThemWhenKilled) {
  script("trap '' TERM; sleep 1000 & echo $! >> log; wait\n");
  open(4);
  std::jthread loop = run();
  {
    auto started = value_of(LocalWorkers::start(allowed()));
    ASSERT_TRUE(eventually([&] { return log().size() == 4; }));
    kill(started.pids().at(0), SIGKILL);
    for (const std::string& pid : log()) {
      EXPECT_TRUE(eventually([&] {
        std::ifstream stat("/proc/" + pid + "/stat");
        std::string text;
        return !std::getline(stat, text) || text.find(") Z") != std::string::npos;
      })) << pid;
    }
  }
  stop(loop);
  EXPECT_TRUE(store.rows_of<FailureRow>().empty());
}

TEST_F(ProgramWorkers, RefuseWhatIsNotAllowed) {
  script("echo $6\n");
  open(1);
  std::jthread loop = run();
  const std::string worker = std::string(SWARMSMITH_BIN_DIR) + "/swarmsmith-worker";
  int pipe_ends[2];
  ASSERT_EQ(pipe(pipe_ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(pipe_ends[1], 2);
    execl(worker.c_str(), worker.c_str(), "--connect", service->endpoint().c_str(), "--allow",
          "/bin/true", nullptr);
    _exit(99);
  }
  close(pipe_ends[1]);
  std::string said;
  char chunk[512];
  for (ssize_t got = 0; (got = read(pipe_ends[0], chunk, sizeof chunk)) > 0;)
    said.append(chunk, static_cast<std::size_t>(got));
  close(pipe_ends[0]);
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(WEXITSTATUS(status), 7);
  EXPECT_NE(said.find("--allow " + (folder / "target-runner").string()), std::string::npos) << said;
  stop(loop);
}

}  // namespace
}  // namespace swarmsmith
