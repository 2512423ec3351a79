#include "kernels/band_plane.h"
#include "kernels/media/cloud.h"
#include "kernels/radiance/pixel.h"
#include "kernels/radiance/radiometry.h"

/* What the spectra of a pixel are read from. */
typedef struct pixel_spectra {
    spectra_tables of;                     /* all pixels */
    global const float *incident;          /* shape (2, knot_count); NULL: thesis mode */
    global const transmission_path *paths; /* shape (TRANSMISSION_PATHS), strided */
} pixel_spectra;

static spectrum load_row(pixel_spectra tables, radiometry_record frame, uint row, uint block)
{
    return spectrum_load(tables.of.rows + (size_t)row * frame.sample_count, block);
}

static global const float *sky_rows(pixel_spectra tables, radiometry_record frame)
{
    return tables.of.rows + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * frame.sample_count;
}

static transmission_path load_path(pixel_spectra tables, radiometry_record frame, uint path)
{
    return tables.paths[(size_t)path * frame.pixel_count];
}

/* E_S tau1, and tau1c or tau_SB of bodies on the sun's way. */
static spectrum load_sun(pixel_spectra tables, radiometry_record frame, uint path, uint block)
{
    const spectrum sun = load_row(tables, frame, SPECTRA_SUN, block);

    if (!tables.of.extinction) return sun;
    const transmission_path media = load_path(tables, frame, path);
    return sun * transmission_along(tables.of.extinction, frame.sample_count, &media, block);
}

/* What the target gets of the sun, still to be multiplied by (1 - e): as eq. 2.4-2 has it, and in
 * exact mode by its lobes. */
static spectrum load_sun_on_target(const pixel_state *pixel, pixel_spectra tables,
                                   radiometry_record frame, uint block)
{
    const uint row = frame.sample_count;
    const spectrum sun = load_sun(tables, frame, TRANSMISSION_SUN, block);
    spectrum diffuse = sun_on_surface(sun, pixel->sunlit, pixel->sun_cosine);

    if (pixel->lobe_row != RECORD_NONE)
        diffuse *= lobe_diffuse(
            lookup_spectrum(tables.of.emissivity, row, pixel->sun_emissivity, block),
            spectrum_load(tables.of.emissivity + (size_t)pixel->lobe_row * row, block));
    if (pixel->specular_share == 0.0f) return diffuse;
    return diffuse * (1.0f - pixel->specular_share) +
           sun * (pixel->specular_share * pixel->sunlit * pixel->glint);
}

/* What is seen through the bodies on a way, and they themselves. */
static spectrum see_through(spectrum radiance, pixel_spectra tables, radiometry_record frame,
                            uint path, uint block)
{
    if (!tables.of.extinction) return radiance;
    const transmission_path media = load_path(tables, frame, path);
    return cloud_seen(radiance, &tables.of, frame, &media, 0u, block);
}

/* Puts the bodies on the sensor's way into its transmission and radiance. As printed (eq. 2.4-1) all
 * of the air's radiance stands before them; exact mode has them where they are in the air. Before
 * the sky, which is all path, nothing else stands in thesis mode. */
static void put_bodies(const pixel_state *pixel, pixel_spectra tables, radiometry_record frame,
                       const air_record *air, uint block, air_terms *terms)
{
    const transmission_path media = load_path(tables, frame, TRANSMISSION_CAMERA);
    const uint from_above = pixel->way.up < 0.0f;
    const spectrum nothing = (spectrum)0.0f;
    spectrum through = (spectrum)1.0f, sum = nothing, before = nothing;

    for (uint i = 0; i < TRANSMISSION_MEDIA && media.length_m[i] > 0.0f; i++) {
        const spectrum own =
            transmission_part(tables.of.extinction, frame.sample_count, &media, i, block);
        air_terms upto = {(spectrum)1.0f,
                          pixel->interaction == INTERACTION_MISSED ? nothing : terms->radiance};
        if (!frame.thesis)
            upto = air_upto(tables.of.rows, frame, air, pixel->way, media.middle_m[i], block);
        sum += through * (upto.radiance - before) +
               through * upto.transmission * (1.0f - own) *
                   cloud_of_way(&tables.of, frame, &media, i, from_above, block);
        before = upto.radiance;
        through *= own;
    }
    terms->radiance = sum + through * (terms->radiance - before);
    terms->transmission *= through;
}

