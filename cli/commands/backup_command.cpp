#include "base/text/json.h"
#include "storage/backup.h"

#include <memory>

#include "cli/arguments/store_argument.h"
#include "cli/commands/commands.h"
#include "console/counter.h"

namespace swarmsmith::cli {
namespace {

struct BackupArguments {
  std::vector<std::string> words;
  std::string out;
  StoreArgument store;
};

/// `backup STORE COPY`, or `backup COPY` with the store from the option or the environment.
ExitCode run_backup(BackupArguments& arguments, Output& output) {
  std::vector<std::string>& words = arguments.words;
  if (!arguments.out.empty()) words.push_back(arguments.out);
  if (words.size() == 2 && arguments.store.option.empty()) {
    arguments.store.word = words.front();
    words.erase(words.begin());
  }
  if (words.size() != 1) {
    return fail(output, ExitCode::Usage,
                "needs two files: `swarmsmith backup campaign.db copy.db`");
  }
  const auto store = arguments.store.path();
  if (!store) return fail(output, ExitCode::Usage, store.error());
  const std::string& copy = words.front();
  Counter counter(output, "copied", "pages");
  const auto made =
      back_up(*store, copy, [&](std::int64_t done, std::int64_t of) { counter.tell(done, of); });
  if (!made) {
    const bool about_copy = made.error().where == copy;
    return fail(output, about_copy ? ExitCode::Failed : ExitCode::Store, made.error());
  }
  if (made->migrated != 0) {
    // Schemas before 4 do not store the flavour of machines; the campaign's file has it.
    const auto named = open_at_rest(copy, StoreAtRest::IfMissing::Refuse);
    if (!named) return fail(output, ExitCode::Failed, named.error());
  }
  if (output.json) {
    output.out << JsonObject()
                      .add("copy", copy)
                      .add("digest", made->digest)
                      .add("schema", made->schema)
                      .add("from_schema", made->migrated == 0 ? made->schema : made->migrated)
                      .add("bytes", made->bytes)
                      .text()
               << "\n";
    return ExitCode::Done;
  }
  output.out << copy << ": " << made->bytes << " bytes, digest " << made->digest;
  if (made->migrated != 0) {
    output.out << ", schema " << made->schema << " (the original has " << made->migrated << ")";
  }
  output.out << "\n";
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_backup(Options& options) {
  auto arguments = std::make_shared<BackupArguments>();
  options.words("STORE_AND_COPY STORE", arguments->words, "The store's file, then the copy's");
  options.text("-o,--output STORE", arguments->out,
               "The copy's file, if it is not the second word");
  arguments->store.declare(options, false);
  return [arguments](Output& output) { return run_backup(*arguments, output); };
}

}  // namespace swarmsmith::cli
