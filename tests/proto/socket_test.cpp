#include "proto/socket.h"

#include <netinet/in.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <functional>
#include <string>
#include <thread>

#include "base/peer_user.h"
#include "proto/wire.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

class Sockets : public ::testing::Test {
 protected:
  void SetUp() override {
    auto bound = value_of(ServerSocket::bind("tcp://127.0.0.1:*"));
    server = std::move(bound);
    client = std::make_unique<ClientSocket>(server->endpoint());
    client->connect();
  }

  /// What the server gets next.
  std::string next_at_server() {
    ServerSocket::Received received;
    if (!eventually([&] { return server->receive(received); })) return "nothing came";
    peer = received.peer;
    return std::string(received.frame);
  }

  Wakeup wakeup;
  std::unique_ptr<ServerSocket> server;
  std::unique_ptr<ClientSocket> client;
  PeerId peer = 0;
};

TEST_F(Sockets, CarryFramesBothWays) {
  EXPECT_EQ(client->send("there"), SendStatus::Sent);
  EXPECT_EQ(next_at_server(), "there");
  EXPECT_EQ(server->send(peer, "back"), SendStatus::Sent);
  std::string frame;
  EXPECT_TRUE(eventually([&] { return client->receive(frame); }));
  EXPECT_EQ(frame, "back");
}

TEST_F(Sockets, SayThatAPeerHasGone) {
  client->send("there");
  EXPECT_EQ(next_at_server(), "there");
  client->close(milliseconds(0));
  EXPECT_TRUE(eventually([&] { return server->send(peer, "back") == SendStatus::Gone; }));
  EXPECT_EQ(server->send(peer + 1000, "to no peer"), SendStatus::Gone);
}

/// So "gone" does not mean that all it said has been read.
TEST_F(Sockets, KeepTheLastWordsOfAPeerThatHasGone) {
  client->send("there");
  EXPECT_EQ(next_at_server(), "there");
  const PeerId first = peer;
  client->send("goodbye");
  client->close(milliseconds(1000));
  EXPECT_TRUE(eventually([&] { return server->send(first, "more") == SendStatus::Gone; }));
  EXPECT_EQ(next_at_server(), "goodbye");
  EXPECT_EQ(peer, first);
}

TEST_F(Sockets, SayThatTheCoordinatorHasGone) {
  client->send("there");
  EXPECT_EQ(next_at_server(), "there");
  EXPECT_FALSE(client->lost());
  const std::string endpoint = server->endpoint();
  server.reset();
  Wakeup other;
  EXPECT_TRUE(
      eventually([&] { return client->lost(); }, [&] { client->wait(other, milliseconds(10)); }));
}

TEST_F(Sockets, GiveAReconnectedPeerAnotherName) {
  client->send("one");
  EXPECT_EQ(next_at_server(), "one");
  const PeerId first = peer;
  client->connect();
  client->send("two");
  EXPECT_EQ(next_at_server(), "two");
  EXPECT_NE(peer, first);
}

TEST_F(Sockets, DropAnOverLongMessageAndItsConnectionOnly) {
  ClientSocket honest(server->endpoint());
  honest.connect();
  client->send(std::string(kMaxFrameBytes + 1, 'x'));
  Wakeup other;
  bool lost = false;
  for (int i = 0; i < 1000 && !lost; ++i) {
    client->wait(other, milliseconds(10));
    lost = client->lost();
  }
  EXPECT_TRUE(lost);
  honest.send("fine");
  EXPECT_EQ(next_at_server(), "fine");
}

TEST_F(Sockets, RefuseAnAddressThatIsTaken) {
  EXPECT_EQ(why_not(ServerSocket::bind(server->endpoint())).kind, ErrorKind::Conflict);
}

/// The socket that listens, and where a client finds it.
struct Ends {
  const char* bind;
  const char* connect;
};

class Addresses : public testing::TestWithParam<Ends> {};

bool has_ipv6() {
  sockaddr_in6 address = {};
  address.sin6_family = AF_INET6;
  address.sin6_addr = in6addr_loopback;
  const int end = socket(AF_INET6, SOCK_STREAM, 0);
  const bool bound = bind(end, reinterpret_cast<sockaddr*>(&address), sizeof address) == 0;
  close(end);
  return bound;
}

