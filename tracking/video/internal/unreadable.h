#pragma once

#include <string>

#include "tracking/rig/issue.h"

namespace swarmsmith {

/// An E_VIDEO_UNREADABLE with the message "NAME TEXT".
inline Unexpected unreadable(const std::string& text, const std::string& name) {
  return Unexpected(error_of(IssueCode::VideoUnreadable, text, name));
}

}  // namespace swarmsmith
