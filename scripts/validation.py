"""What the cases' validate.py share: to run a case file again and again with other keys, and to print and check what came of it.

A validate.py has its runs (name, keys, ranks), its tables and its claims; main() makes the command line of them:

    validate.py [--jobs N] [--only PATTERN ...] [--table] [--readme] [--check]

Needs nothing but Python.
"""
import argparse
import concurrent.futures
import fnmatch
import pathlib
import subprocess
import threading

ROOT = pathlib.Path(__file__).resolve().parent.parent
OUT = ROOT / "out" / "validation"
LOCKS = {}  # of the runs' folders
PROGRAMS = ("coracle-fluid", "coracle-coupler", "coracle-solid")


def launch(arguments, folder, keys):
    """Runs scripts/launch.sh with `arguments` and `keys` ("key=value") into `folder`, what it prints into log.txt there; whether it failed."""
    command = [ROOT / "scripts" / "launch.sh", *arguments]
    for key in ["output.folder=%s" % folder, *keys]:
        command += ["--set", key]
    folder.mkdir(parents=True, exist_ok=True)
    print("begun " + folder.name, flush=True)
    with open(folder / "log.txt", "a") as log:
        return subprocess.run(command, stdout=log, stderr=subprocess.STDOUT).returncode != 0


def launch_coupled(case, folder, keys, ranks, after=None):
    """Runs `case`/case.yaml on `ranks` ("F:C:S"): from the last checkpoint in `folder` if it was stopped, else from that in the folder
    `after` if one is given; whether it failed."""
    begins = after if after and not (folder / "checkpoint").exists() else None
    return launch(["--ranks", ranks, case / "case.yaml"], folder, ["resume=%s" % (begins / "checkpoint" if begins else "last"), *keys])


def run(case, folder, keys, ranks, after=None):
    """launch_coupled() of what has not come to its end before: its summary.json is not there.  Of several jobs that need it one runs it."""
    with LOCKS.setdefault(folder, threading.Lock()):
        if (folder / "summary.json").exists():
            return
        failed = launch_coupled(case, folder, keys, ranks, after)
    print("FAILED %s: see %s/log.txt" % (folder.name, folder) if failed else "done " + folder.name, flush=True)


def percent(measured, reference, digits=1):
    return "%+.*f %%" % (digits, 100.0 * (measured / reference - 1.0))


def cost(there, name, of):
    """Processor time of a run over that of run `of`, "" where one has none; both of one machine, or it says little."""
    return "%.2g" % (there[name].cpu / there[of].cpu) if of in there and there[name].cpu else ""


def build():
    """Installs what is missing and builds the programs; stops where that fails."""
    subprocess.run([ROOT / "scripts" / "setup.sh"], check=True)
    for arguments in (["--preset", "release"], ["--build", "--preset", "release", "--target", *PROGRAMS]):
        subprocess.run(["cmake", *arguments], check=True, cwd=ROOT, stdout=subprocess.DEVNULL)


def merge_tables(old, new):
    """The lines of a Markdown table (header, rule, rows) with those rows of the old one whose first cell the new one has not, in the
    order of the old one; the new one where the headers differ."""
    if old[:1] != new[:1]:
        return new
    rows = {line.split("|")[1]: line for line in old[2:]}
    rows.update((line.split("|")[1], line) for line in new[2:])
    return new[:2] + list(rows.values())


def put_into_readme(path, mark, lines):
    """Puts a table between <!-- mark --> and <!-- end of mark -->; rows of runs that are not there now stay as they are."""
    begin, end = "<!-- %s -->\n" % mark, "<!-- end of %s -->\n" % mark
    head, rest = path.read_text().split(begin)
    table, tail = rest.split(end)
    path.write_text(head + begin + "\n".join(merge_tables(table.splitlines(), lines)) + "\n" + end + tail)


def check(claims):
    """Prints the claims (statement, measured, bound); whether none is above its bound."""
    good = True
    for what, measured, bound in claims:
        holds = bool(measured <= bound)  # not so for nan
        good &= holds
        print("%-60s %8.2g  bound %.2g%s" % (what, measured, bound, "" if holds else "  FAILED"))
    return good


def main(doc, case, names, run, results, tables, claims):
    """The command line of a validate.py.

    doc      its docstring, for --help
    case     its folder, where README.md is
    names    of all runs; --only takes them in the order of its patterns
    run      run(name) runs one, unless it has been run; --jobs of them at a time
    results  results(names) is {name: result} of those that have been run
    tables   {mark: table}: table(results) yields lines of Markdown, and the README has the mark
    claims   claims(results) yields (statement, measured, bound)
    """
    parser = argparse.ArgumentParser(description=doc, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--jobs", type=int, default=1, help="runs at a time")
    parser.add_argument("--only", nargs="*", default=["*"], metavar="PATTERN")
    parser.add_argument("--table", action="store_true")
    parser.add_argument("--readme", action="store_true")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    if not arguments.table:
        build()
        chosen = dict.fromkeys(name for pattern in arguments.only for name in names if fnmatch.fnmatch(name, pattern))
        with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
            list(pool.map(run, chosen))
    there = results(names)
    for mark, table in tables.items():
        lines = list(table(there))
        print("\n".join(lines) + "\n")
        if arguments.readme:
            put_into_readme(case / "README.md", mark, lines)
    if arguments.check and not check(claims(there)):
        raise SystemExit(1)
