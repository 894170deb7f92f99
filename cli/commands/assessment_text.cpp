#include "cli/commands/assessment_text.h"

#include <fmt/format.h>

#include <optional>

#include "base/text/json.h"

namespace swarmsmith::cli {
namespace {

using assessment::Check;
using assessment::ModuleReport;
using assessment::Rate;
using assessment::Report;
using assessment::Subject;

constexpr std::size_t kColumns = 100;

std::string without_trailing_blanks(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line + "\n";
}

std::string check_line(std::string_view module, const Check& check) {
  return without_trailing_blanks(
      fmt::format("{:<24}  {:<22}  {:>4}  {:<7}  {:<20}  {}", module, check.setting, check.runs,
                  check.passes ? "passes" : "FAILS", check.measured, check.expected));
}

std::string rate_line(std::string_view module, const Rate& rate) {
  const bool measured = rate.trials > 0;
  const auto trials = static_cast<double>(rate.trials);
  const bool outside = rate.expected < rate.low || rate.expected > rate.high;
  return without_trailing_blanks(fmt::format(
      "{:<24}  {:<22}  {:>6}  {:>8}  {:<16}  {:.4f}{}", module, rate.setting, rate.trials,
      measured ? fmt::format("{:.4f}", static_cast<double>(rate.firings) / trials) : "-",
      measured ? fmt::format("{:.4f} to {:.4f}", rate.low, rate.high) : "-", rate.expected,
      outside ? " outside" : ""));
}

/// A paragraph in which all lines after the first are indented.
std::string in_lines(const std::string& text) {
  std::string lines;
  std::string line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    if (!line.empty() && line.size() + 1 + word.size() > kColumns) {
      lines += line + "\n";
      line = "   ";
    }
    line += (line.empty() ? "" : " ") + word;
    begin = end + 1;
  }
  return lines + line + "\n";
}

std::string notes(const Report& report) {
  std::string text;
  for (const ModuleReport& module : report.modules) {
    for (const Check& check : module.checks) {
      if (check.note.empty()) continue;
      text += in_lines(fmt::format("{} ({}) {}: {}", id_of(module.module), check.setting,
                                   check.passes ? "passes" : "fails", check.note));
    }
  }
  return text.empty() ? text : "\n" + text;
}

std::string rates(const Report& report) {
  std::string text;
  for (const ModuleReport& module : report.modules) {
    for (const Rate& rate : module.rates)
      text += rate_line(id_of(module.module), rate);
  }
  if (text.empty()) return text;
  return fmt::format("\n{:<24}  {:<22}  {:>6}  {:>8}  {:<16}  {}\n", "rate of", "setting", "trials",
                     "measured", "99 % interval", "expected") +
         text;
}

JsonObject check_json(const Check& check) {
  return JsonObject()
      .add("setting", check.setting)
      .add("runs", check.runs)
      .add("passes", check.passes)
      .add("measured", check.measured)
      .add("expected", check.expected)
      .add("quantity", check.quantity)
      .add("values", check.values)
      .add("note", check.note);
}

JsonObject rate_json(const Rate& rate) {
  const double measured = static_cast<double>(rate.firings) / static_cast<double>(rate.trials);
  return JsonObject()
      .add("setting", rate.setting)
      .add("trials", rate.trials)
      .add("measured", rate.trials == 0 ? std::nullopt : std::optional(measured))
      .add("expected", rate.expected)
      .add("low", rate.low)
      .add("high", rate.high);
}

JsonObject module_json(const ModuleReport& module) {
  return JsonObject()
      .add("module", id_of(module.module))
      .add("passes", module.passes())
      .add("checks", json_list(module.checks, check_json))
      .add("rates", json_list(module.rates, rate_json));
}

}  // namespace

std::string assessment_text(const Report& report, const Subject& subject) {
  std::string text = fmt::format("{:<24}  {:<22}  {:>4}  {:<7}  {:<20}  {}\n", "module", "setting",
                                 "runs", "verdict", "measured", "expected");
  for (const ModuleReport& module : report.modules) {
    for (const Check& check : module.checks)
      text += check_line(id_of(module.module), check);
  }
  return text + notes(report) + rates(report) +
         fmt::format("\n{} of {} modules pass: flavour {}, profile {}, robot {}\n", report.passed(),
                     report.modules.size(), subject.flavour.name, subject.profile.name,
                     subject.robot.name);
}

std::string assessment_json(const Report& report, const Subject& subject) {
  return JsonObject()
             .add("flavour", subject.flavour.name)
             .add("profile", subject.profile.name)
             .add("robot", subject.robot.name)
             .add("passed", report.passed())
             .add("modules", json_list(report.modules, module_json))
             .text() +
         "\n";
}

}  // namespace swarmsmith::cli
