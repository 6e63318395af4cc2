// The table of contact records against the standard library's.

#include "sim2d/contact_records.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <unordered_map>

namespace talus::contact_records_test {
namespace {

const b2Contact* contact_at(int number) {
  return std::bit_cast<const b2Contact*>(std::uintptr_t{16} * static_cast<std::uintptr_t>(number + 1));
}

RC_GTEST_PROP(ContactRecords, FindWhatAnUnorderedMapFinds, (std::vector<std::vector<std::uint8_t>> steps)) {
  box2d::ContactRecords records;
  for (const std::vector<std::uint8_t>& step : steps) {
    records.clear();
    std::unordered_map<const b2Contact*, double> expected;
    for (const std::uint8_t number : step) {
      records[contact_at(number)].normal[0] += 1.0;
      expected[contact_at(number)] += 1.0;
    }
    for (int number = 0; number < 256; ++number) {
      const box2d::ContactRecord* found = records.find(contact_at(number));
      const auto known = expected.find(contact_at(number));
      RC_ASSERT((found != nullptr) == (known != expected.end()));
      if (found != nullptr) RC_ASSERT(found->normal[0] == known->second);
    }
  }
}

}  // namespace
}  // namespace talus::contact_records_test
