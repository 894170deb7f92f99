#include "tracking/app/commands.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "tracking/video/frame_source.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kPrintTagsDetails = R"(Example:
  swarmsmith track print tags --ids 1-3,100-105 --edge 0.10 -o tags.pdf

Print at 100 % (not "fit to page"), measure the ruler on each page, and the black edge of a
tag: write what you measure into the arena file. An .svg of several pages is one file per page.)";
constexpr std::string_view kPrintBoardDetails = R"(Examples:
  swarmsmith track print board charuco:11x8:0.023:0.017:5x5_100 -o board.pdf
  swarmsmith track print board chessboard:10x7:0.025 --paper A3 -o board.pdf

A ChArUco board counts its squares, a chessboard its inner corners; edges are in metres.
Glue it on something flat, measure the squares, and give the measured board to
`swarmsmith track calibrate camera`.)";
constexpr std::string_view kTrackReportDetails = R"(Examples:
  swarmsmith track report r7 --store lab.db -o r7.html
  swarmsmith track report r7 --store lab.db --json

Verdict and reasons, the run from above, how each robot was measured, cameras, floor tags,
files. --json prints the same numbers as one object (docs/tracking.md lists its keys).)";
constexpr std::string_view kTrackProfileDetails = R"(Examples:
  swarmsmith track profile r1 r2 r3 --store lab.db -o lab.toml
  swarmsmith track profile run07.toml --arena arena.toml -o lab.toml

Latency, slip of the treads, missed neighbours and control periods, from the robots' logs beside
the film, with 95 % intervals and the spread between robots. What the runs do not show stays as
in the base profile, and the file says why. INVALID runs are left out. Design with it:
[simulator] profile = "lab.toml".)";
constexpr std::string_view kPrintSurveyDetails = R"(Example:
  swarmsmith track print survey --ids 100-105 --edge 0.10 -o survey.pdf

A form to write down where the floor tags lie. It proposes their places, and has the distances
between the arena's corners to check them.)";

constexpr std::string_view kDetectDetails = R"(Examples:
  swarmsmith track detect run07.mp4
  swarmsmith track detect pictures/ --csv tags.csv
  swarmsmith track detect run07.bag:/ceiling/image_raw

Lists the tags: in how many frames, how large (the shortest side) and how clear (the detector's
margin) they are, whether bits had to be corrected and whether a tag appears twice. Needs no
arena file and no calibration: use it to try light, tags and camera.)";

constexpr std::string_view kScoreDetails = R"(Examples:
  swarmsmith track score run07.mp4 --arena arena.toml --run run07.toml --into demo.db
  swarmsmith track score run07.mp4 --arena arena.toml --design d3 --sync-hidden 99 \
      --into demo.db

Without a store the run is scored and not kept. The same video with the same start is the same
run: it is stored once. You may omit `score` if the first word is a file. Exit code 6: the run
is INVALID, and is stored as INVALID.)";
constexpr std::string_view kCalibrateCameraDetails = R"(Examples:
  swarmsmith track calibrate camera board/ --board charuco:11x8:0.03:0.022:5x5_100 \
    --arena arena.toml
  swarmsmith track calibrate camera board.mp4 --board chessboard:10x7:0.025

A ChArUco board counts its squares, a chessboard its inner corners; measure the squares on
paper. Show the flat board in 15 views or more: in all nine thirds of the picture and into
its corners, tilted by up to 40 degrees, filling a sixth to a half of the picture. Lock focus
and zoom before, and never touch them again. From a video it picks sharp views that differ.

Refused with E_CALIB_QUALITY, and no file written: under 10 views, RMS over 1/2000 of the
focal length, corners' hull under 30 % of the frame, fx and fy over 2 % apart, principal point over 10 % off the
middle, a lens model that folds.)";
constexpr std::string_view kCalibrateArenaDetails = R"(Examples:
  swarmsmith track calibrate arena empty.mp4 --arena arena.toml
  swarmsmith track calibrate arena --again --arena arena.toml

Film the empty arena for some seconds with the floor tags of the arena file on the floor.
--again uses the corners of the last calibration: after you corrected the survey in the arena
file, or calibrated the camera again with the same focus.

Refused, and no file written: E_REF_TAGS (fewer than 4 tags seen, in one line, or over less
than half of the arena that the camera sees); E_EXTRINSICS (RMS over 0.3 px, a tag over 5 mm
off where the others put it, the camera not within `height`).)";
constexpr std::string_view kCalibrateRobotDetails = R"(Example:
  swarmsmith track calibrate robot rvr1 --spin spin.mp4 --straight straight.mp4 \
    --arena arena.toml

Film the robot turning on the spot for two turns or more, in about 8 s, and driving straight
on for half a metre or more (only for headings; scores need the spin alone). The spin shows
the centre of rotation, which becomes the robot's origin: the centre of its tread base.

