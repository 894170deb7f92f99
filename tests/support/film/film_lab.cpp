#include <fmt/format.h>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/support/film/commands.h"

namespace swarmsmith::film {

Shooting shooting_of(const LabWish& wish, const View& view) {
  Shooting shooting;
  shooting.view = view;
  shooting.exposure_s = wish.exposure_s;
  shooting.readout_s = wish.readout_s;
  shooting.blur_px = wish.blur_px;
  shooting.noise = wish.noise;
  shooting.gain = wish.gain;
  shooting.gradient = wish.gradient;
  return shooting;
}

namespace {

/// Films with the lab's camera, frames in time.
class LabFilm {
 public:
  LabFilm(const LabWish& wish, std::filesystem::path folder, const LabCamera& camera)
      : wish_(wish),
        folder_(std::move(folder)),
        camera_(camera),
        lens_(std::make_shared<const LensMap>(lens_map_of(camera.view.camera))) {}

  void views(const BoardKind& kind) {
    const std::filesystem::path folder = folder_ / (camera_.name + ".board");
    std::filesystem::create_directories(folder);
    const Rng rng = Rng(wish_.lab.seed).split("views of " + camera_.name);
    int number = 0;
    for (const FilmedBoard& board :
         calibration_views(kind, camera_.view.camera, wish_.views, rng)) {
      Scene scene;
      scene.boards.push_back(board);
      // The board is held under the same light, still.
      const VirtualCamera camera(scene, shooting_of(wish_, camera_.view), lens_, wish_.lab.seed);
      write_png(camera.picture(0, number), folder / fmt::format("view{:02}.png", number));
      ++number;
    }
  }

  void clip(const std::string& name, const Scene& scene, double seconds) {
    const VirtualCamera camera(scene, shooting_of(wish_, camera_.view), lens_, wish_.lab.seed);
    Schedule schedule;
    schedule.until_s = seconds;
    schedule.rate_hz = wish_.rate_hz;
    write_clip(camera, frames_of(schedule, Rng(wish_.lab.seed).split(name)),
               folder_ / (name + ending_of(wish_.form)), wish_.form, wish_.rate_hz, true);
  }

 private:
  const LabWish& wish_;
  std::filesystem::path folder_;
  const LabCamera& camera_;
  std::shared_ptr<const LensMap> lens_;
};

}  // namespace

void film_lab(const LabWish& wish, const std::string& folder) {
  const Lab lab = lab_of(wish.lab);
  const std::filesystem::path root(folder);
  std::filesystem::create_directories(root);
  write_text(root / "arena.toml", arena_toml(lab, shooting_of(wish, lab.cameras.front().view)));
  nlohmann::json truth = nlohmann::json::parse(truth_json(lab));
  truth["wish"] = nlohmann::json::parse(wish_json(wish));
  write_text(root / "truth.json", truth.dump(1) + "\n");

  for (const LabCamera& camera : lab.cameras) {
    LabFilm film(wish, root, camera);
    film.views(lab.board);
    film.clip(camera.name + ".arena", empty_scene(lab), 1.6);
    if (&camera != &lab.cameras.front()) continue;
    // Below the first camera, so that its own parallax is part of the task.
    const Point3 above = camera.view.place.centre();
    for (const LabRobot& robot : lab.robots) {
      Scene scene = empty_scene(lab);
      scene.robots.push_back(
          filmed(robot, spin_path({above.x * 0.8 + 0.15, 0.2}, 2.2, 8, {0.0011, -0.0007})));
      if (robot.second_tag >= 0)
        scene.robots.push_back(filmed_second(robot, scene.robots.front().path));
      film.clip(robot.name + ".spin", scene, 8);
      scene.robots = {filmed(robot, straight_path({above.x - 0.2, -0.45, 1.3}, 0.9, 4.5))};
      if (robot.second_tag >= 0)
        scene.robots.push_back(filmed_second(robot, scene.robots.front().path));
      film.clip(robot.name + ".straight", scene, 4.5);
    }
  }
}

}  // namespace swarmsmith::film
