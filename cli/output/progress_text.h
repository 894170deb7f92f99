#pragma once

#include <span>
#include <string>
#include <vector>

#include "coordinator/service/live_status.h"
#include "coordinator/service/progress_model.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Lines about a campaign for people, and events for programs. All pure.

/// Four digits, and none behind the point from 1,000 on: scores of grid exploration are large.
std::string score_text(double score);
/// A score of the campaign, or its cost if those are shown: the negative of it.
std::string mean_text(const ProgressModel& model, double score);
/// How good the best is, as people read it: the race's mean, or that of its tests, which says so.
std::string best_text(const ProgressModel& model, const DesignStateRow& state);

/// The line that is redrawn on a terminal, at most `width` columns wide:
///   designs 3/10  d4 iteration 5/~10  [####------]  52 418/100 000  best 2.71  ETA 1m55s
///   412 sim/s  alive 17/58  failed 3
/// Another search than iterated racing says where it is in its own words, and who is alive only
/// where tests drop candidates: d4 generation 41 of 90, 12 of 20 members.
/// What is needed least is left out first: alive, bar, iteration, rate. Of several campaigns, their
/// sums: campaigns 0/2  designs 3/20  [####------]  ...
std::string status_line(std::span<const ProgressModel> models, const LiveStatus& live,
                        std::size_t width);

/// The same facts for logs, without the bar.
std::string plain_status(std::span<const ProgressModel> models, const LiveStatus& live);

/// The table of a race as irace prints it, with the design in front. Means are as
/// `mean_text` has them.
std::string race_headline();
std::string race_line(const RaceStepRow& step, const std::string& mean_best, double elapsed_s);

/// Whether the design's search has races, which are shown step by step.
bool has_tests(const DesignProgress& progress);
/// A race, a generation or another part of a search begins: its size and budget.
std::string iteration_line(const IterationRow& iteration, const DesignProgress& progress);
/// One of those that a race kept, or the best of another part of a search.
std::string elite_line(const EliteRow& elite, const DesignProgress& progress,
                       const std::string& mean);
/// A design's state changed.
std::string state_line(const DesignStateRow& state, const DesignProgress& progress,
                       const std::string& best_mean);
/// A user asked for something, or it acts now.
std::string command_line(const CommandRow& command);
/// Something happened that a person may want to know.
std::string event_line(const EventRow& event);

/// The row as one event, {"v":1,"event":"race_step",...}; empty for rows that are none
/// (candidates, pairs, single evaluations, totals). `campaign`: its name, where there are several.
std::string event_json(const Row& row, const std::string& campaign = {});
/// {"v":1,"event":"progress",...}; the expected time is that of all campaigns.
std::string progress_json(const ProgressModel& model, const LiveStatus& live,
                          const std::string& campaign);

}  // namespace swarmsmith::cli
