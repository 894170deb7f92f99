#include "coordinator/design/verify.h"

#include <fmt/format.h>
#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "base/overloaded.h"
#include "base/plain_text.h"
#include "coordinator/campaign/campaign_file.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/design/campaign_runner.h"
#include "coordinator/design/design_runner.h"
#include "coordinator/design/plans.h"
#include "coordinator/results/filmed_run.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

constexpr std::size_t kComplaintsPerDesign = 20;

/// The rows of one design as texts. If only the latest value counts, as for totals, the rows are in
/// a map.
struct DesignAnswer {
  std::vector<std::string> rows;
  /// Pairs of the race by number; pairs without a step are not part of the answer.
  std::map<std::int64_t, std::string> pairs;
  std::set<std::int64_t> stepped;
  std::map<CandidateId, std::string> totals;
  std::map<CandidateId, std::string> candidates;
  std::optional<DesignStateRow> state;
  std::int64_t evaluations = 0;
};

std::optional<DesignId> design_of(const Row& row) {
  return std::visit(
      Overloaded{[](const CandidateRow& r) { return std::optional(design_of(r.id)); },
                 [](const PairRow& r) { return std::optional(r.design); },
                 [](const EvaluationRow& r) { return std::optional(design_of(r.key.candidate)); },
                 [](const UnusedRow&) { return std::optional<DesignId>(); },
                 [](const IterationRow& r) { return std::optional(r.design); },
                 [](const RaceStepRow& r) { return std::optional(r.design); },
                 [](const EliminationRow& r) { return std::optional(design_of(r.candidate)); },
                 [](const EliteRow& r) { return std::optional(r.design); },
                 [](const CandidateTotalsRow& r) { return std::optional(design_of(r.candidate)); },
                 [](const DesignStateRow& r) { return std::optional(r.design); },
                 [](const CampaignStateRow&) { return std::optional<DesignId>(); },
                 [](const WorkerRow&) { return std::optional<DesignId>(); },
                 [](const ConflictRow&) { return std::optional<DesignId>(); },
                 [](const FailureRow&) { return std::optional<DesignId>(); },
                 [](const EventRow&) { return std::optional<DesignId>(); },
                 [](const AttemptRow&) { return std::optional<DesignId>(); },
                 [](const CommandRow& r) { return std::optional(r.design); },
                 [](const ForgivenRow&) { return std::optional<DesignId>(); }},
      row);
}

void add(const Row& row, DesignAnswer& answer) {
  // Rows about workers, attempts and events differ between runs of one campaign.
  if (!in_answer(row)) return;
  if (const auto* state = std::get_if<DesignStateRow>(&row)) {
    answer.state = *state;
  } else if (const auto* totals = std::get_if<CandidateTotalsRow>(&row)) {
    answer.totals[totals->candidate] = describe(row);
  } else if (const auto* candidate = std::get_if<CandidateRow>(&row)) {
    answer.candidates[candidate->id] = describe(row);
  } else if (const auto* evaluation = std::get_if<EvaluationRow>(&row)) {
    if (evaluation->key.purpose == Purpose::Race) ++answer.evaluations;
  } else if (const auto* pair = std::get_if<PairRow>(&row);
             pair && pair->purpose == Purpose::Race) {
    answer.pairs.emplace(pair->number, describe(row));
  } else {
    if (const auto* step = std::get_if<RaceStepRow>(&row)) answer.stepped.insert(step->pair);
    answer.rows.push_back(describe(row));
  }
}

void add_stepped_pairs(DesignAnswer& answer) {
  // Look-ahead may record pairs that the race never reaches.
  for (const auto& [number, row] : answer.pairs) {
    if (answer.stepped.contains(number)) answer.rows.push_back(row);
  }
}

