#include "robot/zeromq/zmq_ends.h"

#include <algorithm>
#include <atomic>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>
#include <utility>

#include "proto/socket.h"
#include "robot/transport/inbox.h"
#include "robot/zeromq/frames.h"

namespace swarmsmith {

namespace {

constexpr std::string_view kDriver = "driver";
constexpr std::string_view kOperator = "operator";

/// How often a thread checks whether it must end, and whether its connection exists.
constexpr std::chrono::milliseconds kLook{50};
constexpr std::chrono::milliseconds kTryAgain{200};
/// Time for the last frames when an end is closed, above all the command to stand still.
constexpr std::chrono::milliseconds kLastFrames{200};

/// Outgoing frames; any thread may put them.
class Outbox {
 public:
  /// With `newest_only`, a waiting frame of the same topic is dropped.
  void put(std::string frame, bool newest_only) {
    if (frame.empty()) return;
    {
      const std::lock_guard lock(mutex_);
      if (newest_only) {
        const std::string topic = frame.substr(0, frame.find(' ') + 1);
        std::erase_if(frames_, [&](const std::string& old) { return old.starts_with(topic); });
      }
      frames_.push_back(std::move(frame));
    }
    wakeup_.notify();
  }
  std::vector<std::string> take() {
    const std::lock_guard lock(mutex_);
    return std::exchange(frames_, {});
  }
  bool empty() const {
    const std::lock_guard lock(mutex_);
    return frames_.empty();
  }
  Wakeup& wakeup() { return wakeup_; }

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> frames_;
  Wakeup wakeup_;
};

/// Waits until all frames have been passed to the sockets, whose threads then send them.
void wait_until_sent(const std::function<bool()>& sent, Duration most) {
  const TimePoint until = SystemClock().now() + most;
  while (!sent() && SystemClock().now() < until)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

std::vector<std::string> topics_of(const SensorTopics& sensors) {
  std::vector<std::string> topics;
  const auto add = [&](bool wanted, std::string_view topic) {
    if (wanted) topics.emplace_back(topic);
  };
  add(sensors.senses, SensesMessage::kTopic);
  if (sensors.senses) return topics;
  add(sensors.ranges, RangesMessage::kTopic);
  add(sensors.ground_color, GroundColorMessage::kTopic);
  add(sensors.scan, ScanMessage::kTopic);
  add(sensors.neighbours, NeighboursMessage::kTopic);
  add(sensors.light, LightMessage::kTopic);
  return topics;
}

class ServingEnd final : public RobotEnd {
 public:
  ServingEnd(std::unique_ptr<ServerSocket> socket, const std::string& name,
             NodeServerOptions options)
      : keep_(options.end.keep),
        new_clients_(std::move(options.new_clients)),
        hello_(topics_of(options.end.sensors)),
        inbox_(options.end.keep),
        socket_(std::move(socket)) {
    hello_.insert(hello_.begin(), name);
    thread_ = std::thread([this] { run(); });
  }
  ~ServingEnd() override {
    ends_ = true;
    outbox_.wakeup().notify();
    thread_.join();
  }

  std::optional<ToRobot> receive(TimePoint until) override { return inbox_.take(until); }
  void send(const FromRobot& message) override {
    const bool newest_counts = std::holds_alternative<WheelsMessage>(message) ||
                               std::holds_alternative<LedsMessage>(message);
    outbox_.put(frame_of(message), newest_counts && keep_ == Keep::Newest);
  }
  std::vector<Listener> listeners() override {
    const std::lock_guard lock(drivers_mutex_);
    return drivers_;
  }
  void flush(Duration most) override {
    wait_until_sent([this] { return outbox_.empty() && !sending_; }, most);
  }

 private:
  struct Peer {
    std::string name;
    bool drives = false;
    TimePoint heard{};
  };

  void run() {
    while (true) {
      const bool last = ends_;
      socket_->wait(outbox_.wakeup(), last ? std::chrono::milliseconds(0) : kLook);
      outbox_.wakeup().clear();
      // Before the frames are taken: clients that are removed now have no rights any more.
      admit_new_clients();
      ServerSocket::Received received;
      while (socket_->receive(received))
        hear(received);
      tell_refused();
      sending_ = true;
      for (const std::string& frame : outbox_.take())
        send_out(frame);
      sending_ = false;
      if (last) return;
    }
  }

  void admit_new_clients() {
    if (!new_clients_) return;
    auto clients = new_clients_();
    if (!clients) return;
    for (const PeerId cut : socket_->admit(std::move(*clients)))
      peers_.erase(cut);
    keep_drivers();
  }

  void hear(const ServerSocket::Received& received) {
    if (const auto known = peers_.find(received.peer); known != peers_.end()) {
      known->second.heard = SystemClock().now();
      if (known->second.drives) keep_drivers();
    }
    if (const auto hello = hello_of(received.frame)) return greet(received, *hello);
    auto message = message_to_robot(received.frame);
    if (!message && is_unused_frame(received.frame)) return;
    if (!message) {
      return complain(received.peer, "sent an unknown message: `" +
                                         std::string(received.frame.substr(0, 40)) +
                                         "`; expected one from a driver or the operator");
    }
    const bool is_order = std::holds_alternative<OrderMessage>(*message);
    if (is_order ? !may_command(received.role) : !may_work(received.role)) {
      return complain(received.peer,
                      is_order ? "gave an order, but its key is not an operator's"
                               : "sent a sensor's message, but its key is not a worker's");
    }
    message = arrived(*std::move(message));
    if (auto* driven = std::get_if<DrivenMessage>(&*message)) {
      const auto known = peers_.find(received.peer);
      if (known == peers_.end() || !known->second.drives) {
        return complain(
            received.peer,
            "reports what the treads do, but is not a driver: it sent no `hello driver`, or "
            "another hello later; its reports are ignored");
      }
      driven->sender = known->second.name;
    }
    inbox_.put(*std::move(message));
  }

  /// "client at 10.0.0.11 (connection 3)".
  std::string name_of(const ServerSocket::Received& received) {
    const std::string who = received.client.empty() ? "client" : std::string(received.client);
    return who + " at " + std::string(received.address) + " (connection " +
           std::to_string(++connections_) + ")";
  }

  void greet(const ServerSocket::Received& received, const std::vector<std::string>& words) {
    const bool drives = !words.empty() && words.front() == kDriver;
    if (drives && !may_work(received.role))
      return complain(received.peer, "wants to drive, but its key is not a worker's");
    Peer& peer = peers_[received.peer];
    std::optional<TroubleMessage> left;
    if (peer.drives && !drives) {
      left = TroubleMessage{peer.name + " no longer drives: it sent `hello " +
                                (words.empty() ? "" : words.front()) + "`",
                            false};
    }
    if (peer.name.empty()) peer.name = name_of(received);
    peer.drives = drives;
    peer.heard = SystemClock().now();
    if (socket_->send(received.peer, hello_frame(hello_)) != SendStatus::Sent)
      peers_.erase(received.peer);
    else if (!state_.empty())
      socket_->send(received.peer, state_);
    keep_drivers();
    // Put last, so that the receiver finds the change completed.
    if (left) inbox_.put(*std::move(left));
  }

  void send_out(const std::string& frame) {
    const bool is_state = frame.starts_with("state ");
    if (is_state) state_ = frame;
    std::erase_if(peers_, [&](const auto& known) {
      if (!is_state && !known.second.drives) return false;
      const SendStatus status = socket_->send(known.first, frame);
      return status == SendStatus::Gone || status == SendStatus::Full;
    });
    keep_drivers();
  }

  /// Copies the drivers for the other thread.
  void keep_drivers() {
    const std::lock_guard lock(drivers_mutex_);
    drivers_.clear();
    for (const auto& [id, peer] : peers_) {
      if (peer.drives) drivers_.push_back({peer.name, peer.heard});
    }
  }

  /// Reports clients that were refused, with the reason, such as a key that is not listed.
  void tell_refused() {
    constexpr std::size_t kMost = 100;
    const Refusals refusals = socket_->refusals();
    for (const auto& [reason, from] : refusals.last_from) {
      std::string text = "a client at " + from + " was refused: " + reason;
      if (refused_.size() < kMost && refused_.insert(text).second)
        inbox_.put(TroubleMessage{std::move(text), false});
    }
  }

  void complain(PeerId peer, const std::string& what) {
    if (complained_.insert(peer).second) inbox_.put(TroubleMessage{"a client " + what, false});
  }

  Keep keep_;
  std::function<std::optional<std::vector<ListedClient>>()> new_clients_;
  std::vector<std::string> hello_;
  Inbox<ToRobot> inbox_;
  Outbox outbox_;
  std::unique_ptr<ServerSocket> socket_;
  std::map<PeerId, Peer> peers_;
  std::set<PeerId> complained_;
  std::string state_;              ///< the last state, for clients that connect later
  int connections_ = 0;            ///< number of clients that sent hello
  std::set<std::string> refused_;  ///< reported refusals
  std::mutex drivers_mutex_;
  std::vector<Listener> drivers_;
  std::atomic<bool> sending_{false};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// A connection to the node of one robot, with its own thread.
class NodeLink {
 public:
  /// Called with messages of the node, and with troubles of the connection.
  using OnMessage = std::function<void(FromRobot)>;

  NodeLink(RobotPlace place, std::string_view greeting, std::optional<ClientKeys> keys,
           OnMessage on_message)
      : place_(std::move(place)),
        greeting_(greeting),
        on_message_(std::move(on_message)),
        socket_(place_.endpoint, {}, std::move(keys)) {
    thread_ = std::thread([this] { run(); });
  }
  NodeLink(const NodeLink&) = delete;
  NodeLink& operator=(const NodeLink&) = delete;
  ~NodeLink() {
    ends_ = true;
    outbox_.wakeup().notify();
    thread_.join();
  }

  const std::string& name() const { return place_.name; }
  void send(std::string frame, bool newest_only) {
    if (connected_) outbox_.put(std::move(frame), newest_only);
  }
  bool connected() const { return connected_; }
  bool sent() const { return outbox_.empty() && !sending_; }

 private:
  void run() {
    connect();
    while (true) {
      const bool last = ends_;
      socket_.wait(outbox_.wakeup(), last ? std::chrono::milliseconds(0) : kLook);
      outbox_.wakeup().clear();
      while (socket_.receive(frame_))
        hear();
      sending_ = true;
      for (const std::string& frame : outbox_.take())
        socket_.send(frame);
      sending_ = false;
      if (last) return socket_.close(kLastFrames);
      if (socket_.lost()) lose();
      if (!stands_ && SystemClock().now() >= again_) connect();
    }
  }

  void connect() {
    stands_ = true;
    socket_.connect();
    socket_.send(hello_frame({greeting_}));
  }

  void lose() {
    const bool was = std::exchange(stands_, false);
    const bool had = connected_.exchange(false);
    again_ = SystemClock().now() + kTryAgain;
    if (was && !socket_.trouble().empty()) {
      tell(place_.name + "'s node at " + place_.endpoint + ": " + socket_.trouble());
    } else if (was && socket_.refused()) {
      tell(place_.name + "'s node at " + place_.endpoint + " does not accept this key");
    } else if (had) {
      told_.clear();
      tell("the connection to " + place_.name + "'s node at " + place_.endpoint +
           " was lost; trying again");
    }
  }

  void tell(const std::string& text) {
    if (std::exchange(told_, text) != text) on_message_(TroubleMessage{text});
  }

  void hear() {
    if (const auto hello = hello_of(frame_)) {
      if (!hello->empty() && hello->front() != place_.name) {
        return tell("the node at " + place_.endpoint + " is " + hello->front() + "'s, not " +
                    place_.name + "'s");
      }
      connected_ = true;
      return;
    }
    auto message = message_from_robot(frame_);
    if (!message) {
      return tell(place_.name + " sent a message that nodes do not send: `" + frame_.substr(0, 40) +
                  "`");
    }
    message = arrived(*std::move(message));
    if (auto* wheels = std::get_if<WheelsMessage>(&*message)) wheels->sender = place_.endpoint;
    on_message_(*std::move(message));
  }

  RobotPlace place_;
  std::string greeting_;
  OnMessage on_message_;
  Outbox outbox_;
  ClientSocket socket_;
  std::string frame_;
  std::string told_;
  bool stands_ = false;
  TimePoint again_{};
  std::atomic<bool> connected_{false};
  std::atomic<bool> sending_{false};
  std::atomic<bool> ends_{false};
  std::thread thread_;
};

/// Connections to the nodes of all robots.
class NodeLinks {
 public:
  using OnMessage = std::function<void(std::size_t robot, FromRobot)>;

  NodeLinks(std::vector<RobotPlace> places, std::string_view greeting,
            const NodeClientOptions& options, const OnMessage& on_message) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      links_.push_back(std::make_unique<NodeLink>(
          std::move(places[i]), greeting, options.keys,
          [on_message, i](FromRobot message) { on_message(i, std::move(message)); }));
    }
  }

  std::size_t size() const { return links_.size(); }
  NodeLink& operator[](std::size_t robot) const { return *links_[robot]; }
  void flush(Duration most) const {
    wait_until_sent(
        [this] { return std::ranges::all_of(links_, [](const auto& one) { return one->sent(); }); },
        most);
  }

 private:
  std::vector<std::unique_ptr<NodeLink>> links_;
};

class ClientWorldEnd final : public WorldEnd {
 public:
  ClientWorldEnd(std::vector<RobotPlace> places, const NodeClientOptions& options)
      : keep_(options.end.keep),
        inbox_(keep_),
        links_(std::move(places), kDriver, options, [this](std::size_t robot, FromRobot message) {
          inbox_.put({robot, std::move(message)});
        }) {}

