#include "irace_core/files/scenario_file.h"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "base/suggestion.h"
#include "base/text/whole_file.h"
#include "irace_core/files/internal/r_values.h"
#include "irace_core/files/number_text.h"
#include "irace_core/files/r_syntax.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kInclude = "include.scenario";

/// The value in the form of a command line; nothing for a missing value.
std::optional<std::string> text_of(const Scalar& scalar) {
  if (scalar.missing) return std::nullopt;
  switch (scalar.type) {
    case Scalar::Type::Text:
      return scalar.text;
    case Scalar::Type::Logical:
      return scalar.number != 0 ? "1" : "0";
    case Scalar::Type::Integer:
    case Scalar::Type::Real:
      break;
  }
  return shortest_text(scalar.number);
}

/// The value for an option. An error has no place.
Expected<IraceValue> value_for(const IraceOption& option, const r::Vector& vector) {
  if (vector.empty()) return IraceValue{};
  if (option.kind == IraceKind::Texts) {
    // "" stands for the default, as for the other options (irace facts, 23.1).
    const bool is_nothing = vector.size() == 1 &&
                            (vector.front().missing || (vector.front().type == Scalar::Type::Text &&
                                                        vector.front().text.empty()));
    if (is_nothing) return IraceValue{};
    return r::to_texts(vector);
  }
  if (vector.size() != 1) {
    return bad_input("must be a single value, found " + std::to_string(vector.size()));
  }
  const std::optional<std::string> text = text_of(vector.front());
  if (!text) return IraceValue{};
  const bool wants_text = option.is_path() || option.kind == IraceKind::Text;
  if (wants_text && vector.front().type != Scalar::Type::Text) {
    return bad_input("must be a text in quotes, found " + to_text(vector.front()));
  }
  return irace_value_of(option, *text);
}

/// Reads a file and the files that it includes.
class ScenarioReader {
 public:
  ScenarioReader(const fs::path& top, const ScenarioSurroundings& surroundings)
      : top_(top), surroundings_(surroundings) {
    environment_.environment_variable = surroundings.environment_variable;
    environment_.read = surroundings.read;
  }

  void read(std::string_view text, const fs::path& file) {
    const auto statements = r::parse_statements(text);
    if (!statements) {
      complain_about_syntax(file, statements.error());
      return;
    }
    open_.push_back(file);
    // R works in a file's folder while it reads it: source(..., chdir = TRUE).
    const fs::path before = std::exchange(environment_.folder, file.parent_path());
    for (const r::Statement& statement : *statements)
      read_statement(statement, file);
    environment_.folder = before;
    open_.pop_back();
  }

  IraceScenarioFileOrErrors take() {
    if (!errors_.empty()) return tl::unexpected(std::move(errors_));
    return std::move(result_);
  }

 private:
  /// The path of the file relative to the folder of the top file, with the place.
  std::string place(const fs::path& file, const std::string& where) const {
    const std::string name = file.lexically_proximate(top_.parent_path()).string();
    return name + (where.empty() ? "" : ":" + where);
  }

  /// Adds an error, whose `where` is line:column.
  void complain(const fs::path& file, Error error) {
    error.where = place(file, error.where);
    errors_.push_back(std::move(error));
  }
  void complain(const fs::path& file, r::Place where, std::string message) {
    complain(file, {ErrorKind::BadInput, std::move(message), r::to_string(where)});
  }

  /// If a scenario cannot be read, the most frequent reason is that it contains functions of R.
  void complain_about_syntax(const fs::path& file, Error error) {
    if (error.message.find("'function'") != std::string::npos) {
      error.message +=
          "; for targetRunner, targetEvaluator and repairConfiguration write a program (a script "
          "will do) and give its name here; leave targetRunnerParallel out: `parallel` says how "
          "many calls run at a time";
    }
    complain(file, std::move(error));
  }

  void read_statement(const r::Statement& statement, const fs::path& file) {
    if (statement.name.empty()) {
      read_call(statement, file);
    } else if (statement.name.starts_with('.')) {
      assign(statement, file);
    } else if (const IraceOption* option = find_irace_option(statement.name)) {
      read_option(*option, statement, file);
    } else {
      complain(file, statement.place,
               "there is no option `" + statement.name + "`" +
                   did_you_mean(statement.name, irace_option_names()) +
                   "; names of your own variables must begin with a dot");
    }
  }

