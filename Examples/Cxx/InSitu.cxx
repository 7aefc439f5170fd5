// Advances a skin within the loop of a simulation, in which two blocks of particles fly through one
// another. Writes a .vtp file for each frame.
//
// Run: InSitu [--output <folder>]

#include <vtkActiveImplicitSurface.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkXMLPolyDataWriter.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace
{
constexpr double Spacing = 0.1, Speed = 1.0, dt = 0.1;
constexpr int Frames = 11;

// Positions of the particles: two blocks of 6 x 6 x 6.
void Simulate(double time, vtkPoints* points)
{
  points->Reset();
  for (int i = 0; i < 432; ++i)
  {
    const double side = i < 216 ? -1.0 : 1.0;
    const double x = Spacing * (i % 6 - 2.5) + side * (0.5 - Speed * time);
    points->InsertNextPoint(x, Spacing * (i / 6 % 6 - 2.5), Spacing * (i / 36 % 6 - 2.5));
  }
  points->Modified();
}
}

int main(int argc, char* argv[])
{
  const bool named = argc == 3 && std::string(argv[1]) == "--output";
  const std::filesystem::path folder = named ? argv[2] : "output";
  std::filesystem::create_directories(folder);

  vtkNew<vtkPolyData> particles; // overwritten in each frame
  particles->SetPoints(vtkNew<vtkPoints>());
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary(); // VTK 9.1 reads this mode with any libexpat

  vtkNew<vtkActiveImplicitSurface> surface;
  surface->SetParticleSpacing(Spacing);
  for (int frame = 0; frame < Frames; ++frame)
  {
    Simulate(frame * dt, particles->GetPoints());
    if (!surface->Advance(particles, dt))
    {
      return 1;
    }
    const std::string name = (folder / ("in_situ_" + std::to_string(frame) + ".vtp")).string();
    writer->SetFileName(name.c_str());
    writer->SetInputData(surface->GetOutput());
    if (!writer->Write())
    {
      return 1;
    }
    std::cout << name << ": " << surface->GetOutput()->GetNumberOfPolys() << " triangles\n";
  }
  return 0;
}
