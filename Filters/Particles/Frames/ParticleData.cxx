#include "Frames/ParticleData.h"

#include "Frames/TableColumns.h"

#include "vtkAbstractArray.h"
#include "vtkCellTypes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataObjectTree.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <stdexcept>
#include <string>
#include <vector>

namespace activesurface
{

namespace
{

struct InputBlock
{
  std::string Name; // includes VTK's flat index
  vtkSmartPointer<vtkDataSet> Data;
};

std::string NameOf(vtkCompositeDataIterator* leaf)
{
  std::string name = "The block " + std::to_string(leaf->GetCurrentFlatIndex());
  vtkInformation* meta = leaf->HasCurrentMetaData() ? leaf->GetCurrentMetaData() : nullptr;
  if (meta && meta->Has(vtkCompositeDataSet::NAME()))
  {
    name += std::string(", ") + meta->Get(vtkCompositeDataSet::NAME()) + ",";
  }
  return name;
}

// Lists the blocks with points.
std::vector<InputBlock> ListBlocks(vtkDataObjectTree* tree)
{
  std::vector<InputBlock> blocks;
  const auto leaf = vtkSmartPointer<vtkCompositeDataIterator>::Take(tree->NewIterator());
  for (leaf->InitTraversal(); !leaf->IsDoneWithTraversal(); leaf->GoToNextItem())
  {
    vtkDataObject* held = leaf->GetCurrentDataObject();
    InputBlock block{ NameOf(leaf), AsDataSet(held) };
    if (!block.Data)
    {
      throw std::invalid_argument(
        block.Name + " of the input is a " + held->GetClassName() + ", which has no particles.");
    }
    if (block.Data->GetNumberOfPoints() > 0)
    {
      blocks.push_back(block);
    }
  }
  return blocks;
}

bool HasVerticesOnly(vtkPointSet* points)
{
  if (auto polyData = vtkPolyData::SafeDownCast(points)) // its cell types may have to be built
  {
    return polyData->GetNumberOfCells() == polyData->GetNumberOfVerts();
  }
  vtkNew<vtkCellTypes> types;
  points->GetCellTypes(types);
  bool hasOthers = false;
  for (vtkIdType i = 0; i < types->GetNumberOfTypes(); ++i)
  {
    const int type = types->GetCellType(i);
    hasOthers =
      hasOthers || (type != VTK_EMPTY_CELL && type != VTK_VERTEX && type != VTK_POLY_VERTEX);
  }
  return !hasOthers;
}

vtkPointSet* AsParticles(const InputBlock& block)
{
  vtkPointSet* points = vtkPointSet::SafeDownCast(block.Data);
  if (!points || !HasVerticesOnly(points))
  {
    throw std::invalid_argument(block.Name + " of the input is no set of particles, but a " +
      block.Data->GetClassName() + (points ? " with other cells than vertices" : "") +
      "; where several blocks have points, all have to be particles. Extract one block, or merge "
      "them.");
  }
  return points;
}

vtkSmartPointer<vtkPoints> JoinPoints(const std::vector<InputBlock>& blocks)
{
  vtkIdType count = 0;
  bool isDouble = false;
  for (const InputBlock& block : blocks)
  {
    count += block.Data->GetNumberOfPoints();
    isDouble = isDouble || AsParticles(block)->GetPoints()->GetDataType() != VTK_FLOAT;
  }
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(isDouble ? VTK_DOUBLE : VTK_FLOAT);
  points->SetNumberOfPoints(count);
  vtkIdType first = 0;
  for (const InputBlock& block : blocks)
  {
    const vtkIdType own = block.Data->GetNumberOfPoints();
    points->InsertPoints(first, own, 0, AsParticles(block)->GetPoints());
    first += own;
  }
  return points;
}

bool IsAlike(vtkAbstractArray* array, vtkAbstractArray* other)
{
  return other && other->GetDataType() == array->GetDataType() &&
    other->GetNumberOfComponents() == array->GetNumberOfComponents();
}

// Returns null unless all blocks have the array.
vtkSmartPointer<vtkAbstractArray> JoinArray(
  const std::vector<InputBlock>& blocks, vtkAbstractArray* example)
{
  auto joined = vtkSmartPointer<vtkAbstractArray>::Take(example->NewInstance());
  joined->SetName(example->GetName());
  joined->SetNumberOfComponents(example->GetNumberOfComponents());
  joined->CopyComponentNames(example);
  for (const InputBlock& block : blocks)
  {
    vtkAbstractArray* own = block.Data->GetPointData()->GetAbstractArray(example->GetName());
    if (!IsAlike(example, own) || own->GetNumberOfTuples() != block.Data->GetNumberOfPoints())
    {
      return nullptr;
    }
    joined->InsertTuples(joined->GetNumberOfTuples(), own->GetNumberOfTuples(), 0, own);
  }
  return joined;
}

vtkSmartPointer<vtkPolyData> JoinBlocks(const std::vector<InputBlock>& blocks)
{
  auto joined = vtkSmartPointer<vtkPolyData>::New();
  joined->SetPoints(JoinPoints(blocks));
  vtkPointData* first = blocks.front().Data->GetPointData();
  for (int i = 0; i < first->GetNumberOfArrays(); ++i)
  {
    vtkAbstractArray* example = first->GetAbstractArray(i);
    const vtkSmartPointer<vtkAbstractArray> array =
      example->GetName() ? JoinArray(blocks, example) : nullptr;
    if (array)
    {
      const int index = joined->GetPointData()->AddArray(array);
      const int attribute = first->IsArrayAnAttribute(i);
      if (attribute >= 0)
      {
        joined->GetPointData()->SetActiveAttribute(index, attribute);
      }
    }
  }
  return joined;
}

vtkSmartPointer<vtkDataSet> JoinTree(vtkDataObjectTree* tree)
{
  const std::vector<InputBlock> blocks = ListBlocks(tree);
  if (blocks.size() == 1)
  {
    return blocks.front().Data;
  }
  return blocks.empty() ? vtkSmartPointer<vtkPolyData>::New() : JoinBlocks(blocks);
}

}

vtkSmartPointer<vtkDataSet> AsDataSet(vtkDataObject* data)
{
  if (auto table = vtkTable::SafeDownCast(data))
  {
    return MakePoints(table);
  }
  if (auto tree = vtkDataObjectTree::SafeDownCast(data); tree && !HasLevels(data))
  {
    return JoinTree(tree);
  }
  return vtkDataSet::SafeDownCast(data);
}

bool HasLevels(vtkDataObject* data)
{
  return data->IsA("vtkUniformGridAMR");
}

}
