#include "programs/runner.h"

#include <gtest/gtest.h>
#include <cmath>
#include <filesystem>

#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

bool mentions(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class Runners : public ::testing::Test {
 protected:
  void script(const std::string& text, const std::string& name = "target-runner") {
    write_script(folder / name, text);
  }
  Target target() const {
    Target made;
    made.runner = (folder / "target-runner").string();
    made.folder = folder.path().string();
    return made;
  }
  auto run(const Target& made, bool shell = true) {
    return TargetRunner(made, {.shell = shell, .term_grace = milliseconds(50)}, never).run(call);
  }
  std::string log() const { return whole_file(folder / "log"); }

  TemporaryFolder folder;
  Interrupt never;
  RunnerCall call{.configuration = 4,
                  .instance_id = "2",
                  .seed = 99,
                  .instance = "arena one",
                  .switches = "--alpha 0.5"};
};

TEST_F(Runners, CallTheProgramInItsFolder) {
  script("printf '[%s]' \"$@\" > log; echo 3.25\n");
  const auto result = run(target());
  ASSERT_TRUE(result) << result.error().reason;
  EXPECT_EQ(result->reading, (Reading{3.25, 0}));
  EXPECT_EQ(log(), "[4][2][99][arena][one][--alpha][0.5]");
}

TEST_F(Runners, AskAShellWhereOneIsNeeded) {
  script("printf '[%s]' \"$@\" > log; echo 1\n");
  call.instance = "$((20+1)) '$x'";
  ASSERT_TRUE(run(target()));
  EXPECT_EQ(log(), "[4][2][99][21][$x][--alpha][0.5]");
  const auto refused = run(target(), false);
  ASSERT_FALSE(refused);
  EXPECT_TRUE(mentions(refused.error().reason, "--allow-shell"));
}

TEST_F(Runners, StartTheRunnerByItsLauncher) {
  script("echo nonsense; exit 9\n");
  script("printf '[%s]' \"$@\" > log; echo 2\n", "launcher");
  Target launched = target();
  launched.launcher = (folder / "launcher").string();
  ASSERT_TRUE(run(launched));
  EXPECT_EQ(log(), "[" + launched.runner + "][4][2][99][arena][one][--alpha][0.5]");
}

TEST_F(Runners, DoNotReadStandardError) {
  script("echo warning >&2; echo 5\n");
  EXPECT_EQ(run(target())->reading.cost, 5);
}

TEST_F(Runners, RejectWhatCostsInfinitelyMuch) {
  script("echo Inf\n");
  EXPECT_TRUE(run(target())->rejected);
  script("echo -inf\n");
  EXPECT_TRUE(run(target())->rejected);
}

TEST_F(Runners, TellTheWholeStoryOfAFailure) {
  script("echo 12 apples; echo no tree >&2\n");
  const auto result = run(target());
  ASSERT_FALSE(result);
  const TargetFailure& failure = result.error();
  EXPECT_TRUE(mentions(failure.reason, "`apples`"));
  EXPECT_EQ(failure.details.command,
            (folder / "target-runner").string() + " 4 2 99 arena one  --alpha 0.5");
  EXPECT_EQ(failure.details.output, "12 apples\n");
  EXPECT_EQ(failure.details.errors, "no tree\n");
  const std::string message = message_of(failure.reason, failure.details);
  for (const char* part : {"`apples`", "4 2 99 arena one  --alpha 0.5", "12 apples\n", "no tree\n",
                           "run the call by hand"}) {
    EXPECT_TRUE(mentions(message, part)) << message;
  }
}

TEST_F(Runners, TakeAnExitStatusForAFailureWhateverIsPrinted) {
  script("echo 5; exit 3\n");
  EXPECT_TRUE(mentions(run(target()).error().reason, "exit status 3"));
  script("echo 5; kill -9 $$\n");
  const auto killed = run(target());
  EXPECT_TRUE(mentions(killed.error().reason, "SIGKILL"));
  EXPECT_TRUE(killed.error().from_outside);
}

TEST_F(Runners, TryAgainAsOftenAsTheyMay) {
  script("echo x >> log; [ $(wc -l < log) -ge 3 ] && echo 5\n");
  Target patient = target();
  patient.retries = 2;
  EXPECT_EQ(run(patient)->reading.cost, 5);
  EXPECT_EQ(log(), "x\nx\nx\n");
  script("echo y >> log; exit 1\n");
  const auto failed = run(patient);
  ASSERT_FALSE(failed);
  EXPECT_TRUE(mentions(failed.error().reason, "the last of 3 tries"));
  EXPECT_EQ(log(), "x\nx\nx\ny\ny\ny\n");
}

TEST_F(Runners, EndWhatTakesTooLong) {
  script("echo 5; sleep 1000\n");
  Target hasty = target();
  hasty.timeout_s = 1;
  const auto late = run(hasty);
  ASSERT_FALSE(late);
  EXPECT_TRUE(mentions(late.error().reason, "within 1 second"));
  EXPECT_EQ(late.error().details.output, "5\n");
  EXPECT_FALSE(late.error().from_outside);
  hasty.timeout_is_rejection = true;
  EXPECT_TRUE(run(hasty)->rejected);
}

TEST_F(Runners, RefuseAFlood) {
  script("yes 1 | head -c 300000\n");
  const auto flooded = run(target());
  ASSERT_FALSE(flooded);
  EXPECT_TRUE(mentions(flooded.error().reason, "300000 bytes"));
  EXPECT_TRUE(flooded.error().details.output.starts_with("..."));
  EXPECT_LE(flooded.error().details.output.size(), 4000U);
}

TEST_F(Runners, SayWhatIsWrongWithACommandLine) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP() << "under TSan vfork is fork: what the child says of its failure is lost";
#endif
  script("echo 1\n");
  call.instance = "it's";
  EXPECT_TRUE(mentions(run(target()).error().reason, "quote ' that is not closed"));
  call.instance = "x";
  Target missing = target();
  missing.runner = (folder / "nothing").string();
  EXPECT_TRUE(mentions(run(missing).error().reason, "cannot be started"));
}

