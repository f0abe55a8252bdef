#!/usr/bin/env python3
"""Checks what a compiler does not: words, comments, includes.  Usage: style.py words|comments|includes [--fix] ROOT

words     identifiers, comments and READMEs use the field's words, one for one thing
comments  banners and drawings are whole: a formatter has not run their lines together
includes  an include names its room; rooms include each other without a circle, and as the picture in README.md says
"""
import collections
import os
import re
import subprocess
import sys

# A word of our own that once stood for what the field calls otherwise.  In identifiers of a room: patterns of a whole identifier.
IDENTIFIERS = {
    "common/link": {r"(Roll|ROLL)[A-Z_]\w*|roll_call": "handshake", r"Board\w*|board\w*": "failure board", r"Leaving\w*|leaving": "exit guard",
                    r"Machine\w*": "affinity", r"Side|Side[A-Z]\w*|Peer|peer": "clients", r"home": "owner rank", r"told": "registered"},
    "coupler": {r"[Tt]ries\w*|\w+_tries": "coupling iterations", r"most": "max_iterations", r"met": "iterate", r"\w*Agree": "HasConverged",
                r"\w*Aim|aim": "SetInterfaceVelocity", r"rate|has_rate": "acceleration", r"March": "time loop", r"[Gg]uard\w*": "divergence monitor",
                r"n?pieces?|\w*Pieces?\w*": "source triangle", r"nentries": "coupled element", r"near": "bounds", r"\w*[Ff]irm\w*|FIRMER": "implicit factor",
                r"gives?|giving": "implicit inertia, compliant", r"HoldFirmly|Resist|Meet|\w*BringHome|\w*[Ww]eigh": "see the glossary",
                r"\w*LeaveFluid": "NoCorrection", r"Motion|MotionOf": "bulk motion"},
    "fluid": {r"[Gg]iv(es|ing)\w*|give": "inertia-weighted projection", r"\w*u_plus|\w*VelocityPlus": "projected velocity", r"given": "exchanged",
              r"Needs|needs": "sizing", r"Past|past": "history", r"\w+Forget|Forget|Change": "accept, discard mesh", r"idle": "inactive"},
    "solid": {r"\w*[Ss]een\w*|\w*See": "interface motion", r"\w*[Aa]broad\w*|away": "remote, node directory", r"[Ss]hare|Share[A-Z]\w*": "subdomain",
              r"Deal\w*": "sparse exchange", r"Parcel|Cargo|parcel|cargo": "buffer", r"Former|former": "old partition", r"Look|look|looks": "ghost",
              r"Assembly\w*|assembly": "model", r"[Dd]rives?|Drive\w*|driven?|ndriven?": "prescribed motion", r"sheet\w*": "plane stress",
              r"across|ElementAcross": "thickness stretch", r"\w*Sound": "admissible", r"backing": "areal mass", r"softness": "compliance",
              r"[Rr]each|\w+Reach": "skin", r"[Tt]ouch\w*|\w+Touch": "active pair", r"\w*[Bb]rinks?\w*": "crack-tip node", r"[Tt]ies?|nties|\w*_ties?": "bond",
              r"[Ff]an": "corner set", r"\w*_WHOLE|whole|\w*_LIVE|n?live": "intact, active", r"pull|\w*Pull": "traction",
              r"\w*[Rr]ubb\w*": "friction", r"torn": "debonded", r"[Ww]atch": "initiation list", r"\w*[Ss]ettle": "synchronise"},
    "common/mesh": {r"n?pieces?|\w*Pieces?\w*": "part", r"n?rim|rims": "open faces", r"Met|Meet|met|meet|Mesh\w*Meet?t?": "rendezvous reply",
                    r"\w*[Tt]ravel\w*": "migrate", r"MOST_\w+": "MAX_"},
    "common/transfer": {r"\w*[Tt]ravel\w*": "migrate", r"MOST_\w+": "MAX_"},
    "common/output": {r"Kept|Written": "fields", r"Say": "log", r"MOST_\w+": "MAX_"},
    "fluid/adapt": {r"idle|\w+_IDLE": "inactive"},
}
EVERYWHERE = {r"CoracleStands": "CoracleStepAccepted", r"CoracleSaveFolder": "CoracleCheckpointPath", r"Record|Record[A-Z]\w*": "writer"}
# In prose, comments and keys of case files.
PROSE = {r"roll[ -]calls?": "handshake", r"steps? in hand": "current step", r"goes on from": "resumes", r"makes nothing of": "ignores",
         r"its own affair": "its responsibility", r"(comes?|came) to life": "activates", r"gives? way|giving way": "is compliant",
         r"abroad": "remote", r"brinks?": "crack-tip node", r"firmness": "implicit factor", r"bring(s)? home": "assemble to owners",
         r"parcels?|cargo": "buffer", r"tries:": "coupler.max_iterations"}
