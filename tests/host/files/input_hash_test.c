#include "../text_file.h"

#include "files/input_hash.h"
#include "files/record_file.h"
#include "meshio/input_file.h"

static void write_text(const char *text)
{
    text_file(text);
}

static void read_it(void)
{
    record_file *file = NULL;

    assert_int_equal(record_file_open(&file, text_file_at), STATUS_OK);
    record_file_free(file);
}

/* FIPS 180-2, B.1 */
static const char of_abc[] = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
/* NIST, the message of no bits */
static const char of_nothing[] = "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855";

static void the_hash_is_that_of_the_bytes_that_were_read(void **state)
{
    input_hashes *hashes = NULL;
    input_hash found = {{0}, 0};
    (void)state;

    write_text("abc");
    assert_int_equal(input_hashes_open(&hashes), STATUS_OK);
    read_it();
    unlink(text_file_at);

    assert_int_equal(input_hashes_find(hashes, text_file_at, &found), STATUS_OK);
    assert_string_equal(found.sha256, of_abc);
    assert_int_equal(found.bytes, 3);
    input_hashes_free(hashes);
}

static void a_file_that_was_not_read_is_read_for_its_hash(void **state)
{
    input_hashes *hashes = NULL;
    input_hash found = {{0}, 1};
    (void)state;

    write_text("");
    assert_int_equal(input_hashes_open(&hashes), STATUS_OK);

    assert_int_equal(input_hashes_find(hashes, text_file_at, &found), STATUS_OK);
    assert_string_equal(found.sha256, of_nothing);
    assert_int_equal(found.bytes, 0);
    unlink(text_file_at);
    assert_int_equal(input_hashes_find(hashes, text_file_at, &found), STATUS_OK);
    assert_int_equal(input_hashes_find(hashes, text_file_folder, &found), STATUS_FILE);
    assert_non_null(strstr(status_message(), "a folder"));
    input_hashes_free(hashes);
}

static void a_file_that_changes_between_two_readings_is_refused(void **state)
{
    input_hashes *hashes = NULL;
    input_hash found;
    (void)state;

    write_text("abc");
    assert_int_equal(input_hashes_open(&hashes), STATUS_OK);
    read_it();
    read_it();
    assert_int_equal(input_hashes_find(hashes, text_file_at, &found), STATUS_OK);
    write_text("abd");
    read_it();

    assert_int_equal(input_hashes_find(hashes, text_file_at, &found), STATUS_FILE);
    assert_non_null(strstr(status_message(), text_file_at));
    input_hashes_free(hashes);
}

static void nothing_is_hashed_after_the_end(void **state)
{
    input_hashes *hashes = NULL;
    (void)state;

    write_text("abc");
    assert_int_equal(input_hashes_open(&hashes), STATUS_OK);
    input_hashes_free(hashes);
    read_it(); /* would write into freed memory */
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, text_file_setup, text_file_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(the_hash_is_that_of_the_bytes_that_were_read),
        TEST(a_file_that_was_not_read_is_read_for_its_hash),
        TEST(a_file_that_changes_between_two_readings_is_refused),
        TEST(nothing_is_hashed_after_the_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
