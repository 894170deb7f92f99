#include <array>
#include <cctype>
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "tests/support/checks.h"
#include "tests/support/not_empty.h"
#include "tracking/rig/rig_file.h"

namespace swarmsmith {
namespace {

/// A file with all keys that its kind may have, and how it is read.
struct KindOfFile {
  std::string name;
  std::string text;
  std::function<std::vector<Error>(const std::string& text)> errors_of;
  std::set<std::string> may_be_negative;
};

template <class Read>
std::vector<Error> errors_of(const OrComplaints<Read>& read) {
  return read ? std::vector<Error>() : read.error();
}

constexpr char kArena[] = R"(format = 1
survey_error = 0.002
tilt_error = 0.5
[[camera]]
name = "ceiling"
model = "ceiling.camera.toml"
place = "ceiling.place.toml"
exposure = "8 ms"
readout = "16 ms"
height = [1.5, 4]
time_error = "5 ms"
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
height_error = 0.001
[[robot.more_tags]]
tag = 11
edge = 0.08
height = 0.15
height_error = 0.002
)";

constexpr char kLog[] = R"(format = 1
start = "12.4 s"
sync = { tag = 99, when = "hidden" }
[[video]]
file = "run07.mp4"
ahead = "0.5 s"
length = "130 s"
[[point]]
robot = "rvr2"
time = "43.2 s"
u = 812
v = 455
heading = 30
who = "A. Person"
[[patch]]
x = 0.3
y = 0.1
color = "green"
)";

CameraCalibration camera(Lens lens) {
  CameraCalibration made;
  made.model = {{1920, 1080}, lens, 1015.1, 1015.3, 959.7, 540.1, {-0.02, 0.01, 0.001, 0.001, 0}};
  if (lens == Lens::Pinhole) made.model.distortion[4] = 0.01;
  made.rms_px = 0.061;
  made.worst_view_px = 0.09;
  made.views = 17;
  made.views_dropped = 1;
  made.coverage = 0.93;
  made.hull = {{10.5, 20}, {1900.1, 30}, {1880, 1050}, {20, 1060.4}};
  made.focal_sigma_px = 0.12;
  made.board = "charuco";
  made.made = "2026";
  return made;
}

PlaceCalibration place() {
  PlaceCalibration made;
  made.place = {{1, 0, 0, 0, -1, 0, 0, 0, -1}, {0.1, -0.2, 2.7}};
  made.rms_px = 0.05;
  made.worst_left_out_m = 0.0011;
  made.worst_tag = 102;
  made.coverage = 0.7;
  for (int i = 0; i < 4; ++i) {
    made.tags.push_back({{100 + i, {0.3, 0.2, -0.7}, 0.1},
                         {{{1.5, 2.5}, {3.5, 4.25}, {5.5, 6.5}, {7.5, 8.125}}},
                         0.04,
                         0.001});
  }
  made.camera_sha256 = "abc";
  made.made = "2026";
  return made;
}

OffsetCalibration offset() {
  OffsetCalibration made;
  made.robot = "rvr1";
  made.tag = 1;
  made.edge_m = 0.1;
  made.height_m = 0.2;
  made.offset = {0.061, -0.0379, 0.142};
  made.has_yaw = true;
  made.rms_m = 0.0003;
  made.sigma_x_m = 0.00003;
  made.sigma_y_m = 0.00004;
  made.drift_m_s = 0.001;
  made.turned_rad = 12.5;
  made.samples = 120;
  made.made = "2026";
  OffsetCalibration more = made;
  more.tag = 11;
  made.more_tags = {more};
  return made;
}

