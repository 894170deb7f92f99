#include "proto/socket.h"

#include <netinet/in.h>
#include <poll.h>
#include <pthread.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <zmq.hpp>

#include "base/peer_user.h"
#include "proto/frame_pipe.h"
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
    EXPECT_EQ(received.address, "127.0.0.1");
    EXPECT_EQ(received.role, Role::Anyone);
    EXPECT_EQ(received.client, "");
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
  EXPECT_FALSE(client->receive(frame));
  EXPECT_TRUE(client->stood());
  EXPECT_FALSE(client->refused());
  EXPECT_EQ(client->trouble(), "");
  EXPECT_EQ(client->choices(), 1U);
}

TEST_F(Sockets, SkipEmptyFramesOfTheServerOnly) {
  client->send("");
  EXPECT_EQ(next_at_server(), "");
  for (const char* frame : {"", "", "back"})
    EXPECT_EQ(server->send(peer, frame), SendStatus::Sent);
  std::string frame;
  EXPECT_TRUE(eventually([&] { return client->receive(frame); }));
  EXPECT_EQ(frame, "back");
}

/// Programs of others may send them; what comes after is not mixed up with them.
TEST_F(Sockets, GiveAnEmptyFrameForAMessageOfSeveral) {
  zmq::context_t context;
  zmq::socket_t other(context, zmq::socket_type::dealer);
  other.set(zmq::sockopt::linger, 0);
  other.connect(server->endpoint());
  other.send(zmq::str_buffer("one"), zmq::send_flags::sndmore);
  other.send(zmq::str_buffer("two"), zmq::send_flags::none);
  other.send(zmq::str_buffer("three"), zmq::send_flags::none);
  EXPECT_EQ(next_at_server(), "");
  EXPECT_EQ(next_at_server(), "three");
  zmq::socket_t router(context, zmq::socket_type::router);
  router.set(zmq::sockopt::linger, 0);
  router.set(zmq::sockopt::rcvtimeo, 60'000);
  router.bind("tcp://127.0.0.1:*");
  ClientSocket guest(router.get(zmq::sockopt::last_endpoint));
  guest.connect();
  guest.send("there");
  zmq::message_t name, frame;
  ASSERT_TRUE(router.recv(name) && router.recv(frame));
  const std::string id = name.to_string();
  // The first part may be empty, too.
  router.send(zmq::buffer(id), zmq::send_flags::sndmore);
  router.send(zmq::str_buffer(""), zmq::send_flags::sndmore);
  router.send(zmq::str_buffer("two"), zmq::send_flags::none);
  router.send(zmq::buffer(id), zmq::send_flags::sndmore);
  router.send(zmq::str_buffer("three"), zmq::send_flags::none);
  std::string heard = "nothing";
  EXPECT_TRUE(eventually([&] { return guest.receive(heard); }));
  EXPECT_EQ(heard, "");
  EXPECT_TRUE(eventually([&] { return guest.receive(heard); }));
  EXPECT_EQ(heard, "three");
}

/// Even without the probe, which would not reach them.
TEST_F(Sockets, DoNotHearPeersThatChooseTheirNames) {
  auto bound = value_of(ServerSocket::bind("tcp://127.0.0.1:*", {.probes_newcomers = false}));
  server = std::move(bound);
  client->redirect(server->endpoint(), {});
  client->connect();
  zmq::context_t context;
  for (const std::string& name : {std::string("name"), std::string("names")}) {
    zmq::socket_t other(context, zmq::socket_type::dealer);
    other.set(zmq::sockopt::linger, 0);
    other.set(zmq::sockopt::routing_id, name);
    other.connect(server->endpoint());
    other.send(zmq::str_buffer("one"), zmq::send_flags::none);
    server->wait(wakeup, std::chrono::minutes(1));  // until it is there
    ServerSocket::Received received;
    EXPECT_FALSE(server->receive(received)) << name;
    client->send("two");
    EXPECT_EQ(next_at_server(), "two");
  }
}

TEST_F(Sockets, CarryTheLongestFramesAndNoLongerOnes) {
  const std::string longest(kMaxFrameBytes, 'x');
  EXPECT_EQ(client->send(longest), SendStatus::Sent);
  EXPECT_TRUE(next_at_server() == longest);
  const std::string scenario(kMaxFrameToWorkerBytes, 'y');
  EXPECT_EQ(server->send(peer, scenario), SendStatus::Sent);
  std::string frame;
  EXPECT_TRUE(eventually([&] { return client->receive(frame); }));
  EXPECT_TRUE(frame == scenario);
}

TEST_F(Sockets, ThatAreClosedCarryNothing) {
  client->send("there");
  EXPECT_EQ(next_at_server(), "there");
  client->close(milliseconds(0));
  EXPECT_EQ(client->send("more"), SendStatus::Gone);
  std::string frame;
  EXPECT_FALSE(client->receive(frame));
  EXPECT_FALSE(client->lost()) << "it was closed from here";
}

/// One after the other, and each once.
TEST_F(Sockets, TryTheOtherEndpointsOfAServer) {
  const auto second = value_of(ServerSocket::bind("tcp://127.0.0.1:*"));
  ServerSocket::Received received;
  client->redirect(
      server->endpoint(), {},
      {"no endpoint", second->endpoint(), server->endpoint(), "tcp://no-such-host.invalid:5555"});
  const auto hears = [&](const std::unique_ptr<ServerSocket>& end) {
    client->connect();
    EXPECT_EQ(client->choices(), 2U);
    EXPECT_EQ(client->trouble(), "");
    client->send("there");
    return eventually([&] { return end->receive(received); });
  };
  // The first connection of all was made before.
  EXPECT_TRUE(hears(second));
  EXPECT_TRUE(hears(server));
  EXPECT_TRUE(hears(second));
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
  // Said once, and forgotten with the next connection.
  EXPECT_FALSE(client->lost());
  EXPECT_TRUE(client->stood());
  client->connect();
  EXPECT_FALSE(client->stood());
  EXPECT_TRUE(
      eventually([&] { return client->lost(); }, [&] { client->wait(other, milliseconds(10)); }));
  EXPECT_FALSE(client->stood()) << "no program listens any more";
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
  EXPECT_EQ(why_not(ServerSocket::bind(server->endpoint())),
            (Error{ErrorKind::Conflict,
                   "another program listens on this port; name another port, or end that program",
                   server->endpoint()}));
  // An address of documents (RFC 5737), which no host has.
  const Error elsewhere = why_not(ServerSocket::bind("tcp://192.0.2.1:*"));
  EXPECT_EQ(elsewhere.kind, ErrorKind::Unavailable);
  EXPECT_THAT(elsewhere.message, StartsWith("cannot listen on this address: "));
  EXPECT_EQ(elsewhere.where, "tcp://192.0.2.1:*");
  EXPECT_EQ(
      why_not(ServerSocket::bind("127.0.0.1:*")),
      (Error{ErrorKind::BadInput, "invalid address; expected tcp://HOST:PORT", "127.0.0.1:*"}));
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
  // The first one is named.
  client.redirect("tcp://no-such-host.invalid:5555", {}, {"tcp://nor-such-host.invalid:5555"});
  client.connect();
  EXPECT_EQ(client.send("there"), SendStatus::Gone);
  // It does not wait for what cannot come.
  const Wakeup wakeup;
  const auto before = std::chrono::steady_clock::now();
  client.wait(wakeup, std::chrono::seconds(60));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(30));
  EXPECT_TRUE(client.lost());
  EXPECT_FALSE(client.lost());
  EXPECT_THAT(client.trouble(), StartsWith("tcp://no-such-host.invalid:5555: "));
  EXPECT_THAT(client.trouble(), HasSubstr("the name `no-such-host.invalid`"));
  EXPECT_EQ(client.choices(), 0U);
  EXPECT_FALSE(client.stood());
  ClientSocket portless("somewhere");
  portless.connect();
  EXPECT_TRUE(portless.lost());
  EXPECT_EQ(portless.trouble(), "no address to connect to");
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
  EXPECT_EQ(client.trouble(),
            "the program that listens there belongs to another user of this host (" +
                name_of_user(65534) +
                "); without keys client and coordinator on loopback must belong to the same user "
                "(`swarmsmith keygen`)");
  EXPECT_FALSE(client.stood());
  close(other);
}

