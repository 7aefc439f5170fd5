#include "Skeleton.h"

#include <algorithm>
#include <array>
#include <limits>

namespace activesurface
{
namespace
{
// Enough to look at several lattices without leaving the first cache.
constexpr std::size_t HitsOfStream = 32;

// Of the radius: more means more that is looked at in vain, less means more builds.
constexpr double MarginOfMoving = 0.1;

constexpr double SmallestSize = 1e-100;
constexpr double LargestSize = 1e100;

bool IsFinite(const double x[3])
{
  return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
}
}

bool SkeletonVertex::IsUsable() const
{
  return std::fabs(this->Position[0]) <= LargestSize &&
    std::fabs(this->Position[1]) <= LargestSize && std::fabs(this->Position[2]) <= LargestSize &&
    this->Radius >= SmallestSize && this->Radius <= LargestSize &&
    std::fabs(this->Strength) <= LargestSize;
}

void Skeleton::Clear()
{
  this->Points.clear();
  this->Segments.clear();
  this->Capsules.clear();
}

void Skeleton::AddPoint(const SkeletonVertex& vertex)
{
  const double* p = vertex.Position;
  this->Points.push_back(
    { { p[0], p[1], p[2] }, vertex.Strength, 1.0 / (vertex.Radius * vertex.Radius) });
  this->AddCapsule(vertex, vertex);
}

void Skeleton::AddSegment(const SkeletonVertex& start, const SkeletonVertex& end)
{
  SkeletonSegment segment;
  double length2 = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    segment.Start[axis] = start.Position[axis];
    segment.Edge[axis] = end.Position[axis] - start.Position[axis];
    length2 += segment.Edge[axis] * segment.Edge[axis];
  }
  const bool hasLength = length2 >= SmallestSize * SmallestSize;
  segment.InverseLength2 = hasLength ? 1.0 / length2 : 0.0;
  segment.Radius = start.Radius;
  segment.RadiusChange = end.Radius - start.Radius;
  segment.Strength = start.Strength;
  segment.StrengthChange = end.Strength - start.Strength;
  this->Segments.push_back(segment);
  this->AddCapsule(start, end);
}

void Skeleton::AddCapsule(const SkeletonVertex& start, const SkeletonVertex& end)
{
  const bool isFirst = this->Capsules.empty();
  Capsule capsule;
  for (int axis = 0; axis < 3; ++axis)
  {
    capsule.Start[axis] = start.Position[axis];
    capsule.End[axis] = end.Position[axis];
    const double low =
      std::min(start.Position[axis] - start.Radius, end.Position[axis] - end.Radius);
    const double high =
      std::max(start.Position[axis] + start.Radius, end.Position[axis] + end.Radius);
    double* bounds = this->Bounds + 2 * axis;
    bounds[0] = isFirst ? low : std::min(bounds[0], low);
    bounds[1] = isFirst ? high : std::max(bounds[1], high);
  }
  capsule.StartRadius = start.Radius;
  capsule.EndRadius = end.Radius;
  this->Capsules.push_back(capsule);
}

// Whether each element lies within what the cells list for it.
bool Skeleton::AreWithinCells() const
{
  constexpr double largest = 1.0 + 2.0 * MarginOfMoving; // then cells list too much
  const auto isWithin = [](const double at[3], double radius, const double centre[3], double reach)
  {
    const double x = at[0] - centre[0], y = at[1] - centre[1], z = at[2] - centre[2];
    const double room = reach - radius;
    return room >= 0.0 && reach <= largest * radius && x * x + y * y + z * z <= room * room;
  };
  // What holds at both ends of a segment holds between them: all runs linearly.
  return this->Listed.size() == this->Capsules.size() &&
    std::equal(this->Capsules.begin(), this->Capsules.end(), this->Listed.begin(),
      [&](const Capsule& now, const Capsule& then)
      {
        return isWithin(now.Start, now.StartRadius, then.Start, then.StartRadius) &&
          isWithin(now.End, now.EndRadius, then.End, then.EndRadius);
      });
}

void Skeleton::Build()
{
  if (this->AreWithinCells())
  {
    return;
  }
  const bool moves = this->Listed.size() == this->Capsules.size();
  const double factor = moves ? 1.0 + MarginOfMoving : 1.0;
  double largest = 0.0;
  this->Listed = this->Capsules;
  for (Capsule& capsule : this->Listed)
  {
    largest = std::max({ largest, capsule.StartRadius, capsule.EndRadius });
    capsule.StartRadius *= factor;
    capsule.EndRadius *= factor;
  }
  double bounds[6];
  for (int side = 0; side < 6; ++side)
  {
    bounds[side] = this->Bounds[side] + (side % 2 ? 1.0 : -1.0) * (factor - 1.0) * largest;
  }
  try
  {
    this->Cells.Build(this->Listed, bounds);
  }
  catch (...)
  {
    this->Listed.clear();
    this->Cells = SkeletonCells(); // what is half built lists elements that are not there
    throw;
  }
}

template <class Kernel>
ACTIVE_ALWAYS_INLINE SkeletonSum Skeleton::SumAt(const double x[3]) const
{
  SkeletonSum sum;
  this->VisitHits(x,
    [this, &sum, x](const Index* hits, std::size_t count) ACTIVE_INLINED
    { this->AddHits<Kernel>(sum, x, hits, count); });
  return sum;
}

