#pragma once

#include <string>
#include <vector>

#include "storage/internal/sqlite.h"
#include "storage/real_runs.h"

namespace swarmsmith {

/// Writes real runs into their tables. The caller holds a transaction. The functions throw
/// SqliteError.

/// Throws std::invalid_argument when a number is NaN or infinite, or a video or robot names a
/// calibration that is not among the rows.
void require_whole(const RealRunRows& rows);

/// Writes a new run, with its first scoring.
RealRunId write_real_run(sqlite::Connection& connection, const RealRunRows& rows);

/// Replaces everything of a stored run except its sightings, and adds one more scoring.
void rewrite_real_run(sqlite::Connection& connection, RealRunId id, const RealRunRows& rows);

/// Writes the campaign of a store that has real runs and no races: an imported campaign without
/// designs. `key` is that of the store's first run, so two such stores have different campaigns and
/// can be merged.
void write_campaign_of_real_runs(sqlite::Connection& connection, const std::string& key);

void write_override(sqlite::Connection& connection, const RealOverrideRow& row);
/// Lets the overrides of the last scoring but one refer to the last one.
void carry_overrides(sqlite::Connection& connection, RealRunId id);
/// Whether a person who saw one scoring has seen the other: the same inputs and the same result.
bool same_scoring(const RealRunRows& a, const RealRunRows& b);

/// The inputs that differ between two records of one run: "the run log", "calibrations"; empty when
/// its score must be the same.
std::vector<std::string> differing_inputs(const RealRunRows& a, const RealRunRows& b);

/// Whether both have the same sightings: videos, frames, tags and corners, as they are stored.
bool same_sightings(const RealRunRows& a, const RealRunRows& b);

}  // namespace swarmsmith
