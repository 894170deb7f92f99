#pragma once

#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analysis/arena/reading_columns.h"
#include "base/expected.h"
#include "console/options.h"
#include "sim/control/controller.h"
#include "sim/engine/simulate.h"

namespace swarmsmith::cli {

/// Options of commands that can record one run: as tables and as a picture (docs/trajectories.md).
struct RecordingArguments {
  std::string csv;
  std::string objects_csv;
  std::string svg;
  std::string readings;
  std::string at;
  std::string from;
  std::string to;
  std::string width;

  void declare(Options& options);
  /// Whether anything is recorded.
  bool any() const { return !csv.empty() || !objects_csv.empty() || !svg.empty(); }
  /// BadInput if two outputs are one file.
  Expected<void> check_files() const;
  /// Whether something is written to standard output.
  bool takes_standard_output() const { return csv == "-" || objects_csv == "-" || svg == "-"; }
};

/// The exit code after an error of `Recording`.
ExitCode exit_code_of_recording(const Error& error);

/// Records a run while it is simulated.
class Recording {
 public:
  /// Opens the files in the arguments. `machine` and `mission` must outlive the recording. Errors:
  /// BadInput, with the option as place, for arguments that make no sense for the mission;
  /// Unavailable for a file that cannot be written.
  static Expected<Recording> start(const RecordingArguments& arguments, const Mission& mission,
                                   const Controller& controller, Output& output);

  /// The recorder for `simulate`. The recording must not be moved while the recorder is used.
  /// Records nothing if no output was asked for.
  Recorder recorder();

  /// Draws the picture and closes the files. `details` identify the run: candidate, seed, score.
  /// Unavailable, with the file as place, if something could not be written.
  Expected<void> finish(const std::vector<std::string>& details, const Instance& instance);

 private:
  /// A file, or standard output.
  struct Sink {
    std::string name;
    std::unique_ptr<std::ofstream> file;  ///< null: standard output
    std::ostream* stream = nullptr;       ///< null: not wanted

    Expected<void> close() const;
  };

  Recording(const Mission& mission, const Controller& controller)
      : mission_(&mission), controller_(&controller) {}

  static Expected<Sink> open(const std::string& name, Output& output);
  Expected<void> read_span(const RecordingArguments& arguments);
  void write_headers();
  void observe(const Snapshot& snapshot);
  void write_rows(const Snapshot& snapshot);
  std::string behaviour_of(int state) const;
  std::string picture(const std::vector<std::string>& details, const Instance& instance) const;

  const Mission* mission_;
  const Controller* controller_;
  Sink csv_;
  Sink objects_csv_;
  Sink svg_;
  Sensors sensors_;
  std::optional<ReadingColumns> columns_;
  int first_ = 0;  ///< first instant of the picture
  int last_ = 0;
  double width_mm_ = 84;
  std::vector<std::vector<Pose>> robots_;  ///< poses in the picture's time span
  std::vector<std::vector<Pose>> objects_;
  std::vector<int> states_;  ///< at the last instant of the picture
};

}  // namespace swarmsmith::cli
