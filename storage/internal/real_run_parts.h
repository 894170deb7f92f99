#pragma once

#include <array>
#include <cstdint>

namespace swarmsmith {

/// A table with parts of real runs, and the column of real_run with the number of its rows that a
/// run has. This number shows which parts a damaged store has lost.
struct RealRunPart {
  const char* column;
  const char* table;
  bool is_scored;           ///< the score follows from the parts that have this
  std::int64_t schema = 5;  ///< the schema that added it
};

/// The schema that added the robots' logs.
inline constexpr std::int64_t kLogsSchema = 10;
/// The schema that added the checks of runs. A run that was scored earlier has none.
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
