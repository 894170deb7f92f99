#include "proto/wire.h"
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
