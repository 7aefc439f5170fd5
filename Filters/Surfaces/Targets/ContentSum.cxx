#include "Targets/ContentSum.h"

#include "vtkCellArray.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkImageData.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

namespace activesurface
{

namespace
{

std::uint64_t Mix(std::uint64_t hash, std::uint64_t word)
{
  hash = (hash ^ word) * 0x9e3779b97f4a7c15ull;
  return hash ^ (hash >> 29);
}

std::uint64_t MixBytes(std::uint64_t hash, const char* bytes, std::size_t count)
{
  for (; count >= 8; count -= 8, bytes += 8)
  {
    std::uint64_t word;
    std::memcpy(&word, bytes, 8);
    hash = Mix(hash, word);
  }
  std::uint64_t rest = 0;
  if (count > 0)
  {
    std::memcpy(&rest, bytes, count);
  }
  return Mix(hash, rest + count);
}

// Mixes each tuple of the array into the hash with the same index.
void MixTuples(vtkDataArray* array, std::vector<std::uint64_t>& hashes)
{
  const auto count = static_cast<vtkIdType>(hashes.size());
  if (!array || array->GetNumberOfTuples() != count)
  {
    return;
  }
  const std::string name = array->GetName() ? array->GetName() : "";
  const std::uint64_t ofName = MixBytes(1, name.data(), name.size());
  const auto components = static_cast<std::size_t>(array->GetNumberOfComponents());
  if (array->HasStandardMemoryLayout())
  {
    const std::size_t size = components * static_cast<std::size_t>(array->GetDataTypeSize());
    const char* bytes = static_cast<const char*>(array->GetVoidPointer(0));
    for (std::size_t i = 0; i < hashes.size(); ++i)
    {
      hashes[i] = MixBytes(hashes[i] ^ ofName, bytes + i * size, size);
    }
    return;
  }
  std::vector<double> tuple(components);
  for (vtkIdType i = 0; i < count; ++i)
  {
    array->GetTuple(i, tuple.data());
    hashes[i] = MixBytes(
      hashes[i] ^ ofName, reinterpret_cast<const char*>(tuple.data()), components * sizeof(double));
  }
}

std::uint64_t SumTuples(vtkDataArray* array)
{
  std::vector<std::uint64_t> hashes;
  for (vtkIdType i = 0; array && i < array->GetNumberOfTuples(); ++i)
  {
    hashes.push_back(static_cast<std::uint64_t>(i));
  }
  MixTuples(array, hashes);
  std::uint64_t sum = 0;
  for (const std::uint64_t hash : hashes)
  {
    sum += hash;
  }
  return sum;
}

std::uint64_t SumCells(vtkPolyData* mesh)
{
  std::uint64_t sum = 0;
  for (vtkCellArray* cells : { mesh->GetLines(), mesh->GetPolys(), mesh->GetStrips() })
  {
    if (cells && cells->GetNumberOfCells() > 0)
    {
      sum += SumTuples(cells->GetConnectivityArray()) + 3 * SumTuples(cells->GetOffsetsArray());
    }
  }
  return sum;
}

std::uint64_t SumLattice(vtkImageData* image)
{
  std::uint64_t hash = MixBytes(1, reinterpret_cast<const char*>(image->GetExtent()), 24);
  hash = MixBytes(hash, reinterpret_cast<const char*>(image->GetOrigin()), 24);
  return MixBytes(hash, reinterpret_cast<const char*>(image->GetSpacing()), 24);
}

}

std::uint64_t SumContent(vtkDataSet* data)
{
  auto mesh = vtkPolyData::SafeDownCast(data);
  auto image = vtkImageData::SafeDownCast(data);
  auto points = vtkPointSet::SafeDownCast(data);
  std::uint64_t sum = image ? SumLattice(image) : 0;
  sum += mesh ? SumCells(mesh) : 0;
  const bool isInOrder = sum != 0;
  std::vector<std::uint64_t> hashes(static_cast<std::size_t>(data->GetNumberOfPoints()), 1);
  for (std::size_t i = 0; isInOrder && i < hashes.size(); ++i)
  {
    hashes[i] = static_cast<std::uint64_t>(i);
  }
  if (points && points->GetPoints())
  {
    MixTuples(points->GetPoints()->GetData(), hashes);
  }
  for (int i = 0; i < data->GetPointData()->GetNumberOfArrays(); ++i)
  {
    MixTuples(data->GetPointData()->GetArray(i), hashes);
  }
  for (const std::uint64_t hash : hashes)
  {
    sum += hash;
  }
  return sum;
}

}
