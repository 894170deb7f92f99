#include "irace_core/files/parameter_file.h"

#include <algorithm>
#include <utility>

#include "base/overloaded.h"
#include "irace_core/files/forbidden_file.h"
#include "irace_core/files/internal/dependency_file.h"
#include "irace_core/files/internal/read_expression.h"
#include "irace_core/internal/check_parameter.h"
#include "irace_core/internal/rounding.h"

namespace swarmsmith {
namespace {

using irace::LineReader;
using irace::ParameterLine;

/// The parts of a parameter file; text that mentions other parameters is not parsed yet.
struct Parts {
  std::vector<ParameterLine> parameters;
  std::vector<LineReader> forbidden;
  std::optional<int> digits;
};

enum class Section { Parameters, Forbidden, Global };

/// The section that a line `[name]` begins; nothing for any other line.
Expected<std::optional<Section>> read_section(const LineReader& line) {
  if (line.rest().front() != '[') return std::nullopt;
  constexpr std::pair<std::string_view, Section> kSections[] = {{"[forbidden]", Section::Forbidden},
                                                                {"[global]", Section::Global}};
  for (const auto& [title, section] : kSections) {
    if (line.rest().substr(0, title.size()) != title) continue;
    LineReader behind = line;
    behind.advance(title.size());
    if (!behind.at_comment_or_end()) return behind.expected("the end of the line");
    return section;
  }
  return line.expected("[forbidden] or [global]");
}

/// Reads `digits = 4`, which is the only option.
Expected<int> read_option(const LineReader& line) {
  const auto statements = r::parse_statements(line.rest());
  if (!statements || statements->size() != 1 || statements->front().name != "digits") {
    return line.expected(
        "an option of [global]; the only one is 'digits = 4', and parameters come before the "
        "sections");
  }
  const auto* number = std::get_if<r::Number>(&statements->front().value.what);
  const double value = number == nullptr ? 0 : number->value;
  for (int digits = 1; digits <= 15; ++digits) {
    if (value == digits) return digits;
  }
  return line.expected("digits = a whole number from 1 to 15");
}

Expected<Parts> cut(const IraceText& source) {
  Parts parts;
  Section section = Section::Parameters;
  std::size_t number = 0;
  for (const std::string_view text : irace::split_lines(source.text)) {
    LineReader line(source.file, text, ++number);
    if (line.at_comment_or_end()) continue;
    const auto begun = read_section(line);
    if (!begun) return Unexpected(begun.error());
    if (*begun) {
      section = **begun;
    } else if (section == Section::Forbidden) {
      parts.forbidden.push_back(line);
    } else if (section == Section::Global) {
      auto digits = read_option(line);
      if (!digits) return Unexpected(digits.error());
      parts.digits = *digits;
    } else {
      auto parameter = read_parameter_line(line);
      if (!parameter) return Unexpected(parameter.error());
      parts.parameters.push_back(std::move(*parameter));
    }
  }
  if (parts.parameters.empty()) {
    return bad_input("the file has no parameter", source.file + ":1:1");
  }
  return parts;
}

/// Reads the parts into a space; holds the data that all steps need.
class Builder {
 public:
  explicit Builder(const ParameterSources& sources)
      : sources_(sources), file_(sources.parameters.file) {}

  Expected<ParameterFile> build();

 private:
  Expected<void> collect_names();
  Expected<Parameter> read_parameter(const ParameterLine& line);
  template <class Numeric>
  Expected<Domain> read_numeric(const ParameterLine& line);
  void round_bound(Bound& bound, const ParameterLine& line);
  Expected<std::vector<Expression>> read_forbidden();
  /// The error of the space, with the place of the parameter that it names.
  Error placed(Error error) const;

