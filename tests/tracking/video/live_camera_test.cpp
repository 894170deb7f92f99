#include "tracking/video/internal/live_camera.h"

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"
#include "tracking/video/internal/camera_word.h"

namespace swarmsmith {
namespace {

using std::chrono::milliseconds;

TEST(LiveCamera, KnowsItsWords) {
  for (const std::string word : {"camera:0", "opencv:x", "rtsp://host/a", "v4l2src ! appsink"})
    EXPECT_TRUE(is_camera_word(word)) << word;
  for (const std::string word : {"run.mp4", "folder", "a:b.mkv"})
    EXPECT_FALSE(is_camera_word(word)) << word;
  for (const std::string word :
       {"camera:", "camera:x", "camera:-1", "camera:0:1920", "camera:0:0x0", "camera:0:1920x1080@",
        "camera:0:1920x1080@0", "camera:0x"}) {
    const auto camera = open_camera(word);
    ASSERT_FALSE(camera) << word;
    EXPECT_THAT(camera.error().message, HasSubstr("E_CONFIG: write a camera as")) << word;
  }
}

TEST(LiveCamera, SaysThatThereIsNone) {
  EXPECT_THAT(complaint_of(open_camera("camera:97")),
              HasSubstr("camera:97: E_VIDEO_UNREADABLE: OpenCV cannot"));
}

TEST(LiveCamera, PlaysAFileAsACameraWould) {
  const TemporaryFolder folder;
  make_video(folder / "a.mkv", even_times(25, 50), {.codec = "mjpeg", .frame_rate = 50});
  auto camera = value_of(open_camera("opencv:" + (folder / "a.mkv").string()));
  EXPECT_TRUE(camera->info().is_live);
  EXPECT_EQ(camera->info().size, kMadeSize);
  std::vector<double> times;
  std::int64_t shown = 0;
  while (true) {
    const auto more = value_of(camera->next());
    if (!more) break;
    const Frame& frame = camera->frame();
    EXPECT_EQ(number_in(frame.gray), static_cast<int>(frame.number));
    EXPECT_EQ(camera->color().bgr.size(), 3U * 160 * 96);
    EXPECT_TRUE(times.empty() || *frame.time_s > times.back());
    times.push_back(*frame.time_s);
    ++shown;
  }
  EXPECT_EQ(shown + camera->damaged_frames(), 25);
  ASSERT_GT(shown, 0);
  EXPECT_GT(times.back() - times.front(), 0.4) << "at its own rate: 25 frames at 50 a second";
}

/// A host that takes connections and never says a word.
class SilentHost {
 public:
  SilentHost() : socket_(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(address);
    ::bind(socket_, reinterpret_cast<const sockaddr*>(&address), size);
    ::listen(socket_, 4);
    ::getsockname(socket_, reinterpret_cast<sockaddr*>(&address), &size);
    port_ = ntohs(address.sin_port);
  }
  SilentHost(const SilentHost&) = delete;
  SilentHost& operator=(const SilentHost&) = delete;
  ~SilentHost() { ::close(socket_); }
  int port() const { return port_; }

 private:
  int socket_ = -1;
  int port_ = 0;
};

TEST(LiveCamera, DoesNotWaitForEver) {
  const SilentHost host;
  const std::string word = "http://127.0.0.1:" + std::to_string(host.port()) + "/video";
  EXPECT_THAT(
      complaint_of(open_camera(word, {.opening = milliseconds(200), .frame = milliseconds(200)})),
      HasSubstr("no picture came within 0.2 s"));
}

/// The host hangs up while the process ends: the thread that waited for it goes on just then.
[[noreturn]] void give_up_and_exit() {
  {
    const SilentHost host;
    const std::string word = "http://127.0.0.1:" + std::to_string(host.port()) + "/video";
    static_cast<void>(open_camera(word, {.opening = milliseconds(50), .frame = milliseconds(50)}));
  }
  std::exit(3);
}

TEST(LiveCamera, OneThatWasGivenUpDoesNotSpoilTheEndOfTheProcess) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (int i = 0; i < 10; ++i)
    EXPECT_EXIT(give_up_and_exit(), testing::ExitedWithCode(3), "");
}

}  // namespace
}  // namespace swarmsmith
