// SPDX-License-Identifier: MIT
// Blocks of the pages: quotations are what the file says, every other block of code is compiled, and commands name
// programs, scenes and options that there are.
#include <support/catch.hpp>
#include "markdown.hpp"
#include <cstdio>
#include <set>
#include <sstream>

using namespace docs;

namespace {

/// What a program prints.
std::string output(const std::string& command) {
    std::string text;
    std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
    REQUIRE(pipe != nullptr);
    char part[4096];
    for (std::size_t n = 0; (n = std::fread(part, 1, sizeof part, pipe)) > 0;) text.append(part, n);
    pclose(pipe);
    return text;
}

/// Commands of a block: comments are gone, lines that end in a backslash joined, words apart.
std::vector<std::vector<std::string>> commands(const Block& block) {
    std::vector<std::vector<std::string>> all;
    bool joined = false;
    for (std::string line : block.lines) {
        if (const std::size_t hash = line.find(" #"); hash != std::string::npos) line.resize(hash);
        if (line.starts_with("#")) line.clear();
        const bool more = line.ends_with("\\");
        if (more) line.pop_back();
        if (!joined) all.emplace_back();
        std::istringstream words(line);
        for (std::string word; words >> word;) {
            if (word == "&&" || word == "|")
                all.emplace_back();
            else
                all.back().push_back(word);
        }
        joined = more;
    }
    return all;
}

/// Whether the sources of a benchmark know an option.
bool benchmark_knows(const std::string& program, const std::string& option) {
    std::vector<std::filesystem::path> files{root / "benchmarks" / (program + ".cpp")};
    for (const std::string folder : {"support", program.c_str()})
        if (std::filesystem::exists(root / "benchmarks" / folder))
            for (const auto& file : std::filesystem::directory_iterator(root / "benchmarks" / folder))
                files.push_back(file.path());
    for (const auto& file : files)
        for (const std::string& line : read_lines(file))
            if (line.find("\"" + option.substr(2)) != std::string::npos ||
                line.find("\"" + option) != std::string::npos)
                return true;
    return false;
}

}  // namespace

TEST_CASE("every block of C++, GLSL and CMake is a quotation, or compiled, or configured", "[docs]") {
    std::size_t quoted = 0, compiled = 0;
    for (const Page& page : all_pages()) {
        if (!is_documentation(page)) continue;
        for (const Block& block : page.blocks) {
            INFO(page.at(block.line) << "a block of '" << block.language << "', marked '" << block.marker << "'");
            CHECK(!block.language.empty());
            if (block.marker.starts_with("from: ")) {
                ++quoted;
                const std::filesystem::path file = root / block.marker.substr(6);
                REQUIRE(std::filesystem::exists(file));
                const std::vector<std::string> lines = read_lines(file);
                CHECK(std::search(lines.begin(), lines.end(), block.lines.begin(), block.lines.end()) != lines.end());
            } else if (block.language == "cpp" || block.language == "cmake" || block.language == "glsl") {
                ++compiled;
                CHECK(block.marker.starts_with("snippet: "));
            }
        }
    }
    CHECK(quoted >= 3);
    CHECK(compiled >= 5);
}

TEST_CASE("commands of the pages name programs, scenes and options that there are", "[docs]") {
    const std::string programs = PELLUCID_PROGRAMS;
    std::map<std::string, std::string> help;
    const std::string scenes = output(programs + "/generate_scene --list");
    std::size_t options = 0, made = 0;
    const std::set<std::string> others{"cmake",   "ctest", "git", "sudo",  "apt-get", "cd",     "mkdir",
                                       "export",  "sh",    ".",   "ninja", "ls",      "cat",    "env",
                                       "doxygen", "cp",    "ldd", "awk",   "xargs",   "python3"};
    for (const Page& page : all_pages()) {
        if (!is_documentation(page)) continue;
        for (const Block& block : page.blocks) {
            if (block.language != "sh") continue;
            for (std::vector<std::string> words : commands(block)) {
                while (!words.empty() && words[0].find('=') != std::string::npos) words.erase(words.begin());
                if (!words.empty() && words[0] == "xvfb-run")
                    while (words.size() > 1 && words[0].find("build/") == std::string::npos &&
                           words[0].find("pellucid-") == std::string::npos)
                        words.erase(words.begin());
                if (words.empty() || others.count(words[0]) == 1) continue;
                INFO(page.at(block.line) << "`" << words[0] << "`");
                const std::string name = std::filesystem::path(words[0]).filename().string();
                if (words[0].starts_with("scripts/")) {
                    CHECK(std::filesystem::exists(root / words[0]));
                    continue;
                }
                const bool benchmark = words[0].find("benchmarks/") != std::string::npos;
                if (benchmark)
                    CHECK(std::filesystem::exists(root / "benchmarks" / (name + ".cpp")));
                else
                    REQUIRE(std::filesystem::exists(programs + "/" + name));
                if (!benchmark && help.count(name) == 0) help[name] = output(programs + "/" + name + " --help");
                if (name == "generate_scene" && words.size() == 3) {
                    ++made;
                    INFO("scene " << words[1]);
                    CHECK(("\n" + scenes).find("\n" + words[1] + " ") != std::string::npos);
                }
                for (const std::string& word : words) {
                    if (!word.starts_with("--") || name == "generate_scene") continue;
                    ++options;
                    INFO(word << " is no option of it");
                    CHECK((benchmark ? benchmark_knows(name, word) : help[name].find(word) != std::string::npos));
                }
            }
        }
    }
    CHECK(options > 50);
    CHECK(made > 10);
}

TEST_CASE("sentences that troubleshooting quotes are sentences of the sources", "[docs]") {
    // All sources, with string literals that follow each other joined.
    std::string sources;
    for (const char* folder : {"include", "backends", "samples", "scripts", "shaders"})
        for (const auto& file : std::filesystem::recursive_directory_iterator(root / folder))
            if (file.is_regular_file())
                for (const std::string& line : read_lines(file.path())) {
                    const std::size_t first = line.find_first_not_of(' ');
                    const std::string text = first == std::string::npos ? "" : line.substr(first);
                    if (sources.ends_with("\"") && text.starts_with("\""))
                        sources.replace(sources.size() - 1, 1, text.substr(1));
                    else
                        sources += "\n" + text;
                }
    for (const std::string& line : read_lines(root / "CMakeLists.txt")) sources += line + "\n";
    std::size_t found = 0;
    for (const std::string& line : read_lines(root / "docs/troubleshooting.md")) {
        if (!line.starts_with("| `") && !line.starts_with("| warning `")) continue;
        const std::size_t begin = line.find('`') + 1, end = line.find('`', begin);
        std::string message = line.substr(begin, end - begin);
        for (std::size_t at = 0; at < message.size();) {
            const std::size_t dots = std::min(message.find("…", at), message.size());
            std::string part = message.substr(at, dots - at);
            at = dots + std::string("…").size();
            while (!part.empty() && std::string(" ':;,").find(part.back()) != std::string::npos) part.pop_back();
            while (!part.empty() && std::string(" ':;,").find(part.front()) != std::string::npos) part.erase(0, 1);
            if (part.size() < 12) continue;
            INFO("'" << part << "' of '" << message << "'");
            CHECK(sources.find(part) != std::string::npos);
            ++found;
        }
    }
    CHECK(found > 15);
}
