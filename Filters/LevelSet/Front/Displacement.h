/**
 * Measures the displacement of the surface, to detect a steady state. Speeds at the nodes cannot
 * detect a steady state: under tension, the potential at nodes off the surface keeps changing while
 * the surface is steady.
 */
#ifndef Displacement_h
#define Displacement_h

#include "Base/Motion.h"
#include "Leaves/LeafTable.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

namespace activesurface
{

/** The sample points at one time, to be compared with those at a later time. */
class Displacement
{
public:
  /** Copies the potential. */
  void Begin(const LeafTable& table);

  /** The largest distance along the normal [voxels] by which a sample point has moved since Begin,
   * on edges that are still crossed, with the same end inside. Single precision adds noise of about
   * 1e-7. */
  double GetLargest(const LeafTable& table) const;

  struct Statistics
  {
    double ShareBeyond; //< fraction of the sample points that moved farther than `distance`
    double Mean;        //< mean distance of all sample points [voxels]
  };

  /** Returns statistics of the sample points of Begin; 0 without sample points. If the edge of a
   * point is no longer crossed with the same end inside, the point counts as moved by a voxel, and
   * as moved farther than any `distance`. */
  Statistics GetStatistics(const LeafTable& table, double distance) const;

private:
  struct Leaf
  {
    openvdb::Coord Origin;
    std::array<LeafMask, 3> Edge;
    LeafMask Inside;
    std::array<std::int32_t, 3> Next; // next leaf, by axis
  };

  template <class Function>
  void ForEachPoint(const LeafTable& table, std::size_t i, Function&& function) const;

  std::vector<Leaf> Leaves;
  std::vector<float> Values; // 512 per leaf
};

/**
 * Detects a steady state up to residual oscillation: noise below the voxel size never settles. A
 * window has as many substeps as have been observed before the window, at least 16. A window
 * measures the displacement of the surface since the beginning of the window.
 */
class SteadyWindow
{
public:
  /** Called after each substep. attraction: Attraction of the motion [1/time]. IsSteady returns
   * true only after the last substep of a window of at least 8 / attraction [time], in which
   * distances to a target decay by a factor of exp(8) or more; without attraction, never. */
  void Observe(const LeafTable& table, double time, double attraction);

  /** Returns true if the remaining motion is an oscillation, by one of two measures of the last
   * window. Either the moved fraction of the surface was at most SteadyStateCriterion::FewMoving,
   * and at least half of the moved fraction in the window before. Or the mean displacement was at
   * most 0.25 voxel, and 0.5 to 1.25 times the average of the mean displacements in the two windows
   * before. */
  bool IsSteady() const { return this->Steady; }

  /** Fraction of the sample points that moved farther than SteadyStateCriterion::Still in the last
   * window; NaN before the end of the first window. */
  double GetShare() const { return this->Share; }

  /** Mean displacement of the sample points in the last window [voxels]; NaN before the end of the
   * first window. */
  double GetMean() const { return this->Mean; }

private:
  void Begin(const LeafTable& table, double time);

  Displacement Since;
  double BeganAt = 0.0;
  std::size_t Substeps = 0; //< observed
  std::size_t End = 0;      //< value of Substeps at the end of the window
  double Share = std::numeric_limits<double>::quiet_NaN();
  double Mean = std::numeric_limits<double>::quiet_NaN(); //< of the last window
  double MeanBefore = std::numeric_limits<double>::quiet_NaN();
  bool Steady = false;
};

}

#endif
