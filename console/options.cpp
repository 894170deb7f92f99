#include "console/options.h"

#include <CLI/CLI.hpp>

#include "base/environment.h"
#include "base/suggestion.h"

namespace swarmsmith::cli {
namespace {

/// CLI11 lists what is required in the usage line.
void need_it(CLI::Option* option, Options::Need need) {
  if (need == Options::Need::Required) option->required();
}

}  // namespace

std::string store_of_environment() {
  return environment("SWARMSMITH_STORE");
}

void Options::flag(const std::string& names, bool& value, const std::string& help) {
  app_->add_flag(names, value, help);
}

void Options::text(const std::string& names, std::string& value, const std::string& help,
                   Need need) {
  need_it(app_->add_option(names, value, help), need);
}

void Options::texts(const std::string& names, std::vector<std::string>& values,
                    const std::string& help) {
  app_->add_option(names, values, help)->allow_extra_args(false);
}

void Options::words(const std::string& name, std::vector<std::string>& values,
                    const std::string& help, Need need) {
  need_it(app_->add_option(name, values, help), need);
}

void Options::choice(const std::string& names, std::string& value,
                     const std::vector<std::string>& choices, const std::string& help, Need need) {
  const auto check = [choices, names](const std::string& given) -> std::string {
    if (std::find(choices.begin(), choices.end(), given) != choices.end()) return {};
    return "\"" + given + "\" is none of: " + joined(choices) + did_you_mean(given, choices);
  };
  CLI::Option* option = app_->add_option(names, value, help + " (" + joined(choices) + ")");
  option->check(check, "", "choice");
  need_it(option, need);
}

void Options::integer(const std::string& names, std::optional<std::int64_t>& value, Range range,
                      const std::string& help) {
  const auto without_underscores = [](std::string given) {
    std::erase(given, '_');
    return given;
  };
  // Checks run in reverse: the range sees what the transformation has made.
  app_->add_option(names, value, help)
      ->option_text("N")
      ->check(CLI::Range(range.least, range.most))
      ->transform(without_underscores, "", "underscores");
}

void Options::explain(const std::string& lines) {
  app_->footer("\n" + lines + app_->get_footer());
}

}  // namespace swarmsmith::cli
