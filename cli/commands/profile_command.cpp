#include <filesystem>
#include <memory>

#include "base/suggestion.h"
#include "cli/commands/commands.h"
#include "console/whole_file.h"
#include "sim/files/profile_file.h"

namespace swarmsmith::cli {
namespace {

struct ProfileArguments {
  std::string name;
  std::string file;
};

/// One name a line, or the names as JSON.
void list(Output& output) {
  std::string names;
  for (const std::string& name : profile_names())
    names += output.json ? (names.empty() ? "" : ",") + json_text(name) : name + "\n";
  output.out << (output.json ? "{\"profiles\":[" + names + "]}\n" : names);
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
  const auto profile = built_in_profile(arguments.name);
  if (!profile) {
    return fail(output, ExitCode::Usage, Error{ErrorKind::BadInput, profile.error().message, ""});
  }
  const std::string_view text = built_in_profile_text(arguments.name);
  if (!arguments.file.empty()) return write(arguments, text, output);
  if (output.json) {
    output.out << "{\"profile\":" << json_text(arguments.name)
               << ",\"text\":" << json_text(std::string(text)) << "}\n";
  } else {
    output.out << text;
  }
  return output.out.good() ? ExitCode::Done : ExitCode::Failed;
}

}  // namespace

Run declare_profile(Options& options) {
  auto arguments = std::make_shared<ProfileArguments>();
  options.text("NAME", arguments->name, "A built-in profile (default: list them)");
  options.text("-o,--output", arguments->file, "File to write; never overwritten");
  return [arguments](Output& output) { return run_profile(*arguments, output); };
}

}  // namespace swarmsmith::cli
