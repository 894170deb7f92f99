#pragma once

#include <string>

#include "tracking/rig/issue.h"

namespace swarmsmith {

/// E_VIDEO_UNREADABLE: "NAME TEXT".
inline Unexpected unreadable(const std::string& text, const std::string& name) {
  return Unexpected(error_of(IssueCode::VideoUnreadable, text, name));
}

}  // namespace swarmsmith
