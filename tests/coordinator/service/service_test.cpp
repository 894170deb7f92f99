#include "coordinator/service/service.h"

#include <atomic>
#include <mutex>
#include <thread>

#include "base/rng.h"
#include "proto/task_messages.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"
#include "tests/coordinator/service/running_service.h"
#include "tests/coordinator/synthetic_campaign.h"
#include "worker/service.h"
#include "worker/slots.h"

namespace swarmsmith {
namespace {

using cluster::CampaignShape;
using cluster::SyntheticCampaign;

/// Evaluates a synthetic campaign in this process; not while it is `paused`.
EvaluatorFactory honest(const CampaignShape& shape, const std::atomic<bool>& paused) {
  return [shape, &paused](const std::string&) -> Expected<Evaluator> {
    return Evaluator([shape, &paused](const LeasedTask& item) -> Result {
      paused.wait(true);
      const cluster::Truth truth = cluster::truth_of(shape, unpack(item.key));
      if (truth.kind != cluster::Truth::Kind::Score) return Result{.failure = "planted"};
      return Result{.measured = {.score = truth.score, .state_digest = truth.state_digest}};
    });
  };
}

/// A referee in this process, which knows the truth.
class HonestReferee final : public Referee {
 public:
  HonestReferee(const CampaignShape& shape, std::function<void()> on_ruling)
      : shape_(shape), on_ruling_(std::move(on_ruling)) {}
  void judge(AskReferee ask) override {
    const cluster::Truth truth = cluster::truth_of(shape_, ask.task.key);
    const bool has_score = truth.kind == cluster::Truth::Kind::Score;
    rulings_.push_back({.key = key_of(ask.task),
                        .kind = has_score ? Ruling::Kind::Score : Ruling::Kind::Rejected,
                        .measured = {.score = truth.score, .state_digest = truth.state_digest},
                        .reason = has_score ? "" : "planted"});
    on_ruling_();
  }
  std::vector<Ruling> take_rulings() override { return std::exchange(rulings_, {}); }

 private:
  CampaignShape shape_;
  std::function<void()> on_ruling_;
  std::vector<Ruling> rulings_;
};

class Services : public RunningService {
 protected:
  void open(CampaignShape of = {}) { open_with({}, of); }

  void open_with(ServiceOptions options, CampaignShape of) {
    shape = of;
    campaign = std::make_unique<SyntheticCampaign>(shape);
    options.coordinator.scenario = "scenario";
    options.make_referee = [of](const std::string&, std::function<void()> on_ruling) {
      return std::make_unique<HonestReferee>(of, std::move(on_ruling));
    };
    serve_campaign(options, *campaign);
  }

  std::jthread worker(std::string build = "1", int engine = 0) {
    return std::jthread([this, build, engine] {
      Wakeup wakeup;
      Pool pool(2, honest(shape, paused), [&] { wakeup.notify(); });
      WorkerIdentity identity = identity_of_this_process(2, build);
      identity.engine_version = engine;
      last_end = serve(
          {.endpoint = service->endpoint(), .keys = worker_keys, .protocol = {}, .socket = {}},
          identity, pool, wakeup, never);
    });
  }

  CampaignShape shape;
  std::unique_ptr<SyntheticCampaign> campaign;
  const std::atomic<bool> never{false};
  std::optional<ClientKeys> worker_keys;
  std::atomic<bool> paused{false};
  WorkerEnd last_end;
};

TEST_F(Services, RunACampaignToItsEndAndSendWorkersHome) {
  open({.seed = 3, .failing = true});
  {
    const std::jthread loop = run();
    const std::jthread one = worker();
    ASSERT_TRUE(comes_to_an_end());
  }
  EXPECT_EQ(end.how, ServiceEnd::How::Finished);
  EXPECT_EQ(campaign->dump(), cluster::undisturbed_dump(shape));
  EXPECT_EQ(campaign->complaint(), "");
  EXPECT_EQ(last_end.code, WorkerExit::Done);
}

TEST_F(Services, KeepHonestWorkersUnaffectedByBadPeers) {
  open({.seed = 4, .designs = 20, .candidates = 20, .steps = 30});
  {
    const std::jthread loop = run();
    const std::jthread one = worker();
    std::vector<std::unique_ptr<ClientSocket>> bad;
    Rng rng(1);
    pb::ToCoordinator replayed;
    replayed.set_incarnation(1);
    replayed.mutable_results()->set_scenario(digest_of_scenario("scenario"));
    replayed.mutable_results()->add_results()->mutable_key()->set_candidate(1);
    std::string other_version = encode(replayed);
    other_version[4] = 9;
    for (int i = 0; i < 6; ++i) {
      bad.push_back(std::make_unique<ClientSocket>(service->endpoint()));
      bad.back()->connect();
      for (int j = 0; j < 40; ++j) {
        std::string garbage(rng.below(200), '\0');
        for (char& c : garbage)
          c = static_cast<char>(rng.below(256));
        bad.back()->send(garbage);
        bad.back()->send("SWRM" + garbage);
        bad.back()->send(encode(replayed));
        bad.back()->send(other_version);
      }
      bad.back()->send(std::string(kMaxFrameBytes + 1, 'x'));
    }
    ASSERT_TRUE(comes_to_an_end());
  }
  EXPECT_EQ(end.how, ServiceEnd::How::Finished);
  EXPECT_EQ(campaign->dump(), cluster::undisturbed_dump(shape));
  EXPECT_TRUE(store.rows_of<ConflictRow>().empty());
}

TEST_F(Services, RefuseAWorkerOfAnotherBuild) {
  open();
  std::jthread loop = run();
  { const std::jthread one = worker("other", 99); }
  EXPECT_EQ(last_end.code, WorkerExit::Refused);
  EXPECT_THAT(last_end.reason, HasSubstr("version 99"));
  stop(loop);
  EXPECT_EQ(end.how, ServiceEnd::How::Interrupted);
}

TEST_F(Services, StopLeasingWhileTheDiskIsFull) {
  open({.seed = 5});
  store.set_trouble("disk full");
  const std::jthread loop = run();
  const std::jthread one = worker();
  ASSERT_TRUE(eventually([&] { return in_trouble.load() && workers.load() == 1; }));
  EXPECT_FALSE(ended.load());
  EXPECT_EQ(done.load(), 0);
  store.set_trouble("");
  ASSERT_TRUE(comes_to_an_end());
  EXPECT_EQ(end.how, ServiceEnd::How::Finished);
}

TEST_F(Services, ListenOnLoopbackOnly) {
  SyntheticCampaign source({});
  ServiceOptions options;
  options.bind = "tcp://0.0.0.0:*";
  EXPECT_EQ(why_not(Service::open(options, {{"d", &store, &source}})).kind, ErrorKind::BadInput);
}

/// A service that only listed keys reach.
class SecureServices : public Services {
 protected:
  ServiceOptions options() const {
    ServiceOptions with_keys;
    with_keys.keys = ServerKeys{.secret_key = server.secret_key, .clients = clients};
    return with_keys;
  }
  ClientKeys keys_of(const KeyPair& pair) const {
    return {.secret_key = pair.secret_key, .server_key = server.public_key};
  }
  std::unique_ptr<ClientSocket> connect(const KeyPair& pair) const {
    auto socket =
        std::make_unique<ClientSocket>(service->endpoint(), SocketOptions(), keys_of(pair));
    socket->connect();
    return socket;
  }

