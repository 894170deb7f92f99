#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base/text/sha256.h"
#include "base/text/toml_text.h"
#include "base/text/whole_file.h"
#include "robot/log/log_file.h"
#include "robot/log/log_text.h"
#include "sim/files/color_text.h"
#include "sim/files/mission_file.h"
#include "sim/mission/trajectory_csv.h"
#include "tests/support/film/commands.h"

namespace swarmsmith::film {
namespace {

constexpr int kSyncTag = 99;

/// Beside the arena, where the first camera sees it.
Pose sync_place(const Lab& lab) {
  return lab.cameras.size() == 1 ? Pose{1.42, 0.62, 0.3} : Pose{-0.9, 1.15, 0.3};
}

Scene scene_of(const Lab& lab, const RecordedRun& run, const FilmWish& wish) {
  Scene scene = empty_scene(lab);
  std::erase_if(scene.tags, [&](const FilmedTag& tag) {
    return std::ranges::find(wish.hidden_references, tag.tag) != wish.hidden_references.end();
  });
  scene.arena = arena_of(run.mission, run.instance);
  for (std::size_t i = 0; i < run.poses.size(); ++i)
    scene.robots.push_back(filmed(lab.robots.at(i), Path(run.poses[i], 0, run.step_s)));
  if (wish.swap_s != kForever_s) {
    for (std::size_t i = 0; i < 2; ++i) {
      scene.robots.at(i).swap_s = wish.swap_s;
      scene.robots[i].other_tag = scene.robots.at(1 - i).tag;
    }
  }
  scene.robots.front().covered_from_s = wish.cover_from_s;
  scene.robots.front().covered_until_s = wish.cover_until_s;
  for (std::size_t i = 0; lab.robots.front().second_tag >= 0 && i < run.poses.size(); ++i) {
    scene.robots.push_back(filmed_second(lab.robots.at(i), scene.robots[i].path));
    if (i == 0) scene.robots.back().offset.x_m += wish.second_moved_m;
  }
  if (wish.duplicate) scene.tags.push_back({scene.robots.front().tag, {-0.55, 0.62, 1}});
  if (wish.sync) scene.tags.push_back({kSyncTag, sync_place(lab), 0.1, 0, -kForever_s, 0});
  for (const ArmWish& arm : wish.arms) {
    Point hand{0, 0};
    if (arm.robot > 0) {
      const FilmedRobot& robot = scene.robots.at(static_cast<std::size_t>(arm.robot - 1));
      hand =
          tag_pose_of_robot(robot.path.at((arm.from_s + arm.until_s) / 2), robot.offset).position();
    }
    scene.arms.push_back({{1.9, -0.9}, hand, 0.07, 0.35, arm.from_s, arm.until_s});
  }
  return scene;
}

/// The log that a person would keep.
std::string log_toml(const Lab& lab, const RecordedRun& run, const FilmWish& wish,
                     const std::string& name, const std::string& mission,
                     const std::vector<std::string>& clips) {
  std::string text =
      fmt::format("format = 1\nname = {}\nrecorded = 2026-11-21\nmission = {}\nsource = \"real\"\n",
                  quoted_text(name), quoted_text(mission));
  text += wish.sync ? fmt::format("sync = {{ tag = {}, when = \"hidden\" }}\n", kSyncTag)
                    : fmt::format("start = \"{} s\"\n", number_text(wish.before_s));
  if (wish.measured_layout) text += "layout = \"measured\"\n";
  for (std::size_t i = 0; i < clips.size(); ++i) {
    text += fmt::format("\n[[video]]\ncamera = {}\nfile = {}\n", quoted_text(lab.cameras[i].name),
                        quoted_text(clips[i]));
    if (wish.sidecar)
      text += fmt::format("times = {}\n", quoted_text(sidecar_of(clips[i]).string()));
    if (i > 0) text += fmt::format("ahead = \"{} s\"\n", number_text(wish.second_ahead_s));
  }
  for (std::size_t i = 0; wish.robot_logs && i < run.poses.size(); ++i) {
    const std::string& robot = lab.robots.at(i).name;
    text += fmt::format("\n[[robot]]\nname = {}\nlog = {}\n", quoted_text(robot),
                        quoted_text(log_files_of("", name, robot).rows.string()));
  }
  if (wish.measured_layout) return text;
  for (const Patch& patch : run.instance.patches) {
    const Point centre = std::get<Rectangle>(patch.shape).centre;
    text += fmt::format("\n[[patch]]\nx = {}\ny = {}\ncolor = {}\n", number_text(centre.x),
                        number_text(centre.y), quoted_text(color_text(patch.color)));
  }
  return text;
}

/// What the robot's node would have written, with a clock of its own.
void write_robot_log(const RecordedRun& run, std::size_t robot, const std::string& run_name,
                     const std::string& name, const std::filesystem::path& folder) {
  constexpr double kBegin_s = 7000.125;
  const LogFiles files = log_files_of(folder, run_name, name);
  std::string rows = log_columns();
  for (std::size_t i = 0; i < run.decided[robot].size(); ++i) {
    const RobotRecord& decided = run.decided[robot][i];
    LogRow row;
    row.cycle = static_cast<std::int64_t>(i) + 1;
    row.sensed.time_s = static_cast<double>(row.cycle) * kControlPeriod_s;
    row.clock_s = kBegin_s + row.sensed.time_s + 0.0002;
    row.late_ms = 0.2;
    row.state = decided.state;
    row.command = decided.command;
    row.age_ms[0] = 12.5;
    row.sensed.neighbours = run.neighbours[robot][i];
    row.age_ms[index_of(Feed::Neighbours)] = 0;
    rows += log_line(row);
  }
  write_text(files.rows, rows);
  LogHead head{.run = run_name,
               .robot = name,
               .robot_index = static_cast<std::int64_t>(robot),
               .machine = run.machine,
               .machine_digest = sha256_of(run.machine).substr(0, 32),
               .flavour = run.flavour,
               .turn_clock = "cycles",
               .seconds = run.mission.cycles * kControlPeriod_s,
               .max_mps = 0.35,
               .program = "film",
               .host = "film",
               .scheduling = "none"};
  head.start_clock_s = kBegin_s;
  head.end = RunEnd{.state = "ended", .stepped = run.mission.cycles};
  write_text(files.head, log_head_text(head));
}

std::string trajectory_csv(const RecordedRun& run) {
  std::string text(kTrajectoryColumns);
  text += kCsvLineEnd;
  const auto stride = static_cast<int>(std::lround(kControlPeriod_s / run.step_s));
  for (int cycle = 0; cycle <= run.mission.cycles; ++cycle) {
    for (std::size_t robot = 0; robot < run.poses.size(); ++robot) {
      append_pose_cells(text, cycle, static_cast<int>(robot),
                        run.poses[robot][static_cast<std::size_t>(cycle * stride)]);
      text += kCsvLineEnd;
    }
  }
  return text;
}

std::string text_of_file(const std::string& file) {
  auto text = read_file(file, "frame times");
  if (!text) throw std::runtime_error(to_string(text.error()));
  return std::move(*text);
}

std::string truth_csv(const Scene& scene, std::size_t robots,
                      const std::vector<ShotFrame>& frames) {
  std::string text = "frame,time_s,robot,x,y,theta\n";
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t robot = 0; robot < robots; ++robot) {
      const Pose pose = scene.robots[robot].path.at(frames[i].true_s);
      text += fmt::format("{},{:.6f},{},{:.7f},{:.7f},{:.7f}\n", i, frames[i].true_s, robot, pose.x,
                          pose.y, pose.theta);
    }
  }
  return text;
}

}  // namespace

