// SPDX-License-Identifier: MIT
#pragma once
/// \file
/// The command line of a benchmark: `--name value` pairs, `--name` flags and `--name value ...` lists, nothing else.
#include <charconv>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <pellucid/core/result.hpp>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace pellucid::bench {

/// Options with their defaults; after `parse`, with what the user gave.
class Options {
public:
    /// \param defaults name (without the dashes) to value.  An option not listed is an error.
    /// \param flags names that take no value and are off unless given.
    /// \param lists names that take every word up to the next one that starts with two dashes; empty unless given.
    Options(std::initializer_list<std::pair<const std::string, std::string>> defaults,
            std::initializer_list<std::string> flags = {}, std::initializer_list<std::string> lists = {})
        : values_(defaults) {
        for (const std::string& name : flags) flags_[name] = false;
        for (const std::string& name : lists) lists_[name] = {};
    }

    Result<void> parse(int argc, char** argv) {
        for (int i = 1; i < argc; i += 2) {
            const std::string_view name = argv[i];
            if (const auto flag = name.starts_with("--") ? flags_.find(name.substr(2)) : flags_.end();
                flag != flags_.end()) {
                flag->second = true;
                --i;
                continue;
            }
            if (const auto list = name.starts_with("--") ? lists_.find(name.substr(2)) : lists_.end();
                list != lists_.end()) {
                int end = i + 1;
                while (end < argc && !std::string_view(argv[end]).starts_with("--"))
                    list->second.emplace_back(argv[end++]);
                if (end == i + 1) return Error{Errc::invalid_argument, usage(name, "needs a value")};
                i = end - 2;
                continue;
            }
            const auto found = name.starts_with("--") ? values_.find(name.substr(2)) : values_.end();
            if (found == values_.end()) return Error{Errc::invalid_argument, usage(name, "is not an option")};
            if (i + 1 == argc) return Error{Errc::invalid_argument, usage(name, "needs a value")};
            found->second = argv[i + 1];
        }
        return {};
    }
    /// Precondition: `name` is one of the options.
    [[nodiscard]] const std::string& text(std::string_view name) const { return values_.find(name)->second; }
    /// Precondition: `name` is one of the flags.
    [[nodiscard]] bool flag(std::string_view name) const { return flags_.find(name)->second; }
    /// Precondition: `name` is one of the lists.
    [[nodiscard]] const std::vector<std::string>& list(std::string_view name) const {
        return lists_.find(name)->second;
    }
    /// The option as an integer in [lowest, highest].
    [[nodiscard]] Result<std::uint32_t> number(std::string_view name, std::uint32_t lowest,
                                               std::uint32_t highest) const {
        const std::string& value = text(name);
        std::uint32_t out = 0;
        const auto [end, error] = std::from_chars(value.data(), value.data() + value.size(), out);
        if (error != std::errc{} || end != value.data() + value.size() || out < lowest || out > highest)
            return Error{Errc::invalid_argument, "--" + std::string(name) + " is '" + value +
                                                     "' but must be a whole number from " + std::to_string(lowest) +
                                                     " to " + std::to_string(highest)};
        return out;
    }

private:
    [[nodiscard]] std::string usage(std::string_view name, const char* problem) const {
        std::string out = "'" + std::string(name) + "' " + problem + "; options and defaults:";
        for (const auto& [option, value] : values_) out += " --" + option + " " + (value.empty() ? "''" : value);
        for (const auto& [name_of_list, words] : lists_) out += " --" + name_of_list + " ...";
        for (const auto& [name_of_flag, given] : flags_) out += " --" + name_of_flag;
        return out;
    }

    std::map<std::string, std::string, std::less<>> values_;
    std::map<std::string, bool, std::less<>> flags_;
    std::map<std::string, std::vector<std::string>, std::less<>> lists_;
};

}  // namespace pellucid::bench
