#pragma once

#include <string>
#include <utility>
#include <vector>

namespace swarmsmith {

/// Colours for the categories of several parameters, such that one value has one colour: lists that
/// share a value belong together and share a palette. Whole numbers get shades in their order,
/// words colours that are easily told apart.
class CategoryColors {
 public:
  explicit CategoryColors(const std::vector<std::vector<std::string>>& lists);

  std::string color(const std::string& value) const;

  /// Values and their colours, in their order.
  using Family = std::vector<std::pair<std::string, std::string>>;
  const std::vector<Family>& families() const { return families_; }
  /// Whether a list belongs to a family.
  static bool belongs(const std::vector<std::string>& list, const Family& family);

 private:
  std::vector<Family> families_;
};

}  // namespace swarmsmith
