#include "tests/support/checks.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/lens_reach.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

CameraCalibration camera() {
  CameraCalibration calibration;
  calibration.model = {
      {1920, 1080}, Lens::Pinhole, 1015.1, 1015.3, 959.7, 540.1, {-0.285, 0.1, 1e-5, -3e-4, 0.01}};
  calibration.rms_px = 0.061;
  calibration.worst_view_px = 0.09;
  calibration.views = 17;
  calibration.views_dropped = 1;
  calibration.coverage = 0.93;
  calibration.hull = {{10.5, 20}, {1900.1, 30}, {1880, 1050}, {20, 1060.4}};
  calibration.focal_sigma_px = 0.12;
  calibration.board = "charuco:11x8:0.03:0.022:5x5_100";
  calibration.made = "2026-11-21T14:03:00Z";
  return calibration;
}

PlaceCalibration place() {
  PlaceCalibration calibration;
  calibration.place = {{1, 0, 0, 0, -1, 0, 0, 0, -1}, {0.1, -0.2, 2.7}};
  calibration.rms_px = 0.05;
  calibration.worst_left_out_m = 0.0011;
  calibration.worst_tag = 102;
  calibration.coverage = 0.7;
  for (int i = 0; i < 4; ++i) {
    calibration.tags.push_back({{100 + i, {1.0 / 3, 0.2 * i, -0.7}, 0.1},
                                {{{1.5, 2}, {3, 4.25}, {5, 6}, {7, 8.125}}},
                                0.04,
                                0.001});
  }
  calibration.camera_sha256 = "abc";
  calibration.made = "2026-11-21T14:03:00Z";
  return calibration;
}

OffsetCalibration offset() {
  OffsetCalibration calibration;
  calibration.robot = "rvr1";
  calibration.tag = 1;
  calibration.edge_m = 0.1;
  calibration.height_m = 0.2;
  calibration.offset = {0.061, -0.0379, 1.0 / 7};
  calibration.has_yaw = true;
  calibration.rms_m = 0.0003;
  calibration.sigma_x_m = 0.00003;
  calibration.sigma_y_m = 0.00004;
  calibration.drift_m_s = 0.001;
  calibration.turned_rad = 12.5;
  calibration.samples = 120;
  calibration.made = "2026-11-21T14:03:00Z";
  return calibration;
}