std::string film_run(const LabWish& lab_wish, const FilmWish& wish, const std::string& name,
                     const std::string& designs) {
  Expected<RecordedRun> recorded = record_run(wish.run, designs);
  if (!recorded) throw std::runtime_error(to_string(recorded.error()));
  const RecordedRun& run = *recorded;
  LabOptions options = lab_wish.lab;
  options.robots = std::max(options.robots, run.mission.robots);
  const Lab lab = lab_of(options);
  const std::filesystem::path stem(name);
  if (stem.has_parent_path()) std::filesystem::create_directories(stem.parent_path());
  const auto beside = [&](const std::string& ending) {
    return std::filesystem::path(stem).concat(ending);
  };

  const double end_s = run.mission.cycles * 0.1;
  const auto seed = static_cast<std::uint64_t>(wish.run.seed);
  std::vector<std::string> clips;
  for (std::size_t i = 0; i < lab.cameras.size(); ++i) {
    const LabCamera& seen_by = lab.cameras[i];
    const std::string middle = lab.cameras.size() == 1 ? "" : "." + seen_by.name;
    const std::filesystem::path file = beside(middle + ending_of(lab_wish.form));
    clips.push_back(file.filename().string());
    Shooting shooting = shooting_of(lab_wish, seen_by.view);
    if (wish.bump_s != kForever_s) {
      // Half a degree about the vertical and some millimetres, as a ladder would do it.
      shooting.bump_s = wish.bump_s;
      const Point3 centre = seen_by.view.place.centre();
      shooting.bumped =
          looking_at({centre.x + 0.004, centre.y - 0.003, centre.z}, {0.012, 0.009}, 0.03);
    }
    Schedule schedule = wish.faults;
    schedule.from_s = -wish.before_s;
    schedule.until_s = end_s + wish.after_s;
    schedule.rate_hz = wish.rate_hz;
    // No container knows negative times.
    schedule.clock_ahead_s = wish.before_s + (i == 0 ? 0 : wish.second_ahead_s);
    const Scene scene = scene_of(lab, run, wish);
    const Rng rng = Rng(seed).split("frames of " + seen_by.name);
    const bool is_told = !wish.camera_clock.empty();
    const std::vector<ShotFrame> frames =
        is_told ? frames_of_clock(text_of_file(wish.camera_clock), wish.start_clock_s)
                : frames_of(schedule, rng);
    const VirtualCamera camera(scene, shooting, seed + i);
    write_clip(camera, frames, file, lab_wish.form, wish.rate_hz, wish.sidecar && !is_told);
    if (i == 0) write_text(beside(".truth.csv"), truth_csv(scene, run.poses.size(), frames));
  }

  std::string mission = run.mission.name;
  if (wish.run.seconds) {
    mission = stem.filename().string() + ".mission.toml";
    write_text(beside(".mission.toml"), mission_text({run.mission, 100}));
  }
  const std::string run_name = stem.filename().string();
  if (wish.camera_clock.empty())
    write_text(beside(".toml"), log_toml(lab, run, wish, run_name, mission, clips));
  for (std::size_t i = 0; wish.robot_logs && i < run.decided.size(); ++i)
    write_robot_log(run, i, run_name, lab.robots.at(i).name, stem.parent_path());
  write_text(beside(".trajectory.csv"), trajectory_csv(run));
  nlohmann::json truth = {{"mission", run.mission.name}, {"score", run.score}};
  truth["latency_s"] = run.latency_s ? nlohmann::json(*run.latency_s) : nlohmann::json(nullptr);
  for (std::size_t i = 0; i < run.poses.size(); ++i)
    truth["borders"].push_back(distance_to_change(run, i));
  write_text(beside(".truth.json"), truth.dump() + "\n");
  return truth.dump();
}

}  // namespace swarmsmith::film
