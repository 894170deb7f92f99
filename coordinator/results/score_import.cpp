#include "coordinator/results/score_import.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/text/json.h"
#include "programs/cost.h"
#include "storage/answer.h"

namespace swarmsmith {
namespace {

constexpr std::array<std::string_view, 16> kColumns{
    "candidate", "design", "fsm_id", "name",     "mission", "method", "repetition", "score",
    "cost",      "source", "seed",   "instance", "time",    "note",   "purpose",    "pair"};

/// An id with or without its letter; none if the text is not an id.
std::optional<std::int64_t> id_in(std::string text, char letter) {
  if (text.starts_with(letter)) text.erase(0, 1);
  const auto value = integer_in(text);
  return value && *value > 0 ? value : std::nullopt;
}

/// The values of a row.
struct Score {
  ScorePlace place;
  double score = 0;
  double time = 0;
  std::string note;
};

class Importer {
 public:
  Importer(const CsvTable& table, const ScoreImport& known, ScoreLedger ledger)
      : table_(table), known_(known), ledger_(std::move(ledger)) {}

  OrErrors<ImportedScores> all() {
    if (!table_.column("score") && !table_.column("cost")) {
      return tl::unexpected(std::vector{
          Error{ErrorKind::BadInput, "there is no column score (or cost)", table_.file}});
    }
    for (const std::string& column : table_.columns) {
      if (std::ranges::find(kColumns, column) == kColumns.end()) {
        result_.not_read.push_back(column);
      }
    }
    for (const CsvRow& row : table_.rows) {
      const auto taken = take(row);
      if (taken) continue;
      Error error = taken.error();
      error.where = table_.place(row);
      errors_.push_back(std::move(error));
    }
    if (!errors_.empty()) return tl::unexpected(std::move(errors_));
    return std::move(result_);
  }

 private:
  std::string cell(const CsvRow& row, std::string_view column) const {
    return cell_of(table_, row, column);
  }

  Expected<void> take(const CsvRow& row) {
    auto design = design_of_row(row);
    if (!design) return Unexpected(design.error());
    auto candidate = candidate_of(row, **design);
    if (!candidate) return Unexpected(candidate.error());
    auto read = read_values(row, (*design)->mission);
    if (!read) return Unexpected(read.error());
    read->place.candidate = *candidate;
    return put(row, std::move(*read));
  }

  /// The only design that agrees with all cells of the row.
  Expected<const KnownDesign*> design_of_row(const CsvRow& row) const;
  Expected<CandidateId> candidate_of(const CsvRow& row, const KnownDesign& design) const;
  Expected<Score> read_values(const CsvRow& row, const std::string& mission) const;
  Expected<double> read_score(const CsvRow& row, const std::string& mission) const;
  /// The integer in a cell, at least `least`; none if the cell is empty.
  Expected<std::optional<std::int64_t>> read_integer(const CsvRow& row, std::string_view column,
                                                     std::int64_t least) const;
  Expected<void> put(const CsvRow& row, Score read);

