#include "coordinator/service/http_server.h"

#include <memory>
#include <utility>
#include <vector>

#include "tests/support/checks.h"
#include "tests/support/http_peer.h"
#include "tests/support/peak_memory.h"

namespace swarmsmith {
namespace {

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
  const auto second = value_of(HttpServer::start(on_loopback(port_of(*first), true)));
  EXPECT_NE(port_of(*first), port_of(*second));
  EXPECT_THAT(get(port_of(*second), "/healthz"), EndsWith("ok\n"));
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

/// A proxy may take the second of two headers, where we take the first.
TEST(HttpServerTest, ARequestWithTwoMeaningsIsRefused) {
  const auto server = HttpServer::start(on_loopback()).value();
  server->publish({});
  const std::string line = "GET /status HTTP/1.1\r\n";
  const std::string host = "Host: localhost\r\n";
  for (const std::string& headers :
       {host + host, host + "Host: evil.example\r\n", "hOST: evil.example\r\n" + host,
        host + "Authorization: Bearer a\r\nAuthorization: Bearer b\r\n",
        host + "Content-Length: 0\r\nContent-Length: 5\r\n",
        host + "Content-Length: 0\r\nTransfer-Encoding: chunked\r\n",
        host + "Origin: http://localhost\r\nOrigin: http://evil.example\r\n",
        host + "Sec-Fetch-Site: none\r\nSec-Fetch-Site: cross-site\r\n",
        std::string("Host: local\r\n host\r\n"), std::string("Host : localhost\r\n"),
        host + "X\r\n"}) {
    EXPECT_THAT(HttpPeer(port_of(*server)).say(line + headers + "\r\n").hear(),
                StartsWith("HTTP/1.1 400"))
        << headers;
  }
  EXPECT_THAT(
      HttpPeer(port_of(*server))
          .say(line + host + "Accept: a\r\nAccept: b\r\nX-Empty:\r\nContent-Length: 0\r\n\r\n")
          .hear(),
      StartsWith("HTTP/1.1 200"));
}

/// Of a site that computes for any client.
class Computing final : public HttpSite {
 public:
  bool is_open(std::string_view) const override { return false; }
  bool is_api(std::string_view path) const override { return path.starts_with("/api/"); }
  bool is_act(std::string_view) const override { return false; }
  std::string error_json(std::string_view kind, std::string_view) const override {
    return std::string(kind);
  }
  void publish(const LiveStatus&) override {}
  SiteAnswer answer(const SiteRequest&) override {
    return {.status = 200, .type = "text/plain", .body = "computed"};
  }
};

TEST(HttpServerTest, PicturesOfAnotherPageLetNothingBeComputed) {
  HttpOptions options = on_loopback();
  options.site = std::make_shared<Computing>();
  const auto server = HttpServer::start(options).value();
  const std::string port = std::to_string(port_of(*server));
  for (const std::string& from :
       {std::string("Sec-Fetch-Site: cross-site"), std::string("Sec-Fetch-Site: same-site"),
        std::string("Referer: http://evil.example/page"), std::string("Origin: null"),
        std::string("Referer: http://localhost:1/")}) {
    const std::string answer = get(std::stoi(port), "/api/v1/query", from + "\r\n");
    EXPECT_THAT(answer, StartsWith("HTTP/1.1 403")) << from;
    EXPECT_THAT(answer, EndsWith("other_origin")) << from;
  }
  for (const std::string& from :
       {std::string("X: y"), std::string("Sec-Fetch-Site: same-origin"),
        std::string("Sec-Fetch-Site: none"), std::string("Referer: http://localhost/page")}) {
    EXPECT_THAT(get(std::stoi(port), "/api/v1/query", from + "\r\n"), EndsWith("computed")) << from;
  }
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
