#include "cli/commands/export_formats.h"

#include <algorithm>
#include <filesystem>
#include <map>

#include "analysis/records/records.h"
#include "base/output_file.h"
#include "base/plain_text.h"
#include "base/text/json.h"
#include "base/text/whole_file.h"
#include "cli/arguments/thing_id.h"
#include "cli/commands/irace_converter.h"
#include "console/counter.h"
#include "coordinator/results/irace_log.h"
#include "coordinator/results/known_designs.h"
#include "coordinator/results/stored_irace_log.h"

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

/// The named design, or the store's only one.
Expected<DesignId> wanted_design(StoreReader& store, const std::string& word) {
  const auto designs = known_designs(store);
  if (!designs) return Unexpected(designs.error());
  if (word.empty() && designs->size() == 1) return designs->front().id;
  std::string known;
  for (const KnownDesign& design : *designs) {
    if (to_string(design.id) == word) return design.id;
    if (design.id.value <= 20) {
      known += (known.empty() ? "" : ", ") + to_string(design.id) + " " + design.mission + " " +
               design.method + " repetition " + std::to_string(design.repetition);
    }
  }
  if (designs->size() > 20) known += ", ...";
  if (word.empty()) return bad_input("no design given; the store has: " + known, "--design");
  const auto id = parse_thing_id(word);
  if (!id || id->letter != 'd') {
    return bad_input("must be an id such as d3, not \"" + word + "\"", "--design");
  }
  return unexpected(ErrorKind::NotFound, "the store has no design " + word + "; it has: " + known);
}

bool is_folder(const std::string& place) {
  std::error_code ignored;
  return place.ends_with('/') || fs::is_directory(place, ignored);
}

/// Does not overwrite files.
Expected<void> write_tables(const fs::path& folder,
                            const std::map<std::string, std::string>& tables) {
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  for (const auto& [name, text] : tables) {
    if (!fs::exists(folder / name, trouble)) continue;
    return bad_input("already exists; name another folder with -o", (folder / name).string());
  }
  for (const auto& [name, text] : tables) {
    if (auto written = write_whole_file((folder / name).string(), text); !written) return written;
  }
  return {};
}

/// Checks the output place before R starts to work.
Expected<void> check_place(const std::string& place) {
  const auto found = output_place(place, FileKind::Gzip);
  if (!found) return Unexpected(found.error());
  return {};
}

ExitCode exit_code_of(const Error& error) {
  if (error.kind == ErrorKind::NotFound) return ExitCode::NoSuchId;
  return error.kind == ErrorKind::BadInput ? ExitCode::Usage : ExitCode::Store;
}

ExitCode tell(const std::string& kind, const std::string& place, DesignId design,
              const IraceLog& log, Output& output) {
  if (output.json) {
    output.out << JsonObject()
                      .add(kind, place)
                      .add("design", design)
                      .add("configurations", log.configurations.size())
                      .add("experiments", log.runs.size())
                      .text()
               << "\n";
  } else {
    output.out << place << "\n";
  }
  const auto unknown = std::ranges::count_if(
      log.parameters, [](const LogParameter& parameter) { return parameter.domain.empty(); });
  if (unknown > 0) {
    print_note(output, "the store does not know the domains of " + counted(unknown, "parameter") +
                           "; the log gets the values that were tried instead");
  }
  return ExitCode::Done;
}

}  // namespace

ExitCode export_rdata(StoreReader& store, const std::string& design, const std::string& place,
                      Output& output) {
  if (place.empty()) {
    return fail(output, ExitCode::Usage,
                "--format rdata writes a file of R; name it with -o irace.Rdata, or a folder for "
                "its tables with -o FOLDER/");
  }
  const bool folder = is_folder(place);
  if (!folder) {
    const auto free = check_place(place);
    if (!free) return fail(output, ExitCode::Usage, free.error());
  }
  const auto id = wanted_design(store, design);
  if (!id) return fail(output, exit_code_of(id.error()), id.error());
  if (const std::string search = search_of(store, *id); !search.empty() && search != "f-race") {
    return fail(output, ExitCode::Usage,
                to_string(*id) + " was searched by " + search +
                    ", which has no races that a log of irace could hold");
  }
  Counter counter(output, "read", "rows");
  std::int64_t rows = 0;
  const auto log = stored_irace_log(store, *id, [&](std::int64_t read) {
    rows = read;
    counter.tell(rows, 0);
  });
  counter.tell(rows, rows);
  if (!log) return fail(output, exit_code_of(log.error()), log.error());
  if (log->configurations.empty()) {
    return fail(output, ExitCode::NoSuchId, "nothing has raced for " + to_string(*id) + " yet");
  }
  const auto tables = print_irace_log(*log);
  if (folder) {
    const auto written = write_tables(place, tables);
    if (written) return tell("folder", place, *id, *log, output);
    const bool bad = written.error().kind == ErrorKind::BadInput;
    return fail(output, bad ? ExitCode::Usage : ExitCode::Failed, written.error());
  }
  const auto bytes = make_irace_log(tables, place, output);
  if (!bytes) return fail(output, ExitCode::Failed, bytes.error());
  if (auto written = write_whole_file(place, *bytes); !written) {
    return fail(output, ExitCode::Failed, written.error());
  }
  return tell("file", place, *id, *log, output);
}

}  // namespace swarmsmith::cli
