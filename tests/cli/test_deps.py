"""make deps with stand-ins for dpkg-query, apt-get, sudo and id: what it would install."""
import os
import re
import shutil
import subprocess
import types

import pytest

# `dpkg-query -W -f=... NAME` knows every package but those in the file `missing`.
DPKG_QUERY = """#!/bin/sh
for name; do :; done
if grep -qx "$name" "$STAND_IN/missing"; then
    echo "dpkg-query: no packages found matching $name" >&2; exit 1
fi
echo "install ok installed"
"""
APT_GET = """#!/bin/sh
echo "apt-get $*" >> "$STAND_IN/calls"
case "$1" in install) : > "$STAND_IN/missing";; esac
exit "$(cat "$STAND_IN/apt_exit")"
"""
SUDO = """#!/bin/sh
echo "sudo $*" >> "$STAND_IN/calls"
"""
ID = """#!/bin/sh
cat "$STAND_IN/uid"
"""


def packages(root):
    """The names that the Makefile lists in PACKAGES."""
    text = (root / "Makefile").read_text()
    text = re.search(r"^PACKAGES := ((?:.*\\\n)*.*)", text, re.M).group(1)
    return text.replace("\\\n", " ").split()


@pytest.fixture
def make_deps(program, tmp_path):
    """Runs make deps in a folder that holds the Makefile alone."""
    stand_in = tmp_path / "bin"
    stand_in.mkdir()
    for name, text in (("dpkg-query", DPKG_QUERY), ("apt-get", APT_GET), ("sudo", SUDO),
                       ("id", ID)):
        (stand_in / name).write_text(text)
        (stand_in / name).chmod(0o755)
    shutil.copy(program.root / "Makefile", tmp_path)

    def run(missing=(), uid=0, apt_exit=0, target="deps"):
        (stand_in / "missing").write_text("".join(f"{name}\n" for name in missing))
        (stand_in / "uid").write_text(f"{uid}\n")
        (stand_in / "apt_exit").write_text(f"{apt_exit}\n")
        (stand_in / "calls").write_text("")
        environment = {k: v for k, v in os.environ.items() if not k.startswith("MAKE")}
        environment.update(PATH=f"{stand_in}:{os.environ['PATH']}", STAND_IN=str(stand_in))
        done = subprocess.run(["make", "-C", tmp_path, target], env=environment,
                              capture_output=True, text=True, timeout=60)
        return types.SimpleNamespace(code=done.returncode, text=done.stdout + done.stderr,
                                     calls=(stand_in / "calls").read_text().splitlines(),
                                     stamp=(tmp_path / "build" / "deps").exists())

    return run


def test_root_installs_exactly_what_is_missing_after_an_update(make_deps):
    done = make_deps(missing=["libopenmesh-dev", "python3-spectral"])

    assert done.code == 0 and done.stamp
    assert len(done.calls) == 2 and done.calls[0].startswith("apt-get update")
    words = done.calls[1].split()
    assert words[:2] == ["apt-get", "install"] and "--no-install-recommends" in words
    assert sorted(w for w in words[2:] if not w.startswith("-")) == ["libopenmesh-dev",
                                                                     "python3-spectral"]


def test_a_bare_system_gets_every_package(program, make_deps):
    done = make_deps(missing=packages(program.root))

    assert done.code == 0 and done.stamp
    installed = [w for w in done.calls[1].split()[2:] if not w.startswith("-")]
    assert sorted(installed) == sorted(packages(program.root))


def test_nothing_is_called_if_nothing_is_missing(make_deps):
    done = make_deps()

    assert done.code == 0 and done.stamp and done.calls == []


def test_without_root_the_exact_line_is_printed_and_nothing_is_called_not_even_sudo(make_deps):
    done = make_deps(missing=["libopenmesh-dev", "python3-spectral"], uid=1000)

    assert done.code != 0 and not done.stamp and done.calls == []
    line = ("apt-get update && apt-get install -y --no-install-recommends libopenmesh-dev "
            "python3-spectral")
    assert line in done.text or line.replace("libopenmesh-dev python3-spectral",
                                             "python3-spectral libopenmesh-dev") in done.text


def test_an_install_that_fails_leaves_no_stamp(make_deps):
    done = make_deps(missing=["libopenmesh-dev"], apt_exit=100)

    assert done.code != 0 and not done.stamp


def test_a_package_that_vanished_after_the_stamp_is_installed_again(make_deps):
    assert make_deps().stamp

    done = make_deps(missing=["python3-spectral"])

    assert done.code == 0 and any("install" in call for call in done.calls)


@pytest.mark.parametrize("target", ["demo", "test"])
def test_nothing_is_built_while_packages_are_missing(make_deps, target):
    done = make_deps(missing=["build-essential"], uid=1000, target=target)

    assert done.code != 0 and not done.stamp
    assert "apt-get install -y --no-install-recommends build-essential" in done.text


def test_help_lists_the_targets_without_any_package(program, make_deps):
    done = make_deps(missing=packages(program.root), uid=1000, target="help")

    assert done.code == 0
    for target in ("help", "deps", "all", "demo", "test", "lint", "bench", "renders", "clean"):
        assert re.search(rf"^{target}: \S", done.text, re.M)
