// Two balls grow together and become one; a .vtp file is written for each time step.
//
// Run: MorphSpheres [--output <folder>]

#include <vtkActiveImplicitSurface.h>
#include <vtkImplicitBoolean.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSphere.h>
#include <vtkXMLPolyDataWriter.h>

#include <filesystem>
#include <iostream>
#include <string>

namespace
{
constexpr int Steps = 11;
constexpr double StepSize = 0.1;
}

int main(int argc, char* argv[])
{
  const bool named = argc == 3 && std::string(argv[1]) == "--output";
  const std::filesystem::path folder = named ? argv[2] : "output";
  std::filesystem::create_directories(folder);

  vtkNew<vtkSphere> left;
  left->SetCenter(-0.5, 0.0, 0.0);
  left->SetRadius(0.35);
  vtkNew<vtkSphere> right;
  right->SetCenter(0.5, 0.0, 0.0);
  right->SetRadius(0.35);
  vtkNew<vtkImplicitBoolean> both;
  both->SetOperationTypeToUnion();
  both->AddFunction(left);
  both->AddFunction(right);
  vtkNew<vtkSphere> one;
  one->SetRadius(0.7);

  vtkNew<vtkActiveImplicitSurface> surface;
  surface->SetModelBounds(-1, 1, -1, 1, -1, 1);
  surface->SetVoxelSize(0.04);
  surface->SetInitialFunction(both);
  surface->SetTargetFunction(one);
  surface->SetAttraction(4);
  surface->SetTimeStepSize(StepSize);
  surface->SetNumberOfTimeSteps(Steps);

  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetDataModeToBinary(); // VTK 9.1 reads this mode with any libexpat
  for (int step = 0; step < Steps; ++step)
  {
    surface->UpdateTimeStep(step * StepSize);
    const std::string name = (folder / ("morph_" + std::to_string(step) + ".vtp")).string();
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
