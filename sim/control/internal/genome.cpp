#include "sim/control/internal/genome.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "sim/control/internal/module_text.h"

namespace swarmsmith {
namespace {

constexpr std::string_view kGenomeEnd = "genomeend";

/// Kinds of node: the last number in the line of a node.
enum class Kind { Hidden = 0, Input = 1, Output = 2, Bias = 3 };

constexpr bool is_keyword(std::string_view word) {
  return word == "trait" || word == "node" || word == "gene" || word == kGenomeEnd;
}

class GenomeReader {
 public:
  explicit GenomeReader(std::span<const Token> tokens) : rest_(tokens) {}

  Expected<Network> read() {
    rest_ = rest_.subspan(1);
    (void)take();  // its number
    while (true) {
      const Token keyword = take();
      std::optional<Error> error;
      if (keyword.text == kGenomeEnd) {
        (void)take();
        if (!rest_.front().text.empty())
          return Unexpected(error_at(rest_.front(), "expected the end after `genomeend`"));
        return network(keyword);
      }
      if (keyword.text == "trait") {
        while (!rest_.front().text.empty() && !is_keyword(rest_.front().text))
          (void)take();
      } else if (keyword.text == "node") {
        error = read_node();
      } else if (keyword.text == "gene") {
        error = read_gene();
      } else if (keyword.text.empty()) {
        error = error_at(keyword, "the genome is incomplete: `genomeend` is missing");
      } else {
        error = error_at(keyword,
                         "a genome has lines trait, node and gene, not " + quoted(keyword.text));
      }
      if (error) return Unexpected(std::move(*error));
    }
  }

 private:
  /// Returns the next token; at the end, the end token again and again.
  Token take() {
    const Token token = rest_.front();
    if (rest_.size() > 1) rest_ = rest_.subspan(1);
    return token;
  }

  template <std::size_t Count>
  Expected<std::array<double, Count>> numbers(std::string_view owner) {
    std::array<double, Count> values{};
    for (double& value : values) {
      const Token token = take();
      if (!read_number(token.text, value)) {
        return Unexpected(
            error_at(token, quoted(owner) + " must be a number, not " + quoted(token.text)));
      }
    }
    return values;
  }

  std::optional<Error> read_node() {
    const Token at = rest_.front();
    const auto values = numbers<4>("node");
    if (!values) return values.error();
    const auto& [id, trait, is_sensor, label] = *values;
    if (place_of(id, inputs_) || place_of(id, outputs_))
      return error_at(at, "the genome has node " + std::string(at.text) + " twice");
    if (label == static_cast<double>(Kind::Output)) {
      outputs_.push_back(id);
    } else if (label == static_cast<double>(Kind::Hidden)) {
      ++hidden_;
    } else {
      has_bias_ = label == static_cast<double>(Kind::Bias);  // the last of these nodes must be the
                                                             // bias
      inputs_.push_back(id);
    }
    return std::nullopt;
  }

  std::optional<Error> read_gene() {
    const Token at = rest_.front();
    const auto values = numbers<8>("gene");
    if (!values) return values.error();
    const auto& [trait, from, to, weight, is_recurrent, innovation, mutation, is_enabled] = *values;
    // A disabled gene stays in a NEAT genome, but transmits nothing.
    genes_.push_back({.at = at,
                      .from = from,
                      .to = to,
                      .weight = is_enabled == 0 ? 0 : weight,
                      .is_recurrent = is_recurrent != 0});
    return std::nullopt;
  }

  static std::optional<std::size_t> place_of(double id, const std::vector<double>& ids) {
    const auto found = std::ranges::find(ids, id);
    if (found == ids.end()) return std::nullopt;
    return static_cast<std::size_t>(found - ids.begin());
  }

  /// Converts nodes and genes to weights.
  Expected<Network> network(const Token& end) const {
    if (hidden_ > 0) {
      return Unexpected(error_at(
          end, "a genome of NEAT with " + std::to_string(hidden_) +
                   (hidden_ == 1 ? " hidden node" : " hidden nodes") +
                   "; only networks without a hidden layer can be read, as EvoStick, CMA-ES and "
                   "xNES make them"));
    }
    const bool has_single_sensors = inputs_.size() == input_count(NetworkInputs::Rm11);
    Network network{.inputs = has_single_sensors ? NetworkInputs::Rm11 : NetworkInputs::Rm12,
                    .weights = {}};
    const std::size_t count = input_count(network.inputs);
    if (inputs_.size() != count) {
      return Unexpected(error_at(
          end, "a genome of " + std::to_string(inputs_.size()) +
                   " inputs; only those of rm1.2 and rm1.1 can be read, with " +
                   std::to_string(count) + " and " +
                   std::to_string(input_count(NetworkInputs::Rm11)) + ", including the bias"));
    }
    if (!has_bias_)
      return Unexpected(error_at(end, "the last input of the genome must be a bias, as in rm1.2"));
    if (outputs_.size() != kWheels)
      return Unexpected(error_at(end, "a genome has 2 outputs, the left wheel and the right one"));
    network.weights.resize(kWheels * count);
    std::vector<bool> is_known(network.weights.size());
    for (const Gene& gene : genes_) {
      const auto input = place_of(gene.from, inputs_);
      const auto output = place_of(gene.to, outputs_);
      const std::string name = "from node " + shortest(gene.from) + " to node " + shortest(gene.to);
      if (!input || !output || gene.is_recurrent) {
        return Unexpected(error_at(
            gene.at, std::string("the genome has a ") + (gene.is_recurrent ? "recurrent " : "") +
                         "gene " + name + ", but only genes from inputs to outputs can be read"));
      }
      const std::size_t place = *output * count + *input;
      if (is_known[place])
        return Unexpected(error_at(gene.at, "the genome has a gene " + name + " twice"));
      is_known[place] = true;
      network.weights[place] = gene.weight;
    }
    return network;
  }

  struct Gene {
    Token at;
    double from = 0;
    double to = 0;
    double weight = 0;
    bool is_recurrent = false;
  };

  std::span<const Token> rest_;
  std::vector<double> inputs_;  ///< numbers of the input nodes in their order, the bias included
  std::vector<double> outputs_;
  std::vector<Gene> genes_;
  int hidden_ = 0;
  bool has_bias_ = false;
};

}  // namespace

Expected<Network> read_genome(std::span<const Token> tokens) {
  return GenomeReader(tokens).read();
}

}  // namespace swarmsmith
