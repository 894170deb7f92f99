#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/id.h"
#include "base/measured.h"

namespace swarmsmith {

/// The rows of a store as plain values, in the words of docs/storage.md. Everything but the fields
/// marked "not part of the answer" is a pure function of campaign and scores, equal for any number
/// of workers and any history of crashes, and covered by the store's digest.

/// Why an evaluation was made. The numbers are stored. Evaluator: a call of a targetEvaluator,
/// whose pair is numbered by the design's tasks (irace facts, 18.4). Transfer: a test under a
/// further profile of the campaign; its pairs are those of the tests, again for each profile, and
/// numbered on from them.
enum class Purpose : std::int8_t {
  Race = 0,
  LookAhead = 1,
  Test = 2,
  Audit = 3,
  Score = 4,
  Evaluator = 5,
  Transfer = 6
};

/// After the race, outside of its budget.
constexpr bool is_of_tests(Purpose purpose) {
  return purpose == Purpose::Test || purpose == Purpose::Transfer;
}

/// How an evaluation ended. The numbers are stored. A rejected one has no score.
enum class EvaluationStatus : std::int8_t { Ok = 0, Rejected = 1 };

enum class DesignState : std::int8_t {
  Waiting = 0,
  Racing = 1,
  Testing = 2,
  Finished = 3,
  Stopped = 4
};

/// Nothing more comes of the design by itself.
constexpr bool is_over(DesignState state) {
  return state == DesignState::Finished || state == DesignState::Stopped;
}
/// "waiting", "racing", "testing", "finished", "stopped".
std::string_view word_of(DesignState state);
std::optional<DesignState> design_state_of(std::string_view word);

/// What a person can ask of a campaign. Stores, messages and files keep the word. Unknown: of a
/// version that this one does not know; nothing comes of it.
/// Forgive is about workers, and no row of the table of commands.
enum class CommandKind : std::int8_t { Unknown, Pause, Resume, Cancel, Extend, Forgive };

/// "pause", "resume", "cancel", "extend", "forgive"; "unknown".
std::string_view word_of(CommandKind kind);
/// Unknown for any other word.
CommandKind command_kind_of(std::string_view word);
/// Whether a design's race obeys it, so that it is part of the answer once it acts.
constexpr bool is_of_race(CommandKind kind) {
  return kind == CommandKind::Cancel || kind == CommandKind::Extend;
}
/// Whether it only says what is leased: it acts at once, and changes nothing of the answer.
constexpr bool is_of_leases(CommandKind kind) {
  return kind == CommandKind::Pause || kind == CommandKind::Resume;
}

/// Names an evaluation within a store: a candidate (its design follows from it), what for, and the
/// pair (instance, seed) by its number in the design's list of that purpose, from 1.
struct EvaluationKey {
  CandidateId candidate;
  Purpose purpose = Purpose::Race;
  std::int64_t pair = 0;

  friend auto operator<=>(const EvaluationKey&, const EvaluationKey&) = default;
};

/// Ids are made in canonical order, so that two stores of one campaign agree row by row: candidate
/// `number` of a design (irace's id, from 1) has the id (design - 1) * 1,000,000 + number, and its
/// evaluation on a race's pair is e<candidate * 100,000 + pair>.
inline constexpr std::int64_t kCandidatesPerDesign = 1'000'000;
inline constexpr std::int64_t kPairsPerCandidate = 100'000;

constexpr CandidateId candidate_id(DesignId design, std::int64_t number) {
  return {(design.value - 1) * kCandidatesPerDesign + number};
}
constexpr DesignId design_of(CandidateId id) {
  return {(id.value - 1) / kCandidatesPerDesign + 1};
}
constexpr std::int64_t number_of(CandidateId id) {
  return (id.value - 1) % kCandidatesPerDesign + 1;
}

/// Characters of a name in a store: of campaigns, missions, methods, designs, sources.
inline constexpr std::int64_t kLongestName = 1000;

struct CampaignRow {
  std::string name;
  std::string digest;    ///< of what decides the answer
  std::string deciding;  ///< JSON object: the keys and values that the digest covers, in order
  std::string file;      ///< the normalised campaign file; reading it gives the campaign again
  std::int64_t seed = 0;
};

struct DesignRow {
  DesignId id;
  std::string mission;
  std::string method;
  /// Of the machines' texts; empty for the space of a parameter file.
  std::string flavour;
  std::int64_t repetition = 0;  ///< from 1
  std::int64_t seed = 0;        ///< of the race
  std::int64_t budget = 0;      ///< experiments
};

/// A point of the parameter space that a design tried.
struct CandidateRow {
  CandidateId id;
  std::int64_t iteration = 0;
  CandidateId parent;      ///< whose model it was sampled from; none for initial ones
  std::string parameters;  ///< JSON object of the active parameters
  std::string machine;     ///< text of the grammar
  std::string modules;     ///< JSON object, module name -> occurrences
  std::int64_t states = 0;
  std::int64_t transitions = 0;

