#pragma once
// The layout of messages: what lcm-gen encodes, field by field.

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

namespace talus {

/// The unsigned number that up to eight bytes hold, the most significant one first.
inline std::uint64_t big_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (const std::uint8_t byte : bytes) value = value << 8 | byte;
  return value;
}

/// The types of the LCM language that our messages use.
enum class FieldType : std::uint8_t {
  boolean_field,
  int8_t_field,
  int16_t_field,
  int32_t_field,
  int64_t_field,
  float_field,
  double_field,
  string_field,
  message_field,  // a struct of its own, without fingerprint
};

/// Encoded size of the number that LCM puts before a message, made from its type [bytes].
inline constexpr std::size_t fingerprint_bytes = 8;

/// One field of a message.
struct MessageField {
  std::string_view name;
  FieldType type = FieldType::int8_t_field;
  /// Number of entries, unless count_field is set.
  std::size_t number = 1;
  /// Which field of the same message, an int32_t, has the number of entries; -1: none.
  int count_field = -1;
  /// Of a message_field: its own fields.
  std::span<const MessageField> fields = {};
};

/// The fields of a message type in their order, made from its .lcm file (talus_lcm/layouts.h).
template <class Message>
inline constexpr std::span<const MessageField> layout = {};

/// Bytes of one entry of a field; 0 for a string and for a message, whose sizes vary.
constexpr std::size_t entry_bytes(FieldType type) {
  switch (type) {
    case FieldType::boolean_field:
    case FieldType::int8_t_field:
      return 1;
    case FieldType::int16_t_field:
      return 2;
    case FieldType::int32_t_field:
    case FieldType::float_field:
      return 4;
    case FieldType::int64_t_field:
    case FieldType::double_field:
      return 8;
    case FieldType::string_field:
    case FieldType::message_field:
      return 0;
  }
  return 0;
}

/// Bytes of the fields that every message of a type has, without fingerprint, strings and counted entries.
constexpr std::size_t fixed_bytes(std::span<const MessageField> fields) {
  std::size_t bytes = 0;
  for (const MessageField& field : fields)
    if (field.count_field < 0) bytes += field.number * entry_bytes(field.type);
  return bytes;
}

/// Bytes that one more entry takes in the fields whose number is the field `count`.
constexpr std::size_t bytes_per_entry(std::span<const MessageField> fields, std::string_view count) {
  std::size_t bytes = 0;
  for (const MessageField& field : fields)
    if (field.count_field >= 0 && fields[field.count_field].name == count)
      bytes += field.fields.empty() ? entry_bytes(field.type) : fixed_bytes(field.fields);
  return bytes;
}

/// What keeps encoded bytes, fingerprint and checksum included, from being a message of this layout: a count or a text
/// that does not match the bytes left, bytes that follow, a number that is not finite, a boolean other than 0 and 1.
/// Empty where nothing does. Takes no memory, whatever the counts are.
std::string_view layout_fault(std::span<const MessageField> fields, std::span<const std::uint8_t> bytes);

}  // namespace talus
