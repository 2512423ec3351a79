#include "mesh_text.hpp"

#include "cancel.hpp"
#include "failure.hpp"
#include "mesh_soup.hpp"

#include <charconv>
#include <cstdio>

namespace
{

const char blanks[] = " \t"; /* as tinyobjloader has it */

std::string_view without_plus(std::string_view word)
{
    return word.size() > 1 && word[0] == '+' && word[1] != '-' ? word.substr(1) : word;
}

template <typename T> bool parse(std::string_view word, T &value)
{
    const std::string_view digits = without_plus(word);
    const char *end = digits.data() + digits.size();
    const std::from_chars_result result = std::from_chars(digits.data(), end, value);

    return result.ec == std::errc() && result.ptr == end;
}

} // namespace

std::string_view mesh_text_word(std::string_view &rest)
{
    const std::size_t begin = rest.find_first_not_of(blanks);

    if (begin == std::string_view::npos) return rest = {};
    rest.remove_prefix(begin);
    const std::string_view word = rest.substr(0, rest.find_first_of(blanks));
    rest.remove_prefix(word.size());
    return word;
}

bool mesh_text_is(std::string_view word, std::string_view keyword)
{
    if (word.size() != keyword.size()) return false;
    for (std::size_t i = 0; i < word.size(); i++) {
        const char c =
            word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] + ('a' - 'A')) : word[i];
        if (c != keyword[i]) return false;
    }
    return true;
}

std::string mesh_text_shown(double number)
{
    char text[32];

    std::snprintf(text, sizeof text, "%.10g", number);
    return text;
}

mesh_text::mesh_text(std::string path, std::string_view text, std::size_t begin,
                     unsigned long line_count)
    : path_(std::move(path)), text_(text), position_(begin), line_(line_count)
{
    if (!begin && text.substr(0, 3) == "\xef\xbb\xbf")
        position_ = 3; /* the byte order mark of UTF-8 */
    text_ = text_.substr(0, text_.find_last_not_of(mesh_text_padding) + 1);
}

bool mesh_text::next(std::string_view &line)
{
    if (position_ >= text_.size()) return false;
    std::size_t end = position_;

    cancel_check();
    while (end < text_.size() && text_[end] != '\n' && text_[end] != '\r') end++;
    line = text_.substr(position_, end - position_);
    position_ = end + (text_.substr(end, 2) == "\r\n" ? 2 : 1);
    line_++;
    return true;
}

void mesh_text::fail(const std::string &what) const
{
    throw failure(path_ + ":" + std::to_string(line_) + ": " + what);
}

void mesh_text::fail(std::string_view found, const std::string &expected) const
{
    fail((found.empty() ? "nothing" : failure_quote(found.data(), found.size())) + ", expected " +
         expected);
}

double mesh_text::number(std::string_view word) const
{
    double value;

    if (!parse(word, value)) fail(word, "a number");
    return value;
}

long long mesh_text::integer(std::string_view word) const
{
    long long value;

    if (!parse(word, value)) fail(word, "an integer");
    return value;
}

void mesh_text::point(std::string_view rest, double out[3]) const
{
    for (int axis = 0; axis < 3; axis++) {
        const std::string_view word = mesh_text_word(rest);
        out[axis] = number(word);
        if (mesh_soup_is_beyond(out[axis])) fail(word, mesh_soup_expected);
    }
}
