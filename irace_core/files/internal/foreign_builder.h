#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "irace_core/files/foreign_space.h"

namespace swarmsmith::irace {

/// A parameter of another tool's file.
struct ForeignParameter {
  std::string name;         ///< in the file
  std::string switch_text;  ///< printed before the value
  Domain domain;
  std::optional<std::string> initial;  ///< the default value, as text
  std::string where;
};

/// Collects parameters, conditions and forbidden clauses, under their names in the file.
class ForeignBuilder {
 public:
  explicit ForeignBuilder(std::string file) : file_(std::move(file)) {}

  Expected<void> add(ForeignParameter parameter);
  /// `name <operation> values`: Equal to GreaterEqual take one value, In any number. Ordinals are
  /// compared by the order of their values.
  Expected<Expression> compare(const std::string& name, Operation operation,
                               std::span<const std::string> values, const std::string& where) const;
  /// A comparison between two numeric parameters.
  Expected<Expression> relate(const std::string& left, Operation operation,
                              const std::string& right, const std::string& where) const;
  /// Adds a condition; all conditions of a parameter must hold.
  Expected<void> restrict(const std::string& name, Expression condition, const std::string& where);
  void forbid(Expression clause) { forbidden_.push_back(std::move(clause)); }
  void warn(const std::string& where, const std::string& sentence) {
    warnings_.push_back(where + ": " + sentence);
  }

  Expected<ForeignSpace> build(const ForeignSpaceOptions& options) &&;

 private:
  struct Known {
    ForeignParameter foreign;
    std::string name;  ///< the name for irace
    std::optional<Expression> condition;
  };

  Expected<const Known*> find(const std::string& name, const std::string& where) const;
  /// An error of the space, with the place of the parameter that it names, otherwise of the file.
  Error placed(Error error) const;
  int digits() const;
  Expected<std::optional<Configuration>> defaults(const ParameterSpace& space);

  std::string file_;
  std::vector<Known> known_;
  std::map<std::string, std::size_t> by_name_;  ///< by the name in the file
  std::vector<Expression> forbidden_;
  std::vector<std::string> warnings_;
  int renamed_ = 0;               ///< number of names that irace does not allow
  std::size_t last_renamed_ = 0;  ///< number of warnings when the last name was changed
};

}  // namespace swarmsmith::irace
