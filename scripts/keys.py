#!/usr/bin/env python3
"""The reference of the case file's keys, made by the programs from the calls that read them.

Usage: scripts/keys.py BUILD [--check]
Writes cases/KEYS.md (key, type, unit, range, default, meaning) and cases/case.schema.json (for editors: a first line
`# yaml-language-server: $schema=../case.schema.json`).  With --check compares them instead with what is there, and with the keys that the
sources name.
"""
import argparse
import json
import os
import re
import subprocess
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
PARTS = ("coupler", "fluid", "solid")
SAMPLES = ("tests/hardening/keys_box.yaml", "tests/hardening/keys_file.yaml", "tests/hardening/keys_phases.yaml")
DEPENDS = "depends on other keys"
SECTIONS = ("case", "note", "gravity", "time", "fluid", "solid", "coupler", "output", "resume")


def read_keys(build):
    """{key: {type: (range, default)}}, and beside it whether all samples require it, its unit, meaning and readers."""
    keys = {}
    for sample in SAMPLES:
        for part in PARTS:
            command = [os.path.join(build, part, "coracle-" + part), "--keys", os.path.join(ROOT, sample)]
            done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "OPENBLAS_NUM_THREADS": "1"})
            if done.returncode:
                sys.exit(f"{' '.join(command)}: {done.stdout}{done.stderr}")
            for line in done.stdout.splitlines():
                key, need, kind, extent, default, unit, meaning = line.split("\t")
                entry = keys.setdefault(key, {"types": {}, "unit": "", "meaning": "", "parts": set(), "samples": set(), "required": set()})
                before = entry["types"].get(kind, ("", ""))
                if kind == "integer" or before[1] == "":
                    entry["types"][kind] = (extent, default)
                elif default:  # what is not the same in all samples follows from other keys: its meaning says how
                    entry["types"][kind] = tuple(a if a == b else DEPENDS for a, b in zip(before, (extent, default)))
                entry["unit"] = unit or entry["unit"]
                entry["meaning"] = meaning or entry["meaning"]
                entry["parts"].add(part)
                entry["samples"].add(sample)
                if need == "required":
                    entry["required"].add(sample)
    for entry in keys.values():
        entry["types"] = {kind: tuple("" if part == DEPENDS else part for part in parts) for kind, parts in entry["types"].items()}
    return keys


def is_required(key, entry):
    """By every case: read as required in all samples (at the top in one: there a table takes its place in another), and no item of a list or a
    map of the user's names."""
    return len(entry["required"]) >= (len(SAMPLES) if "." in key else 1) and not re.search(r"[\[*]", key)


def order(key):
    return SECTIONS.index(re.split(r"[.\[]", key)[0]), [] if key in SECTIONS else key.split(".")[1:]


def table(keys):
    lines = ["# Keys of a case file", "",
             "Made by `scripts/keys.py` from the calls that read them (`common/link/case_file.h`); `[]` is an item of a list, `*` a name of yours.",
             "A default `-` means that there is none: the key is required where it applies, or its meaning says what holds without it.", "",
             "| key | type | unit | range | default | meaning | read by |", "|---|---|---|---|---|---|---|"]
    for key in sorted(keys, key=order):
        entry = keys[key]
        kinds = list(entry["types"].items())
        extents = [extent for _, (extent, _) in kinds if extent]
        defaults = [default for _, (_, default) in kinds if default]
        cells = ["`%s`" % key, " or ".join(kind for kind, _ in kinds), entry["unit"], "; ".join(extents),
                 "required" if is_required(key, entry) else (defaults[0] if defaults else "-"), entry["meaning"],
                 ", ".join(sorted(entry["parts"]))]
        lines.append("| " + " | ".join(cells) + " |")
    return "\n".join(lines) + "\n"


def bounds(extent):
    """JSON Schema's words for `> 0`, `>= 0`, `<= 1`, `from 0 to 1`."""
    found = re.fullmatch(r"from (\S+) to (\S+)", extent)
    if found:
        return {"minimum": float(found[1]), "maximum": float(found[2])}
    found = re.fullmatch(r"(>=|>|<=) (\S+)", extent)
    return {{">=": "minimum", ">": "exclusiveMinimum", "<=": "maximum"}[found[1]]: float(found[2])} if found else {}