/* What reaches a surface from above, each still to be multiplied by (1 - e): the sky by its fraction,
 * and what stands around by the rest. */
typedef struct from_above {
    spectrum sky, background;
} from_above;

static spectrum mean_background(const pixel_state *pixel, pixel_spectra tables,
                                radiometry_record frame, uint block)
{
    const spectrum first = load_row(tables, frame, SPECTRA_PLANCK_FIRST, block);
    const spectrum second = load_row(tables, frame, SPECTRA_PLANCK_SECOND, block);
    const spectrum sun = load_sun(tables, frame, TRANSMISSION_BACKGROUND_SUN, block);
    const spectrum emissivity = lookup_spectrum(tables.of.emissivity, frame.sample_count,
                                                pixel->background_emissivity, block);
    const spectrum radiance = background_radiance(
        emissivity, planck_radiance(first, second, pixel->background_temperature_k),
        sun_on_surface(sun, pixel->background_sunlit, pixel->background_sun_cosine));

    if (pixel->interaction == INTERACTION_DIFFUSE) return radiance;
    return see_through(radiance, tables, frame, TRANSMISSION_BACKGROUND, block);
}

/* What rays brought, which is known at knots, at samples. */
static from_above between_knots(pixel_spectra tables, radiometry_record frame, uint block)
{
    global const float *sky = tables.incident, *background = sky + frame.knot_count;
    from_above out = {(spectrum)0.0f, (spectrum)0.0f};

    if (frame.knot_span == 0u)
        return (from_above){spectrum_load(sky, block), spectrum_load(background, block)};
    const uint sample = block * SPECTRUM_WIDTH, whole = sample / SPECTRA_BLOCK;
    const uint first = tables.of.knot_first[whole];
    global const float *fraction = tables.of.knot_fraction +
                                   (size_t)whole * frame.knot_span * SPECTRA_BLOCK +
                                   sample % SPECTRA_BLOCK;
    for (uint k = 0; k < frame.knot_span; k++) {
        const spectrum own = spectrum_load(fraction + k * SPECTRA_BLOCK, 0u);
        out.sky = fma((spectrum)sky[first + k], own, out.sky);
        out.background = fma((spectrum)background[first + k], own, out.background);
    }
    return out;
}

static from_above look_above(const pixel_state *pixel, pixel_spectra tables,
                             radiometry_record frame, uint block)
{
    from_above out = {(spectrum)0.0f, (spectrum)0.0f};

    if (tables.incident) return between_knots(tables, frame, block);
    if (pixel->shape_factor > 0.0f)
        out.sky = pixel->shape_factor *
                  (pixel->interaction == INTERACTION_DIFFUSE
                       ? load_row(tables, frame, SPECTRA_SKY, block)
                       : sky_radiance(sky_rows(tables, frame), frame, pixel->sky, block));
    if (pixel->background_temperature_k > 0.0f)
        out.background =
            (1.0f - pixel->shape_factor) * mean_background(pixel, tables, frame, block);
    return out;
}

/* One block of the spectra that bands are integrals of. */
typedef struct block_terms {
    spectrum radiance;
    spectrum part[RADIANCE_PARTS]; /* as the planes from BAND_PARTS on */
} block_terms;

/* A block of a pixel that met a target. */
static block_terms look_at_target(const pixel_state *pixel, pixel_spectra tables,
                                  radiometry_record frame, const air_record *air, uint block)
{
    const uint row = frame.sample_count;
    const spectrum black_body = planck_radiance(
        load_row(tables, frame, SPECTRA_PLANCK_FIRST, block),
        load_row(tables, frame, SPECTRA_PLANCK_SECOND, block), pixel->temperature_k);
    const spectrum sun = load_sun_on_target(pixel, tables, frame, block);
    const spectrum emissivity =
        lookup_spectrum(tables.of.emissivity, row, pixel->emissivity, block);
    air_terms terms = air_upto(tables.of.rows, frame, air, pixel->way, pixel->way.limit_m, block);
    const from_above above = look_above(pixel, tables, frame, block);

    if (tables.of.extinction) put_bodies(pixel, tables, frame, air, block, &terms);
    const spectrum tau2 = terms.transmission, path = terms.radiance;
    const spectrum reflected = tau2 * (1.0f - emissivity);
    const block_terms out = {
        sensor_radiance(surface_radiance(emissivity, black_body, sun, above.sky + above.background),
                        tau2, path),
        {tau2 * emitted_radiance(emissivity, black_body), reflected * sun, reflected * above.sky,
         reflected * above.background, path, tau2}};
    return out;
}

