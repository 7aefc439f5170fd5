#include "Targets/TargetFrame.h"

#include "AttachedData.h"

#include "vtkCellTypes.h"
#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <stdexcept>
#include <string>

namespace activesurface
{

namespace
{

TargetKind FindKindOfPolyData(vtkPolyData* data)
{
  const bool hasFaces = data->GetNumberOfPolys() > 0 || data->GetNumberOfStrips() > 0;
  const bool hasLines = data->GetNumberOfLines() > 0;
  if (hasFaces && hasLines)
  {
    throw std::invalid_argument(
      "A vtkPolyData with both polygons and lines cannot be a target: polygons are a mesh, lines a "
      "skeleton. Leave one of them out.");
  }
  return hasFaces ? TargetKind::Mesh : hasLines ? TargetKind::Skeleton : TargetKind::Particles;
}

void CheckHasVerticesOnly(vtkDataSet* data)
{
  vtkNew<vtkCellTypes> types;
  data->GetCellTypes(types);
  for (vtkIdType i = 0; i < types->GetNumberOfTypes(); ++i)
  {
    const int type = types->GetCellType(i);
    if (type != VTK_EMPTY_CELL && type != VTK_VERTEX && type != VTK_POLY_VERTEX)
    {
      throw std::invalid_argument(std::string("A ") + data->GetClassName() +
        " with other cells than vertices cannot be a target. Take its points alone as particles, "
        "or its closed surface as a vtkPolyData (vtkDataSetSurfaceFilter).");
    }
  }
}

// A copy, by another name.
void AddArray(vtkDataSet* data, vtkAbstractArray* array, const char* name)
{
  if (array)
  {
    vtkSmartPointer<vtkAbstractArray> copy;
    copy.TakeReference(array->NewInstance());
    copy->DeepCopy(array);
    copy->SetName(name);
    data->GetPointData()->AddArray(copy);
  }
}

// A copy of points and cells alone: what comes through the input may be written over by the next
// step.
vtkSmartPointer<vtkDataSet> CopyShape(vtkDataSet* data)
{
  vtkSmartPointer<vtkDataSet> structure;
  structure.TakeReference(data->NewInstance());
  structure->CopyStructure(data);
  vtkSmartPointer<vtkDataSet> copy;
  copy.TakeReference(data->NewInstance());
  copy->DeepCopy(structure);
  return copy;
}

}

const char* GetName(TargetKind kind)
{
  constexpr const char* names[] = { "nothing", "particles", "a skeleton of lines", "a mesh",
    "an image" };
  return names[static_cast<int>(kind)];
}

bool TargetFrame::IsEmpty() const
{
  const bool isOfPoints = this->Kind == TargetKind::Particles || this->Kind == TargetKind::Skeleton;
  return this->Kind == TargetKind::Nothing || (isOfPoints && this->Particles.Particles.empty());
}

TargetKind FindKind(vtkDataSet* data)
{
  if (!data)
  {
    throw std::invalid_argument(
      "An input that is neither points nor an image cannot be a target: connect a vtkPointSet or a "
      "vtkImageData.");
  }
  if (data->GetNumberOfPoints() == 0)
  {
    return TargetKind::Nothing;
  }
  if (vtkImageData::SafeDownCast(data))
  {
    return TargetKind::Image;
  }
  if (auto polyData = vtkPolyData::SafeDownCast(data))
  {
    return FindKindOfPolyData(polyData);
  }
  CheckHasVerticesOnly(data);
  return TargetKind::Particles;
}

TargetFrame MakeParticles(vtkPointSet* points, const ParticleArrays& arrays)
{
  TargetFrame frame;
  frame.Kind = TargetKind::Particles;
  frame.Particles = ReadParticles(points, arrays);
  frame.HasCells = points->GetNumberOfCells() > 0;
  return frame;
}

TargetFrame MakeSkeleton(vtkPointSet* lines, vtkAbstractArray* radii, vtkAbstractArray* strengths)
{
  ParticleArrays arrays;
  arrays.Radii = radii;
  arrays.Strengths = strengths;
  TargetFrame frame;
  frame.Kind = TargetKind::Skeleton;
  frame.Particles = ReadParticles(lines, arrays);
  frame.Data = CopyShape(lines);
  AddArray(frame.Data, radii, RadiusName);
  AddArray(frame.Data, strengths, StrengthName);
  return frame;
}

TargetFrame MakeMesh(vtkDataSet* mesh)
{
  TargetFrame frame;
  frame.Kind = TargetKind::Mesh;
  frame.Data = CopyShape(mesh);
  return frame;
}

TargetFrame MakeImage(vtkDataSet* image, vtkAbstractArray* values)
{
  TargetFrame frame;
  frame.Kind = TargetKind::Image;
  frame.Data.TakeReference(image->NewInstance());
  frame.Data->CopyStructure(image);
  if (!values)
  {
    Attach(frame.Data->GetInformation(), GetAttachedGrid(image->GetInformation()));
    return frame;
  }
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(values);
  if (!numbers || numbers->GetNumberOfComponents() != 1 ||
    numbers->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    const std::string name = values->GetName() ? values->GetName() : "";
    throw std::invalid_argument("The array \"" + name +
      "\" cannot give an image's values: it has to hold one number for each point.");
  }
  // Not a copy. A VTK image makes a new array where another object holds the one that it had.
  frame.Data->GetPointData()->SetScalars(numbers);
  return frame;
}

}
