#include "programs/batch.h"

#include <cstdlib>
#include <filesystem>
#include <map>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

ProcessEnd answer(int exit_code, const std::string& output, const std::string& errors = "") {
  ProcessEnd end;
  end.exit_code = exit_code;
  end.output = {output, output.size()};
  end.errors = {errors, errors.size()};
  return end;
}

constexpr char kPbsTable[] =
    "Job id            Name             User              Time Use S Queue\n"
    "----------------  ---------------- ----------------  -------- - -----\n"
    "77.host           runner           somebody          00:00:01 ";

TEST(Jobs, AreJudgedAsEachSystemAnswers) {
  using enum BatchMode;
  EXPECT_EQ(state_of_job(Sge, answer(0, "job_number: 77")), JobState::Waits);
  EXPECT_EQ(state_of_job(Sge, answer(1, "", "Following jobs do not exist: 77")), JobState::Ended);
  EXPECT_EQ(state_of_job(Sge, answer(1, "", "unable to contact qmaster")), JobState::Unknown);
  EXPECT_EQ(state_of_job(Pbs, answer(0, std::string(kPbsTable) + "R batch\n")), JobState::Waits);
  EXPECT_EQ(state_of_job(Torque, answer(0, std::string(kPbsTable) + "C batch\n")), JobState::Ended);
  EXPECT_EQ(state_of_job(Pbs, answer(35, "", "qstat: 77 Job has finished")), JobState::Ended);
  EXPECT_EQ(state_of_job(Pbs, answer(153, "", "qstat: Unknown Job Id 77")), JobState::Ended);
  EXPECT_EQ(state_of_job(Pbs, answer(111, "", "cannot connect to server")), JobState::Unknown);
  EXPECT_EQ(state_of_job(Slurm, answer(0, "PENDING\n")), JobState::Waits);
  EXPECT_EQ(state_of_job(Slurm, answer(0, "COMPLETING\n")), JobState::Waits);
  EXPECT_EQ(state_of_job(Slurm, answer(0, "COMPLETED\n")), JobState::Ended);
  EXPECT_EQ(state_of_job(Slurm, answer(0, "")), JobState::Ended);
  EXPECT_EQ(state_of_job(Slurm, answer(1, "", "slurm_load_jobs error: Invalid job id specified")),
            JobState::Ended);
  EXPECT_EQ(state_of_job(Slurm, answer(1, "", "Unable to contact slurm controller")),
            JobState::Unknown);
  EXPECT_EQ(state_of_job(HtCondor, answer(0, "2\n")), JobState::Waits);
  EXPECT_EQ(state_of_job(HtCondor, answer(0, "4\n")), JobState::Ended);
  EXPECT_EQ(state_of_job(HtCondor, answer(0, "")), JobState::Ended);
  EXPECT_EQ(state_of_job(HtCondor, answer(1, "", "no schedd")), JobState::Unknown);
}

/// Batch systems played by scripts that come first in PATH.
class Queues : public ::testing::Test {
 protected:
  void SetUp() override {
    before = std::getenv("PATH");
    setenv("PATH", (folder.path().string() + ":" + before).c_str(), 1);
  }
  void TearDown() override { setenv("PATH", before.c_str(), 1); }
  void command(const std::string& name, const std::string& text) {
    write_script(folder / name,
                 "cd " + folder.path().string() + "\necho " + name + " \"$@\" >> log\n" + text);
  }
  std::string log() const { return whole_file(folder / "log"); }

  TemporaryFolder folder;
  std::string before;
};

TEST_F(Queues, AreAskedUntilTheJobHasLeft) {
  command("squeue",
          "n=$(wc -l < log); [ $n = 1 ] && echo PENDING; [ $n = 2 ] && { echo no >&2; exit 1; }\n"
          "[ $n = 3 ] && echo RUNNING; exit 0\n");
  const Interrupt never;
  EXPECT_TRUE(wait_for_job(BatchMode::Slurm, "77", milliseconds(1), never));
  EXPECT_EQ(log(),
            "squeue -h -o %T -j 77\nsqueue -h -o %T -j 77\nsqueue -h -o %T -j 77\n"
            "squeue -h -o %T -j 77\n");
}

TEST_F(Queues, LoseTheJobsOfAnInterruptedWorker) {
  command("squeue", "echo RUNNING\n");
  command("scancel", "");
  Interrupt interrupt;
  interrupt.trigger();
  const auto waited = wait_for_job(BatchMode::Slurm, "77", milliseconds(1), interrupt);
  ASSERT_FALSE(waited);
  EXPECT_EQ(log(), "scancel 77\n");
}

TEST_F(Queues, ThatNeverAnswerAreAnError) {
  command("squeue", "echo no controller >&2; exit 1\n");
  const Interrupt never;
  EXPECT_THAT(why_not(wait_for_job(BatchMode::Slurm, "77", milliseconds(0), never)).message,
              HasSubstr("no controller"));
}

}  // namespace
}  // namespace swarmsmith
