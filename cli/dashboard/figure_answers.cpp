#include "cli/dashboard/figure_answers.h"

#include <array>
#include <optional>
#include <utility>

#include "analysis/comparison/comparison.h"
#include "analysis/comparison/comparison_tables.h"
#include "analysis/comparison/method_matrix.h"
#include "analysis/drawing/svg.h"
#include "analysis/figures/figure.h"
#include "cli/arguments/score_words.h"

namespace swarmsmith::cli {
namespace {

/// A parameter that must be one of a few words, or missing.
Expected<std::string> word_of(const Question& question, const std::string& name,
                              std::initializer_list<const char*> words) {
  const std::string& given = question.text(name);
  if (given.empty()) return given;
  std::string list;
  for (const char* word : words) {
    if (given == word) return given;
    list += (list.empty() ? "" : ", ") + std::string(word);
  }
  return bad_input("must be one of " + list + ", not \"" + given + "\"", name);
}

Expected<FigureOptions> options_of(const Question& question) {
  FigureOptions options;
  options.filter.mission = question.text("mission");
  options.filter.method = question.text("method");
  options.source = question.text("source");
  options.parameter = question.text("parameter");
  options.paper = question.text("paper") == "1";
  const auto design = question.design_parameter();
  if (!design) return Unexpected(design.error());
  options.filter.design = *design;
  const auto by = word_of(question, "by", {"source", "method", "mission"});
  if (!by) return Unexpected(by.error());
  options.by = *by;
  const auto purpose = word_of(question, "purpose", {"test", "score", "all"});
  if (!purpose) return Unexpected(purpose.error());
  const auto per = word_of(question, "per", {"run", "design"});
  if (!per) return Unexpected(per.error());
  options.choice = score_choice(*purpose, *per);
  if (const std::string& given = question.text("candidate"); !given.empty()) {
    options.candidate = id_from_text<CandidateTag>(given);
    if (!options.candidate)
      return bad_input("must be a candidate such as c812, not \"" + given + "\"", "candidate");
  }
  if (!question.text("iteration").empty()) {
    const auto iteration = question.integer("iteration", 1, 1, 1'000'000);
    if (!iteration) return Unexpected(iteration.error());
    options.iteration = *iteration;
  }
  if (const std::string& width = question.text("width"); !width.empty()) {
    options.width_mm = millimetres_from_text(width);
    if (!(options.width_mm >= kLeastFigureWidth_mm && options.width_mm <= kMostFigureWidth_mm))
      return bad_input("a figure is 60mm to 1000mm wide (also cm, in), not \"" + width + "\"",
                       "width");
  }
  return options;
}

/// Changes an option's name to the name of the parameter in the address.
Error in_words_of_addresses(Error error) {
  if (error.where.starts_with("--")) error.where.erase(0, 2);
  return error;
}

/// A figure without data yet is a normal answer, because browsers complain about every failed
/// request.
Expected<Answer> nothing_or_error(const Error& error) {
  if (error.kind != ErrorKind::NotFound && error.kind != ErrorKind::BadInput)
    return Unexpected(in_words_of_addresses(error));
  return json_answer(answer_object().add("nothing", error.message));
}

/// A snapshot asks for the picture and then the table of each figure; a figure may take a second,
/// so it is made once for both.
Expected<Figure> made(const FigureKind& kind, const Question& question,
                      const FigureOptions& options) {
  if (!question.is_snapshot) return kind.make(question.store, options);
  thread_local std::optional<std::pair<std::string, Figure>> last;
  std::string key = question.file.string() + '\n' + std::string(kind.name);
  for (const auto& [name, value] : question.parameters)
    key += '\n' + name + '=' + value;
  if (last && last->first == key) {
    Figure figure = std::move(last->second);
    last.reset();
    return figure;
  }
  auto figure = kind.make(question.store, options);
  if (figure) last = std::pair(std::move(key), *figure);
  return figure;
}

}  // namespace

Expected<Answer> figure_answer(const Question& question) {
  const std::size_t dot = question.id.rfind('.');
  const std::string name = question.id.substr(0, dot);
  const std::string ending = dot == std::string::npos ? "" : question.id.substr(dot);
  const FigureKind* kind = find_figure_kind(name);
  if (kind == nullptr || (ending != ".svg" && ending != ".csv")) {
    std::string known;
    for (const FigureKind& each : figure_kinds())
      known += (known.empty() ? "" : ", ") + std::string(each.name);
    return unexpected(ErrorKind::NotFound,
                      "there is no such figure; there are .svg and .csv of " + known, question.id);
  }
  const auto options = options_of(question);
  if (!options) return Unexpected(options.error());
  if (const auto refused = refused_option(*kind, *options))
    return Unexpected(in_words_of_addresses(*refused));
  if (const auto missing = missing_in(question.store, *options))
    return Unexpected(in_words_of_addresses(*missing));
  auto figure = made(*kind, question, *options);
  if (!figure) return nothing_or_error(figure.error());
  if (ending == ".csv") return Answer{.type = kCsvType, .body = std::move(figure->csv)};
  return Answer{.type = kSvgType, .body = std::move(figure->svg)};
}

Expected<Answer> comparison_answer(const Question& question) {
  const bool is_of_pairs = question.id == "pairs.csv";
  const bool is_matrix = question.id == "matrix";
  if (!is_of_pairs && !is_matrix && question.id != "groups.csv")
    return unexpected(ErrorKind::NotFound, "there are matrix, pairs.csv and groups.csv",
                      question.id);
  const auto by = word_of(question, "by", {"source", "method", "mission"});
  if (!by) return Unexpected(by.error());
  ComparisonOptions options;
  if (*by == "method" || is_matrix) options.by = CompareBy::Method;
  if (*by == "mission") options.by = CompareBy::Mission;
  if (!question.text("mission").empty()) options.missions.push_back(question.text("mission"));
  const auto comparison = compare(question.store, options);
  if (!comparison) return nothing_or_error(comparison.error());
  if (is_matrix) {
    return json_answer(answer_object()
                           .add("per", name_of(comparison->unit))
                           .add("said", comparison->said)
                           .add("matrices", matrices_json(*comparison))
                           .add("notes", matrix_notes(*comparison)));
  }
  if (is_of_pairs && comparison->pairs.empty()) {
    std::string why;
    for (const std::string& note : comparison->notes)
      why += (why.empty() ? "" : "; ") + note;
    return json_answer(answer_object().add("nothing", why));
  }
  return Answer{.type = kCsvType,
                .body = is_of_pairs ? pairs_csv(*comparison) : groups_csv(*comparison)};
}

}  // namespace swarmsmith::cli
