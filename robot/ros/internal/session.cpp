#include "robot/ros/internal/session.h"

#include <netdb.h>
#include <ros/console.h>
#include <ros/master.h>
#include <ros/names.h>
#include <ros/network.h>
#include <ros/this_node.h>
#include <ros/xmlrpc_manager.h>

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cstdlib>
#include <utility>

namespace swarmsmith {

namespace {

/// How long it may take to connect to a publisher that the master knows.
constexpr std::chrono::seconds kLookEvery{1};

/// ROS allows one node per process, and none after it has ended.
bool first_session() {
  static std::mutex mutex;
  static bool taken = false;
  const std::lock_guard lock(mutex);
  return !std::exchange(taken, true);
}

bool resolves(const std::string& host) {
  addrinfo* found = nullptr;
  const bool there = getaddrinfo(host.c_str(), nullptr, nullptr, &found) == 0;
  if (there) freeaddrinfo(found);
  return there;
}

constexpr const char* kAdvice =
    "set ROS_IP there to the host's own address (or ROS_HOSTNAME to a name that resolves "
    "everywhere), and restart it";

/// The reason why there are no messages from a node.
std::string why_unreachable(const std::string& node, const std::string& topic) {
  const std::string begin =
      "the master names " + node + " as publisher of " + topic + ", but there is no connection: ";
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue uri;
  request[0] = ros::this_node::getName();
  request[1] = node;
  if (!ros::master::execute("lookupNode", request, response, uri, false)) {
    return begin + "the master does not know its address";
  }
  std::string host;
  std::string port;
  const std::string place = static_cast<std::string>(uri);
  if (split_uri(place, host, port) && !resolves(host)) {
    return begin + "its host name `" + host + "` does not resolve here; " + kAdvice;
  }
  return begin + "it does not answer at " + place +
         "; was it killed, or does a firewall keep it away?";
}

void read_lists(XmlRpc::XmlRpcValue& lists, std::map<std::string, std::vector<std::string>>& into) {
  // The list's begin() is only for structs.  NOLINTNEXTLINE(modernize-loop-convert)
  for (int i = 0; i < lists.size(); ++i) {
    std::vector<std::string>& nodes = into[static_cast<std::string>(lists[i][0])];
    for (int k = 0; k < lists[i][1].size(); ++k)
      nodes.push_back(static_cast<std::string>(lists[i][1][k]));
  }
}

bool wait_for_master(Duration patience) {
  const auto until = std::chrono::steady_clock::now() + patience;
  while (!ros::master::check()) {
    if (std::chrono::steady_clock::now() >= until) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return true;
}

Expected<ros::M_string> remappings_of(const std::string& name_space, const RosOptions& options) {
  // roscpp puts a slash in front.
  ros::M_string remappings{{"__ns", name_space == "/" ? name_space : name_space.substr(1)}};
  for (const std::string& text : options.remappings) {
    const std::size_t middle = text.find(":=");
    std::string reason;
    if (middle == 0 || middle == std::string::npos || middle + 2 == text.size()) {
      return bad_input("write it as OURS:=THEIRS, such as ranges:=/teraranger/ranges", text);
    }
    const std::string from = text.substr(0, middle);
    const std::string to = text.substr(middle + 2);
    if (!ros::names::validate(from, reason) || !ros::names::validate(to, reason)) {
      return bad_input("ROS does not take this name: " + reason, text);
    }
    remappings[from] = to;
  }
  const char* set = std::getenv("ROS_MASTER_URI");
  const std::string master = set != nullptr && *set != '\0' ? set : "http://localhost:11311";
  std::string host;
  std::string port;
  if (!split_uri(master, host, port)) {
    return bad_input("`" + master + "` is not the address of a master; write http://HOST:11311",
                     "ROS_MASTER_URI");
  }
  remappings["__master"] = master;
  return remappings;
}

}  // namespace

bool split_uri(std::string uri, std::string& host, std::string& port) {
  constexpr const char* kScheme = "http://";
  if (uri.compare(0, 7, kScheme) != 0) return false;
  uri = uri.substr(7);
  if (!uri.empty() && uri.back() == '/') uri.pop_back();
  const std::size_t colon = uri.rfind(':');
  if (colon == std::string::npos || colon == 0) return false;
  host = uri.substr(0, colon);
  port = uri.substr(colon + 1);
  return !port.empty() && port.size() <= 5 &&
         std::all_of(port.begin(), port.end(),
                     [](unsigned char digit) { return std::isdigit(digit) != 0; });
}

bool is_ros_name(const std::string& name) {
  if (name.empty() || std::isalpha(static_cast<unsigned char>(name.front())) == 0) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char letter) {
    return std::isalnum(letter) != 0 || letter == '_';
  });
}

