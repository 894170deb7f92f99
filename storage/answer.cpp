#include "storage/answer.h"

#include <fmt/format.h>
#include <string_view>
#include <type_traits>

#include "base/overloaded.h"
#include "storage/stored_enums.h"

namespace swarmsmith {
namespace {

/// The one list of the fields that are part of the answer: calls `field` with the name and value of
/// each such field of the row, keys first. A field that only some campaigns have is left out where
/// it has no value, so that the digests of other campaigns do not change.
template <class Field>
void visit_fields(const Row& row, Field&& field) {
  std::visit(
      Overloaded{
          [&](const CandidateRow& r) {
            field("id", r.id), field("iteration", r.iteration), field("parent", r.parent);
            field("states", r.states), field("transitions", r.transitions);
            field("modules", r.modules), field("machine", r.machine);
            field("parameters", r.parameters);
          },
          [&](const PairRow& r) {
            field("design", r.design), field("purpose", r.purpose), field("number", r.number);
            field("instance", r.instance), field("seed", r.seed);
          },
          [&](const EvaluationRow& r) {
            field("candidate", r.key.candidate), field("purpose", r.key.purpose);
            field("pair", r.key.pair), field("iteration", r.iteration), field("status", r.status);
            const Measured& m = r.measured;
            field("score",
                  r.status == EvaluationStatus::Ok ? std::optional(m.score) : std::nullopt);
            field("state_digest", m.state_digest), field("source", r.source);
            if (m.time != 0 || r.bound != 0) field("time", m.time), field("bound", r.bound);
          },
          [&](const UnusedRow& r) {
            field("candidate", r.key.candidate), field("purpose", r.key.purpose);
            field("pair", r.key.pair);
          },
          [&](const IterationRow& r) {
            field("design", r.design), field("number", r.number), field("of", r.of);
            field("budget", r.budget), field("configurations", r.configurations);
            field("elites", r.elites), field("soft_restart", r.soft_restart);
            field("model_digest", r.model_digest);
            if (r.postselection) field("postselection", r.postselection);
          },
          [&](const RaceStepRow& r) {
            field("design", r.design), field("step", r.step), field("iteration", r.iteration);
            field("pair", r.pair), field("marker", std::string_view(&r.marker, 1));
            field("evaluated", r.evaluated), field("alive_before", r.alive_before);
            field("alive_after", r.alive_after), field("best", r.best);
            field("mean_best", r.mean_best), field("used", r.used);
            field("statistic", r.statistic), field("p_value", r.p_value);
            field("kendall_w", r.kendall_w), field("spearman_rho", r.spearman_rho);
            field("qvar", r.qvar), field("digest", r.digest);
            if (r.bound) field("bound", r.bound);
          },
          [&](const EliminationRow& r) {
            field("candidate", r.candidate), field("iteration", r.iteration);
            field("step", r.step), field("rank_sum", r.rank_sum), field("reason", r.reason);
          },
          [&](const EliteRow& r) {
            field("design", r.design), field("iteration", r.iteration), field("rank", r.rank);
            field("candidate", r.candidate), field("mean", r.mean), field("runs", r.runs);
          },
          [&](const CandidateTotalsRow& r) {
            field("candidate", r.candidate), field("runs", r.runs);
            field("score_sum", r.score_sum), field("score_squares", r.score_squares);
          },
          [&](const DesignStateRow& r) {
            field("design", r.design), field("state", r.state), field("used", r.used);
            field("iteration", r.iteration), field("best", r.best);
            field("best_mean", r.best_mean), field("reason", r.reason);
          },
          [&](const CampaignStateRow& r) { field("state", r.state); },
          [&](const WorkerRow& r) {
            field("id", r.id), field("host", r.host), field("state", word_of(r.state));
          },
          [&](const ConflictRow& r) {
            field("candidate", r.key.candidate), field("purpose", r.key.purpose);
            field("pair", r.key.pair), field("kept_score", r.kept_score);
            field("other_score", r.other_score);
          },
          [&](const FailureRow& r) {
            field("candidate", r.key.candidate), field("purpose", r.key.purpose);
            field("pair", r.key.pair), field("attempt", r.attempt), field("reason", r.reason);
          },
          [&](const EventRow& r) {
            field("severity", r.severity), field("kind", r.kind), field("text", r.text);
          },
          [&](const AttemptRow& r) {
            field("candidate", r.key.candidate), field("purpose", r.key.purpose);
            field("pair", r.key.pair), field("attempt", r.attempt),
                field("outcome", word_of(r.outcome));
          },
          [&](const CommandRow& r) {
            field("design", r.design), field("step", r.step), field("kind", word_of(r.kind));
            field("budget", r.budget);
          },
          [&](const ForgivenRow& r) { field("principal", r.principal); },
      },
      row);
}

struct AddToDigest {
  Digest& digest;

