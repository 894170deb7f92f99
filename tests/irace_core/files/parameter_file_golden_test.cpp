#include <filesystem>
#include <map>

#include "base/overloaded.h"
#include "irace_core/files/expression_text.h"
#include "irace_core/files/parameter_file.h"
#include "tests/irace_core/files/golden_files.h"
#include "tests/irace_core/golden.h"
#include "tests/support/checks.h"

namespace swarmsmith {
namespace {

using namespace swarmsmith::testing;

Expected<ParameterFile> read(const std::string& name) {
  return parse_parameter_file({.parameters = golden_text("parameters/" + name + ".txt"),
                               .forbidden = {},
                               .dependency = {},
                               .digits = {},
                               .refuse_doubled_operators = true});
}

char type_of(const Domain& domain) {
  return std::visit(
      Overloaded{[](const Categorical&) { return 'c'; }, [](const Ordinal&) { return 'o'; },
                 [](const Integer&) { return 'i'; }, [](const Real&) { return 'r'; }},
      domain);
}

Expression parsed(const std::string& text, const std::vector<std::string>& names) {
  std::vector<Error> warnings;
  auto expression = parse_expression(text, names, ExpressionUse::Value, {}, warnings);
  if (!expression) throw std::runtime_error(text + ": " + to_string(expression.error()));
  return *expression;
}

/// Compares the domain with R's: values, numbers, or expressions as text.
struct DomainComparison {
  const nlohmann::json& wanted;
  const std::vector<std::string>& names;

  void operator()(const Categorical& domain) const {
    EXPECT_EQ(domain.values, as_vector<std::string>(wanted));
  }
  void operator()(const Ordinal& domain) const {
    EXPECT_EQ(domain.values, as_vector<std::string>(wanted));
  }
  void operator()(const Integer& domain) const { bounds(domain.lower, domain.upper, domain.log); }
  void operator()(const Real& domain) const { bounds(domain.lower, domain.upper, domain.log); }

