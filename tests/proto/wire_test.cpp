#include "proto/wire.h"
#include "programs/cost.h"
#include "proto/key.h"
#include "proto/wire.pb.h"

#include <functional>
#include <limits>
#include <string>
#include <utility>
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

std::string fault_of(const pb::ToCoordinator& message) {
  return fault_of(encode(message));
}
std::string fault_of(const pb::ToWorker& message) {
  Arena arena;
  const auto decoded = decode_to_worker(encode(message), arena);
  return decoded ? "" : decoded.error().where;
}

/// The least that a coordinator takes.
pb::ToCoordinator a_hello() {
  pb::ToCoordinator message;
  message.mutable_hello()->set_worker_id(std::string(kWorkerIdBytes, 'a'));
  message.mutable_hello()->set_slots(1);
  return message;
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

/// Each text with a limit, with the most bytes that it may have. Names are kept for each worker, so
/// they are short.
TEST(Wire, TextsHaveLimits) {
  const auto expect_limit = [](const char* name, auto message, std::size_t most, const auto& set) {
    set(message, std::string(most, 't'));
    EXPECT_EQ(fault_of(message), "") << name;
    set(message, std::string(most + 1, 't'));
    EXPECT_EQ(fault_of(message), "limits") << name;
  };
  using Text = const std::string&;
  const std::pair<const char*, void (*)(pb::Hello&, Text)> names[] = {
      {"build", [](pb::Hello& hello, Text text) { hello.set_build(text); }},
      {"self_test", [](pb::Hello& hello, Text text) { hello.set_self_test(text); }},
      {"host", [](pb::Hello& hello, Text text) { hello.set_host(text); }},
      {"job", [](pb::Hello& hello, Text text) { hello.set_job(text); }},
      {"cpu", [](pb::Hello& hello, Text text) { hello.set_cpu(text); }},
      {"secret", [](pb::Hello& hello, Text text) { hello.set_secret(text); }}};
  for (const auto& row : names) {
    expect_limit(row.first, a_hello(), kMaxNameBytes,
                 [&](auto& m, Text text) { row.second(*m.mutable_hello(), text); });
  }
  const std::pair<const char*, void (*)(pb::Result&, Text)> of_results[] = {
      {"failure", [](pb::Result& result, Text text) { result.set_failure(text); }},
      {"command", [](pb::Result& result, Text text) { result.set_command(text); }},
      {"output", [](pb::Result& result, Text text) { result.set_output(text); }},
      {"errors", [](pb::Result& result, Text text) { result.set_errors(text); }}};
  for (const auto& row : of_results) {
    expect_limit(row.first, one_result(1), kMaxTextBytes, [&](auto& m, Text text) {
      row.second(*m.mutable_results()->mutable_results(0), text);
    });
  }
  const std::pair<const char*, void (*)(pb::Command&, Text)> of_commands[] = {
      {"campaign", [](pb::Command& command, Text text) { command.set_campaign(text); }},
      {"who", [](pb::Command& command, Text text) { command.set_who(text); }},
      {"whom", [](pb::Command& command, Text text) { command.set_whom(text); }}};
  for (const auto& row : of_commands) {
    expect_limit(row.first, pb::ToCoordinator(), kMaxTextBytes,
                 [&](auto& m, Text text) { row.second(*m.mutable_command(), text); });
  }
  expect_limit("machine", some_tasks(1), kMaxMachineBytes,
               [](auto& m, Text text) { m.mutable_tasks()->mutable_tasks(0)->set_machine(text); });
  expect_limit("reject", pb::ToWorker(), kMaxTextBytes,
               [](auto& m, Text text) { m.mutable_reject()->set_sentence(text); });
  expect_limit("notice", pb::ToWorker(), kMaxTextBytes,
               [](auto& m, Text text) { m.mutable_notice()->set_sentence(text); });
}

/// Each message with keys: what is not a key is refused everywhere, and so are too many items.
TEST(Wire, KeysAreCheckedWhereverTheyAre) {
  const auto expect_keys = [](const char* name, auto message, const auto& add, bool repeated) {
    add(message).set_candidate(1);
    EXPECT_EQ(fault_of(message), "") << name;
    auto faulty = message;
    add(faulty).set_candidate(0);
    EXPECT_EQ(fault_of(faulty), "limits") << name;
    if (!repeated) return;
    for (int i = 1; i < kMaxItemsPerMessage; ++i)
      add(message).set_candidate(1);
    EXPECT_EQ(fault_of(message), "") << name;
    add(message).set_candidate(1);
    EXPECT_EQ(fault_of(message), "limits") << name;
  };
  using Up = pb::ToCoordinator;
  using Down = pb::ToWorker;
  const auto key_of_task = [](auto& m) -> auto& {
    return *m.mutable_tasks()->add_tasks()->mutable_key();
  };
  const auto key_of_result = [](auto& m) -> auto& {
    return *m.mutable_results()->add_results()->mutable_key();
  };
  const auto key_of_running = [](auto& m) -> auto& {
    return *m.mutable_heartbeat()->add_running()->mutable_key();
  };
  expect_keys(
      "holds", a_hello(), [](auto& m) -> auto& { return *m.mutable_hello()->add_holds(); }, true);
  expect_keys("results", Up(), key_of_result, true);
  expect_keys("running", Up(), key_of_running, true);
  expect_keys("running", Down(), key_of_running, true);
  expect_keys(
      "returned", Up(), [](auto& m) -> auto& { return *m.mutable_returned()->add_keys(); }, true);
  expect_keys(
      "began", Up(), [](auto& m) -> auto& { return *m.mutable_began()->mutable_key(); }, false);
  expect_keys("tasks", Down(), key_of_task, true);
  expect_keys(
      "acknowledged", Down(),
      [](auto& m) -> auto& { return *m.mutable_acknowledged()->add_keys(); }, true);
}

TEST(Wire, TakesBodiesWithoutLimits) {
  Arena arena;
  const std::function<void(pb::ToCoordinator&)> up[] = {
      [](auto& m) { m.mutable_want_status(); }, [](auto& m) { m.mutable_credit()->set_tasks(7); },
      [](auto& m) { m.mutable_goodbye(); }, [](auto& m) { m.mutable_want_scenario(); }};
  for (const auto& make : up) {
    pb::ToCoordinator sent;
    make(sent);
    const auto received = value_of(decode_to_coordinator(encode(sent), arena));
    EXPECT_EQ(received->SerializeAsString(), sent.SerializeAsString());
    EXPECT_NE(received->body_case(), pb::ToCoordinator::BODY_NOT_SET);
  }
  const std::function<void(pb::ToWorker&)> down[] = {
      [](auto& m) { m.mutable_scenario(); }, [](auto& m) { m.mutable_drain(); },
      [](auto& m) { m.mutable_who_are_you(); }, [](auto& m) { m.mutable_command_reply(); },
      [](auto& m) { m.mutable_status_reply(); }};
  for (const auto& make : down) {
    pb::ToWorker sent;
    make(sent);
    const auto received = value_of(decode_to_worker(encode(sent), arena));
    EXPECT_EQ(received->SerializeAsString(), sent.SerializeAsString());
    EXPECT_NE(received->body_case(), pb::ToWorker::BODY_NOT_SET);
  }
  EXPECT_EQ(fault_of(pb::ToWorker()), "");
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

/// The items of a message and 64 other fields; nested parts, and fields that are not messages,
/// count.
TEST(Wire, CountsEveryPart) {
  const std::string head = encode(pb::ToCoordinator());
  constexpr std::size_t kMostParts = kMaxItemsPerMessage + 64;
  const auto numbers = [](std::size_t count) {
    std::string fields;
    for (std::size_t i = 0; i < count; ++i)
      fields += std::string("\x78\x01", 2);  // field 15, the number 1
    return fields;
  };
  EXPECT_EQ(fault_of(head + numbers(kMostParts)), "");
  EXPECT_EQ(fault_of(head + numbers(kMostParts + 1)), "limits");
  // Field 15 itself is a part, too.
  EXPECT_EQ(fault_of(head + empty_parts(15, 9, kMostParts - 1)), "");
  EXPECT_EQ(fault_of(head + empty_parts(15, 9, kMostParts)), "limits");
  EXPECT_EQ(fault_of(head + numbers(1) + empty_parts(15, 9, kMostParts - 2)), "");
  EXPECT_EQ(fault_of(head + numbers(1) + empty_parts(15, 9, kMostParts - 1)), "limits");
  // Frames that are cut are no message: in a number, in a length, in a text.
  for (const char* cut : {"\x78\x80", "\x7a\x80", "\x7a\x7f\x01", "\x78\x01\x7a\x04\x01"})
    EXPECT_EQ(fault_of(head + cut), "protobuf");
  // Two megabytes are said, so nothing after it has to be counted.
  EXPECT_EQ(fault_of(head + "\x7a\xff\xff\x7f" + numbers(kMostParts + 1)), "protobuf");
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

TEST(Wire, BeginsWithTheVersions) {
  // SWRM, version 4.1 as two little-endian words, and field 3 of the message.
  EXPECT_EQ(encode(a_hello()).substr(0, 9), std::string("SWRM\4\0\1\0\x1a", 9));
  EXPECT_EQ(encode(pb::ToWorker()), std::string("SWRM\4\0\1\0", 8));
}

TEST(Wire, NamesThePartThatIsWrong) {
  const std::string fine = encode(one_result(1.5));
  Arena arena;
  const auto error_of = [&](const std::string& frame) {
    return why_not(decode_to_coordinator(frame, arena));
  };
  const auto bad = [](const std::string& message, const std::string& where) {
    return Error{ErrorKind::BadInput, message, where};
  };
  EXPECT_EQ(fault_of(fine), "");
  EXPECT_EQ(error_of(""), bad("a frame of 0 bytes; expected 8 to 1048576", "length"));
  EXPECT_EQ(error_of(fine.substr(0, 7)),
            bad("a frame of 7 bytes; expected 8 to 1048576", "length"));
  EXPECT_EQ(fault_of(fine.substr(0, 8)), "") << "an empty message";
  EXPECT_EQ(error_of(std::string(kMaxFrameBytes + 1, 'x')),
            bad("a frame of 1048577 bytes; expected 8 to 1048576", "length"));
  EXPECT_EQ(fault_of(std::string(kMaxFrameBytes, 'x')), "magic");
  EXPECT_EQ(why_not(decode_to_worker(std::string(kMaxFrameToWorkerBytes + 1, 'x'), arena)),
            bad("a frame of 33554433 bytes; expected 8 to 33554432", "length"));
  EXPECT_EQ(why_not(decode_to_worker(std::string(kMaxFrameToWorkerBytes, 'x'), arena)).where,
            "magic");
  EXPECT_EQ(error_of("GET / HTTP/1.1"), bad("a frame that does not begin with SWRM", "magic"));
  EXPECT_EQ(error_of(fine.substr(0, fine.size() - 1)),
            bad("a frame that is not a message of this protocol", "protobuf"));
  EXPECT_EQ(error_of(encode(pb::ToCoordinator()) + empty_parts(15, 9, 5000)),
            bad("a message with more parts than the protocol's limits", "limits"));
  EXPECT_EQ(error_of(encode(one_result(std::numeric_limits<double>::infinity()))),
            bad("a message with a value outside of the protocol's limits", "limits"));
}

TEST(Wire, TellsAnotherMajorVersionFromRubbish) {
  std::string frame = encode(one_result(1));
  Arena arena;
  // Both bytes of the number count.
  for (const auto& [byte, version] : {std::pair(4, "5"), std::pair(5, "260")}) {
    std::string other = frame;
    ++other[static_cast<std::size_t>(byte)];
    EXPECT_EQ(why_not(decode_to_coordinator(other, arena)),
              (Error{ErrorKind::Conflict,
                     std::string("the peer speaks version ") + version +
                         " of the protocol, this program version 4: install the same release on "
                         "both sides",
                     "major version"}));
  }
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

TEST(Wire, KnowsAScenarioByItsBytes) {
  EXPECT_EQ(digest_of_scenario("abc"), digest_of_scenario(std::string("abc")));
  EXPECT_NE(digest_of_scenario("abc"), digest_of_scenario("abd"));
  EXPECT_NE(digest_of_scenario(""), digest_of_scenario("abc"));
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
  EXPECT_EQ(fault_with(score, -kLargestCost), "");
  EXPECT_EQ(fault_with(score, -2 * kLargestCost), "limits");
  EXPECT_EQ(fault_with(time, 0.0), "");
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(fault_with(time, wrong), "limits");
  // Of a failure, only the score may be anything.
  const auto failed_with = [&](const auto& set, double value) {
    pb::ToCoordinator message = one_result(1);
    kResult(message).set_failure("no score");
    set(message, value);
    return fault_of(message);
  };
  EXPECT_EQ(failed_with(score, 2 * kLargestCost), "");
  EXPECT_EQ(failed_with(time, 2 * kLargestCost), "limits");
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
  for (const double fine : {0.0, kLargestCost})
    EXPECT_EQ(fault_with(bound, fine), "");
  for (const double wrong : {-1.0, 2 * kLargestCost, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(fault_with(bound, wrong), "limits");
}

TEST(Wire, RefusesMoreNumbersThanAMessageMayHave) {
  pb::ToWorker message = some_tasks(1);
  for (int i = 0; i < kMaxItemsPerMessage; ++i)
    message.mutable_tasks()->mutable_tasks(0)->add_alive(1);
  EXPECT_EQ(fault_of(message), "");
  message.mutable_tasks()->mutable_tasks(0)->add_alive(1);
  EXPECT_EQ(fault_of(message), "limits");
  pb::ToCoordinator hello = a_hello();
  for (int i = 0; i < kMaxItemsPerMessage; ++i)
    hello.mutable_hello()->add_attempts(1);
  EXPECT_EQ(fault_of(hello), "");
  hello.mutable_hello()->add_attempts(1);
  EXPECT_EQ(fault_of(hello), "limits");
}

TEST(Wire, RefusesAHelloWithoutANameOrSlots) {
  const auto fault_with = [](const std::string& name, std::uint32_t slots) {
    pb::ToCoordinator message;
    message.mutable_hello()->set_worker_id(name);
    message.mutable_hello()->set_slots(slots);
    return fault_of(message);
  };
  for (const std::size_t wrong : {std::size_t{0}, kWorkerIdBytes - 1, kWorkerIdBytes + 1})
    EXPECT_EQ(fault_with(std::string(wrong, 'a'), 1), "limits") << wrong;
  const std::string name(kWorkerIdBytes, 'a');
  EXPECT_EQ(fault_with(name, 0), "limits");
  EXPECT_EQ(fault_with(name, 1), "");
  EXPECT_EQ(fault_with(name, kMaxSlots), "");
  EXPECT_EQ(fault_with(name, kMaxSlots + 1), "limits");
}

TEST(Wire, LeasesOfAHelloHaveTheirKeysAttemptsAndSignatures) {
  const auto fault_with = [](int keys, int attempts, int signatures) {
    pb::ToCoordinator message = a_hello();
    for (int i = 0; i < keys; ++i)
      message.mutable_hello()->add_holds()->set_candidate(i + 1);
    for (int i = 0; i < attempts; ++i)
      message.mutable_hello()->add_attempts(1);
    for (int i = 0; i < signatures; ++i)
      message.mutable_hello()->add_signatures(1);
    return fault_of(message);
  };
  EXPECT_EQ(fault_with(2, 2, 2), "");
  EXPECT_EQ(fault_with(2, 0, 0), "") << "of an older worker";
  EXPECT_EQ(fault_with(2, 2, 1), "limits");
  EXPECT_EQ(fault_with(2, 1, 2), "limits");
  EXPECT_EQ(fault_with(1, 2, 2), "limits");
}

}  // namespace
}  // namespace swarmsmith
