// What a server's socket holds of others.

#include <arpa/inet.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "proto/internal/gate.h"
#include "proto/internal/tcp_bytes.h"
#include "proto/network.h"
#include "proto/socket.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kMiB = 1U << 20U;

/// A peer by hand, in plaintext: libzmq's own would not say half a message, nor read nothing.
class RawPeer {
 public:
  explicit RawPeer(const std::string& endpoint) : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port =
        htons(static_cast<std::uint16_t>(std::stoi(endpoint.substr(endpoint.rfind(':') + 1))));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    // What is not read stays with the server.
    const int small = 4096;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &small, sizeof small);
    timeval patience = {.tv_sec = 0, .tv_usec = 200'000};
    setsockopt(socket_, SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
    setsockopt(socket_, SOL_SOCKET, SO_RCVTIMEO, &patience, sizeof patience);
    if (connect(socket_, reinterpret_cast<sockaddr*>(&address), sizeof address) != 0) return;
    // Greeting and READY of ZMTP 3.0 with the mechanism NULL.
    std::string words = "\xff" + std::string(8, '\0') + "\x7f\x03";
    words += '\0';
    words += "NULL" + std::string(16 + 1 + 31, '\0');
    words += std::string(
        "\x04\x1c\x05READY\x0bSocket-Type\0\0\0\x06"
        "DEALER",
        30);
    say(words);
    // libzmq ends a connection that speaks before both are ready.
    constexpr std::size_t kGreeting = 64;
    std::string heard;
    std::array<char, 256> bytes{};
    const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(20);
    while (heard.size() < kGreeting + 2 ||
           heard.size() < kGreeting + 2 + static_cast<unsigned char>(heard[kGreeting + 1])) {
      const ssize_t got = ::recv(socket_, bytes.data(), bytes.size(), 0);
      const bool may_come = got < 0 && (errno == EAGAIN || errno == EINTR);
      if (may_come && std::chrono::steady_clock::now() < until) continue;
      if (got <= 0) return;
      heard.append(bytes.data(), static_cast<std::size_t>(got));
    }
  }
  ~RawPeer() { ::close(socket_); }
  RawPeer(const RawPeer&) = delete;
  RawPeer& operator=(const RawPeer&) = delete;

  /// False when the connection is closed, or no peer reads.
  bool say(const std::string& bytes) const {
    std::size_t said = 0;
    while (said < bytes.size()) {
      const ssize_t sent = ::send(socket_, bytes.data() + said, bytes.size() - said, MSG_NOSIGNAL);
      if (sent <= 0) return false;
      said += static_cast<std::size_t>(sent);
    }
    return true;
  }

  /// Takes what there is; true if the connection is closed.
  bool read() const {
    // With a small one the system waits for its timers between two pieces.
    const int large = kMiB;
    setsockopt(socket_, SOL_SOCKET, SO_RCVBUF, &large, sizeof large);
    std::vector<char> bytes(kMiB);
    ssize_t got = 1;
    while (got > 0)
      got = ::recv(socket_, bytes.data(), bytes.size(), 0);
    return got == 0 || errno != EAGAIN;
  }

 private:
  int socket_;
};

/// A part of a message, after which others come.
std::string part_of(std::size_t size, char flags = 3) {
  std::string part(1, flags);
  for (int byte = 7; byte >= 0; --byte)
    part += static_cast<char>(size >> (8 * static_cast<unsigned>(byte)));
  return part + std::string(size, 'x');
}

