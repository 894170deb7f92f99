#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace swarmsmith {

/// A formula over named numbers, as campaign files have it: + - * /, comparisons, `&&`, `||`, `!`,
/// `? :`, `pi`, and the functions abs, sqrt, min, max, floor, hypot, exp, log, pow, sin, cos,
/// atan2. Its bits are the same on every computer, since the functions are those of base/math.h.
/// Values may be copied; each copy is for one thread.
class CompiledFormula {
 public:
  /// Throws std::invalid_argument for a text with a fault.
  CompiledFormula(std::string text, std::span<const std::string_view> names);
  CompiledFormula(const CompiledFormula& other);
  CompiledFormula(CompiledFormula&& other) noexcept;
  CompiledFormula& operator=(const CompiledFormula& other);
  CompiledFormula& operator=(CompiledFormula&& other) noexcept;
  ~CompiledFormula();

  /// What is wrong with the text and where in it; nothing for a good one.
  static std::optional<std::string> fault(const std::string& text,
                                          std::span<const std::string_view> names);

  bool uses(std::string_view name) const;
  /// `values` in the order of the names.
  double operator()(std::span<const double> values) const;

 private:
  struct Compiled;
  std::unique_ptr<Compiled> compiled_;
};

}  // namespace swarmsmith
