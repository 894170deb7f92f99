#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/expected.h"
#include "cli/dashboard/dashboard.h"
#include "cli/run/coordinator_link.h"
#include "console/output.h"
#include "coordinator/service/http_site.h"

namespace swarmsmith::cli {

/// A dashboard with the secret token for its commands. The token file exists as long as this
/// object.
class DashboardSetup {
 public:
  enum class Secret {
    OfOnesOwn,  ///< the user's own, in a token file
    New,        ///< written beside the first store
    Joined,     ///< the token of the process that runs the first store's campaign; new if there is
                ///< none
  };
  /// `coordinator`: gets the commands for running campaigns.
  static std::unique_ptr<DashboardSetup> make(DashboardOptions options,
                                              const CoordinatorArgument& coordinator,
                                              Secret secret);
  ~DashboardSetup();
  DashboardSetup(const DashboardSetup&) = delete;
  DashboardSetup& operator=(const DashboardSetup&) = delete;

  const std::shared_ptr<HttpSite>& site() const { return site_; }
  /// Empty if the user chose the token.
  const std::string& token() const { return token_; }
  /// Prints the address of the pages, and how to reach them from another host. The token is printed
  /// only to a terminal. `address`: HOST:PORT.
  void announce(Output& output, const std::string& address) const;

 private:
  DashboardSetup() = default;

  std::shared_ptr<HttpSite> site_;
  std::string token_;
  std::filesystem::path file_;
};

}  // namespace swarmsmith::cli
