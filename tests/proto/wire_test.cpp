#include "proto/wire.h"
#include "programs/cost.h"
#include "proto/key.h"
#include "proto/wire.pb.h"

#include <limits>
#include <string>
#include <vector>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using google::protobuf::Arena;

pb::ToWorker some_tasks(int count) {
  pb::ToWorker message;
  message.set_sequence(7);
  for (int i = 0; i < count; ++i) {
    pb::Task& task = *message.mutable_tasks()->add_tasks();
    task.mutable_key()->set_candidate(i + 1);
    task.mutable_key()->set_pair(3);
    task.set_machine("--nstates 1 --s0 1");
  }
  return message;
}

pb::ToCoordinator one_result(double score) {
  pb::ToCoordinator message;
  pb::Result& result = *message.mutable_results()->add_results();
  result.mutable_key()->set_candidate(1);
  result.set_score(score);
  return message;
}

std::string fault_of(const std::string& frame) {
  Arena arena;
  const auto message = decode_to_coordinator(frame, arena);
  return message ? "" : message.error().where;
}

/// A body of `field` that has `count` parts of nothing, 2 bytes each.
std::string empty_parts(int field, int part, std::size_t count) {
  std::string body;
  for (std::size_t i = 0; i < count; ++i) {
    body += static_cast<char>(part << 3 | 2);
    body += '\0';
  }
  std::string text(1, static_cast<char>(field << 3 | 2));
  for (std::size_t size = body.size(); true; size >>= 7U) {
    text += static_cast<char>(size > 127 ? (size & 127U) | 128U : size);
    if (size <= 127) break;
  }
  return text + body;
}

/// Else a megabyte makes objects of a hundred.
TEST(Wire, NamesThatAreKeptAreShort) {
  pb::ToCoordinator message;
  message.mutable_hello()->set_worker_id(std::string(kWorkerIdBytes, 'a'));
  message.mutable_hello()->set_slots(1);
  message.mutable_hello()->set_host(std::string(kMaxNameBytes, 'h'));
  EXPECT_EQ(fault_of(encode(message)), "");
  message.mutable_hello()->set_host(std::string(kMaxNameBytes + 1, 'h'));
  EXPECT_EQ(fault_of(encode(message)), "limits");
}

