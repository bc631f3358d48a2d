# SPDX-License-Identifier: GPL-3.0-or-later
# Usage: pvbatch readSeries.py case.hdf.series
# Prints, for each time that ParaView finds: time, points, cells, and the range of every column.
import sys

from paraview.simple import GetTimeKeeper, OpenDataFile

source = OpenDataFile(sys.argv[1])  # chooses the reader as a double-click does
if source is None:
    sys.exit("ParaView has no reader for " + sys.argv[1])
for time in GetTimeKeeper().TimestepValues:
    source.UpdatePipeline(time)
    information = source.GetDataInformation()
    columns = source.PointData
    ranges = ["%s %.17g" % (name, columns[name].GetRange(-1)[1]) for name in sorted(columns.keys())]
    print("%.17g" % time, information.GetNumberOfPoints(), information.GetNumberOfCells(), *ranges)
