"""Modules that tests of several folders share lie here and in kernels/ and cli/."""
import pathlib
import sys

HERE = pathlib.Path(__file__).resolve().parent
sys.path += [str(HERE), str(HERE / "kernels"), str(HERE / "cli")]
