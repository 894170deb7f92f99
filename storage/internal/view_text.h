#pragma once

#include <string>

namespace swarmsmith {

/// The views of schema/views.sql, with the modules that this program knows in flavour_name.
const std::string& our_views();

/// The statement of them that makes flavour_name.
const std::string& flavour_view();

}  // namespace swarmsmith
