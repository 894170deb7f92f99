#include "console/program.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <set>

#include "base/log.h"
#include "base/suggestion.h"
#include "console/wrapped.h"

namespace swarmsmith {
namespace {

std::string overview(const Program& program) {
  std::size_t width = 10;
  for (const ProgramCommand& command : program.commands)
    width = std::max(width, command.name.size());
  const std::string name(program.name);
  std::string text =
      std::string(program.purpose) + "\n\nUsage: " + name + " COMMAND [OPTIONS]\n\nCommands:\n";
  for (const ProgramCommand& command : program.commands) {
    text += "  " + std::string(command.name) + std::string(width - command.name.size(), ' ') +
            "  " + std::string(command.summary) + "\n";
  }
  return text + "\n`" + name + " COMMAND --help` explains a command.\n" +
         std::string(program.begin) + "\n";
}

/// The command named by the first words, or null; a name of two words has priority over a name of
/// one.
const ProgramCommand* find_command(const Program& program, const std::vector<std::string>& words) {
  const ProgramCommand* found = nullptr;
  for (const ProgramCommand& command : program.commands) {
    if (words.size() > 1 && command.name == words[0] + " " + words[1]) return &command;
    if (command.name == words[0]) found = &command;
  }
  return found;
}

std::vector<std::string> names_of(const Program& program) {
  std::vector<std::string> names;
  for (const ProgramCommand& command : program.commands)
    names.emplace_back(command.name);
  return names;
}

/// Prints an error with the name that was probably meant, or with the commands that begin with this
/// word.
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

/// Only long names, because short ones are too similar to be suggested.
std::vector<std::string> option_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames())
      names.push_back("--" + name);
  }
  return names;
}

/// Prints an error about arguments that do not belong to any option.
ExitCode complain_about_extras(const CLI::App& app, const Program& program,
                               const ProgramCommand& command,
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
    return fail(output, ExitCode::Usage, "unexpected word `" + word + "`" + help);
  }
  word = word.substr(0, word.find('='));
  return fail(output, ExitCode::Usage,
              "`" + std::string(command.name) + "` has no option `" + word + "`" +
                  did_you_mean(word, option_names(app)) + help);
}

/// Formats the help for a page: names in the first column, their filled descriptions beside them.
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

/// Declares the flags of all commands.
void declare_common(CLI::App& app, Output& output, bool& no_color) {
  app.add_flag("--json", output.json, "Write the answer as JSON");
  app.add_flag("-q,--quiet", output.quiet, "Write only answers and errors");
  app.add_flag("-v,--verbose", output.verbose, "Write more about the progress");
  app.add_flag("--no-color", no_color, "Write without colours, as NO_COLOR=1 does");
}

/// The parser of one command, created only when it is needed.
class Parser {
 public:
  Parser(const Program& program, const ProgramCommand& command, Output& output)
      : app_(std::string(command.summary),
             std::string(program.name) + " " + std::string(command.name)),
        options_(app_) {
    app_.allow_extras();
    app_.formatter(std::make_shared<PageFormatter>());
    app_.footer("\n" + std::string(command.details));
    run_ = command.declare(options_);
    declare_common(app_, output, no_color_);
  }

  CLI::App& app() { return app_; }
  const CommandRun& run() const { return run_; }
  bool no_color() const { return no_color_; }
  std::vector<DeclaredOption> declared() const { return options_.declared(); }

 private:
  CLI::App app_;
  Options options_;
  CommandRun run_;
  bool no_color_ = false;
};

ExitCode run_command(const Program& program, const ProgramCommand& command,
                     std::vector<std::string> arguments, Output& output) {
  Parser parser(program, command, output);
  CLI::App& app = parser.app();
  app.footer(wrapped(app.get_footer()));
  // CLI11 reads the arguments from the end.
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
  if (parser.no_color()) output.color = false;
  if (output.verbose) set_log_level(LogLevel::Debug);
  if (output.quiet) set_log_level(LogLevel::Error);
  change_log_level_by_signals();
  return parser.run()(output);
}

