#pragma once

#include <initializer_list>
#include <string>

#include "storage/rows.h"

namespace swarmsmith {

/// An event of the pool. Its texts may come from other processes and need not be UTF-8, so each
/// byte that is not ASCII becomes a question mark.
EventRow pool_event(std::string severity, std::string kind,
                    std::initializer_list<EventField> fields);

/// The name of an evaluation in sentences: "c812 on pair 7".
std::string name_of(const EvaluationKey& key);

}  // namespace swarmsmith
