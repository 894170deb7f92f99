#pragma once

#include <charconv>
#include <compare>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace swarmsmith {

/// A small integer that identifies one thing of one kind, so that ids of two kinds cannot be
/// confused. `Tag` has a `static constexpr char kLetter`, the letter of printed ids: d3, c812. Zero
/// is not an id.
template <class Tag>
struct Id {
  std::int64_t value = 0;

  friend auto operator<=>(const Id&, const Id&) = default;
  explicit operator bool() const { return value != 0; }
};

template <class Tag>
std::string to_string(Id<Tag> id) {
  return Tag::kLetter + std::to_string(id.value);
}

/// The id in a text such as "d3"; empty when the text is not an id.
template <class Tag>
std::optional<Id<Tag>> id_from_text(std::string_view text) {
  if (text.empty() || text.front() != Tag::kLetter) return std::nullopt;
  Id<Tag> id;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + 1, end, id.value);
  if (error != std::errc() || stop != end || id.value < 1) return std::nullopt;
  return id;
}

struct DesignTag {
  static constexpr char kLetter = 'd';
};
struct CandidateTag {
  static constexpr char kLetter = 'c';
};
struct RealRunTag {
  static constexpr char kLetter = 'r';
};

/// One (mission, method, repetition) of a campaign: one iterated race.
using DesignId = Id<DesignTag>;
/// A configuration that a design tried.
using CandidateId = Id<CandidateTag>;
/// A filmed trial of real robots.
using RealRunId = Id<RealRunTag>;

}  // namespace swarmsmith

template <class Tag>
struct std::hash<swarmsmith::Id<Tag>> {
  std::size_t operator()(swarmsmith::Id<Tag> id) const noexcept {
    return std::hash<std::int64_t>{}(id.value);
  }
};