  void bounds(const Bound& lower, const Bound& upper, bool) const {
    bound(lower, wanted[0]);
    bound(upper, wanted[1]);
  }
  void bound(const Bound& ours, const nlohmann::json& theirs) const {
    if (theirs.is_number()) {
      EXPECT_EQ(std::get<double>(ours), theirs.get<double>());
      return;
    }
    const Expression expression = parsed(theirs, names);
    if (const double* number = std::get_if<double>(&ours)) {
      EXPECT_EQ(*number, expression.to_number({}));
    } else {
      EXPECT_EQ(std::get<Expression>(ours), expression);
    }
  }
};

void compare(const ParameterSpace& space, std::size_t i, const nlohmann::json& wanted,
             const std::vector<std::string>& names) {
  const Parameter& parameter = space[i];
  SCOPED_TRACE(parameter.name);
  EXPECT_EQ(parameter.name, wanted["name"].get<std::string>());
  EXPECT_EQ(std::string(1, type_of(parameter.domain)), wanted["type"].get<std::string>());
  EXPECT_EQ(parameter.switch_text, wanted["switch"].get<std::string>());
  EXPECT_EQ(space.is_fixed(i), wanted["fixed"].get<bool>());
  EXPECT_EQ(space.constant_interval(i) == nullptr, wanted["dependent_domain"].get<bool>());
  EXPECT_EQ(space.level(i), wanted["level"].get<int>());
  std::visit(DomainComparison{wanted["domain"], names}, parameter.domain);
  bool log = false;
  if (const auto* whole = std::get_if<Integer>(&parameter.domain)) log = whole->log;
  if (const auto* real = std::get_if<Real>(&parameter.domain)) {
    log = real->log;
    EXPECT_EQ(space.digits(), wanted["digits"].get<int>());
  }
  EXPECT_EQ(log, wanted["log"].get<bool>());
  ASSERT_EQ(parameter.condition.has_value(), !wanted["condition"].is_null());
  if (parameter.condition) {
    EXPECT_EQ(*parameter.condition, parsed(wanted["condition"], names));
  }

  std::vector<std::string> mentioned;
  const auto mention = [&mentioned](const Expression& expression) {
    for (const std::string& name : expression.names()) {
      if (!std::count(mentioned.begin(), mentioned.end(), name)) mentioned.push_back(name);
    }
  };
  const auto mention_bounds = [&mention](const auto& numeric) {
    for (const Bound* bound : {&numeric.lower, &numeric.upper}) {
      if (const auto* expression = std::get_if<Expression>(bound)) mention(*expression);
    }
  };
  if (const auto* whole = std::get_if<Integer>(&parameter.domain)) mention_bounds(*whole);
  if (const auto* real = std::get_if<Real>(&parameter.domain)) mention_bounds(*real);
  if (parameter.condition) mention(*parameter.condition);
  EXPECT_EQ(mentioned, as_vector<std::string>(wanted["depends_on"]));
}

TEST(ParameterFileGolden, ReadsWhatRReadsToTheSameStructure) {
  int read_files = 0;
  const nlohmann::json files = golden("parameters.json");
  for (const auto& [name, wanted] : files.items()) {
    if (!wanted["valid"].get<bool>()) continue;
    SCOPED_TRACE(name);
    ++read_files;
    const auto file = value_of(read(name));
    const ParameterSpace& space = file.space;
    ASSERT_EQ(space.size(), wanted["n_parameters"].get<std::size_t>());
    EXPECT_EQ(space.variable_count(), wanted["n_variable"].get<int>());
    std::vector<std::string> names;
    std::vector<std::string> order;
    for (const Parameter& parameter : space.parameters())
      names.push_back(parameter.name);
    for (const std::size_t i : space.hierarchy_order())
      order.push_back(names[i]);
    EXPECT_EQ(order, as_vector<std::string>(wanted["sampling_order"]));
    for (std::size_t i = 0; i < space.size(); ++i)
      compare(space, i, wanted["parameters"][i], names);
    const auto forbidden = as_vector<std::string>(wanted["forbidden"]);
    ASSERT_EQ(space.forbidden().size(), forbidden.size());
    for (std::size_t i = 0; i < forbidden.size(); ++i)
      EXPECT_EQ(space.forbidden()[i], parsed(forbidden[i], names));
    // One file has blanks before a comma, behind quotes: no reason to warn.
    EXPECT_TRUE(file.warnings.empty()) << file.warnings.front();
  }
  EXPECT_EQ(read_files, 18);
}

TEST(ParameterFileGolden, RefusesWhatRRefusesForTheSameReason) {
  const std::map<std::string, std::string> reasons = {
      {"e01_bad_type", "1:10: expected the type and a blank after it"},
      {"e02_no_quotes", "1:3: expected the switch in double quotes"},
      {"e03_duplicate_name", "2:1: there is a parameter 'a' above already"},
      {"e04_lower_ge_upper", "1:1: parameter 'a', domain (5,5): the lower bound must be below"},
      {"e05_real_lower_gt_upper", "1:1: parameter 'a', domain (2.0,1.0): the lower bound must be"},
      {"e06_int_nonint", "1:1: parameter 'a', domain (1.5, 4): the bound 1.5 is not a whole"},
      {"e07_log_nonpositive", "1:1: parameter 'a', domain (0, 1): a logarithmic bound must be pos"},
      {"e08_dup_values", "1:1: parameter 'a', domain (x,y,x): the value 'x' occurs twice"},
      {"e09_cycle", "domain (1,5): depends on itself, by its condition or domain or through"},
      {"e10_undefined_in_condition", "1:16: there is no parameter 'zz'"},
      {"e11_three_bounds",
       "1:9: expected two bounds with a comma between them, found 3 in (1,5,9)"},
      {"e12_missing_paren", "1:8: expected the domain in parentheses, found \"1,5\""},
      {"e13_no_pipe", "1:14: expected '|' before the condition, found \"b > 1\""},
      {"e14_empty_condition", "1:15: expected a condition after '|', found the end of the line"},
      {"e15_empty_file", "1:1: the file has no parameter"},
      {"e16_digits", "the bound 0.00001 does not fit digits = 4; it needs digits = 5"},
      {"e17_forbidden_unknown", "3:1: there is no parameter 'zz'"},
      {"e18_global_unknown", "3:1: expected an option of [global]"},
      {"e19_digits_range", "3:1: expected digits = a whole number from 1 to 15"},
      {"e20_dep_nonnumeric", "2:1: parameter 'a', domain (1, m): a bound depends on 'm', which is"},
      {"e21_dep_unsupported_fn", "2:1: parameter 'a', domain (0, \"exp(p)\"): a bound may use + -"},
      {"e22_dep_log", "2:1: parameter 'a', domain (0.1, p): a logarithmic domain must not depend"},
      {"e23_ordinal_decreasing", "1:1: parameter 'a', domain (3,2,1): the values of an ordinal"},
      {"e24_bad_condition_syntax", "1:20: found the end, expected a value, a name or '('"},
      {"e25_bad_name", "1:1: expected a parameter's name (letters, digits, '_' and '.')"},
      {"e26_dep_undefined", "1:12: there is no parameter 'zz'"},
      {"e27_space_in_type", "1:6: expected the type and a blank after it"},
      {"e28_self_cycle", "1:1: parameter 'a', domain (1,5): depends on itself"},
      {"e29_sections_only", "1:1: the file has no parameter"},
      {"e30_andand_in_condition", "2:25: found '&&': write '&', as irace needs it"},
  };
  std::size_t refused = 0;
  const nlohmann::json files = golden("parameters.json");
  for (const auto& [name, wanted] : files.items()) {
    if (wanted["valid"].get<bool>()) continue;
    SCOPED_TRACE(name + ", R says: " + wanted["error"].get<std::string>());
    ++refused;
    const Error file = why_not(read(name));
    EXPECT_EQ(file.kind, ErrorKind::BadInput);
    ASSERT_EQ(reasons.count(name), 1U);
    EXPECT_THAT(to_string(file), HasSubstr(reasons.at(name)));
    EXPECT_THAT(file.where, HasSubstr(name + ".txt:"));
  }
  EXPECT_EQ(refused, reasons.size());
}

}  // namespace
}  // namespace swarmsmith
