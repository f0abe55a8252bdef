"""ParaView's everyday filters take the files of a run: pvbatch filters.py FOLDER."""
import sys

from paraview.simple import ExtractBlock, ExtractTimeSteps, GroupDatasets, OpenDataFile, PlotDataOverTime, PlotOverLine, StreamTracer, UpdatePipeline

folder = sys.argv[1]
LOWER, UPPER = (0.2, 0.2, 0.0), (1.8, 1.8, 0.0)


def points(proxy, time):
    UpdatePipeline(time=time, proxy=proxy)
    return proxy.GetDataInformation().GetNumberOfPoints()


def must(condition, what):
    if not condition:
        print("paraview: error:", what)
        sys.exit(1)


readers = {name: OpenDataFile(f"{folder}/{name}.xdmf") for name in ("fluid.velocity", "fluid.pressure", "solid", "coupler")}
times = {name: list(reader.TimestepValues) for name, reader in readers.items() if name != "coupler"}
must(times["fluid.velocity"] == times["fluid.pressure"] == times["solid"], f"times differ: {times}")
for name, reader in readers.items():
    last = reader.TimestepValues[-1]
    must(points(PlotOverLine(Input=reader, Point1=LOWER, Point2=UPPER), last) > 100, f"PlotOverLine of {name}")
    must(points(ExtractTimeSteps(Input=reader, TimeStepIndices=[1]), reader.TimestepValues[1]) > 10, f"ExtractTimeSteps of {name}")
    over_time = PlotDataOverTime(Input=reader)
    UpdatePipeline(proxy=over_time)
    must(over_time.GetDataInformation().GetNumberOfRows() >= len(reader.TimestepValues), f"PlotDataOverTime of {name}")
last = times["solid"][-1]
tracer = StreamTracer(Input=readers["fluid.velocity"], Vectors=["POINTS", "velocity"], SeedType="Line")
tracer.SeedType.Point1, tracer.SeedType.Point2 = (0.5, 0.9, 0.0), (1.5, 0.9, 0.0)
must(points(tracer, last) > 10, "StreamTracer")
both = GroupDatasets(Input=[readers["fluid.velocity"], readers["solid"]], BlockNames=["fluid", "solid"])
must(0 < points(ExtractBlock(Input=both, Selectors=["/Root/solid"]), last) == points(readers["solid"], last), "ExtractBlock")