/* The same where nothing was met: the sky of the ray's direction, all of it path. */
static block_terms look_at_sky(const pixel_state *pixel, pixel_spectra tables,
                               radiometry_record frame, const air_record *air, uint block)
{
    const spectrum none = (spectrum)0.0f;
    air_terms sky = {(spectrum)1.0f,
                     sky_radiance(sky_rows(tables, frame), frame, pixel->sky, block)};

    if (tables.of.extinction) put_bodies(pixel, tables, frame, air, block, &sky);
    const block_terms out = {sky.radiance, {none, none, none, none, sky.radiance, none}};
    return out;
}

static block_terms look(const pixel_state *pixel, pixel_spectra tables, radiometry_record frame,
                        const air_record *air, uint block)
{
    if (pixel->interaction == INTERACTION_MISSED)
        return look_at_sky(pixel, tables, frame, air, block);
    return look_at_target(pixel, tables, frame, air, block);
}

/* Where the emissivities of a pixel stand: of the target, and of its background. */
static void store_emissivities(const pixel_state *pixel, global emissivity_record *out)
{
    const emissivity_record none = {RECORD_NONE, RECORD_NONE, 0.0f, 0u};
    const lookup own = pixel->emissivity, behind = pixel->background_emissivity;

    out[0] = out[1] = none;
    if (pixel->interaction != INTERACTION_MISSED)
        out[0] = (emissivity_record){own.low, own.high, own.fraction, 0u};
    if (pixel->background_temperature_k > 0.0f)
        out[1] = (emissivity_record){behind.low, behind.high, behind.fraction, 0u};
}

static pixel_state pixel_look(radiometry_record frame, const air_record *air, camera_record camera,
                              const surface_tables *surfaces, const pixel_tables *pixels,
                              uint pixel)
{
    const hit_record hit = pixels->hit[pixel];
    const background_record background = pixels->background[pixel];
    pixel_state state = {0};
    float ray[3];

    pixel_ray(camera, frame.columns, frame.first_pixel + pixel, ray);
    state.way = pixel_air(frame, air, camera, pixel, ray, hit.range_m);
    if (hit.facet == RECORD_NONE) {
        state.sky = sky_find(frame, ray[0], ray[1], ray[2]);
        return state;
    }
    state.temperature_k = pixels->temperature_k[pixel];
    state.sunlit = pixels->sunlit[pixel];
    state.shape_factor = background.shape_factor;
    const material_record material = surfaces->materials[surfaces->facets[hit.facet].material];
    state.interaction = pixel_interaction(material, background);
    pixel_set_target(&state, frame, hit, material, ray);
    if (background.facet != RECORD_NONE)
        pixel_set_background(&state, frame, surfaces->materials[background.material], background,
                             hit, ray, pixels->background_sunlit[pixel]);
    return state;
}

/* Pixels of a work-item, and blocks of one that are computed before those of the next, whose rows lie
 * apart. */
#define PIXELS (RAY_LANES == 16 ? PIXEL_GROUP : 1u)
#define BLOCKS_TOGETHER (RAY_LANES == 16 ? 8u : 1u)

/* Some blocks of the spectra of these pixels. */
typedef struct some_terms {
    spectrum of[SENSOR_TERMS][BLOCKS_TOGETHER][PIXELS];
} some_terms;

/* Writes a block of one spectrum, sample by sample.
 *   of_pixel   shape (PIXELS)
 *   out        of the first of the pixels, shape (sample_count, PIXEL_GROUP) */
