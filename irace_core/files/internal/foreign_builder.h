#pragma once

#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "irace_core/files/foreign_space.h"

namespace swarmsmith::irace {

/// A parameter as another tool's file has it.
struct ForeignParameter {
  std::string name;         ///< of the file
  std::string switch_text;  ///< stands before the value
  Domain domain;
  std::optional<std::string> initial;  ///< the default, as a text
  std::string where;
};

/// Collects parameters, conditions and forbidden clauses under the file's own names.
class ForeignBuilder {
 public:
  explicit ForeignBuilder(std::string file) : file_(std::move(file)) {}

  Expected<void> add(ForeignParameter parameter);
  /// `name <operation> values`: Equal to GreaterEqual with one value, In with any number. On
  /// ordinals the order is that of their values.
  Expected<Expression> compare(const std::string& name, Operation operation,
                               std::span<const std::string> values, const std::string& where) const;
  /// A comparison of two numeric parameters.
  Expected<Expression> relate(const std::string& left, Operation operation,
                              const std::string& right, const std::string& where) const;
  /// All conditions of a parameter must hold.
  Expected<void> restrict(const std::string& name, Expression condition, const std::string& where);
  void forbid(Expression clause) { forbidden_.push_back(std::move(clause)); }
  void warn(const std::string& where, const std::string& sentence) {
    warnings_.push_back(where + ": " + sentence);
  }

  Expected<ForeignSpace> build(const ForeignSpaceOptions& options) &&;

 private:
  struct Known {
    ForeignParameter foreign;
    std::string name;  ///< irace's
    std::optional<Expression> condition;
  };

  Expected<const Known*> find(const std::string& name, const std::string& where) const;
  /// An error of the space, at the parameter that it names, else in the file.
  Error placed(Error error) const;
  int digits() const;
  Expected<std::optional<Configuration>> defaults(const ParameterSpace& space);

  std::string file_;
  std::vector<Known> known_;
  std::map<std::string, std::size_t> by_name_;  ///< the file's
  std::vector<Expression> forbidden_;
  std::vector<std::string> warnings_;
  int renamed_ = 0;               ///< names that irace cannot have
  std::size_t last_renamed_ = 0;  ///< warnings when the last one came
};

}  // namespace swarmsmith::irace
