"""Table D-1 of the thesis: the materials of June 1992, as facets have them."""
from dataclasses import dataclass

LANGLEY_PER_HOUR_W_M2 = 41840 / 3600


@dataclass(frozen=True)
class Row:
    name: str
    density_g_cm3: float
    specific_heat_cal_g_c: float
    conductivity_cal_cm_h_c: float
    thickness_cm: float
    visible_emissivity: float
    thermal_emissivity: float
    exposed_area: float
    power_ly_h: float
    slope_deg: float
    azimuth_deg: float


_TEXT = """
Asphalt     2.114 .22    5.93  2.4  .93 .93  .40 2.2  0   0
Blue_Wood    .60  .67     .86  2.4  .60 .78 -.77 0   69  90
Bumper      7.833 .1111 464.4   .12 .88 .44  .69 0   90  90
Car_Roof    7.833 .1111 464.4   .09 .88 .44  .53 0    0   0
Car_Side    7.833 .1111 464.4   .01 .88 .44 1.0  1.8 90  90
Concrete    2.28  .1601  15.48 4.5  .73 .94  .39 0    0   0
Front_Black  .60  .67     .86  2.4  .90 .78 -.77 0   90  90
Front_White  .60  .67     .86  2.4  .20 .78 -.77 0   90  90
Green_Wood   .60  .67     .86  2.4  .55 .78 -.77 0   69  90
Grey_1       .60  .67     .86  2.4  .50 .78 -.77 0   69  90
Grey_2       .60  .67     .86  2.4  .60 .78 -.77 0   69  90
Grey_3       .60  .67     .86  2.4  .70 .78 -.77 0   69  90
Grey_4       .60  .67     .86  2.4  .80 .78 -.77 0   69  90
Grey_5       .60  .67     .86  6.0  .72 .87 -.55 0   69  90
Red          .60  .67     .86  2.4  .65 .78 -.77 0   69  90
Sand        1.52  .1911   2.84 1.3  .76 .90  .39 0    0   0
Windshield  1.0   .52   12.04   .11 .61 .61  .52 0   17 180
Shingles    1.3   .35    6.36   .05 .74 .91 -.66 0   29  90
Specular     .60  .67     .86  3.0  .72 .87 -.45 0    0   0
Tire        1.198 .2986  1.3    .15 .93 .90 -.82 0   90  90
Water       1.0  1.0    11.0  47.0  .09 .000 -.57 0   0   0
Window      1.0   .52   12.04   .31 .61 .61  .95 .80 67  90
"""

ROWS = [
    Row(name, *(float(value) for value in values))
    for name, *values in (line.split() for line in _TEXT.strip().splitlines())
]


def material_file_text():
    """The same as a .mat file (Appendix A item 10)."""
    records = [
        f"{r.name}\n{code}\n{r.specific_heat_cal_g_c}\n{r.conductivity_cal_cm_h_c}\n"
        f"{r.density_g_cm3}\n0.0\n{r.visible_emissivity}\n{r.thermal_emissivity}\n"
        f"{r.exposed_area}\nabsent.ems\nabsent.ext\n"
        for code, r in enumerate(ROWS, 1)
    ]
    return f"{len(ROWS)}\n" + "".join(records)
