#include "base/text/sha256.h"

#include <sodium.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <set>
#include <system_error>
#include <vector>

#include "base/output_file.h"

namespace swarmsmith {
namespace {

namespace fs = std::filesystem;

using Hash = std::array<unsigned char, crypto_hash_sha256_BYTES>;

std::string hexadecimal(const Hash& hash) {
  std::array<char, 2 * std::tuple_size_v<Hash> + 1> text{};
  sodium_bin2hex(text.data(), text.size(), hash.data(), hash.size());
  return text.data();
}

Unexpected cannot_read(const std::string& path, int error) {
  return unexpected(error == ENOENT ? ErrorKind::NotFound : ErrorKind::Unavailable,
                    "cannot be read: " + std::generic_category().message(error), path);
}

Expected<std::string> sha256_of_one(const std::string& path) {
  constexpr std::size_t kBlock = 1 << 18;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             std::fclose);
  if (file == nullptr) return cannot_read(path, errno);
  note_input(path);
  crypto_hash_sha256_state state{};
  crypto_hash_sha256_init(&state);
  std::vector<unsigned char> block(kBlock);
  std::size_t count = 0;
  do {
    errno = 0;
    count = std::fread(block.data(), 1, block.size(), file.get());
    crypto_hash_sha256_update(&state, block.data(), count);
  } while (count == block.size());
  if (std::ferror(file.get()) != 0) return cannot_read(path, errno);
  Hash hash{};
  crypto_hash_sha256_final(&state, hash.data());
  return hexadecimal(hash);
}

}  // namespace

std::string sha256_of(std::string_view bytes) {
  Hash hash{};
  crypto_hash_sha256(hash.data(), reinterpret_cast<const unsigned char*>(bytes.data()),
                     bytes.size());
  return hexadecimal(hash);
}

Expected<std::string> sha256_of_file(const std::string& path) {
  std::error_code error;
  if (!fs::is_directory(path, error)) return sha256_of_one(path);
  std::set<std::string> names;
  for (fs::directory_iterator entry(path, error), end; !error && entry != end;
       entry.increment(error)) {
    const std::string name = entry->path().filename().string();
    std::error_code ignored;
    if (!name.starts_with('.') && entry->is_regular_file(ignored)) names.insert(name);
  }
  if (error) return cannot_read(path, error.value());
  std::string lines;
  for (const std::string& name : names) {
    const auto hash = sha256_of_one((fs::path(path) / name).string());
    if (!hash) return hash;
    lines += *hash + "  " + name + "\n";
  }
  return sha256_of(lines);
}

}  // namespace swarmsmith
