// Particles of an input of which each rank keeps some, its home part, and how points get there and
// from there to other ranks.
//
// The home of a particle follows from its id, or from its number in the whole input: so a particle
// has the same one in each time step, and its places in two steps are known on one rank.

#ifndef HomeParticles_h
#define HomeParticles_h

#include "Agreement.h"
#include "Targets/InputShape.h"
#include "Targets/ParticleFrame.h"

#include "vtkSmartPointer.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

class vtkDataArray;
class vtkIdList;
class vtkPolyData;

namespace activesurface
{

// Array of points' numbers in the whole input.
constexpr const char* NumbersOfPoints = "vtkActiveNumbersOfPoints";

// The part of an input whose home is this rank.
struct HomePart
{
  vtkSmartPointer<vtkPolyData> Data; // with NumbersOfPoints
  Agreement Ranks;
  // Makes shapes of points of the same input: of some, with their numbers, or of all without.
  std::function<std::unique_ptr<InputShape>(vtkPolyData* points, bool areAll)> Make;
};

struct HomePoints
{
  vtkSmartPointer<vtkPolyData> Data;
  std::size_t AllPoints = 0;
  std::uint64_t Content = 0; // of all ranks
};

// Sends this rank's points home; returns those whose home it is. ids: of the points, or null.
// Collective.
HomePoints SendHome(
  const Agreement& ranks, vtkPolyData* points, vtkDataArray* ids, std::uint64_t content);

// Describes the parts of all ranks together. points: number of the input's points. Collective.
WholeFrame DescribeWhole(const Agreement& ranks, const ParticleFrame& part, std::size_t points);

// Points of several ranks in one, by ascending numbers. Bytes are those of PackPoints.
Bytes PackPoints(vtkPolyData* points);
vtkSmartPointer<vtkPolyData> MergePoints(const std::vector<Bytes>& parts);

// All points of an input, on all ranks: as one process has them. Collective.
vtkSmartPointer<vtkPolyData> GatherPoints(const HomePart& home);

}

#endif
