#include <memory>

#include "base/shown_text.h"
#include "coordinator/cli/commands.h"
#include "coordinator/cli/store_argument.h"
#include "coordinator/design/verify.h"

namespace swarmsmith::cli {
namespace {

void write(Output& output, const Verification& found) {
  if (output.json) {
    std::string complaints;
    for (const std::string& complaint : found.complaints) {
      complaints += (complaints.empty() ? "" : ",") + json_text(complaint);
    }
    output.out << "{\"clean\":" << (found.complaints.empty() ? "true" : "false")
               << ",\"designs\":" << found.designs << ",\"finished\":" << found.finished
               << ",\"evaluations\":" << found.evaluations << ",\"real_runs\":" << found.real_runs
               << ",\"complaints\":[" << complaints << "]}\n";
    return;
  }
  for (const std::string& complaint : found.complaints)
    output.out << as_shown(complaint, Layout::Escaped) << "\n";
  if (found.complaints.empty()) {
    output.out << "clean: " << found.evaluations << " evaluations of " << found.designs
               << " designs, " << found.finished << " finished; every race was played again";
    if (found.real_runs > 0) output.out << "; " << found.real_runs << " real runs scored again";
    output.out << "\n";
  }
}

}  // namespace

Run declare_verify(Options& options) {
  auto argument = std::make_shared<StoreArgument>();
  argument->declare(options);
  return [argument](Output& output) {
    const auto store = argument->open();
    if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
    const auto found = verify(**store);
    if (!found) return fail(output, ExitCode::Store, found.error());
    write(output, *found);
    return found->complaints.empty() ? ExitCode::Done : ExitCode::Store;
  };
}

}  // namespace swarmsmith::cli
