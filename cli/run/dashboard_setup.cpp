#include "cli/run/dashboard_setup.h"

#include <unistd.h>
#include <system_error>
#include <utility>

#include "base/environment.h"
#include "cli/run/ask_campaign.h"
#include "coordinator/service/http_address.h"
#include "proto/access/address.h"

namespace swarmsmith::cli {

Expected<std::unique_ptr<DashboardSetup>> DashboardSetup::make(
    DashboardOptions options, const CoordinatorArgument& coordinator, bool own_token) {
  std::unique_ptr<DashboardSetup> setup(new DashboardSetup());
  bool may_act = own_token;
  std::optional<Error> trouble;
  if (!own_token) {
    setup->token_ = new_token();
    const std::filesystem::path file = token_file_of(options.stores.front().file);
    const auto written = write_token(file, setup->token_);
    may_act = written.has_value();
    if (may_act) setup->file_ = file;
    // A store in somebody else's folder can be looked at.
    if (!may_act) setup->token_.clear();
  }
  if (may_act) {
    options.act = [coordinator](const std::filesystem::path& store, const CommandRow& command) {
      return ask_campaign(store, coordinator, command);
    };
  }
  // The program that this is: what runs beside it is of the same version.
  if (options.program.empty()) options.program = "/proc/self/exe";
  setup->site_ = make_dashboard(std::move(options));
  return setup;
}

DashboardSetup::~DashboardSetup() {
  std::error_code none;
  if (!file_.empty()) std::filesystem::remove(file_, none);
}

void DashboardSetup::announce(Output& output, const std::string& address) const {
  const std::string secret = output.err_is_terminal && !token_.empty() ? "#t=" + token_ : "";
  print_note(output, "dashboard: http://" + address + "/" + secret);
  const auto parsed = parse_http_address(address);
  if (environment("SSH_CONNECTION").empty() || !parsed || !is_loopback(*parsed)) return;
  print_note(output, "from your desk: ssh -NL " + std::to_string(parsed->port) + ":" + address +
                         " " + user_and_host());
}

}  // namespace swarmsmith::cli
