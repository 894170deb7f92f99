#include "cli/replay/recording.h"

#include <array>
#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "analysis/arena/arena_picture.h"
#include "analysis/drawing/svg.h"
#include "base/output_file.h"
#include "sim/control/module.h"
#include "sim/mission/trajectory_csv.h"

namespace swarmsmith::cli {
namespace {

constexpr int kInstantsPerSecond = 10;

/// Reads 12, 12.5, 12.5s or "12.5 s" as the nearest instant of the mission.
Expected<int> instant_of(std::string_view text, const char* option, const Mission& mission) {
  const std::string given(text);
  double seconds = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), seconds);
  text.remove_prefix(static_cast<std::size_t>(stop - text.data()));
  const bool has_unit = text.empty() || text == "s" || text == " s";
  const double longest = static_cast<double>(mission.cycles) / kInstantsPerSecond;
  if (error == std::errc() && has_unit && seconds >= 0 && seconds <= longest) {
    return static_cast<int>(std::lround(seconds * kInstantsPerSecond));
  }
  std::string most;
  append_number(most, longest);
  return bad_input(
      "must be seconds from 0 to " + most + ", the mission's end, not \"" + given + "\"", option);
}

std::string seconds_text(int instant) {
  std::string text;
  append_number(text, static_cast<double>(instant) / kInstantsPerSecond);
  return text + " s";
}

}  // namespace

void RecordingArguments::declare(Options& options) {
  options.text("--csv FILE", csv,
               "Write poses, commands and states to this file (- for standard output)");
  options.text(
      "--readings SENSORS", readings,
      "Sensors for the table: all (except lidar), or a list such as ground_color,proximity");
  options.text("--objects-csv FILE", objects_csv,
               "Write the poses of movable objects to this file");
  options.text("--svg FILE", svg, "Draw the run into this file (- for standard output)");
  options.text("--at SECONDS", at, "Draw one instant, in seconds (default: the whole run)");
  options.text("--from SECONDS", from, "Draw from this time on, in seconds (default: the start)");
  options.text("--to SECONDS", to, "Draw up to this time, in seconds (default: the end)");
  options.text("--width WIDTH", width,
               "Width of the picture, such as 84mm or 3.3in (default 84mm)");
}

Expected<void> RecordingArguments::check_files() const {
  return each_its_own_file({{"--csv", csv}, {"--objects-csv", objects_csv}, {"--svg", svg}});
}

ExitCode exit_code_of_recording(const Error& error) {
  return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Failed;
}

Expected<void> Recording::Sink::close() const {
  if (stream == nullptr) return {};
  stream->flush();
  const bool good = stream->good();
  if (file) file->close();
  if (good && (!file || file->good())) return {};
  return Unexpected(cannot_write(name == "-" ? "standard output" : name));
}

Expected<Recording::Sink> Recording::open(const std::string& name, Output& output) {
  Sink sink{.name = name};
  if (name.empty()) return sink;
  if (name == "-") {
    sink.stream = &output.out;
    return sink;
  }
  sink.file = std::make_unique<std::ofstream>(name, std::ios::binary);
  if (!*sink.file) return Unexpected(cannot_write(name));
  sink.stream = sink.file.get();
  return sink;
}

Expected<void> Recording::read_span(const RecordingArguments& arguments) {
  last_ = mission_->cycles;
  const bool spans = !arguments.from.empty() || !arguments.to.empty();
  if (!arguments.at.empty() && spans) {
    return bad_input("draws one instant, --from and --to draw a span: give one of them", "--at");
  }
  const std::array<std::pair<const std::string*, const char*>, 3> texts = {
      {{&arguments.at, "--at"}, {&arguments.from, "--from"}, {&arguments.to, "--to"}}};
  std::array<std::optional<int>, 3> instants;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    if (texts[i].first->empty()) continue;
    const auto instant = instant_of(*texts[i].first, texts[i].second, *mission_);
    if (!instant) return Unexpected(instant.error());
    instants[i] = *instant;
  }
  first_ = instants[0].value_or(instants[1].value_or(first_));
  last_ = instants[0].value_or(instants[2].value_or(last_));
  if (first_ > last_) return bad_input("the span ends before it begins", "--to");
  return {};
}