class Budgets : public ::testing::Test {
 protected:
  void listen(const SocketOptions& options = {}) {
    auto bound = value_of(ServerSocket::bind("tcp://127.0.0.1:*", options));
    server = std::move(bound);
  }
  bool eventually(const std::function<bool()>& holds) {
    return swarmsmith::eventually(holds, [&] { server->wait(wakeup, milliseconds(2)); });
  }
  std::uint64_t refused(const std::string& reason) const {
    const Refusals refusals = server->refusals();
    const auto at = refusals.counts.find(reason);
    return at == refusals.counts.end() ? 0 : at->second;
  }
  /// The name of who has just said a frame.
  PeerId next_peer() {
    ServerSocket::Received received;
    EXPECT_TRUE(eventually([&] { return server->receive(received); }));
    return received.peer;
  }
  PeerId meet(const RawPeer& peer) {
    peer.say(std::string("\0\5there", 7));
    return next_peer();
  }
  PeerId meet(ClientSocket& client) {
    client.connect();
    client.send("there");
    return next_peer();
  }

  Wakeup wakeup;
  std::unique_ptr<ServerSocket> server;
};

TEST_F(Budgets, AMessageWithoutAnEndIsCutOff) {
  listen();
  const RawPeer peer(server->endpoint());
  const std::string part = part_of(kMiB - 100);
  std::size_t said = 0;
  while (said < 300 * kMiB && peer.say(part))
    said += part.size();
  EXPECT_LT(said, 100 * kMiB);
  EXPECT_TRUE(eventually([&] { return refused("too much at once") > 0; }));
}

TEST_F(Budgets, CuttingOffAConnectionWithManyMessagesLeavesTheOthers) {
  listen({.heartbeat_timeout = std::chrono::minutes(1), .most_waiting = kMiB});
  // libzmq's own limit would be 1000.
  std::string messages;
  for (int i = 0; i < 1500; ++i)
    messages += part_of(2000, 2);
  const RawPeer first(server->endpoint());
  first.say(messages);
  EXPECT_TRUE(eventually([&] { return refused("too much at once") == 1; }));
  const RawPeer second(server->endpoint());
  second.say(messages.substr(0, 2 * kMiB));
  EXPECT_TRUE(eventually([&] { return second.read(); }));
  EXPECT_EQ(refused("too much at once"), 2U);
}

