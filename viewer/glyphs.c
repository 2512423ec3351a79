#include "glyphs.h"

#include "meshio/lettering.h"

#include <stdlib.h>
#include <string.h>

enum { PER_ROW = 16, MESSAGE_SIZE = 512 };

static status measure(int *out, const char *text, int size)
{
    status rc = STATUS_OK;
    char message[MESSAGE_SIZE] = "";

    NEED(lettering_width(out, text, size, message, sizeof message) == 0, STATUS_FILE, "%s",
         message);
out:
    return rc;
}

/* A text's width is that of its ink: a bar on either side makes the blanks count. */
static status measure_advances(glyphs *g)
{
    status rc = STATUS_OK;
    int bars = 0, width = 0;

    TRY(measure(&bars, "||", g->size));
    for (int i = 0; i < GLYPHS_COUNT; i++) {
        const char text[] = {'|', (char)(GLYPHS_FIRST + i), '|', '\0'};
        TRY(measure(&width, text, g->size));
        g->advance[i] = width - bars;
        if (g->advance[i] + 2 * GLYPHS_PADDING > g->cell_width)
            g->cell_width = g->advance[i] + 2 * GLYPHS_PADDING;
    }
out:
    return rc;
}

static status draw_cells(const glyphs *g, uint8_t *rgb)
{
    static const uint8_t white[3] = {255, 255, 255};
    status rc = STATUS_OK;
    const lettering_page page = {(uint32_t)g->columns, (uint32_t)g->rows, rgb};
    char message[MESSAGE_SIZE] = "";

    for (int i = 0; i < GLYPHS_COUNT; i++) {
        const char text[] = {(char)(GLYPHS_FIRST + i), '\0'};
        const int x = i % PER_ROW * g->cell_width + GLYPHS_PADDING;
        const int y = i / PER_ROW * g->height + g->baseline;
        NEED(lettering_draw(&page, x, y, text, g->size, white, message, sizeof message) == 0,
             STATUS_FILE, "%s", message);
    }
out:
    return rc;
}

status glyphs_draw(glyphs *out, int size)
{
    status rc = STATUS_OK;
    glyphs g = {.size = size, .height = size * 3 / 2, .baseline = size + size / 8};
    uint8_t *rgb = NULL;

    TRY(measure_advances(&g));
    g.columns = PER_ROW * g.cell_width;
    g.rows = (GLYPHS_COUNT / PER_ROW + 1) * g.height; /* the last cell stays free */
    const size_t count = (size_t)g.columns * (size_t)g.rows;
    rgb = calloc(count, 3);
    g.coverage = malloc(count);
    NEED(rgb && g.coverage, STATUS_MEMORY, "no memory for letters of %d pixels", size);
    TRY(draw_cells(&g, rgb));
    for (size_t i = 0; i < count; i++) g.coverage[i] = rgb[3 * i];
    for (int y = g.rows - g.height; y < g.rows; y++)
        memset(g.coverage + (size_t)y * (size_t)g.columns + g.columns - g.cell_width, 255,
               (size_t)g.cell_width);
    *out = g;
    g.coverage = NULL;
out:
    free(g.coverage);
    free(rgb);
    return rc;
}

static int index_of(char character)
{
    return character >= GLYPHS_FIRST && character <= GLYPHS_LAST ? character - GLYPHS_FIRST
                                                                 : '?' - GLYPHS_FIRST;
}

void glyphs_place(const glyphs *g, char character, int *out_x, int *out_y)
{
    *out_x = index_of(character) % PER_ROW * g->cell_width;
    *out_y = index_of(character) / PER_ROW * g->height;
}

int glyphs_advance(const glyphs *g, char character)
{
    return g->advance[index_of(character)];
}
