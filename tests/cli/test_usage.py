"""The command line as a whole: help, version, wrong usage. DESIGN.md: exit 2 is wrong usage."""
import re

import pytest

COMMANDS = ["render", "check", "trace", "shape-factor", "thermal", "sun", "view", "devices",
            "weather", "validate"]


@pytest.mark.parametrize("command", COMMANDS)
def test_help_of_a_command_goes_to_stdout(program, command):
    done = program.run(command, "--help")

    assert done.returncode == 0 and done.stderr == ""
    assert done.stdout.startswith(f"usage: radsig {command}")


@pytest.mark.parametrize("command", COMMANDS)
def test_every_way_to_ask_for_help_gives_the_same(program, command):
    asked = program.run(command, "--help").stdout

    assert program.run("help", command).stdout == asked
    assert program.run(command, "-h").stdout == asked
    assert re.search(r"^  -h, --help", asked, re.M)
    assert max(map(len, asked.splitlines())) <= 100


@pytest.mark.parametrize("asking", ["--help", "-h", "help"])
def test_help_lists_every_command(program, asking):
    done = program.run(asking)

    assert done.returncode == 0 and done.stderr == ""
    for command in COMMANDS:
        assert re.search(rf"^  {command} ", done.stdout, re.M)


def test_the_version_is_the_makefile_s(program):
    makefile = (program.root / "Makefile").read_text()
    version = re.search(r"^VERSION := (.*)$", makefile, re.M).group(1)

    done = program.run("--version")

    assert done.returncode == 0 and done.stdout == f"radsig {version}\n"


@pytest.mark.parametrize("option", ["--version", "--help", "-h"])
def test_help_and_version_of_the_program_stand_alone(program, option):
    done = program.run(option, "extra")

    assert done.returncode == 2 and done.stdout == ""
    assert f"{option} stands alone, found 'extra'" in done.stderr


@pytest.mark.parametrize("arguments", [[], ["no-such-command"], ["--no-such-option"], ["-x"], [""]])
def test_wrong_usage_of_the_program_ends_with_2(program, arguments):
    done = program.run(*arguments)

    assert done.returncode == 2 and done.stdout == "" and "radsig" in done.stderr


@pytest.mark.parametrize("command", [each for each in COMMANDS if each != "view"])
def test_an_unknown_option_ends_with_2_and_names_it(program, command):
    done = program.run(command, "--no-such-option")

    assert done.returncode == 2 and done.stdout == ""
    assert "--no-such-option" in done.stderr


@pytest.mark.parametrize("arguments, hint", [
    (["rendr"], "radsig: unknown command 'rendr' (did you mean 'render'?)"),
    (["chekc", "a.toml"], "radsig: unknown command 'chekc' (did you mean 'check'?)"),
    (["help", "thermla"], "radsig: unknown command 'thermla' (did you mean 'thermal'?)"),
    (["render", "--sise", "3x3"], "radsig render: unknown option '--sise' (did you mean '--size'?)"),
    (["render", "--sise=3x3"], "radsig render: unknown option '--sise' (did you mean '--size'?)"),
    (["thermal", "--mat", "a"], "unknown option '--mat' (did you mean '--materials'?)"),
    (["view", "--ofscreen", "a.png"], "unknown option '--ofscreen' (did you mean '--offscreen'?)"),
])
def test_a_misspelt_name_is_told_the_nearest(program, arguments, hint):
    done = program.run(*arguments)

    assert done.returncode == 2 and done.stdout == "" and hint in done.stderr


@pytest.mark.parametrize("arguments", [["no-such-command"], ["render", "--quiet"], ["render", "-x"]])
def test_a_name_that_is_far_from_all_is_told_none(program, arguments):
    done = program.run(*arguments)

    assert done.returncode == 2 and "unknown" in done.stderr and "mean" not in done.stderr


