#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "base/assert.h"
#include "base/id.h"
#include "base/measured.h"

namespace swarmsmith {

/// The rows of a store as plain values, with the names of docs/storage.md. All fields except those
/// marked "not part of the answer" are a pure function of the campaign and the scores. They are
/// equal for any number of workers and any history of crashes, and the store's digest covers them.

/// Why an evaluation was made. The numbers are stored. Evaluator: a call of a targetEvaluator; the
/// number of its pair is that of the design's task (irace facts, 18.4). Transfer: a test under a
/// further profile of the campaign; each profile has the pairs of the tests again, and their
/// numbers continue those of the tests.
enum class Purpose : std::int8_t {
  Race = 0,
  LookAhead = 1,
  Test = 2,
  Audit = 3,
  Score = 4,
  Evaluator = 5,
  Transfer = 6
};

/// Whether evaluations of this purpose come after the race and do not count in its budget.
constexpr bool is_of_tests(Purpose purpose) {
  return purpose == Purpose::Test || purpose == Purpose::Transfer;
}

/// How an evaluation ended. The numbers are stored. A rejected evaluation has no score.
enum class EvaluationStatus : std::int8_t { Ok = 0, Rejected = 1 };

enum class DesignState : std::int8_t {
  Waiting = 0,
  Racing = 1,
  Testing = 2,
  Finished = 3,
  Stopped = 4
};

/// Whether the design is over: it makes no progress unless a user extends it.
constexpr bool is_over(DesignState state) {
  return state == DesignState::Finished || state == DesignState::Stopped;
}
/// "waiting", "racing", "testing", "finished", "stopped".
std::string_view word_of(DesignState state);
std::optional<DesignState> design_state_of(std::string_view word);

/// The commands that a user can give a campaign. Stores, messages and files use the word. Unknown:
/// a command of another version, which this version ignores. Forgive is about workers; the table of
/// commands has no row for it.
enum class CommandKind : std::int8_t { Unknown, Pause, Resume, Cancel, Extend, Forgive };

/// "pause", "resume", "cancel", "extend", "forgive"; "unknown".
std::string_view word_of(CommandKind kind);
/// Unknown for any other word.
CommandKind command_kind_of(std::string_view word);
/// Whether the command changes the race of a design. It is then part of the answer from the moment
/// it takes effect.
constexpr bool is_of_race(CommandKind kind) {
  return kind == CommandKind::Cancel || kind == CommandKind::Extend;
}
/// Whether the command only changes which evaluations are leased. It takes effect at once, and does
/// not change the answer.
constexpr bool is_of_leases(CommandKind kind) {
  return kind == CommandKind::Pause || kind == CommandKind::Resume;
}

/// Identifies an evaluation within a store: its candidate (which determines the design), its
/// purpose, and the number of its pair (instance, seed) in the design's list of pairs for that
/// purpose, from 1.
struct EvaluationKey {
  CandidateId candidate;
  Purpose purpose = Purpose::Race;
  std::int64_t pair = 0;

  friend auto operator<=>(const EvaluationKey&, const EvaluationKey&) = default;
};

/// Ids follow from the campaign, so that two stores of one campaign agree row by row: candidate
/// `number` of a design (irace's id, from 1) has the id (design - 1) * 1,000,000 + number, and its
/// evaluation on a pair of the race has the id e<candidate * 100,000 + pair>.
inline constexpr std::int64_t kCandidatesPerDesign = 1'000'000;
inline constexpr std::int64_t kPairsPerCandidate = 100'000;
/// Designs of a campaign whose evaluations have keys in a coordinator (proto/key.h).
inline constexpr std::int64_t kDesignsPerCampaign = 34'359;

constexpr CandidateId candidate_id(DesignId design, std::int64_t number) {
  SWARMSMITH_ASSERT(design.value >= 1 && number >= 1 && number <= kCandidatesPerDesign,
                    "a candidate has a number within its design");
  return {(design.value - 1) * kCandidatesPerDesign + number};
}
constexpr DesignId design_of(CandidateId id) {
  return {(id.value - 1) / kCandidatesPerDesign + 1};
}
constexpr std::int64_t number_of(CandidateId id) {
  return (id.value - 1) % kCandidatesPerDesign + 1;
}

/// Largest number of bytes of a name in a store (campaign, mission, method, design, source).
inline constexpr std::int64_t kLongestName = 1000;
/// Largest number of bytes of the reason why a design ended.
inline constexpr std::int64_t kLongestReason = 1 << 20;

struct CampaignRow {
  std::string name;
  std::string digest;    ///< of the settings that determine the answer
  std::string deciding;  ///< JSON object: the keys and values under the digest, in order
  std::string file;      ///< the normalised campaign file; reading it gives the campaign again
  std::int64_t seed = 0;
};

struct DesignRow {
  DesignId id;
  std::string mission;
  std::string method;
  /// Of the machines; empty when the space comes from a parameter file.
  std::string flavour;
  std::int64_t repetition = 0;  ///< from 1
  std::int64_t seed = 0;        ///< of the race
  std::int64_t budget = 0;      ///< experiments
};

/// A configuration that a design tried.
struct CandidateRow {
  CandidateId id;
  std::int64_t iteration = 0;
  CandidateId parent;      ///< the elite whose model sampled it; none for initial candidates
  std::string parameters;  ///< JSON object of the active parameters
  std::string machine;     ///< as text of the grammar
  std::string modules;     ///< JSON object, module name -> occurrences
  std::int64_t states = 0;
  std::int64_t transitions = 0;

