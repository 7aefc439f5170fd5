"""A ball splits into two balls; prints the events of the history, plots volume and components.

Run: python3 plot_history.py [--output FOLDER]
"""

import film_strip
import vtkmodules.vtkRenderingContextOpenGL2  # noqa: F401  draws the chart
from active_implicit_surfaces import vtkActiveImplicitSurface
from vtkmodules.vtkChartsCore import vtkAxis, vtkChart, vtkChartXY
from vtkmodules.vtkCommonDataModel import vtkImplicitBoolean, vtkSphere
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import vtkWindowToImageFilter
from vtkmodules.vtkViewsContext2D import vtkContextView

pair, ball = vtkImplicitBoolean(), vtkSphere()
for x, radius in ((-0.45, 0.32), (0.45, 0.4)):
    sphere = vtkSphere()
    sphere.SetCenter(x, 0, 0)
    sphere.SetRadius(radius)
    pair.AddFunction(sphere)
ball.SetRadius(0.6)
surface = vtkActiveImplicitSurface()
surface.SetModelBounds(-1, 1, -1, 1, -1, 1)
surface.SetInitialFunction(ball)
surface.SetTargetFunction(pair)
surface.SetNumberOfTimeSteps(61)
surface.UpdateTimeStep(6.0)
history = surface.GetHistory()
for row in range(history.GetNumberOfRows()):
    if event := history.GetValueByName(row, "Event").ToString():
        print(f"at {history.GetValueByName(row, 'Time').ToDouble():.1f}: {event}")

chart = vtkChartXY()
for name, color, corner, top in (
    ("Volume", (30, 90, 200), 0, 1),
    ("Components", (210, 90, 30), 1, 4),
):
    line = chart.AddPlot(vtkChart.LINE)
    line.SetInputData(history, "Time", name)
    line.SetColor(*color, 255)
    line.SetWidth(4)
    chart.SetPlotCorner(line, corner)
    axis = chart.GetAxis(vtkAxis.LEFT if corner == 0 else vtkAxis.RIGHT)
    axis.SetTitle(name)
    axis.SetBehavior(vtkAxis.FIXED)
    axis.SetRange(0, top)
chart.GetAxis(vtkAxis.BOTTOM).SetTitle("Time")
chart.SetShowLegend(True)
view = vtkContextView()
view.GetRenderWindow().SetOffScreenRendering(True)
view.GetRenderWindow().SetSize(1280, 720)
view.GetScene().AddItem(chart)
view.Render()
picture, writer = vtkWindowToImageFilter(), vtkPNGWriter()
picture.SetInput(view.GetRenderWindow())
writer.SetInputConnection(picture.GetOutputPort())
writer.SetFileName(str(film_strip.output_folder(__doc__) / "history.png"))
writer.Write()
print(f"wrote {writer.GetFileName()}")
