#!/usr/bin/env python3
"""Launches: what the host and the tests need to launch a kernel, from the kernel's own signature.

    kernels/launches.py FOLDER    writes launches.h, launches.c and kernel_files.c into FOLDER, where
                                  they changed

kernels/.../NAME.cl holds the one kernel NAME. Its parameters are
    const TYPE name                        a scalar or record
    [OPTIONAL] global [const] TYPE *name   a buffer; the host may leave out an optional one
    TABLES(NAME_TABLES)                    a group: what its list in a kernels/ header holds
and the list of a group is
    #define NAME_TABLES(TABLE, AND) TABLE(TYPE, name) AND TABLE([OPTIONAL] global const TYPE *, name)
SHARED_BODY before a kernel: see with_shared_body.
"""
import pathlib
import re
import sys
from dataclasses import dataclass

KERNELS = pathlib.Path(__file__).resolve().parent
PARAMETERS = 10  # that anybody should have to write
HOST_TYPES = ("uint", "int", "float", "uchar")  # those that are no records

LIST = re.compile(r"#define (\w+_TABLES)\(TABLE, AND\)((?:.*\\\n)*.*)")
TABLE = re.compile(r"TABLE\(([^,()]+),\s*(\w+)\)")
KERNEL = re.compile(r"^(?:SHARED_BODY )?kernel\s+void\s+(\w+)\s*\(([^{]*)\)\s*\{", re.MULTILINE)
VALUE = re.compile(r"(?:const )?(\w+) (\w+)")
BUFFER = re.compile(r"(OPTIONAL )?global (const )?(\w+) ?\* ?(\w+)")
GROUP = re.compile(r"TABLES\((\w+_TABLES)\)")


class Mistake(Exception):
    """path:line: what was found, what was expected."""


@dataclass
class Argument:
    """One argument of OpenCL's kernel."""
    name: str
    type: str
    is_buffer: bool = False
    is_optional: bool = False
    is_input: bool = True


@dataclass
class Group:
    """Tables that kernels take together; `name` of the struct that holds them."""
    name: str
    arguments: list

    @property
    def member(self):
        return self.name.removesuffix("_tables")


@dataclass
class Kernel:
    """`parameters` as the signature has them: arguments and groups."""
    name: str
    parameters: list

    @property
    def arguments(self):
        """OpenCL's arguments in their order, each with the names that lead to it."""
        for p in self.parameters:
            for own in p.arguments if isinstance(p, Group) else [p]:
                yield own, [p.member, own.name] if isinstance(p, Group) else [p.name]


def without_comments(text):
    """The same lines without comments."""
    return re.sub(r"/\*.*?\*/", lambda m: "\n" * m[0].count("\n"), text, flags=re.DOTALL)


def read_argument(text):
    """An argument, or None."""
    buffer, value = BUFFER.fullmatch(text), VALUE.fullmatch(text)
    if buffer:
        return Argument(buffer[4], buffer[3], True, bool(buffer[1]), bool(buffer[2]))
    return Argument(value[2], value[1]) if value else None


def read_table(text, place):
    table = TABLE.fullmatch(text)
    argument = read_argument(f"{table[1]} {table[2]}") if table else None
    if argument is None:
        raise Mistake(f"{place}: found '{text}', expected `TABLE(TYPE, name)` or"
                      " `TABLE([OPTIONAL] global const TYPE *, name)`")
    return argument


def read_groups(folder):
    """Group by the name of its list."""
    groups = {}
    for path in sorted(folder.rglob("*.h")):
        text = without_comments(path.read_text())
        for found in LIST.finditer(text):
            place = f"{path}:{text.count(chr(10), 0, found.start()) + 1}"
            tables = [" ".join(t.split()) for t in found[2].replace("\\\n", " ").split(" AND ")]
            groups[found[1]] = Group(found[1].lower(), [read_table(t, place) for t in tables])
    return groups


def read_parameter(text, groups, place):
    group = GROUP.fullmatch(text)
    if group and group[1] in groups:
        return groups[group[1]]
    argument = read_argument(text)
    if argument is None:
        raise Mistake(f"{place}: found '{text}', expected `const TYPE name`, `[OPTIONAL] global"
                      " [const] TYPE *name` or TABLES of a list in a header")
    return argument


def read_kernel(path, groups):
    text = without_comments(path.read_text())
    found = list(KERNEL.finditer(text))
    if [f[1] for f in found] != [path.stem]:
        names = ", ".join(f[1] for f in found) or "none"
        raise Mistake(f"{path}:1: found the kernels {names}, expected the one kernel {path.stem}")
    signature = found[0]
    place = f"{path}:{text.count(chr(10), 0, signature.start()) + 1}"
    parameters = [" ".join(p.split()) for p in signature[2].split(",")]
    if len(parameters) > PARAMETERS:
        raise Mistake(f"{place}: found {len(parameters)} parameters, expected {PARAMETERS} or fewer:"
                      " tables that belong together make a group")
    return Kernel(path.stem, [read_parameter(p, groups, place) for p in parameters])


def read(folder=KERNELS):
    """The kernels of a folder, in the order of their names."""
    groups = read_groups(folder)
    return [read_kernel(p, groups) for p in sorted(folder.rglob("*.cl"), key=lambda p: p.stem)]


