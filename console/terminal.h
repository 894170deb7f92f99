#pragma once

#include <ostream>
#include <streambuf>
#include <string>
#include <string_view>

#include "console/output.h"

namespace swarmsmith {

/// The stream between a program and its terminal: all text passes as shown text
/// (base/shown_text.h), whatever its source. Only text that the program marks as `Verbatim` passes
/// unchanged.
class ShownBuffer : public std::streambuf {
 public:
  explicit ShownBuffer(std::streambuf* behind) : behind_(behind) {}
  ~ShownBuffer() override;
  ShownBuffer(const ShownBuffer&) = delete;
  ShownBuffer& operator=(const ShownBuffer&) = delete;

  /// Whether all of it was written.
  bool pass(std::string_view bytes);

 protected:
  int_type overflow(int_type letter) override;
  std::streamsize xsputn(const char* bytes, std::streamsize size) override;
  int sync() override;

 private:
  bool show(std::string_view text);
  bool put(std::string_view bytes);

  std::streambuf* behind_;
  std::string begun_;  ///< a character whose last bytes have not come yet
};

/// Bytes of our own, such as control sequences.
struct Verbatim {
  std::string_view bytes;
};
std::ostream& operator<<(std::ostream& stream, Verbatim verbatim);

/// Moves to the start of the line and clears it.
inline constexpr Verbatim kClearLine{"\r\x1b[2K"};

/// An answer that programs read (CSV, an exported file, a picture), to standard output: exact in
/// files and pipes, shown on a terminal.
void write_data(Output& output, std::string_view bytes);

}  // namespace swarmsmith