  friend bool operator==(const CandidateRow&, const CandidateRow&) = default;
};

/// An (instance, seed) pair on which the candidates of a design are evaluated.
struct PairRow {
  DesignId design;
  Purpose purpose = Purpose::Race;
  std::int64_t number = 0;
  std::int64_t instance = 0;
  std::int64_t seed = 0;
};

struct EvaluationRow {
  EvaluationKey key;
  std::int64_t iteration = 0;  ///< of the race that requested it; 0 outside races
  EvaluationStatus status = EvaluationStatus::Ok;
  Measured measured{};       ///< finite
  double bound = 0;          ///< of its run time (capping); 0 for none
  std::string source;        ///< name of the simulator profile
  std::int64_t worker = 0;   ///< not part of the answer; 0 when unknown
  std::int64_t attempt = 1;  ///< not part of the answer
};

/// An evaluation that the race no longer needs, because its candidate was rejected on an earlier
/// pair. It stays in the store, but does not count in any result.
struct UnusedRow {
  EvaluationKey key;
};

struct IterationRow {
  DesignId design;
  std::int64_t number = 0;
  std::int64_t of = 0;  ///< number of iterations planned when this one began
  std::int64_t budget = 0;
  std::int64_t configurations = 0;  ///< elites included
  std::int64_t elites = 0;
  bool soft_restart = false;
  bool postselection = false;
  std::uint64_t model_digest = 0;
};

/// One step of a race: all alive candidates are evaluated on one pair, and then tested.
struct RaceStepRow {
  DesignId design;
  std::int64_t step = 0;  ///< from 1, through all iterations
  std::int64_t iteration = 0;
  std::int64_t pair = 0;
  char marker = 'x';  ///< as irace prints: x no test, = none eliminated, - some eliminated,
                      ///< ! only protected candidates left to eliminate, . nothing to run
  std::int64_t evaluated = 0;  ///< number of experiments in this step
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
  std::optional<double> bound;  ///< of run times on this pair, if the race caps them
  std::uint64_t digest = 0;     ///< of alive set, ranks, statistic, generator
};

struct EliminationRow {
  CandidateId candidate;
  std::int64_t iteration = 0;
  std::int64_t step = 0;
  double rank_sum = 0;
  std::string reason;  ///< "test", "rejected", "not kept" (survived, but did not become an elite)
};

struct EliteRow {
  DesignId design;
  std::int64_t iteration = 0;
  std::int64_t rank = 0;  ///< from 1
  CandidateId candidate;
  double mean = 0;  ///< of its scores on the pairs so far
  std::int64_t runs = 0;
};

/// Sums over a candidate's evaluations in the race, in the order of the race. The row holds the
/// whole sums, not increments, so writing it twice does no harm.
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

/// A worker in quarantine stays Quarantined whether or not it is connected.
enum class WorkerState : std::int8_t { Connected, Lost, Left, Refused, Quarantined };

/// The word in stores, logs and JSON.
constexpr std::string_view word_of(WorkerState state) {
  constexpr std::string_view kWords[] = {"connected", "lost", "left", "refused", "quarantined"};
  return kWords[static_cast<std::size_t>(state)];
}

/// Not part of the answer.
struct WorkerRow {
  std::int64_t id = 0;   ///< in the order in which workers first connected
  std::string identity;  ///< 128 random bits in hexadecimal
  std::string host;
  std::int64_t pid = 0;
  std::int64_t slots = 0;
  std::string build;
  WorkerState state = WorkerState::Connected;
  std::int64_t done = 0;
  std::int64_t failed = 0;
  std::string job;     ///< id in the batch system; empty outside one
  std::string cpu;     ///< model of the processor
  std::string client;  ///< name of its key in the allow-list; empty without keys
  std::int64_t connections = 1;
  std::string principal{};  ///< name of the key and address; trust depends on it
};

/// Workers that get no tasks, as recorded in the store.
struct Quarantine {
  std::string principal;  ///< as in WorkerRow; only a key's name: the key at every address
  std::string identity;   ///< of one process; empty: all workers of the principal
  std::string since;      ///< time in the format of stores; empty: unknown
  std::string reason;
};

/// Whether a principal has neither a key nor this host's secret. A wrong result is then blamed on
/// one process of the principal, not on all of them (docs/decisions/0023-forgiveness.md).
bool is_blamed_by_process(std::string_view principal);
/// The quarantine of the worker in this row, if it is in one; `reason` is empty.
std::optional<Quarantine> quarantine_of(const WorkerRow& row);

/// Ends the quarantine of the principal's workers. Not part of the answer.
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

/// The word in stores and logs.
constexpr std::string_view word_of(AttemptOutcome outcome) {
  constexpr std::string_view kWords[] = {"lost",      "expired",     "returned", "failed",
                                         "timed out", "second copy", "audited"};
  return kWords[static_cast<std::size_t>(outcome)];
}

/// A lease that ended in another way than with the evaluation's result, or that was not the only
/// lease of the evaluation. Not part of the answer.
struct AttemptRow {
  EvaluationKey key;
  std::int64_t attempt = 1;
  std::int64_t worker = 0;
  std::int64_t held_ms = 0;
  AttemptOutcome outcome = AttemptOutcome::Lost;
};

/// A user's command to the campaign. "cancel" and "extend" are part of the answer once they have
/// taken effect: a replayed campaign does the same at the same step.
struct CommandRow {
  std::int64_t number = 0;  ///< in the store, from 1
  CommandKind kind = CommandKind::Unknown;
  DesignId design;  ///< none: all designs
  /// The step of the race after which it took effect (0: before the first); empty until then.
  std::optional<std::int64_t> step;
  std::int64_t budget = 0;  ///< of "extend": how many experiments more
  std::string who;          ///< user@host; not part of the answer
  std::string whom{};       ///< of "forgive": the key or the host
};

/// Two results of one evaluation with different bits, so the campaign is not deterministic. The
/// store keeps both; the first one counts.
struct ConflictRow {
  EvaluationKey key;
  double kept_score = 0;
  double other_score = 0;
  std::uint64_t other_state_digest = 0;
  std::int64_t other_worker = 0;
};

/// An attempt that gave no score, with the command that was run and its output. Not part of the
/// answer.
struct FailureRow {
  EvaluationKey key;
  std::int64_t attempt = 1;
  std::int64_t worker = 0;
  std::string reason;
  std::string command;
  std::string output;
  std::string errors;
};

/// Name and value of one field of an event.
using EventField = std::pair<std::string, std::variant<std::int64_t, double, std::string>>;

/// Something that happened and that a user may want to know later. Not part of the answer.
struct EventRow {
  std::string severity;  ///< "info", "warning", "error"
  std::string kind;      ///< "worker lost", "lease expired", "disk full", ...
  std::string text;      ///< JSON object, as stores keep it
  /// The fields of the text (see `event_row`), for code that displays the event; not stored.
  std::vector<EventField> fields{};
};

/// An event with these fields. Its text is a JSON object with the fields in this order.
EventRow event_row(std::string severity, std::string kind, std::vector<EventField> fields);

using Row =
    std::variant<CandidateRow, PairRow, EvaluationRow, UnusedRow, IterationRow, RaceStepRow,
                 EliminationRow, EliteRow, CandidateTotalsRow, DesignStateRow, CampaignStateRow,
                 WorkerRow, ConflictRow, FailureRow, EventRow, AttemptRow, CommandRow, ForgivenRow>;

/// The fields of an evaluation that a resumed campaign needs.
struct StoredScore {
  EvaluationKey key;
  EvaluationStatus status = EvaluationStatus::Ok;
  Measured measured{};
  double bound = 0;
  std::int64_t iteration = 0;  ///< the last one that used it; 0: none (EvaluationRow)
  std::int64_t worker = 0;
};

/// The fields of a race step that a replay compares.
struct StoredStep {
  DesignId design;
  std::int64_t step = 0;
  std::uint64_t digest = 0;
};

}  // namespace swarmsmith
