#pragma once

#include <array>
#include <cstdint>

namespace swarmsmith {

/// A table with parts of real runs, and the column of real_run that says how many of its rows a run
/// has: what a damaged store has lost can so be told.
struct RealRunPart {
  const char* column;
  const char* table;
  bool is_scored;           ///< the score follows from it without anything else
  std::int64_t schema = 5;  ///< that brought it
};

/// Schema that brought the robots' logs.
inline constexpr std::int64_t kLogsSchema = 10;
/// Schema that brought the checks of runs. A run that was scored before has none.
inline constexpr std::int64_t kChecksSchema = 13;

inline constexpr std::array kRealRunParts{
    RealRunPart{"videos", "real_video", false},
    RealRunPart{"samples", "real_sample", false},
    RealRunPart{"looks", "real_reference", false},
    RealRunPart{"robots", "real_robot", true},
    RealRunPart{"patches", "real_patch", true},
    RealRunPart{"cycles", "real_cycle", true},
    RealRunPart{"logs", "real_log", false, kLogsSchema},
    RealRunPart{"log_cycles", "real_log_cycle", false, kLogsSchema},
    RealRunPart{"checks", "real_check", false, kChecksSchema}};

/// The other tables that name a run.
inline constexpr std::array kRealRunNotes{"real_issue", "real_score", "real_override"};

}  // namespace swarmsmith