// Calls visit(hits, count) for all that may reach x, ascending.
template <class Visitor>
ACTIVE_ALWAYS_INLINE void Skeleton::VisitHits(const double x[3], Visitor visit) const
{
  if (this->Cells.GetNumberOfLattices() > 1)
  {
    this->VisitMerged(x, visit);
  }
  else if (this->Cells.GetNumberOfLattices() == 1)
  {
    Index hits[SkeletonCells::HitsAtOnce];
    SkeletonCells::Search search = this->Cells.StartSearch(0, x);
    while (!search.IsOver())
    {
      const std::size_t count = this->Cells.TakeHits(search, hits, SkeletonCells::HitsAtOnce);
      visit(hits, count);
    }
  }
}

// The hits of one lattice.
struct Skeleton::Stream
{
  SkeletonCells::Search Search;
  std::size_t Head;
  std::size_t Count;
  Index Hits[HitsOfStream];

  // Whether there is a hit at Head.
  bool Refill(const SkeletonCells& cells)
  {
    while (this->Head == this->Count && !this->Search.IsOver())
    {
      this->Head = 0;
      this->Count = cells.TakeHits(this->Search, this->Hits, HitsOfStream);
    }
    return this->Head < this->Count;
  }
};

template <class Visitor>
ACTIVE_ALWAYS_INLINE void Skeleton::VisitMerged(const double x[3], Visitor visit) const
{
  std::array<Stream, SkeletonCells::MaximumLattices> streams;
  std::array<Stream*, SkeletonCells::MaximumLattices> open;
  auto end = open.begin();
  for (std::size_t lattice = 0; lattice < this->Cells.GetNumberOfLattices(); ++lattice)
  {
    Stream& stream = streams[lattice];
    stream.Search = this->Cells.StartSearch(lattice, x);
    stream.Head = stream.Count = 0;
    *end = &stream;
    end += stream.Refill(this->Cells) ? 1 : 0;
  }
  const auto isEarlier = [](const Stream* a, const Stream* b)
  { return a->Hits[a->Head] < b->Hits[b->Head]; };
  Index merged[SkeletonCells::HitsAtOnce];
  std::size_t count = 0;
  while (end != open.begin())
  {
    const auto first = std::min_element(open.begin(), end, isEarlier);
    Stream& stream = **first;
    merged[count] = stream.Hits[stream.Head];
    ++stream.Head;
    ++count;
    if (!stream.Refill(this->Cells))
    {
      --end;
      *first = *end;
    }
    if (count == SkeletonCells::HitsAtOnce || end == open.begin())
    {
      visit(merged, count);
      count = 0;
    }
  }
}

template <class Kernel>
ACTIVE_ALWAYS_INLINE void Skeleton::AddHits(
  SkeletonSum& result, const double x[3], const Index* hits, std::size_t count) const
{
  const SkeletonPoint* points = this->Points.data();
  const std::size_t pointCount = this->Points.size();
  // Copies, so that they stay in registers.
  const double here[3] = { x[0], x[1], x[2] };
  SkeletonSum sum = result;
  const Index* end = hits + count;
  for (; hits != end && *hits < pointCount; ++hits)
  {
    points[*hits].AddTo<Kernel>(sum, here);
  }
  for (; hits != end; ++hits)
  {
    this->Segments[*hits - pointCount].AddTo<Kernel>(sum, here);
  }
  result = sum;
}

// Sums at one point after the other.
template <class Kernel>
struct Skeleton::Evaluation
{
  const Skeleton& Elements;
  double Threshold;
  const double* Points;
  double* Values;
  double* Gradients; // or null

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t count) const
  {
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = 0; i < count; ++i)
    {
      const double* x = this->Points + 3 * i;
      const SkeletonSum sum =
        IsFinite(x) ? this->Elements.SumAt<Kernel>(x) : SkeletonSum{ { nan, nan, nan, nan } };
      this->Values[i] = this->Threshold - sum.Terms[3];
      if (this->Gradients)
      {
        std::copy(sum.Terms, sum.Terms + 3, this->Gradients + 3 * i);
      }
    }
  }
};

void Skeleton::Evaluate(SkeletonKernel kernel, double threshold, std::size_t count,
  const double* points, double* values, double* gradients) const
{
  const auto evaluate = [&](auto kind)
  {
    using Kind = Evaluation<decltype(kind)>;
    CompiledKernel<Kind, std::size_t>::GetBest()(
      Kind{ *this, threshold, points, values, gradients }, count);
  };
  switch (kernel)
  {
    case SkeletonKernel::Wyvill:
      evaluate(WyvillKernel());
      break;
    case SkeletonKernel::CubicSpline:
      evaluate(CubicSplineKernel());
      break;
    case SkeletonKernel::Metaball:
      evaluate(MetaballKernel());
      break;
  }
}

void Skeleton::FindWeights(
  SkeletonKernel kernel, const double x[3], std::vector<SkeletonWeight>& weights) const
{
  weights.clear();
  switch (kernel)
  {
    case SkeletonKernel::Wyvill:
      this->AddWeights<WyvillKernel>(x, weights);
      break;
    case SkeletonKernel::CubicSpline:
      this->AddWeights<CubicSplineKernel>(x, weights);
      break;
    case SkeletonKernel::Metaball:
      this->AddWeights<MetaballKernel>(x, weights);
      break;
  }
}

template <class Kernel>
void Skeleton::AddWeights(const double x[3], std::vector<SkeletonWeight>& weights) const
{
  this->VisitHits(x,
    [this, &weights, x](const Index* hits, std::size_t count)
    {
      for (std::size_t i = 0; i < count && hits[i] < this->Points.size(); ++i)
      {
        SkeletonSum sum;
        this->Points[hits[i]].AddTo<Kernel>(sum, x);
        if (sum.Terms[3] != 0.0)
        {
          weights.push_back({ hits[i], sum.Terms[3] });
        }
      }
    });
}

}
