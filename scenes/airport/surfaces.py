"""Every surface of the airport: material, attribute, thickness in cm, power in langley per hour.

Thickness and power of the runway and the grass are those that thesis Appendix A prints, the others
follow Table D-1 where it has a like thing (car panels, asphalt, windows, tyres) and common building
practice elsewhere. Power is self-generated: engines, warm rooms, and the values of Table D-1.
"""

from gdb_file import Surface

RUNWAY = Surface("concrete/roadway", "runway", 35.56)
SLAB = Surface("concrete/roadway", "slab", 35.56)
TAR = Surface("tar", "gap", 2.4, 2.2)
ROAD = Surface("asphalt", "road", 2.4, 2.2)
GRASS = Surface("summergrass", "grass", 0.91, -3.5)
EARTH = Surface("soil", "mound", 30)
MARKING = Surface("white_marking", "marking", 35.56)
WALL = Surface("concrete", "wall", 20)
BRICK_WALL = Surface("brick", "wall", 23)
SHEET = Surface("painted_steel", "sheet", 0.09)
FRAME = Surface("painted_steel", "frame", 0.5)
SHINGLES = Surface("shingles", "roof", 0.05)
PLANK = Surface("painted_wood", "plank", 2.4)
ROOF = Surface("old_asphalt", "roof", 2.4)
PANE = Surface("window", "pane", 0.31)
WARM_PANE = Surface("window", "pane", 0.31, 0.8)
LAMP = Surface("window", "lamp", 0.3)
BARE_FRAME = Surface("bare_steel", "frame", 0.3)

SKIN = Surface("aircraft_paint", "skin", 0.25)
RADOME = Surface("radome_paint", "radome", 0.8)
CANOPY = Surface("plexiglass", "canopy", 1.0)
DUCT = Surface("aircraft_paint", "duct", 0.25)
DUCT_RUNNING = Surface("aircraft_paint", "duct", 0.25, 5.0)
TAIL_METAL = Surface("bare_steel", "shroud", 0.2)
TAIL_METAL_RUNNING = Surface("bare_steel", "shroud", 0.2, 25.0)
EXHAUST = Surface("oxidised_steel", "exhaust", 0.3)
EXHAUST_RUNNING = Surface("oxidised_steel", "exhaust", 0.3, 300.0)
STRUT = Surface("bare_steel", "strut", 2.0)
TYRE = Surface("tire", "tyre", 0.15)
MISSILE = Surface("white_paint", "missile", 0.3)

OLIVE = Surface("olive_paint", "panel", 0.09)
BONNET_WARM = Surface("olive_paint", "bonnet", 0.09, 1.8)
CAR_SIDE = Surface("car_side", "side", 0.01, 1.8)
CAR_ROOF = Surface("car_roof", "roof", 0.09)
BUMPER = Surface("bumper", "bumper", 0.12)
WINDSHIELD = Surface("windshield", "windshield", 0.11)
CANVAS = Surface("canvas", "cover", 0.2)
BLADE = Surface("radome_paint", "blade", 3.0)
TANK = Surface("white_paint", "shell", 0.8)
DRUM = Surface("olive_paint", "drum", 0.1)
