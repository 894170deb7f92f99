#include <gmock/gmock.h>

#include <fstream>

#include "tests/support/temporary_folder.h"
#include "tracking/video/frame_source.h"

namespace swarmsmith {
namespace {

TEST(NoBagsTest, AProgramWithoutRosSaysSo) {
  const TemporaryFolder folder;
  const std::string file = (folder / "run.bag").string();
  std::ofstream(file) << "#ROSBAG V2.0\n";
  const auto source = FrameSource::open(file);
  ASSERT_FALSE(source);
  EXPECT_THAT(to_string(source.error()), testing::HasSubstr("built without ROS 1"));
}

TEST(NoBagsTest, BagsAreReadWhereRosIs) {
  GTEST_SKIP() << "skipped: the package librosbag-storage-dev is not there";
}

}  // namespace
}  // namespace swarmsmith
