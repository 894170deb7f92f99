#include "coordinator/service/coordinator.h"

#include <gtest/gtest.h>

#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "tests/coordinator/synthetic_campaign.h"

namespace swarmsmith {
namespace {

using cluster::SyntheticCampaign;

/// A coordinator with one worker played by hand, peer 1.
class Coordinators : public ::testing::Test {
 protected:
  void say(pb::ToCoordinator message, PeerId peer = 1) {
    message.set_incarnation(1);
    message.set_sequence(++sequence);
    coordinator.on_frame({peer}, encode(message), now);
    move();
  }
  void hello(PeerId peer = 1) {
    pb::ToCoordinator message;
    message.mutable_hello()->set_worker_id(std::string(kWorkerIdBytes, static_cast<char>(peer)));
    message.mutable_hello()->set_slots(1);
    message.mutable_hello()->set_secret("secret");
    say(message, peer);
    message.mutable_credit()->set_tasks(1000);
    say(message, peer);
  }
  void move() {
    for (CoordinatorAction& action : coordinator.take_actions(now)) {
      if (auto* send = std::get_if<SendFrame>(&action)) {
        google::protobuf::Arena arena;
        heard.push_back(**decode_to_worker(send->frame, arena));
      } else if (auto* append = std::get_if<AppendRows>(&action)) {
        for (Row& row : append->rows)
          rows.push_back(std::move(row));
        coordinator.on_appended(0, ++ticket);
      } else {
        const PackedKey asked = key_of(std::get<AskReferee>(action).task);
        const auto truth = cluster::truth_of(shape, unpack(asked));
        coordinator.on_ruling(
            {.key = asked, .measured = {.score = truth.score, .state_digest = truth.state_digest}},
            now);
        move();
      }
    }
  }
  /// Answers the tasks heard of so far.
  void answer() {
    pb::ToCoordinator message;
    pb::Results& results = *message.mutable_results();
    results.set_scenario(digest_of_scenario("scenario"));
    for (const pb::ToWorker& said : std::exchange(heard, {})) {
      for (const pb::Task& task : said.tasks().tasks()) {
        const auto truth = cluster::truth_of(shape, unpack(*pack(task.key())));
        pb::Result& result = *results.add_results();
        *result.mutable_key() = task.key();
        result.set_attempt(task.attempt());
        result.set_signature(task.signature());
        result.set_score(truth.score);
        result.set_state_digest(truth.state_digest);
      }
    }
    say(message);
  }
  void commit() {
    coordinator.on_committed(0, ticket);
    move();
  }
  void finish() {
    for (int i = 0; i < 1000 && !coordinator.finished(); ++i) {
      answer();
      commit();
    }
  }
  int acknowledged() const {
    int count = 0;
    for (const pb::ToWorker& message : heard)
      count += message.acknowledged().keys_size();
    return count;
  }
  int count(pb::ToWorker::BodyCase body) const {
    int found = 0;
    for (const pb::ToWorker& message : heard)
      found += message.body_case() == body;
    return found;
  }

