#pragma once
// Numbers in the bytes that the browser page reads.

#include <cstdint>
#include <string>
#include <string_view>

namespace talus {

/// `u` of FrameEncoder: seven bits a byte, low bits first.
void write_unsigned(std::string& bytes, std::uint64_t value);
/// `s`: zigzag over `u`.
void write_signed(std::string& bytes, std::int64_t value);
/// `f`: four bytes, low byte first.
void write_float(std::string& bytes, float value);

/// Reads what these write. Throws std::out_of_range where the bytes end too soon.
class StreamReader {
 public:
  explicit StreamReader(std::string_view bytes) : bytes_(bytes) {}

  std::uint64_t number();
  std::int64_t difference();
  float real();
  std::string text(std::size_t size);
  bool done() const { return at_ == bytes_.size(); }

 private:
  std::string_view bytes_;  // must outlive the reader
  std::size_t at_ = 0;
};

/// The nearest whole number of quanta; at most 2^30 in size.
std::int32_t in_quanta(double value, double quantum);

}  // namespace talus
