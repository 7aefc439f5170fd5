/**
 * Parts that only the target has, and its hollows: their cores, from which a surface grows until it
 * arrives.
 */
#ifndef PartCores_h
#define PartCores_h

#include "Arrival/DifferingNodes.h"

#include <vector>

namespace activesurface
{

/** A ball of the target's inside, or of its outside, where it is deepest. */
struct PartCore
{
  std::array<double, 3> Centre;
  double Radius;
  bool IsHollow;
};

/** One for each part that the surface does not reach. The target tells of its parts, if it
 * knows them; and they are looked for on a lattice of at most 64 nodes an axis. */
std::vector<PartCore> FindPartCores(const ArrivalSearch& search);

/** The target that has these parts alone. */
class CoreTarget : public Target
{
public:
  explicit CoreTarget(const std::vector<PartCore>& cores)
    : Cores(cores)
  {
  }

  bool HasRegions() const override { return true; }
  std::size_t CountRegionSources() const override { return this->Cores.size(); }
  void VisitRegions(std::size_t first, std::size_t end, const RegionVisitor& visit) const override;
  void Evaluate(
    std::size_t count, const double* points, const TargetResults& results) const override;

private:
  const std::vector<PartCore>& Cores;
};

}

#endif