  /// After an error the variable gets a missing value, so that expressions that use it are not
  /// reported.
  std::optional<r::Vector> assign(const r::Statement& statement, const fs::path& file) {
    auto value = r::evaluate(statement.value, environment_);
    if (!value) complain(file, value.error());
    environment_.variables[statement.name] = value.value_or(r::Vector{Scalar{}});
    return value ? std::optional(std::move(*value)) : std::nullopt;
  }

  void read_option(const IraceOption& option, const r::Statement& statement, const fs::path& file) {
    IraceValue value;
    if (option.kind == IraceKind::Anything) {
      // Any value is meant for R; only an absent value has a meaning here.
      const auto* text = std::get_if<r::Text>(&statement.value.what);
      const bool is_nothing = std::holds_alternative<r::Null>(statement.value.what) ||
                              (text != nullptr && text->value.empty());
      if (!is_nothing) value = "R";
    } else {
      const auto vector = assign(statement, file);
      if (!vector) return;
      const auto read = value_for(option, *vector);
      if (!read) {
        complain(file, statement.value.place,
                 "`" + std::string(option.name) + "` " + read.error().message);
        return;
      }
      value = *read;
    }
    if (const auto refusal = irace_refusal(option, value)) {
      complain(file, statement.place, *refusal);
      return;
    }
    const std::string where = place(file, r::to_string(statement.place));
    if (const auto remark = irace_remark(option, value)) {
      result_.warnings.push_back(where + ": " + *remark);
    }
    result_.settings.set({.option = &option,
                          .value = std::move(value),
                          .where = where,
                          .folder = top_.parent_path()});
  }

  /// The only call that has an effect as a statement is include.scenario.
  void read_call(const r::Statement& statement, const fs::path& file) {
    const auto* call = std::get_if<r::Call>(&statement.value.what);
    if (call == nullptr || call->function != kInclude) {
      const auto value = r::evaluate(statement.value, environment_);
      if (!value) return complain(file, value.error());
      return complain(file, statement.place,
                      "this value is not assigned to an option; expected `option = value` or " +
                          std::string(kInclude) + "(\"file\")");
    }
    const auto name = call->arguments.size() == 1
                          ? r::evaluate(call->arguments.front().value, environment_)
                          : Expected<r::Vector>(r::Vector{});
    if (!name) return complain(file, name.error());
    if (name->size() != 1 || name->front().missing || name->front().text.empty()) {
      return complain(file, statement.place,
                      std::string(kInclude) + " needs the name of one file, in quotes");
    }
    include(name->front().text, statement.place, file);
  }

  void include(const std::string& name, r::Place where, const fs::path& file) {
    constexpr std::size_t kMostFiles = 1000;
    const fs::path included = absolute_path(name, file.parent_path());
    if (std::ranges::find(open_, included) != open_.end()) {
      return complain(file, where, included.string() + " includes itself");
    }
    if (++files_ > kMostFiles) return complain(file, where, "includes too many files");
    const auto text = surroundings_.read(included);
    if (!text) {
      return complain(file, where,
                      "cannot include " + included.string() + ": " + text.error().message);
    }
    read(*text, included);
  }

  const fs::path& top_;
  const ScenarioSurroundings& surroundings_;
  r::Environment environment_;
  std::vector<fs::path> open_;  ///< files that are being read, the innermost last
  std::size_t files_ = 0;
  IraceScenarioFile result_;
  std::vector<Error> errors_;
};

}  // namespace

IraceScenarioFileOrErrors parse_irace_scenario(std::string_view text, const fs::path& file,
                                               const ScenarioSurroundings& surroundings) {
  ScenarioReader reader(file, surroundings);
  reader.read(text, file);
  return reader.take();
}

IraceScenarioFileOrErrors read_irace_scenario(const fs::path& file) {
  const auto text = read_whole_file(file);
  if (!text) return tl::unexpected(std::vector<Error>{text.error()});
  const auto variable = [](const std::string& name) -> std::optional<std::string> {
    const char* value = std::getenv(name.c_str());
    return value == nullptr ? std::nullopt : std::optional<std::string>(value);
  };
  return parse_irace_scenario(*text, file, {read_whole_file, variable});
}

}  // namespace swarmsmith