TEST_F(Budgets, AMessageOfNothingButEmptyPartsIsCutOff) {
  listen({.most_waiting_memory = 16 * kMiB});
  const RawPeer peer(server->endpoint());
  std::string empty;
  for (int i = 0; i < 10'000; ++i)
    empty += std::string("\x01\0", 2);
  std::size_t said = 0;
  while (said < 7 * kMiB && peer.say(empty))
    said += empty.size();
  EXPECT_TRUE(eventually([&] { return refused("too much at once") > 0; })) << said;
}

TEST_F(Budgets, OfAHostOrOfAllThoseWithMostAreCutOff) {
  for (const SocketOptions& options : {SocketOptions{.most_waiting_of_host = 4 * kMiB},
                                       SocketOptions{.most_waiting_of_all = 4 * kMiB}}) {
    listen(options);
    ClientSocket honest(server->endpoint());
    const PeerId name = meet(honest);
    std::vector<std::unique_ptr<RawPeer>> peers;
    const std::string part = part_of(kMiB - 100);
    for (int i = 0; i < 12; ++i) {
      peers.push_back(std::make_unique<RawPeer>(server->endpoint()));
      peers.back()->say(part);
    }
    EXPECT_TRUE(eventually([&] { return refused("too much at once") >= 8; }));
    EXPECT_LT(refused("too much at once"), 12U);
    EXPECT_EQ(server->refusals().last_from.at("too much at once"), "127.0.0.1");
    EXPECT_EQ(server->send(name, "still there"), SendStatus::Sent);
    EXPECT_FALSE(honest.lost());
  }
}

TEST_F(Budgets, WhatIsTakenIsHeldNoMore) {
  listen({.most_waiting = 2 * kMiB});
  const RawPeer half(server->endpoint());
  half.say(part_of(kMiB / 2));  // waits all the time, within the limits
  ClientSocket client(server->endpoint());
  meet(client);
  const std::string frame(kMiB / 2, 'x');
  ServerSocket::Received received;
  for (int i = 0; i < 40; ++i) {
    client.send(frame);
    ASSERT_TRUE(eventually([&] { return server->receive(received); }));
    server->wait(wakeup, milliseconds(50));
  }
  EXPECT_EQ(server->refusals().total(), 0U);
  EXPECT_FALSE(client.lost());
}

TEST_F(Budgets, WhoDoesNotReadIsCutOff) {
  listen();
  const RawPeer silent(server->endpoint());
  const PeerId peer = meet(silent);
  const std::string frame(200'000, 'x');
  SendStatus status = SendStatus::Sent;
  std::size_t sent = 0;
  for (; status == SendStatus::Sent && sent < 100 * kMiB; sent += frame.size())
    status = server->send(peer, frame);
  EXPECT_EQ(status, SendStatus::Full);
  EXPECT_LT(sent, 20 * kMiB);
  EXPECT_TRUE(eventually([&] { return server->send(peer, "x") == SendStatus::Gone; }));
  EXPECT_EQ(refused("reads too slowly"), 1U);
}

TEST_F(Budgets, NothingIsOnItsWayToAPeerThatHasGone) {
  listen({.most_unsent_to_all = kMiB});
  std::optional<RawPeer> first(server->endpoint());
  const RawPeer second(server->endpoint());
  const PeerId to_first = meet(*first);
  const PeerId to_second = meet(second);
  const std::string frame(800'000, 'x');
  EXPECT_EQ(server->send(to_first, frame), SendStatus::Sent);
  EXPECT_EQ(server->send(to_second, std::string(2 * kMiB, 'x')), SendStatus::Later);
  first.reset();
  EXPECT_TRUE(eventually([&] { return server->send(to_first, "x") == SendStatus::Gone; }));
  EXPECT_EQ(server->send(to_second, frame), SendStatus::Sent);
  EXPECT_EQ(server->refusals().total(), 0U);
}

/// A peer that does not read takes a few kilobytes into its system, so that all but these are on
/// their way. The limits below leave room for that.
TEST_F(Budgets, ForAPeerHaveRoomForOneLongFrameMore) {
  constexpr std::size_t kPart = 400'000;
  const std::string frame(kPart, 'x');
  for (const std::size_t long_frame : {std::size_t{0}, 2 * kMiB}) {
    listen({.most_unsent = kMiB});
    const RawPeer silent(server->endpoint());
    const PeerId peer = meet(silent);
    if (long_frame > 0) {
      EXPECT_EQ(server->send(peer, std::string(long_frame, 'x')), SendStatus::Sent);
    }
    // Two of 400 kB fit into a megabyte, a third does not.
    EXPECT_EQ(server->send(peer, frame), SendStatus::Sent);
    EXPECT_EQ(server->send(peer, frame), SendStatus::Sent);
    EXPECT_EQ(server->send(peer, frame), SendStatus::Full);
    EXPECT_EQ(refused("reads too slowly"), 1U);
    EXPECT_EQ(server->refusals().last_from.at("reads too slowly"), "127.0.0.1");
  }
}

TEST_F(Budgets, FramesAreLongAboveOneMegabyte) {
  listen();
  const RawPeer silent(server->endpoint());
  const PeerId peer = meet(silent);
  const std::string frame(kMiB, 'x');
  EXPECT_EQ(server->send(peer, frame), SendStatus::Sent);
  EXPECT_EQ(server->send(peer, frame), SendStatus::Sent) << "it has not to wait for the first";
  EXPECT_EQ(server->send(peer, frame + "x"), SendStatus::Sent);
  EXPECT_EQ(server->send(peer, frame), SendStatus::Sent) << "nor for a long one";
  EXPECT_EQ(server->send(peer, frame + "x"), SendStatus::Later);
  // Once it has arrived, the next one may be sent.
  EXPECT_TRUE(eventually([&] {
    silent.read();
    return server->send(peer, frame + "x") == SendStatus::Sent;
  }));
  EXPECT_EQ(server->refusals().total(), 0U);
}

TEST_F(Budgets, ThatAllShareAreNotForThoseWhoRead) {
  for (const SocketOptions& options :
       {SocketOptions{.most_unsent_to_host = kMiB}, SocketOptions{.most_unsent_to_all = kMiB}}) {
    listen(options);
    const RawPeer first(server->endpoint());
    const RawPeer second(server->endpoint());
    const RawPeer third(server->endpoint());
    const RawPeer fourth(server->endpoint());
    const PeerId to_first = meet(first);
    const PeerId to_second = meet(second);
    const PeerId to_third = meet(third);
    const PeerId to_fourth = meet(fourth);
    EXPECT_EQ(server->send(to_first, std::string(600'000, 'x')), SendStatus::Sent);
    EXPECT_EQ(server->send(to_second, std::string(400'000, 'x')), SendStatus::Sent);
    // Together 1'120'000 bytes.
    EXPECT_EQ(server->send(to_third, std::string(120'000, 'x')), SendStatus::Full);
    EXPECT_EQ(server->send(to_fourth, std::string(2 * kMiB, 'x')), SendStatus::Later);
    // Two of 60 kB: as little as this may be on its way to each, not as much as both.
    EXPECT_EQ(server->send(to_fourth, std::string(60'000, 'x')), SendStatus::Sent);
    EXPECT_EQ(server->send(to_fourth, std::string(60'000, 'x')), SendStatus::Full);
    EXPECT_EQ(refused("reads too slowly"), 2U);
    // The others are not to blame; what has arrived leaves room again.
    const RawPeer fifth(server->endpoint());
    const PeerId to_fifth = meet(fifth);
    EXPECT_TRUE(eventually([&] {
      first.read();
      second.read();
      return server->send(to_fifth, std::string(2 * kMiB, 'x')) == SendStatus::Sent;
    }));
    EXPECT_EQ(refused("reads too slowly"), 2U);
  }
}

TEST_F(Budgets, LongFramesWaitForOneAnotherAndShortOnesDoNot) {
  listen({.most_unsent_to_all = 20 * kMiB});
  const RawPeer first(server->endpoint());
  const RawPeer second(server->endpoint());
  const RawPeer third(server->endpoint());
  const PeerId to_first = meet(first);
  const PeerId to_second = meet(second);
  const PeerId to_third = meet(third);
  // More than the system's own buffers take.
  const std::string scenario(12 * kMiB, 'x');
  EXPECT_EQ(server->send(to_first, scenario), SendStatus::Sent);
  EXPECT_EQ(server->send(to_first, scenario), SendStatus::Later) << "one at a time";
  EXPECT_EQ(server->send(to_first, "short"), SendStatus::Sent);
  EXPECT_EQ(server->send(to_second, scenario), SendStatus::Later) << "no room";
  EXPECT_EQ(server->send(to_third, "short"), SendStatus::Sent);
  EXPECT_TRUE(eventually([&] {
    first.read();  // what has come by now
    return server->send(to_second, scenario) == SendStatus::Sent;
  })) << "when the first is there";
  EXPECT_EQ(server->refusals().total(), 0U);
}

TEST_F(Budgets, AHostHasSoManyConnections) {
  listen({.max_connections_of_host = 3});
  std::vector<std::unique_ptr<RawPeer>> peers;
  for (int i = 0; i < 5; ++i)
    peers.push_back(std::make_unique<RawPeer>(server->endpoint()));
  EXPECT_TRUE(eventually([&] { return refused("too many connections of one host") == 2; }));
  peers.clear();
  // Those that have gone leave room.
  ClientSocket client(server->endpoint());
  EXPECT_TRUE(eventually([&] {
    client.connect();
    client.send("there");
    server->wait(wakeup, milliseconds(100));
    ServerSocket::Received received;
    return server->receive(received);
  }));
}

TEST(Gate, KnowsItsClientsByTheirKeys) {
  zmq::context_t context;
  zmq::socket_t server(context, zmq::socket_type::router);
  Gate gate(context, server, {}, {});
  const ListedClient node{
      .name = "node", .role = Role::Worker, .public_key = "one", .expired = false};
  const ListedClient old{.name = "old", .role = Role::Worker, .public_key = "two", .expired = true};
  gate.admit({node, old});
  EXPECT_EQ(gate.find("one"), node);
  EXPECT_EQ(gate.find("two"), std::nullopt);
  EXPECT_EQ(gate.find("three"), std::nullopt);
  gate.admit({});
  EXPECT_EQ(gate.find("one"), std::nullopt);
  EXPECT_EQ(gate.meter_of({}), nullptr);
  gate.count_refusal("a reason", "login1");
  gate.count_refusal("a reason", "");
  gate.count_refusal("another", "");
  const Refusals refusals = gate.refusals();
  EXPECT_THAT(refusals.counts,
              ElementsAre(testing::Pair("a reason", 2), testing::Pair("another", 1)));
  EXPECT_THAT(refusals.last_from, ElementsAre(testing::Pair("a reason", "login1")));
  EXPECT_EQ(refusals.total(), 3U);
}

TEST(Gate, ForgetsTheCountOfAClosedConnection) {
  zmq::context_t context;
  zmq::socket_t server(context, zmq::socket_type::router);
  server.set(zmq::sockopt::rcvtimeo, 60'000);
  const SocketOptions options{.max_connections = 1};
  Gate gate(context, server, {}, options);
  server.bind("tcp://127.0.0.1:*");
  std::optional<RawPeer> peer(server.get(zmq::sockopt::last_endpoint));
  peer->say(std::string("\0\5there", 7));
  zmq::message_t name, frame;
  ASSERT_TRUE(server.recv(name) && server.recv(frame));
  const Connection connection = connection_at(zmq_msg_get(frame.handle(), ZMQ_SRCFD));
  const RawPeer second(server.get(zmq::sockopt::last_endpoint));
  // The gate has seen the first one, too.
  ASSERT_TRUE(eventually([&] { return gate.refusals().total() == 1; }));
  *gate.meter_of(connection) = 7;
  EXPECT_EQ(gate.meter_of(connection)->load(), 7U);
  peer.reset();
  EXPECT_TRUE(eventually([&] { return gate.meter_of(connection)->load() == 0; }));
}

/// A connection may end before the gate sees its begin, when its first message was received
/// already.
TEST(Gate, ForgetsTheCountOfAConnectionThatItNeverSawOpen) {
  zmq::context_t context;
  zmq::socket_t server(context, zmq::socket_type::router);
  Gate gate(context, server, {}, {});
  server.bind("tcp://127.0.0.1:*");
  const Connection never_seen{1000, 1};
  const Connection in_use{1001, 2};
  *gate.meter_of(never_seen) = 7;
  const Gate::Taken used = gate.meter_of(in_use);
  *used = 7;
  const RawPeer other(server.get(zmq::sockopt::last_endpoint));
  EXPECT_TRUE(eventually([&] { return gate.meter_of(never_seen)->load() == 0; }));
  EXPECT_EQ(gate.meter_of(in_use), used);
}

/// Both ends of a connection over loopback, whose bytes the system counts.
class TcpConnections : public ::testing::Test {
 protected:
  void SetUp() override {
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    const int listener = socket(AF_INET, SOCK_STREAM, 0);
    ASSERT_EQ(bind(listener, reinterpret_cast<sockaddr*>(&address), size), 0);
    ASSERT_EQ(listen(listener, 1), 0);
    ASSERT_EQ(getsockname(listener, reinterpret_cast<sockaddr*>(&address), &size), 0);
    here = socket(AF_INET, SOCK_STREAM, 0);
    ASSERT_EQ(connect(here, reinterpret_cast<sockaddr*>(&address), size), 0);
    there = accept(listener, nullptr, nullptr);
    close(listener);
    ASSERT_GE(there, 0);
  }
  void TearDown() override {
    close(here);
    close(there);
  }
  bool is_open() const {
    char byte = 0;
    return recv(here, &byte, 1, MSG_DONTWAIT) < 0 && errno == EAGAIN;
  }

  int here = -1;
  int there = -1;
};

TEST_F(TcpConnections, AreKnownByTheirInode) {
  struct stat status = {};
  ASSERT_EQ(fstat(there, &status), 0);
  const Connection connection = connection_at(there);
  EXPECT_EQ(connection.descriptor, there);
  EXPECT_EQ(connection.inode, status.st_ino);
  int ends[2] = {-1, -1};
  ASSERT_EQ(pipe(ends), 0);
  for (const int descriptor : {-1, ends[0], 1'000'000}) {
    EXPECT_EQ(connection_at(descriptor).descriptor, -1) << descriptor;
    EXPECT_EQ(connection_at(descriptor).inode, 0U) << descriptor;
  }
  close(ends[0]);
  close(ends[1]);
  // The descriptor belongs to another connection by now.
  const Connection other{there, status.st_ino + 1};
  EXPECT_FALSE(tcp_bytes_of(other));
  cut(other);
  EXPECT_TRUE(is_open());
  cut(connection);
  EXPECT_FALSE(is_open());
  cut({});
}

TEST_F(TcpConnections, CountTheirBytes) {
  const auto counts = [](int descriptor) {
    return value_of(tcp_bytes_of(connection_at(descriptor)));
  };
  // The system counts the begin of a connection, too.
  const std::uint64_t before = counts(here).acknowledged;
  const std::string bytes(1234, 'x');
  ASSERT_EQ(send(here, bytes.data(), bytes.size(), 0), 1234);
  ASSERT_EQ(send(there, bytes.data(), 100, 0), 100);
  EXPECT_TRUE(eventually([&] { return counts(there).received == 1234; }));
  EXPECT_TRUE(eventually([&] { return counts(here).received == 100; }));
  EXPECT_TRUE(eventually([&] { return counts(here).acknowledged == before + 1234; }));
  EXPECT_FALSE(tcp_bytes_of({}));
  // Sockets that are no TCP have no such counts.
  int ends[2] = {-1, -1};
  ASSERT_EQ(socketpair(AF_UNIX, SOCK_STREAM, 0, ends), 0);
  EXPECT_FALSE(tcp_bytes_of(connection_at(ends[0])));
  close(ends[0]);
  close(ends[1]);
}

TEST(Network, OfAnAddress) {
  const std::string loopback = network_of("127.0.0.1");
  for (const char* address : {"::1", "127.8.9.10", "::ffff:127.0.0.1"})
    EXPECT_EQ(network_of(address), loopback) << address;
  EXPECT_EQ(network_of("128.0.0.1"), "128.0.0.1");
  EXPECT_EQ(network_of("126.0.0.1"), "126.0.0.1");
  EXPECT_EQ(network_of("::ffff:10.0.0.5"), "10.0.0.5");
  EXPECT_EQ(network_of("::2"), "::/64");
  EXPECT_EQ(network_of("2001:db8::1"), "2001:db8::/64");
  EXPECT_EQ(network_of("2001:db8:0:1:2:3:4:5"), "2001:db8:0:1::/64");
  EXPECT_EQ(network_of("2001:db8::1"), network_of("2001:db8::ff:2"));
  EXPECT_EQ(network_of("fe80::1%eth0"), "fe80::/64");
  EXPECT_EQ(network_of("login1"), "login1");
  EXPECT_EQ(plain_number("10.0.0.5"), "10.0.0.5");
  EXPECT_EQ(plain_number("::ffff:10.0.0.5"), "10.0.0.5");
  EXPECT_EQ(plain_number("::ffff:a00:5"), "::ffff:a00:5") << "not in this form";
}

}  // namespace
}  // namespace swarmsmith