  const KeyPair server = make_key_pair();
  const KeyPair node = make_key_pair();
  const KeyPair desk = make_key_pair();
  const std::vector<ListedClient> clients = {
      {.name = "node", .role = Role::Worker, .public_key = node.public_key},
      {.name = "desk", .role = Role::Reader, .public_key = desk.public_key}};
};

TEST_F(SecureServices, LetAKeyDoWhatItsRoleAllowsAndNothingElse) {
  open_with(options(), {.seed = 5});
  {
    const std::jthread loop = run();
    pb::ToCoordinator results;
    results.set_incarnation(1);
    results.mutable_results()->set_scenario(digest_of_scenario("scenario"));
    results.mutable_results()->add_results()->mutable_key()->set_candidate(1);
    pb::ToCoordinator command;
    command.mutable_command()->set_kind(pb::Command::KIND_CANCEL);
    pb::ToCoordinator question;
    question.mutable_want_status();
    const auto reader = connect(desk);
    reader->send(encode(results));
    reader->send(encode(command));
    const auto worker_key = connect(node);
    worker_key->send(encode(command));
    worker_key->send(encode(question));
    ASSERT_TRUE(eventually([&] { return malformed.load() == 4; })) << malformed.load();
    // Each gets the reason.
    std::string frame;
    google::protobuf::Arena arena;
    for (ClientSocket* peer : {reader.get(), worker_key.get()}) {
      for (int i = 0; i < 2; ++i) {
        ASSERT_TRUE(eventually([&] { return peer->receive(frame); }));
        EXPECT_THAT((*decode_to_worker(frame, arena))->reject().sentence(),
                    HasSubstr(peer == reader.get() ? "\"desk\"" : "\"node\""));
      }
    }
    reader->send(encode(question));
    ASSERT_TRUE(eventually([&] { return reader->receive(frame); }));
    EXPECT_TRUE((*decode_to_worker(frame, arena))->has_status_reply());
    worker_keys = keys_of(node);
    const std::jthread one = worker();
    ASSERT_TRUE(comes_to_an_end());
  }
  EXPECT_EQ(end.how, ServiceEnd::How::Finished);
  EXPECT_EQ(campaign->dump(), cluster::undisturbed_dump(shape));
}

TEST_F(SecureServices, CutAWorkerOffWhoseKeyIsRevokedAndBlameNoWorker) {
  std::mutex mutex;
  std::optional<std::vector<ListedClient>> news;
  const auto publish = [&](std::vector<ListedClient> list) {
    const std::scoped_lock lock(mutex);
    news = std::move(list);
  };
  ServiceOptions with_news = options();
  with_news.new_clients = [&] {
    const std::scoped_lock lock(mutex);
    return std::exchange(news, std::nullopt);
  };
  open_with(std::move(with_news), {.seed = 6});
  paused = true;
  {
    const std::jthread loop = run();
    worker_keys = keys_of(node);
    const std::jthread one = worker();
    EXPECT_TRUE(eventually([&] { return workers.load() == 1; }));
    publish({clients[1]});
    EXPECT_TRUE(eventually([&] { return revoked.load() == 1 && workers.load() == 0; }));
    EXPECT_FALSE(ended.load());
    publish(clients);
    paused = false;
    paused.notify_all();
    ASSERT_TRUE(comes_to_an_end());
  }
  EXPECT_EQ(end.how, ServiceEnd::How::Finished);
  EXPECT_EQ(campaign->dump(), cluster::undisturbed_dump(shape));
  EXPECT_EQ(campaign->complaint(), "");
  for (const EventRow& event : store.rows_of<EventRow>())
    EXPECT_THAT(event.text, Not(HasSubstr("connection closed")));
}

}  // namespace
}  // namespace swarmsmith
