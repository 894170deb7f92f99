#include "cli/run/coordinator_link.h"

#include <pwd.h>
#include <unistd.h>
#include <utility>

#include "base/clock.h"
#include "coordinator/service/messages.h"
#include "proto/access/address.h"
#include "proto/socket.h"
#include "proto/wakeup.h"
#include "proto/wire.h"
#include "proto/wire.pb.h"

namespace swarmsmith::cli {
namespace {

constexpr std::chrono::milliseconds kLookAgain{200};

std::string frame_of(const std::string& campaign, const CommandRow& command) {
  pb::ToCoordinator message;
  message.set_sequence(1);
  pb::Command& wish = *message.mutable_command();
  wish.set_kind(message_kind_of(command.kind));
  wish.set_campaign(campaign);
  wish.set_design(command.design.value);
  wish.set_budget(command.budget);
  wish.set_who(command.who);
  wish.set_whom(command.whom);
  return encode(message);
}

using Answer = Expected<std::string>;

/// The coordinator's answer in the frame, if there is one.
std::optional<Answer> answer_in(const std::string& frame) {
  google::protobuf::Arena arena;
  const auto message = decode_to_worker(frame, arena);
  if (!message) return Answer(Unexpected(message.error()));
  if ((*message)->has_command_reply()) {
    const pb::CommandReply& reply = (*message)->command_reply();
    return reply.done() ? Answer(reply.sentence()) : Answer(bad_input(reply.sentence()));
  }
  // A coordinator of another major version answers with a reject message.
  if ((*message)->has_reject()) return Answer(bad_input((*message)->reject().sentence()));
  return std::nullopt;
}

/// Sends a frame only once, to the first address of the server that answers: a command that arrives
/// twice could take effect twice.
class Tries {
 public:
  Tries(ClientSocket& socket, std::string frame) : socket_(&socket), frame_(std::move(frame)) {
    begin();
  }

  /// Goes on to the next address, if no address has answered yet and there is another one.
  bool another() {
    if (socket_->stood() || ++tried_ >= socket_->choices()) return false;
    begin();
    return true;
  }
  std::string why(const std::string& otherwise) const {
    return socket_->trouble().empty() ? otherwise : socket_->trouble();
  }

 private:
  void begin() {
    socket_->connect();
    socket_->send(frame_);
  }

  ClientSocket* socket_;
  std::string frame_;
  std::size_t tried_ = 0;
};

}  // namespace

CoordinatorSearch CoordinatorArgument::search(const std::string& file) const {
  CoordinatorSearch search{.endpoint = {},
                           .file = coordinator.empty() ? file : coordinator,
                           .key = key,
                           .role = "operator",
                           .insecure_plaintext = insecure_plaintext};
  if (connect.empty()) return search;
  // An invalid address is refused when the client connects to it.
  search.endpoint = endpoint_of(connect, true).value_or(connect);
  search.file.clear();
  return search;
}

Expected<std::string> command_by_wire(const CoordinatorSearch& search, const std::string& campaign,
                                      const CommandRow& command, std::chrono::seconds patience) {
  if (!search.endpoint.empty()) {
    if (const auto good = endpoint_of(search.endpoint, true); !good)
      return Unexpected(good.error());
  }
  auto found = find_coordinator(search);
  if (!found) return Unexpected(found.error());
  const SystemClock clock;
  const TimePoint until = clock.now() + patience;
  const Wakeup wakeup;
  ClientSocket socket(found->endpoint, {}, found->keys);
  socket.redirect(found->endpoint, found->keys, found->others);
  Tries tries(socket, frame_of(campaign, command));
  std::string received;
  while (clock.now() < until) {
    while (socket.receive(received)) {
      if (const auto answer = answer_in(received)) return *answer;
    }
    if (socket.refused()) {
      return bad_input(
          "it does not accept this key: its clients.toml must list the key with the role operator "
          "(`swarmsmith keygen --client NAME --role operator`)",
          found->endpoint);
    }
    if (socket.lost() && !tries.another()) {
      return unexpected(ErrorKind::Unavailable, tries.why("no coordinator answers there"),
                        found->endpoint);
    }
    socket.wait(wakeup, kLookAgain);
  }
  return unexpected(ErrorKind::Unavailable,
                    "the coordinator has not confirmed the command within " +
                        std::to_string(patience.count()) +
                        " s; it may still carry it out: `swarmsmith status STORE` shows it",
                    found->endpoint);
}

Expected<std::string> ask_status(const FoundCoordinator& coordinator,
                                 std::chrono::milliseconds patience) {
  using Clock = std::chrono::steady_clock;
  using std::chrono::milliseconds;
  const auto unreachable = [&](const std::string& how) {
    return unexpected(ErrorKind::Unavailable, how, coordinator.endpoint);
  };
  ClientSocket socket(coordinator.endpoint, {}, coordinator.keys);
  socket.redirect(coordinator.endpoint, coordinator.keys, coordinator.others);
  pb::ToCoordinator question;
  question.mutable_want_status();
  Tries tries(socket, encode(question));
  google::protobuf::Arena arena;
  const Wakeup no_wakeup;
  std::string frame;
  const auto until = Clock::now() + patience;
  while (true) {
    while (socket.receive(frame)) {
      const auto answer = decode_to_worker(frame, arena);
      if (!answer) return Unexpected(answer.error());
      if ((*answer)->has_status_reply()) return std::string((*answer)->status_reply().json());
      if ((*answer)->has_reject())
        return bad_input((*answer)->reject().sentence(), coordinator.endpoint);
    }
    if (socket.refused()) return unreachable("the coordinator does not know this key");
    if (socket.lost() && !tries.another())
      return unreachable(tries.why("no coordinator runs there"));
    const auto left = std::chrono::ceil<milliseconds>(until - Clock::now());
    if (left.count() <= 0) return unreachable("the coordinator does not answer");
    socket.wait(no_wakeup, left);
  }
}

std::string user_and_host() {
  const passwd* user = getpwuid(geteuid());
  const std::string name = user != nullptr ? user->pw_name : std::to_string(geteuid());
  return name + "@" + name_of_this_host();
}

}  // namespace swarmsmith::cli
