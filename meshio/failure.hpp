/* How the C++ rooms tell their caller what went wrong: an exception becomes a message in the
 * caller's buffer. */
#ifndef MESHIO_FAILURE_HPP
#define MESHIO_FAILURE_HPP

#include <cstddef>
#include <stdexcept>
#include <string>

struct failure : std::runtime_error {
    using std::runtime_error::runtime_error;
};

/* Writes the text of the exception being handled into `message`, cut to its size. Only inside a
 * catch block. about   stands before texts that do not come from this room, such as a library's;
 * may be empty Returns 1, for the C function to pass on. */
int failure_report(const char *about, char *message, std::size_t message_size) noexcept;

/* A quotation for messages, cut after 40 characters, control characters shown as `?`. */
std::string failure_quote(const char *text, std::size_t length);

#endif
