#include "coordinator/cli/options.h"

#include <CLI/CLI.hpp>

#include "base/log.h"
#include "base/suggestion.h"
#include "coordinator/cli/commands.h"
#include "coordinator/cli/machine_words.h"

namespace swarmsmith::cli {
namespace {

/// CLI11 lists what is required in the usage line.
void need_it(CLI::Option* option, Options::Need need) {
  if (need == Options::Need::Required) option->required();
}

/// What `swarmsmith --help` writes.
std::string overview() {
  std::string text =
      "Designs control software for robot swarms.\n\nUsage: swarmsmith COMMAND [OPTIONS]\n\n"
      "Commands:\n";
  for (const Command& command : commands()) {
    const std::string name(command.name);
    text += "  " + name + std::string(name.size() < 10 ? 10 - name.size() : 0, ' ') + "  " +
            std::string(command.summary) + "\n";
  }
  return text +
         "\n`swarmsmith COMMAND --help` explains a command.\n"
         "Begin with `swarmsmith run` (a demo) or `swarmsmith init`.\n";
}

/// The command of that name, or null.
const Command* find_command(const std::string& name) {
  for (const Command& command : commands()) {
    if (command.name == name) return &command;
  }
  return nullptr;
}

/// With the name that was probably meant.
ExitCode unknown_command(const std::string& name, Output& output) {
  std::vector<std::string> names;
  for (const Command& command : commands())
    names.emplace_back(command.name);
  return fail(output, ExitCode::Usage,
              "there is no command `" + name + "`" + did_you_mean(name, names) +
                  "; `swarmsmith --help` lists all");
}

/// Long names only: short ones are too near to each other to be suggested.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  }
  return names;
}

/// Words that no option took.
ExitCode complain_about_extras(const CLI::App& app, const Command& command,
                               const std::vector<std::string>& extras, Output& output) {
  std::string word = extras.front();
  for (const std::string& extra : extras) {
    if (!extra.starts_with("-")) continue;
    word = extra;
    break;
  }
  const std::string help = "; see `swarmsmith " + std::string(command.name) + " --help`";
  if (!word.starts_with("-")) {
    return fail(output, ExitCode::Usage, "`" + word + "` is one word too many" + help);
  }
  word = word.substr(0, word.find('='));
  return fail(output, ExitCode::Usage,
              "`" + std::string(command.name) + "` has no option `" + word + "`" +
                  did_you_mean(word, option_names(app)) + help);
}

/// Flags that every command has.
void declare_common(CLI::App& app, Output& output, bool& no_color) {
  app.add_flag("--json", output.json, "Write the answer as JSON");
  app.add_flag("-q,--quiet", output.quiet, "Write nothing but answers and errors");
  app.add_flag("-v,--verbose", output.verbose, "Write more about what goes on");
  app.add_flag("--no-color", no_color, "Write without colours, as NO_COLOR=1 does");
}

/// One command has a parser of its own, made when it is asked for.
ExitCode run_command(const Command& command, std::vector<std::string> arguments, Output& output) {
  CLI::App app{std::string(command.summary), "swarmsmith " + std::string(command.name)};
  app.allow_extras();
  app.footer("\n" + std::string(command.details));
  Options options(app);
  const auto run = command.declare(options);
  bool no_color = false;
  declare_common(app, output, no_color);
  // The library takes the words from the back.
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    output.out << app.help();
    return ExitCode::Done;
  } catch (const CLI::ParseError& error) {
    return fail(
        output, ExitCode::Usage,
        std::string(error.what()) + "; see `swarmsmith " + std::string(command.name) + " --help`");
  }
  if (!app.remaining().empty()) {
    return complain_about_extras(app, command, app.remaining(), output);
  }
  if (no_color) output.color = false;
  if (output.verbose) set_log_level(LogLevel::Debug);
  if (output.quiet) set_log_level(LogLevel::Error);
  change_log_level_by_signals();
  return run(output);
}

}  // namespace

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
      ->check(CLI::Range(range.least, range.most))
      ->transform(without_underscores, "", "underscores");
}

void Options::explain(const std::string& lines) {
  app_->footer("\n" + lines + app_->get_footer());
}

ExitCode run_program(const std::vector<std::string>& arguments, Output& output) {
  if (arguments.empty()) {
    output.err << overview();
    return ExitCode::Usage;
  }
  const std::string& first = arguments.front();
  if (first == "--help" || first == "-h" || first == "help") {
    if (arguments.size() > 1) return run_program({arguments[1], "--help"}, output);
    output.out << overview();
    return ExitCode::Done;
  }
  if (first == "--version") return run_program({"version"}, output);
  const Command* command = find_command(first);
  if (command == nullptr) return unknown_command(first, output);
  std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
  if (command->run_words != nullptr) return command->run_words(rest, output);
  if (first == "evaluate") rest = with_machine_as_one_word(rest);
  return run_command(*command, std::move(rest), output);
}

}  // namespace swarmsmith::cli
