#include "proto/socket.h"

#include <gtest/gtest.h>
#include <functional>
#include <thread>

#include "proto/wire.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

class Sockets : public ::testing::Test {
 protected:
  void SetUp() override {
    auto bound = ServerSocket::bind("tcp://127.0.0.1:*");
    ASSERT_TRUE(bound);
    server = std::move(*bound);
    client = std::make_unique<ClientSocket>(server->endpoint());
    client->connect();
  }

  bool eventually(const std::function<bool()>& holds) {
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
    while (std::chrono::steady_clock::now() < deadline) {
      if (holds()) return true;
      // Not the server's own wait, which ends at once while a message is unread: who sends to a
      // peer without a pause finds its queue full before it finds it gone.
      std::this_thread::sleep_for(milliseconds(2));
    }
    return false;
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
  EXPECT_EQ(server->send(peer + 1000, "to nobody"), SendStatus::Gone);
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
  bool lost = false;
  for (int i = 0; i < 1000 && !lost; ++i) {
    client->wait(other, milliseconds(10));
    lost = client->lost();
  }
  EXPECT_TRUE(lost);
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
  const auto second = ServerSocket::bind(server->endpoint());
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().kind, ErrorKind::Conflict);
}

TEST_F(Sockets, WakeWhenTheyAreNotified) {
  wakeup.notify();
  const auto before = std::chrono::steady_clock::now();
  server->wait(wakeup, std::chrono::seconds(60));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(30));
}

}  // namespace
}  // namespace swarmsmith
