#include <algorithm>
#include <cctype>
#include <memory>

#include "base/text/json.h"
#include "tracking/app/commands.h"
#include "tracking/app/run_store.h"

namespace swarmsmith {
namespace {

struct OverrideArguments {
  std::string run;
  std::string store;
  std::string verdict;
  std::string who;
  std::string reason;
};

bool is_blank(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) { return std::isspace(c) != 0; });
}

ExitCode run(const OverrideArguments& arguments, Output& output) {
  for (const auto& [option, text] :
       {std::pair("--who", arguments.who), std::pair("--reason", arguments.reason)}) {
    if (!is_blank(text)) continue;
    return fail(
        output, ExitCode::Usage,
        Error{ErrorKind::BadInput,
              "an override needs your name and a reason, for those who read the results", option});
  }
  const auto kept = kept_run(arguments.store, arguments.run);
  if (!kept) return fail(output, kept.error());
  const std::string& measured = kept->rows.score.verdict;
  std::string verdict = arguments.verdict;
  std::ranges::transform(verdict, verdict.begin(),
                         [](unsigned char c) { return static_cast<char>(std::toupper(c)); });
  const auto store = open_store(kept->store, StoreAtRest::IfMissing::Refuse);
  if (!store) return fail(output, store.error());
  const auto added = (*store)->add_override({kept->id, verdict, arguments.who, arguments.reason});
  if (!added) return fail(output, ExitCode::Store, added.error());
  if (output.json) {
    output.out << JsonObject()
                      .add("run", arguments.run)
                      .add("verdict", verdict)
                      .add("measured", measured)
                      .add("who", arguments.who)
                      .add("reason", arguments.reason)
                      .text()
               << "\n";
  } else {
    output.out << arguments.run << ": " << measured << " measured, " << verdict << " by "
               << arguments.who << ": " << arguments.reason << "\n";
  }
  return ExitCode::Done;
}

}  // namespace

CommandRun declare_track_override(Options& options) {
  auto arguments = std::make_shared<OverrideArguments>();
  options.text("RUN", arguments->run, "Run of the store: r7", Options::Need::Required);
  options.choice("--verdict", arguments->verdict, {"valid", "degraded", "invalid"},
                 "The new verdict", Options::Need::Required);
  options.text("--who NAME", arguments->who, "Your name", Options::Need::Required);
  options.text("--reason REASON", arguments->reason, "Why, for those who read the results",
               Options::Need::Required);
  options.text("--store STORE", arguments->store, "The store (else SWARMSMITH_STORE)");
  return [arguments](Output& output) { return run(*arguments, output); };
}

}  // namespace swarmsmith
