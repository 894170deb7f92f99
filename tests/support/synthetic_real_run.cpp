#include "tests/support/synthetic_real_run.h"

#include <cmath>

#include <fmt/format.h>

#include "base/rng.h"

namespace swarmsmith {
namespace {

constexpr std::int64_t kRobots = 2;
constexpr std::int64_t kUnknownTag = 77;

std::array<double, 8> square_at(double u, double v) {
  const auto whole = [](double pixels) { return std::round(pixels * 1000) / 1000; };
  return {whole(u - 20), whole(v + 20), whole(u + 20), whole(v + 20),
          whole(u + 20), whole(v - 20), whole(u - 20), whole(v - 20)};
}

void add_camera(RealRunRows& run, std::uint64_t seed, std::int64_t number) {
  const std::string name = number == 0 ? "ceiling" : "wall";
  const std::string model = "model of " + name;
  const std::string place = fmt::format("place of {} in run {}", name, seed);
  run.calibrations.push_back(
      {"sha of " + model, "camera", name, "2026-11-01T10:00:00Z", 0.06, model});
  run.calibrations.push_back({"sha of " + place, "place", name,
                              fmt::format("2026-11-{:02}T11:00:00Z", seed), 0.05, place});
  const std::int64_t frames = 3 + static_cast<std::int64_t>(run.cycles.size()) / kRobots * 3 / 2;
  RealVideoRow video{.number = number,
                     .camera = name,
                     .file = fmt::format("run{}-{}.mp4", seed, name),
                     .sha256 = fmt::format("video {} of {}", seed, name),
                     .time_source = "container",
                     .width = 1920,
                     .height = 1080,
                     .frames = frames,
                     .damaged_frames = number,
                     .camera_calibration = "sha of " + model,
                     .place_calibration = "sha of " + place,
                     .frame_times = {}};
  Rng rng(seed * 2 + static_cast<std::uint64_t>(number));
  for (std::int64_t frame = 0; frame < frames; ++frame) {
    const double time = static_cast<double>(frame) / 15 + rng.uniform(0, 0.001);
    video.frame_times.push_back(time);
    for (std::int64_t robot = 0; robot < kRobots; ++robot) {
      const double angle = time + static_cast<double>(robot);
      run.samples.push_back(
          {.video = number,
           .frame = frame,
           .time_s = time,
           .tag = robot + 1,
           .corners = square_at(900 + 300 * std::cos(angle), 500 + 300 * std::sin(angle)),
           .hamming = frame % 2,
           .margin = 60.5,
           .robot = robot,
           .x = std::cos(angle) + rng.normal(0, 0.001),
           .y = std::sin(angle),
           .theta = angle,
           .use = frame == 7 ? 1 : 0});
    }
    if (frame % 10 == 0)
      run.samples.push_back({.video = number,
                             .frame = frame,
                             .time_s = time,
                             .tag = kUnknownTag,
                             .corners = square_at(40, 40),
                             .hamming = 0,
                             .margin = 33});
  }
  for (std::int64_t tag = 100; tag < 104; ++tag)
    run.references.push_back({.video = number,
                              .time_s = 2.5,
                              .tag = tag,
                              .corners = square_at(static_cast<double>(tag) * 7, 100.25),
                              .frames = frames});
  run.videos.push_back(std::move(video));
}

}  // namespace

RealRunRows synthetic_real_run(std::uint64_t seed, CandidateId candidate, std::int64_t cycles) {
  RealRunRows run{.key = fmt::format("key of run {}", seed),
                  .name = fmt::format("run{:02}", seed),
                  .recorded = "2026-11-21",
                  .mission = "m1",
                  .candidate = candidate,
                  .arena_file = "format = 1\n",
                  .log = fmt::format("name = \"run{:02}\"\n", seed),
                  .mission_file = "format = 1\n",
                  .duration_s = static_cast<double>(cycles) / 10};
  for (std::int64_t cycle = 0; cycle <= cycles; ++cycle) {
    for (std::int64_t robot = 0; robot < kRobots; ++robot) {
      const double angle = static_cast<double>(cycle) / 10 + static_cast<double>(robot);
      run.cycles.push_back(
          {cycle, robot, std::cos(angle), std::sin(angle), angle, cycle == 5 ? 1 : 0});
    }
  }
  add_camera(run, seed, 0);
  add_camera(run, seed, 1);
  for (std::int64_t robot = 0; robot < kRobots; ++robot) {
    const std::string name = fmt::format("rvr{}", robot + 1);
    const std::string offset = fmt::format("offset of {}", name);
    run.calibrations.push_back(
        {"sha of " + offset, "offset", name, "2026-11-02T09:00:00Z", 0.0007, offset});
    run.robots.push_back({.robot = robot,
                          .name = name,
                          .tag = robot + 1,
                          .offset_calibration = "sha of " + offset,
                          .measured = cycles - 1,
                          .interpolated = 1,
                          .longest_gap_s = 0.21,
                          .outliers = 1,
                          .scale = 1.003,
                          .residual_m = 0.0004,
                          .sigma_m = 0.0002,
                          .sigma_rad = 0.0015,
                          .border_m = robot == 0 ? std::optional(-0.25) : std::nullopt,
                          .too_close = robot == 1});
  }
  // The second robot was killed before its end, and lost a cycle.
  for (std::int64_t robot = 0; robot < kRobots; ++robot) {
    const bool is_whole = robot == 0;
    run.logs.push_back({.robot = robot,
                        .file = fmt::format("run{:02}.rvr{}.log.csv", seed, robot + 1),
                        .machine_digest = "0123456789abcdef",
                        .host = fmt::format("pi{}", robot + 1),
                        .program = "swarmsmith-robot 0.1.0",
                        .scheduling = "SCHED_FIFO 20",
                        .clock_offset_s = is_whole ? std::optional(0.0031) : std::nullopt,
                        .state = is_whole ? "ended" : "",
                        .verdict = is_whole ? "VALID" : "",
                        .stepped = is_whole ? cycles : cycles - 2,
                        .held = 0,
                        .skipped = is_whole ? 0 : 1,
                        .latency_s = is_whole ? std::optional(0.061) : std::nullopt,
                        .latency_error_s = is_whole ? std::optional(0.0004) : std::nullopt,
                        .agreement = is_whole ? std::optional(0.97) : std::nullopt,
                        .latency_reason = is_whole ? "" : "its commands did not move it",
                        .head = "format = 1\nkind = \"robot log\"\n"});
  }
  for (std::int64_t cycle = 1; cycle <= cycles; ++cycle) {
    for (std::int64_t robot = 0; robot < kRobots; ++robot) {
      if (robot == 1 && (cycle == 2 || cycle == cycles)) continue;
      const double time = 0.1 * static_cast<double>(cycle - 1) + 1.0 / 3000;
      run.log_cycles.push_back({.cycle = cycle,
                                .robot = robot,
                                .time_s = time,
                                .clock_s = 5000 + time,
                                .late_ms = 1.0 / 3,
                                .act = cycle == 4 ? "hold" : "step",
                                .state = cycle % 2,
                                .left_mps = cycle == 4 ? 0 : 0.3,
                                .right_mps = cycle == 4 ? 0 : -0.3,
                                .ages_ms = {12.5, 80, std::nullopt, std::nullopt},
                                .drawn = 3 * cycle,
                                .event = cycle == 4 ? "proximity is silent" : ""});
    }
  }
  run.patches = {{.x = 0.3, .y = -0.4, .width_m = 0.3, .height_m = 0.3, .color = "green"},
                 {.x = -0.3, .y = 0, .radius_m = 0.2, .color = "#102030"}};
  run.issues = {
      {.code = "W_UNKNOWN_TAGS", .text = "tag 77 is nobody's", .robot = "", .of_observing = true},
      {.code = "W_OUTLIERS", .text = "dropped", .robot = "rvr1", .from_s = 0.4, .to_s = 0.5}};
  run.checks = {{.name = "film covers the run",
                 .outcome = "passed",
                 .value = 1.0 / 3,
                 .limit = 0.5,
                 .unit = "s",
                 .catches = "an end that no camera filmed"},
                {.name = "scale of the tag",
                 .subject = "rvr1",
                 .outcome = "warned",
                 .value = 2,
                 .limit = 1,
                 .unit = "%",
                 .catches = "a wrong height"},
                {.name = "motion as commanded",
                 .subject = "rvr2",
                 .outcome = "not run",
                 .catches = "logs that were swapped",
                 .reason = "its commands did not move it"}};
  run.score = {.score = static_cast<double>(seed) + 0.25,
               .verdict = "VALID",
               .biased = false,
               .reasons = "[]",
               .report = R"({"frames":63})",
               .program = "swarmsmith-track 0.1.0"};
  return run;
}

}  // namespace swarmsmith
