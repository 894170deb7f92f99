#include "robot/app/transports.h"

#include <chrono>
#include <utility>

#include "proto/access/allow_list_file.h"
#include "proto/access/key_file.h"
#include "proto/access/key_folder.h"
#include "robot/ros/ros_ends.h"
#include "robot/zeromq/zmq_ends.h"

namespace swarmsmith::cli {
namespace {

bool is_ros(const TransportWords& words) {
  return words.transport == "ros";
}

RosOptions ros_options(const TransportWords& words, const EndOptions& end) {
  return {.end = end, .remappings = words.topics};
}

Expected<std::optional<ServerKeys>> server_keys(const std::string& folder_name) {
  if (folder_name.empty()) return std::optional<ServerKeys>();
  const KeyFolder folder{folder_name};
  const auto pair = read_server_key(folder.server_key());
  if (!pair) return Unexpected(pair.error());
  const auto now =
      std::chrono::time_point_cast<std::chrono::seconds>(std::chrono::system_clock::now());
  const auto list = AllowListFile::open(folder.clients(), now);
  if (!list) return Unexpected(list.error().front());
  return std::optional(ServerKeys{.secret_key = pair->secret_key, .clients = list->clients()});
}

Expected<NodeClientOptions> client_options(const TransportWords& words, const EndOptions& end) {
  NodeClientOptions options{.end = end};
  if (words.key.empty()) return options;
  const auto key = read_client_key(words.key);
  if (!key) return Unexpected(key.error());
  options.keys = key->keys();
  return options;
}

/// Where each of the robots listens, in their order.
Expected<std::vector<RobotPlace>> places_of(const TransportWords& words,
                                            const std::vector<std::string>& names) {
  std::vector<RobotPlace> places;
  for (const std::string& name : names) {
    std::string endpoint;
    for (const std::string& word : words.places) {
      if (word.starts_with(name + "=")) endpoint = word.substr(name.size() + 1);
    }
    if (endpoint.empty()) {
      return bad_input("where does the node of " + name + " listen? give --at " + name +
                           "=tcp://HOST:PORT, as the node said it",
                       "--at");
    }
    places.push_back({name, std::move(endpoint)});
  }
  return places;
}

void declare_transport(TransportWords& words, Options& options) {
  options.choice("--transport", words.transport, {"ros", "zmq"},
                 "How messages travel (default ros)");
  options.texts("--topic", words.topics,
                "ROS: NAME:=TOPIC, a topic that has another name here; also without --topic");
}

}  // namespace

void TransportWords::declare_for_node(Options& options) {
  declare_transport(*this, options);
  options.text("--listen", listen, "zmq: the node's address (default tcp://127.0.0.1:*)");
  options.text("--keys", keys,
               "zmq: folder of `swarmsmith keygen`; needed when other hosts reach the address");
}

void TransportWords::declare_for_others(Options& options) {
  declare_transport(*this, options);
  options.texts("--at", places, "zmq: ROBOT=tcp://HOST:PORT, where its node listens, repeatable");
  options.text("--key", key, "zmq: key file of `swarmsmith keygen`");
}

Expected<OpenedRobot> open_robot_end(const TransportWords& words, const std::string& name,
                                     const EndOptions& options) {
  if (is_ros(words)) {
    auto end = ros_robot_end(name, ros_options(words, options));
    if (!end) return Unexpected(end.error());
    return OpenedRobot{std::move(*end), ""};
  }
  auto keys = server_keys(words.keys);
  if (!keys) return Unexpected(keys.error());
  auto server =
      zmq_robot_end(name, {.end = options, .endpoint = words.listen, .keys = std::move(*keys)});
  if (!server) return Unexpected(server.error());
  return OpenedRobot{std::move(server->end), std::move(server->endpoint)};
}

Expected<std::unique_ptr<WorldEnd>> open_world_end(const TransportWords& words,
                                                   const std::vector<std::string>& names,
                                                   const EndOptions& options) {
  if (is_ros(words)) return ros_world_end(names, ros_options(words, options));
  auto places = places_of(words, names);
  if (!places) return Unexpected(places.error());
  const auto client = client_options(words, options);
  if (!client) return Unexpected(client.error());
  return zmq_world_end(std::move(*places), *client);
}

Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names) {
  if (is_ros(words)) return ros_operator_end(names, ros_options(words, {}));
  auto places = places_of(words, names);
  if (!places) return Unexpected(places.error());
  const auto client = client_options(words, {});
  if (!client) return Unexpected(client.error());
  return zmq_operator_end(std::move(*places), *client);
}

ExitCode exit_code_of_transport(const Error& error) {
  return error.kind == ErrorKind::BadInput || error.kind == ErrorKind::NotFound
             ? ExitCode::Usage
             : ExitCode::Unreachable;
}

}  // namespace swarmsmith::cli
