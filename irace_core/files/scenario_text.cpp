#include "irace_core/files/scenario_text.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>

#include "irace_core/files/internal/setup_fields.h"
#include "irace_core/files/options.h"

namespace swarmsmith {
namespace {

/// Options that irace 3.5 does not have (irace facts, 26).
constexpr std::array<std::string_view, 5> kNewIn4 = {
    "blockSize", "targetRunnerTimeout", "minExperiments", "targetCmdline", "cappingAfterFirstTest"};
/// Options with a different default in irace 3.5; they are always written for it.
constexpr std::array<std::string_view, 3> kOtherDefaultIn35 = {"softRestartThreshold", "capping",
                                                               "budgetEstimation"};

bool contains(const auto& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

class Printer {
 public:
  Printer(const IraceSetup& setup, IraceVersion version, const IraceFileNames& names)
      : setup_(setup), version_(version), names_(names) {}

  IraceScenarioText print() {
    print_files();
    for (const irace::SetupField& field : irace::setup_fields())
      print_option(field);
    if (version_ == IraceVersion::V3_5) print_what_only_35_has();
    return std::move(result_);
  }

 private:
  void line(std::string_view name, const IraceValue& value) {
    result_.text += std::string(name) + " = " + irace_value_text(value) + "\n";
  }

  void print_files() {
    // This line is also written if the name is empty, which means no log; without it there would be
    // one.
    line("logFile", setup_.log_file.string());
    line("parameterFile", names_.parameters);
    // Without this line, irace 3.5 would put ./Instances before every instance.
    line("trainInstancesDir", names_.training_folder);
    line("trainInstancesFile", names_.training);
    if (!names_.test.empty()) line("testInstancesFile", names_.test);
    if (!names_.configurations.empty()) line("configurationsFile", names_.configurations);
  }

  void print_option(const irace::SetupField& field) {
    const bool is_file = field.name == "parameterFile" || field.name == "configurationsFile" ||
                         field.name == "logFile";
    const IraceValue value = field.get(setup_);
    const bool is_default = value == field.get(defaults_);
    const bool is_35 = version_ == IraceVersion::V3_5;
    const bool always = is_35 && contains(kOtherDefaultIn35, field.name);
    if (is_file || (is_default && !always)) return;
    if (field.name == "repairConfiguration") {
      remark(field.name, "is left out: it is a program here, and a function of R there");
    } else if (is_35 && field.name == "postselection") {
      // If it is left out, it is off in 3.5.
    } else if (is_35 && contains(kNewIn4, field.name)) {
      if (field.name != "targetCmdline" || !print_launcher_arguments()) {
        remark(field.name, "does not exist in irace 3.5");
      }
    } else if (field.name == "capping") {
      line(field.name, uses_capping(setup_.race));
    } else {
      line(field.name, value);
    }
  }

  /// Converts the template of irace 4 to irace 3.5's, where one word means all arguments; false if
  /// this is not possible.
  bool print_launcher_arguments() {
    std::string line_of_35 = setup_.target_cmdline;
    const std::size_t place = line_of_35.find(defaults_.target_cmdline);
    if (setup_.target_runner_launcher.empty() || place == std::string::npos) return false;
    line_of_35.replace(place, defaults_.target_cmdline.size(), "{targetRunnerArgs}");
    line("targetRunnerLauncherArgs", line_of_35);
    return true;
  }

  void print_what_only_35_has() {
    line("digits", std::int64_t{setup_.space.digits()});
    if (!names_.forbidden.empty()) line("forbiddenFile", names_.forbidden);
    if (setup_.race.postselection) {
      remark("postselection", "is left out: irace 3.5 has no last race with the remaining budget");
    }
  }

  void remark(std::string_view option, std::string_view sentence) {
    result_.remarks.push_back("`" + std::string(option) + "` " + std::string(sentence));
  }

  const IraceSetup& setup_;
  IraceVersion version_;
  const IraceFileNames& names_;
  const IraceSetup defaults_;
  IraceScenarioText result_;
};

}  // namespace

IraceScenarioText print_irace_scenario(const IraceSetup& setup, IraceVersion version,
                                       const IraceFileNames& names) {
  return Printer(setup, version, names).print();
}

std::vector<std::pair<std::string, std::string>> irace_options(const IraceSetup& setup) {
  std::vector<std::pair<std::string, std::string>> options;
  for (const irace::SetupField& field : irace::setup_fields()) {
    const IraceValue value = field.get(setup);
    if (std::holds_alternative<std::monostate>(value)) continue;
    if (field.name == "boundMax" && setup.race.bound_max == 0) continue;
    const auto* truth = std::get_if<bool>(&value);
    options.emplace_back(field.name, truth == nullptr ? irace_value_text(value)
                                     : *truth         ? "TRUE"
                                                      : "FALSE");
  }
  return options;
}

}  // namespace swarmsmith
