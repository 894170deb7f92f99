#include "tracking/scoring/run_patches.h"

#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

class RunPatchesTest : public testing::Test {
 protected:
  Mission mission = built_in_mission("color_selection").value();
  std::vector<Patch> patches = instance_of(mission, 5)->patches;

  std::string refusal() const {
    const auto found = run_patches(mission, patches);
    return found ? "none" : found.error().message;
  }
};

TEST_F(RunPatchesTest, AreThoseOfAnInstance) {
  EXPECT_EQ(run_patches(mission, patches).value(), patches);
}

TEST_F(RunPatchesTest, LieOnThePlacesToTheBit) {
  const std::vector<Patch> laid = patches;
  for (Patch& patch : patches) {
    const Point at = centre_of(patch);
    patch.shape = Disc{{at.x + 0.002, at.y - 0.001}, 0.1};
  }
  EXPECT_EQ(run_patches(mission, patches).value(), laid);
}

TEST_F(RunPatchesTest, AreNeverAssumed) {
  const Error none = why_not(run_patches(mission, std::nullopt));
  EXPECT_THAT(none.message, HasSubstr("E_LAYOUT_MISSING"));
  EXPECT_EQ(none.kind, ErrorKind::Corrupt);
  patches.clear();
  EXPECT_THAT(refusal(), HasSubstr("E_LAYOUT_MISSING"));
}

TEST_F(RunPatchesTest, ElsewhereAreRefusedWithTheNearestPlace) {
  patches[3].shape = Rectangle{{0.31, 0.25}, 0.3, 0.3};
  const auto wrong = run_patches(mission, patches);
  ASSERT_FALSE(wrong);
  EXPECT_THAT(wrong.error().message,
              HasSubstr("E_CONFIG: there is no place for a patch at (0.31, 0.25); the nearest is "
                        "(0.25, 0.25)"));
  EXPECT_EQ(wrong.error().kind, ErrorKind::BadInput);
}

TEST_F(RunPatchesTest, OfWrongColoursNumbersOrTwiceAreRefused) {
  const std::vector<Patch> right = patches;
  patches[0].color = {0, 0, 255};
  EXPECT_THAT(refusal(), HasSubstr("no blue patches"));
  patches = right;
  patches[0].shape = patches[1].shape;
  EXPECT_THAT(refusal(), HasSubstr("two patches at"));
  patches = right;
  patches[0].color = patches.back().color;
  EXPECT_THAT(refusal(), HasSubstr("the run has 3 green patches, and the mission 4"));
}

TEST_F(RunPatchesTest, OnAFixedFloorThereAreNone) {
  mission = built_in_mission("aggregation").value();
  EXPECT_THAT(refusal(), HasSubstr("always the same"));
  EXPECT_TRUE(run_patches(mission, std::nullopt)->empty());
}

}  // namespace
}  // namespace swarmsmith
