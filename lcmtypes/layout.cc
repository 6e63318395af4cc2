#include "lcmtypes/layout.h"

#include <algorithm>
#include <vector>

namespace talus {
namespace {

constexpr std::string_view bad_counts = "counts do not match the size";

bool is_finite(FieldType type, std::uint64_t bits) {
  const std::uint64_t exponent = type == FieldType::float_field ? 0x7F800000U : 0x7FF0000000000000U;
  return (bits & exponent) != exponent;
}

/// Walks over the fields of one message, which the bytes begin with.
class LayoutCheck {
 public:
  explicit LayoutCheck(std::span<const std::uint8_t> bytes) : rest_(bytes) {}

  bool at_end() const { return rest_.empty(); }

  std::string_view fields(std::span<const MessageField> all) {
    counts_.resize(std::max(counts_.size(), first_ + all.size()));
    for (std::size_t i = 0; i < all.size(); ++i) {
      const MessageField& field = all[i];
      const std::size_t number = field.count_field < 0 ? field.number : counts_[first_ + field.count_field];
      if (number > rest_.size()) return bad_counts;  // of negative ones too; each entry takes a byte or more
      for (std::size_t k = 0; k < number; ++k) {
        const std::string_view fault = entry(all, i);
        if (!fault.empty()) return fault;
      }
    }
    return {};
  }

 private:
  std::string_view entry(std::span<const MessageField> all, std::size_t i) {
    const MessageField& field = all[i];
    if (field.type == FieldType::message_field) {
      first_ += all.size();
      const std::string_view fault = fields(field.fields);
      first_ -= all.size();
      return fault;
    }
    if (field.type == FieldType::string_field) return text();
    const std::size_t size = entry_bytes(field.type);
    if (size > rest_.size()) return bad_counts;
    const std::uint64_t value = take(size);
    counts_[first_ + i] = value;
    const bool real = field.type == FieldType::float_field || field.type == FieldType::double_field;
    if (real && !is_finite(field.type, value)) return "a number is not finite";
    if (field.type == FieldType::boolean_field && value > 1) return "a boolean is neither 0 nor 1";
    return {};
  }

  /// A string: its length with the final zero byte, then its bytes.
  std::string_view text() {
    if (rest_.size() < 4) return bad_counts;
    const std::uint64_t length = take(4);
    if (length == 0 || length > rest_.size() || rest_[length - 1] != 0) return bad_counts;
    rest_ = rest_.subspan(length);
    return {};
  }

  std::uint64_t take(std::size_t size) {
    const std::uint64_t value = big_endian(rest_.first(size));
    rest_ = rest_.subspan(size);
    return value;
  }

  std::span<const std::uint8_t> rest_;
  std::vector<std::uint64_t> counts_;  // last value of each field, those of the messages around it before
  std::size_t first_ = 0;              // of the message at hand
};

}  // namespace

std::string_view layout_fault(std::span<const MessageField> fields, std::span<const std::uint8_t> bytes) {
  if (bytes.size() < fingerprint_bytes) return bad_counts;
  LayoutCheck check(bytes.subspan(fingerprint_bytes));
  const std::string_view fault = check.fields(fields);
  if (!fault.empty()) return fault;
  return check.at_end() ? std::string_view{} : bad_counts;
}

}  // namespace talus