/// Adds the candidates to the rows. In an unfinished design, stored candidates after the last one
/// that its scores produce, as in a recovered store, are only counted; returns their number.
std::int64_t add_candidates(DesignAnswer& stored, DesignAnswer& replayed, bool finished) {
  const CandidateId last =
      replayed.candidates.empty() ? CandidateId{} : replayed.candidates.rbegin()->first;
  std::int64_t later = 0;
  for (const auto& [id, row] : stored.candidates) {
    // Candidates up to the last replayed one must follow from the scores; later ones come after a
    // gap.
    if (!finished && id > last) {
      ++later;
    } else {
      stored.rows.push_back(row);
    }
  }
  for (const auto& [id, row] : replayed.candidates)
    replayed.rows.push_back(row);
  return later;
}

/// The entries of `some` that are not in `all`, up to a limit; sorts both.
std::vector<std::string> missing_from(std::vector<std::string>& all,
                                      std::vector<std::string>& some) {
  std::ranges::sort(all);
  std::ranges::sort(some);
  std::vector<std::string> missing;
  std::ranges::set_difference(some, all, std::back_inserter(missing));
  if (missing.size() > kComplaintsPerDesign) missing.resize(kComplaintsPerDesign);
  return missing;
}

void compare_finished(DesignAnswer& stored, DesignAnswer& replayed, const std::string& name,
                      std::vector<std::string>& complaints) {
  for (const std::string& row : missing_from(stored.rows, replayed.rows)) {
    complaints.push_back(fmt::format("{}: a row is missing from the store: {}", name, row));
  }
  std::size_t sums = 0;
  for (const auto& [candidate, row] : replayed.totals) {
    const auto found = stored.totals.find(candidate);
    if (found != stored.totals.end() && found->second == row) continue;
    complaints.push_back(fmt::format("{}: the store's sums of {} are not those of its scores: {}",
                                     name, to_string(candidate), row));
    if (++sums >= kComplaintsPerDesign) break;
  }
  // The last row is compared as a whole: state, best candidate, its mean, and the budget used.
  if (!replayed.state || !same_answer(*stored.state, *replayed.state)) {
    complaints.push_back(
        fmt::format("{}: the store ends with {}, its scores with {}", name, describe(*stored.state),
                    replayed.state ? describe(*replayed.state) : std::string("nothing")));
  } else if (stored.evaluations != replayed.state->used) {
    complaints.push_back(fmt::format(
        "{}: {} stored as used by the race, which used {}", name,
        counted(stored.evaluations, "evaluation is", "evaluations are"), replayed.state->used));
  }
}

/// Commands that have not taken effect are not part of the answer.
std::vector<CommandRow> acted(std::vector<CommandRow> commands) {
  std::erase_if(commands, [](const CommandRow& command) { return !command.step; });
  return commands;
}

/// The number of scores that count for the race or its tests although the replay did not ask for
/// them; scores that were computed ahead or released by a cancel do not count.
std::size_t unasked_but_used(const StoredDesign& unasked) {
  std::size_t count = unasked.test_scores.size() + unasked.evaluator_scores.size();
  for (const auto& [key, score] : unasked.race_scores)
    count += score.iteration != 0;
  return count;
}

/// Whether the design has ended, so that its scores must produce all of its rows.
bool is_over(const std::optional<DesignStateRow>& state, const DesignPlan& plan) {
  if (!state) return false;
  if (state->state == DesignState::Finished) return true;
  return state->state == DesignState::Stopped &&
         std::ranges::any_of(plan.commands, [](const CommandRow& command) {
           return command.kind == CommandKind::Cancel;
         });
}

