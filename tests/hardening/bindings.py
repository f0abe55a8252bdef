"""The structures of coracle.h have the same members, in the same order, in Fortran and in Python.  Usage: bindings.py ROOT

A structure that lacks the last member hands C what lies behind it for a pointer."""
import re
import sys


def text(path):
    with open(sys.argv[1] + "/common/link/" + path, encoding="utf-8") as file:
        return file.read()


def names(declarations):
    """Of members: without types, shapes and initial values."""
    return [re.match(r"[\s*]*(\w+)", part).group(1) for part in re.sub(r"\([^)]*\)|\[[^\]]*\]", "", declarations).split(",")]


def of_c(header, name):
    body = re.search(r"typedef struct \{([^}]*)\} %s;" % name, re.sub(r"/\*.*?\*/", "", header, flags=re.S)).group(1)
    members = []
    for statement in filter(str.strip, body.split(";")):
        members += names(re.match(r"\s*(?:const )?(?:int|double)\s*(.*)", statement, flags=re.S).group(1))
    return members


def of_fortran(module, name):
    body = re.search(r"type, bind\(c\) :: %s\n(.*?)end type" % name, module, flags=re.S).group(1)
    return [member for line in body.splitlines() if "::" in line for member in names(line.split("!")[0].split("::")[1])]


def of_python(module, name):
    body = re.search(r"^(?:class )?%s\b.*?(?=^\S*\s*=|^\w|\Z)" % name, module, flags=re.S | re.M).group(0)
    return re.findall(r'"(\w+)"', body)


HEADER, FORTRAN, PYTHON = text("coracle.h"), text("fortran/coracle.f90"), text("python/coracle/library.py")
failed = False
for structure, python in ("CoracleElements", "Elements"), ("CoracleFlow", "Flow"), ("CoracleCoupling", "COUPLING"), ("CoracleCorrection", "CORRECTION"), ("CoracleGauge", "GAUGE"):
    expected = of_c(HEADER, structure)
    for language, found in ("Fortran", of_fortran(FORTRAN, structure)), ("Python", of_python(PYTHON, python)):
        if found != expected:
            print("%s has in %s %s, in C %s" % (structure, language, ", ".join(found), ", ".join(expected)))
            failed = True
sys.exit(failed)
