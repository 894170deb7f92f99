#include "console/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <utility>

#include "base/environment.h"
#include "base/suggestion.h"
#include "base/text/csv.h"

namespace swarmsmith {
namespace {

/// CLI11 lists required options in the usage line.
void need_it(CLI::Option* option, Options::Need need) {
  if (need == Options::Need::Required) option->required();
}

/// Splits "-o,--output FILE" into its names and the kind of its value.
std::pair<std::string, std::string> names_and_value(const std::string& text) {
  const std::size_t end = text.find(' ');
  if (end == std::string::npos) return {text, ""};
  return {text.substr(0, end), text.substr(end + 1)};
}

/// Whether the value may be a path: "PROFILE|FILE". An empty path would be treated as an option
/// that was not given.
bool is_path(std::string_view kind) {
  while (true) {
    const std::size_t end = kind.find('|');
    const std::string_view one = kind.substr(0, end);
    if (one == "FILE" || one == "STORE" || one == "DIR") return true;
    if (end == std::string_view::npos) return false;
    kind.remove_prefix(end + 1);
  }
}

}  // namespace

std::string store_of_environment() {
  return environment("SWARMSMITH_STORE");
}

void Options::flag(const std::string& names, bool& value, const std::string& help) {
  app_->add_flag(names, value, help);
}

/// The name of an argument is its kind; the value of an option has a name, too.
void Options::describe(CLI::Option* option, const std::string& value) {
  const std::string name = option->get_single_name();
  const bool is_word = option->get_positional();
  if (is_word) {
    option->type_name("");
  } else {
    option->type_name(value.empty() ? "TEXT" : value);
  }
  const std::string& kind = kinds_[name] = value.empty() ? name : value;
  if (!is_path(kind)) return;
  const auto check = [option](const std::string& given) -> std::string {
    if (!given.empty()) return "";
    return option->get_required() ? "the path is empty; name a file"
                                  : "the path is empty; name a file, or leave it out";
  };
  option->check(check, "", "path");
}

void Options::text(const std::string& names, std::string& value, const std::string& help,
                   Need need) {
  const auto [name, kind] = names_and_value(names);
  CLI::Option* option = app_->add_option(name, value, help);
  describe(option, kind);
  need_it(option, need);
}

void Options::texts(const std::string& names, std::vector<std::string>& values,
                    const std::string& help) {
  const auto [name, kind] = names_and_value(names);
  CLI::Option* option = app_->add_option(name, values, help)->allow_extra_args(false);
  describe(option, kind);
}

void Options::words(const std::string& name, std::vector<std::string>& values,
                    const std::string& help, Need need) {
  const auto [word, kind] = names_and_value(name);
  CLI::Option* option = app_->add_option(word, values, help);
  describe(option, kind);
  need_it(option, need);
}

void Options::limit(CLI::Option* option, const std::vector<std::string>& choices) {
  const auto check = [choices](const std::string& given) -> std::string {
    if (std::find(choices.begin(), choices.end(), given) != choices.end()) return {};
    return "\"" + given + "\" is not one of: " + joined(choices) + did_you_mean(given, choices);
  };
  describe(option, "WORD");
  choices_[option->get_single_name()] = choices;
  option->check(check, "", "choice");
}

void Options::choice(const std::string& names, std::string& value,
                     const std::vector<std::string>& choices, const std::string& help, Need need) {
  CLI::Option* option = app_->add_option(names, value, help + " (" + joined(choices) + ")");
  limit(option, choices);
  need_it(option, need);
}

void Options::choose(const std::string& names, const std::vector<std::string>& choices,
                     const std::string& help, const std::function<void(std::size_t)>& take) {
  const auto found = [choices, take](const std::string& given) {
    take(static_cast<std::size_t>(std::ranges::find(choices, given) - choices.begin()));
  };
  limit(app_->add_option_function<std::string>(names, found, help + " (" + joined(choices) + ")"),
        choices);
}

void Options::read_number(const std::string& names, Bounds bounds, const std::string& help,
                          const std::function<void(double)>& take) {
  const auto [name, kind] = names_and_value(names);
  const auto check = [bounds](const std::string& given) -> std::string {
    const auto number = number_in(given);
    if (number && *number >= bounds.least && *number <= bounds.most) return {};
    return fmt::format("`{}` is not a number from {} to {}", given, bounds.least, bounds.most);
  };
  CLI::Option* option = app_->add_option_function<std::string>(
      name, [take](const std::string& given) { take(*number_in(given)); }, help);
  describe(option, kind);
  option->check(check, "", "number");
}

void Options::number(const std::string& names, double& value, Bounds bounds,
                     const std::string& help) {
  read_number(names, bounds, help, [&value](double given) { value = given; });
}

void Options::number(const std::string& names, std::optional<double>& value, Bounds bounds,
                     const std::string& help) {
  read_number(names, bounds, help, [&value](double given) { value = given; });
}

void Options::integer(const std::string& names, std::optional<std::int64_t>& value, Range range,
                      const std::string& help) {
  const auto without_underscores = [](std::string given) {
    std::erase(given, '_');
    return given;
  };
  // Checks run in reverse order, so the range check sees the transformed value.
  app_->add_option(names, value, help)
      ->option_text("N")
      ->check(CLI::Range(range.least, range.most))
      ->transform(without_underscores, "", "underscores");
}

void Options::explain(const std::string& lines) {
  app_->footer("\n" + lines + app_->get_footer());
}

std::vector<DeclaredOption> Options::declared() const {
  std::vector<DeclaredOption> options = declared_options(*app_);
  for (DeclaredOption& option : options) {
    for (std::string name : option.names) {
      name.erase(0, std::min(name.find_first_not_of('-'), name.size()));
      if (const auto kind = kinds_.find(name); kind != kinds_.end()) option.kind = kind->second;
      if (const auto found = choices_.find(name); found != choices_.end())
        option.choices = found->second;
    }
  }
  return options;
}

}  // namespace swarmsmith
