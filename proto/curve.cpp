#include "proto/curve.h"

#include <zmq.h>
#include <algorithm>
#include <array>
#include <cstdint>
#include <stdexcept>

namespace swarmsmith {
namespace {

constexpr std::size_t kKeyCharacters = 40;
constexpr std::string_view kZ85Signs = ".-:+=^!/*?&<>()[]{}@%$#";

using KeyText = std::array<char, kKeyCharacters + 1>;

bool is_z85(char character) {
  return (character >= '0' && character <= '9') || (character >= 'a' && character <= 'z') ||
         (character >= 'A' && character <= 'Z') ||
         kZ85Signs.find(character) != std::string_view::npos;
}

}  // namespace

KeyPair make_key_pair() {
  KeyText public_key{};
  KeyText secret_key{};
  if (zmq_curve_keypair(public_key.data(), secret_key.data()) != 0) {
    throw std::runtime_error("this libzmq was built without CURVE: no keys can be made");
  }
  return {public_key.data(), secret_key.data()};
}

bool is_key(std::string_view text) {
  if (text.size() != kKeyCharacters || !std::ranges::all_of(text, is_z85)) return false;
  // Five characters can hold more than four bytes, so some texts are out of range.
  std::array<std::uint8_t, 32> bytes{};
  return zmq_z85_decode(bytes.data(), std::string(text).c_str()) != nullptr;
}

std::string public_key_of(const std::string& secret_key) {
  KeyText public_key{};
  if (zmq_curve_public(public_key.data(), secret_key.c_str()) != 0) {
    throw std::runtime_error("the public key cannot be derived from the secret one");
  }
  return public_key.data();
}

}  // namespace swarmsmith
