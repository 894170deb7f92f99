#include "coordinator/service/http_server.h"

#include <gmock/gmock.h>
#include <memory>
#include <utility>
#include <vector>

#include "tests/support/http_peer.h"
#include "tests/support/peak_memory.h"

namespace swarmsmith {
namespace {

using testing::EndsWith;
using testing::HasSubstr;
using testing::StartsWith;

HttpOptions on_loopback(int port = 0, bool next_port = false) {
  HttpOptions options;
  options.address = {"127.0.0.1", port};
  options.next_port = next_port;
  return options;
}

int port_of(const HttpServer& server) {
  const std::string address = server.address();
  return std::stoi(address.substr(address.rfind(':') + 1));
}

/// A fleet whose page is some megabytes long.
LiveStatus large_status() {
  std::vector<WorkerStatus> fleet;
  for (int i = 0; i < 3'000; ++i)
    fleet.push_back({.number = i, .state = "connected", .host = std::string(200, 'h')});
  LiveStatus status;
  status.fleet = std::make_shared<const std::vector<WorkerStatus>>(std::move(fleet));
  return status;
}

TEST(HttpServerTest, TwoServersNeverShareAPort) {
  const auto first = HttpServer::start(on_loopback()).value();
  const auto second = HttpServer::start(on_loopback(port_of(*first)));
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().kind, ErrorKind::Conflict);
  EXPECT_THAT(second.error().message, HasSubstr("another program listens on this port"));
}

TEST(HttpServerTest, TheNextPortThatIsFreeWillDo) {
  const auto first = HttpServer::start(on_loopback()).value();
  const auto second = HttpServer::start(on_loopback(port_of(*first), true));
  ASSERT_TRUE(second.has_value()) << to_string(second.error());
  EXPECT_NE(port_of(*first), port_of(**second));
  EXPECT_THAT(get(port_of(**second), "/healthz"), EndsWith("ok\n"));
}

TEST(HttpServerTest, AnAddressOfAnotherHostIsSaidToBeThat) {
  HttpOptions options = on_loopback();
  options.address.host = "192.0.2.1";
  options.token = "0123456789abcdef";
  const auto server = HttpServer::start(options);
  ASSERT_FALSE(server.has_value());
  EXPECT_EQ(server.error().kind, ErrorKind::BadInput);
}

TEST(HttpServerTest, OtherNamesOfTheHostAreRefusedWithTheWayOut) {
  const auto server = HttpServer::start(on_loopback()).value();
  const std::string answer = HttpPeer(port_of(*server))
                                 .say("GET /healthz HTTP/1.1\r\nHost: lab.example.org\r\n\r\n")
                                 .hear();
  // The door answers /healthz itself, after the same checks.
  EXPECT_THAT(answer, StartsWith("HTTP/1.1 421"));
  EXPECT_THAT(answer, HasSubstr("the Host header names another host"));
  EXPECT_THAT(answer, HasSubstr("--http-name"));
}

TEST(HttpServerTest, NamesThatWereGivenCountWhateverTheirCase) {
  HttpOptions options = on_loopback();
  options.names = {"Lab.Example.org"};
  const auto server = HttpServer::start(options).value();
  for (const char* host : {"lab.example.org", "LAB.example.ORG:8443", "Lab.Example.org"}) {
    const std::string request = std::string("GET /healthz HTTP/1.1\r\nHost: ") + host + "\r\n\r\n";
    EXPECT_THAT(HttpPeer(port_of(*server)).say(request).hear(), EndsWith("ok\n")) << host;
  }
  EXPECT_THAT(HttpPeer(port_of(*server))
                  .say("GET /healthz HTTP/1.1\r\nHost: lab.example.org.evil.example\r\n\r\n")
                  .hear(),
              StartsWith("HTTP/1.1 421"));
}

TEST(HttpServerTest, RangesMultiplyNoAnswer) {
  const auto server = HttpServer::start(on_loopback()).value();
  server->publish(large_status());
  const int port = port_of(*server);
  const std::string whole = get(port, "/status");
  ASSERT_GT(whole.size(), 1'000'000U);
  std::string ranges = "Range: bytes=-";
  while (ranges.size() < 8000)
    ranges += ",-";
  const std::vector<std::string> paths = {"/healthz", "/readyz", "/metrics", "/status"};
  for (const std::string& path : paths) {
    for (int i = 0; i < 3; ++i)
      get(port, path);
  }
  const double before = peak_memory();
  for (const std::string& path : paths) {
    server->publish(large_status());  // ready as long as it is young
    for (const std::string& header :
         {ranges, std::string("range: bytes=0-1,2-3"), "X: y\n" + ranges}) {
      const std::string answer = get(port, path, header + "\r\n");
      EXPECT_THAT(answer.substr(0, 20), StartsWith("HTTP/1.1 200")) << path;
      EXPECT_LE(answer.size(), whole.size()) << path;
    }
  }
  EXPECT_LT(peak_memory() - before, 200) << "4,000 ranges of over a megabyte are 4,000";
}

TEST(HttpServerTest, SlowConnectionsKeepNoProbeWaiting) {
  const auto server = HttpServer::start(on_loopback()).value();
  server->publish({});
  const int port = port_of(*server);
  std::vector<HttpPeer> slow;
  for (int i = 0; i < 900; ++i) {
    slow.emplace_back(port).say("GET /healthz HTT");
    if (i % 100 != 99) continue;
    EXPECT_THAT(get(port, "/healthz"), EndsWith("ok\n")) << "beside " << i;
  }
  EXPECT_THAT(get(port, "/readyz"), EndsWith("ok\n"));
  EXPECT_THAT(get(port, "/status").substr(0, 20), StartsWith("HTTP/1.1 200"));
}

TEST(HttpServerTest, SlowReadersKeepNoProbeWaiting) {
  const auto server = HttpServer::start(on_loopback()).value();
  server->publish(large_status());
  const int port = port_of(*server);
  std::vector<HttpPeer> slow;
  for (int i = 0; i < 200; ++i)
    slow.emplace_back(port).say("GET /status HTTP/1.1\r\nHost: localhost\r\n\r\n");
  EXPECT_THAT(get(port, "/healthz"), EndsWith("ok\n"));
  EXPECT_THAT(get(port, "/readyz"), EndsWith("ok\n"));
}

TEST(HttpServerTest, AHeadWithoutAnEndIsNoRequest) {
  const auto server = HttpServer::start(on_loopback()).value();
  const int port = port_of(*server);
  std::string endless = "GET /healthz HTTP/1.1\r\nHost: localhost\r\n";
  while (endless.size() < 100'000)
    endless += "X: " + std::string(1000, 'a') + "\r\n";
  EXPECT_EQ(HttpPeer(port).say(endless).hear(), "");
  EXPECT_THAT(get(port, "/healthz"), EndsWith("ok\n"));
}

}  // namespace
}  // namespace swarmsmith
