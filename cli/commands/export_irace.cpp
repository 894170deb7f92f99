#include "cli/commands/export_formats.h"

#include <filesystem>

#include "base/output_file.h"
#include "base/program_path.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/replay/design_argument.h"
#include "coordinator/campaign/campaign_rows.h"
#include "coordinator/campaign/irace_folder.h"

namespace swarmsmith::cli {
namespace {

Expected<void> write(const std::filesystem::path& folder, const std::vector<NamedText>& files) {
  namespace fs = std::filesystem;
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  for (const NamedText& file : files) {
    if (!fs::exists(folder / file.name, trouble)) continue;
    return bad_input("already exists; name another folder with -o", (folder / file.name).string());
  }
  for (const NamedText& file : files) {
    const fs::path path = folder / file.name;
    if (auto written = write_whole_file(path.string(), file.text); !written) return written;
    if (!file.is_program) continue;
    const auto run = fs::perms::owner_exec | fs::perms::group_exec | fs::perms::others_exec;
    fs::permissions(path, run, fs::perm_options::add, trouble);
    if (trouble) return Unexpected(cannot_write(path.string()));
  }
  return {};
}

}  // namespace

ExitCode export_irace(const std::string& source, const IraceExport& what, const std::string& folder,
                      Output& output) {
  if (folder.empty()) {
    return fail(output, ExitCode::Usage,
                "--format irace writes a folder; name a new one with -o FOLDER");
  }
  const auto campaign = campaign_of(source, output);
  if (!campaign) {
    const bool bad = campaign.error().kind == ErrorKind::BadInput;
    return fail(output, bad ? ExitCode::Usage : ExitCode::Store, campaign.error());
  }
  const auto design = find_design(*campaign, what.design);
  if (!design) return fail(output, ExitCode::Usage, design.error());
  const auto program = own_program();
  const auto version = what.version == "4" ? IraceVersion::V4 : IraceVersion::V3_5;
  const auto made = irace_folder(*campaign, *design, version, program);
  if (!made) return fail(output, ExitCode::Usage, made.error());
  if (const auto written = write(folder, made->files); !written) {
    const bool bad = written.error().kind == ErrorKind::BadInput;
    return fail(output, bad ? ExitCode::Usage : ExitCode::Failed, written.error());
  }
  const auto searches = searches_of(*campaign);
  if (const auto search = searches.find(design->id); search != searches.end()) {
    print_note(output, to_string(design->id) + " is searched by " +
                           std::string(words_of(search->second).name) +
                           " here; irace races the same space and budget");
  }
  for (const std::string& remark : made->remarks)
    print_note(output, remark);
  if (output.json) {
    output.out << JsonObject().add("folder", folder).text() << "\n";
  } else {
    output.out << folder << "\n";
    print_note(output,
               "`cd " + folder + " && irace --scenario scenario.txt` runs it with R's irace.");
  }
  return ExitCode::Done;
}

}  // namespace swarmsmith::cli
