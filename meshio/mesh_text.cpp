#include "mesh_text.hpp"

#include "cancel.hpp"
#include "failure.hpp"
#include "mesh_soup.hpp"

#include <charconv>
#include <cstdint>
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

void append_utf8(std::string &out, std::uint32_t code)
{
    const int more = code < 0x80 ? 0 : code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
    static const std::uint32_t lead[] = {0, 0xc0, 0xe0, 0xf0};

    out += static_cast<char>(lead[more] | code >> (6 * more));
    for (int i = more - 1; i >= 0; i--) out += static_cast<char>(0x80 | (code >> (6 * i) & 0x3f));
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

void mesh_text_unify(std::string &text)
{
    const bool is_big = text.compare(0, 2, "\xfe\xff") == 0;
    std::string out;

    if (!is_big && text.compare(0, 2, "\xff\xfe") != 0) return;
    const auto unit_at = [&](std::size_t at) {
        const auto byte = [&](std::size_t i) {
            return static_cast<std::uint32_t>(static_cast<unsigned char>(text[i]));
        };
        if (at + 1 >= text.size()) return std::uint32_t{0};
        return is_big ? byte(at) << 8 | byte(at + 1) : byte(at + 1) << 8 | byte(at);
    };
    for (std::size_t at = 2; at + 1 < text.size(); at += 2) {
        std::uint32_t code = unit_at(at);
        if (code >> 10 == 0x36 && unit_at(at + 2) >> 10 == 0x37) { /* a pair of surrogates */
            at += 2;
            code = 0x10000 + ((code & 0x3ff) << 10 | (unit_at(at) & 0x3ff));
        }
        append_utf8(out, code);
    }
    text = std::move(out);
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
