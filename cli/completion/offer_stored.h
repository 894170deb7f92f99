#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "console/complete.h"

namespace swarmsmith::cli {

/// Values of the kinds DESIGN, CANDIDATE (winners and elites), RUN (real runs), MISSION, METHOD,
/// SOURCE and PARAMETER, from the store that the words are about; names of PROFILE, FLAVOUR and
/// MISSION that every program has; BEST, the word for all winners. At most 1,000 values, and those
/// that a store gives within half a second.
void offer_stored(std::string_view kind, std::span<const std::string> words, Offer& offer);

/// The store that the words name: the first that is an SQLite file, with or without an option
/// before it; else SWARMSMITH_STORE; else the only one with the ending .db in `folder`.
std::optional<std::filesystem::path> store_in_words(std::span<const std::string> words,
                                                    const std::filesystem::path& folder);

}  // namespace swarmsmith::cli
