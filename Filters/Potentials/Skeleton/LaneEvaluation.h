// Evaluates a field of sums over elements, at several nearby points in SIMD lanes or at single
// points. The results are bitwise identical. All lanes add all hits in the same order; elements out
// of reach add zeros.

#ifndef LaneEvaluation_h
#define LaneEvaluation_h

#include "BallCells.h"
#include "PlaceGroups.h"
#include "SkeletonKernel.h"

#include <algorithm>
#include <limits>

namespace activesurface
{

// Hits of a place, for several visits. The search is done once if there are not too many hits.
class HitList
{
public:
  ACTIVE_ALWAYS_INLINE HitList(const BallCells& cells, const BallCells::Place& place)
    : Cells(cells)
    , Place(place)
  {
    cells.VisitHits(place,
      [this](const BallCells::Index* hits, std::size_t count) ACTIVE_INLINED
      {
        if (this->Count + count <= Capacity)
        {
          std::copy_n(hits, count, this->Hits + this->Count);
        }
        this->Count += count;
      });
  }

  template <class Visitor>
  ACTIVE_ALWAYS_INLINE void Visit(Visitor visit) const
  {
    if (this->Count <= Capacity)
    {
      visit(this->Hits, this->Count);
    }
    else
    {
      this->Cells.VisitHits(this->Place, visit);
    }
  }

private:
  static constexpr std::size_t Capacity = 1024;

  const BallCells& Cells;
  const BallCells::Place& Place;
  std::size_t Count = 0;
  BallCells::Index Hits[Capacity];
};

template <int Width>
struct PlaceLanes
{
  double X[3][Width];

  // Unused lanes repeat the last member.
  ACTIVE_ALWAYS_INLINE PlaceLanes(const double* points, const std::size_t* members, int count)
  {
    for (int i = 0; i < Width; ++i)
    {
      const double* x = points + 3 * members[std::min(i, count - 1)];
      for (int axis = 0; axis < 3; ++axis)
      {
        this->X[axis][i] = x[axis];
      }
    }
  }

  ACTIVE_ALWAYS_INLINE BallCells::Place FindBox() const
  {
    BallCells::Place box;
    for (int axis = 0; axis < 3; ++axis)
    {
      const double* x = this->X[axis];
      box.Low[axis] = box.High[axis] = x[0];
      for (int i = 1; i < Width; ++i)
      {
        box.Low[axis] = std::min(box.Low[axis], x[i]);
        box.High[axis] = std::max(box.High[axis], x[i]);
      }
    }
    return box;
  }
};

// Interface of a field with a number of Terms at each point:
//   Evaluate(PlaceLanes<Width>, HitList, double (&terms)[Terms][Width]), always inline;
//   Write(index of the point, const double* terms).
template <class Field>
struct LaneEvaluation
{
  const BallCells& Cells;
  const Field& Elements;
  const double* Points;

  ACTIVE_ALWAYS_INLINE void operator()(std::size_t count) const
  {
    const PlaceGroups groups(count, this->Points, this->Cells.GetGroupSize());
    groups.ForEachGroup(SkeletonLanes::Width,
      [this](const std::size_t* members, int size) ACTIVE_INLINED
      {
        if (size >= FewestLanes)
        {
          this->EvaluateTogether<SkeletonLanes::Width>(members, size);
          return;
        }
        for (int i = 0; i < size; ++i)
        {
          this->EvaluateTogether<1>(members + i, 1);
        }
      });
    double nowhere[Field::Terms];
    std::fill_n(nowhere, Field::Terms, std::numeric_limits<double>::quiet_NaN());
    groups.GetFinite().ForEachOther(
      [this, &nowhere](std::size_t i) ACTIVE_INLINED { this->Elements.Write(i, nowhere); });
  }

private:
  static constexpr int FewestLanes = 3; // fewer points are faster one by one

  template <int Width>
  ACTIVE_ALWAYS_INLINE void EvaluateTogether(const std::size_t* members, int count) const
  {
    const PlaceLanes<Width> lanes(this->Points, members, count);
    const BallCells::Place box = lanes.FindBox();
    const HitList hits(this->Cells, box);
    double terms[Field::Terms][Width];
    this->Elements.Evaluate(lanes, hits, terms);
    for (int i = 0; i < count; ++i)
    {
      double own[Field::Terms];
      for (int term = 0; term < Field::Terms; ++term)
      {
        own[term] = terms[term][i];
      }
      this->Elements.Write(members[i], own);
    }
  }
};

// Evaluates a field at any number of points. makeField(index of the first point) makes the field of
// a batch.
template <class MakeField>
void EvaluateInLanes(
  const BallCells& cells, std::size_t count, const double* points, MakeField makeField)
{
  using Field = decltype(makeField(std::size_t(0)));
  using Evaluation = LaneEvaluation<Field>;
  const auto run = CompiledKernel<Evaluation, std::size_t>::GetBest();
  for (std::size_t first = 0; first < count; first += PlaceGroups::Capacity)
  {
    const Field field = makeField(first);
    run(Evaluation{ cells, field, points + 3 * first },
      std::min(count - first, PlaceGroups::Capacity));
  }
}

}

#endif
