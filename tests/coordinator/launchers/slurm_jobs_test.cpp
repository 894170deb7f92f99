#include "coordinator/launchers/slurm_jobs.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

/// A queue that a test fills, and a clock that it moves.
class SlurmQueue : public testing::Test {
 protected:
  /// Everything that is due at this moment, answered as a Slurm would; how many jobs it was asked
  /// to submit.
  std::int64_t step() {
    std::int64_t submitted = 0;
    for (int i = 0; i < 10; ++i) {
      const SlurmJobs::Action action = jobs.next(now);
      if (const auto* submit = std::get_if<SlurmJobs::Submit>(&action)) {
        for (std::int64_t k = 0; k < submit->jobs; ++k)
          queue.push_back({std::to_string(++arrays) + "_0", "PENDING", "Resources"});
        submitted += submit->jobs;
        jobs.on_submitted(submit->jobs, now);
      } else if (std::holds_alternative<SlurmJobs::LookAtQueue>(action)) {
        ++looks;
        jobs.on_queue(queue, now);
      } else {
        break;
      }
    }
    return submitted;
  }

  /// The same, second by second.
  std::int64_t run_for(seconds time) {
    std::int64_t submitted = 0;
    for (seconds i{0}; i < time; ++i) {
      now += seconds(1);
      submitted += step();
    }
    return submitted;
  }

  void set_all(const std::string& state) {
    for (QueuedJob& job : queue)
      job.state = state;
  }
  void set(std::size_t job, const std::string& state) { queue.at(job).state = state; }

  TimePoint now{minutes(1000)};
  SlurmJobs jobs{4, {}, Rng(1)};
  std::vector<QueuedJob> queue;
  int arrays = 0;
  int looks = 0;
};

TEST_F(SlurmQueue, IsFilledOnceWithAllThatIsWanted) {
  EXPECT_EQ(step(), 4);
  EXPECT_EQ(run_for(minutes(30)), 0);
  EXPECT_EQ(jobs.status().pending, 4);
  EXPECT_EQ(jobs.status().waits_for, "Resources");
  EXPECT_EQ(jobs.trouble(), "");
}

TEST_F(SlurmQueue, IsNotAskedMoreThanOnceAMinuteWhileNothingChanges) {
  step();
  run_for(minutes(10));
  looks = 0;
  run_for(minutes(30));
  EXPECT_LE(looks, 31);
  EXPECT_GE(looks, 29);
}

TEST_F(SlurmQueue, HasTheJobsOfAnEarlierCoordinator) {
  queue = {{"7_0", "RUNNING", "None"}, {"7_1", "PENDING", "Priority"}, {"7_2", "CANCELLED", ""}};
  EXPECT_EQ(step(), 2);  // what ended before it began is history
}

TEST_F(SlurmQueue, JobsThatEndAreReplacedAfterAPause) {
  step();
  set_all("RUNNING");
  run_for(minutes(2));
  set(0, "NODE_FAIL");
  set(1, "COMPLETED");
  set(2, "FAILED");
  EXPECT_EQ(run_for(minutes(2)), 3);
  EXPECT_THAT(jobs.status().note, HasSubstr("job 3_0 failed"));
}

TEST_F(SlurmQueue, JobsThatFailAtOnceAreReplacedMoreAndMoreSlowly) {
  std::int64_t early = 0;
  std::int64_t late = 0;
  for (int i = 0; i < 120; ++i) {
    set_all("FAILED");
    (i < 10 ? early : late) += run_for(minutes(1));
  }
  EXPECT_GT(early, 8);
  // From then on once in about ten minutes, four jobs.
  EXPECT_LE(late, 4 * 16);
  EXPECT_GE(late, 4 * 7);
}

TEST_F(SlurmQueue, JobsThatCompleteAtOnceAgainAndAgainAreTheEnd) {
  for (int i = 0; i < 10 && jobs.trouble().empty(); ++i) {
    step();
    set_all("COMPLETED");
    run_for(minutes(1));
  }
  EXPECT_THAT(jobs.trouble(), HasSubstr("is their program swarmsmith-worker?"));
}

TEST_F(SlurmQueue, JobsThatAreDrainedAfterAWhileAreReplacedForEver) {
  for (int i = 0; i < 10; ++i) {
    step();
    for (QueuedJob& job : queue)
      if (job.state == "PENDING") job.state = "RUNNING";
    run_for(minutes(2));
    set_all("COMPLETED");
    run_for(minutes(12));
  }
  EXPECT_EQ(jobs.trouble(), "");
  EXPECT_EQ(jobs.status().pending, 4);
}

TEST_F(SlurmQueue, CancelledJobsAreNotReplaced) {
  step();
  run_for(seconds(10));
  set(0, "CANCELLED");
  set(1, "CANCELLED");
  EXPECT_EQ(run_for(minutes(20)), 0);
  EXPECT_EQ(jobs.status().wanted, 2);
  set(2, "TIMEOUT");
  EXPECT_EQ(run_for(minutes(20)), 1);
}

TEST_F(SlurmQueue, ACancelledJobBesidesAFailedOneLeavesThatOneToBeReplaced) {
  step();
  run_for(seconds(10));
  set(0, "CANCELLED");
  set(1, "PREEMPTED");
  EXPECT_EQ(run_for(minutes(20)), 1);
  EXPECT_EQ(jobs.status().wanted, 3);
}

