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
  std::string run;  ///< its name
  std::string robot;
  Reality reality;
};

/// A number of the profile.
struct LabFigure {
  std::string name;  ///< "latency"
  std::optional<Pooled> value;
  std::string unit;    ///< "ms", "%"
  std::string basis;   ///< "of 3 robots in 4 runs (1 could not tell)"
  std::string reason;  ///< why it was left as the base has it, a sentence
};

/// A profile that was measured: `base` where the runs tell nothing.
struct LabProfile {
  std::string text;  ///< of the file
  std::vector<LabFigure> figures;

  bool is_measured() const;
};

/// The runs that it rests on, and what others need to know of it.
struct LabSource {
  std::vector<MeasuredRobot> robots;
  std::string base = "rvr";  ///< a built-in profile
  std::string program;       ///< with its version
};

LabProfile lab_profile(const LabSource& source);

}  // namespace swarmsmith
