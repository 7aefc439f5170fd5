#include "Input/SkeletonInput.h"

#include "Index/Skeleton.h"
#include "Input/EachCell.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <stdexcept>
#include <vector>

namespace activesurface
{
namespace
{
using Ends = std::array<vtkIdType, 2>;

// Returns null if the name is empty.
vtkDataArray* FindArray(vtkPointSet* input, const std::string& name, const char* meaning)
{
  if (name.empty())
  {
    return nullptr;
  }
  const std::string called = std::string("The ") + meaning + " array \"" + name + "\" ";
  vtkDataArray* array = input->GetPointData()->GetArray(name.c_str());
  if (!array)
  {
    throw std::invalid_argument(
      called + "is not among the numeric point arrays of the input; correct its name.");
  }
  if (array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(called + "has " + std::to_string(array->GetNumberOfComponents()) +
      " components; choose an array of one number per point.");
  }
  if (array->GetNumberOfTuples() != input->GetNumberOfPoints())
  {
    throw std::invalid_argument(called + "has " + std::to_string(array->GetNumberOfTuples()) +
      " values for " + std::to_string(input->GetNumberOfPoints()) +
      " points; choose an array of one number per point.");
  }
  return array;
}

std::vector<SkeletonVertex> GetVertices(vtkPointSet* input, const SkeletonArrays& arrays)
{
  vtkDataArray* radii = FindArray(input, arrays.RadiusName, "radius");
  vtkDataArray* strengths = FindArray(input, arrays.StrengthName, "strength");
  std::vector<SkeletonVertex> vertices(input->GetNumberOfPoints());
  for (vtkIdType i = 0; i < input->GetNumberOfPoints(); ++i)
  {
    input->GetPoint(i, vertices[i].Position);
    vertices[i].Radius = radii ? radii->GetComponent(i, 0) : arrays.Radius;
    vertices[i].Strength = strengths ? strengths->GetComponent(i, 0) : 1.0;
  }
  return vertices;
}

// Keeps the first of several segments between the same two points.
void RemoveRepeated(std::vector<Ends>& segments)
{
  const auto key = [&segments](std::size_t i)
  {
    const auto ends = std::minmax(segments[i][0], segments[i][1]);
    return std::array<vtkIdType, 3>{ ends.first, ends.second, static_cast<vtkIdType>(i) };
  };
  std::vector<std::size_t> order(segments.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    order[i] = i;
  }
  std::sort(
    order.begin(), order.end(), [&key](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<bool> isRepeated(segments.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i)
  {
    const auto before = key(order[i - 1]);
    const auto now = key(order[i]);
    isRepeated[order[i]] = before[0] == now[0] && before[1] == now[1];
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < segments.size(); ++i)
  {
    segments[kept] = segments[i];
    kept += isRepeated[i] ? 0 : 1;
  }
  segments.resize(kept);
}

// Omits segments that join a point to itself. Counts segments with a missing point in `ignored`.
std::vector<Ends> GetSegments(vtkPolyData* input, std::size_t& ignored)
{
  const vtkIdType points = input->GetNumberOfPoints();
  std::vector<Ends> segments;
  ForEachCell(input->GetLines(),
    [&](vtkIdList* ids)
    {
      for (vtkIdType i = 1; i < ids->GetNumberOfIds(); ++i)
      {
        const Ends ends = { ids->GetId(i - 1), ids->GetId(i) };
        const auto range = std::minmax(ends[0], ends[1]);
        const bool exists = range.first >= 0 && range.second < points;
        ignored += exists ? 0 : 1;
        if (exists && ends[0] != ends[1])
        {
          segments.push_back(ends);
        }
      }
    });
  return segments;
}

// Returns for each point the first end of a segment that has the same position, radius and
// strength. Returns the point itself if its numbers are not usable, or if it is no end.
std::vector<vtkIdType> FindFirstEnds(
  const std::vector<SkeletonVertex>& vertices, const std::vector<Ends>& segments)
{
  const auto key = [&vertices](vtkIdType id)
  {
    const SkeletonVertex& vertex = vertices[id];
    return std::array<double, 5>{ vertex.Position[0], vertex.Position[1], vertex.Position[2],
      vertex.Radius, vertex.Strength };
  };
  std::vector<vtkIdType> ids;
  for (const Ends& ends : segments)
  {
    std::copy_if(ends.begin(), ends.end(), std::back_inserter(ids),
      [&vertices](vtkIdType id) { return vertices[id].IsUsable(); });
  }
  std::sort(ids.begin(), ids.end(),
    [&key](vtkIdType a, vtkIdType b) { return key(a) != key(b) ? key(a) < key(b) : a < b; });
  std::vector<vtkIdType> first(vertices.size());
  std::iota(first.begin(), first.end(), vtkIdType(0));
  for (std::size_t i = 1; i < ids.size(); ++i)
  {
    first[ids[i]] = key(ids[i]) == key(ids[i - 1]) ? first[ids[i - 1]] : ids[i];
  }
  return first;
}

// Makes ends of equal position, radius and strength one point, the first of them.
void MergeEnds(const std::vector<vtkIdType>& first, std::vector<Ends>& segments)
{
  std::size_t kept = 0;
  for (const Ends& ends : segments)
  {
    segments[kept] = { first[ends[0]], first[ends[1]] };
    kept += segments[kept][0] != segments[kept][1] ? 1 : 0;
  }
  segments.resize(kept);
  RemoveRepeated(segments);
}

// Flags the points that are elements: points of vertex cells, and points without segments that are
// not merged into another point. Counts references to missing points in `ignored`.
std::vector<bool> FindLonePoints(vtkPointSet* input, const std::vector<vtkIdType>& first,
  const std::vector<Ends>& segments, std::size_t& ignored)
{
  const vtkIdType points = input->GetNumberOfPoints();
  std::vector<bool> isLone(points);
  for (vtkIdType id = 0; id < points; ++id)
  {
    isLone[id] = first[id] == id;
  }
  for (const Ends& ends : segments)
  {
    isLone[ends[0]] = isLone[ends[1]] = false;
  }
  if (auto polyData = vtkPolyData::SafeDownCast(input))
  {
    ForEachCell(polyData->GetVerts(),
      [&](vtkIdList* ids)
      {
        for (vtkIdType i = 0; i < ids->GetNumberOfIds(); ++i)
        {
          const vtkIdType id = ids->GetId(i);
          const bool exists = id >= 0 && id < points;
          ignored += exists ? 0 : 1;
          if (exists)
          {
            isLone[id] = true;
          }
        }
      });
  }
  return isLone;
}

// Adds the segments. Subtracts each joint of m segments m - 1 times, because each of these segments
// includes the joint.
void AddSegments(const std::vector<SkeletonVertex>& vertices, const std::vector<Ends>& segments,
  Skeleton& skeleton)
{
  std::vector<int> meeting(vertices.size(), 0);
  for (const Ends& ends : segments)
  {
    ++meeting[ends[0]];
    ++meeting[ends[1]];
  }
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    if (meeting[i] > 1)
    {
      SkeletonVertex joint = vertices[i];
      joint.Strength *= 1 - meeting[i];
      skeleton.AddPoint(joint);
    }
  }
  for (const Ends& ends : segments)
  {
    skeleton.AddSegment(vertices[ends[0]], vertices[ends[1]]);
  }
}
}

std::size_t AddElements(vtkPointSet* input, const SkeletonArrays& arrays, Skeleton& skeleton)
{
  std::size_t ignored = 0;
  if (!input || input->GetNumberOfPoints() == 0)
  {
    return ignored;
  }
  const std::vector<SkeletonVertex> vertices = GetVertices(input, arrays);
  std::vector<Ends> segments;
  if (auto polyData = vtkPolyData::SafeDownCast(input))
  {
    segments = GetSegments(polyData, ignored);
  }
  const std::vector<vtkIdType> first = FindFirstEnds(vertices, segments);
  MergeEnds(first, segments);
  const std::vector<bool> isLone = FindLonePoints(input, first, segments, ignored);
  for (std::size_t i = 0; i < vertices.size(); ++i)
  {
    const bool isUsable = vertices[i].IsUsable();
    ignored += isLone[i] && !isUsable ? 1 : 0;
    if (isLone[i] && isUsable)
    {
      skeleton.AddPoint(vertices[i]);
    }
  }
  const auto isUseless = [&vertices](const Ends& ends)
  { return !vertices[ends[0]].IsUsable() || !vertices[ends[1]].IsUsable(); };
  const auto end = std::remove_if(segments.begin(), segments.end(), isUseless);
  ignored += static_cast<std::size_t>(segments.end() - end);
  segments.erase(end, segments.end());
  AddSegments(vertices, segments, skeleton);
  return ignored;
}

}