/// The replacement of a job that ended before waits for its time.
TEST_F(SlurmQueue, ACancelledJobDoesNotEndTheReplacementOfAnEarlierOne) {
  step();
  set_all("RUNNING");
  run_for(seconds(1));
  EXPECT_EQ(jobs.status().wanted, 4);
  jobs.on_queue(queue, now);
  set(0, "TIMEOUT");
  jobs.on_queue(queue, now);
  set(1, "CANCELLED");
  jobs.on_queue(queue, now);
  EXPECT_EQ(jobs.status().wanted, 3);
  EXPECT_EQ(run_for(minutes(20)), 1);
  EXPECT_EQ(jobs.status().wanted, 3);
}

TEST_F(SlurmQueue, JobsSubmittedByHandCountAndAreNotCancelled) {
  step();
  for (int i = 0; i < 3; ++i)
    queue.push_back({"99_" + std::to_string(i), "RUNNING", "None"});
  run_for(minutes(2));
  set(0, "TIMEOUT");
  set(1, "TIMEOUT");
  EXPECT_EQ(run_for(minutes(5)), 0);
  EXPECT_EQ(jobs.status().running, 3);
}

TEST_F(SlurmQueue, WhatSlurmForgetsHasEnded) {
  step();
  set_all("RUNNING");
  run_for(minutes(2));
  queue.pop_back();
  EXPECT_EQ(run_for(minutes(2)), 1);
}

TEST_F(SlurmQueue, ARequeuedJobIsNotSubmittedTwice) {
  step();
  set(0, "RUNNING");
  run_for(minutes(1));
  set(0, "PENDING");
  queue[0].reason = "BeginTime";
  EXPECT_EQ(run_for(minutes(5)), 0);
}

TEST_F(SlurmQueue, ThatIsNotShownIsAskedAgainAndNothingIsSubmittedBlindly) {
  for (int i = 0; i < 600; ++i) {
    const SlurmJobs::Action action = jobs.next(now);
    ASSERT_FALSE(std::holds_alternative<SlurmJobs::Submit>(action));
    if (std::holds_alternative<SlurmJobs::LookAtQueue>(action)) {
      ++looks;
      jobs.on_no_queue("Unable to contact slurm controller (connect failure)", now);
    }
    now += seconds(1);
  }
  EXPECT_EQ(jobs.trouble(), "");
  EXPECT_THAT(jobs.status().note, HasSubstr("does not show its queue: Unable to contact"));
  EXPECT_LE(looks, 15);
  EXPECT_EQ(run_for(minutes(2)), 4);
  EXPECT_EQ(jobs.status().note, "");
}

TEST_F(SlurmQueue, AFirstSubmissionThatIsRefusedIsTheEnd) {
  ASSERT_TRUE(std::holds_alternative<SlurmJobs::LookAtQueue>(jobs.next(now)));
  jobs.on_queue({}, now);
  ASSERT_TRUE(std::holds_alternative<SlurmJobs::Submit>(jobs.next(now)));
  jobs.on_refused("Batch job submission failed: Invalid account", now);
  EXPECT_EQ(jobs.trouble(), "Slurm refuses jobs: Batch job submission failed: Invalid account");
  EXPECT_TRUE(std::holds_alternative<SlurmJobs::Nothing>(jobs.next(now + minutes(60))));
}

TEST_F(SlurmQueue, ASubmissionWithoutAnAnswerIsLookedForBeforeTheNext) {
  jobs.next(now);
  jobs.on_queue({}, now);
  jobs.next(now);
  jobs.on_refused("it did not answer in time", now);
  EXPECT_EQ(jobs.trouble(), "");
  for (int i = 0; i < 4; ++i)  // it came through after all
    queue.push_back({"5_" + std::to_string(i), "PENDING", "Priority"});
  EXPECT_EQ(run_for(minutes(30)), 0);
}

TEST_F(SlurmQueue, ALaterRefusalIsTriedAgain) {
  step();
  run_for(minutes(2));
  set(0, "TIMEOUT");
  bool refused = false;
  for (int i = 0; i < 300 && !refused; ++i) {
    now += seconds(1);
    const SlurmJobs::Action action = jobs.next(now);
    if (std::holds_alternative<SlurmJobs::LookAtQueue>(action)) jobs.on_queue(queue, now);
    if (!std::holds_alternative<SlurmJobs::Submit>(action)) continue;
    jobs.on_refused("Job violates accounting/QOS policy", now);
    refused = true;
  }
  ASSERT_TRUE(refused);
  EXPECT_EQ(jobs.trouble(), "");
  EXPECT_THAT(jobs.status().note, HasSubstr("QOS policy"));
  EXPECT_EQ(run_for(minutes(5)), 1);
  EXPECT_EQ(jobs.status().note, "");
}

TEST_F(SlurmQueue, AReasonThatOnlyAPersonEndsIsANote) {
  step();
  for (QueuedJob& job : queue)
    job.reason = "PartitionTimeLimit";
  run_for(minutes(1));
  EXPECT_THAT(jobs.status().note, HasSubstr("PartitionTimeLimit"));
}

TEST(SlurmQueueText, IsReadLineByLine) {
  EXPECT_THAT(parse_queue("12_0|RUNNING|None\n12_1|PENDING|Resources (x|y)\nnonsense\n|\n3|"),
              ElementsAre(QueuedJob{"12_0", "RUNNING", "None"},
                          QueuedJob{"12_1", "PENDING", "Resources (x|y)"}));
  EXPECT_TRUE(parse_queue("").empty());
}

}  // namespace
}  // namespace swarmsmith
