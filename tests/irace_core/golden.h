#pragma once

#include <cmath>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

namespace swarmsmith::testing {

/// A file of tests/golden/irace.
inline nlohmann::json golden(const std::string& file) {
  std::ifstream in(std::string(SWARMSMITH_TEST_DATA) + "/irace/" + file);
  if (!in) throw std::runtime_error("no golden file " + file);
  return nlohmann::json::parse(in);
}

/// One part of such a file, by value: the file itself is gone after the call.
inline nlohmann::json golden(const std::string& file, const std::string& part) {
  nlohmann::json found = golden(file).at(part);
  if (found.empty()) throw std::runtime_error(file + ": nothing in " + part);
  return found;
}

/// R writes vectors of length one as plain values.
template <class T>
std::vector<T> as_vector(const nlohmann::json& json) {
  if (json.is_array()) return json.get<std::vector<T>>();
  return {json.get<T>()};
}

/// null is "not evaluated" (or, in race traces, a rejection).
inline double number_or(const nlohmann::json& json, double otherwise) {
  return json.is_null() ? otherwise : json.get<double>();
}

/// Rows of numbers; a column where R has dropped the dimension.
inline std::vector<std::vector<double>> as_matrix(const nlohmann::json& json, double missing) {
  std::vector<std::vector<double>> rows;
  for (const auto& row : json) {
    std::vector<double>& values = rows.emplace_back();
    if (!row.is_array()) {
      values.push_back(number_or(row, missing));
      continue;
    }
    for (const auto& value : row)
      values.push_back(number_or(value, missing));
  }
  return rows;
}

inline constexpr double kNotEvaluated = std::numeric_limits<double>::quiet_NaN();

}  // namespace swarmsmith::testing
