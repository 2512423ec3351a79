/* The text of a mesh file, line by line and word by word, with errors that name the line. */
#ifndef MESHIO_MESH_TEXT_HPP
#define MESHIO_MESH_TEXT_HPP

#include <cstddef>
#include <string>
#include <string_view>

/* Takes the next word off the front of `rest`; empty at its end. */
std::string_view mesh_text_word(std::string_view &rest);

/* True where `word` is `keyword`, which is in lower case, in any case. */
bool mesh_text_is(std::string_view word, std::string_view keyword);

/* What may stand behind the end of a text: zero bytes and Control-Z. */
constexpr std::string_view mesh_text_padding("\0\x1a", 2);

/* Turns a text in UTF-16, as its byte order mark says, into UTF-8; leaves all others as they are. */
void mesh_text_unify(std::string &text);

/* A number in messages, ten digits at most. */
std::string mesh_text_shown(double number);

class mesh_text
{
  public:
    /* Reads `text`, which outlives this object, from the byte `begin`, before which there are
     * `line_count` lines. Lines end at
     * "\n", "\r\n" or "\r" and count from 1. Padding at the end is no text. */
    mesh_text(std::string path, std::string_view text, std::size_t begin = 0,
              unsigned long line_count = 0);

    /* Steps to the next line, without its end; false behind the last one. */
    bool next(std::string_view &line);

    /* The byte at which the line after the present one begins. */
    std::size_t position() const
    {
        return position_;
    }
    unsigned long line() const
    {
        return line_;
    }

    /* Throws failure `path:line: what`. */
    [[noreturn]] void fail(const std::string &what) const;

    /* Throws failure `path:line: "found", expected what`. */
    [[noreturn]] void fail(std::string_view found, const std::string &expected) const;

    /* A decimal number, nan or inf, with or without a sign. Fails by `fail`. */
    double number(std::string_view word) const;
    long long integer(std::string_view word) const;

    /* The first three numbers of `rest`, taken off its front: coordinates of a mesh. */
    void point(std::string_view rest, double out[3]) const;

  private:
    std::string path_;
    std::string_view text_;
    std::size_t position_;
    unsigned long line_;
};

#endif
