"""How the programs are linked: against what an input could do if a reader had a flaw."""
import subprocess

import pytest

FILES = ["radsig", "radsig-view", "plugins/image.so"]


@pytest.fixture
def look(program):
    """Runs readelf (binutils) over a built file."""
    folder = program.path.parent
    if "san-" in folder.name:
        pytest.skip("sanitizers replace the checks of the compiler")

    def run(option, name):
        return subprocess.run(["readelf", "-W", option, folder / name], capture_output=True, text=True,
                              check=True).stdout

    return run


@pytest.mark.parametrize("name", FILES)
def test_tables_of_addresses_are_filled_at_the_start_and_read_only_then(look, name):
    assert "GNU_RELRO" in look("-l", name)
    assert "BIND_NOW" in look("-d", name)


@pytest.mark.parametrize("name", FILES)
def test_code_may_lie_anywhere(look, name):
    assert "Type:                              DYN" in look("-h", name)


@pytest.mark.parametrize("name", ["radsig", "radsig-view"])
def test_stacks_and_copies_are_checked(look, name):
    symbols = look("--dyn-syms", name)

    assert "__stack_chk_fail" in symbols
    assert "__snprintf_chk" in symbols  # _FORTIFY_SOURCE
