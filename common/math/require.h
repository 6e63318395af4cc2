#pragma once
// How a bad value is refused.

#include <stdexcept>
#include <string>
#include <string_view>

namespace talus {

/// A value that breaks a rule. what() is "FIELD = VALUE: RULE".
class InvalidValue : public std::invalid_argument {
 public:
  InvalidValue(std::string field, std::string value, std::string rule);

  const std::string& field() const { return field_; }
  const std::string& value() const { return value_; }
  const std::string& rule() const { return rule_; }

 private:
  std::string field_;
  std::string value_;
  std::string rule_;
};

[[noreturn]] void refuse(std::string_view field, double value, std::string_view rule);

/// Throws InvalidValue unless `holds`. A rule is written as "must be ...". The first one stands in loops over bodies.
inline void require(bool holds, std::string_view field, double value, std::string_view rule) {
  if (!holds) refuse(field, value, rule);
}
void require(bool holds, std::string_view field, const std::string& value, std::string_view rule);

}  // namespace talus