void verify_design(DesignPlan plan, StoredDesign scores, DesignAnswer& stored,
                   std::vector<std::string>& complaints) {
  const std::string name = to_string(plan.row.id);
  const bool finished = is_over(stored.state, plan);
  // The race is made again from its seed and the stored scores (decision 3). The step digests are
  // not given, so each row is compared, and not only the first step that differs is reported.
  auto runner = DesignRunner::start(std::move(plan), std::move(scores));
  if (!runner) {
    complaints.push_back(fmt::format("{}: {}", name, to_string(runner.error())));
    return;
  }
  std::vector<Task> tasks;
  std::vector<Row> rows;
  if (auto advanced = runner->advance(tasks, rows); !advanced) {
    complaints.push_back(fmt::format("{}: {}", name, to_string(advanced.error())));
    return;
  }
  DesignAnswer replayed;
  for (const Row& row : rows)
    add(row, replayed);
  add_stepped_pairs(replayed);
  add_stepped_pairs(stored);
  if (!stored.state) complaints.push_back(name + ": the store has no row of this design");
  if (const std::int64_t later = add_candidates(stored, replayed, finished); later > 0) {
    complaints.push_back(fmt::format(
        "{}: {} after a gap: {} missing before, the first is {}; run the campaign on this store to "
        "make up for it",
        name, counted(later, "candidate comes", "candidates come"),
        counted(tasks.size(), "evaluation is", "evaluations are"),
        tasks.empty() ? "unknown" : to_string(tasks.front().key)));
  }
  if (finished && !tasks.empty()) {
    complaints.push_back(fmt::format(
        "{}: the design is finished, but {} missing, the first is {}", name,
        counted(tasks.size(), "evaluation is", "evaluations are"), to_string(tasks.front().key)));
  }
  // Also in an unfinished design: what is stored must follow from the scores that are stored.
  for (const std::string& row : missing_from(replayed.rows, stored.rows)) {
    complaints.push_back(
        fmt::format("{}: the store has a row that does not follow from its scores: {}", name, row));
  }
  if (const std::size_t unasked = unasked_but_used(runner->unasked()); unasked > 0) {
    complaints.push_back(fmt::format("{}: the race never asked for {}", name,
                                     counted(unasked, "stored evaluation")));
  }
  if (finished) compare_finished(stored, replayed, name, complaints);
}

/// Adds a sentence for each of the first evaluations for which two workers gave different bits. If
/// the coordinator evaluated again and the kept score has the same bits, the other worker was
/// wrong, and there is no complaint.
void complain_of_conflicts(StoreReader& store, std::vector<std::string>& complaints) {
  constexpr const char* kConflicts =
      "SELECT 'e' || (candidate * 100000 + pair), kept_score, other_score, other_worker"
      " FROM conflict AS c ";
  constexpr const char* kUnsettled =
      "WHERE NOT EXISTS (SELECT 1 FROM attempt AS a WHERE a.candidate = c.candidate AND a.purpose "
      "= "
      "c.purpose AND a.pair = c.pair AND a.outcome = 'audited') ";
  // The table of attempts came with this schema; older stores have no such evidence.
  constexpr std::int64_t kWithAttempts = 3;
  const std::string which = store.schema() < kWithAttempts ? "" : kUnsettled;
  const auto found = store.query(
      kConflicts + which + "ORDER BY candidate, purpose, pair", {.rows = 20}, [](const auto&) {},
      [&](const std::vector<StoreReader::Cell>& cells) {
        complaints.push_back(fmt::format(
            "evaluation {}: the score {} is kept, and worker {} gave {}; a worker is wrong, or the "
            "campaign is not deterministic",
            cells[0].text, cells[1].text, cells[3].text, cells[2].text));
      });
  if (!found) complaints.push_back(to_string(found.error()));
}

/// Coordinators mark a campaign when they find a wrong score in its store.
void complain_of_distrust(StoreReader& store, std::vector<std::string>& complaints) {
  for (const StoredCampaign& campaign : store.campaigns()) {
    if (campaign.state != "distrusted") continue;
    complaints.push_back(
        fmt::format("campaign {}: stored scores are wrong, or may be: the coordinator evaluated "
                    "some of them again and got other bits; see the events",
                    campaign.row.name));
  }
}

