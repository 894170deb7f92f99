#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/commands/commands.h"
#include "cli/commands/file_printer.h"
#include "sim/control/flavour_file.h"
#include "sim/control/flavour_text.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {
namespace {

struct PrintedArguments {
  std::string name;
  std::string file;
};

/// A user's profile together with the values of its base, as a file.
tl::expected<std::string, std::vector<Error>> whole_profile(const std::string& word) {
  const auto profile = find_profile(word, ".");
  if (!profile) return tl::unexpected(profile.error());
  return profile_text(*profile);
}

tl::expected<std::string, std::vector<Error>> whole_flavour(const std::string& word) {
  const auto flavour = find_flavour_file(word, ".");
  if (!flavour) return tl::unexpected(flavour.error());
  return flavour_text(*flavour);
}

CommandRun declare(Options& options, const std::string& word, const std::string& about,
                   CarriedFiles files) {
  auto arguments = std::make_shared<PrintedArguments>();
  options.text(word, arguments->name, about);
  options.text("-o,--output FILE", arguments->file, "File to write; never overwritten");
  return [arguments, files = std::move(files)](Output& output) {
    return print_carried_file(files, arguments->name, arguments->file, output);
  };
}

}  // namespace

CommandRun declare_profile(Options& options) {
  return declare(options, "PROFILE PROFILE|FILE",
                 "A built-in profile, or a file (default: list them)",
                 {.kind = "profile",
                  .names = profile_names(),
                  .built_in = built_in_profile_text,
                  .whole = whole_profile,
                  .hint = "[simulator] profile"});
}

CommandRun declare_flavour(Options& options) {
  return declare(options, "FLAVOUR FLAVOUR|FILE",
                 "A built-in flavour, or a file (default: list them)",
                 {.kind = "flavour",
                  .names = flavour_names(),
                  .built_in = built_in_flavour_text,
                  .whole = whole_flavour,
                  .hint = "[[method]] flavour"});
}

}  // namespace swarmsmith::cli