  cluster::CampaignShape shape;
  SyntheticCampaign campaign{shape};
  CoordinatorOptions options{.scheduler = {}, .scenario = "scenario", .local_secret = "secret"};
  Coordinator coordinator{options, {{.digest = "d", .source = &campaign}}};
  TimePoint now{std::chrono::seconds(50)};
  std::vector<pb::ToWorker> heard;
  std::vector<Row> rows;
  std::uint64_t ticket = 0;
  std::uint64_t sequence = 0;
};

TEST_F(Coordinators, AcknowledgeAfterTheCommitAndNotBefore) {
  hello();
  answer();
  EXPECT_EQ(acknowledged(), 0);
  EXPECT_FALSE(coordinator.settled());
  commit();
  EXPECT_GT(acknowledged(), 0);
  EXPECT_TRUE(coordinator.settled());
}

TEST_F(Coordinators, FinishTheCampaign) {
  hello();
  finish();
  EXPECT_TRUE(coordinator.finished());
  EXPECT_EQ(campaign.dump(), cluster::undisturbed_dump(shape));
}

TEST_F(Coordinators, AcknowledgeAgainWhatIsOnDisk) {
  hello();
  const std::vector<pb::ToWorker> tasks = heard;
  answer();
  commit();
  heard = tasks;
  answer();
  EXPECT_GT(acknowledged(), 0);
}

TEST_F(Coordinators, SendTheScenario) {
  hello();
  pb::ToCoordinator message;
  message.mutable_want_scenario();
  say(message);
  ASSERT_EQ(heard.back().body_case(), pb::ToWorker::kScenario);
  EXPECT_EQ(heard.back().scenario().scenario(), "scenario");
}

TEST_F(Coordinators, RefuseAPeerThatSendsRubbish) {
  hello();
  for (int i = 0; i < 10; ++i)
    coordinator.on_frame({9}, "rubbish", now);
  EXPECT_EQ(coordinator.malformed().at("length"), 10U);
  heard.clear();
  hello(9);
  EXPECT_TRUE(heard.empty());
  now += std::chrono::seconds(61);
  hello(9);
  EXPECT_EQ(count(pb::ToWorker::kWelcome), 1);
}

TEST_F(Coordinators, TellAPeerOfAnotherVersion) {
  std::string frame = encode(pb::ToCoordinator());
  frame[4] = 7;
  coordinator.on_frame({3}, frame, now);
  move();
  ASSERT_EQ(heard.size(), 1U);
  EXPECT_EQ(heard[0].reject().reason(), pb::Reject::REASON_PROTOCOL);
}

TEST_F(Coordinators, CountResultsOfAnotherCampaign) {
  hello();
  pb::ToCoordinator message;
  message.mutable_results()->set_scenario(1);
  message.mutable_results()->add_results()->mutable_key()->set_candidate(1);
  say(message);
  EXPECT_EQ(coordinator.malformed().at("campaign"), 1U);
}

TEST_F(Coordinators, ReadTheLastWordsOfAPeerThatHasGoneBeforeTheyJudge) {
  hello(1);
  hello(2);
  const std::size_t leased = coordinator.scheduler().leases().leased();
  ASSERT_GT(leased, 0U);
  coordinator.on_unreachable({1, "", {}});
  coordinator.on_unreachable({2, "", {}});
  EXPECT_TRUE(coordinator.has_unreachable());
  pb::ToCoordinator goodbye;
  goodbye.mutable_goodbye();
  say(goodbye, 1);
  EXPECT_EQ(coordinator.scheduler().counters().lost_workers, 0U);
  coordinator.on_all_read(now);
  EXPECT_FALSE(coordinator.has_unreachable());
  EXPECT_EQ(coordinator.scheduler().counters().lost_workers, 1U);
  EXPECT_EQ(coordinator.scheduler().leases().leased(), 0U);
}

pb::ToCoordinator command(pb::Command::Kind kind, std::int64_t design) {
  pb::ToCoordinator message;
  message.mutable_command()->set_kind(kind);
  message.mutable_command()->set_design(design);
  message.mutable_command()->set_who("user@here");
  return message;
}

TEST_F(Coordinators, ConfirmACommandWhenItIsOnDiskAndNotBefore) {
  say(command(pb::Command::KIND_PAUSE, 1), 5);
  EXPECT_EQ(count(pb::ToWorker::kCommandReply), 0);
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(std::get<CommandRow>(rows[0]).who, "user@here");
  commit();
  ASSERT_EQ(count(pb::ToWorker::kCommandReply), 1);
  EXPECT_TRUE(heard.back().command_reply().done());
  // There is nothing to write now.
  say(command(pb::Command::KIND_PAUSE, 1), 5);
  ASSERT_EQ(count(pb::ToWorker::kCommandReply), 2);
  EXPECT_EQ(heard.back().command_reply().sentence(),
            "nothing to do: every design is over, or already paused");
}

TEST_F(Coordinators, LeaseNothingOfWhatIsPausedUntilItIsResumed) {
  hello();
  say(command(pb::Command::KIND_PAUSE, 0), 5);
  EXPECT_EQ(coordinator.paused().size(), static_cast<std::size_t>(shape.designs));
  // A person hears that nothing will happen by itself.
  EXPECT_TRUE(std::holds_alternative<EventRow>(rows.back()));
  answer();
  commit();
  EXPECT_EQ(count(pb::ToWorker::kTasks), 0);
  EXPECT_FALSE(coordinator.finished());
  say(command(pb::Command::KIND_RESUME, 0), 5);
  EXPECT_GT(count(pb::ToWorker::kTasks), 0);
  finish();
  EXPECT_EQ(campaign.dump(), cluster::undisturbed_dump(shape));
}

TEST_F(Coordinators, KeepPausesOfTheirStore) {
  const std::vector<CommandRow> commands{{.number = 1, .kind = CommandKind::Pause, .design = {1}},
                                         {.number = 2, .kind = CommandKind::Pause, .design = {2}},
                                         {.number = 3, .kind = CommandKind::Resume, .design = {2}}};
  Coordinator again(options, {{.digest = "d", .source = &campaign, .commands = commands}});
  EXPECT_EQ(again.paused(), std::set<DesignId>{{1}});
}

TEST_F(Coordinators, RefuseCommandsThatCannotBe) {
  say(command(pb::Command::KIND_PAUSE, 99), 5);
  ASSERT_EQ(heard.back().body_case(), pb::ToWorker::kCommandReply);
  EXPECT_FALSE(heard.back().command_reply().done());
  EXPECT_NE(heard.back().command_reply().sentence().find("d99"), std::string::npos);
  pb::ToCoordinator other = command(pb::Command::KIND_PAUSE, 1);
  other.mutable_command()->set_campaign("another");
  say(other, 5);
  EXPECT_FALSE(heard.back().command_reply().done());
  EXPECT_TRUE(rows.empty());
}

TEST_F(Coordinators, WriteWhoCame) {
  hello();
  ASSERT_FALSE(rows.empty());
  EXPECT_EQ(std::get<WorkerRow>(rows[0]).state, WorkerState::Connected);
  EXPECT_EQ(std::get<WorkerRow>(rows[0]).identity.size(), 32U);
}

}  // namespace
}  // namespace swarmsmith