  std::size_t robots() const override { return links_.size(); }
  const std::string& name(std::size_t robot) const override { return links_[robot].name(); }
  std::optional<Received> receive(TimePoint until) override { return inbox_.take(until); }
  void send(std::size_t robot, const ToRobot& message) override {
    links_[robot].send(frame_of(message), keep_ == Keep::Newest);
  }
  bool connected(std::size_t robot) override { return links_[robot].connected(); }
  void flush(Duration most) override { links_.flush(most); }

 private:
  Keep keep_;
  Inbox<Received> inbox_;
  NodeLinks links_;  ///< destroyed first, because they put messages into the inbox
};

class ClientOperatorEnd final : public OperatorEnd {
 public:
  ClientOperatorEnd(std::vector<RobotPlace> places, const NodeClientOptions& options)
      : links_(std::move(places), kOperator, options,
               [this](std::size_t robot, FromRobot message) { hear(robot, std::move(message)); }) {}

  std::size_t robots() const override { return links_.size(); }
  const std::string& name(std::size_t robot) const override { return links_[robot].name(); }
  std::optional<Received> receive(TimePoint until) override { return inbox_.take(until); }
  void send(const OrderMessage& order) override {
    for (std::size_t i = 0; i < links_.size(); ++i)
      links_[i].send(frame_of(ToRobot(order)), false);
  }
  bool connected(std::size_t robot) override { return links_[robot].connected(); }
  void flush(Duration most) override { links_.flush(most); }

