#pragma once

#include <span>
#include <string>
#include <vector>

#include "coordinator/service/live_status.h"
#include "coordinator/service/progress_model.h"
#include "storage/rows.h"

namespace swarmsmith::cli {

/// Lines about a campaign for people, and events for programs. All functions are pure.

/// Four significant digits, and no decimals from 1,000 on, because scores of grid exploration are
/// large.
std::string score_text(double score);
/// A score of the campaign; if the campaign shows costs, its cost, the negative score.
std::string mean_text(const ProgressModel& model, double score);
/// The result of the best candidate, for people: its mean in the race, or its mean in the tests,
/// and then the text says so.
std::string best_text(const ProgressModel& model, const DesignStateRow& state);

/// The line that is redrawn on a terminal, at most `width` columns wide:
///   designs 3/10  d4 iteration 5/~10  [####------]  52 418/100 000  best 2.71  ETA 1m55s
///   412 sim/s  alive 17/58  failed 3
/// Other searches than iterated racing describe their stage in their own words, and show the number
/// of alive candidates only if tests drop candidates: d4 generation 41 of 90, 12 of 20 members.
/// If the line is too long, the least important parts are left out first: alive, bar, iteration,
/// rate. For several campaigns, the sums are shown: campaigns 0/2  designs 3/20  [####------]  ...
std::string status_line(std::span<const ProgressModel> models, const LiveStatus& live,
                        std::size_t width);

/// The same facts for logs, without the bar.
std::string plain_status(std::span<const ProgressModel> models, const LiveStatus& live);

/// The table of a race as irace prints it, with an additional first column for the design. Means
/// are formatted as in `mean_text`.
std::string race_headline();
std::string race_line(const RaceStepRow& step, const std::string& mean_best, double elapsed_s);

/// Whether the design's search has races, which are printed step by step.
bool has_tests(const DesignProgress& progress);
/// A line for the start of a race, a generation or another part of a search: its size and budget.
std::string iteration_line(const IterationRow& iteration, const DesignProgress& progress);
/// A line for one of the elites of a race, or for the best candidate of another part of a search.
std::string elite_line(const EliteRow& elite, const DesignProgress& progress,
                       const std::string& mean);
/// A line for a change of a design's state.
std::string state_line(const DesignStateRow& state, const DesignProgress& progress,
                       const std::string& best_mean);
/// A line for a user's command, when it is given and when it takes effect.
std::string command_line(const CommandRow& command);
/// A line for an event that a person may want to know about.
std::string event_line(const EventRow& event);

/// The row as one event, {"v":1,"event":"race_step",...}; empty for rows that are not shown as
/// events (candidates, pairs, single evaluations, totals). `campaign`: its name, if there are
/// several.
std::string event_json(const Row& row, const std::string& campaign = {});
/// {"v":1,"event":"progress",...}; the expected time is for all campaigns together.
std::string progress_json(const ProgressModel& model, const LiveStatus& live,
                          const std::string& campaign);

}  // namespace swarmsmith::cli