TEST(SocketUsers, AreAskedForOnLoopbackWithoutKeys) {
  const auto asks = [](const char* endpoint, std::optional<ServerKeys> keys) {
    return value_of(ServerSocket::bind(endpoint, {}, std::move(keys)))->asks_for_user();
  };
  EXPECT_EQ(asks("tcp://127.0.0.1:*", {}), kernel_names_users());
  EXPECT_FALSE(asks("tcp://*:*", {}));
  const ServerKeys keys{.secret_key = make_key_pair().secret_key, .clients = {}};
  EXPECT_FALSE(asks("tcp://127.0.0.1:*", keys));
}

/// An empty frame, which can be turned off for clients that do not expect it.
TEST(SocketUsers, NewcomersOfLoopbackAreProbed) {
  if (!kernel_names_users()) GTEST_SKIP() << "this system does not say whose a connection is";
  for (const bool probes : {true, false}) {
    const auto server = value_of(ServerSocket::bind(
        "tcp://127.0.0.1:*", {.linger = milliseconds(0), .probes_newcomers = probes}));
    zmq::context_t context;
    zmq::socket_t client(context, zmq::socket_type::dealer);
    client.set(zmq::sockopt::linger, 0);
    client.set(zmq::sockopt::rcvtimeo, 60'000);
    client.connect(server->endpoint());
    client.send(zmq::str_buffer("there"), zmq::send_flags::none);
    ServerSocket::Received received;
    ASSERT_TRUE(eventually([&] { return server->receive(received); }));
    EXPECT_EQ(received.frame, "there");
    EXPECT_EQ(server->send(received.peer, "back"), SendStatus::Sent);
    zmq::message_t frame;
    ASSERT_TRUE(client.recv(frame));
    EXPECT_EQ(frame.to_string(), probes ? "" : "back");
  }
}

/// Another user of this host: the kernel says who connects.
TEST(SocketUsers, OthersAreKeptOut) {
  if (geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  if (!kernel_names_users()) GTEST_SKIP() << "this system does not say whose a connection is";
  const auto server = ServerSocket::bind("tcp://127.0.0.1:*").value();
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
  EXPECT_EQ(refusals.last_from.at("another user"), "user " + name_of_user(65534));
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
  client->wait(wakeup, std::chrono::seconds(60));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::seconds(30));
  const auto is_notified = [&] {
    pollfd item{wakeup.file_descriptor(), POLLIN, 0};
    return ::poll(&item, 1, 0) == 1;
  };
  EXPECT_TRUE(is_notified());
  wakeup.clear();
  EXPECT_FALSE(is_notified());
  wakeup.clear();  // does not wait
}

TEST_F(Sockets, WakeWhenAFrameComesOrTheConnectionEnds) {
  const auto before = std::chrono::steady_clock::now();
  const auto wait = [&] { client->wait(wakeup, std::chrono::minutes(2)); };
  client->send("there");
  server->wait(wakeup, std::chrono::minutes(2));
  EXPECT_EQ(next_at_server(), "there");
  std::string frame;
  for (int i = 0; i < 10; ++i) {
    server->send(peer, "back");
    EXPECT_TRUE(eventually([&] { return client->receive(frame); }, wait));
  }
  server.reset();
  EXPECT_TRUE(eventually([&] { return client->lost(); }, wait));
  EXPECT_LT(std::chrono::steady_clock::now() - before, std::chrono::minutes(1));
}

/// A process that gets a signal looks what to do.
TEST_F(Sockets, WakeAtASignal) {
  struct sigaction action = {};
  action.sa_handler = [](int) {};
  struct sigaction before = {};
  sigaction(SIGUSR1, &action, &before);
  std::atomic<bool> woken = false;
  std::thread waiting([&] {
    server->wait(wakeup, std::chrono::minutes(10));
    woken = true;
  });
  EXPECT_TRUE(eventually([&] { return woken.load(); },
                         [&] {
                           pthread_kill(waiting.native_handle(), SIGUSR1);
                           std::this_thread::yield();
                         }));
  waiting.join();
  sigaction(SIGUSR1, &before, nullptr);
}

class FramePipes : public ::testing::Test {
 protected:
  void SetUp() override {
    std::signal(SIGPIPE, SIG_IGN);
    ASSERT_EQ(pipe(ends), 0);
  }
  void TearDown() override {
    close_end(0);
    close_end(1);
    std::signal(SIGPIPE, SIG_DFL);
  }
  void close_end(int which) {
    if (ends[which] >= 0) close(ends[which]);
    ends[which] = -1;
  }
  void put(const std::string& bytes) {
    ASSERT_EQ(::write(ends[1], bytes.data(), bytes.size()), static_cast<ssize_t>(bytes.size()));
  }
  PipeRead read_until(std::chrono::seconds from_now) {
    return read_frame_until(ends[0], kMost, frame, std::chrono::steady_clock::now() + from_now);
  }
  /// Interrupts a thread many times.
  static void interrupt(std::thread& thread) {
    static std::atomic<int> caught;
    caught = 0;
    struct sigaction action = {};
    action.sa_handler = [](int) { ++caught; };  // without SA_RESTART
    struct sigaction before = {};
    sigaction(SIGUSR1, &action, &before);
    EXPECT_TRUE(eventually([&] { return caught >= 30; },
                           [&] {
                             pthread_kill(thread.native_handle(), SIGUSR1);
                             std::this_thread::yield();
                           }));
    sigaction(SIGUSR1, &before, nullptr);
  }

  static constexpr std::size_t kMost = 1'000'000;
  int ends[2] = {-1, -1};
  std::string frame = "before";
};

TEST_F(FramePipes, CarryFramesBehindTheirLengths) {
  ASSERT_TRUE(write_frame(ends[1], std::string(513, 'x')));
  std::string bytes(517, '\0');
  ASSERT_EQ(::read(ends[0], bytes.data(), bytes.size()), 517);
  EXPECT_EQ(bytes, std::string("\1\2\0\0", 4) + std::string(513, 'x'));
  // More than a pipe takes at once: both sides have to go on.
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{70'000}, kMost}) {
    for (const bool with_deadline : {false, true}) {
      std::string sent;
      for (std::size_t i = 0; i < size; ++i)
        sent += static_cast<char>(i * i >> 3U);
      std::thread writer([&] { EXPECT_TRUE(write_frame(ends[1], sent)); });
      const bool came = with_deadline ? read_until(std::chrono::seconds(60)) == PipeRead::Frame
                                      : read_frame(ends[0], kMost, frame);
      writer.join();
      EXPECT_TRUE(came && frame == sent) << size;
    }
  }
}

TEST_F(FramePipes, RefuseLongerFrames) {
  put(std::string("\x41\x42\x0f\0", 4));  // one byte more
  EXPECT_FALSE(read_frame(ends[0], kMost, frame));
  put(std::string("\x41\x42\x0f\0", 4));
  EXPECT_EQ(read_until(std::chrono::seconds(60)), PipeRead::Ended);
  EXPECT_EQ(frame, "before");
}

TEST_F(FramePipes, SayThatTheOtherEndIsClosed) {
  const std::string whole("\3\0\0\0abc", 7);
  // In the length, behind it, in the frame.
  for (const std::size_t size : {0U, 1U, 4U, 6U}) {
    put(whole.substr(0, size));
    close_end(1);
    std::string part;
    EXPECT_FALSE(read_frame(ends[0], kMost, part)) << size;
    EXPECT_EQ(read_until(std::chrono::seconds(60)), PipeRead::Ended);
    close_end(0);
    ASSERT_EQ(pipe(ends), 0);
  }
  close_end(0);
  EXPECT_FALSE(write_frame(ends[1], "abc"));
  EXPECT_FALSE(write_frame(ends[1], ""));
  EXPECT_FALSE(read_frame(-1, kMost, frame));
  EXPECT_FALSE(write_frame(-1, "abc"));
}

TEST_F(FramePipes, WaitUntilTheTimeIsOver) {
  const std::string whole("\3\0\0\0abc", 7);
  for (const std::size_t size : {0U, 1U, 4U, 6U}) {
    put(whole.substr(0, size));
    const auto until = std::chrono::steady_clock::now() + milliseconds(5);
    EXPECT_EQ(read_frame_until(ends[0], kMost, frame, until), PipeRead::TimedOut) << size;
    EXPECT_GE(std::chrono::steady_clock::now(), until);
    close_end(0);
    close_end(1);
    ASSERT_EQ(pipe(ends), 0);
  }
  // What is there is read, however late it is.
  put(whole);
  EXPECT_EQ(read_until(std::chrono::seconds(-1)), PipeRead::Frame);
  EXPECT_EQ(frame, "abc");
  EXPECT_EQ(read_until(std::chrono::seconds(-1)), PipeRead::TimedOut);
}

TEST_F(FramePipes, GoOnAfterSignals) {
  const std::string sent(200'000, 'x');  // a pipe takes less, so the writer waits
  for (const bool with_deadline : {false, true}) {
    std::thread reader([&] {
      EXPECT_TRUE(with_deadline ? read_until(std::chrono::seconds(60)) == PipeRead::Frame
                                : read_frame(ends[0], kMost, frame));
    });
    interrupt(reader);
    EXPECT_TRUE(write_frame(ends[1], "abc"));
    reader.join();
    EXPECT_EQ(frame, "abc");
    std::thread writer([&] { EXPECT_TRUE(write_frame(ends[1], sent)); });
    interrupt(writer);
    EXPECT_TRUE(read_frame(ends[0], kMost, frame));
    writer.join();
    EXPECT_TRUE(frame == sent);
  }
}

}  // namespace
}  // namespace swarmsmith
