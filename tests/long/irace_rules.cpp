// The rules of irace on cases from the standard input, for a comparison with R itself.
//
//   irace_rules < CASES
//
// Each line is a case: kind, then what the kind takes, separated by blanks. Prints a line a case:
// numbers (or one text) separated by blanks, NA for what is undefined. against_r.R answers the
// same.

#include <cmath>
#include <cstdio>
#include <functional>
#include <iostream>
#include <limits>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/ranks.h"
#include "base/rng.h"
#include "base/special_functions.h"
#include "irace_core/expression.h"
#include "irace_core/files/expression_text.h"
#include "irace_core/internal/agreement.h"
#include "irace_core/internal/elimination.h"
#include "irace_core/internal/model.h"
#include "irace_core/internal/ranking.h"
#include "irace_core/internal/ranks.h"
#include "irace_core/internal/rounding.h"
#include "irace_core/internal/schedule.h"

namespace swarmsmith {
namespace {

using namespace irace;

/// Words of a case.
class Case {
 public:
  explicit Case(const std::string& line) : words_(line) {}

  std::string word() {
    std::string text;
    if (!(words_ >> text)) throw std::runtime_error("a case is too short");
    return text;
  }
  double number() {
    const std::string text = word();
    return text == "NA" ? std::numeric_limits<double>::quiet_NaN() : std::stod(text);
  }
  std::int64_t whole() { return static_cast<std::int64_t>(number()); }
  std::size_t count() { return static_cast<std::size_t>(whole()); }
  std::vector<double> numbers(std::size_t n) {
    std::vector<double> values(n);
    for (double& value : values)
      value = number();
    return values;
  }
  /// The rest, without the blank before it.
  std::string rest() {
    std::string text;
    std::getline(words_ >> std::ws, text);
    return text;
  }

 private:
  std::istringstream words_;
};

std::string text_of(double value) {
  if (std::isnan(value)) return "NA";
  char buffer[40];
  const int size = std::snprintf(buffer, sizeof buffer, "%.17g", value);
  return {buffer, static_cast<std::size_t>(size)};
}

std::string text_of(const std::vector<double>& values) {
  std::string text;
  for (const double value : values)
    text += (text.empty() ? "" : " ") + text_of(value);
  return text;
}

TestType test_type(const std::string& word) {
  if (word == "none") return TestType::TTest;
  if (word == "bonferroni") return TestType::TTestBonferroni;
  if (word == "holm") return TestType::TTestHolm;
  return TestType::FTest;
}

/// Costs by column, n of them.
struct Costs {
  Costs(Case& input, std::size_t n, std::size_t k) : columns(k, std::vector<double>(n)) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t j = 0; j < k; ++j)
        columns[j][i] = input.number();
    }
    for (std::size_t j = 0; j < k; ++j)
      all.push_back(j);
  }
  RankTable ranked() const {
    RankTable table(columns.size());
    for (std::size_t i = 0; i < columns.front().size(); ++i)
      table.add_row(row(i));
    return table;
  }
  std::vector<Entry> row(std::size_t i) const {
    std::vector<Entry> entries;
    for (std::size_t j = 0; j < columns.size(); ++j)
      entries.push_back({columns[j][i], static_cast<std::uint32_t>(j)});
    return entries;
  }
  std::vector<std::vector<double>> columns;
  std::vector<std::size_t> all;
};

/// type confidence n k costs -> p-value, then 1 for each column that is kept.
std::string eliminate(Case& input) {
  const TestType type = test_type(input.word());
  const double alpha = 1 - input.number();
  const std::size_t n = input.count();
  const std::size_t k = input.count();
  const Costs costs(input, n, k);
  std::vector<double> kept(k, 1);
  double p = 1;
  if (type == TestType::FTest && k == 2) {
    const PairedResult result = wilcoxon_test(costs.columns[0], costs.columns[1], alpha);
    kept = {result.drops_first ? 0.0 : 1.0, result.drops_second ? 0.0 : 1.0};
    p = result.p_value;
  } else {
    TestResult result;
    if (type == TestType::FTest) {
      StudentQuantiles quantiles(alpha / 2);
      result = friedman_test(costs.ranked(), costs.all, alpha, quantiles);
    } else {
      std::vector<std::span<const double>> spans(costs.columns.begin(), costs.columns.end());
      std::vector<double> means;
      for (const auto& column : costs.columns) {
        double sum = 0;
        for (const double cost : column)
          sum += cost;
        means.push_back(sum / static_cast<double>(n));
      }
      result = paired_t_tests(spans, means, costs.all, alpha, type);
    }
    for (const std::size_t column : result.dropped)
      kept[column] = 0;
    p = result.p_value;
  }
  return text_of(p) + " " + text_of(kept);
}

/// n k costs -> Kendall's W, Spearman's rho, Qvar.
std::string agreement(Case& input) {
  const std::size_t n = input.count();
  const std::size_t k = input.count();
  const Costs costs(input, n, k);
  const RankTable table = costs.ranked();
  QualityVariance variance(k);
  for (std::size_t i = 0; i < n; ++i)
    variance.add_row(costs.row(i));
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  return text_of({kendall_w(table, costs.all).value_or(nothing),
                  spearman_rho(table, costs.all).value_or(nothing),
                  variance.value(costs.all).value_or(nothing)});
}

/// type n k costs, NA for not evaluated -> ranks.
std::string overall(Case& input) {
  const TestType type = test_type(input.word());
  const std::size_t n = input.count();
  const std::size_t k = input.count();
  return text_of(overall_ranks(Costs(input, n, k).columns, type));
}