  void operator()(const char*, double value) { digest.add(value + 0.0); }  // -0 becomes 0
  void operator()(const char*, std::uint64_t value) { digest.add(value); }
  void operator()(const char*, std::string_view value) { digest.add(value); }
  template <class Tag>
  void operator()(const char*, Id<Tag> value) {
    digest.add(value.value);
  }
  template <class T>
  void operator()(const char* name, const std::optional<T>& value) {
    digest.add(std::int64_t{value.has_value()});
    if (value) (*this)(name, *value);
  }
  template <class T>
  requires std::is_enum_v<T> || std::is_integral_v<T>
  void operator()(const char*, T value) { digest.add(static_cast<std::int64_t>(value)); }
};

struct Describe {
  std::string& text;

  template <class T>
  void operator()(const char* name, const T& value) {
    text += fmt::format(" {}=", name);
    write(value);
  }
  void write(std::string_view value) {
    constexpr std::size_t kLongest = 80;
    text += value.substr(0, kLongest);
    if (value.size() <= kLongest) return;
    // Rows are compared by their descriptions, so the rest must be part of them.
    Digest rest;
    rest.add(value);
    text += fmt::format("...({:x})", rest.value64());
  }
  template <class Tag>
  void write(Id<Tag> value) {
    text += value ? to_string(value) : "none";
  }
  template <class T>
  void write(const std::optional<T>& value) {
    value ? write(*value) : write("none");
  }
  template <class T>
  requires std::is_enum_v<T> || std::is_arithmetic_v<T>
  void write(T value) {
    if constexpr (std::is_enum_v<T>) {
      text += fmt::format("{}", static_cast<int>(value));
    } else {
      text += fmt::format("{}", value);
    }
  }
};

std::string title(const Row& row) {
  return std::visit(
      Overloaded{
          [](const CandidateRow& r) { return "candidate " + to_string(r.id); },
          [](const PairRow&) { return std::string("pair"); },
          [](const EvaluationRow& r) { return "evaluation " + to_string(r.key); },
          [](const UnusedRow& r) { return "unused evaluation " + to_string(r.key); },
          [](const IterationRow&) { return std::string("iteration"); },
          [](const RaceStepRow&) { return std::string("race step"); },
          [](const EliminationRow&) { return std::string("elimination"); },
          [](const EliteRow&) { return std::string("elite"); },
          [](const CandidateTotalsRow&) { return std::string("totals"); },
          [](const DesignStateRow&) { return std::string("state of design"); },
          [](const CampaignStateRow&) { return std::string("state of campaign"); },
          [](const WorkerRow&) { return std::string("worker"); },
          [](const ConflictRow& r) { return "conflict on evaluation " + to_string(r.key); },
          [](const FailureRow& r) { return "failure of evaluation " + to_string(r.key); },
          [](const EventRow&) { return std::string("event"); },
          [](const AttemptRow& r) { return "attempt at evaluation " + to_string(r.key); },
          [](const CommandRow&) { return std::string("command"); },
          [](const ForgivenRow&) { return std::string("forgiven"); },
      },
      row);
}

using Replay = PurposeFacts::Replay;

Replay replay_of(Purpose purpose) {
  const auto facts = facts_of(purpose);
  return facts ? facts->replay : Replay::None;
}

Digest digest_of(const Row& row) {
  Digest digest;
  add_answer(digest, row);
  return digest;
}

}  // namespace

bool in_answer(const Row& row) {
  return std::visit(Overloaded{
                        [](const auto&) { return true; },
                        [](const EvaluationRow& r) {
                          const Replay replay = replay_of(r.key.purpose);
                          return replay != Replay::None &&
                                 (replay != Replay::Race || r.iteration != 0);
                        },
                        [](const PairRow& r) { return replay_of(r.purpose) != Replay::None; },
                        [](const UnusedRow&) { return false; },
                        [](const CampaignStateRow&) { return false; },
                        [](const WorkerRow&) { return false; },
                        [](const ConflictRow&) { return false; },
                        [](const FailureRow&) { return false; },
                        [](const EventRow&) { return false; },
                        [](const AttemptRow&) { return false; },
                        [](const CommandRow& r) { return r.step && is_of_race(r.kind); },
                        [](const ForgivenRow&) { return false; },
                    },
                    row);
}

void add_answer(Digest& digest, const Row& row) {
  if (!in_answer(row)) return;
  digest.add(static_cast<std::uint64_t>(row.index()));
  visit_fields(row, AddToDigest{digest});
}

bool same_answer(const Row& a, const Row& b) {
  // Two different rows will never have the same 128 bits by accident.
  return a.index() == b.index() && in_answer(a) == in_answer(b) &&
         digest_of(a).hex() == digest_of(b).hex();
}

std::string describe(const Row& row) {
  std::string text = title(row) + ":";
  visit_fields(row, Describe{text});
  return text;
}

std::string to_string(const EvaluationKey& key) {
  const auto facts = facts_of(key.purpose);
  return fmt::format("e{}{}", key.candidate.value * kPairsPerCandidate + key.pair,
                     facts ? facts->letter : "?");
}

}  // namespace swarmsmith
