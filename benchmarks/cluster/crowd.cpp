#include "benchmarks/cluster/crowd.h"

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <deque>
#include <optional>
#include <queue>
#include <thread>
#include <utility>
#include <vector>
#include <zmq.hpp>

#include "base/hash.h"
#include "base/overloaded.h"
#include "worker/protocol.h"
#include "worker/slots.h"

namespace swarmsmith::bench {
namespace {

/// Time between two rounds over all workers, and the longest delay of a result.
constexpr std::chrono::milliseconds kRound{2};

class Member {
 public:
  Member(zmq::context_t& context, std::string endpoint, std::optional<ClientKeys> keys, int slots,
         std::uint64_t number)
      : context_(&context),
        endpoint_(std::move(endpoint)),
        keys_(std::move(keys)),
        slots_(slots),
        protocol_(identity_of_this_process(slots, "benchmark"), {}, Rng(number)) {}

  void start(TimePoint now) {
    protocol_.start(now);
    carry_out(now);
  }

  /// False when the worker has left.
  bool step(TimePoint now) {
    if (left_) return false;
    while (!running_.empty() && running_.top().until <= now)
      finish(now);
    start_items(now);
    zmq::message_t message;
    while (socket_ && socket_.recv(message, zmq::recv_flags::dontwait)) {
      protocol_.on_frame(message.to_string_view(), now);
      carry_out(now);
    }
    if (!left_ && protocol_.next_deadline() <= now) protocol_.on_tick(now);
    carry_out(now);
    return !left_;
  }

 private:
  struct Running {
    TimePoint until;
    LeasedTask item;
    bool operator<(const Running& other) const { return other.until < until; }
  };

  void finish(TimePoint now) {
    const Running done = running_.top();
    running_.pop();
    protocol_.on_evaluated(
        {.key = done.item.key,
         .attempt = done.item.attempt,
         .measured = {.score = synthetic_score(done.item.machine, done.item.seed),
                      .state_digest = mix64(static_cast<std::uint64_t>(done.item.seed)),
                      .wall_us = us_}},
        now);
  }

  void start_items(TimePoint now) {
    while (!waiting_.empty() && running_.size() < static_cast<std::size_t>(slots_)) {
      Running next{.until = now + time_of(work_, waiting_.front().seed),
                   .item = std::move(waiting_.front())};
      waiting_.pop_front();
      protocol_.on_started(next.item.key, now);
      running_.push(std::move(next));
    }
  }

  void carry_out(TimePoint now) {
    for (auto actions = protocol_.take_actions(); !actions.empty();
         actions = protocol_.take_actions()) {
      for (WorkerAction& action : actions)
        carry_out(action, now);
    }
  }

  void carry_out(WorkerAction& action, TimePoint now) {
    std::visit(Overloaded{[&](OpenConnection) { open(); },
                          [&](const SendToCoordinator& send) {
                            (void)socket_.send(zmq::buffer(send.frame), zmq::send_flags::dontwait);
                          },
                          [&](const UseScenario& use) { take_work(use.scenario); },
                          [&](RunItems& run) {
                            for (LeasedTask& item : run.items)
                              waiting_.push_back(std::move(item));
                          },
                          [&](TakeBack) {
                            std::vector<PackedKey> keys;
                            for (const LeasedTask& item : waiting_)
                              keys.push_back(item.key);
                            waiting_.clear();
                            protocol_.on_taken_back(keys, now);
                          },
                          [&](DropItems) { waiting_.clear(); }, [](const Say&) {},
                          [&](const Leave& leave) {
                            left_ = true;
                            if (leave.code != WorkerExit::Done)
                              std::fprintf(stderr, "worker: %s\n", leave.reason.c_str());
                          }},
               action);
  }

  void open() {
    socket_ = zmq::socket_t(*context_, zmq::socket_type::dealer);
    socket_.set(zmq::sockopt::linger, 200);
    if (keys_) {
      socket_.set(zmq::sockopt::curve_serverkey, keys_->server_key);
      socket_.set(zmq::sockopt::curve_secretkey, keys_->secret_key);
      socket_.set(zmq::sockopt::curve_publickey, public_key_of(keys_->secret_key));
    }
    socket_.connect(endpoint_);
  }

  void take_work(const std::string& scenario) {
    const Expected<Work> work = work_of(scenario);
    if (!work) return protocol_.on_bad_scenario(to_string(work.error()));
    work_ = *work;
    us_ = work_.us;
  }

  zmq::context_t* context_;
  std::string endpoint_;
  std::optional<ClientKeys> keys_;
  int slots_;
  WorkerProtocol protocol_;
  zmq::socket_t socket_;
  Work work_;
  std::int64_t us_ = 0;
  std::deque<LeasedTask> waiting_;
  std::priority_queue<Running> running_;
  bool left_ = false;
};

}  // namespace

void run_crowd(const std::string& endpoint, const WorkerShape& shape,
               const std::optional<ClientKeys>& keys) {
  const SystemClock clock;
  zmq::context_t context(1);
  // A worker that connects again has two sockets for a moment.
  context.set(zmq::ctxopt::max_sockets, 2 * shape.workers + 16);
  std::deque<Member> members;
  for (int i = 0; i < shape.workers; ++i) {
    members.emplace_back(context, endpoint, keys, shape.slots, static_cast<std::uint64_t>(i));
    members.back().start(clock.now());
  }
  for (bool any = true; any;) {
    const TimePoint round = clock.now();
    any = false;
    for (Member& member : members)
      any = member.step(clock.now()) || any;
    std::this_thread::sleep_until(round + kRound);
  }
}

}  // namespace swarmsmith::bench
