#!/usr/bin/env python3
"""Builds the airport: make_geometry.py [OUTPUT.gdb], by default airport.gdb beside this file.

The setting of thesis 3.0 and Figures 3-1 to 3-15: 50 objects, 661 parts, 54,545 facets.
"""

import pathlib
import sys

import building
import foxbat
import gdb_file
import ground
import hangar
import helicopter
import vehicle

HERE = pathlib.Path(__file__).resolve().parent
CODES = HERE.parent / "library" / "materials.mat"
OBJECTS, PARTS, FACETS = 50, 661, 54545
TARGET = (
    -119.9939,
    90.6849,
)  # east, north of the view's target: the fighter that leaves its hangar
GRASS_PLACE = 24  # the grass is object 24 in the printed file, RUNWAY2 object 1


def near(thing, east, north, heading_deg, height=ground.PAVED_TOP):
    """Places a thing by its distance from the target."""
    return thing.place(TARGET[0] + east, TARGET[1] + north, height, heading_deg)


def pavement():
    e, n = TARGET
    return [
        ground.runway2(),
        ground.runway1(),
        ground.slab("TAXIWAY1", ground.of.RUNWAY, (-5, 35), (100, 124), -0.52, -1.4),
        ground.slab("TAXIWAY2", ground.of.RUNWAY, (55, 405), (320, 345), -0.52, -1.4),
        ground.slab("TAXIWAY3", ground.of.RUNWAY, (55, 405), (75, 100), -0.52, -1.4),
        ground.apron(e - 40, n - 90, 26, 30),
        ground.apron_lines(TARGET),
        ground.slab("ROAD", ground.of.ROAD, (e - 54, e - 46), (n - 400, n + 300), -0.9, -1.25),
        ground.slab("CAR_PARK", ground.of.ROAD, (e - 47, e - 39), (n + 16, n + 34), -0.88, -1.2),
    ]


def structures():
    on_grass = ground.GRASS_TOP
    return [
        near(hangar.build("HANGAR1"), -3, 0, 90),
        near(hangar.build("HANGAR2", pieces=8, points=25), -3, -42, 90),
        near(hangar.build("HANGAR3", pieces=1, points=13), -3, -140, 90, on_grass),
        near(building.bunker("BUNKER1"), -6, 46, 90),
        near(building.bunker("BUNKER2", 0.8), -6, 78, 90),
        near(building.bunker("BUNKER3", pieces=8, points=13), -8, 150, 90, on_grass),
        near(building.bunker("BUNKER4", pieces=8, points=13), -8, 200, 90, on_grass),
        near(building.tower("TOWER"), -68, -6, 90, on_grass),
        near(building.operations("OPERATIONS"), -74, -38, 90, on_grass),
        near(building.shed("SHED1"), -58, 28, 90, on_grass),
        near(building.shed("SHED2", 7, 2.6), -60, 14, 90, on_grass),
    ]


def fighters():
    return [
        near(foxbat.build("FOXBAT1", 2, running=True), 2.5, 0, 90),
        near(foxbat.build("FOXBAT2", 2), 36, 31, 78),
        near(foxbat.build("FOXBAT3", 1), 26, 62, 78),
        near(foxbat.build("FOXBAT4", 1), 26, -40, 62),
        near(foxbat.build("FOXBAT5", 0, armed=False), 100, 64, 180),
        near(foxbat.build("FOXBAT6", 0, armed=False), 165, 150, 0),
    ]


def traffic():
    return [
        near(helicopter.build("HELICOPTER"), 52, -20, 40),
        near(vehicle.truck("TRUCK1"), 20, 18, 150),
        near(vehicle.truck("TRUCK2", covered=False), 8, -21, 80),
        near(vehicle.truck("TRUCK3", 10), -50, -60, 0, -0.9),
        near(vehicle.truck("TRUCK4", 10), 70, 10, 300),
        near(vehicle.tanker("TANKER1"), 50, 43, 200),
        near(vehicle.tanker("TANKER2", 12), -48, 60, 180, -0.9),
        near(vehicle.car("CAR1"), -43, 19, 90, -0.88),
        near(vehicle.car("CAR2"), -43, 23, 90, -0.88),
        near(vehicle.car("CAR3", 14), -43, 30, 270, -0.88),
        near(vehicle.car("CAR4", 14), -48, -20, 180, -0.9),
        near(vehicle.car("CAR5"), 16, -14, 40),
        near(vehicle.tug("TUG"), 18.5, 4.5, 250),
        near(vehicle.generator_cart("GENERATOR"), 10, 9.5, 200),
        near(vehicle.weapon_trailer("TRAILER"), 40, 15, 60),
        near(vehicle.radar_van("RADAR"), 66, 44, 250),
        near(vehicle.drums("DRUMS"), -8, -23.5, 90),
    ]


def furniture():
    lights = building.floodlights(
        "FLOODLIGHTS", [(4, 21), (4, -21), (4, -63), (88, 70), (88, -10), (88, -80)]
    )
    return [
        near(building.crates("CRATES"), 0, 20.5, 90),
        near(lights, 0, 0, 90),
        near(building.fuel_tank("FUEL_TANK1"), -72, -72, 90, ground.GRASS_TOP),
        near(building.fuel_tank("FUEL_TANK2", sides=20), -72, -90, 90, ground.GRASS_TOP),
        near(building.windsock("WINDSOCK"), 135, -10, 290, ground.GRASS_TOP),
    ]


def assemble():
    """All objects in the order of the file; the fence takes the parts and facets that are left."""
    things = pavement() + structures() + fighters() + traffic() + furniture()
    things.insert(GRASS_PLACE - 1, ground.grass())
    contents = [part for thing in things for part in thing.parts.values()]
    facets = sum(len(gdb_file.part_facets(part)[1]) for part in contents)
    parts = len(contents)
    way = [
        (TARGET[0] + e, TARGET[1] + n)
        for e, n in ((-58, -165), (-110, -165), (-110, 240), (-58, 240))
    ]
    return things + [ground.fence(FACETS - facets, PARTS - parts, way)]


def main():
    if len(sys.argv) > 2:
        sys.exit("usage: make_geometry.py [OUTPUT.gdb]")
    path = pathlib.Path(sys.argv[1]) if len(sys.argv) == 2 else HERE / "airport.gdb"
    try:
        counts = gdb_file.write(path, assemble(), gdb_file.read_codes(CODES))
    except KeyError as name:
        sys.exit(f"make_geometry.py: {CODES}: no material {name}, expected all of surfaces.py")
    except (OSError, ValueError) as error:
        sys.exit(f"make_geometry.py: {error}")
    if counts != (OBJECTS, PARTS, FACETS):
        sys.exit(
            f"make_geometry.py: {counts} objects, parts, facets, expected {OBJECTS, PARTS, FACETS}"
        )
    print(f"{path.name}: {counts[0]} objects, {counts[1]} parts, {counts[2]} facets")


if __name__ == "__main__":
    main()