bool ask_system_state(SystemState& state) {
  XmlRpc::XmlRpcValue request;
  XmlRpc::XmlRpcValue response;
  XmlRpc::XmlRpcValue lists;
  request[0] = ros::this_node::getName();
  if (!ros::master::execute("getSystemState", request, response, lists, false)) return false;
  read_lists(lists[0], state.publishers);
  read_lists(lists[1], state.subscribers);
  return true;
}

Expected<std::unique_ptr<Session>> Session::join(const std::string& name_space,
                                                 const std::string& node, bool unique_name,
                                                 const RosOptions& options, OnTrouble on_trouble) {
  const auto remappings = remappings_of(name_space, options);
  if (!remappings) return tl::unexpected(remappings.error());
  if (!first_session()) {
    return unexpected(ErrorKind::Conflict,
                      "this process already has a ROS node, and can have only one");
  }
  std::uint32_t how = ros::init_options::NoSigintHandler | ros::init_options::NoRosout;
  if (unique_name) how |= ros::init_options::AnonymousName;
  ros::init(*remappings, node, how);
  // This program reports important events itself; the messages of roscpp are written for its
  // developers.
  if (ros::console::set_logger_level("ros", ros::console::levels::Fatal))
    ros::console::notifyLoggerLevelsChanged();
  if (!wait_for_master(options.master_patience)) {
    return unexpected(ErrorKind::Unavailable,
                      "no ROS master answers; start one there (rosmaster --core, or roscore), or "
                      "set ROS_MASTER_URI to where it is",
                      ros::master::getURI());
  }
  // Otherwise a node would wait forever for a master that dies while the node joins.
  ros::master::setRetryTimeout(ros::WallDuration(5));
  std::unique_ptr<Session> session(new Session(std::move(on_trouble)));
  ros::start();
  // Otherwise a second node with the same name ends this one before it can send zero speeds.
  const auto manager = ros::XMLRPCManager::instance();
  manager->unbind("shutdown");
  manager->bind("shutdown", [tell = session->on_trouble_](XmlRpc::XmlRpcValue& parameters,
                                                          XmlRpc::XmlRpcValue& result) {
    std::string reason;
    if (parameters.size() > 1) reason = static_cast<std::string>(parameters[1]);
    const bool same_name = reason.find("new node registered with same name") != std::string::npos;
    tell(same_name ? "another node took the name " + ros::this_node::getName() + "; this one ends"
                   : "the master ends this node: " + reason,
         true);
    result = ros::xmlrpc::responseInt(1, "", 0);
  });
  const std::string& own = ros::network::getHost();
  if (!resolves(own)) {
    session->on_trouble_("other nodes get for this one the address `" + own +
                             "`, which does not resolve on this host; set ROS_IP to its own "
                             "address, and start it again",
                         false);
  }
  return session;
}

Session::~Session() {
  {
    const std::lock_guard lock(mutex_);
    ends_ = true;
  }
  ending_.notify_all();
  if (watch_.joinable()) watch_.join();
  if (spinner_) spinner_->stop();
  subscribers_.clear();
  ros::shutdown();
}

ros::NodeHandle Session::handle(const std::string& name_space) {
  ros::NodeHandle handle(name_space);
  handle.setCallbackQueue(&queue_);
  return handle;
}

void Session::spin(std::vector<ros::Subscriber> subscribers) {
  subscribers_ = std::move(subscribers);
  spinner_ = std::make_unique<ros::AsyncSpinner>(1, &queue_);
  spinner_->start();
  watch_ = std::thread([this] { run_watch(); });
}

void Session::run_watch() {
  std::unique_lock lock(mutex_);
  while (!ending_.wait_for(lock, kLookEvery, [this] { return ends_; })) {
    lock.unlock();
    look_for_unreachable();
    lock.lock();
  }
}

void Session::look_for_unreachable() {
  const bool all_connected =
      std::all_of(subscribers_.begin(), subscribers_.end(),
                  [](const ros::Subscriber& one) { return one.getNumPublishers() > 0; });
  SystemState state;
  if (all_connected || !ask_system_state(state)) {
    suspects_.clear();
    return;
  }
  std::set<std::string> unreached;
  std::string first;  // killed nodes stay registered at the master for days: one line for all
  std::string others;
  for (const ros::Subscriber& subscriber : subscribers_) {
    if (subscriber.getNumPublishers() > 0) continue;
    for (const std::string& node : state.publishers[subscriber.getTopic()]) {
      if (node == ros::this_node::getName()) continue;
      unreached.insert(node);
      // A peer that was already registered at the previous look has had enough time.
      if (suspects_.count(node) == 0 || !told_.insert(node).second) continue;
      if (first.empty()) {
        first = why_unreachable(node, subscriber.getTopic());
      } else {
        others += (others.empty() ? "" : ", ") + node;
      }
    }
  }
  if (!first.empty())
    on_trouble_(first + (others.empty() ? "" : "; the same for " + others), false);
  suspects_ = std::move(unreached);
}

}  // namespace swarmsmith
