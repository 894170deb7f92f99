#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace swarmsmith {

/// A frame of a write-ahead log: a page as it is from then on.
struct LogFrame {
  std::uint32_t page = 0;
  std::uint32_t pages_after = 0;  ///< of the database; 0 unless the frame ends a transaction
  std::string bytes;              ///< of the log's page size
};

/// A write-ahead log whose checksums hold, whatever its frames say.
/// https://www.sqlite.org/fileformat2.html, section 4.1
inline std::string write_ahead_log(const std::vector<LogFrame>& frames, std::uint32_t page_size) {
  const auto number = [](std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8)
      bytes += static_cast<char>(value >> static_cast<unsigned>(shift) & 0xffU);
    return bytes;
  };
  std::uint32_t first = 0, second = 0;
  const auto add = [&](const std::string& bytes) {
    const auto word = [&](std::size_t at) {
      std::uint32_t value = 0;
      for (std::size_t i = 0; i < 4; ++i)
        value = value << 8U | static_cast<unsigned char>(bytes[at + i]);
      return value;
    };
    for (std::size_t at = 0; at + 8 <= bytes.size(); at += 8) {
      first += word(at) + second;
      second += word(at + 4) + first;
    }
  };
  const std::string salts = number(1) + number(2);
  const std::string header = number(0x377f0683) + number(3007000) + number(page_size) + number(0) +
                             salts;  // its words are big-endian
  add(header);
  std::string log = header + number(first) + number(second);
  for (const LogFrame& frame : frames) {
    const std::string head = number(frame.page) + number(frame.pages_after);
    add(head);
    add(frame.bytes);
    log += head + salts + number(first) + number(second) + frame.bytes;
  }
  return log;
}

}  // namespace swarmsmith
