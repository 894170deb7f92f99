#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "tests/support/checks.h"
#include "tests/support/film/boards.h"
#include "tests/support/film/virtual_camera.h"
#include "tests/support/temporary_folder.h"
#include "tracking/video/video_writer.h"

namespace swarmsmith {
namespace {

constexpr int kViews = 13;
constexpr int kFramesOfAView = 3;
constexpr int kSharp = 1;  ///< which of them was not blurred

/// A person shows a board from all sides; of each side one frame is sharp.
void film_boards(const std::string& file, const CameraModel& camera) {
  const film::BoardKind kind;
  VideoOptions options;
  options.codec = "mjpeg";
  options.frame_rate = 10;
  options.quality = 95;
  auto writer = value_of(VideoWriter::open(file, camera.size, options));
  const auto lens = std::make_shared<const film::LensMap>(film::lens_map_of(camera));
  int frame = 0;
  for (const film::FilmedBoard& board :
       film::calibration_views(kind, camera, kViews, Rng(4).split("board"))) {
    film::Scene scene;
    scene.boards.push_back(board);
    film::Shooting shooting;
    shooting.view.camera = camera;
    shooting.view.place = film::looking_at({0, 0, 2.7}, {0, 0});
    const ColorImage sharp = film::VirtualCamera(scene, shooting, lens, 1).picture(0, frame);
    shooting.blur_px = 1.6;
    const ColorImage blurred = film::VirtualCamera(scene, shooting, lens, 1).picture(0, frame);
    for (int i = 0; i < kFramesOfAView; ++i, ++frame)
      ASSERT_TRUE(writer.write(i == kSharp ? sharp : blurred, frame / 10.0));
  }
  ASSERT_TRUE(writer.finish());
}

TEST(BoardVideoTest, SharpViewsThatDifferArePickedFromAVideo) {
  const CameraModel camera{{960, 540}, Lens::Pinhole,          560, 560, 479.5,
                           269.5,      {-0.285, 0.09, 0, 0, 0}};
  const TemporaryFolder folder;
  const std::string video = (folder / "boards.mkv").string();
  film_boards(video, camera);
  const std::string answer = (folder / "answer.json").string();
  const std::string command = std::string(SWARMSMITH_BIN_DIR) +
                              "/swarmsmith-track calibrate camera " + video +
                              " --board charuco:9x6:0.04:0.03:4x4_50 --json -o " +
                              (folder / "camera.toml").string() + " > " + answer;
  ASSERT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(answer);
  const nlohmann::json found = nlohmann::json::parse(file);
  EXPECT_NEAR(found["fx"].get<double>(), camera.fx, 0.003 * camera.fx);
  EXPECT_LT(found["rms_px"].get<double>(), 0.15);
  std::set<int> views;
  for (const auto& view : found["views"]) {
    const auto name = view["name"].get<std::string>();
    const int frame = std::stoi(name.substr(name.rfind(' ') + 1));
    EXPECT_EQ(frame % kFramesOfAView, kSharp) << name;
    views.insert(frame / kFramesOfAView);
  }
  EXPECT_GE(views.size(), 11U);
  EXPECT_EQ(views.size(), found["views"].size());
}

}  // namespace
}  // namespace swarmsmith