std::vector<KindOfFile> kinds_of_file() {
  const FindCalibration none = [](CalibrationKind, const std::string&,
                                  const std::string&) -> Expected<std::optional<std::string>> {
    return std::nullopt;
  };
  const auto read_camera = [](const std::string& text) {
    return errors_of(parse_camera_calibration(text, "f"));
  };
  const std::set<std::string> of_lens = {"distortion", "hull", "cx", "cy"};
  return {{"arena",
           kArena,
           [none](const std::string& text) { return errors_of(parse_rig(text, "f", none)); },
           {"x", "y", "angle"}},
          {"run log",
           kLog,
           [](const std::string& text) { return errors_of(parse_run_log(text, "f")); },
           {"start", "ahead", "time", "u", "v", "heading", "x", "y"}},
          {"pinhole", calibration_text(camera(Lens::Pinhole)), read_camera, of_lens},
          {"fisheye", calibration_text(camera(Lens::Fisheye)), read_camera, of_lens},
          {"place",
           calibration_text(place()),
           [](const std::string& text) { return errors_of(parse_place_calibration(text, "f")); },
           {"rotation", "translation", "x", "y", "heading_rad", "corners"}},
          {"offset",
           calibration_text(offset()),
           [](const std::string& text) { return errors_of(parse_offset_calibration(text, "f")); },
           {"x", "y", "yaw_rad"}}};
}

/// A number of a file: its key, its line, and where it stands.
struct Place {
  std::string key;
  int line = 0;
  std::size_t at = 0;
  std::size_t length = 0;
};

/// All numbers of a file: values, items of lists, times in quotes, and members of tables in a line.
std::vector<Place> numbers_of(const std::string& text) {
  std::vector<Place> places;
  int line = 0;
  for (std::size_t from = 0; from < text.size(); ++line) {
    const std::size_t end = std::min(text.find('\n', from), text.size());
    const std::size_t comment = std::min(text.find('#', from), end);
    std::string key;
    for (std::size_t at = from; at < comment;) {
      const char c = text[at];
      const bool begins = std::isdigit(c) != 0 || (c == '-' && std::isdigit(text[at + 1]) != 0);
      if (std::isalpha(c) != 0) {
        const std::size_t begin = at;
        while (at < comment && (std::isalnum(text[at]) != 0 || text[at] == '_'))
          ++at;
        const std::size_t next = text.find_first_not_of(' ', at);
        if (next < comment && text[next] == '=') key = text.substr(begin, at - begin);
      } else if (begins && !key.empty() && key != "format") {
        const std::size_t begin = at++;
        while (at < comment && (std::isdigit(text[at]) != 0 || text[at] == '.' || text[at] == 'e' ||
                                (text[at] == '-' && text[at - 1] == 'e')))
          ++at;
        places.push_back({key, line + 1, begin, at - begin});
      } else {
        ++at;
      }
    }
    from = end + 1;
  }
  const std::set<std::string> texts = {"name", "model", "place", "file",   "who",  "robot",
                                       "made", "board", "color", "offset", "lens", "camera_sha256"};
  std::erase_if(places, [&](const Place& place) { return texts.contains(place.key); });
  return places;
}

/// A key may be of two tables: `height` of a camera and of a robot.
TEST(BadNumbersTest, EachNumberOfEachFileHasASensibleRangeAndIsNamedByItsLine) {
  for (const KindOfFile& kind : not_empty(kinds_of_file())) {
    const auto sound = kind.errors_of(kind.text);
    ASSERT_THAT(sound, IsEmpty()) << kind.name << ": " << to_string(sound.front());
    for (const Place& place : not_empty(numbers_of(kind.text))) {
      for (const std::string bad :
           {"nan", "inf", "-inf", "-1", "-1e7", "1e7", "10000000", "1e300"}) {
        if (bad == "-1" && kind.may_be_negative.contains(place.key)) continue;
        // Clocks may count from 1970, and TOML's numbers of a text have no exponent.
        const bool is_clock =
            kind.name == "run log" && (place.key == "start" || place.key == "time");
        if (is_clock && bad.find('7') != std::string::npos) continue;
        if (is_clock && bad == "10000000") continue;
        std::string text = kind.text;
        text.replace(place.at, place.length, bad);
        const auto errors = kind.errors_of(text);
        const std::string where = "f:" + std::to_string(place.line) + ":";
        const bool is_named = std::ranges::any_of(
            errors, [&](const Error& error) { return to_string(error).starts_with(where); });
        EXPECT_TRUE(is_named) << kind.name << ", `" << place.key << "` in line " << place.line
                              << " is " << bad << ": "
                              << (errors.empty() ? "taken" : to_string(errors.front()));
      }
    }
  }
}

}  // namespace
}  // namespace swarmsmith