TEST_P(Addresses, OfBothFamiliesCarryFrames) {
  const bool is_six = std::string(GetParam().bind) + GetParam().connect != "127.0.0.1127.0.0.1";
  if (is_six && !has_ipv6()) GTEST_SKIP() << "this host has no IPv6";
  const auto server = value_of(ServerSocket::bind(std::string("tcp://") + GetParam().bind + ":*"));
  const int port = address_of(server->endpoint())->port;
  ClientSocket client(std::string("tcp://") + GetParam().connect + ":" + std::to_string(port));
  const Wakeup wakeup;
  ServerSocket::Received received;
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  bool came = false;
  // A name's first number may be another one than that which listens.
  client.connect();
  client.send("there");
  while (!came && std::chrono::steady_clock::now() < deadline) {
    server->wait(wakeup, milliseconds(10));
    came = server->receive(received);
    if (came || !client.lost()) continue;
    client.connect();
    client.send("there");
  }
  ASSERT_TRUE(came);
  EXPECT_EQ(received.frame, "there");
  const std::string host = GetParam().connect;
  if (is_host_number(address_of("tcp://" + host + ":1")->host)) {
    EXPECT_EQ(received.address, address_of("tcp://" + host + ":1")->host)
        << "an IPv4 one as itself";
  }
  EXPECT_EQ(server->send(received.peer, "back"), SendStatus::Sent);
}

INSTANTIATE_TEST_SUITE_P(OfThisHost, Addresses,
                         testing::Values(Ends{"127.0.0.1", "127.0.0.1"}, Ends{"[::1]", "[::1]"},
                                         Ends{"[::]", "[::1]"}, Ends{"[::]", "127.0.0.1"},
                                         Ends{"*", "127.0.0.1"}, Ends{"*", "[::1]"},
                                         Ends{"0.0.0.0", "127.0.0.1"},
                                         Ends{"localhost", "localhost"}));

TEST(SocketAddresses, ThatCannotBeUsedAreNamed) {
  ClientSocket client("tcp://no-such-host.invalid:5555");
  client.connect();
  EXPECT_TRUE(client.lost());
  EXPECT_THAT(client.trouble(), HasSubstr("the name `no-such-host.invalid`"));
  ClientSocket portless("somewhere");
  portless.connect();
  EXPECT_TRUE(portless.lost());
  EXPECT_THAT(portless.trouble(), HasSubstr("no address to connect to"));
  const Error server = why_not(ServerSocket::bind("tcp://[fe80::1]:*"));
  EXPECT_THAT(server.message, HasSubstr("%eth0"));
}

/// A client of root gets the reason, too.
TEST(SocketUsers, AClientSaysThatAnotherUserListens) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof address;
  ASSERT_EQ(seteuid(65534), 0);
  const int other = socket(AF_INET, SOCK_STREAM, 0);
  ASSERT_EQ(seteuid(0), 0);
  ASSERT_EQ(bind(other, reinterpret_cast<sockaddr*>(&address), size), 0);
  ASSERT_EQ(listen(other, 5), 0);
  ASSERT_EQ(getsockname(other, reinterpret_cast<sockaddr*>(&address), &size), 0);
  const int port = ntohs(address.sin_port);
  if (user_who_listens("127.0.0.1", port) != 65534U)
    GTEST_SKIP() << "this system does not say whose a port is";
  ClientSocket client("tcp://127.0.0.1:" + std::to_string(port));
  client.connect();
  EXPECT_TRUE(client.lost());
  EXPECT_THAT(client.trouble(), HasSubstr("belongs to another user of this host"));
  close(other);
}

/// Another user of this host: the kernel says who connects.
TEST(SocketUsers, OthersAreKeptOut) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  const auto server = ServerSocket::bind("tcp://127.0.0.1:*").value();
  if (!server->asks_for_user()) GTEST_SKIP() << "this system does not say whose a connection is";
  sockaddr_in address = {};
  address.sin_family = AF_INET;
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  address.sin_port = htons(static_cast<std::uint16_t>(address_of(server->endpoint())->port));
  // Only in a process of its own: another user's for all threads of this one would be the server's.
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    char byte = 0;
    bool heard = true;
    if (setuid(65534) == 0) {
      const int end = socket(AF_INET, SOCK_STREAM, 0);
      heard = connect(end, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0;
      // libzmq greets before it knows who is there; then the connection ends.
      while (read(end, &byte, 1) > 0) {
      }
    }
    _exit(heard ? 1 : 0);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_EQ(status, 0);
  const auto refusals = server->refusals();
  EXPECT_EQ(refusals.counts.at("another user"), 1U);
  EXPECT_THAT(refusals.last_from.at("another user"), HasSubstr("user "));
  // Its own user comes in.
  ClientSocket own(server->endpoint());
  own.connect();
  own.send("there");
  ServerSocket::Received received;
  const Wakeup wakeup;
  for (int i = 0; i < 2000 && !server->receive(received); ++i)
    server->wait(wakeup, milliseconds(10));
  EXPECT_EQ(received.frame, "there");
}

TEST_F(Sockets, WakeWhenTheyAreNotified) {
  wakeup.notify();
  const auto before = std::chrono::steady_clock::now();
  server->wait(wakeup, std::chrono::seconds(60));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(30));
}

}  // namespace
}  // namespace swarmsmith
