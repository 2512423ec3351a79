extern "C" {
#include "meshio/lettering.h"
}
#include "meshio/failure.hpp"

#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>

#include <string>

namespace
{

const char font[] = "DejaVuSans";

[[noreturn]] void fail(const std::string &reason)
{
    throw failure(std::string("the font ") + font +
                  " cannot be used (is fonts-dejavu-core installed?)" +
                  (reason.empty() ? "" : ": " + reason));
}

/* One `?` for each character outside ASCII, whose first byte is 11xxxxxx, and each control. */
std::string printable(const char *text)
{
    std::string result;

    for (; *text; text++) {
        const unsigned char c = static_cast<unsigned char>(*text);
        if ((c & 0xc0) == 0x80) continue;
        result += c < ' ' || c > '~' ? '?' : *text;
    }
    return result;
}

/* Whether any of a text, whose box is around its origin, lies on the page: OpenImageIO breaks off the program
 * where none does. */
bool touches(const lettering_page *page, int x, int y, const OIIO::ROI &box)
{
    if (!box.defined()) fail("");
    return x + box.xend > 0 && x + box.xbegin < static_cast<int>(page->width) && y + box.yend > 0 &&
           y + box.ybegin < static_cast<int>(page->height);
}

} // namespace

extern "C" int lettering_width(int *out_width, const char *text, int size, char *message,
                               std::size_t message_size)
try {
    *out_width = 0;
    if (!text[0]) return 0;
    const OIIO::ROI box = OIIO::ImageBufAlgo::text_size(printable(text), size, font);

    if (!box.defined()) fail("");
    *out_width = box.width();
    return 0;
} catch (...) {
    return failure_report("", message, message_size);
}

extern "C" int lettering_draw(const lettering_page *page, int x, int y, const char *text, int size,
                              const std::uint8_t colour[3], char *message, std::size_t message_size)
try {
    const OIIO::ImageSpec spec(static_cast<int>(page->width), static_cast<int>(page->height), 3,
                               OIIO::TypeDesc::UINT8);
    OIIO::ImageBuf image(spec, page->rgb);
    const float ink[] = {colour[0] / 255.0f, colour[1] / 255.0f, colour[2] / 255.0f};

    if (!text[0]) return 0;
    if (!touches(page, x, y, OIIO::ImageBufAlgo::text_size(printable(text), size, font))) return 0;
    if (!OIIO::ImageBufAlgo::render_text(image, x, y, printable(text), size, font, ink))
        fail(image.geterror());
    return 0;
} catch (...) {
    return failure_report("", message, message_size);
}