TEST(Wire, CountsPartsBeforeItMakesThem) {
  const std::string head = encode(pb::ToCoordinator());
  // Unknown fields whose text is not a message: cut short, a wrong tag, the end of no group.
  const std::vector<std::string> before = {
      "", {"\x7a\x02\x0a\x50", 4}, {"\x7a\x01\x00", 3}, "\x7a\x01\x0c"};
  Arena arena;
  for (int field = 1; field <= 15; ++field) {
    for (int part = 1; part <= 15; ++part) {
      for (const std::string& unknown : before) {
        const std::string frame = head + unknown + empty_parts(field, part, 400'000);
        ASSERT_LT(frame.size(), kMaxFrameBytes);
        EXPECT_EQ(why_not(decode_to_coordinator(frame, arena)).where, "limits")
            << field << " " << part;
      }
    }
  }
  EXPECT_LT(arena.SpaceAllocated(), 1U << 20U);
  EXPECT_EQ(fault_of(head + empty_parts(4, 9, 4000)), "") << "parts that are not known here";
}

/// As large as the limits let it be.
TEST(Wire, TakesTheLargestHello) {
  pb::ToCoordinator message;
  pb::Hello& hello = *message.mutable_hello();
  hello.set_worker_id(std::string(kWorkerIdBytes, 'a'));
  hello.set_slots(1);
  for (int i = 0; i < kMaxItemsPerMessage; ++i) {
    hello.add_holds()->set_candidate(i + 1);
    hello.add_attempts(i);
    hello.add_signatures(~std::uint64_t{0});
  }
  EXPECT_EQ(fault_of(encode(message)), "");
  hello.add_holds()->set_candidate(1);
  EXPECT_EQ(fault_of(encode(message)), "limits");
}

TEST(Wire, GivesBackWhatWasSent) {
  Arena arena;
  const pb::ToWorker sent = some_tasks(64);
  const auto received = value_of(decode_to_worker(encode(sent), arena));
  EXPECT_EQ(received->SerializeAsString(), sent.SerializeAsString());
}

TEST(Wire, NamesThePartThatIsWrong) {
  const std::string fine = encode(one_result(1.5));
  EXPECT_EQ(fault_of(fine), "");
  EXPECT_EQ(fault_of(""), "length");
  EXPECT_EQ(fault_of(fine.substr(0, 7)), "length");
  EXPECT_EQ(fault_of(std::string(kMaxFrameBytes + 1, 'x')), "length");
  google::protobuf::Arena arena;
  EXPECT_EQ(decode_to_worker(std::string(kMaxFrameToWorkerBytes + 1, 'x'), arena).error().where,
            "length");
  EXPECT_EQ(decode_to_worker(std::string(kMaxFrameBytes + 1, 'x'), arena).error().where, "magic");
  EXPECT_EQ(fault_of("GET / HTTP/1.1"), "magic");
  EXPECT_EQ(fault_of(fine.substr(0, fine.size() - 1)), "protobuf");
}

TEST(Wire, TellsAnotherMajorVersionFromRubbish) {
  std::string frame = encode(one_result(1));
  frame[4] = static_cast<char>(kProtocolMajor + 1);
  Arena arena;
  const Error message = why_not(decode_to_coordinator(frame, arena));
  EXPECT_EQ(message.kind, ErrorKind::Conflict);
  EXPECT_NE(message.message.find("version " + std::to_string(kProtocolMajor)), std::string::npos);
}

TEST(Wire, TakesAnotherMinorVersion) {
  std::string frame = encode(one_result(1));
  frame[6] = 99;
  EXPECT_EQ(fault_of(frame), "");
}

TEST(Wire, TakesABodyThatItDoesNotKnow) {
  std::string frame = encode(pb::ToCoordinator());
  frame += std::string("\xfa\x07\x01x", 4);  // field 127, one byte
  Arena arena;
  const auto message = value_of(decode_to_coordinator(frame, arena));
  EXPECT_EQ(message->body_case(), pb::ToCoordinator::BODY_NOT_SET);
}

TEST(Wire, RefusesScoresThatAreNoNumbersUnlessTheyFailed) {
  EXPECT_EQ(fault_of(encode(one_result(std::numeric_limits<double>::quiet_NaN()))), "limits");
  EXPECT_EQ(fault_of(encode(one_result(std::numeric_limits<double>::infinity()))), "limits");
  pb::ToCoordinator failed = one_result(std::numeric_limits<double>::quiet_NaN());
  failed.mutable_results()->mutable_results(0)->set_failure("no score");
  EXPECT_EQ(fault_of(encode(failed)), "");
}

/// Each number of a message from a worker, with the least and the most that it may be.
TEST(Wire, NumbersFromAWorkerHaveLimits) {
  const auto fault_with = [](const auto& set, auto value) {
    pb::ToCoordinator message = one_result(1);
    set(message, value);
    return fault_of(encode(message));
  };
  using Whole = std::int64_t;
  constexpr Whole kMost = std::numeric_limits<Whole>::max();
  struct Number {
    const char* name;
    void (*set)(pb::ToCoordinator& message, Whole value);
    Whole least;
    Whole most;
  };
  const auto hello = [](pb::ToCoordinator& message) -> pb::Hello& {
    message.mutable_hello()->set_worker_id(std::string(kWorkerIdBytes, 'a'));
    message.mutable_hello()->set_slots(1);
    return *message.mutable_hello();
  };
  static const auto kHello = hello;
  static const auto kResult = [](pb::ToCoordinator& message) -> pb::Result& {
    return *message.mutable_results()->mutable_results(0);
  };
  const std::vector<Number> numbers = {
      {"attempt", [](auto& m, Whole v) { kResult(m).set_attempt(v); }, 0, kMostAttempts},
      {"wall_us", [](auto& m, Whole v) { kResult(m).set_wall_us(v); }, 0, 1000 * kLongestTime_ms},
      {"pid", [](auto& m, Whole v) { kHello(m).set_pid(v); }, 0, kMostWhole},
      {"attempts",
       [](auto& m, Whole v) {
         kHello(m).add_holds()->set_candidate(1);
         kHello(m).add_attempts(v);
         kHello(m).add_signatures(1);
       },
       0, kMostAttempts},
      {"elapsed_ms",
       [](auto& m, Whole v) {
         pb::Running& running = *m.mutable_heartbeat()->add_running();
         running.mutable_key()->set_candidate(1);
         running.set_elapsed_ms(v);
       },
       0, kLongestTime_ms},
      {"design", [](auto& m, Whole v) { m.mutable_command()->set_design(v); }, 0, kMostDesigns},
      {"budget", [](auto& m, Whole v) { m.mutable_command()->set_budget(v); }, 0, kMostWhole}};
  for (const Number& number : numbers) {
    EXPECT_EQ(fault_with(number.set, number.least), "") << number.name;
    EXPECT_EQ(fault_with(number.set, number.most), "") << number.name;
    EXPECT_EQ(fault_with(number.set, number.least - 1), "limits") << number.name;
    EXPECT_EQ(fault_with(number.set, number.most + 1), "limits") << number.name;
    EXPECT_EQ(fault_with(number.set, kMost), "limits") << number.name;
  }
  const auto score = [](pb::ToCoordinator& m, double v) { kResult(m).set_score(v); };
  const auto time = [](pb::ToCoordinator& m, double v) { kResult(m).set_time(v); };
  for (const auto& set : {+score, +time}) {
    EXPECT_EQ(fault_with(set, kLargestCost), "");
    EXPECT_EQ(fault_with(set, 2 * kLargestCost), "limits");
  }
  EXPECT_EQ(fault_with(score, -2 * kLargestCost), "limits");
}

TEST(Wire, NumbersFromTheCoordinatorHaveLimits) {
  const auto fault_with = [](const auto& set, auto value) {
    Arena arena;
    pb::ToWorker message = some_tasks(1);
    set(message, value);
    const auto decoded = decode_to_worker(encode(message), arena);
    return decoded ? "" : decoded.error().where;
  };
  using Whole = std::int64_t;
  struct Number {
    const char* name;
    void (*set)(pb::ToWorker& message, Whole value);
    Whole least;
    Whole most;
  };
  static const auto kTask = [](pb::ToWorker& message) -> pb::Task& {
    return *message.mutable_tasks()->mutable_tasks(0);
  };
  const std::vector<Number> numbers = {
      {"heartbeat_ms", [](auto& m, Whole v) { m.mutable_welcome()->set_heartbeat_ms(v); }, 0,
       kLongestWait_ms},
      {"dead_after_ms", [](auto& m, Whole v) { m.mutable_welcome()->set_dead_after_ms(v); }, 0,
       kLongestWait_ms},
      {"resend_ms", [](auto& m, Whole v) { m.mutable_welcome()->set_resend_ms(v); }, 0,
       kLongestWait_ms},
      {"attempt", [](auto& m, Whole v) { kTask(m).set_attempt(v); }, 0, kMostAttempts},
      {"instance", [](auto& m, Whole v) { kTask(m).set_instance(v); }, -kMostWhole, kMostWhole},
      {"alive", [](auto& m, Whole v) { kTask(m).add_alive(v); }, 1, kMostCandidates}};
  for (const Number& number : numbers) {
    EXPECT_EQ(fault_with(number.set, number.least), "") << number.name;
    EXPECT_EQ(fault_with(number.set, number.most), "") << number.name;
    EXPECT_EQ(fault_with(number.set, number.least - 1), "limits") << number.name;
    EXPECT_EQ(fault_with(number.set, number.most + 1), "limits") << number.name;
  }
  const auto bound = [](pb::ToWorker& m, double v) { kTask(m).set_bound(v); };
  EXPECT_EQ(fault_with(bound, 0.0), "");
  EXPECT_EQ(fault_with(bound, -1.0), "limits");
}

TEST(Wire, RefusesMoreItemsThanAMessageMayHave) {
  Arena arena;
  EXPECT_TRUE(decode_to_worker(encode(some_tasks(kMaxItemsPerMessage)), arena));
  EXPECT_EQ(why_not(decode_to_worker(encode(some_tasks(kMaxItemsPerMessage + 1)), arena)).where,
            "limits");
}

TEST(Wire, RefusesAHelloWithoutAName) {
  pb::ToCoordinator message;
  message.mutable_hello()->set_slots(1);
  EXPECT_EQ(fault_of(encode(message)), "limits");
  message.mutable_hello()->set_worker_id(std::string(kWorkerIdBytes, 'a'));
  EXPECT_EQ(fault_of(encode(message)), "");
  message.mutable_hello()->set_slots(kMaxSlots + 1);
  EXPECT_EQ(fault_of(encode(message)), "limits");
}

TEST(Wire, RefusesACommandBeyondItsLimits) {
  const auto fault_with = [](const auto& change) {
    pb::ToCoordinator message;
    pb::Command& command = *message.mutable_command();
    command.set_campaign(std::string(kMaxTextBytes, 'c'));
    change(command);
    return fault_of(encode(message));
  };
  EXPECT_EQ(fault_with([](pb::Command&) {}), "");
  const std::string long_text(kMaxTextBytes + 1, 'x');
  EXPECT_EQ(fault_with([&](pb::Command& command) { command.set_campaign(long_text); }), "limits");
  EXPECT_EQ(fault_with([&](pb::Command& command) { command.set_who(long_text); }), "limits");
  EXPECT_EQ(fault_with([&](pb::Command& command) { command.set_whom(long_text); }), "limits");
  EXPECT_EQ(fault_with([](pb::Command& command) { command.set_design(-1); }), "limits");
  EXPECT_EQ(fault_with([](pb::Command& command) { command.set_budget(-1); }), "limits");
}

}  // namespace
}  // namespace swarmsmith
