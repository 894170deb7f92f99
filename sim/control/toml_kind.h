#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text/document.h"
#include "base/text/table_reader.h"

namespace swarmsmith {

/// The kinds of TOML files that a user may take for each other.
enum class TomlKind { Campaign, Mission, Robot, Profile, Flavour };

/// The kind of a file, judged by keys that no other kind has; nothing if the file has no such key.
std::optional<TomlKind> toml_kind_of(const Node& root);

/// The kind, with what takes it: "a robot file; `--robot FILE` takes it, ...".
std::string_view words_of(TomlKind kind);

/// The complaints about a file that was read as one of this kind. If it is a file of another kind,
/// one sentence says so instead.
std::vector<Error> complaints_about(const Node& root, TomlKind wanted, const std::string& file,
                                    Complaints& complaints);

}  // namespace swarmsmith
