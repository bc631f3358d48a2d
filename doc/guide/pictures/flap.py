# SPDX-License-Identifier: GPL-3.0-or-later
# Usage, in the case of first-case.md: pvpython flap.py picture.png.  Draws the particles at 0.3 s by their speed, the flap in red
import sys
from paraview.simple import *

series = OpenDataFile("particles.hdf.series")
series.UpdatePipeline(0.3)
view = GetActiveViewOrCreate("RenderView")
view.ViewSize = [400, 169]
view.ViewTime = 0.3
view.Background = [1, 1, 1]
view.UseColorPaletteForBackground = 0
view.OrientationAxesVisibility = 0
for zone in (0, 1):
    part = Threshold(Input=series, Scalars=["POINTS", "zone"], ThresholdMethod="Between", LowerThreshold=zone, UpperThreshold=zone)
    part.UpdatePipeline(0.3)
    shown = Show(part, view)
    shown.SetRepresentationType("Point Gaussian")
    shown.GaussianRadius = 0.00035
    shown.ShaderPreset = "Plain circle"
    if zone == 0:
        ColorBy(shown, ("POINTS", "U", "Magnitude"))
        shown.RescaleTransferFunctionToDataRange()
        shown.SetScalarBarVisibility(view, False)
    else:
        shown.ColorArrayName = [None, ""]
        shown.DiffuseColor = shown.AmbientColor = [0.75, 0.1, 0.1]
view.CameraParallelProjection = 1
ResetCamera(view)
view.CameraParallelScale = 0.0107
SaveScreenshot(sys.argv[1], view, CompressionLevel=9)
