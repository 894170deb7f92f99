#include <map>

#include "base/math.h"
#include "base/text/document.h"
#include "base/text/sha256.h"
#include "tests/support/checks.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

constexpr char kArena[] = R"(format = 1
family = "tag36h11"
[[camera]]
name  = "ceiling"
model = "ceiling.camera.toml"
place = "ceiling.place.toml"
stamp = "start"
exposure = "8 ms"
readout  = "16 ms"
height   = [1.5, 4]
[[reference]]
tag = 100
x = 1.0
y = 0.2
angle = 90
edge = 0.10
[[robot]]
name = "rvr1"
tag = 1
edge = 0.10
height = 0.20
offset = "rvr1.offset.toml"
[[robot]]
name = "rvr2"
tag = 2
edge = 0.10
height = 0.20
)";

/// Calibrations by file name, as if they lay beside the arena file.
FindCalibration files(std::map<std::string, std::string> texts) {
  return [texts](CalibrationKind, const std::string&,
                 const std::string& file) -> Expected<std::optional<std::string>> {
    const auto found = texts.find(file);
    if (found == texts.end()) return std::nullopt;
    return found->second;
  };
}

CameraCalibration camera_calibration() {
  CameraCalibration camera;
  camera.model.size = {1920, 1080};
  camera.model.fx = camera.model.fy = 1015;
  camera.model.cx = 959.5;
  camera.model.cy = 539.5;
  camera.rms_px = 0.06;
  camera.worst_view_px = 0.1;
  camera.views = 17;
  camera.coverage = 0.9;
  camera.board = "charuco 11 x 8";
  camera.made = "2026-11-20T10:00:00Z";
  return camera;
}

PlaceCalibration place_calibration(const std::string& camera_text) {
  PlaceCalibration place;
  place.place.rotation = {1, 0, 0, 0, -1, 0, 0, 0, -1};  // straight down
  place.place.translation = {0, 0, 2.7};
  place.rms_px = 0.05;
  place.coverage = 0.8;
  place.worst_tag = 100;
  for (int tag = 100; tag < 104; ++tag) {
    PlaceCalibration::Seen seen;
    seen.tag = {tag, {tag % 2 == 0 ? 1.0 : -1.0, tag < 102 ? 1.0 : -1.0, 0}, 0.1};
    place.tags.push_back(seen);
  }
  place.camera_sha256 = sha256_of(camera_text);
  place.made = "2026-11-20T11:00:00Z";
  return place;
}

OffsetCalibration offset_calibration() {
  OffsetCalibration offset;
  offset.robot = "rvr1";
  offset.tag = 1;
  offset.edge_m = 0.10;
  offset.height_m = 0.20;
  offset.offset = {0.05, -0.05, 0};
  offset.rms_m = 0.0005;
  offset.sigma_x_m = offset.sigma_y_m = 0.0001;
  offset.turned_rad = 13;
  offset.samples = 120;
  offset.made = "2026-11-20T12:00:00Z";
  return offset;
}

std::map<std::string, std::string> calibrations() {
  const std::string camera = calibration_text(camera_calibration());
  return {{"ceiling.camera.toml", camera},
          {"ceiling.place.toml", calibration_text(place_calibration(camera))},
          {"rvr1.offset.toml", calibration_text(offset_calibration())}};
}

std::vector<std::string> complaints_about(const std::string& text) {
  return complaints_of(parse_rig(text, "arena.toml", files({})));
}

/// The arena of the tests with `before` replaced.
std::string arena_with(const std::string& before, const std::string& after) {
  std::string text = kArena;
  const auto at = text.find(before);
  EXPECT_NE(at, std::string::npos) << before;
  return text.replace(at, before.size(), after);
}

