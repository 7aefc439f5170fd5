"""Makes the small pictures of the pages, Examples/Pictures/*.jpg, from the examples' .png files.

Run: python3 shrink_pictures.py FOLDER   (the --output folder of the examples)
"""

import sys
from pathlib import Path

from vtkmodules.vtkImagingCore import vtkImageResize
from vtkmodules.vtkIOImage import vtkJPEGWriter, vtkPNGReader

WIDTH, QUALITY = 1200, 88
PICTURES = Path(__file__).resolve().parent / "Pictures"

for path in sorted(Path(sys.argv[1]).glob("*.png")):
    reader, smaller, writer = vtkPNGReader(), vtkImageResize(), vtkJPEGWriter()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    across = min(WIDTH, width)
    smaller.SetInputConnection(reader.GetOutputPort())
    smaller.SetOutputDimensions(across, round(height * across / width), 1)
    writer.SetInputConnection(smaller.GetOutputPort())
    writer.SetQuality(QUALITY)
    picture = PICTURES / f"{path.stem}.jpg"
    writer.SetFileName(str(picture))
    writer.Write()
    print(f"{picture.name}: {picture.stat().st_size // 1000} kB")