  const ParameterSources& sources_;
  const std::string& file_;
  Parts parts_;
  std::vector<std::string> names_;
  std::vector<Error> warnings_;
};

Expected<void> Builder::collect_names() {
  for (const ParameterLine& line : parts_.parameters) {
    if (std::find(names_.begin(), names_.end(), line.name.text) != names_.end()) {
      return bad_input("there is a parameter '" + line.name.text + "' above already",
                       file_ + ":" + r::to_string(line.name.place));
    }
    names_.push_back(line.name.text);
  }
  return {};
}

/// irace 3.5 rounds the bounds of reals to its option digits; irace 4 requires bounds that fit.
/// Bounds that irace 4 accepts stay unchanged.
void Builder::round_bound(Bound& bound, const ParameterLine& line) {
  double* value = std::get_if<double>(&bound);
  if (value == nullptr || !sources_.digits || parts_.digits) return;
  if (irace::fits_digits(*value, *sources_.digits)) return;
  const double rounded = irace::round_to_digits(*value, *sources_.digits);
  warnings_.push_back({ErrorKind::BadInput,
                       "the bound " + exact_text(*value) + " of '" + line.name.text +
                           "' is rounded to " + exact_text(rounded) +
                           ", for digits = " + std::to_string(*sources_.digits),
                       file_ + ":" + r::to_string(line.domain.place)});
  *value = rounded;
}

template <class Numeric>
Expected<Domain> Builder::read_numeric(const ParameterLine& line) {
  auto bounds = irace::read_bounds(line.domain, file_, names_, warnings_);
  if (!bounds) return Unexpected(bounds.error());
  if constexpr (std::is_same_v<Numeric, Real>) {
    round_bound(bounds->first, line);
    round_bound(bounds->second, line);
  }
  return Numeric{std::move(bounds->first), std::move(bounds->second), line.log};
}

Expected<Parameter> Builder::read_parameter(const ParameterLine& line) {
  Expected<Domain> domain = Categorical{};
  if (line.type == 'i') {
    domain = read_numeric<Integer>(line);
  } else if (line.type == 'r') {
    domain = read_numeric<Real>(line);
  } else {
    auto values = irace::read_choices(line.domain, file_, warnings_);
    if (!values) return Unexpected(values.error());
    if (line.type == 'o') {
      domain = Ordinal{std::move(*values)};
    } else {
      domain = Categorical{std::move(*values)};
    }
  }
  if (!domain) return Unexpected(domain.error());
  Parameter parameter{line.name.text, line.switch_text, std::move(*domain), {}};
  if (line.condition.text.empty()) return parameter;
  const ExpressionUse use =
      sources_.refuse_doubled_operators ? ExpressionUse::Value : ExpressionUse::Forbidden;
  auto condition = irace::read_expression(line.condition, file_, names_, use, warnings_);
  if (!condition) return Unexpected(condition.error());
  if (condition->operands().empty() && condition->name().empty()) {
    const Values value = condition->evaluate({});
    if (value.type() != Scalar::Type::Logical) {
      return bad_input("the condition of '" + line.name.text + "' is " + to_text(value[0]) +
                           ", which is neither TRUE nor FALSE; write a comparison, such as "
                           "algorithm == \"as\"",
                       file_ + ":" + r::to_string(line.condition.place));
    }
  }
  parameter.condition = std::move(*condition);
  return parameter;
}

Expected<std::vector<Expression>> Builder::read_forbidden() {
  std::vector<Expression> clauses;
  for (const LineReader& line : parts_.forbidden) {
    auto clause = irace::read_forbidden_line({std::string(line.rest()), line.place()}, file_,
                                             names_, warnings_);
    if (!clause) return Unexpected(clause.error());
    clauses.push_back(std::move(*clause));
  }
  if (!sources_.forbidden) return clauses;
  auto more = parse_forbidden_file(*sources_.forbidden, names_, warnings_);
  if (!more) return Unexpected(more.error());
  std::move(more->begin(), more->end(), std::back_inserter(clauses));
  return clauses;
}

Error Builder::placed(Error error) const {
  const auto found = std::find(names_.begin(), names_.end(), error.where);
  if (found == names_.end()) {
    error.where = file_ + (error.where.empty() ? "" : ": " + error.where);
    return error;
  }
  const auto& line = parts_.parameters[static_cast<std::size_t>(found - names_.begin())];
  error.message =
      "parameter '" + error.where + "', domain (" + line.domain.text + "): " + error.message;
  error.where = file_ + ":" + r::to_string(line.name.place);
  return error;
}

Expected<ParameterFile> Builder::build() {
  auto parts = cut(sources_.parameters);
  if (!parts) return Unexpected(parts.error());
  parts_ = std::move(*parts);
  if (auto named = collect_names(); !named) return Unexpected(named.error());
  std::vector<Parameter> parameters;
  for (const ParameterLine& line : parts_.parameters) {
    auto parameter = read_parameter(line);
    if (!parameter) return Unexpected(parameter.error());
    parameters.push_back(std::move(*parameter));
  }
  if (sources_.dependency) {
    auto applied = irace::apply_dependency_file(*sources_.dependency, parameters, warnings_);
    if (!applied) return Unexpected(applied.error());
  }
  auto forbidden = read_forbidden();
  if (!forbidden) return Unexpected(forbidden.error());
  const int digits = parts_.digits.value_or(sources_.digits.value_or(4));
  auto space = ParameterSpace::make(std::move(parameters), std::move(*forbidden), digits);
  if (!space) return Unexpected(placed(std::move(space.error())));
  ParameterFile file{std::move(*space), {}};
  for (const Error& warning : warnings_)
    file.warnings.push_back(to_string(warning));
  return file;
}

}  // namespace

Expected<ParameterFile> parse_parameter_file(const ParameterSources& sources) {
  return Builder(sources).build();
}

}  // namespace swarmsmith
