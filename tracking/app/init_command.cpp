#include <array>
#include <filesystem>
#include <memory>
#include <string_view>

#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "embedded/kArenaTemplate.h"
#include "embedded/kRunTemplate.h"
#include "tracking/app/commands.h"

namespace swarmsmith {
namespace {

/// A file to start with.
struct Template {
  std::string_view name;
  std::string_view text;
};
constexpr std::array kTemplates = {Template{"arena.toml", kArenaTemplate},
                                   Template{"run.toml", kRunTemplate}};

ExitCode run(const std::string& folder, Output& output) {
  std::error_code trouble;
  std::filesystem::create_directories(folder, trouble);
  for (const Template& each : kTemplates) {
    const std::string file = (std::filesystem::path(folder) / each.name).string();
    if (!std::filesystem::exists(file, trouble)) continue;
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "already exists; name another folder", file});
  }
  std::vector<std::string> files;
  for (const Template& each : kTemplates) {
    const std::string file = (std::filesystem::path(folder) / each.name).string();
    if (const auto written = write_whole_file(file, each.text); !written) {
      return fail(output, ExitCode::Failed, written.error());
    }
    files.push_back(file);
  }
  if (output.json) {
    output.out << JsonObject().add("files", files).text() << "\n";
    return ExitCode::Done;
  }
  for (const std::string& file : files)
    output.out << file << "\n";
  const std::string arena = (std::filesystem::path(folder) / "arena.toml").string();
  print_note(output, "Write your cameras, floor tags and robots into it; `swarmsmith track check " +
                         command_word(arena) + "` then says what comes next.");
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_track_init(Options& options) {
  auto folder = std::make_shared<std::string>(".");
  options.text("DIR", *folder, "Folder of the new arena.toml and run.toml (default: this one)");
  return [folder](Output& output) { return run(*folder, output); };
}

}  // namespace swarmsmith
