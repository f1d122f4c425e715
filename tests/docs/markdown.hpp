// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// What the tests need of Markdown pages: headings, links, pictures and fenced blocks, as GitHub reads them.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace docs {

inline const std::filesystem::path root = PELLUCID_SOURCE_DIR;

struct Link {
    std::string target;
    std::size_t line = 0;
    bool picture = false;
};
struct Block {
    std::string language, marker;  ///< the marker is the HTML comment in the line before, without its dashes
    std::vector<std::string> lines;
    std::size_t line = 0;  ///< of the fence
};
struct Page {
    std::string name;  ///< from the root
    std::vector<std::string> anchors;
    std::vector<Link> links;
    std::vector<Block> blocks;
    std::size_t lines = 0;

    [[nodiscard]] std::string at(std::size_t line) const { return name + ":" + std::to_string(line) + ": "; }
};

[[nodiscard]] inline std::vector<std::string> read_lines(const std::filesystem::path& file) {
    std::vector<std::string> lines;
    std::ifstream in(file);
    for (std::string line; std::getline(in, line);) lines.push_back(line);
    return lines;
}

/// The anchor of a heading: lower case, spaces to dashes, no punctuation but dashes and underscores.
[[nodiscard]] inline std::string anchor(std::string_view heading) {
    std::string out;
    for (const char c : heading) {
        const auto u = static_cast<unsigned char>(c);
        if (c == ' ')
            out += '-';
        else if (u >= 0x80 || std::isalnum(u) || c == '-' || c == '_')
            out += static_cast<char>(std::tolower(u));
    }
    return out;
}

/// Links of a line outside of code spans.
inline void find_links(std::string line, std::size_t number, std::vector<Link>& links) {
    for (std::size_t a = line.find('`'); a != std::string::npos; a = line.find('`', a)) {
        const std::size_t b = line.find('`', a + 1);
        if (b == std::string::npos) break;
        line.replace(a, b - a + 1, "_");
    }
    for (std::size_t at = line.find("]("); at != std::string::npos; at = line.find("](", at + 2)) {
        const std::size_t end = line.find(')', at);
        std::size_t open = at, depth = 1;
        while (open > 0 && depth > 0) {
            --open;
            depth += line[open] == ']' ? 1 : line[open] == '[' ? -1 : 0;
        }
        if (end != std::string::npos)
            links.push_back({line.substr(at + 2, end - at - 2), number, open > 0 && line[open - 1] == '!'});
    }
}

[[nodiscard]] inline Page read_page(const std::filesystem::path& file) {
    Page page;
    page.name = std::filesystem::relative(file, root).generic_string();
    const std::vector<std::string> lines = read_lines(file);
    page.lines = lines.size();
    std::map<std::string, int> seen;
    bool inside = false;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (line.starts_with("```")) {
            if (!inside) {
                Block block{.language = line.substr(3), .line = i + 1};
                if (i > 0 && lines[i - 1].starts_with("<!-- ") && lines[i - 1].ends_with(" -->"))
                    block.marker = lines[i - 1].substr(5, lines[i - 1].size() - 9);
                page.blocks.push_back(block);
            }
            inside = !inside;
        } else if (inside) {
            page.blocks.back().lines.push_back(line);
        } else if (line.starts_with("#")) {
            const std::string name = anchor(line.substr(line.find_first_not_of("# ")));
            const int count = seen[name]++;
            page.anchors.push_back(count == 0 ? name : name + "-" + std::to_string(count));
            find_links(line, i + 1, page.links);
        } else {
            find_links(line, i + 1, page.links);
        }
    }
    return page;
}

/// Every page of the repository, by name.
[[nodiscard]] inline std::vector<Page> all_pages() {
    std::vector<Page> pages;
    for (auto it = std::filesystem::recursive_directory_iterator(root); it != std::filesystem::end(it); ++it) {
        const std::string name = it->path().filename().string();
        const bool top = it.depth() == 0;
        if (it->is_directory() &&
            (name.starts_with(".") || (top && (name.starts_with("build") || name == "out" || name == "shared"))))
            it.disable_recursion_pending();
        else if (it->is_regular_file() && name.ends_with(".md"))
            pages.push_back(read_page(it->path()));
    }
    std::sort(pages.begin(), pages.end(), [](const Page& a, const Page& b) { return a.name < b.name; });
    return pages;
}

/// The front page and those of docs/: what promises blocks that work.
[[nodiscard]] inline bool is_documentation(const Page& page) {
    return page.name == "README.md" || page.name.starts_with("docs/");
}

}  // namespace docs
