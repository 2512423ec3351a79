#include "scene/scene_parts.h"

static bool take_pair(scene_table *t, const toml_node *pair, double *out_hour, double *out_w_m2)
{
    char message[512];

    if (toml_node_kind(pair) == TOML_ARRAY && toml_node_count(pair) == 2 &&
        toml_node_number(out_hour, toml_node_at(pair, 0), message, sizeof message) == 0 &&
        toml_node_number(out_w_m2, toml_node_at(pair, 1), message, sizeof message) == 0)
        return true;
    scene_fail(t->reader, pair, "%s: expected pairs of clock hour and W/m2: [[8, 500], [17.5, 0]]",
               toml_node_name(pair));
    return false;
}

void scene_read_power(scene_table *t, heat_schedule *out)
{
    const toml_node *list = scene_table_node(t, "power_w_m2_by_hour");
    const size_t count = list && toml_node_kind(list) == TOML_ARRAY ? toml_node_count(list) : 0;

    if (!list) return;
    if (count < 1 || count > HEAT_SCHEDULE_ENTRIES) {
        scene_fail(t->reader, list, "%s: expected 1 to %d pairs of clock hour and W/m2",
                   toml_node_name(list), HEAT_SCHEDULE_ENTRIES);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const toml_node *pair = toml_node_at(list, i);
        if (!take_pair(t, pair, &out->hour[i], &out->w_m2[i])) return;
        if (out->hour[i] < 0.0 || out->hour[i] > 24.0 ||
            (i > 0 && out->hour[i] <= out->hour[i - 1]) || out->w_m2[i] < -1e6 ||
            out->w_m2[i] > 1e6) {
            scene_fail(t->reader, pair,
                       "%s: found [%g, %g], expected hours from 0 to 24 that ascend and W/m2 from "
                       "-1e6 to 1e6",
                       toml_node_name(pair), out->hour[i], out->w_m2[i]);
            return;
        }
    }
    out->count = count;
}
