#include <filesystem>
#include <memory>
#include <vector>

#include "base/suggestion.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/commands/commands.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {
namespace {

struct ProfileArguments {
  std::string name;
  std::string file;
};

/// One name a line, or the names as JSON.
void list(Output& output) {
  if (output.json) {
    output.out << JsonObject().add("profiles", profile_names()).text() << "\n";
    return;
  }
  for (const std::string& name : profile_names())
    output.out << name << "\n";
}

/// All that a user's profile says, with what its base says, as a file.
std::string whole_text(const Profile& profile) {
  const std::string root = "profile";
  std::string text = "format = 1\n";
  for (Section& section : profile_sections(profile, root)) {
    if (section.header == "[" + root + "]") continue;  // its name is the file's
    section.header.erase(1, root.size() + 1);
    text += text_of({section});
  }
  return text;
}

ExitCode write(const ProfileArguments& arguments, std::string_view text, Output& output) {
  if (std::error_code none; std::filesystem::exists(arguments.file, none)) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "is there already; name another file", arguments.file});
  }
  if (auto written = write_whole_file(arguments.file, text); !written) {
    return fail(output, ExitCode::Failed, written.error());
  }
  print_note(output, arguments.file + " can be named in a campaign file: [simulator] profile = \"" +
                         arguments.file + "\"");
  return ExitCode::Done;
}

ExitCode run_profile(const ProfileArguments& arguments, Output& output) {
  if (arguments.name.empty()) {
    if (!arguments.file.empty()) {
      return fail(output, ExitCode::Usage,
                  Error{ErrorKind::BadInput,
                        "no profile given; name one of: " + joined(profile_names()), "--output"});
    }
    list(output);
    return ExitCode::Done;
  }
  std::string text(built_in_profile_text(arguments.name));
  if (text.empty()) {
    const auto profile = find_profile(arguments.name, ".");
    if (!profile) {
      const std::vector<Error>& errors = profile.error();
      for (std::size_t i = 0; i + 1 < errors.size(); ++i)
        print_error(output, errors[i]);
      return fail(output, ExitCode::Usage, errors.back());
    }
    text = whole_text(*profile);
  }
  if (!arguments.file.empty()) return write(arguments, text, output);
  if (output.json) {
    output.out << JsonObject().add("profile", arguments.name).add("text", text).text() << "\n";
  } else {
    output.out << text;
  }
  return output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

CommandRun declare_profile(Options& options) {
  auto arguments = std::make_shared<ProfileArguments>();
  options.text("PROFILE", arguments->name, "A built-in profile, or a file (default: list them)");
  options.text("-o,--output FILE", arguments->file, "File to write; never overwritten");
  return [arguments](Output& output) { return run_profile(*arguments, output); };
}

}  // namespace swarmsmith::cli
