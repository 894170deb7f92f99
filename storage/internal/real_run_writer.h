#pragma once

#include <string>
#include <vector>

#include "storage/internal/sqlite.h"
#include "storage/real_runs.h"

namespace swarmsmith {

/// Real runs into their tables. The caller holds a transaction. Throw SqliteError.

/// Throws std::invalid_argument when a number is NaN or infinite, or a video or robot names a
/// calibration that is not among the rows.
void require_whole(const RealRunRows& rows);

/// A run that is not there, with its first scoring.
RealRunId write_real_run(sqlite::Connection& connection, const RealRunRows& rows);

/// All of a stored run but its sightings, and one more scoring.
void rewrite_real_run(sqlite::Connection& connection, RealRunId id, const RealRunRows& rows);

/// The campaign of a store that has real runs and no races, which begins with the run of that key:
/// an imported one without designs. Two such stores differ, so that they can be merged.
void write_campaign_of_real_runs(sqlite::Connection& connection, const std::string& key);

void write_override(sqlite::Connection& connection, const RealOverrideRow& row);

/// Which inputs of two records of one run differ: "the run log", "calibrations"; none when its
/// score must be the same.
std::vector<std::string> differing_inputs(const RealRunRows& a, const RealRunRows& b);

/// Whether both hold the same sightings: videos, frames, tags and corners as they are stored.
bool same_sightings(const RealRunRows& a, const RealRunRows& b);

}  // namespace swarmsmith
