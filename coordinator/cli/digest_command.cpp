#include <memory>

#include "coordinator/cli/commands.h"
#include "coordinator/cli/store_argument.h"

namespace swarmsmith::cli {

Run declare_digest(Options& options) {
  auto argument = std::make_shared<StoreArgument>();
  argument->declare(options);
  return [argument](Output& output) {
    const auto store = argument->open();
    if (!store) return fail(output, exit_code_of_store(store.error()), store.error());
    const std::string digest = (*store)->digest();
    if (output.json) {
      output.out << "{\"digest\":" << json_text(digest)
                 << ",\"campaign\":" << json_text((*store)->campaign().digest) << "}\n";
    } else {
      output.out << digest << "\n";
    }
    return ExitCode::Done;
  };
}

}  // namespace swarmsmith::cli