LEFT_OUT = ("CHANGELOG.md", "tests/style/style.py")


def files(*endings):
    names = subprocess.run(["git", "ls-files"], capture_output=True, text=True, check=True).stdout.split()
    return [n for n in names if n.endswith(endings) and n not in LEFT_OUT and os.path.exists(n)]


def read(name):
    with open(name, encoding="utf-8") as file:
        return file.read()


def blank(match):
    return re.sub(r"[^\n]", " ", match.group(0))


def code_of(text):
    """The C text with comments and strings blanked, line by line."""
    return re.sub(r'/\*.*?\*/|//[^\n]*|"(?:[^"\\\n]|\\.)*"', blank, text, flags=re.S)


def room_of(name):
    parts = name.split("/")
    if parts[0] == "tests" and len(parts) > 2:
        parts = {"link": ["common", "link"], "mesh": ["common", "mesh"], "transfer": ["common", "transfer"], "output": ["common", "output"],
                 "adapt": ["fluid", "adapt"]}.get(parts[1], [parts[1]]) + parts[2:]
    two = "/".join(parts[:2])
    return two if two in IDENTIFIERS or parts[0] == "common" else parts[0]


def line_of(text, position):
    return text.count("\n", 0, position) + 1


def words():
    problems = []
    for name in files(".c", ".h"):
        text = code_of(read(name))
        table = dict(EVERYWHERE, **IDENTIFIERS.get(room_of(name), {}))
        pattern = re.compile("|".join("(?:%s)" % p for p in table))
        for m in re.finditer(r"\b[A-Za-z_]\w*\b", text):
            if pattern.fullmatch(m.group(0)):
                instead = next(w for p, w in table.items() if re.fullmatch(p, m.group(0)))
                problems.append(f"{name}:{line_of(text, m.start())}: '{m.group(0)}': the field says {instead}")
    for name in files(".c", ".h", ".md", ".py", ".sh", ".yaml"):
        text = read(name)
        for pattern, instead in PROSE.items():
            for m in re.finditer(r"\b(?:%s)\b" % re.sub(" (?![^[]*\\])", lambda _: r"[\s*#]+", pattern), text, flags=re.I):
                problems.append(f"{name}:{line_of(text, m.start())}: '{' '.join(m.group(0).split())}': the field says {instead}")
    return problems


BANNER = re.compile(r"/\* -{2,} (?P<text>[^\n]*?)[ ]*\n[ *]*-{8,} ?\*/")
SHORT = re.compile(r"^/\* --- (?P<text>[^\n]*?) -+ \*/$", re.M)