TEST(RigFile, SaysWhatHangsLiesAndDrives) {
  const auto rig = value_of(parse_rig(kArena, "lab/arena.toml", files({})));
  EXPECT_EQ(rig.file, "arena.toml");
  EXPECT_THAT(rig.cameras,
              ElementsAre(CameraSetup{"ceiling", "ceiling.camera.toml", "ceiling.place.toml",
                                      StampedAt::Start, 0.008, 0.016, 1.5, 4}));
  EXPECT_THAT(rig.references, ElementsAre(ReferenceTag{100, {1.0, 0.2, kPi / 2}, 0.10}));
  EXPECT_THAT(rig.robots, ElementsAre(RobotSetup{"rvr1", 1, 0.10, 0.20, "rvr1.offset.toml"},
                                      RobotSetup{"rvr2", 2, 0.10, 0.20, ""}));
  EXPECT_THAT(rig.models, IsEmpty());
  EXPECT_FALSE(rig.view_of(rig.cameras[0]));
}

TEST(RigFile, TakesTheCalibrationsThatAreThere) {
  const auto texts = calibrations();
  const auto rig = value_of(parse_rig(kArena, "arena.toml", files(texts)));
  EXPECT_TRUE(rig.view_of(rig.cameras[0]));
  EXPECT_EQ(rig.offset_of(rig.robots[0]), (TagOffset{0.05, -0.05, 0}));
  EXPECT_FALSE(rig.offset_of(rig.robots[1]));
  const CalibrationFile& file = rig.files.at("rvr1.offset.toml");
  EXPECT_EQ(file.text, texts.at("rvr1.offset.toml"));
  EXPECT_EQ(file.sha256, sha256_of(file.text));
  EXPECT_EQ(file.made, "2026-11-20T12:00:00Z");
  EXPECT_THAT(misfits(rig), IsEmpty());
}

TEST(RigFile, NamesEachMistakeByPlaceKeyAndWhatIsAllowed) {
  EXPECT_THAT(
      complaints_about(R"(format = 1
family = "tag36h12"
[[camera]]
name = "ceiling"
modell = "x.toml"
stamp = "begin"
exposure = "8"
readout = "2 s"
height = [4, 1]
[[reference]]
tag = 600
x = nan
y = 0
edge = -0.1
[[robot]]
name = "rvr1"
tag = 1
edge = 0.1
height = 0.7
[[robot]]
name = "rvr1"
tag = 2
edge = 0.1
)"),
      ElementsAre(
          AllOf(HasSubstr("arena.toml:2:10: E_CONFIG: "), HasSubstr("did you mean \"tag36h11\"?")),
          HasSubstr("arena.toml:3:1: E_CONFIG: [[camera]] needs a `model`"),
          HasSubstr("arena.toml:3:1: E_CONFIG: [[camera]] needs a `place`"),
          AllOf(HasSubstr("arena.toml:5:1: E_CONFIG: "), HasSubstr("did you mean \"model\"?")),
          AllOf(HasSubstr("arena.toml:6:9: E_CONFIG: `stamp`"), HasSubstr("start, middle, end")),
          HasSubstr("arena.toml:7:12: E_CONFIG: `exposure` must be a time with its unit"),
          HasSubstr("arena.toml:8:11: E_CONFIG: `readout` must be from 0 to 1 seconds"),
          HasSubstr("arena.toml:9:10: E_CONFIG: `height` must be [least, most]"),
          HasSubstr("arena.toml:11:7: E_CONFIG: `tag` must be from 0 to 586, not 600"),
          HasSubstr("arena.toml:12:5: E_CONFIG: `x` must be from -100 to 100, not nan"),
          HasSubstr("arena.toml:14:8: E_CONFIG: `edge` must be from 0.005 to 2, not -0.1"),
          AllOf(HasSubstr("arena.toml:19:10: E_CONFIG: `height` must be below the camera"),
                HasSubstr("this is 0.7")),
          HasSubstr("arena.toml:20:1: E_CONFIG: [[robot]] needs `height`"),
          HasSubstr("arena.toml:21:8: E_CONFIG: two [[robot]] have the name \"rvr1\"")));
}

