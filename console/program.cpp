#include "console/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "base/log.h"
#include "base/suggestion.h"
#include "console/wrapped.h"

namespace swarmsmith::cli {
namespace {

std::string overview(const Program& program) {
  std::size_t width = 10;
  for (const Command& command : program.commands)
    width = std::max(width, command.name.size());
  const std::string name(program.name);
  std::string text =
      std::string(program.purpose) + "\n\nUsage: " + name + " COMMAND [OPTIONS]\n\nCommands:\n";
  for (const Command& command : program.commands) {
    text += "  " + std::string(command.name) + std::string(width - command.name.size(), ' ') +
            "  " + std::string(command.summary) + "\n";
  }
  return text + "\n`" + name + " COMMAND --help` explains a command.\n" +
         std::string(program.begin) + "\n";
}

/// The command that the first words name, or null; a name of two words goes before one of one.
const Command* find_command(const Program& program, const std::vector<std::string>& words) {
  const Command* found = nullptr;
  for (const Command& command : program.commands) {
    if (words.size() > 1 && command.name == words[0] + " " + words[1]) return &command;
    if (command.name == words[0]) found = &command;
  }
  return found;
}

std::vector<std::string> names_of(const Program& program) {
  std::vector<std::string> names;
  for (const Command& command : program.commands)
    names.emplace_back(command.name);
  return names;
}

/// With the name that was probably meant, or those that begin with the word.
ExitCode unknown_command(const Program& program, const std::vector<std::string>& words,
                         Output& output) {
  const std::vector<std::string> names = names_of(program);
  std::vector<std::string> longer;
  std::copy_if(names.begin(), names.end(), std::back_inserter(longer),
               [&](const std::string& name) { return name.starts_with(words[0] + " "); });
  const std::string help = "`" + std::string(program.name) + " --help` lists all";
  if (!longer.empty()) {
    return fail(output, ExitCode::Usage,
                "`" + words[0] + "` needs one more word: " + joined(longer) + "; " + help);
  }
  return fail(
      output, ExitCode::Usage,
      "there is no command `" + words[0] + "`" + did_you_mean(words[0], names) + "; " + help);
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
ExitCode complain_about_extras(const CLI::App& app, const Program& program, const Command& command,
                               const std::vector<std::string>& extras, Output& output) {
  std::string word = extras.front();
  for (const std::string& extra : extras) {
    if (!extra.starts_with("-")) continue;
    word = extra;
    break;
  }
  const std::string help =
      "; see `" + std::string(program.name) + " " + std::string(command.name) + " --help`";
  if (!word.starts_with("-")) {
    return fail(output, ExitCode::Usage, "`" + word + "` is one word too many" + help);
  }
  word = word.substr(0, word.find('='));
  return fail(output, ExitCode::Usage,
              "`" + std::string(command.name) + "` has no option `" + word + "`" +
                  did_you_mean(word, option_names(app)) + help);
}

/// Help that fits a page: names in a column of their own, what they mean beside, filled.
class PageFormatter : public CLI::Formatter {
 public:
  std::string make_option(const CLI::Option* option, bool is_positional) const override {
    constexpr std::size_t kNames = 26;
    std::string names = "  " + make_option_name(option, is_positional) + make_option_opts(option);
    if (names.size() + 2 > kNames) {
      names += "\n" + std::string(kNames, ' ');
    } else {
      names.resize(kNames, ' ');
    }
    std::string meaning = wrapped(make_option_desc(option), kPageWidth - kNames);
    for (std::size_t at = meaning.find('\n'); at != std::string::npos;
         at = meaning.find('\n', at + 1))
      meaning.insert(at + 1, kNames, ' ');
    return names + meaning + "\n";
  }
};

/// Flags that every command has.
void declare_common(CLI::App& app, Output& output, bool& no_color) {
  app.add_flag("--json", output.json, "Write the answer as JSON");
  app.add_flag("-q,--quiet", output.quiet, "Write only answers and errors");
  app.add_flag("-v,--verbose", output.verbose, "Write more about the progress");
  app.add_flag("--no-color", no_color, "Write without colours, as NO_COLOR=1 does");
}

/// One command has a parser of its own, made when it is asked for.
ExitCode run_command(const Program& program, const Command& command,
                     std::vector<std::string> arguments, Output& output) {
  CLI::App app{std::string(command.summary),
               std::string(program.name) + " " + std::string(command.name)};
  app.allow_extras();
  app.formatter(std::make_shared<PageFormatter>());
  app.footer("\n" + std::string(command.details));
  Options options(app);
  const Run run = command.declare(options);
  app.footer(wrapped(app.get_footer()));
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
    return fail(output, ExitCode::Usage,
                std::string(error.what()) + "; see `" + std::string(program.name) + " " +
                    std::string(command.name) + " --help`");
  }
  if (!app.remaining().empty()) {
    return complain_about_extras(app, program, command, app.remaining(), output);
  }
  if (no_color) output.color = false;
  if (output.verbose) set_log_level(LogLevel::Debug);
  if (output.quiet) set_log_level(LogLevel::Error);
  change_log_level_by_signals();
  return run(output);
}

}  // namespace

ExitCode run_program(const Program& program, const std::vector<std::string>& arguments,
                     Output& output) {
  output.program = program.name;
  if (arguments.empty()) {
    output.err << overview(program);
    return ExitCode::Usage;
  }
  const std::string& first = arguments.front();
  if (first == "--help" || first == "-h" || first == "help") {
    if (arguments.size() > 1) {
      std::vector<std::string> words(arguments.begin() + 1, arguments.end());
      words.emplace_back("--help");
      return run_program(program, words, output);
    }
    output.out << overview(program);
    return ExitCode::Done;
  }
  if (first == "--version") return run_program(program, {"version"}, output);
  const Command* command = find_command(program, arguments);
  if (command == nullptr) return unknown_command(program, arguments, output);
  const auto words = std::count(command->name.begin(), command->name.end(), ' ') + 1;
  std::vector<std::string> rest(arguments.begin() + words, arguments.end());
  if (command->run_words != nullptr) return command->run_words(rest, output);
  if (command->prepare != nullptr) rest = command->prepare(std::move(rest));
  return run_command(program, *command, std::move(rest), output);
}

}  // namespace swarmsmith::cli
