#include "Targets/MeshShape.h"

#include "Input/MeshTriangles.h"
#include "Targets/GridFunction.h"
#include "Targets/MovingTarget.h"
#include "Targets/TargetOptions.h"
#include "Targets/Warnings.h"

#include "vtkBoundingBox.h"
#include "vtkGridPotential.h"
#include "vtkNew.h"
#include "vtkPolyData.h"

#include <stdexcept>

namespace activesurface
{

namespace
{

vtkDataSet* CheckHasNoLines(vtkDataSet* data)
{
  if (vtkPolyData::SafeDownCast(data)->GetNumberOfLines() > 0)
  {
    throw std::invalid_argument(
      "A vtkPolyData with both polygons and lines cannot be an input: polygons are a mesh, lines a "
      "skeleton. Remove the polygons or the lines. If vtkCleanPolyData made lines of narrow "
      "polygons, call its ConvertPolysToLinesOff.");
  }
  return data;
}

vtkIdType ToCount(double voxels)
{
  return voxels < double(VTK_ID_MAX) ? static_cast<vtkIdType>(voxels) : VTK_ID_MAX;
}

}

bool MeshShape::Fits(vtkDataSet* data)
{
  auto polyData = vtkPolyData::SafeDownCast(data);
  return polyData && (polyData->GetNumberOfPolys() > 0 || polyData->GetNumberOfStrips() > 0);
}

MeshShape::MeshShape(const InputData& input)
  : FunctionShape(CopyPointsAndCells(CheckHasNoLines(input.Data)))
{
}

std::string MeshShape::Prepare(const TargetOptions& options, const Warnings&)
{
  if (this->Function || !options.IsDomainKnown)
  {
    return "";
  }
  const double thickness = options.MeshThickness;
  vtkNew<vtkGridPotential> grid;
  grid->SetVoxelSize(options.VoxelSize);
  grid->SetReach(options.MeshReach);
  grid->SetMeshThickness(thickness);
  grid->SetMaximumNumberOfVoxels(ToCount(options.MeshVoxels));
  try
  {
    ReadGrid(grid, this->Data);
  }
  catch (const std::runtime_error& error)
  {
    const std::string text = error.what();
    const bool isOfSize = text.find("MaximumNumberOfVoxels") != std::string::npos;
    throw std::runtime_error(isOfSize ? text + options.MeshHint : text);
  }
  this->Function = grid;
  const std::string defects = grid->GetDefects();
  return defects.empty() || thickness != 0.0 ? defects
                                             : defects +
      " Any hole is closed by winding numbers. If open edges are a seam, merge its points "
      "(vtkCleanPolyData with Tolerance > 0; points of equal coordinates are merged already). If "
      "the mesh is meant to be open, set MeshThickness > 0 for a shell.";
}

// Returns an empty string for a level other than 0, where the thickness of parts differs.
std::string MeshShape::DescribeThinParts(const TargetOptions& options) const
{
  return options.IsoValue == 0.0
    ? activesurface::DescribeThinParts(this->Function, options.VoxelSize)
    : "";
}

void MeshShape::AddBounds(
  const TargetOptions& options, vtkBoundingBox& shapes, vtkBoundingBox&) const
{
  const std::array<double, 6> bounds = FindBounds(vtkPolyData::SafeDownCast(this->Data));
  if (bounds[0] > bounds[1])
  {
    return; // no usable polygon: an error follows when the mesh is read
  }
  vtkBoundingBox shell(bounds.data());
  shell.Inflate(0.5 * options.MeshThickness);
  shapes.AddBox(shell);
}

std::unique_ptr<MovingTarget> MeshShape::MakeTarget(
  const TargetFrames& frames, const TargetOptions& options) const
{
  return MakeBlend(frames, options.IsoValue + options.Reach, options);
}

}