template <class Calibration>
std::string first_error(const OrComplaints<Calibration>& read) {
  return read ? "nothing is wrong" : to_string(read.error().front());
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST(CalibrationFileTest, TextsReadBackToTheSameBits) {
  CameraCalibration fisheye = camera();
  fisheye.model.lens = Lens::Fisheye;
  fisheye.model.distortion = {0.01, -0.002, 0.0003, -0.00004, 0};
  for (const CameraCalibration& calibration : {camera(), fisheye}) {
    const auto back = parse_camera_calibration(calibration_text(calibration), "f");
    ASSERT_TRUE(back) << first_error(back);
    EXPECT_EQ(back->model, calibration.model);
    EXPECT_EQ(calibration_text(*back), calibration_text(calibration));
  }
  const auto hung = parse_place_calibration(calibration_text(place()), "f");
  ASSERT_TRUE(hung) << first_error(hung);
  EXPECT_EQ(hung->place, place().place);
  EXPECT_EQ(hung->tags.at(2).tag, place().tags.at(2).tag);
  EXPECT_EQ(hung->tags.at(2).corners, place().tags.at(2).corners);
  EXPECT_EQ(calibration_text(*hung), calibration_text(place()));
  const auto robot = parse_offset_calibration(calibration_text(offset()), "f");
  ASSERT_TRUE(robot) << first_error(robot);
  EXPECT_EQ(robot->offset, offset().offset);
  EXPECT_EQ(calibration_text(*robot), calibration_text(offset()));
}

TEST(CalibrationFileTest, ErrorsNameLineColumnAndKey) {
  const std::string text = calibration_text(camera());
  EXPECT_THAT(first_error(parse_camera_calibration(replaced(text, "fx = 1015.1", "fx = nan"), "f")),
              AllOf(HasSubstr("f:19:6"), HasSubstr("E_CONFIG"), HasSubstr("`fx`")));
  EXPECT_THAT(first_error(parse_camera_calibration(replaced(text, "fx =", "fz ="), "f")),
              HasSubstr("needs `fx`"));
  EXPECT_THAT(first_error(parse_camera_calibration("format = 1\nkind = ", "f")),
              AllOf(HasSubstr("f:2"), HasSubstr("E_CONFIG")));
  EXPECT_THAT(first_error(parse_camera_calibration(calibration_text(place()), "f")),
              HasSubstr("this is a calibration of kind \"place\"; expected one of kind"));
  EXPECT_THAT(first_error(parse_camera_calibration("", "f")), HasSubstr("format = 1"));
}

/// What counts is the part of the picture that the arena fills.
TEST(LensReachTest, TheArenaMustLieWhereTheBoardWas) {
  CameraCalibration lens = camera();
  CameraPlace above{{1, 0, 0, 0, -1, 0, 0, 0, -1}, {0, 0, 2.7}};
  const Arena arena = dodecagon_of_the_thesis();
  EXPECT_EQ(share_beyond_reach(lens, above, arena), 0.0);
  // The arena is 930 pixels wide: sides of the picture without a board do not matter.
  lens.hull = {{500, 60}, {1420, 60}, {1420, 1020}, {500, 1020}};
  EXPECT_EQ(share_beyond_reach(lens, above, arena), 0.0);
  lens.hull = {{500, 60}, {500, 1020}, {960, 1020}, {960, 60}};
  EXPECT_NEAR(share_beyond_reach(lens, above, arena).value(), 0.37, 0.05);
  EXPECT_GT(0.37, kMostBeyondReach);
  lens.hull.clear();
  EXPECT_FALSE(share_beyond_reach(lens, above, arena).has_value());
}

TEST(CalibrationFileTest, WhatIsUnfitIsRefusedAlsoFromAFile) {
  const std::string text = calibration_text(camera());
  const auto folding = parse_camera_calibration(replaced(text, "[-0.285", "[-0.9"), "f");
  EXPECT_THAT(first_error(folding), AllOf(HasSubstr("E_CALIB_QUALITY"), HasSubstr("folds")));
  EXPECT_EQ(folding.error().front().kind, ErrorKind::Corrupt);
  EXPECT_THAT(
      first_error(parse_camera_calibration(replaced(text, "rms_px = 0.061", "rms_px = 0.61"), "f")),
      AllOf(HasSubstr("E_CALIB_QUALITY"), HasSubstr("0.610 px, limit 0.5")));
  EXPECT_THAT(first_error(parse_camera_calibration(replaced(text, "views = 17", "views = 9"), "f")),
              HasSubstr("9 usable views"));
  const std::string hung = calibration_text(place());
  const auto mirrored = parse_place_calibration(
      replaced(hung, "rotation = [1, 0, 0, 0, -1", "rotation = [1, 0, 0, 0, 1"), "f");
  EXPECT_THAT(first_error(mirrored), AllOf(HasSubstr("E_CALIB_QUALITY"), HasSubstr("rotation")));
  EXPECT_EQ(mirrored.error().front().kind, ErrorKind::Corrupt);
  EXPECT_THAT(
      first_error(parse_place_calibration(
          replaced(hung, "translation = [0.1, -0.2, 2.7]", "translation = [0, 0, -1]"), "f")),
      HasSubstr("E_EXTRINSICS"));
  EXPECT_THAT(first_error(parse_offset_calibration(
                  replaced(calibration_text(offset()), "samples = 120", "samples = 59"), "f")),
              AllOf(HasSubstr("E_SPIN_QUALITY"), HasSubstr("59 usable samples")));
}

/// Every cut and every flipped byte gives a calibration or errors, and nothing else.
TEST(CalibrationFileTest, DamagedFilesNeverCrash) {
  for (const std::string& text :
       {calibration_text(camera()), calibration_text(place()), calibration_text(offset())}) {
    for (std::size_t i = 0; i < text.size(); i += 3) {
      std::string flipped = text;
      flipped[i] = static_cast<char>(flipped[i] ^ (1 << (i % 7)));
      for (const std::string& damaged : {text.substr(0, i), flipped}) {
        const auto a = parse_camera_calibration(damaged, "f");
        const auto b = parse_place_calibration(damaged, "f");
        const auto c = parse_offset_calibration(damaged, "f");
        EXPECT_TRUE(a || !a.error().empty());
        EXPECT_TRUE(b || !b.error().empty());
        EXPECT_TRUE(c || !c.error().empty());
      }
    }
  }
}

}  // namespace
}  // namespace swarmsmith