  friend bool operator==(const CandidateRow&, const CandidateRow&) = default;
};

/// An (instance, seed) that all candidates of a design are tried on.
struct PairRow {
  DesignId design;
  Purpose purpose = Purpose::Race;
  std::int64_t number = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
};

struct EvaluationRow {
  EvaluationKey key;
  std::int64_t iteration = 0;  ///< whose race asked for it; 0 outside races
  EvaluationStatus status = EvaluationStatus::Ok;
  Measured measured{};       ///< finite
  double bound = 0;          ///< on its time; 0 for none
  std::string source;        ///< the simulator profile
  std::int64_t worker = 0;   ///< not part of the answer; 0 when unknown
  std::int64_t attempt = 1;  ///< not part of the answer
};

/// The race no longer wants this evaluation (its candidate was rejected on an earlier pair): it
/// stays in the store, and counts nowhere.
struct UnusedRow {
  EvaluationKey key;
};

struct IterationRow {
  DesignId design;
  std::int64_t number = 0;
  std::int64_t of = 0;  ///< iterations planned when this one began
  std::int64_t budget = 0;
  std::int64_t configurations = 0;  ///< elites included
  std::int64_t elites = 0;
  bool soft_restart = false;
  bool postselection = false;
  std::uint64_t model_digest = 0;
};

/// One task of a race: all alive candidates on one pair, and the test after it.
struct RaceStepRow {
  DesignId design;
  std::int64_t step = 0;  ///< from 1, through all iterations
  std::int64_t iteration = 0;
  std::int64_t pair = 0;
  char marker = 'x';  ///< irace's: x no test, = nothing dropped, - dropped, ! only protected ones,
                      ///< . nothing to run
  std::int64_t evaluated = 0;  ///< experiments of this step
  std::int64_t alive_before = 0;
  std::int64_t alive_after = 0;
  CandidateId best;
  double mean_best = 0;   ///< score
  std::int64_t used = 0;  ///< experiments of the design so far
  std::optional<double> statistic;
  std::optional<double> p_value;
  std::optional<double> kendall_w;
  std::optional<double> spearman_rho;
  std::optional<double> qvar;
  std::optional<double> bound;  ///< of the times on this pair, when capping
  std::uint64_t digest = 0;     ///< alive set, ranks, statistic, generator
};

struct EliminationRow {
  CandidateId candidate;
  std::int64_t iteration = 0;
  std::int64_t step = 0;
  double rank_sum = 0;
  std::string reason;  ///< "test", "rejected", "not kept" (survived the race, no elite)
};

struct EliteRow {
  DesignId design;
  std::int64_t iteration = 0;
  std::int64_t rank = 0;  ///< from 1
  CandidateId candidate;
  double mean = 0;  ///< score over the pairs seen so far
  std::int64_t runs = 0;
};

/// Sums over a candidate's race evaluations in the order of the race: absolute values, so that
/// writing them twice does no harm.
struct CandidateTotalsRow {
  CandidateId candidate;
  std::int64_t runs = 0;
  double score_sum = 0;
  double score_squares = 0;
};

struct DesignStateRow {
  DesignId design;
  DesignState state = DesignState::Waiting;
  std::int64_t used = 0;
  std::int64_t iteration = 0;
  CandidateId best;  ///< best so far; the winner of a finished design
  double best_mean = 0;
  std::string reason;  ///< why it ended
};

struct CampaignStateRow {
  /// "running", "finished", "stopped"; "distrusted": its scores are wrong, or may be
  std::string state;
};

/// One in quarantine is quarantined whether it is there or not.
enum class WorkerState : std::int8_t { Connected, Lost, Left, Refused, Quarantined };

/// As in stores, logs and JSON.
constexpr std::string_view word_of(WorkerState state) {
  constexpr std::string_view kWords[] = {"connected", "lost", "left", "refused", "quarantined"};
  return kWords[static_cast<std::size_t>(state)];
}

/// Not part of the answer.
struct WorkerRow {
  std::int64_t id = 0;   ///< by order of arrival in this store
  std::string identity;  ///< 128 random bits in hexadecimal
  std::string host;
  std::int64_t pid = 0;
  std::int64_t slots = 0;
  std::string build;
  WorkerState state = WorkerState::Connected;
  std::int64_t done = 0;
  std::int64_t failed = 0;
  std::string job;     ///< of the batch system; empty outside of one
  std::string cpu;     ///< model of its processor
  std::string client;  ///< name of its key in the allow-list; empty without keys
  std::int64_t connections = 1;
  std::string principal{};  ///< key's name and address, by which it is trusted or not
};

/// Workers that get nothing, as a store remembers them.
struct Quarantine {
  std::string principal;  ///< as in WorkerRow; the name of a key alone: at every address
  std::string identity;   ///< of one process; empty: all workers of the principal
  std::string since;      ///< as stores have times; empty: not known
  std::string reason;
};

/// Whether a principal has neither a key nor this host's secret, so that one lie is blamed on a
/// process of it and not on all (docs/decisions/0023-forgiveness.md).
bool is_blamed_by_process(std::string_view principal);
/// What a worker's row says of it, if it is in quarantine; without cause.
std::optional<Quarantine> quarantine_of(const WorkerRow& row);

/// The principal's workers are in quarantine no longer. Not part of the answer.
struct ForgivenRow {
  std::string principal;
};

enum class AttemptOutcome : std::int8_t {
  Lost,
  Expired,
  Returned,
  Failed,
  TimedOut,
  SecondCopy,
  Audited,
};

/// As in stores and logs.
constexpr std::string_view word_of(AttemptOutcome outcome) {
  constexpr std::string_view kWords[] = {"lost",      "expired",     "returned", "failed",
                                         "timed out", "second copy", "audited"};
  return kWords[static_cast<std::size_t>(outcome)];
}

/// A lease that did not simply end with the evaluation's result, or that was not the only one. Not
/// part of the answer.
struct AttemptRow {
  EvaluationKey key;
  std::int64_t attempt = 1;
  std::int64_t worker = 0;
  std::int64_t held_ms = 0;
  AttemptOutcome outcome = AttemptOutcome::Lost;
};

/// A person's command to the campaign. "cancel" and "extend" are part of the answer once they act:
/// a replayed campaign does the same at the same step.
struct CommandRow {
  std::int64_t number = 0;  ///< in the store, from 1
  CommandKind kind = CommandKind::Unknown;
  DesignId design;  ///< none: every design
  /// Step of the race after which it acts (0: before the first); nothing until it does.
  std::optional<std::int64_t> step;
  std::int64_t budget = 0;  ///< experiments more, of "extend"
  std::string who;          ///< user@host; not part of the answer
  std::string whom{};       ///< of "forgive": a key or a host
};

/// Two results of one evaluation with different bits: the campaign is not deterministic. Both are
/// kept; the first one counts.
struct ConflictRow {
  EvaluationKey key;
  double kept_score = 0;
  double other_score = 0;
  std::uint64_t other_state_digest = 0;
  std::int64_t other_worker = 0;
};

/// An attempt without a score: the command that was run, and its output. Not part of the answer.
struct FailureRow {
  EvaluationKey key;
  std::int64_t attempt = 1;
  std::int64_t worker = 0;
  std::string reason;
  std::string command;
  std::string output;
  std::string errors;
};

/// What an event says of one thing.
using EventField = std::pair<std::string, std::variant<std::int64_t, double, std::string>>;

/// Something that a person may want to know afterwards. Not part of the answer.
struct EventRow {
  std::string severity;  ///< "info", "warning", "error"
  std::string kind;      ///< "worker lost", "lease expired", "disk full", ...
  std::string text;      ///< JSON object, as stores keep it
  /// What the text was made of, see `event_row`, for who shows it; stores do not keep it.
  std::vector<EventField> fields{};
};

/// An event with these fields, whose text is a JSON object of them in their order.
EventRow event_row(std::string severity, std::string kind, std::vector<EventField> fields);

using Row =
    std::variant<CandidateRow, PairRow, EvaluationRow, UnusedRow, IterationRow, RaceStepRow,
                 EliminationRow, EliteRow, CandidateTotalsRow, DesignStateRow, CampaignStateRow,
                 WorkerRow, ConflictRow, FailureRow, EventRow, AttemptRow, CommandRow, ForgivenRow>;

/// The part of an evaluation that a resumed campaign needs.
struct StoredScore {
  EvaluationKey key;
  EvaluationStatus status = EvaluationStatus::Ok;
  Measured measured{};
  double bound = 0;
  std::int64_t iteration = 0;  ///< that used it last; 0: none (EvaluationRow)
  std::int64_t worker = 0;
};

/// The part of an evaluation that a replay compares.
struct StoredStep {
  DesignId design;
  std::int64_t step = 0;
  std::uint64_t digest = 0;
};

}  // namespace swarmsmith
