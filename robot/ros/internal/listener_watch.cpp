#include "robot/ros/internal/listener_watch.h"

#include <ros/ros.h>
#include <xmlrpcpp/XmlRpcClient.h>

#include <chrono>
#include <cstdlib>
#include <utility>

#include "robot/ros/internal/session.h"

namespace swarmsmith {

namespace {

constexpr std::chrono::milliseconds kAskEvery{200};
constexpr int kAsksToTheMaster = 5;  ///< once per this many rounds
/// A live node answers within a few milliseconds.
constexpr double kPatience_ms = 150;

std::string named(const std::string& node, int connection) {
  return connection < 2 ? node : node + " (connection " + std::to_string(connection) + ")";
}

/// The address of the node according to the master; empty when the master does not give it.
std::string place_of(const std::string& node) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) return {};
  return static_cast<std::string>(uri);
}

/// Whether the node at http://HOST:PORT/ answers.
bool lives(const std::string& place) {
  std::string host;
  std::string port;
  if (!split_uri(place, host, port)) return false;
  XmlRpc::XmlRpcClient client(host.c_str(), std::atoi(port.c_str()), "/");
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue result;
  request[0] = ros::this_node::getName();
  if (!client.executeNonBlock("getPid", request)) return false;
  client._disp.work(kPatience_ms);
  return client.executeCheckDone(result);
}

}  // namespace

ListenerWatch::ListenerWatch(OnTrouble on_trouble)
    : on_trouble_(std::move(on_trouble)), thread_([this] { run(); }) {}

ListenerWatch::~ListenerWatch() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ending_.notify_all();
  thread_.join();
}

void ListenerWatch::joined(const std::string& node) {
  const std::lock_guard lock(mutex_);
  Known& known = known_[node];
  ++known.connection;
  ++known.open;
  known.heard = SystemClock().now();
}

void ListenerWatch::left(const std::string& node) {
  const std::lock_guard lock(mutex_);
  --known_[node].open;
}

std::vector<Listener> ListenerWatch::listeners() const {
  const std::lock_guard lock(mutex_);
  std::vector<Listener> all;
  for (const auto& [node, known] : known_) {
    if (known.open > 0 && node != ros::this_node::getName())
      all.push_back({named(node, known.connection), known.heard, false});
  }
  return all;
}

std::string ListenerWatch::name_of(const std::string& node) const {
  const std::lock_guard lock(mutex_);
  const auto known = known_.find(node);
  return known == known_.end() ? node : named(node, known->second.connection);
}

bool ListenerWatch::listens(const std::string& node) const {
  const std::lock_guard lock(mutex_);
  const auto known = known_.find(node);
  return known != known_.end() && known->second.open > 0;
}

void ListenerWatch::look_for_rivals(const std::string& topic) {
  const std::lock_guard lock(mutex_);
  topic_ = topic;
}

void ListenerWatch::run() {
  std::unique_lock lock(mutex_);
  for (int round = 0; !ending_.wait_for(lock, kAskEvery, [this] { return ends_; }); ++round) {
    lock.unlock();
    ask_all();
    if (round % kAsksToTheMaster == 0) ask_master();
    lock.lock();
  }
}

void ListenerWatch::ask_all() {
  for (const Listener& listener : listeners()) {
    const std::string node = listener.name.substr(0, listener.name.find(' '));
    std::string& place = places_[listener.name];
    if (place.empty()) place = place_of(node);
    // A node that the master does not know cannot be asked: its connection is the only sign of
    // life.
    if (!place.empty() && !lives(place)) continue;
    const std::lock_guard lock(mutex_);
    known_[node].heard = SystemClock().now();
  }
}

void ListenerWatch::ask_master() {
  std::string topic;
  {
    const std::lock_guard lock(mutex_);
    topic = topic_;
  }
  SystemState state;
  if (topic.empty() || !ask_system_state(state)) return;
  std::map<std::string, bool> rivals;
  for (const std::string& node : state.publishers[topic]) {
    if (node == ros::this_node::getName()) continue;
    const std::string place = place_of(node);
    rivals[node] = rivals_[node];
    if (rivals[node] || place.empty() || !lives(place)) continue;  // already reported, or not alive
    rivals[node] = true;
    on_trouble_(node + " also publishes " + topic +
                ": when it sends, the treads stand still, and the run cannot be VALID");
  }
  rivals_ = std::move(rivals);
}

}  // namespace swarmsmith
