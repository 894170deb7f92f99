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
  EXPECT_EQ(read.instance, -3);
  EXPECT_EQ(read.seed, 4);
  EXPECT_EQ(read.machine, task.machine);
  EXPECT_EQ(read.bound, 0.1);
  EXPECT_EQ(read.alive, task.alive);
  EXPECT_EQ(read.key, task.key);
  EXPECT_EQ(read.attempt, 10);
  EXPECT_EQ(read.signature, 11U);
  EXPECT_TRUE(read.alone);
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
  pb::Result message;
  write({.key = pack(1, 0, 1),
         .measured = {.score = -0.0},
         .failure = std::string(2 * kMaxTextBytes, 'x')},
        message);
  EXPECT_EQ(result_of(message).failure.size(), kMaxTextBytes);
  EXPECT_FALSE(std::signbit(result_of(message).measured.score));
}

}  // namespace
}  // namespace swarmsmith