@pytest.mark.parametrize("change, hint", [
    (("focal_length_mm", "focal_lenght_mm"),
     "camera.focal_lenght_mm: unknown key (did you mean 'focal_length_mm'?)"),
    (("[camera]", "[camra]"), "camra: unknown key (did you mean 'camera'?)"),
    (('name = "wall"', 'name = "wal"'), "material \"wall\" is neither in the library nor a "
     "[[material]] (did you mean 'wal'?)"),
])
def test_a_misspelt_name_of_the_scene_is_told_the_nearest(program, tmp_path, change, hint):
    scene = program.write_scene(tmp_path)
    text = scene.read_text()
    assert change[0] in text
    scene.write_text(text.replace(*change, 1))

    assert hint in program.run("check", scene).stderr


@pytest.mark.parametrize("command", ["render", "check", "view"])
def test_a_command_without_its_scene_ends_with_2(program, command):
    assert program.run(command).returncode == 2


@pytest.mark.parametrize("arguments, words", [
    (["scene.toml"], "-o DIR"),
    (["-o", "out"], "needs SCENE"),
    (["a.toml", "b.toml", "-o", "out"], "found 'b.toml', expected one SCENE"),
    (["scene.toml", "-o"], "-o needs a value"),
    (["scene.toml", "-o", ""], "''"),
    (["scene.toml", "-o", "out", "--size", "32"], "'32'"),
    (["scene.toml", "-o", "out", "--size", "65536x65537"], "'65536x65537'"),
    (["scene.toml", "-o", "out", "--size", "32x32x32"], "'32x32x32'"),
    (["scene.toml", "-o", "out", "--size", "-3x32"], "'-3x32'"),
    (["scene.toml", "-o", "out", "--size=3*2"], "--size: found '3*2', expected COLUMNSxROWS"),
    (["scene.toml", "-o", "out", "--size", "4294967328x24"], "at most 2147483647 pixels"),
    (["scene.toml", "-o", "out", "--size", "65536x65536"], "at most 2147483647 pixels"),
    (["scene.toml", "-o", "out", "--exr=yes"], "--exr takes no value, found 'yes'"),
    (["scene.toml", "-o", "out", "--device", "0,1,0"], "expected each device once"),
    (["scene.toml", "-o", "out", "--device", "4294967296"], "'4294967296'"),
    (["scene.toml", "-o", "out", "--set", "camera.twist_deg"], "'camera.twist_deg'"),
    (["scene.toml", "-o", "out", "--device", "x"], "'x'"),
    (["scene.toml", "-o", "out", "--device", "-1"], "'-1'"),
    (["scene.toml", "-o", "out", "--device", "0.5"], "'0.5'"),
    (["scene.toml", "-o", "out", "--bands", ""], "''"),
    (["scene.toml", "-o", "a", "-o", "b"], "--output is given twice"),
    (["scene.toml", "-o", "out", "--size", "3x3", "--size", "4x4"], "--size is given twice"),
])
def test_wrong_usage_of_render_ends_with_2_and_says_what(program, tmp_path, arguments, words):
    program.write_scene(tmp_path)

    done = program.run("render", *arguments, cwd=tmp_path)

    assert done.returncode == 2 and done.stdout == ""
    assert words in done.stderr and "radsig render --help" in done.stderr
    assert sorted(each.name for each in tmp_path.iterdir()) == ["plane.obj", "scene.toml"]


@pytest.mark.parametrize("arguments", [["a.toml", "b.toml"], ["a.toml", "--set"],
                                       ["a.toml", "--set", "x"], ["a.toml", "-o", "out"]])
def test_wrong_usage_of_check_ends_with_2(program, arguments):
    done = program.run("check", *arguments)

    assert done.returncode == 2 and done.stdout == "" and "radsig check --help" in done.stderr


@pytest.mark.parametrize("option, value, words", [
    ("--mode", "fast", '"exact" or "thesis"'), ("--time", "1992-06-21T13:20:00", "with offset"),
    ("--size", "0x32", "from 1 to"), ("--bands", "mwir", "no band 'mwir'"),
    ("--planes", "depth", "no plane 'depth'"), ("--set", "camera.lens=3", "unknown key"),
])
def test_a_value_that_the_scene_refuses_ends_with_1_and_leaves_nothing(program, tmp_path, option,
                                                                        value, words):
    scene = program.write_scene(tmp_path)

    done = program.run("render", scene, "-o", tmp_path / "out", option, value)

    assert done.returncode == 1 and words in done.stderr
    assert not (tmp_path / "out").exists()
