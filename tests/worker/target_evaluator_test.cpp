#include "worker/target_evaluator.h"

#include <filesystem>
#include <thread>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "worker/evaluate.h"

namespace swarmsmith {
namespace {

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class TargetEvaluators : public ::testing::Test {
 protected:
  void SetUp() override {
    script("target-runner", "printf '[%s]' \"$@\" > log; echo 2.5 7\n");
    scenario.campaign_digest = "d";
    scenario.target = Target{};
    scenario.target->runner = (folder / "target-runner").string();
    scenario.target->folder = folder.path().string();
    scenario.instances = {{{"one", "two"}, {"three"}}, {{"other"}, {}}};
    allowed.programs = {*allowed_program(scenario.target->runner)};
  }
  void script(const std::string& name, const std::string& text) {
    write_script(folder / name, text);
  }
  Expected<Evaluator> make() { return make_evaluators(allowed)(to_bytes({scenario})); }
  Result evaluate(const LeasedTask& item) {
    const auto evaluator = make();
    if (!evaluator) return {.failure = to_string(evaluator.error())};
    return (*evaluator)(item);
  }
  std::string log() const { return whole_file(folder / "log"); }
  /// Of the third configuration of the second design.
  static LeasedTask item(std::int32_t purpose = 0) {
    LeasedTask made;
    made.key = pack(kMostCandidates + 3, purpose, 1);
    made.instance = 2;
    made.seed = 11;
    made.machine = "-a 1";
    return made;
  }

  TemporaryFolder folder;
  WorkerScenario scenario;
  AllowedPrograms allowed;
};

TEST_F(TargetEvaluators, GiveTheNegativeOfTheCost) {
  const Result result = evaluate(item());
  ASSERT_EQ(result.failure, "");
  EXPECT_EQ(result.measured.score, -2.5);
  EXPECT_EQ(result.measured.time, 7);
  EXPECT_FALSE(result.rejected);
  EXPECT_EQ(log(), "[3][2][11][two][-a][1]");
}

TEST_F(TargetEvaluators, DigestWhatWasPrinted) {
  const auto digest_of = [&](const std::string& printed) {
    script("target-runner", "echo " + printed + "\n");
    const Result result = evaluate(item());
    EXPECT_EQ(result.failure, "");
    return result.measured.state_digest;
  };
  EXPECT_EQ(digest_of("2.5 7"), digest_of("2.5 7"));
  EXPECT_EQ(digest_of("0 7"), digest_of("-0 7"));
  EXPECT_NE(digest_of("2.5 7"), digest_of("2.5 8"));
  EXPECT_NE(digest_of("1e-20 7"), digest_of("2e-20 7"));
}

TEST_F(TargetEvaluators, NameTheInstance) {
  LeasedTask test = item(kTestPurpose);
  test.instance = 1;
  ASSERT_EQ(evaluate(test).failure, "");
  EXPECT_EQ(log(), "[3][1t][11][three][-a][1]");
  // A mission without instances for tests is tested on those of the training.
  test.mission = 1;
  ASSERT_EQ(evaluate(test).failure, "");
  EXPECT_EQ(log(), "[3][1][11][other][-a][1]");
  const auto has = [&](std::uint32_t mission, std::int32_t purpose, std::int64_t instance) {
    LeasedTask task = item(purpose);
    task.mission = mission;
    task.instance = instance;
    const std::string failure = evaluate(task).failure;
    if (failure.empty()) return true;
    EXPECT_EQ(failure, "a task for an instance that the scenario does not have");
    return false;
  };
  for (const std::int64_t instance : {0, 1, 2, 3}) {
    EXPECT_EQ(has(0, 0, instance), instance == 1 || instance == 2);
    EXPECT_EQ(has(0, kTestPurpose, instance), instance == 1);
    EXPECT_EQ(has(1, 0, instance), instance == 1);
    EXPECT_FALSE(has(2, 0, instance));
  }
}

TEST_F(TargetEvaluators, CallTheEvaluatorForItsPurpose) {
  script("target-evaluator", "printf '[%s]' \"$@\" > log; echo 4\n");
  scenario.target->evaluator = (folder / "target-evaluator").string();
  allowed.programs.push_back(*allowed_program(scenario.target->evaluator));
  script("target-runner", "echo 7\n");
  const Result run = evaluate(item());
  ASSERT_EQ(run.failure, "");
  EXPECT_EQ(run.measured.score, 0);
  EXPECT_EQ(run.measured.time, 7);
  LeasedTask call = item(kEvaluatorPurpose);
  call.alive = {1, 3};
  EXPECT_EQ(evaluate(call).measured.score, -4);
  EXPECT_EQ(log(), "[3][2][11][two][2][1][3]");
  call.instance = -1;
  ASSERT_EQ(evaluate(call).failure, "");
  EXPECT_EQ(log(), "[3][1t][11][three][2][1][3]");
}

TEST_F(TargetEvaluators, RejectAnInfiniteCost) {
  script("target-runner", "echo Inf 3\n");
  const Result result = evaluate(item());
  ASSERT_EQ(result.failure, "");
  EXPECT_TRUE(result.rejected);
  EXPECT_EQ(result.measured.time, 3);
}

TEST_F(TargetEvaluators, KeepTheStoryOfAFailure) {
  script("target-runner", "echo apples; echo pears >&2\n");
  const Result result = evaluate(item());
  EXPECT_TRUE(mentions(result.failure, "`apples`"));
  EXPECT_EQ(result.details.output, "apples\n");
  EXPECT_EQ(result.details.errors, "pears\n");
  EXPECT_TRUE(mentions(result.details.command, "3 2 11 two  -a 1"));
}

TEST_F(TargetEvaluators, RunNothingThatIsNotAllowed) {
  allowed.programs = {"/bin/true"};
  const auto refused = make();
  ASSERT_FALSE(refused);
  const std::string file = *allowed_program(scenario.target->runner);
  EXPECT_EQ(refused.error().message,
            "targetRunner: the campaign needs the program " + file +
                ", which this worker may not run: start the worker with --allow " + file);
  allowed.programs = {*allowed_program(scenario.target->runner)};
  scenario.target->launcher = "/bin/sh";
  EXPECT_TRUE(mentions(make().error().message, "targetRunnerLauncher"));
  scenario.target->launcher.clear();
  scenario.target->evaluator = "/no/such/evaluator";
  EXPECT_EQ(why_not(make()).message, "targetEvaluator: there is no such program on this host");
  EXPECT_EQ(why_not(make()).where, "/no/such/evaluator");
  EXPECT_EQ(why_not(allowed_program("/no/such/program")).message, "there is no such program");
}

TEST_F(TargetEvaluators, SeeThroughLinks) {
  std::filesystem::create_symlink(folder / "target-runner", folder / "link");
  scenario.target->runner = (folder / "link").string();
  const auto evaluator = value_of(make());
  EXPECT_EQ((evaluator)(item()).failure, "");
  // What the link means is looked at before every call.
  std::filesystem::remove(folder / "link");
  std::filesystem::create_symlink("/bin/true", folder / "link");
  EXPECT_TRUE(mentions((evaluator)(item()).failure, "may not"));
}

/// Makes the link mean the one and the other in turn, as fast as it can.
void swap_until(const std::stop_token& over, const std::filesystem::path& link,
                const std::filesystem::path& one, const std::filesystem::path& other) {
  const std::filesystem::path next = link.string() + ".next";
  for (bool odd = false; !over.stop_requested(); odd = !odd) {
    std::filesystem::remove(next);
    std::filesystem::create_symlink(odd ? one : other, next);
    std::filesystem::rename(next, link);
  }
}

TEST_F(TargetEvaluators, RunTheFileThatWasCheckedWhateverALinkMeansThen) {
  script("stranger", "touch stranger-ran; echo 9\n");
  std::filesystem::create_directory(folder / "good");
  std::filesystem::create_directory(folder / "bad");
  std::filesystem::rename(folder / "target-runner", folder / "good/run");
  std::filesystem::rename(folder / "stranger", folder / "bad/run");
  allowed.programs = {*allowed_program((folder / "good/run").string())};
  // The program itself is a link, or a folder on the way to it is one.
  const std::pair<std::string, std::string> links[] = {{"link", ""}, {"folder", "/run"}};
  for (const auto& [link, rest] : links) {
    const auto good = folder / (rest.empty() ? "good/run" : "good");
    const auto bad = folder / (rest.empty() ? "bad/run" : "bad");
    std::filesystem::create_symlink(good, folder / link);
    scenario.target->runner = (folder / link).string() + rest;
    const auto evaluator = value_of(make());
    std::jthread swapper([&, &changed = link](const std::stop_token& over) {
      swap_until(over, folder / changed, good, bad);
    });
    int ran = 0;
    int refused = 0;
    while (ran < 100 || refused < 100) {
      const Result result = (evaluator)(item());
      result.failure.empty() ? ++ran : ++refused;
      if (result.failure.empty()) {
        ASSERT_EQ(result.measured.score, -2.5);
      } else {
        ASSERT_TRUE(mentions(result.failure, "may not")) << result.failure;
      }
      ASSERT_FALSE(std::filesystem::exists(folder / "stranger-ran"));
    }
  }
}

TEST_F(TargetEvaluators, TellALauncherTheFileThatWasChecked) {
  script("stranger", "touch stranger-ran; echo 9\n");
  std::filesystem::create_symlink(folder / "target-runner", folder / "link");
  allowed.programs = {*allowed_program("/bin/sh"),
                      *allowed_program((folder / "target-runner").string())};
  scenario.target->launcher = "/bin/sh";
  scenario.target->runner = (folder / "link").string();
  const auto evaluator = make();
  ASSERT_TRUE(evaluator) << evaluator.error().message;
  std::jthread swapper([&](const std::stop_token& over) {
    swap_until(over, folder / "link", folder / "target-runner", folder / "stranger");
  });
  int ran = 0;
  int refused = 0;
  while (ran < 100 || refused < 100) {
    (*evaluator)(item()).failure.empty() ? ++ran : ++refused;
    ASSERT_FALSE(std::filesystem::exists(folder / "stranger-ran"));
  }
}

TEST_F(TargetEvaluators, NeedTheFolder) {
  scenario.target->folder = (folder / "nowhere").string();
  EXPECT_EQ(why_not(make()).message,
            "this host does not have the folder in which the campaign's programs run");
  EXPECT_EQ(why_not(make()).where, scenario.target->folder);
}

TEST_F(TargetEvaluators, GiveUpWhatRunsWhenAnotherScenarioComes) {
  script("target-runner", "exec sleep 1000\n");
  EvaluatorFactory factory = make_evaluators(allowed);
  const auto evaluator = value_of(factory(to_bytes({scenario})));
  std::string reason;
  std::jthread slot([&] { reason = (evaluator)(item()).failure; });
  ASSERT_TRUE(factory(to_bytes({scenario})));  // the next slot's: nothing happens
  scenario.campaign_digest = "other";
  ASSERT_TRUE(factory(to_bytes({scenario})));
  slot.join();
  EXPECT_TRUE(mentions(reason, "interrupted")) << reason;
}

}  // namespace
}  // namespace swarmsmith
