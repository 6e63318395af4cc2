// The table of contact records against the standard library's.

#include "sim2d/contact_records.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <unordered_map>

namespace talus::contact_records_test {
namespace {

/// Contacts of 23 discs that overlap, each with each.
class Discs {
 public:
  Discs() : world_({0.0F, 0.0F}) {
    b2CircleShape disc;
    disc.m_radius = 1.0F;
    b2FixtureDef fixture;
    fixture.shape = &disc;
    fixture.density = 1.0F;
    b2BodyDef body;
    body.type = b2_dynamicBody;
    for (int i = 0; i < 23; ++i) {
      fixture.userData = box2d::to_user_data(box2d::make_tag(i, 0));
      world_.CreateBody(&body)->CreateFixture(&fixture);
    }
    world_.Step(0.0F, 1, 1);
    for (b2Contact* contact = world_.GetContactList(); contact != nullptr; contact = contact->GetNext())
      contacts_.push_back(contact);
  }
  b2Contact& contact(std::uint8_t number) const { return *contacts_[number % contacts_.size()]; }

 private:
  b2World world_;
  std::vector<b2Contact*> contacts_;
};

RC_GTEST_PROP(ContactRecords, HoldWhatAnUnorderedMapHoldsInTheOrderOfFirstMention,
              (std::vector<std::vector<std::uint8_t>> steps)) {
  const Discs discs;
  box2d::ContactRecords records;
  for (const std::vector<std::uint8_t>& step : steps) {
    records.clear();
    std::unordered_map<const b2Contact*, double> expected;
    std::vector<const b2Contact*> order;
    for (const std::uint8_t number : step) {
      b2Contact& contact = discs.contact(number);
      if (!expected.contains(&contact)) order.push_back(&contact);
      records[contact].normal[0] += 1.0;
      expected[&contact] += 1.0;
    }
    RC_ASSERT(records.all().size() == order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      const box2d::ContactRecord& record = records.all()[i];
      RC_ASSERT(record.contact == order[i]);
      RC_ASSERT(record.normal[0] == expected[order[i]]);
      RC_ASSERT(record.first == box2d::tag_of(*record.contact->GetFixtureA()));
      RC_ASSERT(record.second == box2d::tag_of(*record.contact->GetFixtureB()));
    }
  }
}

}  // namespace
}  // namespace talus::contact_records_test