TEST(RigFile, RefusesATagThatIsThereTwice) {
  const auto rig = parse_rig(arena_with("tag = 2", "tag = 1"), "arena.toml", files({}));
  ASSERT_FALSE(rig);
  EXPECT_THAT(lines_of(rig.error()),
              ElementsAre(AllOf(HasSubstr("arena.toml:25:7: E_DUPLICATE_ID: tag 1 is on robot "),
                                HasSubstr("\"rvr1\" and on robot \"rvr2\""))));
  EXPECT_EQ(rig.error().front().kind, ErrorKind::BadInput);
  EXPECT_THAT(complaints_about(arena_with("tag = 2", "tag = 100")),
              ElementsAre(HasSubstr("E_DUPLICATE_ID: tag 100 is on the floor at (1, 0.2)")));
}

constexpr char kMoreTags[] = R"([[robot.more_tags]]
tag = 11
edge = 0.08
height = 0.15
height_error = 0.002
)";

/// The arena file in which rvr1 carries two tags.
std::string arena_with_two_tags(const std::string& more = kMoreTags) {
  std::string text = kArena;
  const std::string before = "[[robot]]\nname = \"rvr2\"";
  return text.insert(text.find(before), more);
}

OffsetCalibration two_offsets() {
  OffsetCalibration both = offset_calibration();
  OffsetCalibration second = both;
  second.tag = 11;
  second.edge_m = 0.08;
  second.height_m = 0.15;
  second.offset = {-0.06, 0.01, 1.5};
  both.more_tags = {second};
  return both;
}

TEST(RigFile, LetsARobotCarrySeveralTags) {
  auto texts = calibrations();
  texts["rvr1.offset.toml"] = calibration_text(two_offsets());
  const auto rig = value_of(parse_rig(arena_with_two_tags(), "arena.toml", files(texts)));
  ASSERT_EQ(rig.robots.size(), 2U);
  EXPECT_EQ(tags_text(rig.robots[0]), "tags 1, 11");
  EXPECT_EQ(tags_text(rig.robots[1]), "tag 2");
  const std::vector<RobotSetup> tags = each_tag(rig.robots);
  ASSERT_EQ(tags.size(), 3U);
  EXPECT_EQ(tags[1].name, "rvr1");
  EXPECT_EQ(tags[1].tag, 11);
  EXPECT_EQ(tags[1].edge_m, 0.08);
  EXPECT_EQ(tags[1].height_m, 0.15);
  EXPECT_EQ(tags[1].height_error_m, 0.002);
  EXPECT_EQ(rig.offset_of(tags[0]), offset_calibration().offset);
  EXPECT_EQ(rig.offset_of(tags[1]), (TagOffset{-0.06, 0.01, 1.5}));
  EXPECT_THAT(misfits(rig), IsEmpty());
  const OffsetCalibration& read = rig.offsets.at("rvr1.offset.toml");
  EXPECT_EQ(calibration_text(read), calibration_text(two_offsets()));
}

TEST(RigFile, RefusesTagsOfOneRobotThatDoNotFit) {
  const auto said = [](const std::string& more) {
    return complaints_about(arena_with_two_tags(more));
  };
  const std::string size = "edge = 0.08\nheight = 0.15\n";
  EXPECT_THAT(said("[[robot.more_tags]]\ntag = 2\n" + size),
              ElementsAre(HasSubstr("E_DUPLICATE_ID: tag 2 is on robot \"rvr1\" and on robot ")));
  EXPECT_THAT(said("[[robot.more_tags]]\ntag = 1\n" + size),
              ElementsAre(HasSubstr("E_DUPLICATE_ID: tag 1 is on robot \"rvr1\"")));
  EXPECT_THAT(said("[[robot.more_tags]]\n" + size), ElementsAre(HasSubstr("needs a `tag`")));
  EXPECT_THAT(said("[[robot.more_tags]]\ntag = 11\nedge = 0.08\nheight = 1.6\n"),
              ElementsAre(HasSubstr("must be below the camera")));
  EXPECT_THAT(said("[[robot.more_tags]]\ntag = 11\nname = \"a\"\n" + size),
              ElementsAre(HasSubstr("name")));
  // Calibrated before it had the second one.
  const auto rig = value_of(parse_rig(arena_with_two_tags(), "arena.toml", files(calibrations())));
  EXPECT_THAT(lines_of(misfits(rig)), ElementsAre(HasSubstr("tag 1 and not 11")));
  EXPECT_EQ(rig.offset_of(rig.robots[0].more_tags.front()), std::nullopt);
}