/// budget iteration mu each_test elites old new -> configurations of the race.
std::string race_size_of(Case& input) {
  const auto v = input.numbers(7);
  const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(v[i]); };
  return std::to_string(race_size({.budget = whole(0),
                                   .iteration = whole(1),
                                   .mu = whole(2),
                                   .pairs_between_tests = whole(3),
                                   .elites = whole(4),
                                   .old_pairs = whole(5),
                                   .new_pairs = whole(6)}));
}

/// elitist iterations survivors mu each_test new -> smallest budget.
std::string smallest_budget(Case& input) {
  const auto v = input.numbers(6);
  const auto whole = [&](std::size_t i) { return static_cast<std::int64_t>(v[i]); };
  return std::to_string(minimum_budget({.elitist = v[0] != 0,
                                        .iterations = whole(1),
                                        .min_survival = whole(2),
                                        .mu = whole(3),
                                        .pairs_between_tests = whole(4),
                                        .new_pairs = whole(5)}));
}

/// elitist iteration iterations parameters chosen k p1 ... pk -> probabilities.
std::string update(Case& input) {
  const bool elitist = input.whole() != 0;
  const std::int64_t iteration = input.whole();
  const std::int64_t iterations = input.whole();
  const auto parameters = static_cast<int>(input.whole());
  const std::size_t chosen = input.count() - 1;
  std::vector<double> probabilities = input.numbers(input.count());
  const UpdateStrength strength = update_strength(iteration, iterations, 10, parameters, elitist);
  update_probabilities(probabilities, chosen, strength);
  return text_of(probabilities);
}

/// One parameter, the model's mean a value of it, its standard deviation a fraction of the first
/// one: type lower upper value fraction draws seed -> how many draws fell into each value of a
/// choice or integer, or into each eighth of a real's domain.
std::string draws(Case& input) {
  const std::string type = input.word();
  const double lower = input.number();
  const double upper = input.number();
  const double value = input.number();
  const double fraction = input.number();
  const std::int64_t n = input.whole();
  Rng rng(static_cast<std::uint64_t>(input.whole()));
  Parameter parameter{"x", "", Real{lower, upper, type == "r,log"}, {}};
  const bool is_real = type.front() == 'r';
  if (type == "i" || type == "i,log") parameter.domain = Integer{lower, upper, type == "i,log"};
  if (type == "o") {
    Ordinal choices;
    for (double i = lower; i <= upper; ++i)
      choices.values.push_back(to_fixed_text(i));
    parameter.domain = choices;
  }
  const ParameterSpace space = ParameterSpace::make({parameter}).value();
  Configuration elite(1);
  elite.set(0, type == "o" ? value - lower : value);
  const EliteLine line{.id = 1, .parent = 0, .configuration = &elite};
  SamplingModels models(space);
  models.initialise({&line, 1});
  models.update({&line, 1}, {.fraction = 0, .shrink = fraction, .most = 1});
  const double step = is_real ? (upper - lower) / 8 : 1;
  std::vector<double> counts(is_real ? 8 : static_cast<std::size_t>(upper - lower) + 1, 0);
  for (std::int64_t i = 0; i < n; ++i) {
    const double drawn = models.sample(1, rng).value()[0];
    const double from_lower = type == "o" ? drawn : (drawn - lower) / step;
    counts[std::min(counts.size() - 1, static_cast<std::size_t>(from_lower))] += 1;
  }
  return text_of(counts);
}

/// a b c d as expressions' variables (a, b text or NA; c integer, d real), then an expression.
std::string expression(Case& input) {
  std::vector<Scalar> values;
  for (int i = 0; i < 2; ++i) {
    const std::string text = input.word();
    values.push_back(text == "NA" ? Scalar::missing_of(Scalar::Type::Text) : Scalar::of_text(text));
  }
  const double whole = input.number();
  const double real = input.number();
  values.push_back(std::isnan(whole) ? Scalar::missing_of(Scalar::Type::Integer)
                                     : Scalar::integer(whole));
  values.push_back(std::isnan(real) ? Scalar::missing_of(Scalar::Type::Real) : Scalar::real(real));
  const std::string text = input.rest();
  const std::vector<std::string> names = {"a", "b", "c", "d"};
  std::vector<Error> warnings;
  auto parsed = parse_expression(text, names, ExpressionUse::Value, {}, warnings);
  if (!parsed) return "error: " + to_string(parsed.error());
  if (const auto bound = parsed->bind(names); !bound) return "error: " + to_string(bound.error());
  const Values result = parsed->evaluate(values);
  if (result.size() != 1 || result[0].missing) return "NA";
  return result[0].type == Scalar::Type::Text ? result[0].text : text_of(result[0].number);
}

using Rule = std::function<std::string(Case&)>;

const std::map<std::string, Rule>& rules() {
  static const std::map<std::string, Rule> kRules = {
      {"eliminate", eliminate},
      {"agreement", agreement},
      {"overall", overall},
      {"size", race_size_of},
      {"minimum", smallest_budget},
      {"update", update},
      {"draws", draws},
      {"expression", expression},
      {"rank",
       [](Case& input) { return text_of(average_ranks(input.numbers(input.count())).ranks); }},
      {"round",
       [](Case& input) {
         const auto digits = static_cast<int>(input.whole());
         return text_of(round_to_digits(input.number(), digits));
       }},
      {"text", [](Case& input) { return to_fixed_text(input.number()); }},
      {"adjust",
       [](Case& input) {
         const TestType type = test_type(input.word());
         return text_of(adjusted(input.numbers(input.count()), type));
       }},
  };
  return kRules;
}

}  // namespace
}  // namespace swarmsmith

int main() {
  std::string line;
  while (std::getline(std::cin, line)) {
    swarmsmith::Case input(line);
    std::puts(swarmsmith::rules().at(input.word())(input).c_str());
  }
  return 0;
}