static void store_block(const spectrum *of_pixel, uint block, global float *out)
{
#if RAY_LANES == 16 && SPECTRUM_WIDTH == 16
    spectrum of_sample[SPECTRUM_WIDTH];

    spectrum_turn(of_pixel, of_sample);
    UNROLL
    for (uint k = 0; k < SPECTRUM_WIDTH; k++)
        vstore16(of_sample[k], block * SPECTRUM_WIDTH + k, out);
#else
    for (uint i = 0; i < PIXELS; i++)
        for (uint k = 0; k < SPECTRUM_WIDTH; k++)
            out[(size_t)(block * SPECTRUM_WIDTH + k) * PIXEL_GROUP + i] =
                ((const float *)&of_pixel[i])[k];
#endif
}

/* Writes `count` blocks, from `first` on.
 *   out   of the first of the pixels, shape (term_count, sample_count, PIXEL_GROUP) */
static void store_terms(const some_terms *terms, uint term_count, uint first, uint count,
                        uint sample_count, global float *out)
{
    for (uint k = 0; k < term_count; k++)
        for (uint b = 0; b < count; b++)
            store_block(terms->of[k][b], first + b, out + (size_t)k * sample_count * PIXEL_GROUP);
}

/* Sets the terms of pixels past the end. */
static void clear_terms(some_terms *terms, uint count)
{
    for (uint k = 0; k < SENSOR_TERMS * BLOCKS_TOGETHER; k++)
        for (uint i = count; i < PIXELS; i++)
            terms->of[k / BLOCKS_TOGETHER][k % BLOCKS_TOGETHER][i] = (spectrum)0.0f;
}

/* Spectra of what reaches the sensor, eq. 2.4-1 and 2.4-2, of groups of neighbouring pixels.
 * Launch: (groups of PIXEL_GROUP pixels; one pixel of these where RAY_LANES is 1), from frame.first_group
 * on.
 * emissivities: shape (pixel_count, 2): of the target and of its background, rows of `emissivity`
 * terms: shape (groups launched, band_plane_terms, sample_count, PIXEL_GROUP), W m-2 sr-1 um-1: what
 *   the radiance is the sum of where that is wanted (emitted by the target, reflected of the sun,
 *   the sky and the background, path) and tau2; then the radiance. Of pixels past the end 0 */
kernel void radiometry(const radiometry_record frame, const air_record air,
                       const camera_record camera, TABLES(SURFACE_TABLES), TABLES(PIXEL_TABLES),
                       TABLES(SPECTRA_TABLES), global emissivity_record *emissivities,
                       global float *terms)
{
    const uint first = frame.first_group * PIXEL_GROUP + get_global_id(0) * PIXELS;
    if (first >= band_plane_row(frame.pixel_count)) return;

    const uint count = first < frame.pixel_count ? min(PIXELS, frame.pixel_count - first) : 0u;
    const uint term_count = band_plane_terms(frame.wants), row = frame.sample_count;
    const uint blocks = row / SPECTRUM_WIDTH, group = first / PIXEL_GROUP - frame.first_group;
    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const pixel_tables pixels = TABLES_GIVEN(PIXEL_TABLES);
    pixel_spectra tables = {.of = TABLES_GIVEN(SPECTRA_TABLES)};
    pixel_state state[PIXELS];
    some_terms own;

    for (uint i = 0; i < count; i++) {
        state[i] = pixel_look(frame, &air, camera, &surfaces, &pixels, first + i);
        store_emissivities(&state[i], emissivities + 2u * (first + i));
    }
    clear_terms(&own, count);
    terms += (size_t)group * term_count * row * PIXEL_GROUP + first % PIXEL_GROUP;
    for (uint block = 0; block < blocks; block += BLOCKS_TOGETHER) {
        const uint together = min(BLOCKS_TOGETHER, blocks - block);
        for (uint i = 0; i < count; i++) {
            if (!frame.thesis)
                tables.incident = pixels.incident + (size_t)(first + i) * 2u * frame.knot_count;
            tables.paths = pixels.paths + first + i;
            for (uint b = 0; b < together; b++) {
                const block_terms seen = look(&state[i], tables, frame, &air, block + b);
                for (uint k = 0; k + 1u < term_count; k++) own.of[k][b][i] = seen.part[k];
                own.of[term_count - 1u][b][i] = seen.radiance;
            }
        }
        store_terms(&own, term_count, block, together, row, terms);
    }
}