def scalar(kind, extent):
    """The schema of one value; None for a list whose items have keys of their own."""
    size = re.fullmatch(r"list of (\d+) numbers", kind)
    if size:
        n = int(size[1])
        return {"type": "array", "items": {"type": "number"}, "minItems": n, "maxItems": n}
    if kind == "word":
        return {"enum": [word.strip() for word in extent.split(",")]}
    return {"number": {"type": "number", **bounds(extent)}, "integer": {"type": "integer", **bounds(extent)}, "string": {"type": "string"},
            "file name": {"type": "string"}, "true or false": {"type": "boolean"}}.get(kind)


def place(root, key, entry):
    """Puts a key into the tree of nodes: {fields, item, values, about}."""
    node = root
    for step in re.findall(r"[^.\[\]]+|\[\]", key):
        if step == "[]":
            node = node.setdefault("item", {})
        else:
            node = node.setdefault("fields", {}).setdefault(step, {})
    node["values"] = [v for v in (scalar(kind, extent) for kind, (extent, _) in entry["types"].items()) if v]
    node["about"] = entry["meaning"] + (", " + entry["unit"] if entry["unit"] else "")
    node["list"] = "list" in entry["types"]
    node["required"] = is_required(key, entry)


def schema(node):
    kinds = list(node.get("values", []))
    fields = node.get("fields", {})
    if fields:
        made = {"type": "object", "additionalProperties": schema(fields["*"]) if "*" in fields else False,
                "properties": {name: schema(below) for name, below in fields.items() if name != "*"}}
        needed = [name for name, below in fields.items() if below.get("required")]
        kinds.append({**made, "required": needed} if needed else made)
    if "item" in node:
        kinds.append({"type": "array", "items": schema(node["item"])})
    result = kinds[0] if len(kinds) == 1 else {"anyOf": kinds} if kinds else {}
    return {**result, "description": node["about"]} if node.get("about") else result


def named_in_sources():
    """Keys that string constants of the C sources spell out."""
    found = set()
    for folder, _, files in os.walk(ROOT):
        room = os.path.relpath(folder, ROOT)
        if not re.match(r"(fluid|solid|coupler|common)(/|$)", room) or room == "common/conformance":  # the kit's keys are its script's
            continue
        for name in files:
            if not name.endswith(".c") or name == "check.c":
                continue
            with open(os.path.join(folder, name)) as source:
                text = re.sub(r"/\*.*?\*/|CoracleCase(?:Renamed|NotBeside)\([^;]*;", "", source.read(), flags=re.S)
            for key in re.findall(r'Case\w*\([^;]*?"((?:fluid|solid|coupler|time|output)\.[\w.\[\]%]+)(?<!%s)"', text):
                found.add(re.sub(r"%[.\d]*s", "*", key.replace("[%d]", "[]")))
            found.update("fluid.probes[]." + key for key in re.findall(r'\bKey\(k, "([\w.]+)"\)', text))
            for reader, place in (("BodyKey", "solid.bodies[]."), ("MaterialKey", "solid.materials.*.")):
                found.update(place + key for key in re.findall(reader + r'\(\w+, [^,]+, "([\w.]+)"\)', text))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    keys = read_keys(arguments.build)
    tree = {}
    for key in sorted(keys, key=order):
        place(tree, key, keys[key])
    made = {"$schema": "https://json-schema.org/draft/2020-12/schema", "title": "A case of Coracle", **schema(tree)}
    texts = {"cases/KEYS.md": table(keys), "cases/case.schema.json": json.dumps(made, indent=1) + "\n"}
    if not arguments.check:
        for path, text in texts.items():
            with open(os.path.join(ROOT, path), "w") as out:
                out.write(text)
        return
    wrong = [f"{key} has no meaning: add it to KEYS in {'/check.c, '.join(sorted(e['parts']))}/check.c" for key, e in keys.items() if not e["meaning"]]
    known = {re.sub(r"\[\]$", "", key[:end.start()]) for key in keys for end in re.finditer(r"\.|$", key)} | set(keys)
    wrong += [f"{key} is read in the sources, but by none of {', '.join(SAMPLES)}: add it there" for key in named_in_sources() - known]
    for path, text in texts.items():
        with open(os.path.join(ROOT, path)) as old:
            if old.read() != text:
                wrong.append(f"{path} is not what the programs say: run scripts/keys.py")
    sys.exit("\n".join(wrong) or 0)


if __name__ == "__main__":
    main()
