#include "Grids/PointArrays.h"

#include "OpenVDB.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <openvdb/points/AttributeArrayString.h>
#include <openvdb/points/AttributeGroup.h>
#include <openvdb/points/PointDataGrid.h>

#include <cmath>
#include <functional>
#include <map>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace activesurface
{

namespace
{

using namespace openvdb::points;
using Leaf = PointDataTree::LeafNodeType;
using Leaves = std::vector<const Leaf*>;

std::int64_t CountPoints(const Leaf& leaf)
{
  return leaf.getValue(openvdb::Index(Leaf::SIZE - 1));
}

// Validates that each array has one value per point of the leaf and that the offsets ascend.
void Check(const Leaf& leaf)
{
  leaf.validateOffsets();
  const AttributeSet& attributes = leaf.attributeSet();
  for (std::size_t i = 0; i < attributes.size(); ++i)
  {
    if (attributes.getConst(i)->size() != CountPoints(leaf))
    {
      throw std::runtime_error(
        "The points cannot be read: an attribute has not one value for each point of a leaf.");
    }
  }
}

Leaves CollectLeaves(const PointDataGrid& grid, std::int64_t maximum, std::int64_t& count)
{
  Leaves leaves;
  count = 0;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf)
  {
    Check(*leaf);
    leaves.push_back(&*leaf);
    count += CountPoints(*leaf);
  }
  if (count > maximum)
  {
    throw std::runtime_error("The grid has " + std::to_string(count) +
      " points, more than MaximumNumberOfPoints; raise it to read them.");
  }
  return leaves;
}

vtkSmartPointer<vtkPoints> MakePositions(
  const PointDataGrid& grid, const Leaves& leaves, std::int64_t count)
{
  auto points = vtkSmartPointer<vtkPoints>::New();
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(count);
  vtkIdType point = 0;
  for (const Leaf* leaf : leaves)
  {
    const AttributeHandle<openvdb::Vec3f> place(leaf->constAttributeArray("P"));
    for (auto index = leaf->beginIndexAll(); index; ++index, ++point)
    {
      const openvdb::Vec3d at = grid.transform().indexToWorld(
        openvdb::Vec3d(place.get(*index)) + index.getCoord().asVec3d());
      points->SetPoint(point, at.asPointer());
    }
  }
  return points;
}

template <class Value, bool IsNumber = std::is_arithmetic<Value>::value>
struct Parts
{
  using Element = Value;
  static constexpr int Count = 1;
  static double Get(const Value& value, int) { return static_cast<double>(value); }
};

template <class Value>
struct Parts<Value, false>
{
  using Element = typename Value::value_type;
  static constexpr int Count = sizeof(Value) / sizeof(Element);
  static double Get(const Value& value, int i)
  {
    return static_cast<double>(reinterpret_cast<const Element*>(&value)[i]);
  }
};

template <class Element>
int GetVTKType()
{
  if (std::is_floating_point<Element>::value)
  {
    return sizeof(Element) == 4 ? VTK_FLOAT : VTK_DOUBLE;
  }
  constexpr bool isSigned = std::is_signed<Element>::value;
  switch (sizeof(Element))
  {
    case 1:
      return isSigned ? VTK_TYPE_INT8 : VTK_TYPE_UINT8;
    case 2:
      return isSigned ? VTK_TYPE_INT16 : VTK_TYPE_UINT16;
    case 4:
      return isSigned ? VTK_TYPE_INT32 : VTK_TYPE_UINT32;
    default:
      return isSigned ? VTK_TYPE_INT64 : VTK_TYPE_UINT64;
  }
}

using Maker = vtkSmartPointer<vtkAbstractArray> (*)(const Leaves&, std::size_t, std::int64_t);

template <class Value>
vtkSmartPointer<vtkAbstractArray> MakeArray(
  const Leaves& leaves, std::size_t attribute, std::int64_t count)
{
  using Part = Parts<Value>;
  const openvdb::Index stride =
    leaves.empty() ? 1 : leaves.front()->constAttributeArray(attribute).stride();
  vtkSmartPointer<vtkDataArray> array;
  array.TakeReference(vtkDataArray::CreateDataArray(GetVTKType<typename Part::Element>()));
  array->SetNumberOfComponents(static_cast<int>(stride) * Part::Count);
  array->SetNumberOfTuples(count);
  vtkIdType point = 0;
  for (const Leaf* leaf : leaves)
  {
    const AttributeHandle<Value> handle(leaf->constAttributeArray(attribute));
    if (handle.stride() != stride || !handle.hasConstantStride())
    {
      throw std::runtime_error("An attribute has another number of values in each point.");
    }
    for (std::int64_t i = 0; i < CountPoints(*leaf); ++i, ++point)
    {
      for (openvdb::Index s = 0; s < stride; ++s)
      {
        const Value value = handle.get(static_cast<openvdb::Index>(i), s);
        for (int part = 0; part < Part::Count; ++part)
        {
          array->SetComponent(
            point, static_cast<int>(s) * Part::Count + part, Part::Get(value, part));
        }
      }
    }
  }
  return array;
}

// Specialised because doubles have too few digits for 64-bit integers.
template <>
vtkSmartPointer<vtkAbstractArray> MakeArray<openvdb::Int64>(
  const Leaves& leaves, std::size_t attribute, std::int64_t count)
{
  auto array = vtkSmartPointer<vtkTypeInt64Array>::New();
  array->SetNumberOfTuples(count);
  vtkIdType point = 0;
  for (const Leaf* leaf : leaves)
  {
    const AttributeHandle<openvdb::Int64> handle(leaf->constAttributeArray(attribute));
    for (std::int64_t i = 0; i < CountPoints(*leaf); ++i)
    {
      array->SetValue(point++, handle.get(static_cast<openvdb::Index>(i)));
    }
  }
  return array;
}

vtkSmartPointer<vtkAbstractArray> MakeStrings(
  const Leaves& leaves, std::size_t attribute, std::int64_t count)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetNumberOfValues(count);
  vtkIdType point = 0;
  for (const Leaf* leaf : leaves)
  {
    const StringAttributeHandle handle(
      leaf->constAttributeArray(attribute), leaf->attributeSet().descriptor().getMetadata());
    for (std::int64_t i = 0; i < CountPoints(*leaf); ++i)
    {
      array->SetValue(point++, handle.get(static_cast<openvdb::Index>(i)));
    }
  }
  return array;
}

