// Uses the installed package like an outside project: both libraries, their headers, no source
// tree. The argument is the version that find_package should have found.

#include <activesurface/NarrowBand.h>
#include <vtkActiveImplicitSurface.h>
#include <vtkNew.h>
#include <vtkPolyData.h>
#include <vtkSkeletonPotential.h>
#include <vtkSphere.h>

#include <iostream>
#include <string>

int main(int argc, char** argv)
{
  const std::string expected = argc > 1 ? argv[1] : FOUND_VERSION;
  if (expected != FOUND_VERSION)
  {
    std::cerr << "found version " << FOUND_VERSION << ", expected " << expected << "\n";
    return 1;
  }

  vtkNew<vtkSphere> ball;
  ball->SetRadius(0.5);
  vtkNew<vtkActiveImplicitSurface> surface;
  surface->SetTargetFunction(ball);
  surface->SetInitialFunction(ball);
  surface->SetModelBounds(-1, 1, -1, 1, -1, 1);
  surface->SetVoxelSize(0.1);
  surface->Update();
  std::cout << surface->GetOutput()->GetNumberOfPoints() << " points on the skin\n";

  vtkNew<vtkSkeletonPotential> potential;
  potential->Modified();
  const activesurface::NarrowBand band(0.1);
  return surface->GetOutput()->GetNumberOfPoints() > 0 && band.IsEmpty() ? 0 : 1;
}
