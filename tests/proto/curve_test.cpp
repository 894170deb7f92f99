#include "proto/curve.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#include <functional>
#include <vector>

#include "proto/socket.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

TEST(Keys, HaveForty85DigitsAndMatch) {
  const KeyPair pair = make_key_pair();
  EXPECT_TRUE(is_key(pair.public_key));
  EXPECT_TRUE(is_key(pair.secret_key));
  EXPECT_EQ(public_key_of(pair.secret_key), pair.public_key);
  EXPECT_NE(make_key_pair().secret_key, pair.secret_key);
}

TEST(Keys, AreToldFromOtherTexts) {
  // Of the digits, each is in one of these; "/" and "`", beside letters, are not or not only.
  EXPECT_TRUE(is_key("0123456789abcdefghijABCDEFGHIJ.-:+=^!/*?"));
  EXPECT_TRUE(is_key("00000zzzzzZZZZZ99999aaaaaAAAAA0%$#@0&<>("));
  EXPECT_TRUE(is_key(std::string(40, '.')));
  for (const char beside : {'`', '|', '~', ' ', ';', ',', '_', '\\'})
    EXPECT_FALSE(is_key(std::string(39, '1') + beside)) << beside;
  EXPECT_FALSE(is_key(""));
  EXPECT_FALSE(is_key(std::string(39, '1')));
  EXPECT_FALSE(is_key(std::string(41, '1')));
  EXPECT_FALSE(is_key(std::string(40, '"')));
  EXPECT_FALSE(is_key(std::string(40, '\0')));
  // Five characters, but more than 32 bits.
  EXPECT_FALSE(is_key(std::string(40, '#')));
}

class LockedDoor : public ::testing::Test {
 protected:
  void SetUp() override {
    options.handshake_timeout = milliseconds(300);
    auto bound = value_of(ServerSocket::bind(
        "tcp://127.0.0.1:*", options,
        ServerKeys{.secret_key = server_pair.secret_key,
                   .clients = {client(worker, Role::Worker), client(reader, Role::Reader),
                               client(old, Role::Worker, true)}}));
    server = std::move(bound);
    honest = connect(worker);
    honest->send("hello");
    ASSERT_EQ(next_at_server(), "hello");
  }

  /// Whatever else happened, a listed client talks on.
  void TearDown() override {
    honest->send("still here");
    EXPECT_EQ(next_at_server(), "still here");
    EXPECT_EQ(last.role, Role::Worker);
    EXPECT_FALSE(honest->lost());
  }

  static ListedClient client(const KeyPair& pair, Role role, bool expired = false) {
    return {.name = role == Role::Worker ? "node" : "desk",
            .role = role,
            .public_key = pair.public_key,
            .expired = expired};
  }

  std::unique_ptr<ClientSocket> connect(const KeyPair& pair) {
    return connect(ClientKeys{.secret_key = pair.secret_key, .server_key = server_pair.public_key});
  }
  std::unique_ptr<ClientSocket> connect(std::optional<ClientKeys> keys) {
    auto socket = std::make_unique<ClientSocket>(server->endpoint(), options, std::move(keys));
    socket->connect();
    return socket;
  }

  bool eventually(const std::function<bool()>& holds) {
    return swarmsmith::eventually(holds, [&] { server->wait(wakeup, milliseconds(2)); });
  }

  std::string next_at_server() {
    if (!eventually([&] { return server->receive(last); })) return "nothing came";
    return std::string(last.frame);
  }

  std::uint64_t refused(const std::string& reason) {
    const Refusals refusals = server->refusals();
    const auto at = refusals.counts.find(reason);
    return at != refusals.counts.end() ? at->second : 0;
  }

  /// The stranger is kept out for `reason`, and what it said never arrives.
  void expect_kept_out(ClientSocket& stranger, const std::string& reason) {
    stranger.send("let me in");
    EXPECT_TRUE(eventually([&] { return refused(reason) > 0; })) << reason;
    EXPECT_TRUE(eventually([&] { return stranger.lost(); }));
    EXPECT_FALSE(server->receive(last)) << last.frame;
    EXPECT_EQ(server->refusals().total(), refused(reason));
  }

  SocketOptions options;
  const KeyPair server_pair = make_key_pair();
  const KeyPair worker = make_key_pair();
  const KeyPair reader = make_key_pair();
  const KeyPair old = make_key_pair();
  Wakeup wakeup;
  std::unique_ptr<ServerSocket> server;
  std::unique_ptr<ClientSocket> honest;
  ServerSocket::Received last;
};

TEST_F(LockedDoor, LetsListedKeysInAndSaysWhoTheyAre) {
  EXPECT_EQ(last.role, Role::Worker);
  EXPECT_EQ(last.client, "node");
  const auto desk = connect(reader);
  desk->send("how is it?");
  EXPECT_EQ(next_at_server(), "how is it?");
  EXPECT_EQ(last.role, Role::Reader);
  EXPECT_EQ(last.client, "desk");
  EXPECT_EQ(server->send(last.peer, "fine"), SendStatus::Sent);
  std::string frame;
  EXPECT_TRUE(eventually([&] { return desk->receive(frame); }));
  EXPECT_EQ(frame, "fine");
  EXPECT_THAT(server->refusals().counts, IsEmpty());
  EXPECT_THAT(server->refusals().last_from, IsEmpty());
}

TEST_F(LockedDoor, KeepsAnUnlistedKeyOut) {
  const auto stranger = connect(make_key_pair());
  expect_kept_out(*stranger, "unlisted key");
  EXPECT_TRUE(stranger->refused());
  EXPECT_EQ(server->refusals().last_from.at("unlisted key"), "127.0.0.1");
  // Until it connects again, when nothing is known yet.
  stranger->redirect("somewhere", {});
  stranger->connect();
  EXPECT_FALSE(stranger->refused());
}

