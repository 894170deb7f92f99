#include "console/sha256.h"

#include <sodium.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <vector>

namespace swarmsmith::cli {
namespace {

namespace fs = std::filesystem;

using Digest = std::array<unsigned char, crypto_hash_sha256_BYTES>;

std::string hexadecimal(const Digest& digest) {
  std::array<char, 2 * crypto_hash_sha256_BYTES + 1> text{};
  sodium_bin2hex(text.data(), text.size(), digest.data(), digest.size());
  return text.data();
}

Expected<std::string> sha256_of_file(const fs::path& file, std::int64_t& bytes,
                                     const std::function<void(std::int64_t)>& on_bytes) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return bad_input(std::string("cannot be read: ") + std::strerror(errno), file);
  crypto_hash_sha256_state state;
  crypto_hash_sha256_init(&state);
  std::vector<char> piece(1U << 20U);
  while (stream) {
    stream.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    const auto count = static_cast<std::size_t>(stream.gcount());
    crypto_hash_sha256_update(&state, reinterpret_cast<const unsigned char*>(piece.data()), count);
    bytes += stream.gcount();
    if (on_bytes) on_bytes(bytes);
  }
  if (stream.bad()) return bad_input(std::string("cannot be read: ") + std::strerror(errno), file);
  Digest digest{};
  crypto_hash_sha256_final(&state, digest.data());
  return hexadecimal(digest);
}

}  // namespace

std::string sha256_of(std::string_view bytes) {
  Digest digest{};
  crypto_hash_sha256(digest.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                     bytes.size());
  return hexadecimal(digest);
}

Expected<std::string> sha256_of_recording(const fs::path& path,
                                          const std::function<void(std::int64_t)>& on_bytes) {
  std::int64_t bytes = 0;
  std::error_code trouble;
  if (!fs::is_directory(path, trouble)) return sha256_of_file(path, bytes, on_bytes);
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : fs::directory_iterator(path, trouble)) {
    if (entry.is_regular_file(trouble)) files.push_back(entry.path());
  }
  std::ranges::sort(files);
  std::string list;
  for (const fs::path& file : files) {
    const auto digest = sha256_of_file(file, bytes, on_bytes);
    if (!digest) return digest;
    // As sha256sum prints it.
    list += *digest + "  " + file.filename().string() + "\n";
  }
  return sha256_of(list);
}

}  // namespace swarmsmith::cli
