"""ParaView's everyday filters take the files of runs: pvbatch filters.py FOLDER..."""
import os
import sys

from paraview.simple import (Delete, ExtractBlock, ExtractTimeSteps, GroupDatasets, OpenDataFile, PlotDataOverTime, PlotOverLine, StreamTracer,
                             UpdatePipeline)


def points(proxy, time):
    UpdatePipeline(time=time, proxy=proxy)
    return proxy.GetDataInformation().GetNumberOfPoints()


def across(proxy):
    """Two points far apart within the bounds of what it has."""
    bounds = proxy.GetDataInformation().GetBounds()
    return [[(1 - s) * bounds[2 * k] + s * bounds[2 * k + 1] for k in range(3)] for s in (0.1, 0.9)]


def check(folder):
    def must(condition, what):
        if not condition:
            print(f"paraview: error: {folder}: {what}")
            sys.exit(1)

    readers = {name: OpenDataFile(f"{folder}/{name}.xdmf") for name in ("fluid.velocity", "fluid.pressure", "solid.solid", "coupler")}
    last = readers["fluid.velocity"].TimestepValues[-1]
    readers = {name: reader for name, reader in readers.items() if points(reader, last) > 0}  # a case may have no solid
    must({"fluid.velocity", "fluid.pressure"} <= set(readers), "a fluid's file is empty")
    times = {name: list(reader.TimestepValues) for name, reader in readers.items() if name != "coupler"}
    must(all(of == times["fluid.velocity"] for of in times.values()), f"times differ: {times}")
    filters = []
    for name, reader in readers.items():
        points(reader, reader.TimestepValues[-1])
        lower, upper = across(reader)
        line = PlotOverLine(Input=reader, Point1=lower, Point2=upper)
        must(points(line, last) > 100, f"PlotOverLine of {name}")
        steps = ExtractTimeSteps(Input=reader, TimeStepIndices=[1])
        must(points(steps, reader.TimestepValues[1]) > 10, f"ExtractTimeSteps of {name}")
        over_time = PlotDataOverTime(Input=reader)
        UpdatePipeline(proxy=over_time)
        must(over_time.GetDataInformation().GetNumberOfRows() >= len(reader.TimestepValues), f"PlotDataOverTime of {name}")
        filters += [line, steps, over_time]
    tracer = StreamTracer(Input=readers["fluid.velocity"], Vectors=["POINTS", "velocity"], SeedType="Line", MaximumSteps=50)
    tracer.SeedType.Point1, tracer.SeedType.Point2 = across(readers["fluid.velocity"])
    must(points(tracer, last) > 10, "StreamTracer")
    filters.append(tracer)
    if "solid" in readers:
        both = GroupDatasets(Input=[readers["fluid.velocity"], readers["solid.solid"]], BlockNames=["fluid", "solid"])
        block = ExtractBlock(Input=both, Selectors=["/Root/solid"])
        must(0 < points(block, last) == points(readers["solid.solid"], last), "ExtractBlock")
        filters += [block, both]
    for proxy in (*filters, *readers.values()):
        Delete(proxy)
    print(f"{os.path.basename(folder)}: {', '.join(readers)}")


for folder in sys.argv[1:]:
    check(folder)
