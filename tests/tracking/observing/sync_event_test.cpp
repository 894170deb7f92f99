#include "tracking/observing/sync_event.h"

#include <string>

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

/// A camera of 10 frames a second that saw tag 99 where the text has an x.
Observations seen(const std::string& frames) {
  Observations observations;
  CameraRecord& record = observations.cameras.emplace_back();
  record.file = "run.mp4";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    record.frame_times.push_back(5 + 0.1 * static_cast<double>(i));
    Sighting sighting;
    sighting.frame = static_cast<std::int64_t>(i);
    sighting.tag = frames[i] == 'x' ? 99 : 1;
    observations.sightings.push_back(sighting);
  }
  return observations;
}

Expected<double> hidden(const std::string& frames) {
  return sync_instant(seen(frames), 0, {std::nullopt, 99, RunStart::Sync::Hidden});
}
Expected<double> shown(const std::string& frames) {
  return sync_instant(seen(frames), 0, {std::nullopt, 99, RunStart::Sync::Shown});
}

TEST(SyncEvent, IsBetweenTheLastFrameBeforeAndTheFirstAfter) {
  EXPECT_NEAR(*hidden("xxxx...."), 5.35, 1e-12);
  EXPECT_NEAR(*shown("...xxxxx"), 5.25, 1e-12);
}

TEST(SyncEvent, IsNoFlickerOfTheDetector) {
  EXPECT_NEAR(*hidden("xxxx..xx..xx...."), 6.15, 1e-12);
  EXPECT_NEAR(*shown("....xx....xxx"), 5.95, 1e-12);
}

TEST(SyncEvent, NeedsTheOtherStateBefore) {
  for (const char* frames : {"........", "xxxxxxxx", "...xxxxx", "xx......", "xxxxxx..", ""}) {
    const Error instant = why_not(hidden(frames));
    EXPECT_THAT(instant.message, HasSubstr("E_CONFIG: `sync`: tag 99 was covered at no"));
    EXPECT_EQ(instant.kind, ErrorKind::BadInput) << frames;
  }
}

TEST(SyncEvent, IsRefusedWhenItIsThereTwice) {
  const auto instant = hidden("xxx....xxx....");
  ASSERT_FALSE(instant);
  EXPECT_THAT(instant.error().message, HasSubstr("2 times, at 5.300 s, 6.000 s; say by `start`"));
}

}  // namespace
}  // namespace swarmsmith
