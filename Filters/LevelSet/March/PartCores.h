/**
 * Cores of parts and hollows of the target into which the surface would not grow. From each core a
 * surface grows to the target.
 */
#ifndef PartCores_h
#define PartCores_h

#include "March/DifferingNodes.h"

#include <vector>

namespace activesurface
{

/** A ball at the deepest point of a part (inside the target) or of a hollow (outside the target).
 */
struct PartCore
{
  std::array<double, 3> Centre; //< [world units]
  double Radius;                //< [world units]
  bool IsHollow;
};

/** Returns a core for each part or hollow that the surface does not reach, or meets only in a
 * region too thin to grow from. Parts and hollows are those that the target reports, and those
 * found on a lattice of at most 64 cells along an axis. Returns no cores if too many nodes differ.
 */
std::vector<PartCore> FindPartCores(const ArrivalSearch& search);

/** A target that consists only of the cores. */
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
