#include "coordinator/design/command_log.h"

#include <gtest/gtest.h>

namespace swarmsmith {
namespace {

CommandRow command(std::int64_t number, const char* kind,
                   std::optional<std::int64_t> step = std::nullopt) {
  return {.number = number, .kind = kind, .design = {1}, .step = step, .budget = 100};
}

TEST(CommandLog, WhatHasActedActsAgainAfterItsStepAndNothingBeforeIt) {
  CommandLog log({command(1, "cancel"), command(2, "extend", 9), command(3, "extend", 4)});
  EXPECT_EQ(log.next("extend", 3), nullptr);
  EXPECT_EQ(log.next("cancel", 3), nullptr) << "a new one waits for those that have acted";
  ASSERT_NE(log.next("extend", 4), nullptr);
  EXPECT_EQ(log.next("extend", 4)->number, 3) << "the order is that of the steps";
  EXPECT_EQ(log.act(*log.next("extend", 4), 4).step, 4);
  EXPECT_EQ(log.next("extend", 4), nullptr);
  log.act(*log.next("extend", 9), 9);
  ASSERT_NE(log.next("cancel", 9), nullptr);
  EXPECT_EQ(log.next("cancel", 9)->number, 1);
}

TEST(CommandLog, ANewCommandActsAtAnyStepOnce) {
  CommandLog log({});
  log.add(command(1, "extend", 7));
  ASSERT_NE(log.next("extend", 2), nullptr) << "its step is the one after which it acts here";
  EXPECT_EQ(log.next("cancel", 2), nullptr);
  EXPECT_EQ(log.act(*log.next("extend", 2), 2).step, 2);
  EXPECT_EQ(log.next("extend", 2), nullptr);
  EXPECT_EQ(log.all().front().step, 2);
}

}  // namespace
}  // namespace swarmsmith
