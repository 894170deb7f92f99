#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "tracking/profile/pooled.h"
#include "tracking/robots/reality.h"

namespace swarmsmith {

/// A robot in a scored run.
struct MeasuredRobot {
  std::string run;  ///< name of the run
  std::string robot;
  Reality reality;
};

/// A measured number of the profile.
struct LabFigure {
  std::string name;  ///< "latency"
  std::optional<Pooled> value;
  std::string unit;    ///< "ms", "%"
  std::string basis;   ///< "of 3 robots in 4 runs (1 without a result)"
  std::string reason;  ///< why the base's value was kept, a sentence
};

/// A measured profile; values that the runs do not show are from the base.
struct LabProfile {
  std::string text;  ///< text of the profile file
  std::vector<LabFigure> figures;

  bool is_measured() const;
};

/// The runs on which a profile is based, and its origin.
struct LabSource {
  std::vector<MeasuredRobot> robots;
  std::string base = "rvr";  ///< a built-in profile
  std::string program;       ///< name of the program, with its version
};

LabProfile lab_profile(const LabSource& source);

}  // namespace swarmsmith
