#include "../scratch_folder.h"
#include "../skip.h"

#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <stdbool.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "tree/bvh_cache.h"

enum { SIDE = 225, FACETS = SIDE * SIDE, VERTICES = (SIDE + 1) * (SIDE + 1) };

_Static_assert((int)FACETS >= (int)BVH_CACHE_LEAST, "the terrain is kept");

static float (*position)[3];
static uint32_t (*corner)[4];
static bvh *fresh;

static bvh_source terrain(void)
{
    return (bvh_source){.facet_count = FACETS,
                        .vertex_count = VERTICES,
                        .corner = (const uint32_t(*)[4])corner,
                        .position = (const float(*)[3])position};
}

static int make_terrain(void **state)
{
    (void)state;
    position = malloc(VERTICES * sizeof *position);
    corner = malloc(FACETS * sizeof *corner);
    for (uint32_t i = 0; i < VERTICES; i++) {
        position[i][0] = (float)(i % (SIDE + 1));
        position[i][1] = (float)(i / (SIDE + 1));
        position[i][2] = 3 * sinf(.3f * position[i][0]) * cosf(.2f * position[i][1]);
    }
    for (uint32_t i = 0; i < FACETS; i++) {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE;
        const uint32_t quad[4] = {a, a + 1, a + SIDE + 2, a + SIDE + 1};
        memcpy(corner[i], quad, sizeof quad);
    }
    const bvh_source source = terrain();
    return bvh_build(&fresh, &source) == STATUS_OK ? 0 : -1;
}

static int free_terrain(void **state)
{
    (void)state;
    bvh_free(fresh);
    free(corner);
    free(position);
    return 0;
}

/* A cache of its own for each test. */
static int setup(void **state)
{
    if (scratch_setup(state) != 0) return -1;
    return setenv("XDG_CACHE_HOME", scratch_path("cache"), 1);
}

static bool is_fresh(const bvh *tree)
{
    const bvh_tables *a = bvh_look(tree), *b = bvh_look(fresh);

    return a->node_count == b->node_count && a->block_count == b->block_count &&
           a->triangle_count == b->triangle_count && !memcmp(a->low, b->low, sizeof a->low) &&
           !memcmp(a->high, b->high, sizeof a->high) &&
           !memcmp(a->node, b->node, a->node_count * sizeof *a->node) &&
           !memcmp(a->block, b->block, a->block_count * sizeof *a->block);
}

static void build_and_compare(void)
{
    const bvh_source source = terrain();
    bvh *tree = NULL;

    assert_int_equal(bvh_cache_build(&tree, &source), STATUS_OK);
    assert_true(is_fresh(tree));
    assert_int_equal((uintptr_t)bvh_look(tree)->node % 64, 0);
    assert_int_equal((uintptr_t)bvh_look(tree)->block % 64, 0);
    bvh_free(tree);
}

/* The name, in the scratch folder, of the only file of the cache. */
static const char *kept_file(void)
{
    static char name[300];
    DIR *folder = opendir(scratch_path("cache/radsig"));

    assert_non_null(folder);
    assert_int_equal(scratch_count("cache/radsig"), 1);
    for (struct dirent *entry; (entry = readdir(folder));)
        if (entry->d_name[0] != '.') snprintf(name, sizeof name, "cache/radsig/%s", entry->d_name);
    closedir(folder);
    return name;
}

static ino_t inode(const char *name)
{
    struct stat found;

    assert_int_equal(stat(scratch_path(name), &found), 0);
    return found.st_ino;
}

static void a_kept_tree_has_the_bytes_of_a_fresh_one(void **state)
{
    (void)state;
    build_and_compare();
    const ino_t first = inode(kept_file());

    build_and_compare();

    assert_int_equal(inode(kept_file()), first); /* read, not written again */
}

static void other_geometry_has_a_file_of_its_own(void **state)
{
    (void)state;
    const bvh_source source = terrain();
    bvh *tree = NULL;
    build_and_compare();
    position[7][2] += 1;

    assert_int_equal(bvh_cache_build(&tree, &source), STATUS_OK);

    position[7][2] -= 1;
    assert_false(is_fresh(tree));
    assert_int_equal(scratch_count("cache/radsig"), 2);
    bvh_free(tree);
}

static void write_bytes(const char *name, const char *bytes, size_t size)
{
    FILE *file = fopen(scratch_path(name), "wb");

    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    fclose(file);
}

static void a_damaged_file_is_written_anew(void **state)
{
    (void)state;
    size_t size;
    build_and_compare();
    const char *name = kept_file();
    char *whole = scratch_read(name, &size);
    const size_t at[] = {0, 9, 20, 32, 36, 40, 44, 60, 70, 75, 80, 1000, size / 2, size - 1};

    for (size_t i = 0; i < sizeof at / sizeof *at; i++) {
        whole[at[i]] ^= 16;
        write_bytes(name, whole, size);
        whole[at[i]] ^= 16;

        build_and_compare();

        size_t mended_size;
        char *mended = scratch_read(name, &mended_size);
        assert_int_equal(mended_size, size);
        assert_memory_equal(mended, whole, size);
        free(mended);
    }
    free(whole);
}