bool becomes_another_program(const ProgramCommand& command) {
  return command.run_words != nullptr && command.options == nullptr;
}

ExitCode print_declared(const Program& program, Output& output) {
  const auto of_command = [&](const ProgramCommand& command) {
    std::vector<DeclaredOption> options;
    std::string details(command.details);
    if (command.options != nullptr) {
      options = command.options();
    } else if (command.run_words == nullptr) {
      Parser parser(program, command, output);
      options = parser.declared();
      details = parser.app().get_footer();
    }
    return JsonObject()
        .add("name", command.name)
        .add("summary", command.summary)
        .add("details", details)
        .add("another_program", becomes_another_program(command))
        .add("options", declared_json(options));
  };
  output.out << JsonObject()
                    .add("program", program.name)
                    .add("purpose", program.purpose)
                    .add("begin", program.begin)
                    .add("commands", json_list(program.commands, of_command))
                    .text()
             << '\n';
  return ExitCode::Done;
}

/// Offers the next words of commands that begin with the complete words.
Offer offer_commands(const Program& program, std::span<const std::string> words) {
  std::string begin;
  for (const std::string& word : words)
    begin += word + " ";
  Offer offer;
  std::set<std::string_view> known;
  for (const ProgramCommand& command : program.commands) {
    if (!command.name.starts_with(begin)) continue;
    const std::string_view rest = command.name.substr(begin.size());
    const std::string_view next = rest.substr(0, rest.find(' '));
    if (!known.insert(next).second) continue;
    const bool is_whole = next.size() == rest.size();
    offer.words.push_back({std::string(next), is_whole ? std::string(command.summary) : ""});
  }
  return offer;
}

ExitCode complete(const Program& program, std::span<const std::string> given, Output& output) {
  std::vector<std::string> words = typed_words(given);
  const std::string begin = words.back();
  words.pop_back();
  const bool asks_for_help = !words.empty() && words.front() == "help";
  if (asks_for_help) words.erase(words.begin());
  Offer offer = offer_commands(program, words);
  if (words.empty() && !asks_for_help) {
    for (const char* word : {"--help", "--version"})
      offer.words.push_back({word, ""});
  }
  const ProgramCommand* command = words.empty() ? nullptr : find_command(program, words);
  if (command != nullptr && !asks_for_help) {
    const auto of_name = std::count(command->name.begin(), command->name.end(), ' ') + 1;
    const std::vector<std::string> rest(words.begin() + of_name, words.end());
    if (becomes_another_program(*command)) {
      std::vector<std::string> passed{"--complete"};
      passed.insert(passed.end(), rest.begin(), rest.end());
      passed.push_back(begin);
      std::ostream nowhere(nullptr);
      Output silent{output.out, nowhere};
      command->run_words(passed, silent);
      return ExitCode::Done;
    }
    const std::vector<DeclaredOption> options = command->options != nullptr
                                                    ? command->options()
                                                    : Parser(program, *command, output).declared();
    offer = offer_next(options, rest, begin, program.values);
  }
  write_offer(output.out, offer, begin);
  return ExitCode::Done;
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
  if (first == "--declared") return print_declared(program, output);
  if (first == "--complete") return complete(program, std::span(arguments).subspan(1), output);
  if (first == "--version") return run_program(program, {"version"}, output);
  const ProgramCommand* command = find_command(program, arguments);
  if (command == nullptr) return unknown_command(program, arguments, output);
  const auto words = std::count(command->name.begin(), command->name.end(), ' ') + 1;
  std::vector<std::string> rest(arguments.begin() + words, arguments.end());
  if (command->run_words != nullptr) return command->run_words(rest, output);
  if (command->prepare != nullptr) rest = command->prepare(std::move(rest));
  return run_command(program, *command, std::move(rest), output);
}

}  // namespace swarmsmith
