#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Colours for the categories of several parameters, so that a value has the same colour
/// everywhere: lists that share a value form a family with one palette. Whole numbers get shades in
/// their order; words get colours that are easy to distinguish.
class CategoryColors {
 public:
  explicit CategoryColors(const std::vector<std::vector<std::string>>& lists);

  std::string color(const std::string& value) const;

  /// The values of a family with their colours, in order.
  using Family = std::vector<std::pair<std::string, std::string>>;
  const std::vector<Family>& families() const { return families_; }
  /// Whether a list belongs to a family.
  static bool belongs(const std::vector<std::string>& list, const Family& family);

 private:
  std::vector<Family> families_;
};

}  // namespace swarmsmith
