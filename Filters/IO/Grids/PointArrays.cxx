#include "Grids/PointArrays.h"

#include "Base/OpenVDB.h"
#include "Grids/ArrayValues.h"

#include "vtkAOSDataArrayTemplate.h"
#include "vtkCellArray.h"
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

#include <map>
#include <memory>
#include <stdexcept>
#include <string>
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
      throw std::runtime_error("The points cannot be read: an attribute does not have one value "
                               "for each point of a leaf; copy or write the file again.");
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
      " points, more than MaximumNumberOfPoints (" + std::to_string(maximum) +
      "); raise the limit.");
  }
  return leaves;
}

// For each leaf, calls visit = open(leaf). For each point of the leaf, calls visit(index in the
// leaf, index among all points).
template <class Open>
void ForEachPoint(const Leaves& leaves, const Open& open)
{
  vtkIdType point = 0;
  for (const Leaf* leaf : leaves)
  {
    const auto visit = open(*leaf);
    const auto count = static_cast<openvdb::Index>(CountPoints(*leaf));
    for (openvdb::Index i = 0; i < count; ++i)
    {
      visit(i, point++);
    }
  }
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

using Maker = vtkSmartPointer<vtkAbstractArray> (*)(const Leaves&, std::size_t, std::int64_t);

template <class Value>
vtkSmartPointer<vtkAbstractArray> MakeArray(
  const Leaves& leaves, std::size_t attribute, std::int64_t count)
{
  using Traits = openvdb::ValueTraits<Value>;
  using Element = typename Traits::ElementType;
  using Array = vtkAOSDataArrayTemplate<StoredNumber<Element>>;
  const openvdb::Index stride = leaves.front()->constAttributeArray(attribute).stride();
  const auto made = MakeArrayOf<Element>();
  made->SetNumberOfComponents(static_cast<int>(stride) * Traits::Elements);
  made->SetNumberOfTuples(count);
  auto array = vtkArrayDownCast<Array>(made.Get());
  ForEachPoint(leaves,
    [=](const Leaf& leaf)
    {
      const auto handle = AttributeHandle<Value>::create(leaf.constAttributeArray(attribute));
      if (handle->stride() != stride || !handle->hasConstantStride())
      {
        throw std::runtime_error("The points cannot be read: an attribute has different numbers of "
                                 "values in different points; write the file with the same "
                                 "number of values in each point.");
      }
      return [=](openvdb::Index i, vtkIdType point)
      {
        int component = 0;
        for (openvdb::Index s = 0; s < stride; ++s)
        {
          const Value value = handle->get(i, s);
          const auto* const elements = reinterpret_cast<const Element*>(&value);
          for (int part = 0; part < Traits::Elements; ++part)
          {
            array->SetTypedComponent(point, component++, elements[part]);
          }
        }
      };
    });
  return made;
}

vtkSmartPointer<vtkAbstractArray> MakeStrings(
  const Leaves& leaves, std::size_t attribute, std::int64_t count)
{
  auto array = vtkSmartPointer<vtkStringArray>::New();
  array->SetNumberOfValues(count);
  ForEachPoint(leaves,
    [&](const Leaf& leaf)
    {
      const auto handle = std::make_shared<StringAttributeHandle>(
        leaf.constAttributeArray(attribute), leaf.attributeSet().descriptor().getMetadata());
      return [&array, handle](openvdb::Index i, vtkIdType point)
      { array->SetValue(point, handle->get(i)); };
    });
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
        ", which is not supported; write the file without this attribute.");
    }
    const auto array = maker(leaves, position, count);
    array->SetName(name.c_str());
    data->AddArray(array);
  }
}

// Adds an array for each group: 1 for points of the group, else 0.
void AddGroups(const Leaves& leaves, std::int64_t count, vtkPointData* data)
{
  for (const auto& group : leaves.front()->attributeSet().descriptor().groupMap())
  {
    vtkNew<vtkUnsignedCharArray> array;
    array->SetName(group.first.c_str());
    array->SetNumberOfTuples(count);
    ForEachPoint(leaves,
      [&](const Leaf& leaf)
      {
        const GroupHandle handle = leaf.groupHandle(group.first);
        return [&array, handle](openvdb::Index i, vtkIdType point)
        { array->SetValue(point, handle.get(i) ? 1 : 0); };
      });
    data->AddArray(array);
  }
}

}

void ReadPoints(const openvdb::GridBase& grid, std::int64_t maximum, vtkPolyData* data)
{
  if (!grid.isType<PointDataGrid>())
  {
    throw std::invalid_argument(
      "The grid \"" + grid.getName() + "\" has no points; choose another GridName.");
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