def comments(fix):
    """A banner is one line; the lines of a drawing are not joined; clang-format is told to leave comments alone."""
    problems = []
    if "ReflowComments: false" not in read(".clang-format"):
        problems.append(".clang-format: without 'ReflowComments: false' drawings are run together")
    for name in files(".c", ".h"):
        text = read(name)
        for m in BANNER.finditer(text):
            problems.append(f"{name}:{line_of(text, m.start())}: the banner '{m.group('text')}' is split over two lines")
        if fix:
            whole = BANNER.sub(lambda m: "/* --- %s %s */" % (m.group("text").strip(), "-" * max(3, 100 - len(m.group("text").strip()))), text)
            if whole != text:
                with open(name, "w", encoding="utf-8") as file:
                    file.write(whole)
        for m in re.finditer(r"/\*.*?\*/", text, flags=re.S):
            for k, line in enumerate(m.group(0).split("\n")):
                if re.search(r"\S {3,}[|/\\] .* \* {2,}\S|\|.*\| +\* +\|", line):
                    problems.append(f"{name}:{line_of(text, m.start()) + k}: lines of a drawing have been joined: {line.strip()[:60]}")
    return problems


def picture(readme):
    """What README.md says each room stands on: lines 'room -> room, room' in its block headed 'Rooms and what they include'."""
    block = re.search(r"^Rooms and what they include.*?\n+```\n(.*?)```", read(readme), flags=re.S | re.M)
    allowed = {}
    for line in block.group(1).strip().split("\n") if block else []:
        room, _, on = line.partition("->")
        allowed[room.strip()] = {r.strip() for r in on.split(",") if r.strip()}
    return allowed


def library_of(name):
    """A room of the whole: common/link, fluid/adapt, coupler ...; of the programs' own folders only those that are libraries of their own."""
    parts = name.split("/")
    if parts[0] == "common" or os.path.exists(os.path.join(*parts[:2], "CMakeLists.txt") if len(parts) > 2 else ""):
        return "/".join(parts[:2])
    return parts[0]


def folder_of(name):
    """A room of a program: flow, momentum, ...; the program's name for what lies in none."""
    return name.split("/")[-2]


def circle(graph):
    """A circle of rooms, as a list, or None."""
    state, path = {}, []

    def visit(room):
        state[room] = 1
        path.append(room)
        for other in sorted(graph.get(room, ())):
            if state.get(other) == 1:
                return path[path.index(other):] + [other]
            if other not in state:
                found = visit(other)
                if found:
                    return found
        state[room] = 2
        path.pop()
        return None

    for room in sorted(graph):
        if room not in state:
            found = visit(room)
            if found:
                return found
    return None


def includes():
    problems, here, pairs = [], set(files(".h")), []
    for name in files(".c", ".h"):
        for k, line in enumerate(read(name).split("\n"), 1):
            m = re.match(r'#include "([^"]+)"', line)
            if m and m.group(1) not in here:
                problems.append(f"{name}:{k}: \"{m.group(1)}\" does not name its room from the repository's root")
            elif m and not name.startswith("tests/"):
                pairs.append((name, m.group(1)))
    for readme, room_of_file in (("README.md", library_of), ("fluid/README.md", folder_of), ("coupler/README.md", folder_of)):
        inside, graph = os.path.dirname(readme), collections.defaultdict(set)
        for name, other in pairs:
            if name.startswith(inside) and other.startswith(inside) and room_of_file(name) != room_of_file(other):
                graph[room_of_file(name)].add(room_of_file(other))
        found = circle(graph)
        if found:
            problems.append("rooms include each other in a circle: " + " -> ".join(found))
        allowed = picture(readme)
        if not allowed:
            problems.append(f"{readme} has no picture 'Rooms and what they include'")
        for room, on in sorted(graph.items()):
            if on != allowed.get(room, set()):
                problems.append(f"{room} includes {', '.join(sorted(on))}; {readme} says {', '.join(sorted(allowed.get(room, {'nothing'})))}")
    return problems


def main():
    what, root = sys.argv[1], sys.argv[-1]
    os.chdir(root)
    problems = {"words": words, "comments": lambda: comments("--fix" in sys.argv), "includes": includes}[what]()
    for problem in problems:
        print(problem)
    sys.exit(1 if problems else 0)


main()
