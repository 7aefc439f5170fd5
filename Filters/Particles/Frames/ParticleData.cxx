#include "Frames/ParticleData.h"

#include "vtkAbstractArray.h"
#include "vtkCellTypes.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObjectTree.h"
#include "vtkInformation.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

namespace activesurface
{

namespace
{

// Names of position columns without the component, in lower case; "" for x, y and z.
constexpr const char* NamesOfPositions[] = { "", "coordinate", "coordinates", "p", "point",
  "points", "pos", "position", "positions", "vertices" };

// One column, or three columns that are the components of a vector.
struct Group
{
  std::string Name;
  std::vector<vtkAbstractArray*> Columns;

  int GetNumberOfComponents() const
  {
    return this->Columns.size() == 1 ? this->Columns[0]->GetNumberOfComponents() : 3;
  }
};

// "Velocity:1", "velocity_y [m/s]" and "VelocityY" are component 1 of a vector. -1: not a
// component.
struct ColumnName
{
  std::string Vector;
  int Component = -1;
};

std::string GetName(vtkAbstractArray* column)
{
  return column->GetName() ? column->GetName() : "";
}

std::string ToLower(std::string text)
{
  std::transform(text.begin(), text.end(), text.begin(),
    [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  return text;
}

std::string WithoutUnit(const std::string& name)
{
  const bool hasUnit = !name.empty() && (name.back() == ']' || name.back() == ')');
  const std::size_t begin = hasUnit ? name.find_last_of("[(") : std::string::npos;
  const std::string plain = begin == std::string::npos ? name : name.substr(0, begin);
  return plain.substr(0, plain.find_last_not_of(' ') + 1);
}

ColumnName FindVector(vtkAbstractArray* column)
{
  ColumnName name{ WithoutUnit(GetName(column)) };
  if (name.Vector.empty() || column->GetNumberOfComponents() != 1)
  {
    return name;
  }
  const char last = static_cast<char>(std::tolower(static_cast<unsigned char>(name.Vector.back())));
  const std::string rest = name.Vector.substr(0, name.Vector.size() - 1);
  const char before = rest.empty() ? '\0' : rest.back();
  const bool isLetter = last >= 'x' && last <= 'z';
  const bool isNumber = last >= '0' && last <= '2' && (before == ':' || before == '_');
  if (isLetter || isNumber)
  {
    const bool isSeparated = before == ':' || before == '_' || before == '.' || before == ' ';
    name.Component = isLetter ? last - 'x' : last - '0';
    name.Vector = rest.substr(0, rest.size() - (isSeparated ? 1 : 0));
  }
  return name;
}

bool AreNumbers(const std::array<vtkAbstractArray*, 3>& columns)
{
  return std::all_of(columns.begin(), columns.end(),
    [](vtkAbstractArray* column) { return vtkDataArray::SafeDownCast(column) != nullptr; });
}

bool ArePositions(const Group& group)
{
  const std::string name = ToLower(WithoutUnit(group.Name));
  return group.GetNumberOfComponents() == 3 &&
    std::find(std::begin(NamesOfPositions), std::end(NamesOfPositions), name) !=
    std::end(NamesOfPositions);
}

// Groups the columns of vectors. A vector has the place of its component 0 among the groups.
std::vector<Group> GroupColumns(vtkTable* table)
{
  std::map<std::string, std::array<vtkAbstractArray*, 3>> vectors;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    const ColumnName name = FindVector(table->GetColumn(i));
    if (name.Component >= 0)
    {
      vectors[ToLower(name.Vector)][name.Component] = table->GetColumn(i);
    }
  }
  std::vector<Group> groups;
  for (vtkIdType i = 0; i < table->GetNumberOfColumns(); ++i)
  {
    vtkAbstractArray* column = table->GetColumn(i);
    const ColumnName name = FindVector(column);
    const auto found = vectors.find(ToLower(name.Vector));
    Group whole{ name.Vector, {} };
    if (name.Component >= 0 && found->second[name.Component] == column)
    {
      whole.Columns.assign(found->second.begin(), found->second.end());
      const bool isVector = std::count(whole.Columns.begin(), whole.Columns.end(), nullptr) == 0 &&
        (ArePositions(whole) || AreNumbers(found->second));
      if (isVector && name.Component == 0)
      {
        groups.push_back(whole);
      }
      if (isVector)
      {
        continue;
      }
    }
    groups.push_back({ GetName(column), { column } });
  }
  return groups;
}

vtkDataArray* AsNumbers(vtkAbstractArray* column, vtkTable* table)
{
  vtkDataArray* numbers = vtkDataArray::SafeDownCast(column);
  if (!numbers || numbers->GetNumberOfTuples() != table->GetNumberOfRows())
  {
    throw std::invalid_argument("The column \"" + GetName(column) +
      "\" of the table cannot be used for positions or vectors of particles, which need a number "
      "in each row. With a vtkDelimitedTextReader, turn DetectNumericColumns on.");
  }
  return numbers;
}

// Joins columns. The result has the columns' type, or double if their types differ.
vtkSmartPointer<vtkDataArray> Join(const Group& group, vtkTable* table)
{
  int type = group.Columns[0]->GetDataType();
  for (vtkAbstractArray* column : group.Columns)
  {
    AsNumbers(column, table);
    type = column->GetDataType() == type ? type : VTK_DOUBLE;
  }
  auto joined = vtkSmartPointer<vtkDataArray>::Take(vtkDataArray::CreateDataArray(type));
  joined->SetName(group.Name.c_str());
  joined->SetNumberOfComponents(3);
  joined->SetNumberOfTuples(table->GetNumberOfRows());
  for (int i = 0; i < 3; ++i)
  {
    const bool isWhole = group.Columns.size() == 1;
    joined->CopyComponent(i, AsNumbers(group.Columns[isWhole ? 0 : i], table), isWhole ? i : 0);
  }
  return joined;
}

vtkSmartPointer<vtkPoints> MakePositions(const Group& group, vtkTable* table)
{
  const vtkSmartPointer<vtkDataArray> positions = Join(group, table);
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataType(positions->GetDataType() == VTK_FLOAT ? VTK_FLOAT : VTK_DOUBLE);
  points->GetData()->DeepCopy(positions);
  return points;
}

std::string ListColumns(vtkTable* table)
{
  constexpr vtkIdType most = 20;
  std::string names;
  for (vtkIdType i = 0; i < std::min(table->GetNumberOfColumns(), most); ++i)
  {
    names += (i > 0 ? ", " : "") + GetName(table->GetColumn(i));
  }
  return names.empty() ? "none" : names + (table->GetNumberOfColumns() > most ? ", ..." : "");
}

// Converts rows to points. Columns other than positions become point arrays. Throws
// std::invalid_argument for a table without positions.
vtkSmartPointer<vtkPolyData> MakePoints(vtkTable* table)
{
  const std::vector<Group> groups = GroupColumns(table);
  const auto positions = std::find_if(groups.begin(), groups.end(), ArePositions);
  if (positions == groups.end())
  {
    throw std::invalid_argument("The table has no positions: particles need columns x, y and z, or "
                                "Points:0, Points:1 and Points:2; its columns are: " +
      ListColumns(table) + ".");
  }
  auto points = vtkSmartPointer<vtkPolyData>::New();
  points->SetPoints(MakePositions(*positions, table));
  for (auto group = groups.begin(); group != groups.end(); ++group)
  {
    if (group != positions)
    {
      points->GetPointData()->AddArray(
        group->Columns.size() == 1 ? group->Columns[0] : Join(*group, table).Get());
    }
  }
  return points;
}

struct InputBlock
{
  std::string Name; // block name with VTK's flat index
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
      throw std::invalid_argument(block.Name + " of the input is a " + held->GetClassName() +
        ", which has no particles; leave this block out.");
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
  if (auto polyData = vtkPolyData::SafeDownCast(points)) // GetCellTypes may build cells
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
      "; if several blocks have points, all such blocks have to be particles. Extract one block, "
      "or merge the blocks.");
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
