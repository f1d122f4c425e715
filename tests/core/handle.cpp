// SPDX-License-Identifier: MIT
#include <pellucid/core/handle.hpp>
#include <string>
#include "support/catch.hpp"

using namespace pellucid;

TEST_CASE("a handle is null until a slot map made it", "[cpu]") {
    SlotMap<struct Tag, std::string> map;
    CHECK_FALSE(Handle<struct Tag>{});
    CHECK(map.find({}) == nullptr);
    const auto first = map.insert("first");
    REQUIRE(map.find(first));
    CHECK(*map.find(first) == "first");
    CHECK(map.size() == 1);
}

TEST_CASE("a stale handle finds nothing, also after its slot is used again", "[cpu]") {
    SlotMap<struct Tag, std::string> map;
    const auto first = map.insert("first");
    CHECK(map.erase(first) == "first");
    CHECK(map.find(first) == nullptr);
    CHECK(map.erase(first).empty());
    const auto second = map.insert("second");
    CHECK(second.index() == first.index());
    CHECK(second != first);
    CHECK(map.find(first) == nullptr);
    CHECK(*map.find(second) == "second");
}

TEST_CASE("a slot's generations wrap without ever giving a null handle", "[cpu]") {
    SlotMap<struct Tag, int> map;
    const auto first = map.insert(0);
    map.erase(first);
    for (int i = 1; i < 4095; ++i) {
        const auto handle = map.insert(i);
        REQUIRE(handle);
        REQUIRE(handle != first);
        map.erase(handle);
    }
    CHECK(map.insert(4095) == first);  // the 4,096th user of the slot
}

TEST_CASE("for_each visits exactly the live objects", "[cpu]") {
    SlotMap<struct Tag, int> map;
    const auto a = map.insert(1);
    map.insert(2);
    map.insert(4);
    map.erase(a);
    int sum = 0;
    map.for_each([&](auto handle, int value) {
        CHECK(map.find(handle));
        sum += value;
    });
    CHECK(sum == 6);
}
