#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// A formula over named numbers, as written in campaign files: + - * /, comparisons, `&&`, `||`,
/// `!`, `? :`, `pi`, and the functions abs, sqrt, min, max, floor, hypot, exp, log, pow, sin, cos,
/// atan2. Its results have the same bits on every computer, because it uses the functions of
/// base/math.h. Not thread-safe; copy it for each thread.
class CompiledFormula {
 public:
  /// Throws std::invalid_argument for a text with a fault.
  CompiledFormula(std::string text, std::span<const std::string_view> names);
  CompiledFormula(const CompiledFormula& other);
  CompiledFormula(CompiledFormula&& other) noexcept;
  CompiledFormula& operator=(const CompiledFormula& other);
  CompiledFormula& operator=(CompiledFormula&& other) noexcept;
  ~CompiledFormula();

  /// The error in the text, with its place; nothing for a valid text.
  static std::optional<std::string> fault(const std::string& text,
                                          std::span<const std::string_view> names);

  bool uses(std::string_view name) const;
  /// `values` must be in the order of the names.
  double operator()(std::span<const double> values) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace swarmsmith