template <class Value>
std::pair<std::string, Maker> Of()
{
  return { openvdb::typeNameAsString<Value>(), &MakeArray<Value> };
}

Maker FindMaker(const openvdb::NamePair& type)
{
  using namespace openvdb;
  static const std::map<std::string, Maker> makers = { Of<bool>(), Of<std::int8_t>(),
    Of<std::int16_t>(), Of<Int32>(), Of<Int64>(), Of<std::uint8_t>(), Of<float>(), Of<double>(),
    Of<Vec3i>(), Of<Vec3s>(), Of<Vec3d>(), Of<math::Mat3s>(), Of<math::Mat3d>(), Of<math::Mat4s>(),
    Of<math::Mat4d>(), Of<math::Quats>(), Of<math::Quatd>() };
  if (type.second == StringCodec<false>::name())
  {
    return &MakeStrings;
  }
  const auto maker = makers.find(type.first);
  return maker == makers.end() ? nullptr : maker->second;
}

void AddAttributes(const Leaves& leaves, std::int64_t count, vtkPointData* data)
{
  const AttributeSet::Descriptor& descriptor = leaves.front()->attributeSet().descriptor();
  for (const auto& [name, position] : descriptor.map())
  {
    const openvdb::NamePair& type = descriptor.type(position);
    if (name == "P" || type == GroupAttributeArray::attributeType())
    {
      continue;
    }
    const Maker maker = FindMaker(type);
    if (!maker)
    {
      throw std::runtime_error("The points' attribute \"" + name + "\" has the type " + type.first +
        ", which has no array in VTK.");
    }
    const auto array = maker(leaves, position, count);
    array->SetName(name.c_str());
    data->AddArray(array);
  }
}

// Adds an array for each group: 1 for its points, else 0.
void AddGroups(const Leaves& leaves, std::int64_t count, vtkPointData* data)
{
  for (const auto& group : leaves.front()->attributeSet().descriptor().groupMap())
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(group.first.c_str());
    array->SetNumberOfTuples(count);
    vtkIdType point = 0;
    for (const Leaf* leaf : leaves)
    {
      const GroupHandle handle = leaf->groupHandle(group.first);
      for (std::int64_t i = 0; i < CountPoints(*leaf); ++i)
      {
        array->SetValue(point++, handle.get(static_cast<openvdb::Index>(i)) ? 1 : 0);
      }
    }
    data->AddArray(array);
  }
}

}

void ReadPoints(const openvdb::GridBase& grid, std::int64_t maximum, vtkPolyData* data)
{
  if (!grid.isType<PointDataGrid>())
  {
    throw std::invalid_argument("The grid \"" + grid.getName() + "\" holds no points.");
  }
  const auto& points = static_cast<const PointDataGrid&>(grid);
  std::int64_t count;
  const Leaves leaves = CollectLeaves(points, maximum, count);
  data->SetPoints(MakePositions(points, leaves, count));
  vtkNew<vtkTypeInt64Array> offsets, corners;
  offsets->SetNumberOfValues(count + 1);
  corners->SetNumberOfValues(count);
  for (vtkIdType i = 0; i <= count; ++i)
  {
    offsets->SetValue(i, i);
    i < count ? corners->SetValue(i, i) : void();
  }
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(offsets, corners);
  data->SetVerts(vertices);
  if (!leaves.empty())
  {
    AddAttributes(leaves, count, data->GetPointData());
    AddGroups(leaves, count, data->GetPointData());
  }
}

}
