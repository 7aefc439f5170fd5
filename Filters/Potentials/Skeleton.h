// Points and segments, and the sum of their contributions (see SkeletonKernel.h) anywhere.
//
// Contributions are added by ascending index, points in the order in which they were added, then
// segments, so that a sum has the same bits whatever the cells, the batch and the thread.

#ifndef Skeleton_h
#define Skeleton_h

#include "ElementIndex.h"
#include "SkeletonKernel.h"
#include "vtkActivePotentialsModule.h"

namespace activesurface
{

struct VTKACTIVEPOTENTIALS_EXPORT SkeletonVertex
{
  double Position[3];
  double Radius;
  double Strength;

  // Finite, and of a size (1e-100 to 1e100) that can be squared and divided by.
  bool IsUsable() const;
};

// Returns the largest radius, 0 if there are no vertices.
VTKACTIVEPOTENTIALS_EXPORT double FindLargestRadius(const std::vector<SkeletonVertex>& vertices);

// How much a point of the skeleton adds to the sum at a place.
struct SkeletonWeight
{
  std::uint32_t Point;
  double Weight;
};

// Distance from an element of strength 1, over its reach, at which its kernel falls to a level in
// ]0,1[: the radius of the ball or tube that it makes without neighbours.
VTKACTIVEPOTENTIALS_EXPORT double FindRadiusOfLevel(SkeletonKernel kernel, double level);

class VTKACTIVEPOTENTIALS_EXPORT Skeleton
{
public:
  // Forgets all elements, keeps the memory.
  void Clear();

  // All points come before the first segment. Vertices have to be usable.
  void AddPoint(const SkeletonVertex& vertex);
  void AddSegment(const SkeletonVertex& start, const SkeletonVertex& end);

  // Comes after the last element and before the first evaluation. Throws as ElementIndex does.
  void Build() { this->Near.Build(); }

  // Values: threshold - sum, at points (x y z each); gradients, unless null: those of the values.
  // A point that is not finite gets NaN. Thread-safe.
  void Evaluate(SkeletonKernel kernel, double threshold, std::size_t count, const double* points,
    double* values, double* gradients) const;

  // What each point, no segment, contributes to the sum at x, those that add nothing left out; in
  // the order of the points. Thread-safe.
  void FindWeights(
    SkeletonKernel kernel, const double x[3], std::vector<SkeletonWeight>& weights) const;

  std::size_t GetNumberOfElements() const { return this->Near.Size(); }
  bool HasSegments() const { return !this->Segments.empty(); }

  // The points, as they were added.
  std::vector<SkeletonVertex> ListPoints() const;

  // The box of all supports: xmin xmax ymin ... Meaningless without elements.
  const double* GetBounds() const { return this->Near.GetBounds(); }

private:
  using Index = SkeletonCells::Index;

  template <class Kernel>
  struct Evaluation;
  template <class Kernel>
  void AddWeights(const double x[3], std::vector<SkeletonWeight>& weights) const;
  template <class Kernel, class Sums>
  ACTIVE_ALWAYS_INLINE void AddAll(const SkeletonCells::Place& place, Sums& sums) const;
  template <class Kernel, class Sums>
  ACTIVE_ALWAYS_INLINE void AddHits(const Index* hits, std::size_t count, Sums& sums) const;

  std::vector<SkeletonPoint> Points;
  std::vector<SkeletonSegment> Segments;
  ElementIndex Near; // the points, then the segments
};

}

#endif