TEST(RigFile, NeedsACamera) {
  EXPECT_THAT(complaints_about("format = 1\n"),
              ElementsAre(AllOf(HasSubstr("E_CONFIG: "), HasSubstr("no [[camera]]"))));
  EXPECT_THAT(complaints_about("format = 2\n[[camera]]\nname=\"a\"\nmodel=\"b\"\nplace=\"c\"\n"),
              ElementsAre(HasSubstr("E_CONFIG: format 2 is newer")));
}

TEST(RigFile, TakesForeignLettersInStringsAndCommentsOnly) {
  EXPECT_THAT(complaints_about("format = 1\nnam\xc3\xa9 = 1\n"),
              ElementsAre(HasSubstr("arena.toml:2:4: E_CONFIG: this is not TOML: letters")));
  const std::string quoted =
      "# \xc3\xa9\na = \"\\\"\xc3\xa9\"\nb = '\xc3\xa9\\'\nc = \"\"\"\n\xc3\xa9\"\"\"\"\n";
  EXPECT_TRUE(parse_document(quoted, "x.toml"));
  EXPECT_FALSE(parse_document(quoted + "d = \xc3\xa9", "x.toml"));
}

TEST(RigFile, ShowsWhatIsWrongInACalibration) {
  auto texts = calibrations();
  texts["rvr1.offset.toml"] = "format = 1\nrobbot = \"rvr1\"\n";
  EXPECT_THAT(complaint_of(parse_rig(kArena, "arena.toml", files(texts))),
              HasSubstr("rvr1.offset.toml:"));
}

TEST(RigFile, SaysWhichCalibrationsDoNotBelongTogether) {
  auto texts = calibrations();
  CameraCalibration later = camera_calibration();
  later.model.fx = 1016;
  texts["ceiling.camera.toml"] = calibration_text(later);
  const auto rig = value_of(parse_rig(arena_with("tag = 1\nedge = 0.10", "tag = 3\nedge = 0.12"),
                                      "arena.toml", files(texts)));
  EXPECT_THAT(lines_of(misfits(rig)),
              ElementsAre(AllOf(HasSubstr("ceiling.place.toml: E_CALIB_QUALITY: "),
                                HasSubstr("another calibration"), HasSubstr("calibrate arena")),
                          AllOf(HasSubstr("rvr1.offset.toml: E_CALIB_QUALITY: "),
                                HasSubstr("tag 1 and not 3, edge 0.1 and not 0.12"),
                                HasSubstr("calibrate robot"))));
}

TEST(RigFile, RefusesATagAboveWhereTheCameraReallyHangs) {
  auto texts = calibrations();
  PlaceCalibration low = place_calibration(texts.at("ceiling.camera.toml"));
  low.place.translation = {0, 0, 0.15};
  texts["ceiling.place.toml"] = calibration_text(low);
  const auto rig = value_of(parse_rig(kArena, "arena.toml", files(texts)));
  EXPECT_THAT(lines_of(misfits(rig)),
              ElementsAre(HasSubstr("camera \"ceiling\" hangs at 0.15 m"),
                          AllOf(HasSubstr("E_CONFIG: `height` of robot \"rvr1\""),
                                HasSubstr("hangs at 0.15 m; this is 0.2")),
                          HasSubstr("robot \"rvr2\"")));
}

TEST(RigFile, RefusesACameraThatHangsElsewhereThanItsHeightSays) {
  for (const char* height : {"[0.5, 2.6]", "[2.8, 20]"}) {
    const auto rig =
        value_of(parse_rig(arena_with("[1.5, 4]", height), "arena.toml", files(calibrations())));
    EXPECT_THAT(lines_of(misfits(rig)),
                ElementsAre(AllOf(HasSubstr("ceiling.place.toml: E_EXTRINSICS: "),
                                  HasSubstr("camera \"ceiling\" hangs at 2.7 m"), HasSubstr(height),
                                  HasSubstr("calibrate arena"))));
  }
}

}  // namespace
}  // namespace swarmsmith
