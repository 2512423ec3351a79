"""Modules that tests of several folders share lie here and in kernels/ and cli/; what `make test` says at its
end."""
import os
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE / "kernels"), str(HERE / "cli")]


def pytest_terminal_summary(terminalreporter):
    """The tests in C that were skipped before, and why; pytest's own follow by -rs."""
    file = os.environ.get("RADSIG_SKIPPED")
    if not file or not pathlib.Path(file).exists():
        return
    lines = pathlib.Path(file).read_text()
    if lines:
        terminalreporter.section("skipped tests in C")
        terminalreporter.write(lines)