Expected<Recording> Recording::start(const RecordingArguments& arguments, const Mission& mission,
                                     const Controller& controller, Output& output) {
  const int to_standard_output = (arguments.csv == "-" ? 1 : 0) +
                                 (arguments.objects_csv == "-" ? 1 : 0) +
                                 (arguments.svg == "-" ? 1 : 0) + (output.json ? 1 : 0);
  if (arguments.takes_standard_output() && to_standard_output > 1) {
    return bad_input("only one of --csv -, --objects-csv -, --svg - and --json can write to it",
                     "standard output");
  }
  if (auto own = arguments.check_files(); !own) return Unexpected(own.error());
  const bool draws_nothing =
      arguments.svg.empty() && (!arguments.at.empty() || !arguments.from.empty() ||
                                !arguments.to.empty() || !arguments.width.empty());
  if (draws_nothing) {
    return bad_input("--at, --from, --to and --width are about a picture: add --svg FILE", "--svg");
  }
  Recording recording(mission, controller);
  if (auto read = recording.read_span(arguments); !read) return Unexpected(read.error());
  if (!arguments.width.empty()) {
    recording.width_mm_ = millimetres_from_text(arguments.width);
    if (recording.width_mm_ < kLeastPictureWidth_mm || recording.width_mm_ > kMostPictureWidth_mm) {
      return bad_input(
          "a picture is 40mm to 1000mm wide (also cm, in), not \"" + arguments.width + "\"",
          "--width");
    }
  }
  if (!arguments.readings.empty()) {
    if (arguments.csv.empty()) return bad_input("needs --csv FILE", "--readings");
    const auto sensors = sensors_from_names(arguments.readings);
    if (!sensors) return bad_input(sensors.error().message, "--readings");
    recording.sensors_ = *sensors;
  }
  recording.columns_.emplace(recording.sensors_, mission.robots, mission.robot);
  // Files are opened last, so that the errors above leave no files behind; and none is opened
  // before all are allowed, since opening empties it.
  for (const auto& [name, kind] : {std::pair(&arguments.csv, FileKind::Table),
                                   std::pair(&arguments.objects_csv, FileKind::Table),
                                   std::pair(&arguments.svg, FileKind::Svg)}) {
    if (name->empty() || *name == "-") continue;
    if (const auto place = output_place(*name, kind); !place) return Unexpected(place.error());
  }
  for (const auto& [name, sink] : {std::pair(&arguments.csv, &recording.csv_),
                                   std::pair(&arguments.objects_csv, &recording.objects_csv_),
                                   std::pair(&arguments.svg, &recording.svg_)}) {
    auto opened = open(*name, output);
    if (!opened) return Unexpected(opened.error());
    *sink = std::move(*opened);
  }
  recording.write_headers();
  return recording;
}

void Recording::write_headers() {
  if (csv_.stream != nullptr) {
    std::string line = std::string(kTrajectoryColumns) + ",cmd_left,cmd_right,state,behaviour,leds";
    for (const std::string& name : columns_->names())
      line += "," + name;
    *csv_.stream << line << kCsvLineEnd;
  }
  if (objects_csv_.stream != nullptr) {
    *objects_csv_.stream << "cycle,time_s,object,x,y,theta" << kCsvLineEnd;
  }
}

Recorder Recording::recorder() {
  const bool asked =
      csv_.stream != nullptr || objects_csv_.stream != nullptr || svg_.stream != nullptr;
  if (!asked) return {};
  return {[this](const Snapshot& snapshot) { observe(snapshot); }, sensors_};
}

std::string Recording::behaviour_of(int state) const {
  return std::string(acting_in(*controller_, state));
}

void Recording::observe(const Snapshot& snapshot) {
  write_rows(snapshot);
  if (svg_.stream == nullptr || snapshot.cycle < first_ || snapshot.cycle > last_) return;
  robots_.resize(snapshot.robots.size());
  objects_.resize(snapshot.objects.size());
  states_.clear();
  for (std::size_t i = 0; i < robots_.size(); ++i) {
    robots_[i].push_back(snapshot.robots[i].pose);
    states_.push_back(snapshot.robots[i].state);
  }
  for (std::size_t i = 0; i < objects_.size(); ++i)
    objects_[i].push_back(snapshot.objects[i]);
}

void Recording::write_rows(const Snapshot& snapshot) {
  std::string text;
  if (csv_.stream != nullptr) {
    int number = 0;
    for (const RobotRecord& robot : snapshot.robots) {
      append_pose_cells(text, snapshot.cycle, number++, robot.pose);
      for (const double speed : {robot.command.left_mps, robot.command.right_mps}) {
        text += ',';
        append_number(text, speed);
      }
      text += "," + std::to_string(robot.state) + "," + behaviour_of(robot.state) + "," +
              leds_text(robot.command.leds);
      columns_->append_cells(text, robot.readings);
      text += kCsvLineEnd;
    }
    *csv_.stream << text;
  }
  if (objects_csv_.stream == nullptr) return;
  text.clear();
  int number = 0;
  for (const Pose& pose : snapshot.objects) {
    append_pose_cells(text, snapshot.cycle, number++, pose);
    text += kCsvLineEnd;
  }
  *objects_csv_.stream << text;
}

std::string Recording::picture(const std::vector<std::string>& details,
                               const Instance& instance) const {
  ArenaPicture picture{.title = mission_->name,
                       .details = details,
                       .arena = arena_of(*mission_, instance),
                       .body = mission_->robot.body.outline,
                       .robots = {},
                       .objects = objects_,
                       .width_mm = width_mm_};
  picture.details.push_back(first_ == last_
                                ? "at " + seconds_text(last_)
                                : seconds_text(first_) + " (hollow) to " + seconds_text(last_));
  for (std::size_t i = 0; i < robots_.size(); ++i)
    picture.robots.push_back({robots_[i], behaviour_of(states_[i])});
  return draw(picture);
}

Expected<void> Recording::finish(const std::vector<std::string>& details,
                                 const Instance& instance) {
  if (svg_.stream != nullptr) *svg_.stream << picture(details, instance);
  for (const Sink* sink : {&csv_, &objects_csv_, &svg_}) {
    if (auto closed = sink->close(); !closed) return closed;
  }
  return {};
}

}  // namespace swarmsmith::cli
