#include "tracking/live/live_pages.h"
#include "tests/support/checks.h"
#include "tests/support/eventually.h"

#include <arpa/inet.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <nlohmann/json.hpp>
#include <thread>

namespace swarmsmith {
namespace {

int port_of(const LivePages& pages) {
  const std::string address = pages.address();
  return std::stoi(address.substr(address.rfind(':') + 1));
}

LiveState state_of(std::int64_t frame) {
  LiveState state;
  state.frame = frame;
  state.time_s = 0.1 * static_cast<double>(frame);
  state.robots = {{"rvr1", 1, 0.2, Pose{0.5, 0.25, 1}, 0.1, true, {}}};
  return state;
}

ColorImage picture() {
  return {320, 240, std::vector<std::uint8_t>(320 * 240 * 3, 90)};
}

/// Publishes a picture again and again, as a camera would.
class Publishing {
 public:
  explicit Publishing(LivePages& pages)
      : thread_([this, &pages] {
          for (std::int64_t frame = 0; !done_; ++frame) {
            pages.publish(state_of(frame),
                          pages.is_watched() ? std::optional(picture()) : std::nullopt);
            std::this_thread::sleep_for(std::chrono::milliseconds(5));
          }
        }) {}
  ~Publishing() {
    done_ = true;
    thread_.join();
  }
  Publishing(const Publishing&) = delete;
  Publishing& operator=(const Publishing&) = delete;

 private:
  std::atomic<bool> done_ = false;
  std::thread thread_;
};

TEST(LivePagesTest, ShowsAPageAndTheState) {
  const auto pages = LivePages::start(0, {}).value();
  EXPECT_THAT(pages->address(), StartsWith("http://127.0.0.1:"));
  httplib::Client client("127.0.0.1", port_of(*pages));
  const auto page = client.Get("/");
  ASSERT_TRUE(page);
  EXPECT_EQ(page->status, 200);
  EXPECT_THAT(page->body, HasSubstr("/stream.mjpg"));
  EXPECT_THAT(page->get_header_value("Content-Security-Policy"), HasSubstr("default-src 'self'"));
  EXPECT_EQ(client.Get("/state.json")->status, 503) << "nothing was published yet";
  pages->publish(state_of(7), std::nullopt);
  const auto state = client.Get("/state.json");
  ASSERT_EQ(state->status, 200);
  EXPECT_EQ(nlohmann::json::parse(state->body)["frame"], 7);
  EXPECT_EQ(client.Get("/other")->status, 404);
}

TEST(LivePagesTest, SendsPicturesWhileAClientWatches) {
  const auto pages = LivePages::start(0, {}).value();
  EXPECT_FALSE(pages->is_watched());
  const Publishing publishing(*pages);
  httplib::Client client("127.0.0.1", port_of(*pages));
  const auto frame = client.Get("/frame.jpg");
  ASSERT_TRUE(frame);
  ASSERT_EQ(frame->status, 200);
  EXPECT_THAT(frame->body, StartsWith("\xff\xd8"));
  std::string stream;
  int parts = 0;
  // Leaves after the third picture, as a browser that is closed.
  client.Get("/stream.mjpg", [&](const char* bytes, std::size_t size) {
    stream.append(bytes, size);
    parts = 0;
    for (std::size_t at = 0; (at = stream.find("--frame\r\n", at)) != std::string::npos; ++at)
      ++parts;
    return parts < 3;
  });
  EXPECT_GE(parts, 3) << "several may come at once";
  EXPECT_THAT(stream, StartsWith("--frame\r\nContent-Type: image/jpeg\r\nContent-Length: "));
  EXPECT_TRUE(eventually([&] { return !pages->is_watched(); })) << "the stream has ended";
}

TEST(LivePagesTest, OtherNamesAndMethodsAreRefused) {
  const auto pages = LivePages::start(0, {}).value();
  httplib::Client client("127.0.0.1", port_of(*pages));
  const httplib::Headers evil{{"Host", "evil.example:" + std::to_string(port_of(*pages))}};
  EXPECT_EQ(client.Get("/state.json", evil)->status, 403);
  const httplib::Headers local{{"Host", "localhost:" + std::to_string(port_of(*pages))}};
  EXPECT_EQ(client.Get("/", local)->status, 200);
  EXPECT_EQ(client.Delete("/")->status, 405);
}

TEST(LivePagesTest, RangesMultiplyNoPicture) {
  const auto pages = LivePages::start(0, {}).value();
  const Publishing publishing(*pages);
  httplib::Client client("127.0.0.1", port_of(*pages));
  const auto whole = client.Get("/frame.jpg");
  ASSERT_TRUE(whole);
  std::string ranges = "bytes=-";
  while (ranges.size() < 8000)
    ranges += ",-";
  const auto answer = client.Get("/frame.jpg", httplib::Headers{{"Range", ranges}});
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
  EXPECT_LT(answer->body.size(), 2 * whole->body.size());
}

TEST(LivePagesTest, HalfOpenConnectionsKeepNoOtherWaiting) {
  const auto pages = LivePages::start(0, {}).value();
  httplib::Client client("127.0.0.1", port_of(*pages));
  std::vector<int> sockets;
  for (int i = 0; i < 60; ++i) {
    const int one = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address = {};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port_of(*pages)));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    ASSERT_EQ(::connect(one, reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    sockets.push_back(one);
  }
  client.set_read_timeout(2);
  const auto page = client.Get("/");
  ASSERT_TRUE(page) << "they were waited for";
  EXPECT_EQ(page->status, 200);
  for (const int one : sockets)
    ::close(one);
}

TEST(LivePagesTest, AnotherProgramsPortIsAnError) {
  const auto pages = LivePages::start(0, {}).value();
  const auto second = LivePages::start(port_of(*pages), {});
  ASSERT_FALSE(second.has_value());
  EXPECT_EQ(second.error().kind, ErrorKind::Conflict);
  EXPECT_THAT(second.error().message, HasSubstr("--port"));
}

/// Connections that say half a sentence keep no other one waiting.
TEST(LivePagesTest, HalfOpenConnectionsBlockNoOther) {
  const auto pages = LivePages::start(0, {}).value();
  const Publishing publishing(*pages);
  std::vector<int> sockets;
  for (int i = 0; i < 12; ++i) {
    sockets.push_back(::socket(AF_INET, SOCK_STREAM, 0));
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    address.sin_port = htons(static_cast<std::uint16_t>(port_of(*pages)));
    ASSERT_EQ(::connect(sockets.back(), reinterpret_cast<sockaddr*>(&address), sizeof address), 0);
    ASSERT_EQ(::send(sockets.back(), "GET / HT", 8, MSG_NOSIGNAL), 8);
  }
  httplib::Client client("127.0.0.1", port_of(*pages));
  client.set_read_timeout(2);
  EXPECT_TRUE(client.Get("/"));
  EXPECT_TRUE(client.Get("/frame.jpg"));
  for (const int socket : sockets)
    ::close(socket);
}

}  // namespace
}  // namespace swarmsmith
