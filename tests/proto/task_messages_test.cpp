#include "proto/task_messages.h"

#include <gtest/gtest.h>
#include <cmath>
#include <string>

#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith {
namespace {

TEST(TaskMessages, GiveBackTheTask) {
  const LeasedTask task{{.mission = 1,
                         .method = 2,
                         .profile = 12,
                         .instance = -3,
                         .seed = 4,
                         .machine = "--nstates 1\xff",
                         .bound = 0.1,
                         .alive = {5, 6}},
                        pack(7, kTestPurpose, 8, 9),
                        10,
                        11,
                        true};
  pb::Task message;
  write(task, message);
  const LeasedTask read = task_of(message);
  EXPECT_EQ(read.mission, 1U);
  EXPECT_EQ(read.method, 2U);
  EXPECT_EQ(read.profile, 12U);
  EXPECT_EQ(read.instance, -3);
  EXPECT_EQ(read.seed, 4);
  EXPECT_EQ(read.machine, task.machine);
  EXPECT_EQ(read.bound, 0.1);
  EXPECT_EQ(read.alive, task.alive);
  EXPECT_EQ(read.key, task.key);
  EXPECT_EQ(read.attempt, 10);
  EXPECT_EQ(read.signature, 11U);
  EXPECT_TRUE(read.alone);
  // One evaluation of the test with a whole key.
  EXPECT_EQ(message.key().campaign(), 9U);
  EXPECT_EQ(message.key().candidate(), 7);
  EXPECT_EQ(message.key().purpose(), kTestPurpose);
  EXPECT_EQ(message.key().pair(), 8);
  write(LeasedTask{{}, pack(1, 0, 0), 0, 0, false}, message);
  EXPECT_FALSE(task_of(message).alone);
  EXPECT_TRUE(task_of(message).alive.empty()) << "nothing of the task before";
}

TEST(TaskMessages, GiveBackTheResult) {
  const Result result{.key = pack(7, 0, 8, 9),
                      .attempt = 1,
                      .measured = {.score = 1.0 / 3, .state_digest = 2, .wall_us = 3, .time = 0.5},
                      .rejected = true,
                      .failure = "why",
                      .details = {"called", "out", "err"},
                      .signature = 4};
  pb::Result message;
  write(result, message);
  const Result read = result_of(message);
  EXPECT_EQ(read.key, result.key);
  EXPECT_EQ(read.attempt, 1);
  EXPECT_EQ(measured_fields(read.measured), measured_fields(result.measured));
  EXPECT_TRUE(read.rejected);
  EXPECT_EQ(read.failure, "why");
  EXPECT_EQ(read.details, result.details);
  EXPECT_EQ(read.signature, 4U);
}

TEST(TaskMessages, CutTextsAndKnowOneZero) {
  const std::string text(2 * kMaxTextBytes, 'x');
  const std::string part(kMaxTextBytes, 'x');
  pb::Result message;
  write({.key = pack(1, 0, 1),
         .measured = {.score = -0.0},
         .failure = text,
         .details = {text, text, text}},
        message);
  const Result read = result_of(message);
  EXPECT_EQ(read.failure, part);
  EXPECT_EQ(read.details, (FailureDetails{part, part, part}));
  EXPECT_FALSE(std::signbit(read.measured.score));
}

TEST(TaskMessages, HaveDetailsOfFailuresOnly) {
  pb::Result message;
  write({.key = pack(1, 0, 1), .measured = {.score = 2.5}, .details = {"called", "out", "err"}},
        message);
  EXPECT_EQ(result_of(message).details, FailureDetails{});
  EXPECT_FALSE(result_of(message).rejected);
  EXPECT_EQ(result_of(message).measured.score, 2.5);
}

}  // namespace
}  // namespace swarmsmith
