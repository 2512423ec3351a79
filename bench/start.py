"""How long commands take to start that write no picture, beside /bin/true in the same run.

make bench-start: medians of rounds in which each command runs once; exit code 1 where one of those
with a limit takes longer."""
import os
import statistics
import subprocess
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
ROUNDS = 31
LIMIT_MS = 20.0
SCENE = str(ROOT / "scenes" / "airport" / "scene.toml")
PROGRAMS = ROOT / "build"
SITE = ["--site", "43.1,-77.7", "--time", "1987-06-24T10:00:00-05:00"]

# What is run, and whether the limit is for it.
COMMANDS = [(["/bin/true"], False),
            ([f"{PROGRAMS}/radsig", "--help"], True),
            ([f"{PROGRAMS}/radsig", "--version"], True),
            ([f"{PROGRAMS}/radsig", "sun", *SITE], True),
            ([f"{PROGRAMS}/radsig", "render", "--help"], True),
            ([f"{PROGRAMS}/radsig-view", "--help"], False),
            ([f"{PROGRAMS}/radsig", "check", SCENE], False)]


def run(command):
    """Returns wall and CPU time in ms."""
    null = os.open(os.devnull, os.O_RDWR)
    start = time.perf_counter()
    process = os.posix_spawn(command[0], command, os.environ,
                             file_actions=[(os.POSIX_SPAWN_DUP2, null, 1)])
    _, state, used = os.wait4(process, 0)
    wall = time.perf_counter() - start
    os.close(null)
    if state:
        raise SystemExit(f"{' '.join(command)}: failed")
    return 1e3 * wall, 1e3 * (used.ru_utime + used.ru_stime)


def libraries(program):
    listed = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    return listed.count("\n")


def main():
    times = [[] for _ in COMMANDS]
    is_slow = False

    for _ in range(ROUNDS):
        for at, (command, _) in enumerate(COMMANDS):
            times[at].append(run(command))
    print(f"{'command':26}{'wall ms':>10}{'cpu ms':>10}{'libraries':>11}")
    for (command, is_limited), measured in zip(COMMANDS, times):
        wall, cpu = (statistics.median(column) for column in zip(*measured))
        name = " ".join([Path(command[0]).name, *command[1:2]])
        print(f"{name:26}{wall:10.1f}{cpu:10.1f}{libraries(command[0]):11}")
        is_slow |= is_limited and wall > LIMIT_MS
    if is_slow:
        raise SystemExit(f"a command takes longer than {LIMIT_MS} ms to start")


if __name__ == "__main__":
    main()