TEST_F(Runners, AskTheEvaluatorForTheCost) {
  script("exit 0\n");
  script("printf '[%s]' \"$@\" > log; echo 8\n", "target-evaluator");
  Target two = target();
  two.evaluator = (folder / "target-evaluator").string();
  const TargetRunner runner(two, {}, never);
  EXPECT_EQ(runner.run(call)->reading, (Reading{0, 0}));
  const auto cost = runner.evaluate(
      {.configuration = 4, .instance_id = "2", .seed = 99, .instance = "arena", .alive = {1, 4}});
  ASSERT_TRUE(cost) << cost.error().reason;
  EXPECT_EQ(cost->reading.cost, 8);
  EXPECT_EQ(log(), "[4][2][99][arena][2][1][4]");
}

TEST_F(Runners, WaitForTheJobThatTheySubmitted) {
  script("echo 4711\n");
  script("echo \"$@\" >> log; [ $(wc -l < log) = 1 ] && echo RUNNING; exit 0\n", "squeue");
  const std::string before = std::getenv("PATH");
  setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
  Target batch = target();
  batch.batch_mode = BatchMode::Slurm;
  batch.evaluator = "/bin/true";
  // The script of the queue writes its log where it is called.
  const auto old = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  const auto result = TargetRunner(batch, {.batch_poll = milliseconds(1)}, never).run(call);
  std::filesystem::current_path(old);
  setenv("PATH", before.c_str(), 1);
  ASSERT_TRUE(result) << result.error().reason;
  EXPECT_EQ(log(), "-h -o %T -j 4711\n-h -o %T -j 4711\n");
}

}  // namespace
}  // namespace swarmsmith