static void a_file_of_another_length_is_written_anew(void **state)
{
    (void)state;
    size_t size;
    build_and_compare();
    const char *name = kept_file();
    char *whole = scratch_read(name, &size); /* and a 0 behind it */
    const size_t length[] = {0, 1, 79, 80, size - 1, size + 1};

    for (size_t i = 0; i < sizeof length / sizeof *length; i++) {
        write_bytes(name, whole, length[i]);
        build_and_compare();
        size_t mended_size;
        free(scratch_read(name, &mended_size));
        assert_int_equal(mended_size, size);
    }
    free(whole);
}

static void what_is_no_file_of_ours_is_no_failure(void **state)
{
    (void)state;
    build_and_compare();
    const char *name = kept_file();

    assert_int_equal(unlink(scratch_path(name)), 0);
    assert_int_equal(mkfifo(scratch_path(name), 0600), 0);
    build_and_compare();
    assert_int_equal(unlink(scratch_path(name)), 0);
    assert_int_equal(mkdir(scratch_path(name), 0700), 0);
    build_and_compare();

    assert_int_equal(scratch_count("cache/radsig"), 1);
}

static void a_folder_that_cannot_be_made_is_no_failure(void **state)
{
    (void)state;
    write_bytes("file", "x", 1);
    setenv("XDG_CACHE_HOME", scratch_path("file"), 1);

    build_and_compare();

    scratch_assert_text("file", "x");
}

static void a_full_disk_is_no_failure_and_leaves_nothing(void **state)
{
    (void)state;
    struct rlimit before, little;
    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &before), 0);
    little = before;
    little.rlim_cur = 100000;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &little), 0);

    build_and_compare();

    assert_int_equal(setrlimit(RLIMIT_FSIZE, &before), 0);
    assert_int_equal(scratch_count("cache/radsig"), 0);
}

static void several_processes_at_once_end_with_one_whole_file(void **state)
{
    (void)state;
    enum { PROCESSES = 4 };
#ifdef __SANITIZE_THREAD__
    SKIP_IF(true, "ThreadSanitizer cannot follow processes that fork from threads");
#endif
    const bvh_source source = terrain();
    pid_t process[PROCESSES];

    for (int i = 0; i < PROCESSES; i++) {
        process[i] = fork();
        assert_true(process[i] >= 0);
        if (process[i] > 0) continue;
        bvh *tree = NULL;
        const bool is_good = bvh_cache_build(&tree, &source) == STATUS_OK && is_fresh(tree);
        _exit(is_good ? 0 : 1);
    }
    for (int i = 0; i < PROCESSES; i++) {
        int code = -1;
        assert_int_equal(waitpid(process[i], &code, 0), process[i]);
        assert_int_equal(code, 0);
    }

    const ino_t kept = inode(kept_file());
    build_and_compare();
    assert_int_equal(inode(kept_file()), kept);
}

static void without_a_stated_folder_that_of_the_home_is_used(void **state)
{
    (void)state;
    const char *homes[] = {NULL, "", "relative/folder"};

    for (size_t i = 0; i < sizeof homes / sizeof *homes; i++) {
        char name[32];
        snprintf(name, sizeof name, "home%zu", i);
        setenv("HOME", scratch_path(name), 1);
        if (homes[i])
            setenv("XDG_CACHE_HOME", homes[i], 1);
        else
            unsetenv("XDG_CACHE_HOME");
        build_and_compare();
        strcat(name, "/.cache/radsig");
        assert_int_equal(scratch_count(name), 1);
    }
}

static void a_tree_that_is_read_counts_as_used_now(void **state)
{
    (void)state;
    const struct timespec long_ago[2] = {{.tv_sec = 1000}, {.tv_sec = 1000}};
    struct stat found;
    build_and_compare();
    const char *name = kept_file();
    assert_int_equal(utimensat(AT_FDCWD, scratch_path(name), long_ago, 0), 0);

    build_and_compare();

    assert_int_equal(stat(scratch_path(name), &found), 0);
    assert_true(found.st_mtim.tv_sec > 1000000000); /* after 2001 */
}

static void a_tree_beyond_the_budget_is_not_kept(void **state)
{
    (void)state;
    setenv("RADSIG_CACHE_GB", "1e-4", 1);

    build_and_compare();

    unsetenv("RADSIG_CACHE_GB");
    assert_int_equal(scratch_count("cache/radsig"), 0);
}

static void small_trees_are_not_kept(void **state)
{
    (void)state;
    bvh_source source = terrain();
    bvh *tree = NULL;
    source.facet_count = BVH_CACHE_LEAST - 1;

    assert_int_equal(bvh_cache_build(&tree, &source), STATUS_OK);

    assert_int_equal(scratch_count("cache"), -1);
    bvh_free(tree);
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_kept_tree_has_the_bytes_of_a_fresh_one),
        IN_FOLDER(other_geometry_has_a_file_of_its_own),
        IN_FOLDER(a_damaged_file_is_written_anew),
        IN_FOLDER(a_file_of_another_length_is_written_anew),
        IN_FOLDER(what_is_no_file_of_ours_is_no_failure),
        IN_FOLDER(a_folder_that_cannot_be_made_is_no_failure),
        IN_FOLDER(a_full_disk_is_no_failure_and_leaves_nothing),
        IN_FOLDER(several_processes_at_once_end_with_one_whole_file),
        IN_FOLDER(without_a_stated_folder_that_of_the_home_is_used),
        IN_FOLDER(a_tree_that_is_read_counts_as_used_now),
        IN_FOLDER(a_tree_beyond_the_budget_is_not_kept),
        IN_FOLDER(small_trees_are_not_kept),
    };

    return cmocka_run_group_tests(tests, make_terrain, free_terrain);
}
