#include <fmt/format.h>

#include <memory>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "tracking/app/commands.h"
#include "tracking/app/refusal.h"
#include "tracking/rig/calibration_limits.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// The state of one calibration of a rig, for people and for scripts.
struct Part {
  std::string file;
  bool is_there = false;
  std::string made;
  std::string sha256;
  std::string text;  ///< its quality
};

Part part_of(const Rig& rig, const std::string& file) {
  Part part{.file = file};
  const auto found = rig.files.find(file);
  if (found == rig.files.end()) return part;
  part.is_there = true;
  part.made = found->second.made;
  part.sha256 = found->second.sha256;
  return part;
}

Part lens_of(const Rig& rig, const CameraSetup& camera) {
  Part part = part_of(rig, camera.model_file);
  if (!part.is_there) return part;
  const CameraCalibration& lens = rig.models.at(camera.model_file);
  part.text =
      fmt::format("{} x {}, {} views, RMS {:.3f} px, {:.0f} % of the frame", lens.model.size.width,
                  lens.model.size.height, lens.views, lens.rms_px, 100 * lens.coverage);
  return part;
}

Part place_of(const Rig& rig, const CameraSetup& camera) {
  Part part = part_of(rig, camera.place_file);
  if (!part.is_there) return part;
  const PlaceCalibration& place = rig.places.at(camera.place_file);
  part.text = fmt::format("{} floor tags, RMS {:.3f} px, {:.3f} m up, worst tag {} {} off",
                          place.tags.size(), place.rms_px, place.place.centre().z, place.worst_tag,
                          millimetres(place.worst_left_out_m));
  return part;
}

Part offset_part_of(const Rig& rig, const RobotSetup& robot) {
  Part part = part_of(rig, robot.offset_file);
  if (!part.is_there) return part;
  const OffsetCalibration* const own = of_tag(rig.offsets.at(robot.offset_file), robot.tag);
  const OffsetCalibration& offset = own == nullptr ? rig.offsets.at(robot.offset_file) : *own;
  part.text = fmt::format("({}, {}), RMS {}{}", millimetres(offset.offset.x_m),
                          millimetres(offset.offset.y_m), millimetres(offset.rms_m),
                          offset.has_yaw ? "" : ", heading not calibrated");
  return part;
}

/// The names of cameras and robots that lack a calibration.
struct Missing {
  std::vector<std::string> lenses, places, offsets;
};

/// The next step for the user.
std::string next_step(const Missing& missing, const Rig& rig, const std::string& file) {
  const std::string arena = " --arena " + command_word(file);
  if (!missing.lenses.empty()) {
    return "film a printed board in 15 or more positions with camera " + missing.lenses.front() +
           ", then `swarmsmith track calibrate camera`; `swarmsmith track print board` prints one";
  }
  if (!missing.places.empty()) {
    return "film the empty arena with camera " + missing.places.front() +
           ", then `swarmsmith track calibrate arena" + arena + "`";
  }
  if (rig.robots.empty()) return "add a [[robot]] for each robot to " + file;
  if (!missing.offsets.empty()) {
    return "film robot " + missing.offsets.front() +
           " turning on the spot twice or more, then `swarmsmith track calibrate robot" + arena +
           "`";
  }
  return "score a run: `swarmsmith track score RUN.mp4" + arena + " --run run.toml`";
}

std::string line_of(const std::string& what, const Part& part) {
  const std::string head = "  " + what + std::string(8 - what.size(), ' ');
  if (part.file.empty()) return head + "missing: give it a file name\n";
  if (!part.is_there) return head + part.file + ": missing\n";
  return head + part.file + ", made " + part.made + ": " + part.text + "\n";
}

JsonObject part_json(const Part& part) {
  JsonObject object;
  object.add("file", part.file).add("there", part.is_there);
  if (!part.is_there) return object;
  return object.add("made", part.made).add("sha256", part.sha256).add("quality", part.text);
}

/// The existing calibrations, as text and as JSON, and the missing ones.
struct Inventory {
  std::string text;
  std::vector<JsonObject> cameras;
  std::vector<JsonObject> robots;
  Missing missing;
};

Inventory inventory_of(const Rig& rig) {
  Inventory all;
  for (const CameraSetup& camera : rig.cameras) {
    const Part lens = lens_of(rig, camera);
    const Part place = place_of(rig, camera);
    if (!lens.is_there) all.missing.lenses.push_back(camera.name);
    if (!place.is_there) all.missing.places.push_back(camera.name);
    all.text += "camera " + camera.name + "\n" + line_of("lens", lens) + line_of("place", place);
    all.cameras.push_back(JsonObject()
                              .add("name", camera.name)
                              .add("model", part_json(lens))
                              .add("place", part_json(place)));
  }
  for (const RobotSetup& robot : rig.robots) {
    const Part offset = offset_part_of(rig, robot);
    if (!offset.is_there) all.missing.offsets.push_back(robot.name);
    all.text += fmt::format("robot {}: tag {}, edge {}, height {}\n", robot.name, robot.tag,
                            millimetres(robot.edge_m), millimetres(robot.height_m)) +
                line_of("offset", offset);
    JsonObject answer;
    answer.add("name", robot.name).add("tag", robot.tag).add("offset", part_json(offset));
    std::vector<JsonObject> more;
    for (const RobotSetup& tag : robot.more_tags) {
      const Part part = offset_part_of(rig, tag);
      more.push_back(JsonObject().add("tag", tag.tag).add("offset", part_json(part)));
      all.text += fmt::format("  also tag {}, edge {}, height {}\n", tag.tag,
                              millimetres(tag.edge_m), millimetres(tag.height_m)) +
                  line_of("offset", part);
    }
    if (!more.empty()) answer.add("more_tags", more);
    all.robots.push_back(std::move(answer));
  }
  return all;
}

ExitCode run(const std::string& file, Output& output) {
  const auto rig = read_rig(file);
  if (!rig) return fail_all(output, rig.error());
  const Inventory all = inventory_of(*rig);
  std::vector<Error> wrong = misfits(*rig);
  for (const CameraSetup& camera : rig->cameras) {
    for (const Issue& doubt : doubts_of_place(*rig, camera))
      wrong.push_back(error_of(doubt.code, doubt.text, camera.place_file));
  }
  const std::string next =
      wrong.empty() ? next_step(all.missing, *rig, file) : "correct the errors above";
  if (output.json) {
    const auto text_of = [](const Error& error) { return to_string(error); };
    const bool is_ready = wrong.empty() && all.missing.lenses.empty() &&
                          all.missing.places.empty() && all.missing.offsets.empty() &&
                          !rig->robots.empty();
    output.out << JsonObject()
                      .add("file", file)
                      .add("family", rig->family)
                      .add("references", rig->references.size())
                      .add("cameras", all.cameras)
                      .add("robots", all.robots)
                      .add("misfits", json_list(wrong, text_of))
                      .add("ready", is_ready)
                      .add("next", next)
                      .text()
               << "\n";
  } else {
    output.out << file << ": family " << rig->family << ", "
               << counted(rig->references.size(), "floor tag") << "\n"
               << all.text;
  }
  for (const Error& error : wrong)
    print_error(output, error);
  if (!output.json) output.out << "Next: " << next << "\n";
  return wrong.empty() ? ExitCode::Done : exit_code_of_all(wrong);
}

}  // namespace

CommandRun declare_track_check(Options& options) {
  auto file = std::make_shared<std::string>();
  options.text("ARENA FILE", *file, "Arena file", Options::Need::Required);
  return [file](Output& output) { return run(*file, output); };
}

}  // namespace swarmsmith
