#include "storage/internal/row_writer.h"

#include <cmath>
#include <stdexcept>
#include <string>
#include <tuple>
#include <utility>

#include "base/assert.h"
#include "base/overloaded.h"
#include "storage/answer.h"
#include "storage/internal/columns.h"
#include "storage/internal/row_reader.h"

namespace swarmsmith {
namespace {

constexpr const char* kOfEvaluation = " WHERE candidate = ? AND purpose = ? AND pair = ?";
/// Limit for the totals' hashes of racing candidates in memory; others are read again.
constexpr std::size_t kMostTotals = 100'000;
constexpr const char* kOnceOnly = " ON CONFLICT DO NOTHING";
constexpr const char* kNewTotals =
    " ON CONFLICT DO UPDATE SET runs = excluded.runs, score_sum = excluded.score_sum,"
    " score_squares = excluded.score_squares";
constexpr const char* kNewStep = " ON CONFLICT DO UPDATE SET step = excluded.step";
// The first result stays, whatever arrives later. Only a race that asks for a result computed ahead
// may still write its iteration, if the bits agree.
constexpr char kUsed[] =
    "UPDATE evaluation SET iteration = ?4 WHERE candidate = ?1 AND purpose = ?2 AND pair = ?3"
    " AND iteration IS NULL AND status = ?5 AND score IS ?6 AND state_digest = ?7 AND time IS ?8";
constexpr char kUnused[] =
    "UPDATE evaluation SET iteration = NULL WHERE candidate = ? AND purpose = ? AND pair = ?";
constexpr char kDesignState[] =
    "UPDATE design SET state = ?2, used = ?3, iteration = ?4, best = ?5, best_mean = ?6,"
    " reason = ?7 WHERE id = ?1";
// The first campaign of a store is the one that runs; the others were merged or imported.
constexpr char kCampaignState[] =
    "UPDATE campaign SET state = ?1, finished = CASE WHEN ?1 = 'finished' THEN"
    " coalesce(finished, strftime('%Y-%m-%dT%H:%M:%fZ', 'now')) END WHERE id = 1";
constexpr char kWorker[] =
    "INSERT INTO worker (id, identity, host, pid, slots, build, state, done, failed, job, cpu,"
    " client, connections, principal)"
    " VALUES (?,?,?,?,?,?,?,?,?,?,?,?,?,?) ON CONFLICT DO UPDATE SET identity = excluded.identity,"
    " host = excluded.host, pid = excluded.pid, slots = excluded.slots, build = excluded.build,"
    " state = excluded.state, done = excluded.done, failed = excluded.failed,"
    " job = excluded.job, cpu = excluded.cpu, client = excluded.client,"
    " connections = excluded.connections, principal = excluded.principal,"
    " last_seen = excluded.last_seen";
constexpr char kConflict[] =
    "INSERT OR IGNORE INTO conflict (candidate, purpose, pair, kept_score, other_score,"
    " other_state_digest, other_worker) VALUES (?,?,?,?,?,?,?)";
constexpr char kFailure[] =
    "INSERT INTO failure (candidate, purpose, pair, attempt, worker, reason, command, output,"
    " errors) VALUES (?,?,?,?,?,?,?,?,?)";
constexpr char kAttempt[] =
    "INSERT INTO attempt (candidate, purpose, pair, attempt, worker, held_ms, outcome)"
    " VALUES (?,?,?,?,?,?,?)";
constexpr char kForgiven[] =
    "UPDATE worker SET state = 'left' WHERE principal = ? AND state = 'quarantined'";
constexpr char kEvent[] = "INSERT INTO event (severity, kind, text) VALUES (?,?,?)";

std::optional<std::int64_t> unless_zero(std::int64_t value) {
  return value == 0 ? std::nullopt : std::optional(value);
}

template <class Enum>
std::int64_t number(Enum value) {
  return static_cast<std::int64_t>(value);
}

void require(bool finite, const Row& row) {
  if (!finite) throw std::invalid_argument("a number is not finite in " + describe(row));
}

}  // namespace

RowWriter::RowWriter(sqlite::Connection& connection)
    : connection_(connection),
      candidate_(connection, kCandidateColumns.insert()),
      known_candidate_(connection, "SELECT 1 FROM candidate WHERE id = ?"),
      phrase_(connection, "INSERT INTO phrase VALUES (?,?,?,?)"),
      pair_(connection, kPairColumns.insert() + kOnceOnly),
      evaluation_(connection, kEvaluationColumns.insert({"iteration", "row_check"}) + kOnceOnly),
      used_(connection, kUsed),
      unused_(connection, kUnused),
      iteration_(connection, kIterationColumns.insert() + kOnceOnly),
      race_step_(connection, kRaceStepColumns.insert() + kOnceOnly),
      elimination_(connection, kEliminationColumns.insert() + kOnceOnly),
      elite_(connection, kEliteColumns.insert() + kOnceOnly),
      totals_(connection, kTotalsColumns.insert() + kNewTotals),
      design_state_(connection, kDesignState),
      campaign_state_(connection, kCampaignState),
      worker_(connection, kWorker),
      conflict_(connection, kConflict),
      failure_(connection, kFailure),
      event_(connection, kEvent),
      attempt_(connection, kAttempt),
      command_(connection, kCommandColumns.insert() + kNewStep),
      forgiven_(connection, kForgiven),
      new_source_(connection, "INSERT OR IGNORE INTO source (name) VALUES (?)"),
      find_source_(connection, "SELECT id FROM source WHERE name = ?"),
      evaluation_cells_(connection, cells_of_rows(Table::Evaluation) + kOfEvaluation),
      used_cells_(connection,
                  cells_of_rows(Table::Used) + " AND candidate = ? AND purpose = ? AND pair = ?"),
      totals_cells_(connection, cells_of_rows(Table::Totals) + " WHERE candidate = ?"),
      design_cells_(connection, cells_of_rows(Table::Design) + " WHERE id = ?"),
      campaign_cells_(connection, cells_of_rows(Table::Campaign) + " WHERE id = ?"),
      command_cells_(connection, cells_of_rows(Table::Command) + " WHERE number = ?"),
      sums_(RowSums::stored(connection)),
      committed_(sums_) {}

void RowWriter::write(const Row& row) {
  std::visit([this](const auto& alternative) { put(alternative); }, row);
}

void RowWriter::write_sums(std::initializer_list<Table> others) {
  if (!sums_) return;
  for (const Table table : others)
    sums_->count(connection_, table);
  if (sums_ != committed_) sums_->write(connection_);
}

void RowWriter::forget() {
  sums_ = committed_;
  totals_hashes_.clear();
  sources_.clear();
  phrases_.clear();
  phrases_are_loaded_ = false;
}

void RowWriter::remove(const EvaluationKey& key) {
  const std::int64_t purpose = number(key.purpose);
  take_away(Table::Evaluation, evaluation_cells_, key.candidate.value, purpose, key.pair);
  take_away(Table::Used, used_cells_, key.candidate.value, purpose, key.pair);
  sqlite::Statement(connection_, std::string("DELETE FROM evaluation") + kOfEvaluation)
      .run(key.candidate.value, purpose, key.pair);
}

void RowWriter::put(const CandidateRow& row) {
  known_candidate_.bind(row.id.value);
  const bool known = known_candidate_.step();
  known_candidate_.reset();
  if (known) return;  // and adds no new phrases
  if (!std::exchange(phrases_are_loaded_, true)) phrases_.load(connection_);
  const StoredTexts texts = phrases_.encode(row, [this](std::int64_t number, const Phrase& phrase) {
    insert(Table::Phrase, phrase_, number, phrase.machine, phrase.parameters, phrase.modules);
  });
  insert(Table::Candidate, candidate_, kCandidateColumns, row.id.value, row.iteration,
         unless_zero(row.parent.value), row.states, row.transitions, texts.modules, texts.machine,
         texts.parameters, texts.code, texts.module_code);
}

void RowWriter::put(const PairRow& row) {
  insert(Table::Pair, pair_, kPairColumns, row.design.value, number(row.purpose), row.number,
         row.instance, row.seed);
}

void RowWriter::put(const EvaluationRow& row) {
  const auto all = cells_of(row, source_id(row.source));
  const std::int64_t candidate = row.key.candidate.value;
  const std::int64_t purpose = number(row.key.purpose);
  const auto iteration = unless_zero(row.iteration);
  const bool is_new = std::apply(
      [&](const auto&... cells) {
        evaluation_.run(cells..., iteration, row_check(cells...));
        if (connection_.changes() == 0) return false;
        if (sums_) sums_->add(Table::Evaluation, RowHash::of(cells...));
        return true;
      },
      all);
  bool is_used = is_new;
  if (!is_new && iteration) {
    used_.run(candidate, purpose, row.key.pair, iteration, number(row.status),
              std::get<kEvaluationColumns.at("score")>(all), row.measured.state_digest,
              std::get<kEvaluationColumns.at("time")>(all));
    is_used = connection_.changes() > 0;
  }
  if (sums_ && iteration && is_used)
    sums_->add(Table::Used, RowHash::of(candidate, purpose, row.key.pair, row.iteration));
}

void RowWriter::put(const UnusedRow& row) {
  const std::int64_t purpose = number(row.key.purpose);
  // Before the update, which removes the iteration that the hash covers.
  take_away(Table::Used, used_cells_, row.key.candidate.value, purpose, row.key.pair);
  unused_.run(row.key.candidate.value, purpose, row.key.pair);
}

void RowWriter::put(const IterationRow& row) {
  insert(Table::Iteration, iteration_, kIterationColumns, row.design.value, row.number, row.of,
         row.budget, row.configurations, row.elites, row.soft_restart, row.model_digest,
         row.postselection);
}

void RowWriter::put(const RaceStepRow& row) {
  insert(Table::RaceStep, race_step_, kRaceStepColumns, row.design.value, row.step, row.iteration,
         row.pair, std::string_view(&row.marker, 1), row.evaluated, row.alive_before,
         row.alive_after, unless_zero(row.best.value), row.mean_best, row.used, row.statistic,
         row.p_value, row.kendall_w, row.spearman_rho, row.qvar, row.digest, row.bound);
}

void RowWriter::put(const EliminationRow& row) {
  insert(Table::Elimination, elimination_, kEliminationColumns, row.candidate.value, row.iteration,
         row.step, row.rank_sum, row.reason);
}

void RowWriter::put(const EliteRow& row) {
  insert(Table::Elite, elite_, kEliteColumns, row.design.value, row.iteration, row.rank,
         row.candidate.value, row.mean, row.runs);
}

void RowWriter::put(const CandidateTotalsRow& row) {
  const std::int64_t candidate = row.candidate.value;
  const auto known = totals_hashes_.find(candidate);
  if (sums_ && known != totals_hashes_.end()) {
    sums_->remove(Table::Totals, known->second);
  } else {
    take_away(Table::Totals, totals_cells_, candidate);
  }
  totals_.run(candidate, row.runs, row.score_sum, row.score_squares);
  if (!sums_) return;
  const std::uint64_t hash = RowHash::of(candidate, row.runs, row.score_sum, row.score_squares);
  sums_->add(Table::Totals, hash);
  if (totals_hashes_.size() >= kMostTotals) totals_hashes_.clear();
  totals_hashes_.insert_or_assign(candidate, hash);
}

void RowWriter::put(const DesignStateRow& row) {
  const std::int64_t design = row.design.value;
  take_away(Table::Design, design_cells_, design);
  design_state_.run(design, number(row.state), row.used, row.iteration, unless_zero(row.best.value),
                    row.best_mean, row.reason);
  if (!sums_ || connection_.changes() == 0) return;
  sums_->add(Table::Design, RowHash::of(design, number(row.state), row.used, row.iteration,
                                        unless_zero(row.best.value), row.best_mean, row.reason));
}

void RowWriter::put(const CampaignStateRow& row) {
  constexpr std::int64_t kFirst = 1;
  take_away(Table::Campaign, campaign_cells_, kFirst);
  campaign_state_.run(row.state);
  if (sums_ && connection_.changes() > 0)
    sums_->add(Table::Campaign, RowHash::of(kFirst, row.state));
  // Leases of a finished campaign are not signed any more.
  if (row.state == "finished") forget_secret(connection_);
}

void RowWriter::put(const WorkerRow& row) {
  worker_.run(row.id, row.identity, row.host, row.pid, row.slots, row.build, word_of(row.state),
              row.done, row.failed, row.job, row.cpu, row.client, row.connections, row.principal);
}

void RowWriter::put(const ConflictRow& row) {
  conflict_.run(row.key.candidate.value, number(row.key.purpose), row.key.pair, row.kept_score,
                row.other_score, row.other_state_digest, row.other_worker);
}

void RowWriter::put(const FailureRow& row) {
  failure_.run(row.key.candidate.value, number(row.key.purpose), row.key.pair, row.attempt,
               row.worker, row.reason, row.command, row.output, row.errors);
}

void RowWriter::put(const EventRow& row) {
  event_.run(row.severity, row.kind, row.text);
}

void RowWriter::put(const AttemptRow& row) {
  attempt_.run(row.key.candidate.value, number(row.key.purpose), row.key.pair, row.attempt,
               row.worker, row.held_ms, word_of(row.outcome));
}

void RowWriter::put(const CommandRow& row) {
  take_away(Table::Command, command_cells_, row.number);
  command_.run(row.number, word_of(row.kind), unless_zero(row.design.value), row.step, row.budget,
               row.who);
  if (!sums_) return;
  command_cells_.bind(row.number);  // only the step of a known command changes
  if (command_cells_.step()) sums_->add(Table::Command, hash_of(command_cells_));
  command_cells_.reset();
}

void RowWriter::put(const ForgivenRow& row) {
  forgiven_.run(row.principal);
}

std::int64_t RowWriter::source_id(const std::string& name) {
  const auto known = sources_.find(name);
  if (known != sources_.end()) return known->second;
  new_source_.run(name);
  const bool is_new = connection_.changes() > 0;
  find_source_.bind(name);
  SWARMSMITH_ASSERT(find_source_.step(), "a source that was inserted is there");
  const std::int64_t id = find_source_.integer(0);
  find_source_.reset();
  if (sums_ && is_new) sums_->add(Table::Source, RowHash::of(id, name));
  sources_.emplace(name, id);
  return id;
}

void require_finite(const Row& row) {
  const auto nothing = [](const auto&) {};
  std::visit(Overloaded{
                 nothing,
                 [&](const EvaluationRow& r) {
                   require(r.status != EvaluationStatus::Ok || std::isfinite(r.measured.score),
                           row);
                   require(std::isfinite(r.measured.time) && std::isfinite(r.bound), row);
                 },
                 [&](const RaceStepRow& r) {
                   require(std::isfinite(r.mean_best), row);
                   for (const auto& value :
                        {r.statistic, r.p_value, r.kendall_w, r.spearman_rho, r.qvar, r.bound}) {
                     require(!value || std::isfinite(*value), row);
                   }
                 },
                 [&](const EliminationRow& r) { require(std::isfinite(r.rank_sum), row); },
                 [&](const EliteRow& r) { require(std::isfinite(r.mean), row); },
                 [&](const CandidateTotalsRow& r) {
                   require(std::isfinite(r.score_sum) && std::isfinite(r.score_squares), row);
                 },
                 [&](const DesignStateRow& r) { require(std::isfinite(r.best_mean), row); },
                 [&](const ConflictRow& r) {
                   require(std::isfinite(r.kept_score) && std::isfinite(r.other_score), row);
                 },
             },
             row);
}

}  // namespace swarmsmith