  const CsvTable& table_;
  const ScoreImport& known_;
  ScoreLedger ledger_;
  ImportedScores result_;
  std::vector<Error> errors_;
  std::map<std::pair<CandidateId, std::string>, std::int64_t> unseeded_;
  std::map<EvaluationKey, std::string> lines_;  ///< the line of each score in this table
};

Expected<const KnownDesign*> Importer::design_of_row(const CsvRow& row) const {
  std::optional<std::int64_t> design;
  if (const std::string word = cell(row, "design"); !word.empty()) {
    design = id_in(word, 'd');
    if (!design) return bad_input("column design must be d3 or 3, not `" + word + "`");
  }
  if (const std::string word = cell(row, "candidate"); !word.empty()) {
    const auto candidate = id_in(word, 'c');
    if (!candidate) return bad_input("column candidate must be c812 or 812, not `" + word + "`");
    const std::int64_t its = design_of(CandidateId{*candidate}).value;
    if (design && *design != its) {
      return bad_input(fmt::format("c{} is of design d{}, not d{}", *candidate, its, *design));
    }
    design = its;
  }
  const auto repetition = read_integer(row, "repetition", 1);
  if (!repetition) return Unexpected(repetition.error());
  const std::string name = cell(row, table_.column("fsm_id") ? "fsm_id" : "name");
  const std::string mission = known_.missions.name_of(cell(row, "mission"));
  const std::string method = cell(row, "method");
  if (!design && name.empty() && mission.empty() && method.empty() && !*repetition) {
    return bad_input(
        "the row names no design; give a column candidate, design, fsm_id, or mission, method and "
        "repetition");
  }
  const KnownDesign* found = nullptr;
  for (const KnownDesign& known : known_.designs) {
    if (design && known.id.value != *design) continue;
    if (!name.empty() && known.name != name) continue;
    if (!mission.empty() && known.mission != mission) continue;
    if (!method.empty() && known.method != method) continue;
    if (*repetition && known.repetition != **repetition) continue;
    if (found != nullptr) {
      return bad_input(fmt::format("the row could be of {} as well as of {}; name the design",
                                   to_string(found->id), to_string(known.id)));
    }
    found = &known;
  }
  if (found != nullptr) return found;
  const auto add = [](std::string& text, std::string_view column, const std::string& value) {
    if (!value.empty()) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", column, value);
  };
  std::string said;
  add(said, "design", design ? fmt::format("d{}", *design) : "");
  add(said, "name", name);
  add(said, "mission", mission);
  add(said, "method", method);
  add(said, "repetition", *repetition ? std::to_string(**repetition) : "");
  const auto known = std::ranges::find_if(
      known_.designs, [&](const KnownDesign& each) { return design && each.id.value == *design; });
  if (known == known_.designs.end()) return bad_input("the store has no such design: " + said);
  // What is otherwise in the store.
  std::string has;
  if (!name.empty() && known->name != name)
    add(has, "name", known->name.empty() ? "(none)" : known->name);
  if (!mission.empty() && known->mission != mission) add(has, "mission", known->mission);
  if (!method.empty() && known->method != method) add(has, "method", known->method);
  if (*repetition && known->repetition != **repetition)
    add(has, "repetition", std::to_string(known->repetition));
  return bad_input(fmt::format("the store has no such design: {}; its {} has {}", said,
                               to_string(known->id), has));
}

Expected<CandidateId> Importer::candidate_of(const CsvRow& row, const KnownDesign& design) const {
  const std::string word = cell(row, "candidate");
  if (word.empty()) {
    if (design.finished && design.best) return design.best;
    return bad_input(to_string(design.id) +
                     " is not finished and has no winner; name the candidate");
  }
  const CandidateId candidate{*id_in(word, 'c')};
  if (candidate == design.best || known_.has_candidate(candidate)) return candidate;
  return bad_input("the store has no candidate " + to_string(candidate));
}

Expected<double> Importer::read_score(const CsvRow& row, const std::string& mission) const {
  const std::string score = cell(row, "score");
  const std::string cost = cell(row, "cost");
  if (score.empty() == cost.empty()) {
    return bad_input(score.empty() ? "the row has no score"
                                   : "the row has a score and a cost; which one counts?");
  }
  const std::string& word = score.empty() ? cost : score;
  const auto value = number_in(word);
  if (!value || !std::isfinite(*value)) {
    return bad_input(fmt::format("column {} must be a finite number, not `{}`",
                                 score.empty() ? "cost" : "score", word));
  }
  if (is_too_large(*value)) {
    return bad_input(fmt::format("the {} {} is beyond 1e300, where sums of scores are infinite",
                                 score.empty() ? "cost" : "score", word));
  }
  const bool is_cost =
      score.empty() || std::ranges::find(known_.costs_of, mission) != known_.costs_of.end();
  return is_cost ? 0.0 - *value : *value;
}

Expected<std::optional<std::int64_t>> Importer::read_integer(const CsvRow& row,
                                                             std::string_view column,
                                                             std::int64_t least) const {
  const std::string word = cell(row, column);
  if (word.empty()) return std::optional<std::int64_t>();
  const auto value = integer_in(word);
  if (value && *value >= least) return value;
  return bad_input(
      fmt::format("column {} must be an integer from {} on, not `{}`", column, least, word));
}

Expected<Score> Importer::read_values(const CsvRow& row, const std::string& mission) const {
  Score read;
  const auto score = read_score(row, mission);
  if (!score) return Unexpected(score.error());
  read.score = *score;
  read.place.source = cell(row, "source");
  if (read.place.source.empty()) read.place.source = known_.source;
  if (read.place.source.empty()) {
    return bad_input(
        "the row does not say who made the score: add a column source, or --source real");
  }
  if (std::ssize(read.place.source) > kLongestName) {
    return bad_input(fmt::format("the source has {} bytes; the limit is {}",
                                 read.place.source.size(), kLongestName));
  }
  const auto seed = read_integer(row, "seed", 1);
  if (!seed) return Unexpected(seed.error());
  const auto instance = read_integer(row, "instance", 1);
  if (!instance) return Unexpected(instance.error());
  read.place.seed = seed->value_or(0);
  read.place.instance = *instance;
  if (const std::string word = cell(row, "time"); !word.empty()) {
    const auto time = number_in(word);
    if (!time || !std::isfinite(*time) || *time < 0) {
      return bad_input("column time must be a number from 0 on, not `" + word + "`");
    }
    read.time = *time;
  }
  read.note = cell(row, "note");
  return read;
}

Expected<void> Importer::put(const CsvRow& row, Score read) {
  if (read.place.seed == 0 && !read.place.instance) {
    read.place.instance = ++unseeded_[{read.place.candidate, read.place.source}];
  }
  const LedgerScore* stored = ledger_.find(read.place);
  EvaluationKey key;
  if (stored != nullptr) {
    key = stored->key;
    const auto here = lines_.find(key);
    if (stored->measured.score == read.score) {
      if (here == lines_.end()) ++result_.known;
      return {};
    }
    const std::string both =
        fmt::format("the score {} of {} ({}, {}) ", read.score, to_string(read.place.candidate),
                    read.place.source,
                    read.place.seed == 0 ? fmt::format("run {}", *read.place.instance)
                                         : fmt::format("seed {}", read.place.seed));
    if (here != lines_.end()) {
      return bad_input(both + fmt::format("is {} in {}", stored->measured.score, here->second));
    }
    if (key.purpose == Purpose::Test) {
      return bad_input(both + fmt::format("is {} in the campaign's own test {}",
                                          stored->measured.score, to_string(key)));
    }
    if (!known_.replace) {
      return bad_input(both + fmt::format("is {} in the store, {}; --replace takes the new one",
                                          stored->measured.score, to_string(key)));
    }
    ledger_.replace(read.place, read.score);
    result_.addition.removed.push_back(key);
    ++result_.replaced;
  } else {
    if (const auto room = ledger_.check_room({read.place}); !room)
      return bad_input(room.error().message + ": leave out some of its rows");
    key = ledger_.add(read.place, {.score = read.score}, result_.addition.rows);
    ++result_.added;
  }
  lines_.emplace(key, table_.place(row));
  result_.addition.rows.emplace_back(
      EvaluationRow{.key = key,
                    .measured = {.score = read.score, .time = read.time},
                    .source = read.place.source});
  if (!read.note.empty()) {
    result_.addition.rows.emplace_back(EventRow{
        .severity = "info",
        .kind = "note",
        .text = JsonObject().add("evaluation", to_string(key)).add("note", read.note).text()});
  }
  return {};
}

}  // namespace

bool has_scores(const CsvTable& table) {
  return table.column("score") || table.column("cost");
}

OrErrors<ImportedScores> import_scores(const CsvTable& table, const ScoreImport& known,
                                       ScoreLedger ledger) {
  return Importer(table, known, std::move(ledger)).all();
}

}  // namespace swarmsmith
