#pragma once

#include <string>

namespace swarmsmith::cli {

/// A commented campaign file that runs as it is.
std::string campaign_template(const std::string& mission, const std::string& flavour);

}  // namespace swarmsmith::cli
