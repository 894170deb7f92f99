#include "tracking/video/frame_clock.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

std::string refusal(std::string_view text) {
  const auto times = parse_frame_times(text);
  return times ? "" : to_string(times.error());
}

Frame frame(std::int64_t number, std::optional<double> time = std::nullopt) {
  return {.number = number, .time_s = time, .gray = {}};
}

TEST(FrameTimes, ReadsColumnsInAnyOrder) {
  EXPECT_THAT(*parse_frame_times("frame,time_s\n0,0.5\n1,0.75\n"), ElementsAre(0.5, 0.75));
  EXPECT_THAT(*parse_frame_times("clock,time_s,frame\r\nx,-1e-3,0\r\n,2,1\r\n"),
              ElementsAre(-0.001, 2));
  EXPECT_THAT(*parse_frame_times("\xef\xbb\xbf\"frame\" , \"time_s\"\n0 , 7"), ElementsAre(7));
}

TEST(FrameTimes, NamesTheLineThatIsWrong) {
  EXPECT_THAT(refusal(""), HasSubstr("empty"));
  EXPECT_THAT(refusal("frame,clock\n0,1\n"), HasSubstr("line 1: E_TIMESTAMPS"));
  EXPECT_THAT(refusal("frame,time\n0,1\n"), HasSubstr("line 2: E_TIMESTAMPS: `1` has no unit"));
  EXPECT_THAT(refusal("frame,frame,time_s\n"), HasSubstr("twice"));
  EXPECT_THAT(refusal("frame,time_s\n"), HasSubstr("no frame"));
  EXPECT_THAT(refusal("frame,time_s\n0,1\n2,2\n"), HasSubstr("line 3: E_TIMESTAMPS: frame 1"));
  EXPECT_THAT(refusal("frame,time_s\n0,1\n1\n"), HasSubstr("line 3: E_TIMESTAMPS: 1 cells"));
  EXPECT_THAT(refusal("frame,time_s\n0,nan\n"), HasSubstr("`nan` is not a time"));
  EXPECT_THAT(refusal("frame,time_s\n0,1s\n"), HasSubstr("`1s` is not a time"));
  EXPECT_THAT(refusal("frame,time_s\n0,1\n\n1,1\n"),
              HasSubstr("line 4: E_TIMESTAMPS: frame 1 at 1 s is not later"));
}

TEST(FrameTimes, RefusesNumbersThatNoClockShows) {
  for (const char* unit : {"time_s", "time_ms", "time_us", "time_ns"}) {
    for (const char* bad : {"nan", "-nan", "inf", "-inf", "1e300", "-1e300", "1e23", "-1e23"}) {
      for (const char* before : {"", "0,0\n1,1\n"}) {
        const std::string row = std::string(*before == 0 ? "0," : "2,") + bad;
        EXPECT_THAT(refusal(std::string("frame,") + unit + "\n" + before + row + "\n"),
                    HasSubstr(*before == 0 ? "line 2: E_TIMESTAMPS" : "line 4: E_TIMESTAMPS"))
            << unit << " " << row;
      }
    }
  }
}

TEST(FrameTimes, MayBeMillisecondsOrOfTheEpoch) {
  const auto times = parse_frame_times("frame,time_ms\n0,500\n1,533.25\n");
  EXPECT_THAT(*times, ElementsAre(0.5, 0.53325));
  EXPECT_THAT(*parse_frame_times("frame,time_s\n0,1732391823.25\n1,1732391823.5\n"),
              ElementsAre(1732391823.25, 1732391823.5));
  EXPECT_THAT(refusal("frame,time_s\n0,1\n1,1e308\n"),
              HasSubstr("line 3: E_TIMESTAMPS: frame 1 at 1e+308 s is more than an hour later"));
}