 private:
  void hear(std::size_t robot, FromRobot message) {
    if (auto* state = std::get_if<StateMessage>(&message)) {
      inbox_.put({robot, std::move(*state)});
    } else if (auto* trouble = std::get_if<TroubleMessage>(&message)) {
      inbox_.put({robot, std::move(*trouble)});
    }
  }

  Inbox<Received> inbox_{Keep::All};
  NodeLinks links_;
};

std::optional<Error> check_places(const std::vector<RobotPlace>& places, bool has_keys) {
  for (const RobotPlace& place : places) {
    const auto address = address_of(place.endpoint);
    if (!address || address->port == 0) {
      return Error{ErrorKind::BadInput,
                   "`" + place.endpoint + "` is not an address; write tcp://HOST:PORT", place.name};
    }
    if (!has_keys && !is_loopback(address->host)) {
      return Error{ErrorKind::BadInput,
                   place.endpoint +
                       " is on another host: such connections need a key, else "
                       "any host could drive the robots",
                   place.name};
    }
  }
  return std::nullopt;
}

}  // namespace

Expected<NodeServer> zmq_robot_end(const std::string& name, NodeServerOptions options) {
  const auto address = address_of(options.endpoint);
  if (!address) {
    return bad_input("`" + options.endpoint + "` is not an address; write tcp://HOST:PORT");
  }
  if (!options.keys && !is_loopback(address->host)) {
    return bad_input(
        "other hosts can reach this address: it needs keys, else any program could drive the robot "
        "(`swarmsmith keygen` makes them)",
        options.endpoint);
  }
  SocketOptions socket_options;
  socket_options.linger = kLastFrames;
  socket_options.probes_newcomers = false;  // drivers may be programs of other authors
  auto socket = ServerSocket::bind(options.endpoint, socket_options, std::move(options.keys));
  if (!socket) return tl::unexpected(socket.error());
  NodeServer server{.end = nullptr, .endpoint = (*socket)->endpoint()};
  server.end = std::make_unique<ServingEnd>(std::move(*socket), name, std::move(options));
  return server;
}

Expected<std::unique_ptr<WorldEnd>> zmq_world_end(std::vector<RobotPlace> robots,
                                                  const NodeClientOptions& options) {
  if (auto wrong = check_places(robots, options.keys.has_value())) return tl::unexpected(*wrong);
  return std::make_unique<ClientWorldEnd>(std::move(robots), options);
}

Expected<std::unique_ptr<OperatorEnd>> zmq_operator_end(std::vector<RobotPlace> robots,
                                                        const NodeClientOptions& options) {
  if (auto wrong = check_places(robots, options.keys.has_value())) return tl::unexpected(*wrong);
  return std::make_unique<ClientOperatorEnd>(std::move(robots), options);
}

}  // namespace swarmsmith
