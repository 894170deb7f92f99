#include "irace_core/files/settings.h"

#include <algorithm>
#include <cstdlib>

#include "base/environment.h"

namespace swarmsmith {
namespace {

/// Whether the value is missing, an empty text, or the default.
bool is_default(const IraceOption& option, const IraceValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return true;
  if (const auto* text = std::get_if<std::string>(&value); text != nullptr && text->empty()) {
    return true;
  }
  const auto initial = irace_value_of(option, option.initial);
  return initial && *initial == value;
}

/// Paths `~` and `~/...` start in the home folder; R expands them itself, without the shell.
std::filesystem::path with_home(std::string_view path) {
  const bool begins = path == "~" || path.starts_with("~/");
  const std::string home = begins ? environment("HOME") : "";
  if (home.empty()) return path;
  path.remove_prefix(std::min<std::size_t>(path.size(), 2));
  return std::filesystem::path(home) / path;
}

std::string in_backticks(std::string_view text) {
  return "`" + std::string(text) + "`";
}

}  // namespace

void IraceSettings::set(IraceSetting setting) {
  const auto old = std::ranges::find(settings_, setting.option, &IraceSetting::option);
  if (old == settings_.end()) {
    settings_.push_back(std::move(setting));
  } else {
    *old = std::move(setting);
  }
}

void IraceSettings::override_with(const IraceSettings& stronger) {
  for (const IraceSetting& setting : stronger.all())
    set(setting);
}

const IraceSetting* IraceSettings::find(std::string_view title) const {
  for (const IraceSetting& setting : settings_) {
    const IraceOption& option = *setting.option;
    if (option.title() != title && option.long_switch != title) continue;
    return std::holds_alternative<std::monostate>(setting.value) ? nullptr : &setting;
  }
  return nullptr;
}

bool IraceSettings::is_on(std::string_view title) const {
  const IraceSetting* setting = find(title);
  const bool* value = setting == nullptr ? nullptr : std::get_if<bool>(&setting->value);
  return value != nullptr && *value;
}

std::optional<std::string> IraceSettings::text(std::string_view title) const {
  const IraceSetting* setting = find(title);
  const auto* value = setting == nullptr ? nullptr : std::get_if<std::string>(&setting->value);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

std::optional<std::int64_t> IraceSettings::number(std::string_view title) const {
  const IraceSetting* setting = find(title);
  const auto* value = setting == nullptr ? nullptr : std::get_if<std::int64_t>(&setting->value);
  return value == nullptr ? std::nullopt : std::optional(*value);
}

std::optional<std::string> irace_refusal(const IraceOption& option, const IraceValue& value) {
  const std::string title = in_backticks(option.title());
  if (option.meaning == IraceMeaning::Gone) {
    return title + " is a name of irace before 2.0: write " + in_backticks(option.remark);
  }
  if (option.meaning != IraceMeaning::Refused || is_default(option, value)) return std::nullopt;
  return title + " cannot be used here: " + std::string(option.remark);
}

std::optional<std::string> irace_remark(const IraceOption& option, const IraceValue& value) {
  const std::string title = in_backticks(option.title());
  if (option.meaning == IraceMeaning::Removed && !std::holds_alternative<std::monostate>(value)) {
    std::string remark(option.remark);
    const auto* number = std::get_if<std::int64_t>(&value);
    if (option.name == "digits" && number != nullptr)
      remark.replace(remark.find('N'), 1, std::to_string(*number));
    return title + " is read, but newer versions of irace refuse it: " + remark;
  }
  if (option.meaning == IraceMeaning::Ignored && !is_default(option, value)) {
    return title + " has no effect here: " + std::string(option.remark);
  }
  const auto* share = std::get_if<double>(&value);
  if (option.name == "postselection" && share != nullptr && *share > 0 && *share < 1) {
    return title +
           " is a share of the budget in irace 3.5; here, as in irace 4, the last race gets what "
           "the others leave";
  }
  return std::nullopt;
}

std::filesystem::path absolute_path(std::string_view path, const std::filesystem::path& folder) {
  if (path.empty()) return {};
  std::filesystem::path whole = (folder / with_home(path)).lexically_normal();
  // "folder/" and "folder" are the same place.
  if (!whole.has_filename() && whole.has_relative_path()) whole = whole.parent_path();
  return whole;
}

}  // namespace swarmsmith
