#include "failure.hpp"

#include <cstdio>
#include <new>

int failure_report(const char *about, char *message, std::size_t message_size) noexcept
{
    const char *colon = about[0] ? ": " : "";

    try {
        throw;
    } catch (const failure &e) {
        std::snprintf(message, message_size, "%s", e.what());
    } catch (const std::bad_alloc &) {
        std::snprintf(message, message_size, "%s%sout of memory", about, colon);
    } catch (const std::exception &e) {
        std::snprintf(message, message_size, "%s%s%s", about, colon, e.what());
    } catch (...) {
        std::snprintf(message, message_size, "%s%sunknown failure", about, colon);
    }
    return 1;
}

std::string failure_quote(const char *text, std::size_t length)
{
    const std::size_t longest = 40;
    std::string quote(text, length < longest ? length : longest);

    for (char &c : quote)
        if (static_cast<unsigned char>(c) < ' ') c = '?';
    return '"' + quote + (length > longest ? "...\"" : "\"");
}
