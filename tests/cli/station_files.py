"""Weather files of stations, with values that are known, and the history that the program makes of them."""
import datetime

import numpy as np

PLACE = {"latitude_deg": 43.083, "longitude_deg": -77.667}
SITE = {**PLACE, "time": "1992-06-23T15:00:00-04:00"}
MATTER = {"name": "wall", "emissivity": 0.93, "density_kg_m3": 2114.0,
          "specific_heat_j_kg_k": 920.0, "conductivity_w_m_k": 0.689, "thickness_cm": 5.0,
          "exposed_area": -0.5}
LANGLEY_PER_HOUR_W_M2 = 41840 / 3600
TIME, AIR, PRESSURE, HUMIDITY, DEW, WIND, DIRECT, DIFFUSE, EXPOSURE, CLOUD, _, RAIN, _ = range(13)


def check(program, folder, name, **site):
    path = program.write_scene(folder, site={**SITE, **site}, weather={"history": name},
                               material=[MATTER], render={"thermal": "therm"})
    return program.run("weather", path, "-o", folder / "made.wth")


def history(program, folder, name, **site):
    done = check(program, folder, name, **site)
    assert done.returncode == 0, done.stderr
    return np.loadtxt(folder / "made.wth", skiprows=1), done.stderr


# EPW: hours 1..24 of local standard time, 5 h behind UTC; the scene's clock is 4 h behind.
def epw_row(date, hour, minute=60, **change):
    value = {"year": date.year, "air": 10 + hour / 2, "dew": 5.0, "pressure": 100000, "infrared": 330,
             "direct": 500 if 7 <= hour <= 18 else 0, "diffuse": 90 if 7 <= hour <= 18 else 0,
             "wind": 3.0, "cover": 2, "rain": 0.0, "rh": 999, "global": 9999, **change}
    field = ["0"] * 35
    field[:6] = [str(value["year"]), str(date.month), str(date.day), str(hour), str(minute), "?9?9?9E0"]
    for place, name in ((6, "air"), (7, "dew"), (8, "rh"), (9, "pressure"), (12, "infrared"),
                        (13, "global"), (14, "direct"), (15, "diffuse"), (21, "wind"), (23, "cover"),
                        (33, "rain")):
        field[place] = str(value[name])
    return ",".join(field)


def epw_text(first=(1992, 6, 21), days=4, change=None, place=(43.1, -77.7), minutes=(60,), an_hour=None):
    """`change`: values by (day of the month, hour) or, of several records an hour, (day, hour, minute)."""
    rows = []
    for i in range(days):
        date = datetime.date(*first) + datetime.timedelta(i)
        rows += [epw_row(date, hour, minute, **(change or {}).get((date.day, hour), (change or {}).get((date.day, hour, minute), {})))
                 for hour in range(1, 25) for minute in minutes]
    return "\r\n".join([
        f"LOCATION,Rochester,NY,USA,hand,725290,{place[0]},{place[1]},-5.0,169.0",
        "DESIGN CONDITIONS,0", "TYPICAL/EXTREME PERIODS,0", "GROUND TEMPERATURES,0",
        "HOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0", "COMMENTS 1,by hand", "COMMENTS 2,",
        f"DATA PERIODS,1,{an_hour or len(minutes)},Data,Sunday, 6/21, 6/24", *rows]) + "\r\n"


# SURFRAD: samples of three minutes, UTC.
def surfrad_text(*days, value=None, longitude="77.67", step_min=3):
    """`value(time)`: a dict of what differs."""
    text = ""
    for day in days:
        text += f" Rochester\n  43.08  {longitude}  169 m version 1\n"
        time = datetime.datetime(1992, 6, day)
        for i in range(1440 // step_min):
            now = time + datetime.timedelta(minutes=i * step_min)
            v = {"direct": 800.0, "diffuse": 100.0, "infrared": 330.0, "air": 20.0, "rh": 50.0,
                 "wind": 3.0, "pressure": 995.0, **(value(now) if value else {})}
            pairs = [0.0, 0.0, v["direct"], v["diffuse"], v["infrared"], 0, 0, v.get("up", 400.0), 0, 0, 0, 0, 0,
                     0, 0, v["air"], v["rh"], v["wind"], 180.0, v["pressure"]]
            hours = now.hour + now.minute / 60
            text += (f" 1992 {now.timetuple().tm_yday} {now.month} {now.day} {now.hour} {now.minute}"
                     f" {hours:.3f} 45.0 " + " ".join(
                         f"{p} {v.get('flag', 0) if k == 17 else 0}" for k, p in enumerate(pairs))
                     + "\n")
    return text


def height(utc, place=(43.1, -77.7)):
    """Sine of the sun's height: Cooper's declination, no equation of time."""
    day = utc.timetuple().tm_yday
    declination = np.radians(23.45) * np.sin(np.radians(360 / 365 * (284 + day)))
    hour = np.radians(15 * (utc.hour + utc.minute / 60 + place[1] / 15 - 12))
    latitude = np.radians(place[0])
    return np.sin(latitude) * np.sin(declination) + np.cos(latitude) * np.cos(declination) * np.cos(hour)


def light(utc, place=(43.1, -77.7)):
    up = height(utc, place)
    return {"direct": round(900 * up**0.3) if up > 0 else 0, "diffuse": round(100 * up**0.5) if up > 0 else 0}
