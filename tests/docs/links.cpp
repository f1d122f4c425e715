// SPDX-License-Identifier: MIT
// Links of all pages lead somewhere; pictures are there, are made by a command beside them, and all are shown.
#include <support/catch.hpp>
#include "markdown.hpp"
#include <set>

using namespace docs;

TEST_CASE("every relative link of every page leads to a file, and to a heading of it", "[docs]") {
    const std::vector<Page> pages = all_pages();
    CHECK(pages.size() > 20);
    std::size_t links = 0, anchors = 0;
    for (const Page& page : pages)
        for (const Link& link : page.links) {
            if (link.target.find("://") != std::string::npos || link.target.starts_with("mailto:")) continue;
            ++links;
            const std::size_t hash = link.target.find('#');
            const std::string path = link.target.substr(0, hash);
            const std::filesystem::path file =
                path.empty() ? root / page.name : (root / page.name).parent_path() / path;
            INFO(page.at(link.line) << link.target);
            CHECK(std::filesystem::exists(file));
            if (hash == std::string::npos) continue;
            ++anchors;
            const std::string wanted = std::filesystem::weakly_canonical(file).string();
            const auto found = std::find_if(pages.begin(), pages.end(), [&](const Page& p) {
                return std::filesystem::weakly_canonical(root / p.name).string() == wanted;
            });
            REQUIRE(found != pages.end());
            CHECK(std::find(found->anchors.begin(), found->anchors.end(), link.target.substr(hash + 1)) !=
                  found->anchors.end());
        }
    CHECK(links > 100);
    CHECK(anchors > 0);
}

TEST_CASE("every picture of docs/pictures is shown, small, and made by a command of the page that shows it first",
          "[docs]") {
    std::map<std::string, std::string> made;  // picture, page
    std::map<std::string, std::set<std::string>> shown;
    for (const Page& page : all_pages()) {
        for (const Link& link : page.links)
            if (link.picture && link.target.find("pictures/") != std::string::npos)
                shown[std::filesystem::path(link.target).filename().string()].insert(page.name);
        if (!page.name.starts_with("docs/")) continue;
        for (const Block& block : page.blocks)
            for (const std::string& line : block.lines)
                for (std::size_t at = line.find("docs/pictures/"); block.language == "sh" && at != std::string::npos;
                     at = line.find("docs/pictures/", at + 1)) {
                    const std::string name = line.substr(at + 14, line.find_first_of(" '\"", at) - at - 14);
                    INFO(page.at(block.line) << name << " is made by another command too");
                    CHECK(made.emplace(name, page.name).second);
                }
    }
    CHECK(shown.size() > 20);
    std::uintmax_t bytes = 0;
    for (const auto& file : std::filesystem::directory_iterator(root / "docs/pictures")) {
        const std::string name = file.path().filename().string();
        INFO(name);
        CHECK(shown.count(name) == 1);
        CHECK(file.file_size() < 200 * 1024);
        bytes += file.file_size();
    }
    CHECK(bytes < 4 * 1024 * 1024);
    for (const auto& [name, pages] : shown) {
        INFO(name << " in " << *pages.begin());
        CHECK(std::filesystem::exists(root / "docs/pictures" / name));
        REQUIRE(made.count(name) == 1);
        CHECK(pages.count(made.at(name)) == 1);
    }
    for (const auto& [name, page] : made) {
        INFO(name << " is made in " << page << " and shown nowhere");
        CHECK(shown.count(name) == 1);
    }
}
