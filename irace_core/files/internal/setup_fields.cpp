#include "irace_core/files/internal/setup_fields.h"

#include <array>
#include <optional>
#include <type_traits>
#include <utility>

namespace swarmsmith::irace {
namespace {

constexpr std::array<std::pair<TestType, std::string_view>, 4> kTestTypes = {{
    {TestType::FTest, "F-test"},
    {TestType::TTest, "t-test"},
    {TestType::TTestHolm, "t-test-holm"},
    {TestType::TTestBonferroni, "t-test-bonferroni"},
}};
constexpr std::array<std::pair<CappingType, std::string_view>, 4> kCappingTypes = {{
    {CappingType::Median, "median"},
    {CappingType::Mean, "mean"},
    {CappingType::Worst, "worst"},
    {CappingType::Best, "best"},
}};
constexpr std::array<std::pair<BoundType, std::string_view>, 2> kBoundTypes = {{
    {BoundType::Candidate, "candidate"},
    {BoundType::Instance, "instance"},
}};
constexpr const auto& words_of(TestType) {
  return kTestTypes;
}
constexpr const auto& words_of(CappingType) {
  return kCappingTypes;
}
constexpr const auto& words_of(BoundType) {
  return kBoundTypes;
}

template <class T>
constexpr bool kIsOptional = false;
template <class T>
constexpr bool kIsOptional<std::optional<T>> = true;

template <class T>
IraceValue to_value(const T& field) {
  if constexpr (kIsOptional<T>) {
    return field ? to_value(*field) : IraceValue{};
  } else if constexpr (std::is_enum_v<T>) {
    for (const auto& [value, word] : words_of(field)) {
      if (value == field) return std::string(word);
    }
    return IraceValue{};
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    return field.string();
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    return static_cast<std::int64_t>(field);
  } else {
    return field;
  }
}

/// Converts the value to T; nothing if it is of another type.
template <class T>
std::optional<T> from_value(const IraceValue& value) {
  if constexpr (std::is_enum_v<T>) {
    const auto* text = std::get_if<std::string>(&value);
    for (const auto& [item, word] : words_of(T{})) {
      if (text != nullptr && word == *text) return item;
    }
  } else if constexpr (std::is_same_v<T, std::filesystem::path>) {
    if (const auto* text = std::get_if<std::string>(&value)) return *text;
  } else if constexpr (std::is_same_v<T, std::uint64_t>) {
    if (const auto* number = std::get_if<std::int64_t>(&value)) {
      return static_cast<std::uint64_t>(*number);
    }
  } else {
    if (const auto* same = std::get_if<T>(&value)) return *same;
    if constexpr (std::is_same_v<T, double>) {
      if (const auto* whole = std::get_if<std::int64_t>(&value)) {
        return static_cast<double>(*whole);
      }
    }
    if constexpr (std::is_same_v<T, bool>) {
      if (const auto* share = std::get_if<double>(&value)) return *share > 0;
    }
  }
  return std::nullopt;
}

template <class T>
void assign(T& field, const IraceValue& value) {
  if constexpr (kIsOptional<T>) {
    field = from_value<typename T::value_type>(value);
  } else if (auto given = from_value<T>(value)) {
    field = std::move(*given);
  }
}

/// A member of the setup or of its race.
template <auto Member>
auto& part(auto& setup) {
  if constexpr (requires { setup.*Member; }) {
    return setup.*Member;
  } else {
    return setup.race.*Member;
  }
}

template <auto Member>
constexpr SetupField field(std::string_view name) {
  return {name, [](const IraceSetup& setup) { return to_value(part<Member>(setup)); },
          [](IraceSetup& setup, const IraceValue& value) { assign(part<Member>(setup), value); }};
}

/// A field whose value is a whole number in files and a real in the race.
template <double Scenario::*Member>
constexpr SetupField whole(std::string_view name) {
  return {name,
          [](const IraceSetup& setup) {
            return IraceValue(static_cast<std::int64_t>(setup.race.*Member));
          },
          [](IraceSetup& setup, const IraceValue& value) { assign(setup.race.*Member, value); }};
}

using S = Scenario;
using I = IraceSetup;

constexpr std::array kFields = {
    field<&I::exec_dir>("execDir"),
    field<&I::parameter_file>("parameterFile"),
    field<&I::configurations_file>("configurationsFile"),
    field<&I::log_file>("logFile"),
    field<&S::sample_instances>("sampleInstances"),
    field<&S::deterministic>("deterministic"),
    field<&I::test_nb_elites>("testNbElites"),
    field<&I::test_iteration_elites>("testIterationElites"),
    field<&I::target_runner>("targetRunner"),
    field<&I::target_runner_launcher>("targetRunnerLauncher"),
    field<&I::target_cmdline>("targetCmdline"),
    field<&I::target_runner_retries>("targetRunnerRetries"),
    field<&I::target_runner_timeout>("targetRunnerTimeout"),
    field<&I::target_evaluator>("targetEvaluator"),
    field<&I::repair_configuration>("repairConfiguration"),
    field<&I::parallel>("parallel"),
    field<&I::batchmode>("batchmode"),
    field<&I::aclib>("aclib"),
    field<&S::max_experiments>("maxExperiments"),
    field<&S::min_experiments>("minExperiments"),
    whole<&S::max_time>("maxTime"),
    field<&S::budget_estimation>("budgetEstimation"),
    field<&S::min_measurable_time>("minMeasurableTime"),
    field<&I::seed>("seed"),
    field<&S::elitist>("elitist"),
    field<&S::elitist_new_instances>("elitistNewInstances"),
    field<&S::elitist_limit>("elitistLimit"),
    field<&S::test_type>("testType"),
    field<&S::confidence>("confidence"),
    field<&S::first_test>("firstTest"),
    field<&S::each_test>("eachTest"),
    field<&S::block_size>("blockSize"),
    field<&S::mu>("mu"),
    field<&S::nb_iterations>("nbIterations"),
    field<&S::nb_experiments_per_iteration>("nbExperimentsPerIteration"),
    field<&S::min_nb_survival>("minNbSurvival"),
    field<&S::nb_configurations>("nbConfigurations"),
    field<&S::soft_restart>("softRestart"),
    field<&S::soft_restart_threshold>("softRestartThreshold"),
    field<&S::postselection>("postselection"),
    field<&S::capping>("capping"),
    field<&S::capping_after_first_test>("cappingAfterFirstTest"),
    field<&S::capping_type>("cappingType"),
    field<&S::bound_type>("boundType"),
    whole<&S::bound_max>("boundMax"),
    field<&S::bound_digits>("boundDigits"),
    whole<&S::bound_par>("boundPar"),
    field<&S::bound_as_timeout>("boundAsTimeout"),
    field<&I::quiet>("quiet"),
    field<&I::debug_level>("debugLevel"),
};

}  // namespace

std::span<const SetupField> setup_fields() {
  return kFields;
}

}  // namespace swarmsmith::irace
