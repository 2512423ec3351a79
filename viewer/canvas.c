#include "canvas.h"

#include "gl.h"
#include "glyphs.h"

#include <math.h>
#include <stddef.h>
#include <stdlib.h>

enum { VERTEX_LIMIT = 6 * 2048 };

typedef struct vertex {
    float x, y, u, v;
    canvas_colour colour;
} vertex;

struct canvas {
    gl gl;
    int width, height;
    GLuint program, array, buffer;
    GLint size_uniform;
    glyphs letters[CANVAS_SIZES];
    GLuint letter_texture[CANVAS_SIZES], picture_texture[CANVAS_PICTURES];
    GLuint texture; /* of the vertices that wait */
    int waiting;
    vertex vertices[VERTEX_LIMIT];
};

static const char vertex_text[] = "#version 330 core\n"
                                  "layout(location = 0) in vec2 place;\n"
                                  "layout(location = 1) in vec2 texel;\n"
                                  "layout(location = 2) in vec4 colour;\n"
                                  "uniform vec2 size;\n"
                                  "out vec2 at;\n"
                                  "out vec4 ink;\n"
                                  "void main()\n"
                                  "{\n"
                                  "    at = texel;\n"
                                  "    ink = colour;\n"
                                  "    vec2 share = 2.0 * place / size - 1.0;\n"
                                  "    gl_Position = vec4(share.x, -share.y, 0.0, 1.0);\n"
                                  "}\n";

static const char fragment_text[] = "#version 330 core\n"
                                    "in vec2 at;\n"
                                    "in vec4 ink;\n"
                                    "uniform sampler2D image;\n"
                                    "out vec4 colour;\n"
                                    "void main()\n"
                                    "{\n"
                                    "    colour = ink * texture(image, at);\n"
                                    "}\n";

static GLuint attach(const gl *g, GLuint program, GLenum kind, const char *text)
{
    const GLuint shader = g->CreateShader(kind);

    g->ShaderSource(shader, 1, &text, NULL);
    g->CompileShader(shader);
    g->AttachShader(program, shader);
    return shader;
}

static status open_program(canvas *c)
{
    status rc = STATUS_OK;
    const gl *g = &c->gl;
    char log[1024] = "";
    GLint linked = 0;

    c->program = g->CreateProgram();
    const GLuint first = attach(g, c->program, GL_VERTEX_SHADER, vertex_text);
    const GLuint second = attach(g, c->program, GL_FRAGMENT_SHADER, fragment_text);
    g->LinkProgram(c->program);
    g->DeleteShader(first);
    g->DeleteShader(second);
    g->GetProgramiv(c->program, GL_LINK_STATUS, &linked);
    g->GetProgramInfoLog(c->program, sizeof log, NULL, log);
    NEED(linked, STATUS_DEVICE, "OpenGL does not build the shaders: %s", log);
    c->size_uniform = g->GetUniformLocation(c->program, "size");
out:
    return rc;
}

static void open_vertices(canvas *c)
{
    const gl *g = &c->gl;

    g->GenVertexArrays(1, &c->array);
    g->BindVertexArray(c->array);
    g->GenBuffers(1, &c->buffer);
    g->BindBuffer(GL_ARRAY_BUFFER, c->buffer);
    for (GLuint i = 0; i < 3; i++) g->EnableVertexAttribArray(i);
    g->VertexAttribPointer(0, 2, GL_FLOAT, GL_FALSE, sizeof(vertex), (void *)offsetof(vertex, x));
    g->VertexAttribPointer(1, 2, GL_FLOAT, GL_FALSE, sizeof(vertex), (void *)offsetof(vertex, u));
    g->VertexAttribPointer(2, 4, GL_UNSIGNED_BYTE, GL_TRUE, sizeof(vertex),
                           (void *)offsetof(vertex, colour));
}

static GLuint open_texture(const gl *g)
{
    GLuint texture = 0;

    g->GenTextures(1, &texture);
    g->BindTexture(GL_TEXTURE_2D, texture);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    g->TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    return texture;
}

