#include "toml_depth.hpp"

#include "failure.hpp"

#include <algorithm>

namespace
{

/* The byte behind a string in three quotes, which may hold one or two before the last three. */
std::size_t end_of_lines(std::string_view text, std::size_t begin)
{
    const char quote = text[begin];

    for (std::size_t i = begin + 3; i < text.size(); i++) {
        if (text[i] == '\\' && quote == '"') {
            i++;
        } else if (text.substr(i, 3) == text.substr(begin, 3)) {
            i += 3;
            for (int more = 0; more < 2 && i < text.size() && text[i] == quote; more++) i++;
            return i;
        }
    }
    return text.size();
}

/* The byte behind the string that begins at a quote, at the latest the end of its line. */
std::size_t end_of_string(std::string_view text, std::size_t begin)
{
    const char quote = text[begin];
    std::size_t i = begin + 1;

    if (text.substr(begin, 3) == std::string(3, quote)) return end_of_lines(text, begin);
    for (; i < text.size() && text[i] != '\n'; i++) {
        if (text[i] == quote) return i + 1;
        if (text[i] == '\\' && quote == '"') i++;
    }
    return i;
}

/* The byte behind the string or comment that begins here, or behind this one byte. */
std::size_t end_of_token(std::string_view text, std::size_t begin)
{
    if (text[begin] == '#') return std::min(text.find('\n', begin), text.size());
    if (text[begin] == '"' || text[begin] == '\'') return end_of_string(text, begin);
    return begin + 1;
}

} // namespace

void toml_depth_check(std::string_view text, const std::string &path)
{
    long line = 1;
    int parts = 1;

    for (std::size_t begin = 0, end; begin < text.size(); begin = end) {
        end = end_of_token(text, begin);
        const std::string_view token = text.substr(begin, end - begin);
        line += std::count(token.begin(), token.end(), '\n');
        if (std::string_view("\n=,[]{}").find(text[begin]) != std::string_view::npos)
            parts = 1;
        else if (text[begin] == '.' && ++parts > toml_depth_keys)
            throw failure(path + ":" + std::to_string(line) + ": a key of more than " +
                          std::to_string(toml_depth_keys) + " parts");
    }
}