TEST(FrameTimes, MayBeMicrosecondsNanosecondsOrDates) {
  EXPECT_THAT(*parse_frame_times("frame,time_us\n0,500000\n1,533250\n"), ElementsAre(0.5, 0.53325));
  EXPECT_THAT(*parse_frame_times("frame,time_ns\n0,500000000\n1,750000000\n"),
              ElementsAre(0.5, 0.75));
  EXPECT_THAT(refusal("frame,time_s\n0,1732391823250000\n1,1732391823283000\n"),
              HasSubstr("`time_us`"));
  for (const char* column : {"time", "time_s"}) {
    const auto times =
        value_of(parse_frame_times(std::string("frame,") + column +
                                   "\n0,2026-11-18T11:06:40.250Z\n"
                                   "1,2026-11-18 12:06:40.5+01:00\n"
                                   "2,2026-11-18T11-06-40-750\n3,2026-11-18T11:06:41\n"));
    EXPECT_THAT(times, ElementsAre(1795000000.25, 1795000000.5, 1795000000.75, 1795000001.0));
  }
  for (const char* none : {"2026-13-18T11:06:40", "2026-11-18", "2026-11-18T11:06", "11:06:40.25",
                           "2026-11-18T11:06:40.25x", "2026-02-30T11:06:40"})
    EXPECT_THAT(refusal(std::string("frame,time\n0,") + none + "\n"), HasSubstr("is not a time"));
}

TEST(FrameClock, SeesMillisecondsThatAreCalledSeconds) {
  const SourceInfo source{.name = "run.mkv", .frame_rate = 30, .has_times = true};
  const Error clock = why_not(FrameClock::of(source, std::vector<double>{0, 33, 67, 100}));
  EXPECT_THAT(to_string(clock),
              HasSubstr("run.mkv: E_TIMESTAMPS: its times are 33.3 s from frame to frame"));
  EXPECT_THAT(to_string(clock), HasSubstr("`time_ms`"));
  // Slow pictures are slow pictures.
  EXPECT_TRUE(FrameClock::of(source, std::vector<double>{0, 1, 2, 3}));
}

TEST(FrameClock, TrustsTheSidecarThenTheContainerThenTheCount) {
  SourceInfo source{.name = "run.mkv", .frame_rate = 20, .has_times = true, .has_count = true};
  auto sidecar = value_of(FrameClock::of(source, std::vector<double>{10, 11}));
  EXPECT_EQ(sidecar.source(), TimeSource::Sidecar);
  EXPECT_EQ(*sidecar.time_of(frame(0, 0.1)), 10);

  auto container = FrameClock::of(source, std::nullopt);
  EXPECT_EQ(container->source(), TimeSource::Container);
  EXPECT_EQ(*container->time_of(frame(0, 0.1)), 0.1);

  source.has_times = false;
  auto count = FrameClock::of(source, std::nullopt);
  EXPECT_EQ(count->source(), TimeSource::FrameRate);
  EXPECT_DOUBLE_EQ(*count->time_of(frame(3)), 0.15);
  EXPECT_DOUBLE_EQ(*count->time_of(frame(7)), 0.35) << "frames that were left out count";

  source.has_count = false;
  EXPECT_THAT(complaint_of(FrameClock::of(source, std::nullopt)),
              HasSubstr("run.mkv: E_TIMESTAMPS"));
}

TEST(FrameClock, RefusesTimesThatDoNotGrow) {
  const SourceInfo source{.name = "run.mkv", .has_times = true};
  auto clock = FrameClock::of(source, std::nullopt);
  ASSERT_TRUE(clock->time_of(frame(0, 1)));
  EXPECT_FALSE(clock->time_of(frame(1))) << "no time is not time 0";
  for (const double time : {1.0, 0.0}) {
    EXPECT_THAT(complaint_of(clock->time_of(frame(5, time))), HasSubstr("E_TIMESTAMPS: frame 5 "));
  }
}

TEST(FrameClock, WantsAsManyRowsAsFrames) {
  auto clock = FrameClock::of({.name = "run.mkv"}, std::vector<double>{1, 2, 3});
  ASSERT_TRUE(clock->time_of(frame(2)));
  EXPECT_THAT(complaint_of(clock->time_of(frame(3))),
              HasSubstr("E_SIDECAR_MISMATCH: the video has a frame 3"));
  EXPECT_TRUE(clock->finish(3));
  EXPECT_THAT(complaint_of(clock->finish(2)),
              HasSubstr("E_SIDECAR_MISMATCH: 2 frames in the video, 3"));
}

}  // namespace
}  // namespace swarmsmith
