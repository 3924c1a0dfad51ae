"""The types of the module say what the module has: every class, property and argument, and none more.

  stubs.py STUBS     the .pyi file; the module is the one that Python finds
"""
import ast
import re
import sys

import numpy
import orthonav



def arguments(function):
    """Names and whether they have a default, of a function of the stubs; without `self`."""
    names = [a.arg for a in function.args.args]
    first = len(names) - len(function.args.defaults)
    return [(name, i >= first) for i, name in enumerate(names) if name != "self"]


def arguments_of_doc(doc):
    """The same, from the first line that pybind11 writes: f(a: int, b: float = 1.0) -> T."""
    text = re.match(r"\w+\((.*)\) -> ", doc.strip(), re.S).group(1)
    while re.search(r"\[[^][]*\]", text):
        text = re.sub(r"\[[^][]*\]", "", text)
    parts = [part.strip() for part in text.split(",") if part.strip()]
    return [(p.split(":")[0].strip(), "=" in p) for p in parts if not p.startswith(("self", "arg0"))]


def members(node):
    properties, functions = {}, {}
    for item in node.body:
        if isinstance(item, ast.FunctionDef):
            kind = properties if any(getattr(d, "id", "") == "property" for d in item.decorator_list) else functions
            kind[item.name] = item
    return properties, functions


def same_plain_type(stub, doc):
    """Where pybind11 names a plain type, the stub names the same one."""
    said = re.search(r"-> (.*)", doc).group(1).replace("orthonav.", "").strip()
    if re.search(r"object|numpy|tuple", said):
        return True
    return ast.unparse(stub.returns) == said


def check_class(name, node, problems):
    real = getattr(orthonav, name)
    properties, functions = members(node)
    have = {k: v for k, v in vars(real).items() if isinstance(v, property)}
    if properties.keys() != have.keys():
        problems.append(f"{name}: properties {sorted(properties.keys() ^ have.keys())}")
    for key in properties.keys() & have.keys():
        if not same_plain_type(properties[key], have[key].fget.__doc__):
            problems.append(f"{name}.{key}: {ast.unparse(properties[key].returns)}, {have[key].fget.__doc__.strip()}")
    if "__repr__" not in vars(real):
        problems.append(f"{name}: is shown by its address alone")
    made = {k for k, v in vars(real).items()
            if (not k.startswith("_") or k in ("__iter__", "__next__")) and not isinstance(v, property)}
    if re.match(r"__init__\(", (real.__init__.__doc__ or "").strip()):
        made.add("__init__")
    if functions.keys() != made:
        problems.append(f"{name}: functions {sorted(functions.keys() ^ made)}")
    for key in functions.keys() & made - {"__iter__", "__next__"}:
        said, has = arguments(functions[key]), arguments_of_doc(getattr(real, key).__doc__)
        if said != has:
            problems.append(f"{name}.{key}: {said}, {has}")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        tree = ast.parse(file.read())
    problems, named = [], {"__version__"}
    for node in tree.body:
        if isinstance(node, ast.ClassDef):
            named.add(node.name)
            if node.name != "Error" and hasattr(orthonav, node.name):
                check_class(node.name, node, problems)
        elif isinstance(node, ast.FunctionDef):
            named.add(node.name)
            said, has = arguments(node), arguments_of_doc(getattr(orthonav, node.name).__doc__)
            if said != has:
                problems.append(f"{node.name}: {said}, {has}")
    missing = {n for n in dir(orthonav) if not n.startswith("__")} | {"__version__"}
    if named != missing:
        problems.append(f"names: {sorted(named ^ missing)}")
    if not issubclass(orthonav.Error, ValueError):
        problems.append("Error is no ValueError")
    # What arrays hold, which pybind11 does not say.
    level = orthonav.phantom(["L5"])[0]
    if level.vertices.dtype != numpy.float64 or level.triangles.dtype != numpy.uint32:
        problems.append(f"arrays: {level.vertices.dtype}, {level.triangles.dtype}")
    for thing, shown in ((level.screws[0], "<Screw left, 6.0 x 45.0 mm>"), (level, "<Level L5: "),
                         (orthonav.built_in_tools()[0], "<Tool pointer: pointer, tag tag36h11 3, 70.0 mm>"),
                         (orthonav.VertebraModel(level.vertices, level.triangles), "<VertebraModel: ")):
        if not repr(thing).startswith(shown):
            problems.append(f"{thing!r}: does not begin with {shown}")
    for problem in problems:
        print(problem, file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
