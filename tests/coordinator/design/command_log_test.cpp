#include "coordinator/design/command_log.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

CommandRow command(std::int64_t number, CommandKind kind,
                   std::optional<std::int64_t> step = std::nullopt) {
  return {.number = number, .kind = kind, .design = {1}, .step = step, .budget = 100};
}

TEST(CommandLog, WhatHasActedActsAgainAfterItsStepAndNothingBeforeIt) {
  CommandLog log({command(1, CommandKind::Cancel), command(2, CommandKind::Extend, 9),
                  command(3, CommandKind::Extend, 4)});
  EXPECT_EQ(log.next(CommandKind::Extend, 3), nullptr);
  EXPECT_EQ(log.next(CommandKind::Cancel, 3), nullptr)
      << "a new one waits for those that have acted";
  ASSERT_NE(log.next(CommandKind::Extend, 4), nullptr);
  EXPECT_EQ(log.next(CommandKind::Extend, 4)->number, 3) << "the order is that of the steps";
  EXPECT_EQ(log.act(*log.next(CommandKind::Extend, 4), 4).step, 4);
  EXPECT_EQ(log.next(CommandKind::Extend, 4), nullptr);
  log.act(*log.next(CommandKind::Extend, 9), 9);
  ASSERT_NE(log.next(CommandKind::Cancel, 9), nullptr);
  EXPECT_EQ(log.next(CommandKind::Cancel, 9)->number, 1);
}

TEST(CommandLog, ANewCommandActsAtAnyStepOnce) {
  CommandLog log({});
  log.add(command(1, CommandKind::Extend, 7));
  ASSERT_NE(log.next(CommandKind::Extend, 2), nullptr)
      << "its step is the one after which it acts here";
  EXPECT_EQ(log.next(CommandKind::Cancel, 2), nullptr);
  EXPECT_EQ(log.act(*log.next(CommandKind::Extend, 2), 2).step, 2);
  EXPECT_EQ(log.next(CommandKind::Extend, 2), nullptr);
  EXPECT_EQ(log.all().front().step, 2);
}

}  // namespace
}  // namespace swarmsmith