/* Letters are white and as opaque as they cover a pixel. */
static status open_letters(canvas *c, canvas_size size, int pixels)
{
    static const GLint swizzle[4] = {GL_ONE, GL_ONE, GL_ONE, GL_RED};
    static const GLenum channel[4] = {GL_TEXTURE_SWIZZLE_R, GL_TEXTURE_SWIZZLE_G,
                                      GL_TEXTURE_SWIZZLE_B, GL_TEXTURE_SWIZZLE_A};
    status rc = STATUS_OK;
    glyphs *letters = &c->letters[size];

    TRY(glyphs_draw(letters, pixels));
    c->letter_texture[size] = open_texture(&c->gl);
    for (int i = 0; i < 4; i++) c->gl.TexParameteri(GL_TEXTURE_2D, channel[i], swizzle[i]);
    c->gl.TexImage2D(GL_TEXTURE_2D, 0, GL_R8, letters->columns, letters->rows, 0, GL_RED,
                     GL_UNSIGNED_BYTE, letters->coverage);
out:
    return rc;
}

status canvas_open(canvas **out, const surface *s, double scale)
{
    status rc = STATUS_OK;
    canvas *c = calloc(1, sizeof *c);

    NEED(c, STATUS_MEMORY, "no memory for a canvas");
    TRY(gl_load(&c->gl, s));
    c->gl.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    c->gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
    TRY(open_program(c));
    open_vertices(c);
    TRY(open_letters(c, CANVAS_TEXT, (int)(CANVAS_TEXT_SIZE * scale + 0.5)));
    TRY(open_letters(c, CANVAS_HEADING, (int)(CANVAS_HEADING_SIZE * scale + 0.5)));
    for (int i = 0; i < CANVAS_PICTURES; i++) {
        c->picture_texture[i] = open_texture(&c->gl);
        c->gl.TexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
    }
    *out = c;
    c = NULL;
out:
    canvas_free(c);
    return rc;
}

void canvas_free(canvas *c)
{
    if (!c) return;
    if (c->gl.Viewport) { /* the last function: all are there */
        c->gl.DeleteTextures(CANVAS_PICTURES, c->picture_texture);
        c->gl.DeleteTextures(CANVAS_SIZES, c->letter_texture);
        c->gl.DeleteBuffers(1, &c->buffer);
        c->gl.DeleteVertexArrays(1, &c->array);
        c->gl.DeleteProgram(c->program);
    }
    for (int i = 0; i < CANVAS_SIZES; i++) free(c->letters[i].coverage);
    free(c);
}

int canvas_line_height(const canvas *c, canvas_size size)
{
    return c->letters[size].height;
}

int canvas_text_width(const canvas *c, canvas_size size, const char *text)
{
    int width = 0;

    for (; *text; text++) width += glyphs_advance(&c->letters[size], *text);
    return width;
}

static void flush(canvas *c)
{
    const gl *g = &c->gl;

    if (c->waiting == 0) return;
    g->BindTexture(GL_TEXTURE_2D, c->texture);
    g->BufferData(GL_ARRAY_BUFFER, c->waiting * (GLsizeiptr)sizeof(vertex), c->vertices,
                  GL_STREAM_DRAW);
    g->DrawArrays(GL_TRIANGLES, 0, c->waiting);
    c->waiting = 0;
}

void canvas_begin(canvas *c, int width, int height)
{
    const gl *g = &c->gl;

    c->width = width;
    c->height = height;
    g->Viewport(0, 0, width, height);
    g->ClearColor(1.0f, 1.0f, 1.0f, 1.0f);
    g->Clear(GL_COLOR_BUFFER_BIT);
    g->Enable(GL_BLEND);
    g->BlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    g->UseProgram(c->program);
    g->BindVertexArray(c->array);
    g->BindBuffer(GL_ARRAY_BUFFER, c->buffer);
    g->ActiveTexture(GL_TEXTURE0);
    g->Uniform2f(c->size_uniform, (float)width, (float)height);
}

/* Four corners around: a quad as two triangles. */
static void add_quad(canvas *c, GLuint texture, const vertex corner[4])
{
    static const int order[6] = {0, 1, 2, 0, 2, 3};

    if (texture != c->texture || c->waiting + 6 > VERTEX_LIMIT) flush(c);
    c->texture = texture;
    for (int i = 0; i < 6; i++) c->vertices[c->waiting++] = corner[order[i]];
}

