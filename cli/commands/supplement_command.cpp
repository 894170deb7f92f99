#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>

#include <unistd.h>

#include "analysis/report/supplement.h"
#include "base/output_file.h"
#include "base/process/process.h"
#include "base/text/json.h"
#include "base/text/sha256.h"
#include "base/text/whole_file.h"
#include "cli/arguments/program_name.h"
#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "cli/commands/runs_from_above.h"
#include "cli/dashboard/snapshot.h"
#include "cli/replay/machine_filer.h"
#include "cli/replay/stored_instances.h"
#include "console/counter.h"
#include "console/pdf.h"
#include "web/pages.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<SupplementFile>;

struct SupplementArguments {
  StoreArgument store;
  std::string folder;
};

/// Adds a PDF for every SVG.
Expected<void> add_pdfs(Files& files, Output& output) {
  Counter counter(output, "made", "PDFs");
  const auto of = std::ranges::count_if(
      files, [](const SupplementFile& file) { return file.path.ends_with(".svg"); });
  Files pdfs;
  for (const SupplementFile& file : files) {
    if (!file.path.ends_with(".svg")) continue;
    counter.tell(std::ssize(pdfs), of);
    auto pdf = pdf_of_svg(file.text);
    if (!pdf) return Unexpected(pdf.error());
    pdfs.push_back({file.path.substr(0, file.path.size() - 3) + "pdf", std::move(*pdf)});
  }
  counter.tell(of, of);
  std::ranges::move(pdfs, std::back_inserter(files));
  std::ranges::sort(files, {}, &SupplementFile::path);
  return {};
}

/// The places of robots and patches in the runs that gave the winners' scores.
Expected<Files> instance_tables(StoreReader& store) {
  const auto missions = scored_missions(store);
  if (!missions) return Unexpected(missions.error());
  Files files;
  for (const ScoredMission& scored : *missions) {
    for (const bool patches : {false, true}) {
      auto text = patches ? patches_table(scored) : starts_table(scored);
      if (!text) return Unexpected(text.error());
      if (text->empty()) continue;
      files.push_back({"instances/" + scored.name + (patches ? "-patches" : "-starts") + ".csv",
                       std::move(*text)});
    }
  }
  return files;
}

/// In the format of `sha256sum -c`: all files except this one.
std::string checksums_of(const Files& files) {
  std::string text;
  for (const SupplementFile& file : files)
    text += sha256_of(file.text) + "  " + file.path + "\n";
  return text;
}

/// Writes everything into a folder beside the final one, and renames it when it is complete.
Expected<void> write_folder(const fs::path& folder, const Files& files) {
  const fs::path unfinished = folder.string() + ".unfinished-" + std::to_string(getpid());
  const auto failed = [&](const Error& error) {
    std::error_code ignored;
    fs::remove_all(unfinished, ignored);
    return Unexpected(error);
  };
  for (const SupplementFile& file : files) {
    const fs::path path = unfinished / file.path;
    std::error_code trouble;
    fs::create_directories(path.parent_path(), trouble);
    if (trouble) return failed(cannot_write(path.string()));
    if (const auto written = write_whole_file(path.string(), file.text); !written)
      return failed(written.error());
  }
  std::error_code trouble;
  fs::rename(unfinished, folder, trouble);
  if (trouble) return failed(cannot_write(folder.string()));
  return {};
}

ExitCode run_supplement(const SupplementArguments& arguments, Output& output) {
  // "out/" and "out" are the same folder.
  fs::path folder = fs::path(arguments.folder).lexically_normal();
  if (folder.filename().empty()) folder = folder.parent_path();
  if (std::error_code ignored; fs::exists(fs::symlink_status(folder, ignored))) {
    return fail(output, ExitCode::Usage,
                Error{ErrorKind::BadInput, "already exists; name another folder", folder.string()});
  }
  const auto store = arguments.store.open_whole();
  if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
  const bool with_pdfs = find_program("rsvg-convert").has_value();
  // A program that was built without pages cannot add a dashboard.
  std::function<Expected<std::string>()> dashboard;
  if (!page_files().empty()) {
    dashboard = [&] { return snapshot_page(*arguments.store.path(), {.version = program_name()}); };
  }
  auto filer = MachineFiler::open(**store);
  if (!filer) return fail(output, ExitCode::Store, filer.error());
  Counter counter(output, "made", "files");
  auto files = supplement(
      **store,
      {.machine_file = [&filer](CandidateId candidate) { return filer->text_of(candidate); },
       .program = program_name(),
       .with_pdfs = with_pdfs,
       .instance_tables = [&store] { return instance_tables(**store); },
       .runs_from_above = [&](DesignId design) { return runs_from_above(arguments.store, design); },
       .dashboard = dashboard,
       .progress = [&](std::size_t made) { counter.tell(static_cast<std::int64_t>(made), 0); }});
  if (files) {
    const auto made = static_cast<std::int64_t>(files->size());
    counter.tell(made, made);
  }
  if (!files) {
    const bool nothing = files.error().kind == ErrorKind::NotFound;
    return fail(output, nothing ? ExitCode::NoSuchId : ExitCode::Store, files.error());
  }
  if (with_pdfs) {
    if (const auto added = add_pdfs(*files, output); !added)
      return fail(output, ExitCode::Failed, added.error());
  } else {
    print_note(output,
               "no PDFs: the program rsvg-convert (Debian package librsvg2-bin) is not installed");
  }
  files->push_back({"SHA256SUMS", checksums_of(*files)});
  if (const auto written = write_folder(folder, *files); !written)
    return fail(output, ExitCode::Failed, written.error());
  if (output.json) {
    output.out << JsonObject()
                      .add("folder", folder.string())
                      .add("files", files->size())
                      .add("pdfs", with_pdfs)
                      .text()
               << "\n";
  } else {
    output.out << folder.string() << "\n";
  }
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_supplement(Options& options) {
  auto arguments = std::make_shared<SupplementArguments>();
  arguments->store.declare(options);
  options.text("-o,--output DIR", arguments->folder, "The new folder", Options::Need::Required);
  return [arguments](Output& output) { return run_supplement(*arguments, output); };
}

}  // namespace swarmsmith::cli