TEST_F(LockedDoor, KeepsAnExpiredKeyOut) {
  const auto stranger = connect(old);
  expect_kept_out(*stranger, "expired key");
  EXPECT_TRUE(stranger->refused());
}

TEST_F(LockedDoor, KeepsPlaintextOut) {
  const auto stranger = connect(std::nullopt);
  stranger->send("let me in");
  // Either end may see first that they do not match; a stranger that hangs up leaves no reason.
  EXPECT_TRUE(eventually([&] { return refused("plaintext") + refused("no handshake") == 1; }));
  EXPECT_TRUE(eventually([&] { return stranger->lost(); }));
  EXPECT_FALSE(server->receive(last)) << last.frame;
}

TEST_F(LockedDoor, KeepsOutWhoTakesItForAnother) {
  const auto stranger = connect(
      ClientKeys{.secret_key = worker.secret_key, .server_key = make_key_pair().public_key});
  expect_kept_out(*stranger, "wrong server key");
  EXPECT_FALSE(stranger->stood());
}

TEST_F(LockedDoor, ClosesAnIdleOrRubbishConnectionSoon) {
  const std::string address = server->endpoint();
  for (const std::string& words : {std::string(), std::string("GET / HTTP/1.1\r\n\r\n")}) {
    const std::uint64_t before = server->refusals().total();
    const int descriptor = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in where = {};
    where.sin_family = AF_INET;
    where.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(address.substr(address.rfind(':') + 1))));
    where.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(descriptor, reinterpret_cast<const sockaddr*>(&where), sizeof where), 0);
    ASSERT_EQ(::send(descriptor, words.data(), words.size(), 0),
              static_cast<ssize_t>(words.size()));
    char byte = 0;
    // What libzmq says first, and then the end of the connection.
    while (recv(descriptor, &byte, 1, 0) > 0) {
    }
    close(descriptor);
    EXPECT_TRUE(eventually([&] { return server->refusals().total() > before; })) << words;
  }
}

TEST_F(LockedDoor, CutsOffWhoIsNotListedAnyMore) {
  const auto desk = connect(reader);
  desk->send("one");
  ASSERT_EQ(next_at_server(), "one");
  const PeerId peer = last.peer;
  desk->send("two");
  server->wait(wakeup, std::chrono::minutes(1));  // until it has arrived
  const std::vector<PeerId> gone = server->admit({client(worker, Role::Worker)});
  EXPECT_EQ(gone, std::vector<PeerId>{peer});
  EXPECT_EQ(server->send(peer, "to no peer"), SendStatus::Gone);
  EXPECT_TRUE(eventually([&] { return desk->lost(); }));
  EXPECT_FALSE(server->receive(last));
  EXPECT_EQ(refused("revoked key"), 1U);
  // Nor does it come in again, until it is listed again.
  desk->connect();
  EXPECT_TRUE(eventually([&] { return desk->lost(); }));
  EXPECT_EQ(refused("unlisted key"), 1U);
  EXPECT_TRUE(server->admit({client(worker, Role::Worker), client(reader, Role::Reader)}).empty());
  desk->connect();
  desk->send("three");
  EXPECT_EQ(next_at_server(), "three");
}

TEST_F(LockedDoor, CutsOffWhoseTimeIsOver) {
  const auto desk = connect(reader);
  desk->send("one");
  ASSERT_EQ(next_at_server(), "one");
  EXPECT_EQ(server->admit({client(worker, Role::Worker), client(reader, Role::Reader, true)}),
            std::vector<PeerId>{last.peer});
  EXPECT_TRUE(eventually([&] { return desk->lost(); }));
  EXPECT_EQ(refused("revoked key"), 1U);
  // It is cut once.
  EXPECT_TRUE(server->admit({client(worker, Role::Worker)}).empty());
  EXPECT_EQ(server->refusals().total(), 1U);
}

TEST_F(LockedDoor, KeepsARevokedKeyFromItsFirstWord) {
  const auto desk = connect(reader);
  // Its connection may stand already; it has not spoken.
  EXPECT_TRUE(server->admit({client(worker, Role::Worker)}).empty());
  desk->send("one");
  EXPECT_TRUE(eventually([&] { return desk->lost(); }));
  EXPECT_FALSE(server->receive(last));
  EXPECT_EQ(server->refusals().total(), 1U);
}

TEST_F(LockedDoor, SeesAnotherRoleAtTheNextWord) {
  const auto desk = connect(reader);
  desk->send("one");
  ASSERT_EQ(next_at_server(), "one");
  EXPECT_TRUE(
      server->admit({client(worker, Role::Worker), client(reader, Role::Operator)}).empty());
  desk->send("two");
  ASSERT_EQ(next_at_server(), "two");
  EXPECT_EQ(last.role, Role::Operator);
}

TEST(OpenDoor, ClosesConnectionsBeyondItsLimit) {
  SocketOptions options;
  options.max_connections = 2;
  auto server = value_of(ServerSocket::bind("tcp://127.0.0.1:*", options));
  std::vector<std::unique_ptr<ClientSocket>> clients;
  for (int i = 0; i < 3; ++i) {
    clients.push_back(std::make_unique<ClientSocket>(server->endpoint()));
    clients.back()->connect();
  }
  Wakeup wakeup;
  int lost = 0;
  for (int i = 0; i < 5000 && lost == 0; ++i) {
    server->wait(wakeup, milliseconds(2));
    for (const auto& client : clients)
      lost += client->lost() ? 1 : 0;
  }
  EXPECT_EQ(lost, 1);
  EXPECT_EQ(server->refusals().counts.at("too many connections"), 1U);
}

}  // namespace
}  // namespace swarmsmith
