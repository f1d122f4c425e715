// SPDX-License-Identifier: MIT
#include <pellucid/core/result.hpp>
#include <pellucid/core/small_vector.hpp>
#include <memory>
#include "support/catch.hpp"

using namespace pellucid;

namespace {
Result<int> half_of(int value) {
    if (value % 2 != 0) return Error{Errc::invalid_argument, "the value is odd"};
    return value / 2;
}
Result<int> quarter_of(int value) {
    PELLUCID_TRY(const int half, half_of(value));
    PELLUCID_TRY(int quarter, half_of(half));
    return quarter;
}
Result<void> check_quarter(int value) {
    PELLUCID_CHECK(quarter_of(value) ? Result<void>{} : Result<void>{Error{Errc::parse, "no quarter"}});
    return {};
}
}  // namespace

TEST_CASE("results carry a value or an error through TRY and CHECK", "[cpu]") {
    REQUIRE(quarter_of(8));
    CHECK(*quarter_of(8) == 2);
    REQUIRE_FALSE(quarter_of(6));
    CHECK(quarter_of(6).error().code == Errc::invalid_argument);
    CHECK(quarter_of(6).error().message == "the value is odd");
    CHECK(check_quarter(4));
    CHECK(check_quarter(2).error().code == Errc::parse);
    CHECK(std::string(name(Errc::parse)) == "parse");
}

TEST_CASE("a result moves what cannot be copied", "[cpu]") {
    Result<std::unique_ptr<int>> made = std::make_unique<int>(7);
    REQUIRE(made);
    const std::unique_ptr<int> owned = std::move(*made);
    CHECK(*owned == 7);
}

TEST_CASE("small vectors compare by their used part", "[cpu]") {
    SmallVector<int, 4> a{1, 2, 3};
    SmallVector<int, 4> b{1, 2};
    CHECK_FALSE(a == b);
    b.push_back(3);
    CHECK(a == b);
    a.clear();
    CHECK(a.empty());
    a.push_back(1);
    CHECK_FALSE(a == b);
}
