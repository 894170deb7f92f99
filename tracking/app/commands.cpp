#include "tracking/app/commands.h"

#include <array>

namespace swarmsmith::cli {
namespace {

constexpr std::string_view kPrintTagsDetails =
    "Example:\n"
    "  swarmsmith track print tags --ids 1-3,100-105 --edge 0.10 -o tags.pdf\n"
    "\n"
    "Print at 100 % (not \"fit to page\"), measure the ruler on each page, and the black edge of "
    "a\n"
    "tag: what you measure goes into the arena file. Of several pages an .svg is a file a page.";
constexpr std::string_view kPrintBoardDetails =
    "Examples:\n"
    "  swarmsmith track print board charuco:11x8:0.023:0.017:5x5_100 -o board.pdf\n"
    "  swarmsmith track print board chessboard:10x7:0.025 --paper A3 -o board.pdf\n"
    "\n"
    "A ChArUco board counts its squares, a chessboard its inner corners; edges are in metres.\n"
    "Glue it on something flat, measure the squares, and give the measured board to\n"
    "`swarmsmith track calibrate camera`.";
constexpr std::string_view kPrintSurveyDetails =
    "Example:\n"
    "  swarmsmith track print survey --ids 100-105 --edge 0.10 -o survey.pdf\n"
    "\n"
    "A form to write down where the floor tags lie, with places to put them and distances of the\n"
    "arena's corners to check.";

constexpr std::array kCommands = {
    Command{"init", "Write an arena.toml and a run.toml to begin with", "", declare_track_init},
    Command{"check", "Say what an arena has, what is missing and what comes next", "",
            declare_track_check},
    Command{"print tags", "Tags to print and cut out, in true scale", kPrintTagsDetails,
            declare_print_tags},
    Command{"print board", "A board to calibrate a camera with, in true scale", kPrintBoardDetails,
            declare_print_board},
    Command{"print survey", "A form to fill in with the places of the floor tags",
            kPrintSurveyDetails, declare_print_survey},
    Command{"version", "Print the versions of program and libraries", "", declare_track_version},
};

}  // namespace

std::span<const Command> track_commands() {
  return kCommands;
}

ExitCode exit_code_of_tracking(const Error& error) {
  return error.kind == ErrorKind::BadInput || error.kind == ErrorKind::NotFound ? ExitCode::Usage
                                                                                : ExitCode::Failed;
}

}  // namespace swarmsmith::cli