/// Checks the races of one campaign; the reader shows only this campaign.
void verify_campaign(StoreReader& store, std::vector<DesignPlan> plans, Verification& result) {
  std::map<DesignId, DesignAnswer> stored;
  store.each_answer_row([&](const Row& row) {
    if (const auto id = design_of(row)) add(row, stored[*id]);
  });
  const std::vector<StoredScore> all = store.scores();
  result.evaluations += static_cast<std::int64_t>(all.size());
  auto scores = by_design(all, {}, {});
  const std::vector<CommandRow> commands = acted(store.commands());
  for (DesignPlan& plan : plans) {
    const DesignId id = plan.row.id;
    DesignAnswer& answer = stored[id];
    ++result.designs;
    plan.commands = commands_to(id, commands);
    if (answer.state && answer.state->state == DesignState::Finished) ++result.finished;
    verify_design(std::move(plan), std::move(scores[id]), answer, result.complaints);
  }
}

/// "campaign 2, tuning"
std::string name_of(const StoredCampaign& campaign) {
  return fmt::format("campaign {}, {}", campaign.id, campaign.row.name);
}

/// The error in a run that has a score; empty if it is correct.
std::string complaint_about(StoreReader& store, const RealRunHead& head) {
  const auto rows = store.real_run(head.id);
  if (!rows) return to_string(rows.error());
  const auto run = filmed_run(*rows);
  if (!run) return run.error().message;
  const double again = score_again(*run);
  if (again == *head.score) return {};
  return fmt::format("its cycles score {}, but the store has {}", again, *head.score);
}

/// Recomputes the score of every real run from its control cycles, and compares it bit by bit with
/// its latest scoring; runs without a score (INVALID ones may have none) are skipped. Returns the
/// number of runs with a score; adds a sentence for each error to `complaints`.
std::int64_t verify_real_runs(StoreReader& store, std::vector<std::string>& complaints) {
  std::int64_t scored = 0;
  for (const RealRunHead& head : store.real_runs()) {
    if (!head.score) continue;
    ++scored;
    const std::string complaint = complaint_about(store, head);
    if (!complaint.empty())
      complaints.push_back(fmt::format("real run {}: {}", to_string(head.id), complaint));
  }
  return scored;
}

}  // namespace

Expected<Verification> verify(StoreReader& store) {
  Verification result{.complaints = store.integrity()};
  complain_of_conflicts(store, result.complaints);
  complain_of_distrust(store, result.complaints);
  result.real_runs = verify_real_runs(store, result.complaints);
  const std::vector<StoredCampaign> campaigns = store.campaigns();
  for (const StoredCampaign& campaign : campaigns) {
    // It has no race that could be replayed.
    if (campaign.state == "imported") continue;
    const auto alone = store.alone(campaign.id);
    auto plans = plans_of(campaign.row);
    // One campaign that cannot be replayed must not hide the complaints about the others.
    if (!plans && campaigns.size() == 1) return Unexpected(plans.error());
    Verification found;
    if (plans) {
      verify_campaign(*alone, std::move(*plans), found);
    } else {
      found.complaints.push_back(to_string(plans.error()));
    }
    result.designs += found.designs;
    result.finished += found.finished;
    result.evaluations += found.evaluations;
    for (const std::string& complaint : found.complaints) {
      result.complaints.push_back(campaigns.size() == 1 ? complaint
                                                        : name_of(campaign) + ": " + complaint);
    }
  }
  return result;
}

Expected<std::vector<DesignPlan>> plans_of(const CampaignRow& row) {
  const auto campaign = parse_campaign(row.file, "the store's campaign file");
  if (!campaign) return Unexpected(campaign.error().front());
  // With another meaning of the file, a replay would report differences that are no faults of the
  // store.
  if (campaign_digest(*campaign) != row.digest) {
    return unexpected(ErrorKind::Conflict,
                      "the store was written by another version of the engine (or its campaign was "
                      "changed by hand), so this program cannot replay its races");
  }
  return plans_of(*campaign);
}

}  // namespace swarmsmith
