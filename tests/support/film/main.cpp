#include <CLI/CLI.hpp>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>

#include "tests/support/film/commands.h"

namespace swarmsmith::film {
namespace {

const std::map<std::string, ClipForm> kForms{
    {"folder", ClipForm::Folder}, {"mjpg", ClipForm::Mjpg}, {"h264", ClipForm::H264}};

const std::map<std::string, LabLens> kLenses{
    {"wide", LabLens::Wide}, {"narrow", LabLens::Narrow}, {"fisheye", LabLens::Fisheye}};

/// "960x540".
ImageSize parse_size(const std::string& word) {
  ImageSize size;
  if (std::sscanf(word.c_str(), "%dx%d", &size.width, &size.height) != 2 || size.width < 64 ||
      size.height < 64)
    throw CLI::ValidationError("--size", "is not like 960x540: " + word);
  return size;
}

/// "3:4.5", "2:3:4.5": numbers between colons.
std::vector<double> numbers_of(const std::string& word, std::size_t count) {
  std::vector<double> numbers;
  std::istringstream in(word);
  for (std::string part; std::getline(in, part, ':');)
    numbers.push_back(std::stod(part));
  if (numbers.size() != count)
    throw CLI::ValidationError(word, "needs " + std::to_string(count) + " numbers, as in 2:3.5");
  return numbers;
}

/// What both commands say about light and sensor; a run has its lab's where it says nothing.
void declare_camera(CLI::App& app, LabWish& wish) {
  app.add_option(
      "--exposure-ms",
      [&wish](const CLI::results_t& r) {
        wish.exposure_s = std::stod(r.at(0)) / 1000;
        return true;
      },
      "exposure, blurs what moves");
  app.add_option(
      "--readout-ms",
      [&wish](const CLI::results_t& r) {
        wish.readout_s = std::stod(r.at(0)) / 1000;
        return true;
      },
      "rolling shutter, first row to last");
  app.add_option("--blur", wish.blur_px, "sigma of the lens' blur, pixels");
  app.add_option("--noise", wish.noise, "sigma of read noise, grey levels");
  app.add_option("--gain", wish.gain, "of the light; 0.5 is dark");
  app.add_option("--gradient", wish.gradient, "of the light over the image's width");
  app.add_option("--form", wish.form, "folder, mjpg or h264")
      ->transform(CLI::CheckedTransformer(kForms));
}

int run(int argc, char** argv) {
  CLI::App app("Films a virtual laboratory: clips for calibration and runs, and what is true.");
  app.require_subcommand(1);

  std::string folder;
  std::string size = "960x540";
  double survey_mm = 0;
  LabWish lab;
  CLI::App* lab_app = app.add_subcommand("lab", "boards, empty arena, spins and straight drives");
  lab_app->add_option("DIR", folder)->required();
  lab_app->add_option("--size", size, "of the images");
  lab_app->add_option("--seed", lab.lab.seed);
  lab_app->add_option("--cameras", lab.lab.cameras)->check(CLI::Range(1, 2));
  lab_app->add_option("--robots", lab.lab.robots)->check(CLI::Range(1, 20));
  lab_app->add_option("--survey-mm", survey_mm, "sigma of the survey's errors");
  lab_app->add_option("--lens", lab.lab.lens, "wide, narrow or fisheye")
      ->transform(CLI::CheckedTransformer(kLenses));
  lab_app->add_flag("--chessboard", lab.lab.chessboard, "in place of a board with markers");
  lab_app->add_flag("--two-tags", lab.lab.two_tags, "on each robot");
  lab_app->add_option("--fps", lab.rate_hz);
  lab_app->add_option("--views", lab.views, "of the calibration board");
  declare_camera(*lab_app, lab);

  std::string name;
  std::string lab_folder;
  std::string designs = SWARMSMITH_FILM_DESIGNS;
  FilmWish film;
  std::vector<std::string> arms;
  std::vector<std::string> drops;
  std::string cover;
  double second_moved_mm = 0;
  double seconds = 0;
  double jitter_ms = 0;
  bool no_sidecar = false;
  std::vector<std::function<void(LabWish&)>> changes;
  CLI::App* run_app = app.add_subcommand("run", "a simulated run, filmed in a lab");
  run_app->add_option("NAME", name, "path of the files, without an ending")->required();
  run_app->add_option("--lab", lab_folder, "folder of `film lab`")->required();
  run_app->add_option("--mission", film.run.mission);
  run_app->add_option("--machine", film.run.machine, "text, or a design of --designs");
  run_app->add_option("--trajectory", film.run.trajectory, "a recorded one, in place of --machine");
  double latency_ms = 0;
  run_app->add_option("--latency-ms", latency_ms, "from command to treads");
  run_app->add_flag("--every-step", film.run.every_step, "the simulator's motion between cycles");
  run_app->add_flag("--robot-logs", film.robot_logs, "what robots would have written");
  run_app->add_option("--camera-clock", film.camera_clock,
                      "a sidecar with clock_s: when frames are taken");
  run_app->add_option("--start-clock", film.start_clock_s, "the start of the run on that clock");
  run_app->add_option("--designs", designs, "CSV of machines");
  run_app->add_option("--flavour", film.run.flavour);
  run_app->add_option("--profile", film.run.profile);
  run_app->add_option("--seed", film.run.seed);
  run_app->add_option("--seconds", seconds, "instead of the mission's duration");
  run_app->add_option("--fps", film.rate_hz);
  run_app->add_option("--before", film.before_s, "that the video begins before the run");
  run_app->add_option("--after", film.after_s);
  run_app->add_option("--drop", film.faults.drop_share, "share of frames that never arrive");
  run_app->add_option("--drop-from", drops, "FROM:UNTIL of the run, no frame arrives");
  run_app->add_option("--twice", film.faults.twice_share, "share of frames shown twice");
  run_app->add_option("--jitter-ms", jitter_ms, "sigma of when frames are taken");
  run_app->add_flag("--count-stamps", film.faults.counts_frames, "stamps are frame / rate");
  run_app->add_option("--arm", arms, "ROBOT:FROM:UNTIL, an arm covers it");
  run_app->add_option("--cover", cover, "FROM:UNTIL, paper lies on robot 1's first tag");
  run_app->add_option("--second-moved-mm", second_moved_mm, "robot 1's second tag");
  run_app->add_option("--bump", film.bump_s, "the camera is moved then");
  run_app->add_option("--swap", film.swap_s, "robots 1 and 2 swap tags then");
  run_app->add_flag("--duplicate", film.duplicate, "robot 1's tag also lies on the floor");
  run_app->add_flag("--sync", film.sync, "tag 99 is hidden at the start");
  run_app->add_flag("--no-sidecar", no_sidecar);
  run_app->add_flag("--measured-layout", film.measured_layout, "the log names no patches");
  run_app->add_option("--hide-floor-tags", film.hidden_references, "numbers");
  LabWish camera;
  const double unset = std::nan("");
  camera.exposure_s = camera.readout_s = camera.blur_px = camera.noise = unset;
  camera.gain = camera.gradient = unset;
  declare_camera(*run_app, camera);

  CLI11_PARSE(app, argc, argv);
  if (lab_app->parsed()) {
    lab.lab.size = parse_size(size);
    lab.lab.survey_sigma_m = survey_mm / 1000;
    film_lab(lab, folder);
    return 0;
  }
  std::ifstream in(lab_folder + "/truth.json");
  if (!in) throw std::runtime_error("no lab in " + lab_folder);
  std::stringstream truth;
  truth << in.rdbuf();
  LabWish there = wish_from_truth(truth.str());
  const auto change = [](double& to, double from) {
    if (!std::isnan(from)) to = from;
  };
  change(there.exposure_s, camera.exposure_s);
  change(there.readout_s, camera.readout_s);
  change(there.blur_px, camera.blur_px);
  change(there.noise, camera.noise);
  change(there.gain, camera.gain);
  change(there.gradient, camera.gradient);
  if (run_app->count("--form") > 0) there.form = camera.form;
  if (run_app->count("--fps") == 0) film.rate_hz = there.rate_hz;
  film.sidecar = !no_sidecar;
  film.faults.jitter_s = jitter_ms / 1000;
  film.run.latency_s = latency_ms / 1000;
  if (seconds > 0) film.run.seconds = seconds;
  for (const std::string& word : arms) {
    const auto n = numbers_of(word, 3);
    film.arms.push_back({static_cast<int>(n[0]), n[1], n[2]});
  }
  for (const std::string& word : drops) {
    const auto n = numbers_of(word, 2);
    film.faults.drops.push_back({n[0], n[1]});
  }
  if (!cover.empty()) {
    const auto n = numbers_of(cover, 2);
    film.cover_from_s = n[0];
    film.cover_until_s = n[1];
  }
  film.second_moved_m = second_moved_mm / 1000;
  std::printf("%s\n", film_run(there, film, name, designs).c_str());
  return 0;
}

}  // namespace
}  // namespace swarmsmith::film

int main(int argc, char** argv) {
  try {
    return swarmsmith::film::run(argc, argv);
  } catch (const CLI::Error& error) {
    std::fprintf(stderr, "film: %s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "film: %s\n", error.what());
    return 1;
  }
}
