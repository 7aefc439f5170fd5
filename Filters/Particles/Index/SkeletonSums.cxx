// Sums a skeleton's contributions: in SIMD lanes at several points of one cell, otherwise point by
// point. The results are bitwise identical.

#include "Index/PointGroups.h"
#include "Index/Skeleton.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace activesurface
{
namespace
{
// Smaller groups are faster point by point.
constexpr int FewestLanes = 3;

ACTIVE_ALWAYS_INLINE ElementIndex::Place PlaceAt(const double x[3])
{
  return { { x[0], x[1], x[2] }, { x[0], x[1], x[2] } };
}

// Fills all lanes; unused lanes repeat the last member.
ACTIVE_ALWAYS_INLINE SkeletonLanes GatherPositions(
  const double* points, const std::size_t* members, int count)
{
  SkeletonLanes lanes;
  for (int i = 0; i < SkeletonLanes::Width; ++i)
  {
    const double* x = points + 3 * members[std::min(i, count - 1)];
    for (int axis = 0; axis < 3; ++axis)
    {
      lanes.X[axis][i] = x[axis];
    }
  }
  return lanes;
}

ACTIVE_ALWAYS_INLINE ElementIndex::Place FindBox(const SkeletonLanes& lanes)
{
  ElementIndex::Place box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const double* x = lanes.X[axis];
    double low = x[0], high = x[0];
    for (int i = 1; i < SkeletonLanes::Width; ++i)
    {
      low = std::min(low, x[i]);
      high = std::max(high, x[i]);
    }
    box.Low[axis] = low;
    box.High[axis] = high;
  }
  return box;
}
}

template <class Kernel, class Sums>
ACTIVE_ALWAYS_INLINE void Skeleton::AddHits(
  const Index* hits, std::size_t count, Sums& result) const
{
  const SkeletonPoint* points = this->Points.data();
  const std::size_t pointCount = this->Points.size();
  Sums sums = result; // a copy that stays in registers
  const Index* end = hits + count;
  for (; hits != end && *hits < pointCount; ++hits)
  {
    points[*hits].AddTo<Kernel>(sums);
  }
  for (; hits != end; ++hits)
  {
    this->Segments[*hits - pointCount].AddTo<Kernel>(sums);
  }
  result = sums;
}

template <class Kernel, class Sums>
ACTIVE_ALWAYS_INLINE void Skeleton::AddAll(const ElementIndex::Place& place, Sums& sums) const
{
  this->Near.VisitHits(place,
    [this, &sums](const Index* hits, std::size_t count) ACTIVE_INLINED
    { this->AddHits<Kernel>(hits, count, sums); });
}

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
    std::size_t alone[PointGroups::Capacity];
    std::size_t countAlone = 0;
    const PointGroups groups(count,
      [&](std::size_t i, NodeIndex& cell)
      {
        const bool isGrouped = this->IsFinite(i) && this->FindCell(i, cell);
        alone[countAlone] = i;
        countAlone += isGrouped ? 0 : 1;
        return isGrouped;
      });
    groups.ForEach(
      [this](const NodeIndex&, const std::size_t* members, int size) ACTIVE_INLINED
      {
        if (size >= FewestLanes)
        {
          this->EvaluateTogether(members, size);
          return;
        }
        for (int i = 0; i < size; ++i)
        {
          this->EvaluateAt(members[i]);
        }
      });
    for (std::size_t i = 0; i < countAlone; ++i)
    {
      this->EvaluateAt(alone[i]);
    }
  }

private:
  bool IsFinite(std::size_t i) const
  {
    const double* x = this->Points + 3 * i;
    return std::isfinite(x[0]) && std::isfinite(x[1]) && std::isfinite(x[2]);
  }

  bool FindCell(std::size_t i, NodeIndex& cell) const
  {
    return this->Elements.Near.FindCell(this->Points + 3 * i, cell);
  }

  ACTIVE_ALWAYS_INLINE void EvaluateAt(std::size_t i) const
  {
    if (!this->IsFinite(i))
    {
      constexpr double nan = std::numeric_limits<double>::quiet_NaN();
      constexpr double nowhere[4] = { nan, nan, nan, nan };
      this->Write(i, nowhere);
      return;
    }
    const double* x = this->Points + 3 * i;
    SkeletonPlace place{ { x[0], x[1], x[2] } };
    this->Elements.template AddAll<Kernel>(PlaceAt(x), place);
    this->Write(i, place.Terms);
  }

  ACTIVE_ALWAYS_INLINE void EvaluateTogether(const std::size_t* members, int count) const
  {
    SkeletonLanes lanes = GatherPositions(this->Points, members, count);
    this->Elements.template AddAll<Kernel>(FindBox(lanes), lanes);
    for (int i = 0; i < count; ++i)
    {
      const double terms[4] = { lanes.Terms[0][i], lanes.Terms[1][i], lanes.Terms[2][i],
        lanes.Terms[3][i] };
      this->Write(members[i], terms);
    }
  }

  ACTIVE_ALWAYS_INLINE void Write(std::size_t i, const double terms[4]) const
  {
    this->Values[i] = this->Threshold - terms[3];
    if (this->Gradients)
    {
      std::copy(terms, terms + 3, this->Gradients + 3 * i);
    }
  }
};

void Skeleton::Evaluate(SkeletonKernel kernel, double threshold, std::size_t count,
  const double* points, double* values, double* gradients) const
{
  const auto evaluate = [&](auto kind)
  {
    using Kind = Evaluation<decltype(kind)>;
    const auto run = CompiledKernel<Kind, std::size_t>::GetBest();
    for (std::size_t first = 0; first < count; first += PointGroups::Capacity)
    {
      const Kind part{ *this, threshold, points + 3 * first, values + first,
        gradients ? gradients + 3 * first : nullptr };
      run(part, std::min(count - first, PointGroups::Capacity));
    }
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
  this->Near.VisitHits(PlaceAt(x),
    [this, &weights, x](const Index* hits, std::size_t count)
    {
      for (std::size_t i = 0; i < count && hits[i] < this->Points.size(); ++i)
      {
        SkeletonPlace place{ { x[0], x[1], x[2] } };
        this->Points[hits[i]].AddTo<Kernel>(place);
        if (place.Terms[3] != 0.0)
        {
          weights.push_back({ hits[i], place.Terms[3] });
        }
      }
    });
}

}
