#include <sys/stat.h>

#include <cmath>
#include <string_view>

#include "tests/support/checks.h"
#include "tests/support/temporary_folder.h"
#include "tests/tracking/video/made_video.h"

namespace swarmsmith {
namespace {

std::string error_of(const ReadVideo& video) {
  return video.error ? to_string(*video.error) : "";
}

/// Every frame in its place with its own time, those at the end, too.
void expect_times(const ReadVideo& video, const std::vector<double>& times) {
  ASSERT_FALSE(video.error) << to_string(*video.error);
  ASSERT_EQ(video.frames.size(), times.size());
  EXPECT_EQ(video.info.expected_frames, static_cast<std::int64_t>(times.size()));
  EXPECT_EQ(video.damaged, 0);
  EXPECT_TRUE(video.info.has_times);
  EXPECT_FALSE(video.info.is_truncated);
  for (std::size_t i = 0; i < times.size(); ++i) {
    EXPECT_EQ(video.frames[i].number, static_cast<std::int64_t>(i));
    EXPECT_EQ(video.frames[i].code, static_cast<int>(i));
    ASSERT_TRUE(video.frames[i].time_s.has_value());
    EXPECT_NEAR(*video.frames[i].time_s, times[i], 1e-9) << i;
  }
}

TEST(VideoFile, TellsTheTimeOfEveryFrameToTheLast) {
  const TemporaryFolder folder;
  for (const std::string codec : {"h264", "mjpeg", "ffv1"}) {
    for (const std::string ending : {".mkv", ".mp4"}) {
      if (codec == "ffv1" && ending == ".mp4") continue;
      const std::string path = folder / (codec + ending);
      make_video(path, even_times(40, 25), {.codec = codec, .frame_rate = 25});
      expect_times(read_video(path), even_times(40, 25));
      make_video(path, uneven_times(40), {.codec = codec, .frame_rate = 25});
      expect_times(read_video(path), uneven_times(40));
    }
  }
}

TEST(VideoFile, PutsPicturesThatWereStoredOutOfOrderBackIntoIt) {
  const TemporaryFolder folder;
  for (const std::string name : {"a.mkv", "a.mp4"}) {
    make_video(folder / name, uneven_times(50), {.frame_rate = 20, .b_frames = 3});
    expect_times(read_video(folder / name), uneven_times(50));
  }
}

TEST(VideoFile, CountsAnAviWhoseHeaderAgrees) {
  const TemporaryFolder folder;
  for (const int b_frames : {0, 3}) {
    const VideoOptions options{
        .codec = b_frames == 0 ? "mjpeg" : "h264", .frame_rate = 20, .b_frames = b_frames};
    make_video(folder / "a.avi", even_times(30, 20), options);
    const ReadVideo video = read_video(folder / "a.avi");
    ASSERT_EQ(video.frames.size(), 30U);
    EXPECT_FALSE(video.info.has_times);
    EXPECT_TRUE(video.info.has_count);
    EXPECT_DOUBLE_EQ(video.info.frame_rate, 20);
    for (std::size_t i = 0; i < video.frames.size(); ++i) {
      EXPECT_EQ(video.frames[i].code, static_cast<int>(i));
      EXPECT_FALSE(video.frames[i].time_s);
    }
  }
}

/// The number of frames in the header of an .avi's stream.
void declare_frames(std::string& avi, char frames) {
  const std::size_t header = avi.find("strh");
  ASSERT_NE(header, std::string::npos);
  constexpr std::size_t kLength = 8 + 32;  // chunk's name and size; dwLength in it
  avi[header + kLength] = frames;
}

TEST(VideoFile, DoesNotTrustTheRateOfAnAviWithAWrongDuration) {
  const TemporaryFolder folder;
  make_video(folder / "a.avi", even_times(30, 20), {.codec = "mjpeg", .frame_rate = 20});
  for (const char frames : {char{20}, char{45}}) {
    std::string bytes = whole_file(folder / "a.avi");
    declare_frames(bytes, frames);
    write_bytes(folder / "b.avi", bytes);
    const ReadVideo video = read_video(folder / "b.avi");
    EXPECT_EQ(video.frames.size(), 30U);
    EXPECT_FALSE(video.info.has_count);
    EXPECT_FALSE(video.info.is_truncated);
  }
}

/// With an empty chunk before a frame, as recorders write it for one that they dropped.
std::string with_dropped_frame(std::string avi, int before) {
  std::size_t at = avi.find("movi");
  for (int i = 0; i <= before; ++i)
    at = avi.find("00dc", at + 4);
  avi.insert(at, std::string("00dc\0\0\0\0", 8));
  return avi.replace(avi.find("idx1"), 4, "JUNK");
}

TEST(VideoFile, KeepsThePlaceOfAFrameThatTheRecorderDropped) {
  const TemporaryFolder folder;
  make_video(folder / "a.avi", even_times(30, 20), {.codec = "mjpeg", .frame_rate = 20});
  std::string bytes = with_dropped_frame(whole_file(folder / "a.avi"), 10);
  declare_frames(bytes, 31);
  write_bytes(folder / "b.avi", bytes);
  const ReadVideo video = read_video(folder / "b.avi");
  ASSERT_EQ(video.frames.size(), 30U);
  EXPECT_EQ(video.damaged, 1);
  EXPECT_TRUE(video.info.has_count);
  for (const ReadFrame& frame : video.frames)
    EXPECT_EQ(frame.number, *frame.code + (*frame.code >= 10 ? 1 : 0));
}

TEST(VideoFile, SaysWhenTheEndIsMissing) {
  const TemporaryFolder folder;
  make_video(folder / "a.mkv", even_times(100, 20), {.frame_rate = 20});
  make_video(folder / "a.avi", even_times(100, 20), {.codec = "mjpeg", .frame_rate = 20});
  for (const std::string ending : {".mkv", ".avi"}) {
    const std::string bytes = whole_file(folder / ("a" + ending));
    write_bytes(folder / ("b" + ending), bytes.substr(0, bytes.size() / 2));
    const ReadVideo video = read_video(folder / ("b" + ending));
    EXPECT_FALSE(video.error);
    EXPECT_GT(video.frames.size(), 30U);
    EXPECT_LT(video.frames.size(), 70U);
    EXPECT_TRUE(video.info.is_truncated) << ending;
    EXPECT_EQ(video.info.has_count, ending == ".avi") << "what is there still counts";
  }
}

TEST(VideoFile, RefusesWhatIsNoVideo) {
  const TemporaryFolder folder;
  EXPECT_THAT(error_of(read_video(folder / "none.mp4")), HasSubstr("No such file"));
  write_bytes(folder / "empty.mp4", "");
  EXPECT_THAT(error_of(read_video(folder / "empty.mp4")), HasSubstr("empty"));
  write_bytes(folder / "text.mp4", "This is a letter to my grandmother.\n");
  EXPECT_THAT(error_of(read_video(folder / "text.mp4")),
              HasSubstr("E_VIDEO_UNREADABLE: is not a readable video"));
  // The error has its decoder's own words.
  make_video(folder / "a.mp4", even_times(9, 10), {});
  const std::string bytes = whole_file(folder / "a.mp4");
  write_bytes(folder / "cut.mp4", bytes.substr(0, bytes.size() / 2));
  EXPECT_THAT(error_of(read_video(folder / "cut.mp4")), HasSubstr("its index is missing (moov)"));
}

/// The bytes with a code of four letters replaced wherever it is.
std::string replaced(std::string bytes, std::string_view from, std::string_view to) {
  for (std::size_t at = bytes.find(from); at != std::string::npos; at = bytes.find(from, at + 1))
    bytes.replace(at, from.size(), to);
  return bytes;
}

TEST(VideoFile, APipeIsRefusedAndNotWaitedFor) {
  const TemporaryFolder folder;
  const std::string pipe = (folder / "run.mkv").string();
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(complaint_of(FrameSource::open(pipe)), HasSubstr("E_VIDEO_UNREADABLE: is a pipe"));
}

TEST(VideoFile, RefusesAnUnknownCodecByName) {
  const TemporaryFolder folder;
  make_video(folder / "a.avi", even_times(5, 30), {.codec = "mjpeg"});
  write_bytes(folder / "odd.avi", replaced(whole_file(folder / "a.avi"), "MJPG", "XYZW"));
  EXPECT_THAT(error_of(read_video(folder / "odd.avi")), HasSubstr("its codec"));
  // Known to the library, but not to us.
  write_bytes(folder / "cinepak.avi", replaced(whole_file(folder / "a.avi"), "MJPG", "cvid"));
  EXPECT_THAT(error_of(read_video(folder / "cinepak.avi")),
              HasSubstr("`cinepak` is not supported"));
}

/// An .avi of sound alone: 8 kHz, 8 bits, a tenth of a second.
std::string sound_only() {
  const auto word = [](std::uint32_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i)
      text += static_cast<char>(value >> (8 * i));
    return text;
  };
  const std::string format =
      word(1, 2) + word(1, 2) + word(8000, 4) + word(8000, 4) + word(1, 2) + word(8, 2);
  std::string avih;
  for (const std::uint32_t value : {0U, 8000U, 0U, 0U, 0U, 0U, 1U, 0U, 0U, 0U, 0U, 0U, 0U, 0U})
    avih += word(value, 4);
  std::string strh = "auds" + std::string(4, '\0');
  for (const std::uint32_t value : {0U, 0U, 0U, 1U, 8000U, 0U, 800U, 800U, 0U, 1U, 0U, 0U})
    strh += word(value, 4);
  const auto chunk = [&](const std::string& name, const std::string& body) {
    return name + word(static_cast<std::uint32_t>(body.size()), 4) + body;
  };
  const std::string stream = chunk("LIST", "strl" + chunk("strh", strh) + chunk("strf", format));
  const std::string header = chunk("LIST", "hdrl" + chunk("avih", avih) + stream);
  const std::string movie = chunk("LIST", "movi" + chunk("00wb", std::string(800, '\x80')));
  return chunk("RIFF", "AVI " + header + movie);
}

TEST(VideoFile, RefusesSoundAloneAndVideosWithoutAFrame) {
  const TemporaryFolder folder;
  write_bytes(folder / "sound.avi", sound_only());
  EXPECT_THAT(error_of(read_video(folder / "sound.avi")), HasSubstr("it has no video"));
  for (const std::string name : {"none.mkv", "none.mp4", "none.avi"}) {
    make_video(folder / name, {}, {.codec = "mjpeg"});
    EXPECT_THAT(error_of(read_video(folder / name)), HasSubstr("E_VIDEO_UNREADABLE")) << name;
  }
}

/// Another height and width in the frame headers of JPEGs.
std::string with_size(std::string bytes, std::string_view height_and_width) {
  const std::string header("\xff\xc0\x00\x11\x08", 5);
  for (std::size_t at = bytes.find(header); at != std::string::npos;
       at = bytes.find(header, at + 1))
    bytes.replace(at + header.size(), 4, height_and_width);
  return bytes;
}

TEST(VideoFile, RefusesAbsurdSizesBeforeItMakesRoomForThem) {
  const TemporaryFolder folder;
  make_video(folder / "a.avi", even_times(5, 30), {.codec = "mjpeg"});
  const std::string bytes = whole_file(folder / "a.avi");
  // 65000 x 65000; what the .avi's own header says is of no account.
  write_bytes(folder / "b.avi", with_size(bytes, "\xfd\xe8\xfd\xe8"));
  const ReadVideo large = read_video(folder / "b.avi");
  EXPECT_TRUE(large.frames.empty());
  EXPECT_TRUE(large.error || large.damaged == 5);
  // 20 x 16400: few pixels, but no camera.
  write_bytes(folder / "c.avi", with_size(bytes, std::string_view("\x00\x14\x40\x10", 4)));
  EXPECT_THAT(error_of(read_video(folder / "c.avi")),
              HasSubstr("pixels cannot be used (at most 16384 a side"));
}

}  // namespace
}  // namespace swarmsmith
