#include "Targets/HomeParticles.h"

#include "Ranks/InputPiece.h"
#include "Ranks/PieceBytes.h"
#include "Ranks/WholeOfPieces.h"

#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace activesurface
{

namespace
{

// Facts of a rank's piece of an input.
struct PieceFacts
{
  std::uint64_t Points;
  std::uint64_t Content;
  std::uint64_t HasCells;
};

vtkSmartPointer<vtkPolyData> AddNumbers(vtkPolyData* points, std::uint64_t first)
{
  auto numbered = vtkSmartPointer<vtkPolyData>::New();
  numbered->SetPoints(points->GetPoints());
  numbered->GetPointData()->ShallowCopy(points->GetPointData());
  vtkNew<vtkTypeInt64Array> numbers;
  numbers->SetName(NumbersOfPoints);
  numbers->SetNumberOfValues(points->GetNumberOfPoints());
  std::iota(numbers->GetPointer(0), numbers->GetPointer(0) + points->GetNumberOfPoints(),
    static_cast<vtkTypeInt64>(first));
  numbered->GetPointData()->AddArray(numbers);
  return numbered;
}

std::size_t HomeOfId(double id, std::size_t ranks)
{
  id += 0.0; // -0 is 0
  std::uint64_t key = 0;
  std::memcpy(&key, &id, sizeof key);
  key = (key ^ (key >> 31)) * 0x9e3779b97f4a7c15ull;
  key = (key ^ (key >> 29)) * 0xbf58476d1ce4e5b9ull;
  return static_cast<std::size_t>((key ^ (key >> 32)) % ranks);
}

}

Bytes PackPoints(vtkPolyData* points)
{
  return points->GetNumberOfPoints() > 0 ? PackPiece({ PieceKind::Particles, points }) : Bytes();
}

vtkSmartPointer<vtkPolyData> MergePoints(const std::vector<Bytes>& parts)
{
  std::vector<InputPiece> pieces;
  std::vector<vtkDataSet*> data;
  for (const Bytes& bytes : parts)
  {
    if (!bytes.empty())
    {
      pieces.push_back(UnpackPiece(bytes));
      data.push_back(pieces.back().Data);
    }
  }
  if (data.empty())
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  const vtkSmartPointer<vtkDataSet> whole = AppendPieces(data, "The input");
  auto points = vtkPolyData::SafeDownCast(whole);
  vtkNew<vtkTypeInt64Array> numbers; // a reader may have made another array of integers
  numbers->DeepCopy(points->GetPointData()->GetArray(NumbersOfPoints));
  vtkNew<vtkIdList> order;
  order->SetNumberOfIds(points->GetNumberOfPoints());
  std::iota(order->begin(), order->end(), vtkIdType(0));
  // Faster than std::sort on parts that are in order.
  std::stable_sort(order->begin(), order->end(),
    [&numbers](vtkIdType a, vtkIdType b) { return numbers->GetValue(a) < numbers->GetValue(b); });
  return std::is_sorted(order->begin(), order->end()) ? vtkSmartPointer<vtkPolyData>(points)
                                                      : SelectPoints(points, order);
}

HomePoints SendHome(
  const Agreement& ranks, vtkPolyData* points, vtkDataArray* ids, std::uint64_t content)
{
  const auto size = static_cast<std::size_t>(ranks.GetSize());
  const auto count = static_cast<std::uint64_t>(points ? points->GetNumberOfPoints() : 0);
  const PieceFacts own = { count, content, points && points->GetNumberOfCells() > 0 ? 1u : 0u };
  HomePoints home;
  std::uint64_t first = 0;
  int rank = 0;
  for (const PieceFacts& facts : ranks.ExchangeValue(own))
  {
    first += rank++ < ranks.GetRank() ? facts.Points : 0;
    home.AllPoints += facts.Points;
    constexpr std::uint64_t factor = 0x9e3779b97f4a7c15ull;
    home.Content = (home.Content ^ facts.Content) * factor + facts.Points;
  }
  std::vector<Bytes> toEach(size);
  if (count > 0)
  {
    const vtkSmartPointer<vtkPolyData> numbered = AddNumbers(points, first);
    if (own.HasCells)
    {
      MakeOneCell(numbered);
    }
    std::vector<vtkSmartPointer<vtkIdList>> lists(size);
    for (vtkSmartPointer<vtkIdList>& list : lists)
    {
      list = vtkSmartPointer<vtkIdList>::New();
    }
    for (std::uint64_t i = 0; i < count; ++i)
    {
      const auto point = static_cast<vtkIdType>(i);
      const std::size_t to =
        ids ? HomeOfId(ids->GetComponent(point, 0), size) : (first + i) * size / home.AllPoints;
      lists[to]->InsertNextId(point);
    }
    for (std::size_t to = 0; to < size; ++to)
    {
      toEach[to] = PackPoints(SelectPoints(numbered, lists[to]));
    }
  }
  home.Data = MergePoints(ranks.Distribute(toEach));
  return home;
}

WholeFrame DescribeWhole(const Agreement& ranks, const ParticleFrame& part, std::size_t points)
{
  WholeFrame whole;
  for (const WholeFrame& ofRank : ranks.ExchangeValue(part.Describe()))
  {
    whole.Add(ofRank);
  }
  whole.Points = points;
  return whole;
}

vtkSmartPointer<vtkPolyData> GatherPoints(const HomePart& home)
{
  vtkSmartPointer<vtkPolyData> all = MergePoints(home.Ranks.Exchange(PackPoints(home.Data)));
  all->GetPointData()->RemoveArray(NumbersOfPoints);
  return all;
}

}
