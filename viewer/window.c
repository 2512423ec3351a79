#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <stdlib.h>

enum { QUEUE_LIMIT = 256 };

typedef struct window {
    surface base;
    GLFWwindow *glfw;
    event queue[QUEUE_LIMIT]; /* those that do not fit are lost */
    int first, count;
    double x, y; /* of the pointer, pixels */
} window;

static void add(GLFWwindow *glfw, event e)
{
    window *w = glfwGetWindowUserPointer(glfw);
    event *last = &w->queue[(w->first + w->count + QUEUE_LIMIT - 1) % QUEUE_LIMIT];

    if (e.kind == EVENT_MOVE) {
        w->x = e.x;
        w->y = e.y;
    }
    if (e.kind != EVENT_KEY && e.kind != EVENT_RESIZE) {
        e.x = w->x;
        e.y = w->y;
    }
    if (e.kind == EVENT_MOVE && w->count > 0 && last->kind == EVENT_MOVE) {
        *last = e;
        return;
    }
    if (w->count == QUEUE_LIMIT) return;
    w->queue[(w->first + w->count++) % QUEUE_LIMIT] = e;
}

static void on_key(GLFWwindow *glfw, int key, int code, int action, int modifiers)
{
    static const struct {
        int glfw;
        event_key key;
    } keys[] = {{GLFW_KEY_LEFT, EVENT_LEFT},       {GLFW_KEY_RIGHT, EVENT_RIGHT},
                {GLFW_KEY_UP, EVENT_UP},           {GLFW_KEY_DOWN, EVENT_DOWN},
                {GLFW_KEY_PAGE_UP, EVENT_PAGE_UP}, {GLFW_KEY_PAGE_DOWN, EVENT_PAGE_DOWN},
                {GLFW_KEY_HOME, EVENT_HOME},       {GLFW_KEY_ENTER, EVENT_ENTER},
                {GLFW_KEY_KP_ENTER, EVENT_ENTER},  {GLFW_KEY_ESCAPE, EVENT_ESCAPE}};

    (void)code;
    if (action == GLFW_RELEASE) return;
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++)
        if (keys[i].glfw == key)
            add(glfw, (event){.kind = EVENT_KEY,
                              .key = keys[i].key,
                              .shift = modifiers & GLFW_MOD_SHIFT,
                              .control = modifiers & GLFW_MOD_CONTROL,
                              .alt = modifiers & GLFW_MOD_ALT});
}

static void on_character(GLFWwindow *glfw, unsigned character)
{
    add(glfw, (event){.kind = EVENT_KEY, .key = character});
}

static void on_button(GLFWwindow *glfw, int button, int action, int modifiers)
{
    static const event_button buttons[] = {EVENT_BUTTON_LEFT, EVENT_BUTTON_RIGHT,
                                           EVENT_BUTTON_MIDDLE};

    if (button > GLFW_MOUSE_BUTTON_MIDDLE) return;
    add(glfw, (event){.kind = action == GLFW_PRESS ? EVENT_PRESS : EVENT_RELEASE,
                      .button = buttons[button],
                      .shift = modifiers & GLFW_MOD_SHIFT,
                      .control = modifiers & GLFW_MOD_CONTROL});
}

/* Pixels in a unit of the screen's coordinates. */
static double pixel_ratio(GLFWwindow *glfw)
{
    int pixels, units, height;

    glfwGetFramebufferSize(glfw, &pixels, &height);
    glfwGetWindowSize(glfw, &units, &height);
    return units > 0 && pixels > 0 ? (double)pixels / units : 1.0;
}

static void on_move(GLFWwindow *glfw, double x, double y)
{
    const double ratio = pixel_ratio(glfw);

    add(glfw, (event){.kind = EVENT_MOVE, .x = x * ratio, .y = y * ratio});
}

static void on_scroll(GLFWwindow *glfw, double across, double amount)
{
    (void)across;
    add(glfw, (event){.kind = EVENT_SCROLL, .amount = amount});
}

static void on_resize(GLFWwindow *glfw, int width, int height)
{
    add(glfw, (event){.kind = EVENT_RESIZE, .x = width, .y = height});
}

static void on_refresh(GLFWwindow *glfw)
{
    int width, height;

    glfwGetFramebufferSize(glfw, &width, &height);
    on_resize(glfw, width, height);
}

static void on_close(GLFWwindow *glfw)
{
    add(glfw, (event){.kind = EVENT_CLOSE});
}

static surface_function load(const char *name)
{
    return (surface_function)glfwGetProcAddress(name);
}

static void measure(surface *s, int *out_width, int *out_height, double *out_scale)
{
    float across, down;

    glfwGetFramebufferSize(((window *)s)->glfw, out_width, out_height);
    glfwGetWindowContentScale(((window *)s)->glfw, &across, &down);
    *out_scale = across > 0.0f ? (double)across : 1.0;
}

static status resize(surface *s, int width, int height)
{
    const double ratio = pixel_ratio(((window *)s)->glfw);

    glfwSetWindowSize(((window *)s)->glfw, (int)(width / ratio), (int)(height / ratio));
    return STATUS_OK;
}

static void show(surface *s)
{
    glfwSwapBuffers(((window *)s)->glfw);
}

static bool take(surface *s, event *out, double wait_s)
{
    window *w = (window *)s;

    if (w->count == 0) {
        if (wait_s > 0.0)
            glfwWaitEventsTimeout(wait_s);
        else
            glfwPollEvents();
    }
    if (w->count == 0) return false;
    *out = w->queue[w->first];
    w->first = (w->first + 1) % QUEUE_LIMIT;
    w->count--;
    return true;
}

static void name(surface *s, const char *title)
{
    glfwSetWindowTitle(((window *)s)->glfw, title);
}

static void free_surface(surface *s)
{
    window *w = (window *)s;

    if (w->glfw) glfwDestroyWindow(w->glfw);
    glfwTerminate();
    free(w);
}

static void listen(window *w)
{
    glfwSetWindowUserPointer(w->glfw, w);
    glfwSetKeyCallback(w->glfw, on_key);
    glfwSetCharCallback(w->glfw, on_character);
    glfwSetMouseButtonCallback(w->glfw, on_button);
    glfwSetCursorPosCallback(w->glfw, on_move);
    glfwSetScrollCallback(w->glfw, on_scroll);
    glfwSetFramebufferSizeCallback(w->glfw, on_resize);
    glfwSetWindowRefreshCallback(w->glfw, on_refresh);
    glfwSetWindowCloseCallback(w->glfw, on_close);
}

static const char *reason(void)
{
    const char *text = NULL;

    glfwGetError(&text);
    return text ? text : "unknown";
}

status window_open(surface **out, int width, int height)
{
    status rc = STATUS_OK;
    window *w = calloc(1, sizeof *w);

    NEED(w, STATUS_MEMORY, "no memory for a window");
    w->base = (surface){load, measure, resize, show, take, name, free_surface};
    NEED(glfwInit(), STATUS_DEVICE,
         "no display to open a window on (%s): --offscreen FILE.png draws without one", reason());
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    w->glfw = glfwCreateWindow(width, height, "radsig", NULL, NULL);
    NEED(w->glfw, STATUS_DEVICE, "no window with OpenGL 3.3 can be opened: %s", reason());
    glfwMakeContextCurrent(w->glfw);
    glfwSwapInterval(0);
    listen(w);
    *out = &w->base;
    w = NULL;
out:
    if (w) free_surface(&w->base);
    return rc;
}
