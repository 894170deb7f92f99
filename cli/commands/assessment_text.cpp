#include "cli/commands/assessment_text.h"

#include <fmt/format.h>

#include "console/output.h"

namespace swarmsmith::cli {
namespace {

using assessment::Check;
using assessment::ModuleReport;
using assessment::Rate;
using assessment::Report;

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

/// A paragraph with the second and further lines indented.
std::string wrapped(const std::string& text) {
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
      text += wrapped(fmt::format("{} ({}) {}: {}", id_of(module.module), check.setting,
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

std::string check_json(const Check& check) {
  std::string values;
  for (const double value : check.values)
    values += (values.empty() ? "" : ",") + json_number(value);
  return "{\"setting\":" + json_text(check.setting) + ",\"runs\":" + std::to_string(check.runs) +
         ",\"passes\":" + (check.passes ? "true" : "false") +
         ",\"measured\":" + json_text(check.measured) +
         ",\"expected\":" + json_text(check.expected) +
         ",\"quantity\":" + json_text(check.quantity) + ",\"values\":[" + values + "]" +
         ",\"note\":" + json_text(check.note) + "}";
}

std::string rate_json(const Rate& rate) {
  const std::string measured =
      rate.trials == 0
          ? "null"
          : json_number(static_cast<double>(rate.firings) / static_cast<double>(rate.trials));
  return "{\"setting\":" + json_text(rate.setting) + ",\"trials\":" + std::to_string(rate.trials) +
         ",\"measured\":" + measured + ",\"expected\":" + json_number(rate.expected) +
         ",\"low\":" + json_number(rate.low) + ",\"high\":" + json_number(rate.high) + "}";
}

template <class T>
std::string array_json(const std::vector<T>& items, std::string (*item_json)(const T&)) {
  std::string text;
  for (const T& item : items)
    text += (text.empty() ? "" : ",") + item_json(item);
  return "[" + text + "]";
}

std::string module_json(const ModuleReport& module) {
  return "{\"module\":" + json_text(id_of(module.module)) +
         ",\"passes\":" + (module.passes() ? "true" : "false") +
         ",\"checks\":" + array_json(module.checks, check_json) +
         ",\"rates\":" + array_json(module.rates, rate_json) + "}";
}

}  // namespace

std::string assessment_text(const Report& report, std::string_view flavour,
                            std::string_view profile) {
  std::string text = fmt::format("{:<24}  {:<22}  {:>4}  {:<7}  {:<20}  {}\n", "module", "setting",
                                 "runs", "verdict", "measured", "expected");
  for (const ModuleReport& module : report.modules) {
    for (const Check& check : module.checks)
      text += check_line(id_of(module.module), check);
  }
  return text + notes(report) + rates(report) +
         fmt::format("\n{} of {} modules pass: flavour {}, profile {}\n", report.passed(),
                     report.modules.size(), flavour, profile);
}

std::string assessment_json(const Report& report, std::string_view flavour,
                            std::string_view profile) {
  return "{\"flavour\":" + json_text(flavour) + ",\"profile\":" + json_text(profile) +
         ",\"passed\":" + std::to_string(report.passed()) +
         ",\"modules\":" + array_json(report.modules, module_json) + "}\n";
}

}  // namespace swarmsmith::cli
