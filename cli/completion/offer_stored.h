#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "console/complete.h"

namespace swarmsmith::cli {

/// Offers completions. From the store on the command line: values of the kinds DESIGN, CANDIDATE
/// (winners and elites), RUN (real runs), MISSION, METHOD, SOURCE and PARAMETER. Built in: names of
/// PROFILE, FLAVOUR and MISSION, and BEST, the word for all winners. Offers at most 1,000 values,
/// and only those that the store returns within half a second.
void offer_stored(std::string_view kind, std::span<const std::string> words, Offer& offer);

/// The store on the command line: the first argument, or value of an option (--store=FILE), that is
/// an SQLite file; else SWARMSMITH_STORE; else the .db file in `folder`, if there is only one.
std::optional<std::filesystem::path> store_in_words(std::span<const std::string> words,
                                                    const std::filesystem::path& folder);

}  // namespace swarmsmith::cli