Refused with E_SPIN_QUALITY, and no file written: under 60 samples or 300 degrees, RMS over
2 mm, offset not known to 0.5 mm, tag outside of the robot's body (over 135 mm from its
centre; other robots: --kind), centre creeping over 5 mm/s.)";

constexpr std::string_view kOverlayDetails = R"(Examples:
  swarmsmith track overlay r7 --store demo.db -o r7.mp4
  swarmsmith track overlay run07.mp4 --arena arena.toml --run run07.toml -o run07-overlay.mp4
  swarmsmith track overlay r7 --store demo.db --at 119.5 -o end.png

Tags are drawn where they were found, robots' bodies at the height of their tags. The white
cross is a robot's centre on the floor, which the score uses. A robot that is not filled was
between measurements. Visited tiles show how long ago.)";
constexpr std::string_view kLiveDetails = R"(Examples:
  swarmsmith track live --arena arena.toml --camera camera:0 --mission aggregation
  swarmsmith track live --arena arena.toml --camera run07.mp4 --port 8090

Open the printed address in a browser of this host; from another one through
`ssh -L 8080:127.0.0.1:8080 HOST`. There is no window: a camera's computer often has no
screen. A video file plays at its own speed. Frames that come too fast are not shown, but
counted; a recording has them all. Ctrl-C ends it.)";

constexpr std::array kCommands = {
    ProgramCommand{"init", "Write an arena.toml and a run.toml to begin with", "",
                   declare_track_init},
    ProgramCommand{"check", "List what an arena has, what is missing and what comes next", "",
                   declare_track_check},
    ProgramCommand{"score", "Score a filmed run and keep it in a store", kScoreDetails,
                   declare_track_score},
    ProgramCommand{"rescore", "Score stored runs again, with corrected files", "",
                   declare_track_rescore},
    ProgramCommand{"override", "Override a run's verdict", "", declare_track_override},
    ProgramCommand{"detect", "List the tags in a video or in pictures", kDetectDetails,
                   declare_detect},
    ProgramCommand{"calibrate camera", "Find a camera's lens from pictures of a board",
                   kCalibrateCameraDetails, declare_calibrate_camera},
    ProgramCommand{"calibrate arena", "Find where a camera hangs from the floor tags",
                   kCalibrateArenaDetails, declare_calibrate_arena},
    ProgramCommand{"calibrate robot", "Find where a robot's tag sits on it from a spin",
                   kCalibrateRobotDetails, declare_calibrate_robot},
    ProgramCommand{"print tags", "Make tags to print and cut out, in true scale", kPrintTagsDetails,
                   declare_print_tags},
    ProgramCommand{"print board", "Make a board to calibrate a camera, in true scale",
                   kPrintBoardDetails, declare_print_board},
    ProgramCommand{"print survey", "Make a form for the places of the floor tags",
                   kPrintSurveyDetails, declare_print_survey},
    ProgramCommand{"report", "Write the quality report of a stored run, a page of HTML",
                   kTrackReportDetails, declare_track_report},
    ProgramCommand{"profile", "Make a simulator profile of your robots from scored runs",
                   kTrackProfileDetails, declare_track_profile},
    ProgramCommand{
        "record", "Record a camera with the time of each frame",
        R"(A camera is `camera:0`, `camera:0:1920x1080@30`, an address (`rtsp://...`) or any
other word that OpenCV opens (`opencv:WORD`). FILE.times.csv, beside FILE.mkv, has the time
of each frame in seconds from the first one. Ctrl-C ends a recording. Whatever happens, the
recording stays readable, except the last half second.

  swarmsmith track record camera:0:1920x1080@30 run07.mkv --seconds 130)",
        declare_record},
    ProgramCommand{"overlay", "Draw the tracking of a run over its video", kOverlayDetails,
                   declare_overlay},
    ProgramCommand{"live", "Watch a camera: show the robots and tags that it sees", kLiveDetails,
                   declare_live},
    ProgramCommand{"version", "Print the versions of the program and its libraries", "",
                   declare_track_version},
};

}  // namespace

std::span<const ProgramCommand> track_commands() {
  return kCommands;
}

bool means_a_recording(const std::string& word) {
  const bool is_command = std::ranges::any_of(kCommands, [&](const ProgramCommand& command) {
    return command.name == word || command.name.starts_with(word + " ");
  });
  std::error_code trouble;
  return !is_command && !word.starts_with('-') &&
         std::filesystem::exists(file_of_source(word), trouble);
}

ExitCode exit_code_of_tracking(const Error& error) {
  return error.kind == ErrorKind::BadInput || error.kind == ErrorKind::NotFound ? ExitCode::Usage
                                                                                : ExitCode::Failed;
}

}  // namespace swarmsmith
