// SPDX-License-Identifier: MIT
// README.md's table of hard cases against the tests that there are.
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include "support/catch.hpp"

namespace {

const std::filesystem::path tests = std::filesystem::path(PELLUCID_SOURCE_DIR) / "tests";

std::string text_of(const std::filesystem::path& file) {
    std::ifstream in(file);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
}

/// Names of the tests of a file, empty where there is none.
std::set<std::string> names_in(const std::filesystem::path& file) {
    const std::string text = text_of(file);
    const std::regex test_case("TEST_CASE\\(\\s*\"([^\"]+)\"");
    std::set<std::string> out;
    for (auto i = std::sregex_iterator(text.begin(), text.end(), test_case); i != std::sregex_iterator(); ++i)
        out.insert((*i)[1]);
    return out;
}

/// Calls `use(file, name)` for each test that a text names: a file, then its tests in quotes.
template <class Use>
std::size_t each_test(const std::string& text, Use&& use) {
    const std::regex part("([a-z_/]+\\.cpp)|\"([^\"]+)\"");
    std::string file;
    std::size_t count = 0;
    for (auto i = std::sregex_iterator(text.begin(), text.end(), part); i != std::sregex_iterator(); ++i) {
        if ((*i)[1].matched) {
            file = (*i)[1];
            continue;
        }
        use(file, (*i)[2]);
        ++count;
    }
    return count;
}

}  // namespace

TEST_CASE("hard cases: the catalogue has all 45 cases and names tests that exist", "[cpu]") {
    const std::string readme = text_of(tests / "hard_cases/README.md");
    std::set<std::pair<std::string, std::string>> named;
    const auto check = [&](const std::string& file, const std::string& name) {
        INFO(file << ": " << name);
        CHECK(names_in(tests / file).count(name) == 1);
        named.emplace(file, name);
    };
    std::istringstream lines(readme);
    std::string line, rest;
    int number = 0;
    while (std::getline(lines, line)) {
        std::smatch row;
        if (!std::regex_match(line, row, std::regex("\\| (\\d+) \\| (.+) \\| (.+) \\|"))) {
            rest += line + "\n";
            continue;
        }
        ++number;
        INFO(line);
        CHECK(std::stoi(row[1]) == number);
        const std::string cell = row[3];
        const bool none = cell.find("no such pass yet: ") == 0;
        CHECK((each_test(cell, check) == 0) == none);
        // Once the file that such a case waits for is there, its tests belong into the table.
        if (std::smatch awaited; none && std::regex_search(cell, awaited, std::regex("[a-z_/]+\\.cpp")))
            CHECK_FALSE(exists(tests / awaited[0].str()));
    }
    CHECK(number == 45);
    CHECK(each_test(rest.substr(rest.rfind("And what")), check) > 0);
    // And no test on lighting is forgotten.
    for (const char* const file : {"brdf", "lights", "encodings", "space", "radiance"}) {
        const std::string path = std::string("hard_cases/") + file + ".cpp";
        const std::set<std::string> names = names_in(tests / path);
        CHECK_FALSE(names.empty());
        for (const std::string& name : names) {
            INFO(path << ": " << name);
            CHECK(named.count({path, name}) == 1);
        }
    }
}
