#include "cli/run/dashboard_setup.h"

#include <unistd.h>
#include <algorithm>
#include <system_error>
#include <utility>

#include "base/address.h"
#include "base/environment.h"
#include "base/program_path.h"
#include "cli/run/ask_campaign.h"
#include "coordinator/service/http_address.h"
#include "storage/store.h"

namespace swarmsmith::cli {

std::unique_ptr<DashboardSetup> DashboardSetup::make(DashboardOptions options,
                                                     const CoordinatorArgument& coordinator,
                                                     Secret secret) {
  std::unique_ptr<DashboardSetup> setup(new DashboardSetup());
  bool may_act = secret == Secret::OfOnesOwn;
  if (!may_act) {
    const std::filesystem::path& store = options.stores.front().file;
    const std::filesystem::path file = token_file_of(store);
    if (secret == Secret::Joined && has_writer(store))
      setup->token_ = read_token(file).value_or("");
    if (setup->token_.empty()) {
      setup->token_ = new_token();
      // A store in another user's folder can only be viewed.
      if (write_token(file, setup->token_)) {
        setup->file_ = file;
      } else {
        setup->token_.clear();
      }
    }
    may_act = !setup->token_.empty();
  }
  if (may_act) {
    options.act = [coordinator, stores = options.stores](const std::filesystem::path& store,
                                                         const CommandRow& command) {
      const auto known = std::ranges::find(stores, store, &DashboardStore::file);
      const bool is_its_own = known == stores.end() || !known->place;
      return ask_campaign(store, is_its_own ? coordinator.of_store() : coordinator, command);
    };
  }
  // Uses this program itself, so that the child process has the same version.
  if (options.program.empty()) options.program = same_program();
  setup->site_ = make_dashboard(std::move(options));
  return setup;
}

DashboardSetup::~DashboardSetup() {
  std::error_code none;
  // A run of the campaign that began later has put its own token there.
  if (!file_.empty() && read_token(file_) == token_) std::filesystem::remove(file_, none);
}

void DashboardSetup::announce(Output& output, const std::string& address) const {
  const std::string secret = output.err_is_terminal && !token_.empty() ? "#t=" + token_ : "";
  print_note(output, "dashboard: http://" + address + "/" + secret);
  const auto parsed = parse_address(address);
  if (environment("SSH_CONNECTION").empty() || !parsed || !is_loopback(parsed->host)) return;
  print_note(output, "from your desk: ssh -NL " + std::to_string(parsed->port) + ":" + address +
                         " " + user_and_host());
}

}  // namespace swarmsmith::cli