def headers_of(types, folder):
    """The headers that define records."""
    texts = {p: p.read_text() for p in sorted(folder.rglob("*.h"))}
    found = [p for p, text in texts.items() if any(f"typedef struct {t} {{" in text for t in types)]
    return [f"{folder.name}/{p.relative_to(folder)}" for p in found]


def member(argument):
    return f"    {argument.type}{'_buffer' * argument.is_buffer} {argument.name};\n"


def header(kernels, folder):
    arguments = [a for k in kernels for a, _ in k.arguments]
    values = {a.type for a in arguments if not a.is_buffer}
    elements = sorted({a.type for a in arguments if a.is_buffer})
    groups = {p.name: p for k in kernels for p in k.parameters if isinstance(p, Group)}
    out = ["/* Made by kernels/launches.py from the kernels' signatures. */\n#ifndef LAUNCHES_H\n"
           '#define LAUNCHES_H\n\n#include "device/device.h"\n']
    out += [f'#include "{h}"\n' for h in headers_of(values, folder)]
    out += [f"\ntypedef struct {t} {t};" for t in elements if t not in HOST_TYPES]
    out += ["\n", *(f"\nDEVICE_BUFFER({t});" for t in elements)]
    for name, group in sorted(groups.items()):
        members = "".join(member(a) for a in group.arguments)
        out += [f"\n\ntypedef struct {name} {{\n{members}}} {name};"]
    out += ["\n\nenum {\n", *(f"    KERNEL_{k.name.upper()},\n" for k in kernels),
            "    KERNEL_COUNT\n};\n"]
    for k in kernels:
        members = "".join(f"    {p.name} {p.member};\n" if isinstance(p, Group) else member(p)
                          for p in k.parameters)
        out += [f"\ntypedef struct {k.name}_args {{\n{members}}} {k.name}_args;\n\n"
                f"static inline status {k.name}_run(device *dev, device_shape shape, "
                f"const {k.name}_args *args)\n{{\n"
                f"    return device_launch(dev, KERNEL_{k.name.upper()}, shape, args);\n}}\n"]
    return "".join([*out, "\n#endif\n"])


def description(kernel):
    out = [f"static const device_argument {kernel.name}_arguments[] = {{\n"]
    for a, names in kernel.arguments:
        name = ".".join(names)
        kind = "VALUE" if not a.is_buffer else "BUFFER_OPTIONAL" if a.is_optional else "BUFFER_NEEDED"
        out += [f'    {{"{name}", offsetof({kernel.name}_args, {name}), '
                f"sizeof(((const {kernel.name}_args *)0)->{name}), DEVICE_{kind}}},\n"]
    return "".join([*out, "};\n\n"])


def source(kernels):
    out = ["/* Made by kernels/launches.py from the kernels' signatures. */\n"
           '#include "launches.h"\n\n']
    out += [description(k) for k in kernels]
    out += ["const device_kernel device_kernels[] = {\n"]
    for k in kernels:
        count = f"sizeof {k.name}_arguments / sizeof *{k.name}_arguments"
        out += [f'    {{"{k.name}", {k.name}_arguments, {count}}},\n']
    return "".join([*out, "};\n"])


def with_shared_body(kernel, text):
    """The text of a kernel on CPUs. PoCL makes three functions of a kernel, each with all of its code, so
    that compiling takes three times as long: a SHARED_BODY becomes a function that they call. Its lines
    stay where they are."""
    signature = KERNEL.search(text)
    if not signature or not signature[0].startswith("SHARED_BODY"):
        return text
    body = text[signature.end() - 1:].replace("get_global_id(", "BODY_ID(")
    names = ", ".join(a.name for a, _ in kernel.arguments)
    return (f"{text[:signature.start()]}BODY({kernel.name})({signature[2]} BODY_ITEM)\n{body}\n"
            f"#if BODY_IS_SHARED\nkernel void {kernel.name}({signature[2]})\n{{\n"
            f"    {kernel.name}_shared_body({names}, get_global_id(0), get_global_id(1));\n}}\n#endif\n")


def kernel_files(kernels, folder):
    """The text of every kernel file as a C string."""
    named = {k.name: k for k in kernels}
    out = ['#include "device/kernel_source.h"\n\nconst kernel_file kernel_files[] = {\n']
    for path in sorted([*folder.rglob("*.h"), *folder.rglob("*.cl")]):
        text = path.read_text()
        if path.suffix == ".cl":
            text = with_shared_body(named[path.stem], text)
        lines = text.replace("\\", "\\\\").replace('"', '\\"').splitlines()
        name = path.relative_to(folder.parent)
        out += [f'{{"{name}",\n', *(f'"{line}\\n"\n' for line in lines), "},\n"]
    return "".join([*out, "{0, 0}};\n"])


def write(path, text):
    """Writes a file unless it holds the text, so that nothing is built again for it."""
    if not path.is_file() or path.read_text() != text:
        path.write_text(text)


def main(folder):
    try:
        kernels = read()
    except Mistake as mistake:
        sys.exit(str(mistake))
    folder.mkdir(parents=True, exist_ok=True)
    write(folder / "launches.h", header(kernels, KERNELS))
    write(folder / "launches.c", source(kernels))
    write(folder / "kernel_files.c", kernel_files(kernels, KERNELS))


if __name__ == "__main__":
    main(pathlib.Path(sys.argv[1]))
