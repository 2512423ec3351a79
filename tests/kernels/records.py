"""Numpy twins of the records of kernels/records.h; test_records.py holds them to the device."""
import numpy as np

NONE = 0xFFFFFFFF
NO_VALUE = -9999.0
BAND_PLANES, BAND_PARTS, RADIANCE_PARTS, BAND_STDERR, TRUTH_PLANES = 12, 5, 6, 11, 11
BAND_RADIANCE, BAND_COUNTS, BAND_APPARENT, BAND_EMISSIVITY, BAND_BACKGROUND_EMISSIVITY = range(5)
PIXEL_GROUP = 16
WITHOUT_PARTS = (1 << BAND_PARTS) - 1  # planes that are wanted, a bit each
ALL_PARTS = WITHOUT_PARTS | ((1 << RADIANCE_PARTS) - 1) << BAND_PARTS
BAND_TEMPERATURES, BAND_LOWEST_K, BAND_HIGHEST_K = 1024, 1.0, 20000.0
WEIGHT, PLANCK_FIRST, PLANCK_SECOND, SUN, SKY, PATHS = range(6)  # SPECTRA_...
MISSED, DIFFUSE, SPECULAR_SKY, SPECULAR_BACKGROUND = range(4)  # INTERACTION_...


def record(text):
    """A record of float32 and, with * before the name, uint32; [n] makes an array."""
    fields = []
    for field in text.split():
        name, *counts = field.lstrip("*").replace("]", "").split("[")
        fields.append((name, "u4" if field[0] == "*" else "f4", tuple(map(int, counts))))
    return np.dtype(fields)


BVH_NODE = record("low[3][8] high[3][8] *child[8] *order[8]")
BVH_BLOCK = record("vertex[3][3][8] *facet[8]")
HIT = record("point[3] range_m *facet normal[3]")
FACET = record("normal[3] *material slope_rad azimuth_rad thickness_m power_w_m2"
               " stated_temperature_k *two_sided *lateral_column *received_column")
VIEW = record("*first *count sky below")
CONDUCTION = record("*neighbour[4] link_w_k[4] stated_w_k stated_k area_m2 *unused")
MATERIAL = record("density_kg_m3 specific_heat_j_kg_k conductivity_w_m_k solar_absorptance"
                  " thermal_emissivity exposed_area specular_share *emissivity_first"
                  " *emissivity_angles *number *lobe_first roughness melts_k *unused[3]")
FORCING = record("air_temperature_k sky_longwave_w_m2 convection_w_m2_k direct_w_m2 diffuse_w_m2"
                 " sun[3] rain_w_m2_k rain_temperature_k specific_humidity"
                 " pressure_pa *convection_law buoyancy roughness plate_w_m2_k wet_below_k *unused[3]")
WORLD = record("*ground_facet ground_z_m offset_m *cull_back")
BACKGROUND = record("shape_factor mean_temperature_k *material *facet point[3] normal[3]"
                    " *met_count *unused")
CAMERA = record("position[3] corner[3] across[3] down[3] *first_column *first_row"
                " *is_orthographic *samples_per_side *seed *unused[3]")
RADIOMETRY = record("*columns *first_pixel *pixel_count *band_count *sample_count *thesis"
                    " *path_count path_zenith_first_deg path_zenith_step_deg *zenith_count"
                    " *azimuth_count zenith_step_deg azimuth_step_deg sun[3] *wants *first_group *knot_count *knot_span")
AIR = record("*first_row *altitude_count *range_count *is_level ground_z_m *unused[3] altitude_z_m[20]"
             " range_m[20]")
TRANSMISSION_PATH = record("length_m[4] temperature_k[4] middle_m[4] vertical_m[4] *medium[4]")
INCIDENT = record("*cell_count *dome_count *ring_count *light_length *is_of_facets *keeps_sky *unused[2]")
EMISSIVITY = record("*low *high fraction *unused")
BAND = record("*first_sample *sample_count gain offset width_um *is_mean *first_weight *unused")
DETECTOR = record("*seed *frame *band *columns *count *last_count noise shot fixed_gain fixed_offset"
                  " periodic waves_across waves_down gain offset *first")
BLUR = record("*columns *rows *step *picture_columns *picture_rows *weight_columns *weight_rows"
              " *first_column *first_row *first *present *unused")
SPAN = record("*facet_count *first_step *row_count *sunlit_words weight step_s *sunlit_period *step_count")
SUN_DAY = record("*slot_count *word_count *nearest since_min step_min *stride *unused[2]")
MEDIUM_WORLD = record("low[3] high[3] altitude_m *level_count stated_k[4] broad_band_per_m[4] *scatters[4]")
LAYERED = record("capacity_j_m2_k[8] conductance_w_m2_k[9] normal[3] absorptance emissivity power_w_m2"
                 " *two_sided *back back_k resistance_day_s_m resistance_night_s_m film_limit_kg_m2"
                 " stated_temperature_k *material *lateral_column lateral_fraction[8] sky_fraction"
                 " *received_column melts_k *unused")
CONDUCTION_PROGRESS = record("*days *step *is_settled *is_done")
CONDUCTION_GROUP = np.dtype("V4096")  # to work with: room enough for what the device makes of it

TWINS = {  # by the name of the record
    "bvh_node": BVH_NODE, "bvh_block": BVH_BLOCK, "hit_record": HIT, "facet_record": FACET,
    "material_record": MATERIAL, "forcing_record": FORCING, "world_record": WORLD,
    "background_record": BACKGROUND, "camera_record": CAMERA, "radiometry_record": RADIOMETRY,
    "incident_record": INCIDENT, "band_record": BAND, "detector_record": DETECTOR,
    "blur_record": BLUR, "air_record": AIR, "conduction_record": CONDUCTION, "view_record": VIEW,
    "emissivity_record": EMISSIVITY, "thermal_span": SPAN, "sun_day": SUN_DAY,
    "medium_world": MEDIUM_WORLD, "transmission_path": TRANSMISSION_PATH,
    "layered_record": LAYERED, "conduction_progress": CONDUCTION_PROGRESS,
    "conduction_group": CONDUCTION_GROUP,
}
