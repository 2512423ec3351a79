#include "../scratch_folder.h"

#include "files/record_file.h"
#include "meshio/input_file.h"
#include "meshio/mesh_file.h"
#include "meshio/toml_file.h"
#include "sky/atmosphere.h"

#include <string.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

static char message[1024];

static void assert_unopened(const char *path, const char *expected)
{
    FILE *file = NULL;

    assert_int_not_equal(
        input_file_open(&file, NULL, path, INPUT_FILE_TEXT_LIMIT, message, sizeof message), 0);
    assert_null(file);
    if (!strstr(message, expected)) fail_msg("\"%s\" lacks \"%s\"", message, expected);
}

static const char *make_pipe(const char *name)
{
    const char *path = scratch_path(name);

    remove(path);
    assert_int_equal(mkfifo(path, 0600), 0);
    return path;
}

static const char *make_file(const char *name, const char *text, off_t size)
{
    const char *path = scratch_path(name);
    FILE *file = fopen(path, "wb");

    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fflush(file), 0);
    assert_int_equal(ftruncate(fileno(file), size), 0);
    fclose(file);
    return path;
}

static void a_file_is_opened_with_its_size_through_a_link(void **state)
{
    char path[512];
    FILE *file = NULL;
    size_t size = 0;

    (void)state;
    snprintf(path, sizeof path, "%s", make_file("file", "four", 4));
    remove(scratch_path("link"));
    assert_int_equal(symlink(path, scratch_path("link")), 0);
    assert_int_equal(
        input_file_open(&file, &size, scratch_path("link"), 4, message, sizeof message), 0);
    assert_int_equal(size, 4);
    assert_int_equal(fgetc(file), 'f');
    fclose(file);
}

static void what_is_not_a_file_is_refused_at_once(void **state)
{
    struct sockaddr_un at = {.sun_family = AF_UNIX};
    const int plug = socket(AF_UNIX, SOCK_STREAM, 0);

    (void)state;
    assert_unopened(scratch_path("absent"), "absent: No such file or directory");
    assert_unopened("/", "/: a folder, expected a file");
    assert_unopened("/dev/zero", "/dev/zero: a device, expected a file");
    assert_unopened(make_pipe("pipe"), "pipe: a pipe, expected a file");
    snprintf(at.sun_path, sizeof at.sun_path, "%s", scratch_path("plug"));
    assert_int_equal(bind(plug, (struct sockaddr *)&at, sizeof at), 0);
    assert_unopened(scratch_path("plug"), "plug: "); /* Linux does not open it at all */
    close(plug);
}

static void a_file_beyond_the_limit_is_refused(void **state)
{
    const char *path = make_file("large", "", (off_t)INPUT_FILE_TEXT_LIMIT + 1);

    (void)state;
    assert_unopened(path, "large: 2147483649 bytes, expected at most 2147483648");
    remove(path);
}

/* Each hung, or read until memory ended. */
static void every_reader_refuses_a_pipe_and_a_device(void **state)
{
    char mesh_path[512], pipe_path[512];
    record_file *records = NULL;
    mesh_file *mesh = NULL;
    toml_file *document = NULL;
    atmosphere *air = NULL;

    (void)state;
    snprintf(mesh_path, sizeof mesh_path, "%s", make_pipe("pipe.obj"));
    snprintf(pipe_path, sizeof pipe_path, "%s", make_pipe("pipe"));
    assert_int_equal(record_file_open(&records, "/dev/zero"), STATUS_FILE);
    assert_int_equal(record_file_open(&records, pipe_path), STATUS_FILE);
    assert_int_not_equal(mesh_file_read(&mesh, mesh_path, message, sizeof message), 0);
    assert_non_null(strstr(message, "pipe.obj: a pipe, expected a file"));
    assert_int_not_equal(toml_file_read(&document, pipe_path, NULL, 0, message, sizeof message), 0);
    assert_int_not_equal(toml_file_read(&document, "/dev/zero", NULL, 0, message, sizeof message),
                         0);
    assert_int_equal(atmosphere_read(&air, pipe_path), STATUS_FILE);
    assert_int_equal(atmosphere_read(&air, "/dev/zero"), STATUS_FILE);
    status_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_file_is_opened_with_its_size_through_a_link),
        cmocka_unit_test(what_is_not_a_file_is_refused_at_once),
        cmocka_unit_test(a_file_beyond_the_limit_is_refused),
        cmocka_unit_test(every_reader_refuses_a_pipe_and_a_device),
    };

    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
