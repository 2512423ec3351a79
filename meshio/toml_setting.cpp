#include "toml_setting.hpp"

#include "failure.hpp"
#include "toml_depth.hpp"

#include <charconv>

namespace
{

[[noreturn]] void fail(const std::string &setting, const std::string &what)
{
    throw failure("--set " + setting + ": " + what);
}

/* A table with the one key `x`; what is not TOML is a string, unless it begins like a quoted or
 * bracketed value. */
toml::table parsed(const std::string &setting, const std::string &value)
{
    toml_depth_check(value, "--set");
    try {
        toml::table table = toml::parse("x = " + value);
        if (table.size() == 1) return table;
    } catch (const toml::parse_error &e) {
        if (!value.empty() && std::string("\"'[{").find(value[0]) != std::string::npos)
            fail(setting, std::string(e.description()));
    }
    toml::table table;
    table.insert("x", value);
    return table;
}

std::size_t index_of(const toml::array &array, const std::string &part, const std::string &setting)
{
    std::size_t index = array.size();
    const char *end = part.data() + part.size();
    const std::from_chars_result result = std::from_chars(part.data(), end, index);

    if (result.ec != std::errc() || result.ptr != end || index >= array.size())
        fail(setting, failure_quote(part.data(), part.size()) + ", expected an index below " +
                          std::to_string(array.size()));
    return index;
}

/* The node called `part` in `parent`; a missing one becomes a table. */
toml::node &step(toml::node &parent, const std::string &part, const std::string &setting)
{
    if (toml::array *array = parent.as_array()) return (*array)[index_of(*array, part, setting)];
    if (toml::table *table = parent.as_table())
        return table->insert(part, toml::table{}).first->second;
    fail(setting, failure_quote(part.data(), part.size()) +
                      " is inside a value, expected a table or an array");
}

void put(toml::node &parent, const std::string &part, toml::node &&value,
         const std::string &setting)
{
    if (toml::array *array = parent.as_array()) {
        const std::size_t index = index_of(*array, part, setting);
        array->replace(array->cbegin() + static_cast<std::ptrdiff_t>(index), std::move(value));
    } else if (toml::table *table = parent.as_table()) {
        table->insert_or_assign(part, std::move(value));
    } else {
        fail(setting, failure_quote(part.data(), part.size()) +
                          " is inside a value, expected a table or an array");
    }
}

} // namespace

void toml_setting_apply(toml::table &root, const std::string &setting)
{
    const std::size_t equals = setting.find('=');
    toml::node *parent = &root;
    std::size_t begin = 0;

    if (equals == setting.npos) fail(setting, "expected table.key=value");
    toml_depth_check(setting.substr(0, equals), "--set");
    toml::table value = parsed(setting, setting.substr(equals + 1));
    for (;;) {
        const std::size_t end = std::min(setting.find('.', begin), equals);
        const std::string part = setting.substr(begin, end - begin);
        if (part.empty()) fail(setting, "an empty name, expected table.key=value");
        if (end == equals) return put(*parent, part, std::move(*value.get("x")), setting);
        parent = &step(*parent, part, setting);
        begin = end + 1;
    }
}
