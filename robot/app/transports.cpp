#include "robot/app/transports.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include "base/log.h"
#include "proto/access/allow_list_file.h"
#include "proto/access/allow_list_watch.h"
#include "proto/access/key_file.h"
#include "proto/access/key_folder.h"
#include "robot/ros/ros_ends.h"
#include "robot/zeromq/zmq_ends.h"

namespace swarmsmith {
namespace {

RosOptions ros_options(const TransportWords& words, const EndOptions& end) {
  return {.end = end, .remappings = words.topics};
}

void log_faults(const std::vector<Error>& faults) {
  for (const Error& fault : faults) {
    log_event(LogLevel::Error, "robot", "new list of clients refused; the last one stays in use",
              {{"reason", to_string(fault)}});
  }
}

Expected<void> read_keys(const std::string& folder, NodeServerOptions& options) {
  if (folder.empty()) return {};
  const KeyFolder keys{folder};
  const auto pair = read_server_key(keys.server_key());
  if (!pair) return Unexpected(pair.error());
  auto list = AllowListFile::open(keys.clients(), AllowListWatch::system_time());
  if (!list) return Unexpected(list.error().front());
  options.keys = ServerKeys{.secret_key = pair->secret_key, .clients = list->clients()};
  auto watch = std::make_shared<AllowListWatch>(std::move(*list), log_faults);
  options.new_clients = [watch] { return watch->take(); };
  return {};
}

/// The addresses of the robots in the order of their names.
Expected<std::vector<RobotPlace>> places_of(const TransportWords& words,
                                            const std::vector<std::string>& names) {
  std::map<std::string, std::string> endpoints;
  for (const std::string& word : words.at) {
    const std::size_t equals = word.find('=');
    if (equals == 0 || equals == std::string::npos)
      return bad_input("write NAME=tcp://HOST:PORT, such as rvr1=tcp://10.0.0.11:5570",
                       "--at " + word);
    if (!endpoints.emplace(word.substr(0, equals), word.substr(equals + 1)).second)
      return bad_input("is given twice", "--at " + word);
  }
  std::vector<RobotPlace> places;
  for (const std::string& name : names) {
    const auto found = endpoints.find(name);
    if (found == endpoints.end()) {
      return bad_input("the address of " + name + "'s node is missing: add --at " + name +
                           "=tcp://HOST:PORT, as the node prints it",
                       "--at");
    }
    places.push_back({name, found->second});
    endpoints.erase(found);
  }
  if (!endpoints.empty()) return bad_input("there is no robot " + endpoints.begin()->first, "--at");
  return places;
}

Expected<NodeClientOptions> client_options(const TransportWords& words, const EndOptions& end) {
  NodeClientOptions options{.end = end};
  if (words.key.empty()) return options;
  const auto key = read_client_key(words.key);
  if (!key) return Unexpected(key.error());
  options.keys = key->keys();
  return options;
}

Expected<void> check_words(const TransportWords& words) {
  const bool ros = words.transport == "ros";
  if (!ros && !words.topics.empty())
    return bad_input("only topics of ROS can be renamed", "--topic");
  const auto only = [&](bool given, const char* option) -> Expected<void> {
    if (ros && given) return bad_input("works only with --transport zeromq", option);
    return {};
  };
  for (const auto& checked :
       {only(!words.bind.empty(), "--bind"), only(!words.keys.empty(), "--keys"),
        only(!words.at.empty(), "--at"), only(!words.key.empty(), "--key")}) {
    if (!checked) return checked;
  }
  return {};
}

}  // namespace

void TransportWords::declare(Options& options) {
  transport = "ros";
  options.choice("--transport", transport, {"ros", "zeromq"},
                 "Send messages over topics of ROS 1, or over ZeroMQ with keys (default ros)");
  options.texts("--topic", topics, "Rename a topic: OURS:=THEIRS; repeatable");
}

void TransportWords::declare_node(Options& options) {
  declare(options);
  options.text("--bind HOST:PORT", bind,
               "ZeroMQ: address where drivers, worlds and operators connect (default "
               "tcp://127.0.0.1:5570)");
  options.text("--keys DIR", keys,
               "ZeroMQ: folder with server.key and clients.toml, made by `swarmsmith keygen`; "
               "needed if other hosts connect");
}

void TransportWords::declare_client(Options& options) {
  declare(options);
  options.texts("--at", at, "ZeroMQ: NAME=tcp://HOST:PORT of a robot's node, repeatable");
  options.text("--key FILE", key,
               "ZeroMQ: key file, a worker's for worlds, an operator's for orders");
}

void declare_wheels(Options& options, WheelsForm& wheels) {
  options.choice("--wheels", wheels,
                 {{"doubles", WheelsForm::Doubles},
                  {"floats", WheelsForm::Floats},
                  {"twist", WheelsForm::Twist}},
                 "Type of the messages with speeds (default doubles)");
}

Expected<std::unique_ptr<RobotEnd>> open_robot_end(const TransportWords& words,
                                                   const std::string& name, const EndOptions& end,
                                                   Output& output) {
  if (const auto good = check_words(words); !good) return Unexpected(good.error());
  if (words.transport == "ros") return ros_robot_end(name, ros_options(words, end));
  NodeServerOptions options{.end = end};
  if (const auto read = read_keys(words.keys, options); !read) return Unexpected(read.error());
  options.endpoint = words.bind.empty() ? "tcp://127.0.0.1:5570" : words.bind;
  auto server = zmq_robot_end(name, std::move(options));
  if (!server) return Unexpected(server.error());
  print_note(output, name + " listens at " + server->endpoint);
  return std::move(server->end);
}

Expected<std::unique_ptr<WorldEnd>> open_world_end(const TransportWords& words,
                                                   const std::vector<std::string>& names,
                                                   const EndOptions& end) {
  if (const auto good = check_words(words); !good) return Unexpected(good.error());
  if (words.transport == "ros") return ros_world_end(names, ros_options(words, end));
  auto places = places_of(words, names);
  if (!places) return Unexpected(places.error());
  const auto options = client_options(words, end);
  if (!options) return Unexpected(options.error());
  return zmq_world_end(std::move(*places), *options);
}

Expected<std::unique_ptr<OperatorEnd>> open_operator_end(const TransportWords& words,
                                                         const std::vector<std::string>& names) {
  if (const auto good = check_words(words); !good) return Unexpected(good.error());
  if (words.transport == "ros") return ros_operator_end(names, ros_options(words, {}));
  auto places = places_of(words, names);
  if (!places) return Unexpected(places.error());
  const auto options = client_options(words, {});
  if (!options) return Unexpected(options.error());
  return zmq_operator_end(std::move(*places), *options);
}

ExitCode exit_code_of_transport(const Error& error) {
  return error.kind == ErrorKind::BadInput || error.kind == ErrorKind::NotFound
             ? ExitCode::Usage
             : ExitCode::Unreachable;
}

}  // namespace swarmsmith