/* The middle of the solid cell of the small letters. */
static vertex solid(const canvas *c, double x, double y, canvas_colour colour)
{
    const glyphs *g = &c->letters[CANVAS_TEXT];

    return (vertex){(float)x, (float)y, 1.0f - 0.5f * (float)g->cell_width / (float)g->columns,
                    1.0f - 0.5f * (float)g->height / (float)g->rows, colour};
}

void canvas_fill(canvas *c, double x, double y, double width, double height, canvas_colour colour)
{
    const vertex corner[4] = {solid(c, x, y, colour), solid(c, x + width, y, colour),
                              solid(c, x + width, y + height, colour),
                              solid(c, x, y + height, colour)};

    add_quad(c, c->letter_texture[CANVAS_TEXT], corner);
}

void canvas_line(canvas *c, double x0, double y0, double x1, double y1, double width,
                 canvas_colour colour)
{
    const double length = hypot(x1 - x0, y1 - y0);

    if (length == 0.0) return;
    const double dx = 0.5 * width * (x1 - x0) / length, dy = 0.5 * width * (y1 - y0) / length;
    const vertex corner[4] = {
        solid(c, x0 - dy, y0 + dx, colour), solid(c, x1 - dy, y1 + dx, colour),
        solid(c, x1 + dy, y1 - dx, colour), solid(c, x0 + dy, y0 - dx, colour)};

    add_quad(c, c->letter_texture[CANVAS_TEXT], corner);
}

void canvas_text(canvas *c, double x, double y, canvas_size size, canvas_colour colour,
                 const char *text)
{
    const glyphs *g = &c->letters[size];
    const float across = 1.0f / (float)g->columns, down = 1.0f / (float)g->rows;
    const float width = (float)g->cell_width, height = (float)g->height, top = (float)floor(y);
    float left = (float)floor(x) - GLYPHS_PADDING;

    for (; *text; text++) {
        int column, row;
        glyphs_place(g, *text, &column, &row);
        const float u = (float)column * across, v = (float)row * down;
        const vertex corner[4] = {
            {left, top, u, v, colour},
            {left + width, top, u + width * across, v, colour},
            {left + width, top + height, u + width * across, v + height * down, colour},
            {left, top + height, u, v + height * down, colour}};
        if (*text != ' ') add_quad(c, c->letter_texture[size], corner);
        left += (float)glyphs_advance(g, *text);
    }
}

void canvas_load_picture(canvas *c, int index, int columns, int rows, const uint8_t *rgb)
{
    flush(c); /* may still need the old one */
    c->gl.BindTexture(GL_TEXTURE_2D, c->picture_texture[index]);
    c->gl.TexImage2D(GL_TEXTURE_2D, 0, GL_RGB8, columns, rows, 0, GL_RGB, GL_UNSIGNED_BYTE, rgb);
}

void canvas_picture(canvas *c, int index, double x, double y, double width, double height)
{
    static const canvas_colour white = {255, 255, 255, 255};
    const float left = (float)x, top = (float)y, right = (float)(x + width),
                bottom = (float)(y + height);
    const vertex corner[4] = {{left, top, 0.0f, 0.0f, white},
                              {right, top, 1.0f, 0.0f, white},
                              {right, bottom, 1.0f, 1.0f, white},
                              {left, bottom, 0.0f, 1.0f, white}};

    add_quad(c, c->picture_texture[index], corner);
}

static status check(const canvas *c)
{
    status rc = STATUS_OK;
    const GLenum error = c->gl.GetError();

    NEED(error == GL_NO_ERROR, STATUS_DEVICE, "OpenGL reports the error 0x%04x", error);
out:
    return rc;
}

status canvas_end(canvas *c)
{
    flush(c);
    c->gl.Finish();
    return check(c);
}

status canvas_read(canvas *c, uint8_t *out_rgb)
{
    const size_t row_bytes = (size_t)c->width * 3;

    /* OpenGL's rows run upwards. */
    for (int row = 0; row < c->height; row++)
        c->gl.ReadPixels(0, c->height - 1 - row, c->width, 1, GL_RGB, GL_UNSIGNED_BYTE,
                         out_rgb + (size_t)row * row_bytes);
    return check(c);
}
